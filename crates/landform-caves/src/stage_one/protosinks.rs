//! Protosinks: voxels on the boundary of a zone to which protochannels grow.

use glam::DVec3;
use landform_graph::Lattice;
use landform_sim::random::RandomStream;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::zones::Zones;
use crate::place::displacement;

/// The direction in which protochannels grow.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Preference {
    /// Direction on the map, counter-clockwise from east.
    #[schemars(range(min = -360.0, max = 360.0), extend("x-unit" = "deg"))]
    pub azimuth_deg: f64,
    /// Angle above the level, less than 0 for down.
    #[schemars(range(min = -90.0, max = 90.0), extend("x-unit" = "deg"))]
    #[serde(default)]
    pub rise_deg: f64,
    /// Half of the angle of the cone in which protosinks lie.
    #[schemars(range(min = 1.0, max = 180.0), extend("x-unit" = "deg"))]
    pub spread_deg: f64,
}

impl Preference {
    /// Whether a way leads in that direction.
    fn holds(&self, way: DVec3) -> bool {
        let (azimuth, rise) = (self.azimuth_deg.to_radians(), self.rise_deg.to_radians());
        let axis = DVec3::new(rise.cos() * azimuth.cos(), rise.cos() * azimuth.sin(), rise.sin());
        way.dot(axis) >= way.length() * self.spread_deg.to_radians().cos()
    }
}

/// Up to `count` voxels on the boundary of the zone of `source`, chosen at random, in node order.
///
/// The boundary is where the zone meets another, where it ends at `reach_m` of weighted distance, and
/// the border of the domain. `near` is a voxel of the source, from which `preference` looks; without
/// one, protosinks lie on all sides. `open` tells which voxels water may enter.
pub fn protosinks(
    lattice: &Lattice,
    zones: &Zones,
    (source, near): (u32, usize),
    (count, reach_m): (usize, f64),
    preference: Option<&Preference>,
    open: impl Fn(usize) -> bool,
    random: &RandomStream,
) -> Vec<usize> {
    let inside = |node: usize| zones.owner[node] == source && zones.distance[node] <= reach_m;
    let at_end = |node: usize| {
        at_border(lattice, node)
            || lattice.neighbours(node).any(|edge| open(edge.node) && !inside(edge.node))
    };
    let wanted = |&node: &usize| {
        let at_source = zones.distance[node] == 0.0;
        let chosen = preference.is_none_or(|cone| cone.holds(displacement(lattice, near, node)));
        inside(node) && open(node) && !at_source && chosen && at_end(node)
    };
    let mut candidates: Vec<(u32, usize)> = (0..lattice.node_count())
        .filter(wanted)
        .map(|node| (random.block(u64::from(source), node, 0)[0], node))
        .collect();
    candidates.sort_unstable();
    candidates.truncate(count);
    let mut chosen: Vec<usize> = candidates.into_iter().map(|(_, node)| node).collect();
    chosen.sort_unstable();
    chosen
}

/// Whether a voxel lies where the domain ends.
fn at_border(lattice: &Lattice, node: usize) -> bool {
    let at = lattice.coordinates(node);
    (0..3).any(|axis| {
        let size = lattice.size()[axis];
        // Planes have no border above and below.
        size > 1 && !lattice.is_periodic(axis) && (at[axis] == 0 || at[axis] + 1 == size)
    })
}

#[cfg(test)]
mod tests {
    use super::super::{Seed, pressure_zones};
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    #[test]
    fn protosinks_lie_on_the_boundary_and_where_they_are_wanted() {
        let open = [Boundary::Open; 3];
        let lattice = Lattice::volume([21, 21, 21], 1.0, Connectivity::Voxel26, open).unwrap();
        let middle = lattice.node([10, 10, 10]);
        let seed = Seed { node: middle, source: 0, pressure: 1.0 };
        let zones = pressure_zones(&lattice, |_| true, &[seed]).unwrap();
        let random = RandomStream::new(5, "protosinks");
        let choose = |count, reach, cone: Option<&Preference>| {
            protosinks(&lattice, &zones, (0, middle), (count, reach), cone, |_| true, &random)
        };
        let ball = choose(40, 7.0, None);
        assert_eq!(ball.len(), 40);
        assert!(ball.iter().all(|&node| (5.0..=7.0).contains(&zones.distance[node])));
        let up = Preference { azimuth_deg: 0.0, rise_deg: 90.0, spread_deg: 30.0 };
        let cluster = choose(30, 7.0, Some(&up));
        assert!(!cluster.is_empty());
        for node in cluster {
            let way = displacement(&lattice, middle, node);
            assert!(way.z / way.length() >= 30_f64.to_radians().cos());
        }
        let faces = choose(usize::MAX, f64::INFINITY, None);
        assert_eq!(faces.len(), 21 * 21 * 21 - 19 * 19 * 19);
        assert_eq!(choose(40, 7.0, None), ball);
    }
}
