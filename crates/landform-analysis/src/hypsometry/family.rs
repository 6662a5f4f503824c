//! Strahler's family of model curves.

use super::HypsometricCurve;

/// A model curve (thesis, equation 2.9; Strahler 1952):
///
/// `f(x) = ((d - X) / X * a / (d - a))^z` with `X = (d - a) x + a`.
///
/// Only the ratio a/d and the exponent z matter. The curve falls from (0, 1) to (1, 0). It is
/// concave above and convex below an inflection at `x = 1 - (1 - z) / (2 (1 - a/d))`, entirely
/// concave when z is 1 or more, and entirely convex when z is at most 2 a/d - 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrahlerCurve {
    a_over_d: f64,
    z: f64,
}

impl StrahlerCurve {
    /// The curve with this ratio (above 0 and below 1) and exponent (above 0 and finite);
    /// `None` for other numbers.
    pub fn new(a_over_d: f64, z: f64) -> Option<Self> {
        let in_range = a_over_d > 0.0 && a_over_d < 1.0 && z > 0.0 && z.is_finite();
        in_range.then_some(Self { a_over_d, z })
    }

    /// Ratio a/d.
    pub fn a_over_d(&self) -> f64 {
        self.a_over_d
    }

    /// Exponent z.
    pub fn z(&self) -> f64 {
        self.z
    }

    /// Relative height above which the share `x` of the area lies.
    pub fn height_at(&self, x: f64) -> f64 {
        let x = x.clamp(0.0, 1.0);
        let ratio = self.a_over_d;
        // (d - X) / (d - a) is 1 - x: so written, nothing cancels.
        (ratio * (1.0 - x) / ((1.0 - ratio) * x + ratio)).powf(self.z)
    }

    /// Where concavity gives way to convexity: 1 or more for curves that are entirely concave,
    /// 0 or less for entirely convex ones.
    pub fn inflection(&self) -> f64 {
        1.0 - (1.0 - self.z) / (2.0 * (1.0 - self.a_over_d))
    }
}

/// The member of the family that is nearest to a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FamilyFit {
    /// The nearest curve.
    pub curve: StrahlerCurve,
    /// Root mean square distance, in relative heights, at equal shares of area.
    pub misfit: f64,
}

/// Range of the search: logarithm of the odds of a/d, and logarithm of z.
const SEARCHED: [[f64; 2]; 2] = [[-9.0, 9.0], [-5.0, 5.0]];
/// Steps of the coarse search along each axis.
const GRID: usize = 36;
/// Most steps of the refinement; some ten are usual.
const MOST_STEPS: usize = 200;

impl FamilyFit {
    /// Finds the nearest curve by least squares: the best of a grid over a/d from 0.0001 to
    /// 0.9999 and z from 0.007 to 150, refined by the method of Levenberg and Marquardt.
    pub fn new(curve: &HypsometricCurve) -> Self {
        let points: Vec<[f64; 2]> = curve.points().collect();
        let squares = |place: [f64; 2]| {
            let model = member(place);
            points.iter().map(|&[x, y]| (model.height_at(x) - y).powi(2)).sum::<f64>()
        };
        let mut place = coarse(&squares);
        let mut sum = squares(place);
        let mut damping = 1e-3;
        for _ in 0..MOST_STEPS {
            let next = step(&points, place, damping);
            let next_sum = squares(next);
            if next_sum < sum {
                (place, sum, damping) = (next, next_sum, 0.1 * damping);
            } else {
                damping *= 10.0;
            }
        }
        Self { curve: member(place), misfit: (sum / points.len() as f64).sqrt() }
    }
}

/// The best place of a grid.
fn coarse(squares: &impl Fn([f64; 2]) -> f64) -> [f64; 2] {
    let at = |axis: usize, index: usize| {
        let [least, most] = SEARCHED[axis];
        least + (most - least) * index as f64 / GRID as f64
    };
    let mut best = ([0.0; 2], f64::INFINITY);
    for index in 0..(GRID + 1) * (GRID + 1) {
        let place = [at(0, index % (GRID + 1)), at(1, index / (GRID + 1))];
        let sum = squares(place);
        if sum < best.1 {
            best = (place, sum);
        }
    }
    best.0
}

/// A damped Gauss-Newton step, kept within the range of the search.
///
/// With odds o, `f = (o (1 - x) / (x + o))^z`, so `df / d ln o = f z x / (x + o)` and
/// `df / d ln z = f ln f`.
fn step(points: &[[f64; 2]], place: [f64; 2], damping: f64) -> [f64; 2] {
    let (model, odds) = (member(place), place[0].exp());
    let [mut oo, mut oz, mut zz, mut o, mut z] = [0.0; 5];
    for &[x, y] in points {
        let height = model.height_at(x);
        let by_odds = height * model.z * x / (x + odds);
        let by_z = if height > 0.0 { height * height.ln() } else { 0.0 };
        oo += by_odds * by_odds;
        oz += by_odds * by_z;
        zz += by_z * by_z;
        o += by_odds * (y - height);
        z += by_z * (y - height);
    }
    let [oo, zz] = [oo, zz].map(|square| square * (1.0 + damping) + f64::MIN_POSITIVE);
    let determinant = oo * zz - oz * oz;
    let moves = [(zz * o - oz * z) / determinant, (oo * z - oz * o) / determinant];
    let leaves = [0, 1].map(|axis| {
        let [least, most] = SEARCHED[axis];
        !(least..=most).contains(&(place[axis] + moves[axis]))
    });
    // Along the border of the range the other axis is searched alone.
    let moves = match leaves {
        [true, false] => [moves[0], z / zz],
        [false, true] => [o / oo, moves[1]],
        _ => moves,
    };
    std::array::from_fn(|axis| {
        let [least, most] = SEARCHED[axis];
        let next = place[axis] + moves[axis];
        // A singular step leads nowhere.
        if next.is_nan() { place[axis] } else { next.clamp(least, most) }
    })
}

fn member([log_odds, log_z]: [f64; 2]) -> StrahlerCurve {
    StrahlerCurve { a_over_d: 1.0 / (1.0 + (-log_odds).exp()), z: log_z.exp() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equation 2.9 as it is printed.
    fn as_printed(x: f64, a: f64, d: f64, z: f64) -> f64 {
        let below = (d - a) * x + a;
        ((d - below) / below * a / (d - a)).powf(z)
    }

    #[test]
    fn the_curve_is_equation_2_9() {
        for (a, d, z) in [(0.01, 1.0, 0.3), (1.0, 10.0, 1.0), (4.0, 8.0, 2.5)] {
            let curve = StrahlerCurve::new(a / d, z).unwrap();
            assert_eq!([curve.height_at(0.0), curve.height_at(1.0)], [1.0, 0.0]);
            for x in [0.05, 0.3, 0.7, 0.99] {
                assert!((curve.height_at(x) - as_printed(x, a, d, z)).abs() < 1e-12);
            }
        }
        for (ratio, z) in
            [(0.0, 1.0), (1.0, 1.0), (f64::NAN, 1.0), (0.5, 0.0), (0.5, f64::INFINITY)]
        {
            assert_eq!(StrahlerCurve::new(ratio, z), None);
        }
    }

    /// A curve that no member comes near: the best one has the largest ratio of the search, and the
    /// exponent that is best for it.
    #[test]
    fn at_the_border_of_the_search_the_other_number_is_still_the_best() {
        let heights: Vec<f64> = (0..2000)
            .map(|cell| f64::from(cell) / 2000.0)
            .map(|share| if share < 0.35 { share } else { 1.0 - (1.0 - share).powf(1.6) * 0.6 })
            .collect();
        let curve = HypsometricCurve::new(&heights).unwrap();
        let found = FamilyFit::new(&curve);
        let misfit = |z: f64| {
            let model = StrahlerCurve { a_over_d: found.curve.a_over_d, z };
            curve.points().map(|[x, y]| (model.height_at(x) - y).powi(2)).sum::<f64>()
        };
        let z = found.curve.z;
        assert!(found.curve.a_over_d > 0.9998, "{found:?}");
        assert!(misfit(z) <= misfit(1.0005 * z) && misfit(z) <= misfit(0.9995 * z), "{found:?}");
    }

    /// Second differences change sign where the formula says.
    #[test]
    fn the_inflection_is_where_curvature_changes_sign() {
        for (ratio, z) in [(0.01, 0.2), (0.1, 0.5), (0.5, 0.4), (0.3, 0.8), (0.5, 1.5), (0.9, 0.5)]
        {
            let curve = StrahlerCurve::new(ratio, z).unwrap();
            let h = 1e-4;
            for x in (1..100).map(|k| f64::from(k) / 100.0) {
                let bend =
                    curve.height_at(x - h) - 2.0 * curve.height_at(x) + curve.height_at(x + h);
                if (x - curve.inflection()).abs() > 0.02 {
                    assert_eq!(bend > 0.0, x < curve.inflection(), "{ratio} {z} {x}");
                }
            }
        }
    }

    #[test]
    fn members_of_the_family_are_found_again() {
        for (ratio, z) in [(0.01, 0.2), (0.1, 0.35), (0.1, 1.0), (0.5, 0.6), (0.5, 3.0)] {
            let curve = StrahlerCurve::new(ratio, z).unwrap();
            let fit = FamilyFit::new(&super::super::form::tests::sampled(&|x| curve.height_at(x)));
            assert!(fit.misfit < 1e-3, "{ratio} {z}: {fit:?}");
            let [found_ratio, found_z] = [fit.curve.a_over_d(), fit.curve.z()];
            assert!((found_ratio / ratio - 1.0).abs() < 0.05, "{ratio} {z}: {fit:?}");
            assert!((found_z / z - 1.0).abs() < 0.05, "{ratio} {z}: {fit:?}");
        }
    }
}
