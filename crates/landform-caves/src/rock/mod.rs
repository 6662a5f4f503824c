//! Rock: how porous each voxel is.
//!
//! Porosity is the share of a voxel that water may fill, from 0 (impermeable) to 1 (a void). The
//! initial conditions of this module lay planes, fractures, strata and hard regions into a field;
//! noise and constants come from `landform-synth`. They are put together by the `combine` of a
//! scenario: a matrix, `Multiply` by [`HardRegions`], `Max` with [`BeddingPlanes`] and
//! [`Fractures`].
//!
//! Heights are those above the lowest layer. On a plane, which is a section through the rock, rows lie
//! one above the other from south to north.

mod bedding;
mod channel_lines;
mod fractures;
mod hard_regions;
mod strata;
#[cfg(test)]
mod tests;

pub use bedding::BeddingPlanes;
pub use channel_lines::ChannelLines;
pub use fractures::{FractureSet, Fractures};
pub use hard_regions::{HardRegion, HardRegions};
pub use strata::{Strata, Stratum};

use glam::DVec3;
use landform_graph::Lattice;
use landform_sim::initial::InitialContext;
use landform_sim::parameters::Problem;

use crate::CaveError;
use crate::place::in_section;

/// Position of a voxel in metres, heights up, from the foot of the domain's middle.
fn from_foot(lattice: &Lattice, node: usize) -> DVec3 {
    let last = lattice.size().map(|size| (size - 1) as f64 * lattice.spacing());
    let mut middle = in_section(lattice, DVec3::from_array(last)) * 0.5;
    middle.z = 0.0;
    in_section(lattice, lattice.position(node)) - middle
}

/// Unit vector across a plane that goes down at `dip_deg` from level towards `towards_deg`, an angle on
/// the map counter-clockwise from east.
fn across(dip_deg: f64, towards_deg: f64) -> DVec3 {
    let (dip, towards) = (dip_deg.to_radians(), towards_deg.to_radians());
    DVec3::new(dip.sin() * towards.cos(), dip.sin() * towards.sin(), dip.cos())
}

/// Half of the thickness in metres that a plane takes among voxels: at least what joins them over
/// faces, edges and corners.
fn half_thickness(lattice: &Lattice, across: DVec3, thickness_m: f64) -> f64 {
    let section = !lattice.connectivity().is_volume();
    let across = if section { DVec3::new(across.x, 0.0, across.z) } else { across };
    let steepest = across.abs().max_element();
    (0.5 * thickness_m).max(0.5 * steepest * lattice.spacing())
}

/// The field that `fill` gives as values of an initial condition.
fn values_of(
    context: &InitialContext<'_>,
    fill: impl FnOnce(&Lattice, u64) -> Result<Vec<f64>, CaveError>,
) -> Result<Vec<f64>, Problem> {
    fill(&context.domain.lattice, context.seed)
        .map_err(|error| Problem::new("", error.to_string(), ""))
}
