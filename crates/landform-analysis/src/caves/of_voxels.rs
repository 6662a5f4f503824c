//! The network of a thinned set of voxels.

use super::{CaveNetwork, CaveNetworkError};
use crate::voxels::{Rule, Turns, VoxelSet, centreline};

/// The line through the middle of the passages of a cave, from which its length and its network come.
///
/// Voxels with many open sides go first (thesis, figure A.4 c): side by side in turn, as listing A.5
/// has it, thinning leaves a line to nearly every bump of a rough wall.
pub(super) fn cave_line(cave: &VoxelSet) -> VoxelSet {
    centreline(cave, Turns::ExposedSides, Rule::Supported)
}

impl CaveNetwork {
    /// The network of a centreline of voxels: a station in the middle of each, and a leg between
    /// neighbours unless a third voxel stands between them, so that corners make no loops.
    ///
    /// x and y count from the south-western corner of the block, z from below, in metres. Where lines
    /// meet, several voxels may be junctions: [`CaveNetwork::of_passages`] makes one of them.
    ///
    /// # Errors
    /// [`CaveNetworkError::Empty`] of fewer than two voxels that touch.
    pub fn of_centreline(thin: &VoxelSet, spacing_m: f64) -> Result<Self, CaveNetworkError> {
        let voxels: Vec<[usize; 3]> = thin.iter().collect();
        let height = thin.size()[1];
        let position = |[column, row, layer]: [usize; 3]| {
            [column as f64 + 0.5, (height - row) as f64 - 0.5, layer as f64 + 0.5]
                .map(|at| at * spacing_m)
        };
        let stations: Vec<[f64; 3]> = voxels.iter().map(|&voxel| position(voxel)).collect();
        let legs = legs(thin, &voxels);
        Self::new(stations, &legs)
    }
}

/// Pairs of neighbouring voxels that no third one stands between: no voxel that is nearer to both
/// than they are to each other. Of three at like distances one pair goes, the last in order.
fn legs(thin: &VoxelSet, voxels: &[[usize; 3]]) -> Vec<[usize; 2]> {
    let mut legs = Vec::new();
    for (from, &voxel) in voxels.iter().enumerate() {
        for step in steps() {
            let other = [0, 1, 2].map(|axis| voxel[axis] as isize + step[axis]);
            // Later voxels only: each pair once.
            let is_later = [step[2], step[1], step[0]] > [0; 3];
            if !is_later || !thin.holds(other) {
                continue;
            }
            let here = voxel.map(|at| at as isize);
            let far = rank(here, other);
            let stands_between = |between: &[isize; 3]| {
                let third = [0, 1, 2].map(|axis| here[axis] + between[axis]);
                rank(here, third) < far && rank(third, other) < far && thin.holds(third)
            };
            if !steps().any(|between| stands_between(&between)) {
                let other = other.map(|at| at as usize);
                let [_, row, layer] = other;
                let key = [layer, row, other[0]];
                let to = voxels.partition_point(|&[x, y, z]| [z, y, x] < key);
                legs.push([from, to]);
            }
        }
    }
    legs
}

/// The steps to the 26 neighbours of a voxel.
fn steps() -> impl Iterator<Item = [isize; 3]> {
    let all = (0..27).map(|place| [place % 3 - 1, place / 3 % 3 - 1, place / 9 - 1]);
    all.filter(|&step| step != [0; 3])
}

/// Orders pairs of voxels by their distance, then in node order.
fn rank(one: [isize; 3], other: [isize; 3]) -> (isize, [[isize; 3]; 2]) {
    let square = (0..3).map(|axis| (other[axis] - one[axis]).pow(2)).sum();
    let mut ends = [one, other].map(|[x, y, z]| [z, y, x]);
    ends.sort_unstable();
    (square, ends)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::caves::NetworkShape;

    fn set(voxels: &[[usize; 3]]) -> VoxelSet {
        let mut set = VoxelSet::empty([12, 12, 3]);
        voxels.iter().for_each(|&voxel| set.insert(voxel));
        set
    }

    #[test]
    fn corners_make_no_loops_and_junctions_are_one() {
        // A corner of face neighbours; its ends touch diagonally.
        let corner = set(&[[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 2, 0]]);
        let network = CaveNetwork::of_centreline(&corner, 2.0).unwrap();
        assert_eq!((network.cyclomatic_number(), network.length_m()), (0, 6.0));
        assert_eq!(network.stations()[0], [1.0, 23.0, 1.0]);
        // A cross: its middle is a junction of four branches.
        let arm = |k: usize| [[5 + k, 5, 1], [5 - k, 5, 1], [5, 5 + k, 1], [5, 5 - k, 1]];
        let cross = set(&(0..5).flat_map(arm).collect::<Vec<_>>());
        let network = CaveNetwork::of_centreline(&cross, 1.0).unwrap();
        let shape = NetworkShape::of(&network);
        assert_eq!((shape.branches, shape.cyclomatic_number), (4, 0));
        assert_eq!(shape.length_m, 16.0);
    }

    /// Three voxels that touch each other over edges are a junction, not a loop.
    #[test]
    fn three_that_touch_are_a_junction() {
        let voxels = [
            [0, 0, 0],
            [1, 1, 0],
            [2, 2, 0],
            [3, 3, 0],
            [4, 4, 0],
            [5, 3, 0],
            [6, 2, 0],
            [7, 1, 0],
            [8, 0, 0],
            [4, 3, 1],
            [4, 2, 2],
            [4, 1, 2],
            [4, 0, 2],
        ];
        let network = CaveNetwork::of_passages(&set(&voxels), 1.0).unwrap();
        assert_eq!((network.component_count(), network.branches().len()), (1, 3));
        assert_eq!(network.cyclomatic_number(), 0, "{:?}", network.legs());
    }
}
