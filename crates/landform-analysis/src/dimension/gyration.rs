//! How the number of particles grows with the size of what they make.

use super::{Dimension, DimensionError, Rule};

/// Each number of particles at which the size is taken is so many times the one before.
const STEP: f64 = 1.2;

/// Dimension of what grows particle by particle: the first N of them have the radius of gyration
/// `R`, the root mean square distance from their middle, and N grows as R^D. `places` stand in the
/// order of arrival; the first `skipped` particles, too few to be a fractal, are left out.
///
/// # Errors
/// [`DimensionError::TooFewScales`] for fewer than about twice as many particles as are skipped.
///
/// # Source
/// Meakin 1998, "Fractals, scaling and growth far from equilibrium".
pub fn gyration_dimension(
    places: &[[f64; 3]],
    skipped: usize,
) -> Result<Dimension, DimensionError> {
    let (mut sum, mut squares) = ([0.0; 3], 0.0);
    let mut measured: Vec<[f64; 2]> = Vec::new();
    let mut next = skipped.max(2) as f64;
    for (number, place) in places.iter().enumerate() {
        // Distances from the first particle, so that far places lose no digits.
        let away = [0, 1, 2].map(|axis| place[axis] - places[0][axis]);
        (0..3).for_each(|axis| sum[axis] += away[axis]);
        squares += away.iter().map(|way| way * way).sum::<f64>();
        let count = (number + 1) as f64;
        if count >= next {
            let middle: f64 = sum.iter().map(|sum| (sum / count).powi(2)).sum();
            let radius = (squares / count - middle).max(0.0).sqrt();
            if measured.last().is_none_or(|last| radius > last[0]) && radius > 0.0 {
                measured.push([radius, count]);
            }
            next = (next * STEP).max(count + 1.0);
        }
    }
    Dimension::fit(&measured, Rule::MASS)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places that fill a line, a disc and a ball from the middle outwards.
    #[test]
    fn what_fills_space_has_the_dimension_of_space() {
        let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
        let place = |dimension: i32, number: usize| {
            let radius = ((number + 1) as f64).powf(1.0 / f64::from(dimension));
            let (north, east) = (golden * number as f64).sin_cos();
            match dimension {
                1 => [radius * [1.0, -1.0][number % 2], 0.0, 0.0],
                2 => [radius * east, radius * north, 0.0],
                _ => {
                    let up = 2.0 * (0.618_033_988_749_895 * number as f64).fract() - 1.0;
                    let level = (1.0 - up * up).sqrt();
                    let (north, east) = (2.0 * golden * number as f64 * 1.37).sin_cos();
                    [radius * level * east, radius * level * north, radius * up]
                }
            }
        };
        for dimension in 1..=3 {
            let places: Vec<[f64; 3]> =
                (0..20_000).map(|number| place(dimension, number).map(|at| at + 1e6)).collect();
            let found = gyration_dimension(&places, 100).unwrap();
            let expected = f64::from(dimension);
            assert!((found.dimension - expected).abs() < 0.01, "{dimension}: {found:?}");
        }
        let few = gyration_dimension(&[[0.0; 3]; 50], 10);
        assert_eq!(few, Err(DimensionError::TooFewScales(0)), "all at one place");
        assert!(gyration_dimension(&[], 0).is_err());
    }
}
