//! Koch's curves: every piece is replaced by a chain of smaller ones.

use super::check_level;
use crate::SynthError;

/// ln 4 / ln 3.
pub const KOCH_DIMENSION: f64 = 1.261_859_507_142_914_8;

/// ln 8 / ln 4.
pub const QUADRIC_KOCH_DIMENSION: f64 = 1.5;

/// Koch's curve of 1904 from 0, 0 to 1, 0: every piece gets an equilateral bump on its left, on
/// its middle third. `4^level + 1` points.
///
/// # Errors
/// [`SynthError::OutOfRange`] for levels above 10.
pub fn koch_curve(level: u32) -> Result<Vec<[f64; 2]>, SynthError> {
    check_level("koch_curve", level, 10)?;
    Ok(chain(&KOCH, level))
}

/// The quadric Koch curve from 0, 0 to 1, 0: eight pieces of a quarter, with a square bump on
/// either side. `8^level + 1` points.
///
/// # Errors
/// [`SynthError::OutOfRange`] for levels above 6.
pub fn quadric_koch_curve(level: u32) -> Result<Vec<[f64; 2]>, SynthError> {
    check_level("quadric_koch_curve", level, 6)?;
    Ok(chain(&QUADRIC, level))
}

/// Koch's snowflake, a ring of three Koch curves with their bumps outside, in the unit square:
/// a triangle of side 3/4 to begin with. Its last point is its first.
///
/// # Errors
/// [`SynthError::OutOfRange`] for levels above 9.
pub fn koch_snowflake(level: u32) -> Result<Vec<[f64; 2]>, SynthError> {
    check_level("koch_snowflake", level, 9)?;
    let side = 0.75;
    let height = side * 0.75_f64.sqrt();
    let base = 0.5 - height / 3.0;
    let corners = [[0.125, base], [0.5, base + height], [0.875, base]];
    let curve = chain(&KOCH, level);
    let mut ring = Vec::with_capacity(3 * curve.len());
    for number in 0..3 {
        let [from, to] = [corners[number], corners[(number + 1) % 3]];
        let [east, north] = [to[0] - from[0], to[1] - from[1]];
        let placed =
            |&[x, y]: &[f64; 2]| [from[0] + east * x - north * y, from[1] + north * x + east * y];
        ring.extend(curve[..curve.len() - 1].iter().map(placed));
    }
    ring.push(corners[0]);
    Ok(ring)
}

/// The inner points of a chain from 0, 0 to 1, 0.
const KOCH: [[f64; 2]; 3] = [[1.0 / 3.0, 0.0], [0.5, 0.288_675_134_594_812_9], [2.0 / 3.0, 0.0]];
const QUADRIC: [[f64; 2]; 7] =
    [[0.25, 0.0], [0.25, 0.25], [0.5, 0.25], [0.5, 0.0], [0.5, -0.25], [0.75, -0.25], [0.75, 0.0]];

/// The curve from 0, 0 to 1, 0 in which every piece has been replaced by a chain, `level` times.
fn chain(inner: &[[f64; 2]], level: u32) -> Vec<[f64; 2]> {
    let mut points = vec![[0.0, 0.0], [1.0, 0.0]];
    for _ in 0..level {
        let mut finer = Vec::with_capacity((inner.len() + 1) * points.len());
        for pair in points.windows(2) {
            let [east, north] = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
            finer.push(pair[0]);
            finer.extend(inner.iter().map(|[x, y]| {
                [pair[0][0] + east * x - north * y, pair[0][1] + north * x + east * y]
            }));
        }
        finer.extend(points.last());
        points = finer;
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length(points: &[[f64; 2]]) -> f64 {
        points.windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1])).sum()
    }

    /// Lengths grow by 4/3 and by 2; the snowflake's area approaches 8/5 of its triangle's.
    #[test]
    fn lengths_and_areas_are_the_known_ones() {
        for level in 0..7 {
            let curve = koch_curve(level).unwrap();
            assert_eq!(curve.len(), 4_usize.pow(level) + 1);
            assert_eq!((curve[0], curve[curve.len() - 1]), ([0.0; 2], [1.0, 0.0]));
            let expected = (4.0_f64 / 3.0).powi(level as i32);
            assert!((length(&curve) / expected - 1.0).abs() < 1e-12);
        }
        assert!((length(&quadric_koch_curve(4).unwrap()) - 16.0).abs() < 1e-9);
        let flake = koch_snowflake(6).unwrap();
        assert_eq!(flake.first(), flake.last());
        let area: f64 =
            flake.windows(2).map(|p| 0.5 * (p[0][0] * p[1][1] - p[1][0] * p[0][1])).sum();
        let triangle = 0.75_f64.powi(2) * 3.0_f64.sqrt() / 4.0;
        let expected = triangle * (1.6 - 0.6 * (4.0_f64 / 9.0).powi(6));
        assert!((area.abs() - expected).abs() < 1e-12, "{area} {expected}");
        assert!(flake.iter().flatten().all(|x| (0.0..=1.0).contains(x)));
    }

    #[test]
    fn levels_that_fill_memory_are_refused() {
        assert!(koch_curve(11).is_err() && quadric_koch_curve(u32::MAX).is_err());
        assert!(koch_snowflake(10).is_err());
    }
}
