//! The network of a thinned set of voxels.

use super::{CaveNetwork, CaveNetworkError};
use crate::voxels::VoxelSet;

impl CaveNetwork {
    /// The network of a centreline of voxels: a station in the middle of each, and a leg between
    /// neighbours unless a third voxel stands between them, so that corners make no loops.
    ///
    /// x and y count from the south-western corner of the block, z from below, in metres. Voxels that
    /// touch at a junction are joined to one, in their middle.
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
        let network = Self::new(stations, &legs)?;
        Ok(network.with_junctions_joined(spacing_m))
    }

    /// The network with junctions that are neighbours joined to one in their middle, where they fit
    /// into three voxels each way: what is larger is no crossing of passages.
    fn with_junctions_joined(self, spacing_m: f64) -> Self {
        let is_crossing = |part: &[usize]| {
            (0..3).all(|axis| {
                let along = part.iter().map(|&station| self.stations()[station][axis]);
                let [low, high] =
                    [along.clone().fold(f64::MAX, f64::min), along.fold(f64::MIN, f64::max)];
                high - low < 2.5 * spacing_m
            })
        };
        let is_junction = |station: usize| self.neighbours(station).len() > 2;
        let count = self.stations().len();
        let joined: Vec<Vec<usize>> = (0..count)
            .map(|station| match is_junction(station) {
                true => {
                    let beside = self.neighbours(station).iter().copied();
                    beside.filter(|&other| is_junction(other)).collect()
                }
                false => Vec::new(),
            })
            .collect();
        let mut stations = self.stations().to_vec();
        let mut stands_for: Vec<usize> = (0..count).collect();
        for part in super::paths::components(&joined).iter().filter(|part| is_crossing(part)) {
            let size = part.len() as f64;
            let sum = |axis: usize| part.iter().map(|&at| self.stations()[at][axis]).sum::<f64>();
            stations[part[0]] = [0, 1, 2].map(|axis| sum(axis) / size);
            part.iter().for_each(|&member| stands_for[member] = part[0]);
        }
        let legs: Vec<[usize; 2]> =
            self.legs().iter().map(|leg| leg.map(|end| stands_for[end])).collect();
        // A network that is one junction stays as it is.
        Self::new(stations, &legs).unwrap_or(self)
    }
}

/// Pairs of neighbouring voxels that no third one stands between: no voxel that is nearer to both
/// than they are to each other.
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
            let far = square(step);
            let stands_between = |between: &[isize; 3]| {
                let rest = [0, 1, 2].map(|axis| step[axis] - between[axis]);
                let third = [0, 1, 2].map(|axis| voxel[axis] as isize + between[axis]);
                square(*between) < far && square(rest) < far && thin.holds(third)
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

fn square(step: [isize; 3]) -> isize {
    step.iter().map(|step| step * step).sum()
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
        // A cross: its middle and the four voxels around it are one junction of four branches.
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
            [1, 1, 0],
            [2, 2, 0],
            [3, 3, 0],
            [4, 4, 0],
            [5, 3, 0],
            [4, 3, 1],
            [6, 2, 0],
            [4, 2, 2],
        ];
        let network = CaveNetwork::of_centreline(&set(&voxels), 1.0).unwrap();
        assert_eq!(network.component_count(), 1);
        assert_eq!(network.cyclomatic_number(), 0, "{:?}", network.legs());
    }
}
