//! Flow directions at any angle (D-infinity) and what accumulates along them.

use rayon::prelude::*;

use super::FlowDirections;
use crate::framed::Framed;
use crate::grid::{Grid, GridError, STEPS};

/// The eight triangles around a cell, counter-clockwise from east, each as the numbers of its
/// steps along an axis and along a diagonal.
const FACETS: [[u8; 2]; 8] = [[0, 4], [1, 4], [1, 5], [2, 5], [2, 6], [3, 6], [3, 7], [0, 7]];

/// For every cell the direction of steepest descent at any angle, D-infinity (Tarboton 1997):
/// that of the steepest of the eight triangles between the cell and its neighbours. Water is
/// shared between the two neighbours that enclose the direction, in proportion to the angles.
///
/// Where no triangle descends (flats, filled lakes, cells beside no-data or on the edge) the
/// single direction of [`FlowDirections`] is taken.
#[derive(Clone, Debug, PartialEq)]
pub struct DInfinity {
    /// Directions of the cells that no triangle drains, and where water leaves.
    single: FlowDirections,
    /// Index in [`FACETS`] of the triangle that each cell drains to; [`NO_FACET`] if none descends.
    facets: Vec<u8>,
    /// Share of the neighbour on the diagonal.
    diagonal_shares: Vec<f64>,
}

/// No triangle descends.
const NO_FACET: u8 = 8;

impl DInfinity {
    /// Directions on a surface without depressions, as
    /// [`fill_depressions`](super::fill_depressions) makes it.
    ///
    /// # Errors
    /// See [`GridError`].
    pub fn over_filled(grid: &Grid, filled: &[f64]) -> Result<Self, GridError> {
        let single = FlowDirections::over_filled(grid, filled)?;
        let framed = Framed::new(grid, filled);
        let triangles = Triangles::new(grid);
        let mut facets = vec![NO_FACET; filled.len()];
        let mut diagonal_shares = vec![0.0; filled.len()];
        let columns = grid.columns();
        let rows = facets.par_chunks_exact_mut(columns);
        let rows = rows.zip(diagonal_shares.par_chunks_exact_mut(columns)).enumerate();
        rows.for_each(|(row, (facets, shares))| {
            let window = framed.window(row).map(|row| &row[..columns + 2]);
            for (x, (facet, share)) in facets.iter_mut().zip(shares).enumerate() {
                let around = Framed::around(window, x);
                (*facet, *share) = triangles.steepest(window[1][x + 1], &around);
            }
        });
        Ok(Self { single, facets, diagonal_shares })
    }

    /// Angle of the flow, counter-clockwise from east on the map in radians, 0 to 2 pi; `None`
    /// where water leaves, stays or there are no data.
    pub fn angle(&self, cell: usize) -> Option<f64> {
        let [width, height] = self.single.grid().cell_size();
        let of_step = |step: u8| {
            let [x, y] = STEPS[usize::from(step)].map(|step| step as f64);
            (-y * height).atan2(x * width).rem_euclid(std::f64::consts::TAU)
        };
        let number = self.facets[cell];
        let Some(facet) = FACETS.get(usize::from(number)) else {
            return self.single.direction(cell).map(of_step);
        };
        let [axis, diagonal] = facet.map(of_step);
        let full = std::f64::consts::TAU;
        // The triangle between south-east and east ends at a full turn.
        let axis = if number == 7 { full } else { axis };
        Some((axis + self.diagonal_shares[cell] * (diagonal - axis)).rem_euclid(full))
    }

    /// The neighbours that receive the water of a cell, with their shares, which add up to 1; a
    /// share of 0 stands for no neighbour.
    pub fn receivers(&self, cell: usize) -> [(usize, f64); 2] {
        let offsets = self.single.grid().step_offsets();
        self.receivers_by(&offsets, cell)
    }

    #[inline]
    fn receivers_by(&self, offsets: &[isize; 8], cell: usize) -> [(usize, f64); 2] {
        let Some(facet) = FACETS.get(usize::from(self.facets[cell])) else {
            let next = self.single.receiver(cell);
            return [next.map_or((cell, 0.0), |next| (next, 1.0)), (cell, 0.0)];
        };
        let [axis, diagonal] =
            facet.map(|step| cell.wrapping_add_signed(offsets[usize::from(step)]));
        let share = self.diagonal_shares[cell];
        [(axis, 1.0 - share), (diagonal, share)]
    }

    /// Area in square metres whose water passes each cell, itself included; 0 where there are no
    /// data.
    pub fn contributing_area(&self) -> Vec<f64> {
        let grid = self.single.grid();
        let offsets = grid.step_offsets();
        let mut donors = vec![0_u8; self.facets.len()];
        for cell in 0..donors.len() {
            for (next, share) in self.receivers_by(&offsets, cell) {
                donors[next] += u8::from(share > 0.0);
            }
        }
        let area = |cell| if self.single.has_data(cell) { grid.cell_area() } else { 0.0 };
        let mut areas: Vec<f64> = (0..donors.len()).map(area).collect();
        const VISITED: u8 = u8::MAX;
        let mut ready = Vec::new();
        for source in 0..donors.len() {
            if donors[source] == 0 {
                ready.push(source);
            }
            while let Some(cell) = ready.pop() {
                donors[cell] = VISITED;
                for (next, share) in self.receivers_by(&offsets, cell) {
                    if share > 0.0 {
                        areas[next] += share * areas[cell];
                        donors[next] -= 1;
                        if donors[next] == 0 {
                            ready.push(next);
                        }
                    }
                }
            }
        }
        areas
    }
}

/// Lengths of the sides of the triangles around a cell.
struct Triangles {
    /// Inverse lengths of the side along the axis, of the one across, and of the diagonal.
    inverse: [[f64; 3]; 8],
    /// Length of the side across over that along the axis.
    aspect: [f64; 8],
}

impl Triangles {
    fn new(grid: &Grid) -> Self {
        let lengths = grid.step_lengths();
        let sides = FACETS.map(|[axis, _]| {
            let across = usize::from(axis + 1) & 3;
            [lengths[usize::from(axis)], lengths[across], lengths[4]]
        });
        let aspect = sides.map(|[along, across, _]| across / along);
        Self { inverse: sides.map(|side| side.map(f64::recip)), aspect }
    }

    /// Number of the triangle with the steepest descent from a height, and the share of its
    /// diagonal; of several, the first. Triangles with a corner without data do not count.
    #[inline]
    fn steepest(&self, height: f64, around: &[f64; 8]) -> (u8, f64) {
        let mut best = (0.0, 0, 0.0, 0.0);
        for (number, [axis, diagonal]) in FACETS.into_iter().enumerate() {
            let [near, far] = [around[usize::from(axis)], around[usize::from(diagonal)]];
            let [along, across, slanted] = self.inverse[number];
            let [first, second] = [(height - near) * along, (near - far) * across];
            // Squares with a sign: a slope along one of the two sides may rise.
            let (squared, tilt) = if second <= 0.0 {
                (first * first.abs(), 0.0)
            } else if second >= first * self.aspect[number] {
                let slope = (height - far) * slanted;
                (slope * slope.abs(), f64::INFINITY)
            } else {
                (first * first + second * second, second)
            };
            if squared > best.0 {
                best = (squared, number, tilt, first);
            }
        }
        let (squared, number, tilt, first) = best;
        if squared == 0.0 {
            return (NO_FACET, 0.0);
        }
        let diagonal_share = match tilt {
            0.0 => 0.0,
            f64::INFINITY => 1.0,
            second => (second / first).atan() / self.aspect[number].atan(),
        };
        (number as u8, diagonal_share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hydrology::fill_depressions;
    use crate::hydrology::testing::terrains;
    use std::f64::consts::{FRAC_PI_2, TAU};

    /// Tarboton's equations as printed, triangle by triangle: angle within it and slope.
    fn by_definition(grid: &Grid, heights: [f64; 3], along_x: bool) -> (f64, f64) {
        let [width, height] = grid.cell_size();
        let [d1, d2] = if along_x { [width, height] } else { [height, width] };
        let [e0, e1, e2] = heights;
        let [s1, s2] = [(e0 - e1) / d1, (e1 - e2) / d2];
        let angle = s2.atan2(s1);
        match angle {
            below if below < 0.0 => (0.0, s1),
            above if above > d2.atan2(d1) => (d2.atan2(d1), (e0 - e2) / d1.hypot(d2)),
            inside => (inside, s1.hypot(s2)),
        }
    }

    #[test]
    fn triangles_are_the_steepest_by_definition() {
        let mut compared = 0;
        for (grid, heights) in terrains() {
            let filled = fill_depressions(&grid, &heights).unwrap();
            let directions = DInfinity::over_filled(&grid, &filled).unwrap();
            for cell in 0..filled.len() {
                let around: Vec<(usize, usize)> = grid.neighbours(cell).collect();
                if around.len() < 8 || around.iter().any(|&(_, next)| filled[next].is_nan()) {
                    continue;
                }
                let triangle = |number: usize| {
                    let [axis, diagonal] = FACETS[number].map(usize::from);
                    let corners =
                        [filled[cell], filled[around[axis].1], filled[around[diagonal].1]];
                    by_definition(&grid, corners, axis % 2 == 0)
                };
                let steepest = (0..8).map(|number| triangle(number).1).fold(0.0, f64::max);
                let number = directions.facets[cell];
                if number == NO_FACET {
                    assert!(steepest <= 0.0);
                    continue;
                }
                let (angle, slope) = triangle(usize::from(number));
                assert!((slope - steepest).abs() <= 1e-12 * steepest);
                let start = f64::from(number.div_ceil(2)) * FRAC_PI_2;
                let expected = if number.is_multiple_of(2) { start + angle } else { start - angle };
                let difference = directions.angle(cell).unwrap() - expected.rem_euclid(TAU);
                assert!(difference.abs() < 1e-9 || (difference.abs() - TAU).abs() < 1e-9);
                compared += 1;
            }
        }
        assert!(compared > 10_000, "only {compared} cells");
    }

    #[test]
    fn all_water_of_a_filled_terrain_leaves_it() {
        for (grid, heights) in terrains() {
            let filled = fill_depressions(&grid, &heights).unwrap();
            let directions = DInfinity::over_filled(&grid, &filled).unwrap();
            let areas = directions.contributing_area();
            let outlets = (0..areas.len()).filter(|&cell| directions.single.leaves(cell));
            let stays = |&cell: &usize| directions.receivers(cell)[0].1 == 0.0;
            let left: f64 = outlets.filter(stays).map(|cell| areas[cell]).sum();
            let data = heights.iter().filter(|height| !height.is_nan()).count() as f64;
            assert!((left - data * grid.cell_area()).abs() <= 1e-9 * left, "{grid:?}");
        }
    }

    /// On a plane that falls to the angle a, all inner cells flow there.
    #[test]
    fn planes_of_any_angle_are_followed() {
        let grid = Grid::new([5, 5], [2.0, 3.0]).unwrap();
        for turn in 0..36 {
            let angle = f64::from(turn) / 36.0 * TAU + 0.01;
            let height = |cell| {
                let [x, y] = grid.position(cell).map(|place| place as f64);
                -(2.0 * x * angle.cos() - 3.0 * y * angle.sin())
            };
            let plane: Vec<f64> = (0..25).map(height).collect();
            let found = DInfinity::over_filled(&grid, &plane).unwrap().angle(12).unwrap();
            assert!((found - angle).abs() < 1e-9, "{found} for {angle}");
        }
    }
}
