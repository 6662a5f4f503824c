//! Sizes of passages at stations, as surveyors note them.

use serde::Serialize;

use super::CaveNetwork;
use crate::voxels::VoxelSet;

/// Distances from a station to the walls, in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct PassageSize {
    /// To the left of the passage.
    pub left_m: f64,
    /// To its right.
    pub right_m: f64,
    /// To the ceiling.
    pub up_m: f64,
    /// To the floor.
    pub down_m: f64,
}

impl CaveNetwork {
    /// Sizes of the passages of a set of voxels at the stations of its network; positions count from
    /// the set's south-western corner, as those of [`CaveNetwork::of_centreline`].
    ///
    /// Left and right are across the mean direction of the legs on the map, in which the stations are
    /// counted; of vertical shafts they are west and east.
    pub fn passage_sizes(&self, set: &VoxelSet, spacing_m: f64) -> Vec<PassageSize> {
        let size = |station: usize| {
            let [east, north] = self.direction(station);
            let reach = |way: [f64; 3]| reach(set, self.stations()[station], way, spacing_m);
            PassageSize {
                left_m: reach([-north, east, 0.0]),
                right_m: reach([north, -east, 0.0]),
                up_m: reach([0.0, 0.0, 1.0]),
                down_m: reach([0.0, 0.0, -1.0]),
            }
        };
        (0..self.stations().len()).map(size).collect()
    }

    /// Unit vector of the mean direction of a station's legs on the map, towards later stations.
    fn direction(&self, station: usize) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for &other in self.neighbours(station) {
            let sign = if other > station { 1.0 } else { -1.0 };
            for (axis, sum) in sum.iter_mut().enumerate() {
                *sum += sign * (self.stations()[other][axis] - self.stations()[station][axis]);
            }
        }
        let length = sum[0].hypot(sum[1]);
        if length > 1e-9 { sum.map(|part| part / length) } else { [0.0, 1.0] }
    }
}

/// How wide a passage is around a point within it, in metres: the larger extent of its cross-section.
///
/// That is the longest way from wall to wall across the direction in which that is shortest, of 13
/// directions along axes and diagonals. Where passages cross it is the width of them, not their length.
pub(super) fn passage_width(set: &VoxelSet, at: [f64; 3], spacing_m: f64) -> f64 {
    let directions: Vec<[f64; 3]> = (14..27)
        .map(|place| [place % 3 - 1, place / 3 % 3 - 1, place / 9 - 1].map(f64::from))
        .collect();
    let extent = |way: &[f64; 3]| {
        let length = dot(*way, *way).sqrt();
        let unit = way.map(|part| part / length);
        reach(set, at, unit, spacing_m) + reach(set, at, unit.map(|part| -part), spacing_m)
    };
    let extents: Vec<f64> = directions.iter().map(extent).collect();
    let across = |along: &[f64; 3]| {
        let crossing = directions.iter().zip(&extents).filter(|(way, _)| dot(*along, **way) == 0.0);
        crossing.fold(0.0, |most: f64, (_, &extent)| most.max(extent))
    };
    directions.iter().map(across).fold(f64::INFINITY, f64::min)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// How far a straight way from a point stays in a set, in metres: from side to side of its voxels.
fn reach(set: &VoxelSet, from: [f64; 3], way: [f64; 3], spacing_m: f64) -> f64 {
    /// A little beyond a side, in voxels.
    const BEYOND: f64 = 1e-9;
    let rows = set.size()[1] as isize;
    let start = from.map(|at| at / spacing_m);
    let mut far = 0.0;
    loop {
        let inside = [0, 1, 2].map(|axis| start[axis] + way[axis] * (far + BEYOND));
        let [x, y, z] = inside.map(|at| at.floor() as isize);
        if !set.holds([x, rows - 1 - y, z]) {
            return far * spacing_m;
        }
        let to_side = |axis: usize| match way[axis] {
            along if along > 0.0 => (inside[axis].floor() + 1.0 - start[axis]) / along,
            along if along < 0.0 => (inside[axis].ceil() - 1.0 - start[axis]) / along,
            _ => f64::INFINITY,
        };
        far = (0..3).map(to_side).fold(f64::INFINITY, f64::min).max(far + BEYOND);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::voxels::{Rule, Turns, centreline};

    #[test]
    fn a_gallery_has_its_walls_where_they_are() {
        // Northwards, 3 voxels wide from column 2, 5 high from layer 1, of half a metre.
        let set = VoxelSet::new([8, 30, 8], |[x, _, z]| (2..5).contains(&x) && (1..6).contains(&z));
        let line = centreline(&set, Turns::Sides, Rule::Supported);
        let network = CaveNetwork::of_centreline(&line, 0.5).unwrap();
        let sizes = network.passage_sizes(&set, 0.5);
        let middle = sizes[sizes.len() / 2];
        assert!((middle.left_m + middle.right_m - 1.5).abs() < 1e-6);
        assert!((middle.up_m + middle.down_m - 2.5).abs() < 1e-6);
        assert!((middle.left_m - middle.right_m).abs() < 0.51);
    }

    #[test]
    fn widths_are_those_of_cross_sections() {
        let width = |set: &VoxelSet| passage_width(set, [10.25, 10.25, 2.25], 0.5);
        // A low wide gallery northwards, a shaft, and two galleries that cross.
        let low =
            VoxelSet::new([41, 41, 9], |[x, _, z]| (16..25).contains(&x) && (3..6).contains(&z));
        assert!((width(&low) - 4.5).abs() < 1e-6, "{}", width(&low));
        let shaft =
            VoxelSet::new([41, 41, 9], |[x, y, _]| (19..22).contains(&x) && (19..22).contains(&y));
        let diagonal = 1.5 * std::f64::consts::SQRT_2;
        assert!((width(&shaft) - diagonal).abs() < 1e-6, "{}", width(&shaft));
        let cross = VoxelSet::new([41, 41, 9], |[x, y, z]| {
            ((19..22).contains(&x) || (19..22).contains(&y)) && (3..6).contains(&z)
        });
        assert!((width(&cross) - diagonal).abs() < 1e-6, "{}", width(&cross));
    }
}
