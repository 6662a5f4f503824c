//! Laws that numbers are held against.

use serde::Deserialize;

/// A published law: y as a function of x.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub enum Law {
    /// The same number everywhere.
    Constant(f64),
    /// `factor x^exponent`, given as the factor and the exponent.
    Power(f64, f64),
    /// `factor / (x + shift)`, given as the factor and the shift.
    Hyperbola(f64, f64),
}

impl Law {
    /// The law at `x`; not finite where it has no value.
    pub fn at(self, x: f64) -> f64 {
        match self {
            Self::Constant(value) => value,
            Self::Power(factor, exponent) => factor * x.powf(exponent),
            Self::Hyperbola(factor, shift) => factor / (x + shift),
        }
    }

    /// The power of this exponent whose factor fits the points best: the line of that slope
    /// through their middle on logarithmic axes. `None` without points above 0.
    pub fn through(exponent: f64, points: &[[f64; 2]]) -> Option<Self> {
        let logs: Vec<f64> = points
            .iter()
            .filter(|[x, y]| *x > 0.0 && *y > 0.0)
            .map(|[x, y]| y.ln() - exponent * x.ln())
            .collect();
        let mean = logs.iter().sum::<f64>() / logs.len() as f64;
        (!logs.is_empty()).then(|| Self::Power(mean.exp(), exponent))
    }
}

/// The exponent of the power that fits points above 0 best, by least squares of logarithms; `None` when
/// fewer than two of them lie at different `x`.
pub(super) fn exponent(points: &[[f64; 2]]) -> Option<f64> {
    if points.iter().flatten().any(|value| value.is_nan() || *value <= 0.0) {
        return None;
    }
    let logs: Vec<[f64; 2]> = points.iter().map(|point| point.map(f64::ln)).collect();
    let count = logs.len() as f64;
    let mean = |axis: usize| logs.iter().map(|point| point[axis]).sum::<f64>() / count;
    let [x, y] = [mean(0), mean(1)];
    let product: f64 = logs.iter().map(|point| (point[0] - x) * (point[1] - y)).sum();
    let square: f64 = logs.iter().map(|point| (point[0] - x).powi(2)).sum();
    (square > 0.0).then(|| product / square)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laws_have_their_values() {
        assert_eq!(Law::Constant(2.125).at(7.0), 2.125);
        assert_eq!(Law::Power(3.0, 2.0).at(4.0), 48.0);
        assert_eq!(Law::Hyperbola(8.5, 3.7).at(13.3), 0.5);
    }

    #[test]
    fn exponents_are_found_again() {
        let law = Law::Power(0.3, 4.0 / 7.0);
        let points = [32.0, 64.0, 512.0].map(|x| [x, law.at(x)]);
        assert!(exponent(&points).is_some_and(|found| (found - 4.0 / 7.0).abs() < 1e-12));
        let Some(Law::Power(factor, _)) = Law::through(4.0 / 7.0, &points) else {
            panic!("a power")
        };
        assert!((factor - 0.3).abs() < 1e-12);
        for points in [vec![], vec![[2.0, 1.0]; 2], vec![[1.0, 1.0], [2.0, 0.0]]] {
            assert_eq!(exponent(&points), None, "{points:?}");
        }
        assert_eq!(Law::through(1.0, &[[0.0, 1.0]]), None);
    }
}
