//! Sierpinski's triangle and carpet.

use super::check_level;
use crate::SynthError;

/// ln 3 / ln 2.
pub const TRIANGLE_DIMENSION: f64 = 1.584_962_500_721_156;

/// ln 8 / ln 3.
pub const CARPET_DIMENSION: f64 = 1.892_789_260_714_372;

/// The triangles that are left of an equilateral one with its base from 0, 0 to 1, 0 when the
/// middle quarter of every triangle has been taken out `level` times: `3^level` rings of three
/// corners.
///
/// # Errors
/// [`SynthError::OutOfRange`] for levels above 12.
pub fn sierpinski_triangle(level: u32) -> Result<Vec<[[f64; 2]; 3]>, SynthError> {
    check_level("sierpinski_triangle", level, 12)?;
    let mut triangles = vec![[[0.0, 0.0], [1.0, 0.0], [0.5, 0.75_f64.sqrt()]]];
    for _ in 0..level {
        let corners = |triangle: &[[f64; 2]; 3]| {
            let triangle = *triangle;
            triangle.map(|corner| {
                triangle.map(|other| [0.5 * (corner[0] + other[0]), 0.5 * (corner[1] + other[1])])
            })
        };
        triangles = triangles.iter().flat_map(corners).collect();
    }
    Ok(triangles)
}

/// Which of `3^level` by `3^level` cells are left of a square when the middle ninth of every
/// square has been taken out `level` times; row by row.
///
/// # Errors
/// [`SynthError::OutOfRange`] for levels above 8.
pub fn sierpinski_carpet(level: u32) -> Result<Vec<bool>, SynthError> {
    check_level("sierpinski_carpet", level, 8)?;
    let side = 3_usize.pow(level);
    let left = |cell: usize| {
        let [mut column, mut row] = [cell % side, cell / side];
        let mut hole = false;
        for _ in 0..level {
            hole |= column % 3 == 1 && row % 3 == 1;
            [column, row] = [column / 3, row / 3];
        }
        !hole
    };
    Ok((0..side * side).map(left).collect())
}

/// The outline of the carpet in the unit square: the square and its holes, as rings of four
/// corners, `1 + (8^level - 1) / 7` of them.
///
/// # Errors
/// [`SynthError::OutOfRange`] for levels above 5.
pub fn sierpinski_carpet_rings(level: u32) -> Result<Vec<[[f64; 2]; 4]>, SynthError> {
    check_level("sierpinski_carpet_rings", level, 5)?;
    let square =
        |[x, y]: [f64; 2], side: f64| [[x, y], [x + side, y], [x + side, y + side], [x, y + side]];
    let mut rings = vec![square([0.0, 0.0], 1.0)];
    let mut corners = vec![[0.0, 0.0]];
    for depth in 1..=level {
        let third = 3.0_f64.powi(-(depth as i32));
        let mut finer = Vec::with_capacity(8 * corners.len());
        for [x, y] in corners {
            for cell in 0..9 {
                let corner = [x + third * f64::from(cell % 3), y + third * f64::from(cell / 3)];
                match cell {
                    4 => rings.push(square(corner, third)),
                    _ => finer.push(corner),
                }
            }
        }
        corners = finer;
    }
    Ok(rings)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three quarters and eight ninths are left each time.
    #[test]
    fn what_is_left_is_known() {
        let area = |ring: &[[f64; 2]]| -> f64 {
            let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
            pairs.map(|(a, b)| 0.5 * (a[0] * b[1] - b[0] * a[1])).sum()
        };
        let triangles = sierpinski_triangle(6).unwrap();
        assert_eq!(triangles.len(), 729);
        let left: f64 = triangles.iter().map(|triangle| area(triangle).abs()).sum();
        assert!((left / (0.75_f64.sqrt() / 2.0) - 0.75_f64.powi(6)).abs() < 1e-12);
        for level in 0..5 {
            let cells = sierpinski_carpet(level).unwrap();
            assert_eq!(cells.iter().filter(|left| **left).count(), 8_usize.pow(level));
            let rings = sierpinski_carpet_rings(level).unwrap();
            let holes: f64 = rings[1..].iter().map(|ring| area(ring)).sum();
            assert!((1.0 - holes - (8.0_f64 / 9.0).powi(level as i32)).abs() < 1e-12);
        }
    }
}
