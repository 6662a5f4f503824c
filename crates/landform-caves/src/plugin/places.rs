//! Where water comes in and goes out, for pictures.

use bevy_ecs::resource::Resource;
use glam::DVec3;
use landform_graph::Lattice;

use crate::{CaveSink, CaveSource, box_nodes};

/// Where the sources and sinks of the present stage are, in metres from the lower south-western corner
/// of the block, in the order of the scenario: the middle of each, and of one that spans more than a
/// quarter of the block three places along that axis.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct CavePlaces {
    /// Where water comes in.
    pub sources: Vec<[f64; 3]>,
    /// Where it goes out.
    pub sinks: Vec<[f64; 3]>,
}

impl CavePlaces {
    /// The places of sources and sinks; of those that lie in the lattice.
    pub fn of(lattice: &Lattice, sources: &[CaveSource], sinks: &[CaveSink]) -> Self {
        let of = |center, size_m| places(lattice, center, size_m);
        Self {
            sources: sources.iter().flat_map(|source| of(source.center, source.size_m)).collect(),
            sinks: sinks.iter().flat_map(|sink| of(sink.center, sink.size_m)).collect(),
        }
    }
}

/// Places in a box of voxels.
fn places(lattice: &Lattice, center: [f64; 3], size_m: [f64; 3]) -> Vec<[f64; 3]> {
    let Ok(nodes) = box_nodes(lattice, center, size_m) else { return Vec::new() };
    let positions = || nodes.iter().map(|&node| lattice.position(node));
    let low = positions().fold(DVec3::INFINITY, DVec3::min);
    let high = positions().fold(DVec3::NEG_INFINITY, DVec3::max) + DVec3::splat(lattice.spacing());
    let along = |axis: usize| {
        let whole = lattice.size()[axis] as f64 * lattice.spacing();
        let [from, span] = [low[axis], high[axis] - low[axis]];
        let shares: &[f64] = if 4.0 * span > whole && lattice.size()[axis] > 3 {
            &[1.0 / 6.0, 0.5, 5.0 / 6.0]
        } else {
            &[0.5]
        };
        shares.iter().map(move |share| from + share * span)
    };
    let row = |z: f64| along(1).flat_map(move |y| along(0).map(move |x| [x, y, z]));
    along(2).flat_map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    #[test]
    fn places_are_the_middles_of_boxes_and_three_along_wide_ones() {
        let open = [Boundary::Open; 3];
        let lattice = Lattice::volume([11, 7, 5], 2.0, Connectivity::Voxel26, open).unwrap();
        let source = CaveSource {
            center: [0.0, 0.5, 1.0],
            size_m: [0.0, 2.0, 0.0],
            pressure: 1.0,
            strength: 1.0,
        };
        let sink = |size_m| CaveSink { center: [1.0, 0.5, 0.5], size_m };
        let places = CavePlaces::of(&lattice, &[source], &[sink([0.0; 3]), sink([0.0, 9e8, 0.0])]);
        assert_eq!(places.sources, [[1.0, 7.0, 9.0]]);
        let wide = [1.0, 3.0, 5.0].map(|sixth| [21.0, 14.0 * sixth / 6.0, 5.0]);
        assert_eq!(places.sinks[0], [21.0, 7.0, 5.0]);
        assert!(
            places.sinks[1..].iter().zip(wide).all(|(at, place)| (at[1] - place[1]).abs() < 1e-9)
        );
        assert_eq!(places.sinks.len(), 4);
    }
}
