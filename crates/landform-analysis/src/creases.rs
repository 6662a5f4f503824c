//! Creases: sharp bends along the lines of a grid.

use landform_graph::Lattice;

use crate::AnalysisError;
use crate::spectrum::check;

/// How sharply a surface bends where it crosses the lines of a square grid, beside elsewhere.
///
/// Multi-level synthesis leaves creases on the lines of its coarser levels (Miller 1986; thesis,
/// figures 2.5 and 2.8). A bend is a second difference `z(k - 1) - 2 z(k) + z(k + 1)` along a row or
/// a column, in the unit of the heights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Creases {
    /// Largest bend across a line.
    pub largest: f64,
    /// Root mean square of the bends across lines over that of the bends between lines: 1 for a
    /// surface that knows nothing of the grid.
    pub ratio: f64,
}

impl Creases {
    /// Measures the bends of `heights` at the lines that are `cell` nodes apart, the first one the
    /// western and northern border. Borders themselves have no bend unless their axis is periodic.
    ///
    /// `None` for a surface without a bend, or without nodes between lines.
    ///
    /// # Errors
    /// See [`AnalysisError`].
    pub fn new(
        lattice: &Lattice,
        heights: &[f64],
        cell: usize,
    ) -> Result<Option<Self>, AnalysisError> {
        check(lattice, heights)?;
        let size = [lattice.width(), lattice.height()];
        let mut largest = 0.0_f64;
        let [mut across, mut between] = [[0.0; 2]; 2];
        for (node, height) in heights.iter().enumerate() {
            let place = [node % size[0], node / size[0]];
            for axis in [0, 1] {
                let [before, after] = [size[axis] - 1, 1].map(|step| place[axis] + step);
                let inside = (1..size[axis] - 1).contains(&place[axis]);
                if !inside && (!lattice.is_periodic(axis) || size[axis] < 3) {
                    continue;
                }
                let at = |along: usize| {
                    let mut there = place;
                    there[axis] = along % size[axis];
                    heights[there[0] + size[0] * there[1]]
                };
                let bend = at(before) - 2.0 * height + at(after);
                let sums = match place[axis].is_multiple_of(cell.max(1)) {
                    true => &mut across,
                    false => &mut between,
                };
                sums[0] += 1.0;
                sums[1] += bend * bend;
                if place[axis].is_multiple_of(cell.max(1)) {
                    largest = largest.max(bend.abs());
                }
            }
        }
        let [across, between] = [across, between].map(|[count, squares]| squares / count);
        let ratio = (across / between).sqrt();
        Ok(ratio.is_finite().then_some(Self { largest, ratio }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    fn lattice(boundary: Boundary) -> Lattice {
        Lattice::plane([32, 16], 2.0, Connectivity::Eight, [boundary; 2]).unwrap()
    }

    /// Roofs with ridges every 8 columns bend by 2 at the ridges, valleys between them included
    /// when they fall on lines, and nowhere else.
    #[test]
    fn a_roof_bends_at_its_ridge() {
        let roof = |node: usize| ((node % 32 % 8) as f64 - 4.0).abs() + (node / 32) as f64;
        let heights: Vec<f64> = (0..512).map(roof).collect();
        let found = Creases::new(&lattice(Boundary::Open), &heights, 8).unwrap().unwrap();
        assert_eq!(found.largest, 2.0);
        assert!(found.ratio > 2.0, "{found:?}");
        let other = Creases::new(&lattice(Boundary::Open), &heights, 7).unwrap().unwrap();
        assert!(other.ratio < 1.5, "{other:?}");
    }

    #[test]
    fn a_parabola_bends_alike_everywhere_and_a_plane_nowhere() {
        let parabola: Vec<f64> = (0..512)
            .map(|node| [node % 32, node / 32].map(|x| (x * x) as f64).iter().sum())
            .collect();
        let found = Creases::new(&lattice(Boundary::Open), &parabola, 4).unwrap().unwrap();
        assert_eq!((found.largest, found.ratio), (2.0, 1.0));
        let plane: Vec<f64> = (0..512).map(|node| (node % 32) as f64).collect();
        assert_eq!(Creases::new(&lattice(Boundary::Open), &plane, 4), Ok(None));
        assert_eq!(Creases::new(&lattice(Boundary::Periodic), &parabola, 1), Ok(None));
    }
}
