//! Places in the rock: where water comes in and goes out, and how far voxels lie from each other.

use glam::DVec3;
use landform_graph::Lattice;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::CaveError;

/// A box of voxels where water comes in.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CaveSource {
    /// Its middle: share of the way from west to east, from south to north, from the lowest layer to
    /// the highest. Planes have one layer; give 0 as the third.
    pub center: [f64; 3],
    /// Size along the three axes; the voxel nearest to the middle belongs to it in any case.
    #[schemars(extend("x-unit" = "m"))]
    #[serde(default)]
    pub size_m: [f64; 3],
    /// Pressure of the source among others: it claims rock in proportion before channels break
    /// through.
    #[schemars(range(min = 1e-3, max = 1e3), extend("x-source" = "thesis, listing 5.1"))]
    #[serde(default = "one")]
    pub pressure: f64,
    /// Water that an iteration brings to each of its voxels, as a share of the volume of a voxel; no
    /// more than fits in comes in.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "chosen: the thesis has weak sources and others"))]
    #[serde(default = "one")]
    pub strength: f64,
}

fn one() -> f64 {
    1.0
}

/// A box of voxels where water leaves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CaveSink {
    /// Its middle: share of the way from west to east, from south to north, from the lowest layer to
    /// the highest. Planes have one layer; give 0 as the third.
    pub center: [f64; 3],
    /// Size along the three axes; the voxel nearest to the middle belongs to it in any case.
    #[schemars(extend("x-unit" = "m"))]
    #[serde(default)]
    pub size_m: [f64; 3],
}

/// The voxels of a box, in order: those whose centres lie in it, and the nearest to its middle.
///
/// `center` gives shares of the way from west to east, south to north and the lowest layer to the
/// highest; the box is cut off where the lattice ends.
///
/// # Errors
/// [`CaveError::Outside`] if the middle is not in the lattice, [`CaveError::OutOfRange`] for a size
/// that is no length.
pub fn box_nodes(
    lattice: &Lattice,
    center: [f64; 3],
    size_m: [f64; 3],
) -> Result<Vec<usize>, CaveError> {
    if !center.iter().all(|share| (0.0..=1.0).contains(share)) {
        return Err(CaveError::Outside { center });
    }
    for length in size_m {
        crate::error::check_range("size_m", length, [0.0, 1e9])?;
    }
    let span = |axis: usize| {
        let last = lattice.size()[axis] - 1;
        // Rows run south.
        let share = if axis == 1 { 1.0 - center[1] } else { center[axis] };
        let middle = share * last as f64;
        let half = 0.5 * size_m[axis] / lattice.spacing();
        let nearest = (middle.round() as usize).min(last);
        let first = ((middle - half).ceil().max(0.0) as usize).min(nearest);
        first..=((middle + half).floor().min(last as f64) as usize).max(nearest)
    };
    let layer = |z| span(1).flat_map(move |y| span(0).map(move |x| lattice.node([x, y, z])));
    Ok(span(2).flat_map(layer).collect())
}

/// Distance in metres between two voxels, the short way round on periodic axes.
#[inline]
pub fn separation(lattice: &Lattice, a: usize, b: usize) -> f64 {
    displacement(lattice, a, b).length()
}

/// The way in metres from voxel `a` to voxel `b`, x east, y north and z up, the short way round on
/// periodic axes.
#[inline]
pub fn displacement(lattice: &Lattice, a: usize, b: usize) -> DVec3 {
    between(lattice, lattice.coordinates(a), lattice.coordinates(b))
}

/// [`displacement`] between voxels of these coordinates.
#[inline]
pub(crate) fn between(lattice: &Lattice, from: [usize; 3], to: [usize; 3]) -> DVec3 {
    let along = |axis: usize| {
        let steps = to[axis] as f64 - from[axis] as f64;
        let size = lattice.size()[axis] as f64;
        match lattice.is_periodic(axis) && 2.0 * steps.abs() > size {
            true => steps - size.copysign(steps),
            false => steps,
        }
    };
    DVec3::new(along(0), -along(1), along(2)) * lattice.spacing()
}

/// Height of a voxel in metres. A plane is a section through the rock, its rows one above the other
/// from south to north.
#[inline]
pub fn height(lattice: &Lattice, node: usize) -> f64 {
    in_section(lattice, lattice.position(node)).z
}

/// A position in the rock: on planes, which are sections, north is up.
#[inline]
pub(crate) fn in_section(lattice: &Lattice, at: DVec3) -> DVec3 {
    match lattice.connectivity().is_volume() {
        true => at,
        false => DVec3::new(at.x, 0.0, at.y),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    #[test]
    fn boxes_hold_the_voxels_whose_centres_they_contain() {
        let open = [Boundary::Open; 3];
        let lattice = Lattice::volume([11, 7, 5], 2.0, Connectivity::Voxel26, open).unwrap();
        let nodes = |center, size| box_nodes(&lattice, center, size).unwrap();
        assert_eq!(nodes([0.5; 3], [0.0; 3]), [lattice.node([5, 3, 2])]);
        // The south is the last row.
        assert_eq!(nodes([0.0, 0.0, 1.0], [0.0; 3]), [lattice.node([0, 6, 4])]);
        let wall = nodes([1.0, 0.5, 0.5], [0.0, 4.0, 1e9]);
        assert_eq!(wall.len(), 3 * 5);
        assert!(wall.iter().all(|&node| lattice.coordinates(node)[0] == 10));
        assert!(box_nodes(&lattice, [0.5, 1.1, 0.5], [0.0; 3]).is_err());
        assert!(box_nodes(&lattice, [0.5; 3], [-1.0, 0.0, 0.0]).is_err());
    }

    #[test]
    fn the_short_way_may_lead_over_a_periodic_border() {
        let boundary = [Boundary::Periodic, Boundary::Open, Boundary::Open];
        let lattice = Lattice::volume([10, 10, 10], 1.0, Connectivity::Voxel26, boundary).unwrap();
        let way = displacement(&lattice, lattice.node([9, 9, 0]), lattice.node([1, 0, 3]));
        assert_eq!(way, DVec3::new(2.0, 9.0, 3.0));
        assert_eq!(height(&lattice, lattice.node([0, 0, 4])), 4.0);
    }
}
