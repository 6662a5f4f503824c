//! Morphometric indices of caves (thesis, sections 2.4.3 and 5.4.2; Klimchouk 2006; Frumkin and
//! Fischhendler 2005).

use serde::Serialize;

use super::of_voxels::cave_line;
use super::{CaveNetwork, CaveNetworkError};
use crate::voxels::{VoxelSet, plan_sheet};

/// The part of the map that a cave is said to take up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CaveField {
    /// The rectangle around it, sides along the axes.
    Rectangle,
    /// Cells of the rectangle within so many metres of a passage in plan.
    Near(f64),
}

/// What indices are computed of.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CaveTotals {
    /// Length of the centreline, m.
    pub length_m: f64,
    /// Area of the sheet through the middle of the passages, m².
    pub area_m2: f64,
    /// Area of the passages on the map, m².
    pub plan_area_m2: f64,
    /// Volume, m³.
    pub volume_m3: f64,
    /// Area of the cave field, m².
    pub field_m2: f64,
    /// Vertical extent, m.
    pub height_m: f64,
}

/// Indices of a cave.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CaveIndices {
    /// What they are computed of.
    pub totals: CaveTotals,
    /// Length over the area of the field, m/m².
    pub network_density: f64,
    /// Area on the map over that of the field, %.
    pub areal_coverage_percent: f64,
    /// Volume over that of the block of the field, %.
    pub porosity_percent: f64,
    /// Length over mean width: L² / A.
    pub length_to_width: f64,
    /// Mean width: A / L, m.
    pub width_m: f64,
}

impl CaveIndices {
    /// Measures a cave of voxels, `spacing_m` metres a side.
    ///
    /// Length is that of the [centreline](crate::voxels::centreline), voxels with many open sides thinned
    /// away first, with the lines to bumps of the walls that are left; area that of the
    /// [sheet](plan_sheet), each of whose voxels stands for as much as the slope of the sheet there
    /// makes it larger than on the map. Coverage is by the area on the map: the areas of table 5.3 of
    /// the thesis only agree with each other in this way.
    ///
    /// # Errors
    /// [`CaveNetworkError::Empty`] of a set without passages.
    pub fn of(cave: &VoxelSet, spacing_m: f64, field: CaveField) -> Result<Self, CaveNetworkError> {
        let network = CaveNetwork::of_centreline(&cave_line(cave), spacing_m)?;
        let square = spacing_m * spacing_m;
        let plan = Plan::of(cave);
        let lowest = cave.iter().map(|[_, _, layer]| layer).min().unwrap_or(0);
        let highest = cave.iter().map(|[_, _, layer]| layer).max().unwrap_or(0);
        Ok(Self::of_totals(CaveTotals {
            length_m: network.length_m(),
            area_m2: sheet_area(&plan_sheet(cave)) * square,
            plan_area_m2: plan.passages() as f64 * square,
            volume_m3: cave.len() as f64 * square * spacing_m,
            field_m2: plan.cells(field, spacing_m) as f64 * square,
            height_m: (highest - lowest + 1) as f64 * spacing_m,
        }))
    }

    /// The indices of the same `cave` for another field.
    #[must_use]
    pub fn within(&self, field: CaveField, cave: &VoxelSet, spacing_m: f64) -> Self {
        let cells = Plan::of(cave).cells(field, spacing_m);
        Self::of_totals(CaveTotals {
            field_m2: cells as f64 * spacing_m * spacing_m,
            ..self.totals
        })
    }

    /// The indices of what was measured of a cave, by survey or otherwise.
    pub fn of_totals(totals: CaveTotals) -> Self {
        let CaveTotals { length_m, area_m2, plan_area_m2, volume_m3, field_m2, height_m } = totals;
        Self {
            totals,
            network_density: length_m / field_m2,
            areal_coverage_percent: 100.0 * plan_area_m2 / field_m2,
            porosity_percent: 100.0 * volume_m3 / (field_m2 * height_m),
            length_to_width: length_m * length_m / area_m2,
            width_m: area_m2 / length_m,
        }
    }
}

/// The cave seen from above.
struct Plan {
    width: usize,
    filled: Vec<bool>,
    /// First and last column, first and last row of the cave.
    bounds: [[usize; 2]; 2],
}

impl Plan {
    fn of(cave: &VoxelSet) -> Self {
        let [width, height, _] = cave.size();
        let mut filled = vec![false; width * height];
        let mut bounds = [[width, 0], [height, 0]];
        for [column, row, _] in cave.iter() {
            filled[column + width * row] = true;
            for (bound, at) in bounds.iter_mut().zip([column, row]) {
                *bound = [bound[0].min(at), bound[1].max(at)];
            }
        }
        Self { width, filled, bounds }
    }

    fn passages(&self) -> usize {
        self.filled.iter().filter(|&&filled| filled).count()
    }

    /// Cells of a field.
    fn cells(&self, field: CaveField, spacing_m: f64) -> usize {
        match field {
            CaveField::Rectangle => self.rectangle(),
            CaveField::Near(radius_m) => self.near(radius_m / spacing_m),
        }
    }

    fn rectangle(&self) -> usize {
        self.bounds.iter().map(|[first, last]| last - first + 1).product()
    }

    /// Cells of the rectangle whose middle lies within `radius` cells of that of a passage.
    fn near(&self, radius: f64) -> usize {
        let [[west, east], [north, south]] = self.bounds;
        let reach = (radius.clamp(0.0, 1e9) as usize).min(self.filled.len());
        // Half the width of the disc in rows at each distance.
        let half: Vec<isize> = (0..=reach)
            .map(|off| (radius * radius - (off * off) as f64).max(0.0).sqrt() as isize)
            .collect();
        let mut count = 0;
        for row in north..=south {
            // Differences of how many discs cover each cell of this row.
            let mut change = vec![0_i64; east - west + 2];
            for other in row.saturating_sub(reach).max(north)..=(row + reach).min(south) {
                let half = half[other.abs_diff(row)];
                for column in west..=east {
                    if self.filled[column + self.width * other] {
                        let at = (column - west) as isize;
                        change[(at - half).max(0) as usize] += 1;
                        let end = (at + half + 1).min((east - west + 1) as isize);
                        change[end as usize] -= 1;
                    }
                }
            }
            let mut covers = 0;
            for change in &change[..east - west + 1] {
                covers += change;
                count += usize::from(covers > 0);
            }
        }
        count
    }
}

/// Area of a sheet in squares of a voxel's side: over each voxel, that of the plane through it and
/// its neighbours.
fn sheet_area(sheet: &VoxelSet) -> f64 {
    let around = || (0..27).map(|place| [place % 3 - 1, place / 3 % 3 - 1, place / 9 - 1]);
    let area = |voxel: [usize; 3]| {
        let near = around().filter(|step: &[isize; 3]| {
            sheet.holds([0, 1, 2].map(|axis| voxel[axis] as isize + step[axis]))
        });
        let near: Vec<[f64; 3]> = near.map(|step| step.map(|at| at as f64)).collect();
        let [slope_x, slope_y] = slopes(&near);
        (1.0 + slope_x * slope_x + slope_y * slope_y).sqrt()
    };
    sheet.iter().map(area).sum()
}

/// Slopes of the plane z = p x + q y + r that fits points best, the smallest if several do.
fn slopes(points: &[[f64; 3]]) -> [f64; 2] {
    let count = points.len() as f64;
    let mean = [0, 1, 2].map(|axis| points.iter().map(|point| point[axis]).sum::<f64>() / count);
    let product = |a: usize, b: usize| {
        let terms = points.iter().map(|point| (point[a] - mean[a]) * (point[b] - mean[b]));
        terms.sum::<f64>()
    };
    let [xx, xy, yy] = [product(0, 0), product(0, 1), product(1, 1)];
    let [xz, yz] = [product(0, 2), product(1, 2)];
    let determinant = xx * yy - xy * xy;
    if determinant > 1e-9 {
        return [(xz * yy - yz * xy) / determinant, (yz * xx - xz * xy) / determinant];
    }
    // All on one line of the map: the slope along it.
    let spread = xx + yy;
    if spread > 1e-9 { [xz / spread, yz / spread] } else { [0.0; 2] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_gallery_has_the_indices_of_a_straight_gallery() {
        // The line ends about half a width before the walls. 30 m long, 3 m wide and high, in voxels of half a metre.
        let cave = VoxelSet::new([70, 40, 12], |[x, y, z]| {
            (5..65).contains(&x) && (10..16).contains(&y) && (2..8).contains(&z)
        });
        let found = CaveIndices::of(&cave, 0.5, CaveField::Rectangle).unwrap();
        assert_eq!(
            (found.totals.volume_m3, found.totals.field_m2, found.totals.height_m),
            (270.0, 90.0, 3.0)
        );
        assert_eq!((found.totals.area_m2, found.totals.plan_area_m2), (90.0, 90.0));
        assert!((26.0..=30.0).contains(&found.totals.length_m), "{}", found.totals.length_m);
        assert_eq!(found.width_m, 90.0 / found.totals.length_m);
        assert_eq!((found.areal_coverage_percent, found.porosity_percent), (100.0, 100.0));
    }

    #[test]
    fn a_slanting_sheet_is_larger_than_on_the_map() {
        let cave = VoxelSet::new([40, 30, 40], |[x, _, z]| x == z);
        let found = CaveIndices::of(&cave, 1.0, CaveField::Rectangle).unwrap();
        let ratio = found.totals.area_m2 / found.totals.plan_area_m2;
        assert!((ratio - 2.0_f64.sqrt()).abs() < 1e-9, "{ratio}");
    }

    #[test]
    fn fields_near_passages_are_discs_around_them() {
        let mut cave = VoxelSet::empty([41, 41, 1]);
        for at in 0..41 {
            cave.insert([at, 0, 0]);
            cave.insert([0, at, 0]);
        }
        let field =
            |radius| CaveIndices::of(&cave, 1.0, CaveField::Near(radius)).unwrap().totals.field_m2;
        assert_eq!(field(0.0), 81.0);
        assert_eq!(field(3.0), 81.0 + 3.0 * 40.0 * 2.0 - 9.0);
        assert_eq!(field(1e6), 1681.0);
    }

    /// The one row of numbers that is given in full: Zoloushka (Klimchouk 2007).
    #[test]
    fn formulas_are_those_of_klimchouk() {
        let (field_m2, block_m3) = (0.63e6, 18.93e6);
        let found = CaveIndices::of_totals(CaveTotals {
            length_m: 89.5e3,
            area_m2: 0.305e6,
            plan_area_m2: 0.305e6,
            volume_m3: 0.712e6,
            field_m2,
            height_m: block_m3 / field_m2,
        });
        assert!((found.network_density - 0.14206).abs() < 1e-5);
        assert!((found.porosity_percent - 3.76).abs() < 0.005);
        assert!((found.areal_coverage_percent - 48.41).abs() < 0.005);
        assert!((found.width_m - 3.41).abs() < 0.005);
        assert!((found.length_to_width - 89.5e3 * 89.5e3 / 0.305e6).abs() < 1e-6);
    }
}
