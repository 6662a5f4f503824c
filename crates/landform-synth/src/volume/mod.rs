//! Implicit volumes: solids in space put together in a tree.

mod build;
mod change;
mod combine;
mod roughness;
mod shapes;
mod solid;
#[cfg(test)]
mod tests;

use std::path::Path;

use landform_graph::Lattice;
use landform_sim::initial::{InitialCondition, InitialContext};
use landform_sim::parameters::Problem;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use change::{Instance, Instances, Noised};
pub use combine::{Blended, Cut};
pub use roughness::Roughness;
pub use shapes::{Ball, Block, Tube};

use crate::error::Checks;
use crate::scenario::refusal;
use crate::{Generator, Node, SynthError};
use build::Builder;
use solid::Solid;

/// Name of the generator in messages.
const NAME: &str = "ImplicitVolume";

/// A node of an implicit volume: a solid, or what is made of others. Each gives a function f of the
/// place, negative inside and positive outside, and a bound L of its slope.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum VolumeNode {
    /// A ball, smooth or rough.
    Ball(Ball),
    /// A tube along a line.
    Tube(Tube),
    /// A box.
    Block(Block),
    /// The ground below a terrain: a node of a construction tree. L is `sqrt(1 + L_h^2)`.
    Ground(Node),
    /// All of several solids.
    Union(Blended),
    /// What several solids have in common.
    Intersection(Blended),
    /// One without another.
    Difference(Cut),
    /// One at several places.
    Instances(Instances),
    /// One on space that is bent by noise.
    Warp(Noised),
    /// One with a surface made rough by noise.
    Rough(Noised),
}

/// One value inside a solid and another outside, with a solid put together in a tree (Wyvill et al.
/// 1999, "The blob tree"; Paris et al. 2019, "Terrain amplification with implicit 3D features"):
/// caves of porosity 1 in rock of porosity 0.1, say.
///
/// Every node of the tree gives a function f of the place, metres east, north and up from the
/// lowest south-western voxel: negative inside, 0 at the surface, positive outside; and a bound L
/// of its slope, a Lipschitz constant, so that no surface is nearer than `|f| / L`. A voxel with f
/// at its middle has the share `1/2 - f / edge` of the value inside, from 0 to 1.
///
/// # Limits
/// Open axes. Trees of 50 levels and 10 000 nodes, points of tubes and instances. Cost: voxels
/// times parts of the tree. Where f is steeper or flatter than 1 the change from one value to the
/// other is narrower or wider than `edge_m`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ImplicitVolume {
    /// The root.
    pub of: VolumeNode,
    /// Value inside.
    #[schemars(range(min = -1e12, max = 1e12))]
    pub inside: f64,
    /// Value outside.
    #[schemars(range(min = -1e12, max = 1e12))]
    pub outside: f64,
    /// Width of the change from one to the other; 0 for none, the spacing when missing.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m"))]
    pub edge_m: Option<f64>,
}

impl Default for ImplicitVolume {
    fn default() -> Self {
        Self { of: VolumeNode::Ball(Ball::default()), inside: 1.0, outside: 0.0, edge_m: None }
    }
}

impl ImplicitVolume {
    /// The solid with the random numbers of `seed`, for voxels `spacing_m` apart. Files are
    /// relative to `folder`.
    ///
    /// # Errors
    /// [`SynthError`] if a parameter is out of its range or the tree is too large. The message
    /// names the node.
    pub fn volume(&self, folder: &Path, spacing_m: f64, seed: u64) -> Result<Volume, SynthError> {
        let checks = Checks(NAME);
        checks.length("spacing_m", spacing_m, f64::MIN_POSITIVE)?;
        checks.elevation("inside", self.inside)?;
        checks.elevation("outside", self.outside)?;
        checks.range("edge_m", self.edge_m.unwrap_or(0.0), 0.0..=1e9)?;
        let mut builder = Builder { folder, spacing: spacing_m, seed, parts: 0 };
        Ok(Volume { root: builder.build(&self.of, "of", 1)? })
    }

    fn values_from(
        &self,
        folder: &Path,
        lattice: &Lattice,
        seed: u64,
    ) -> Result<Vec<f64>, SynthError> {
        for (axis, name) in ['x', 'y', 'z'].into_iter().enumerate() {
            if lattice.is_periodic(axis) {
                let remedy = "make the axis open";
                return Err(SynthError::DoesNotClose { generator: NAME, axis: name, remedy });
            }
        }
        let volume = self.volume(folder, lattice.spacing(), seed)?;
        let edge = self.edge_m.unwrap_or(lattice.spacing());
        let value = |node: usize| {
            let [x, y, z] = lattice.position(node).to_array();
            let value = volume.value([x, y, z]);
            let share = match edge > 0.0 {
                true => (0.5 - value / edge).clamp(0.0, 1.0),
                false => f64::from(u8::from(value <= 0.0)),
            };
            self.outside + share * (self.inside - self.outside)
        };
        Ok((0..lattice.node_count()).into_par_iter().map(value).collect())
    }
}

impl Generator for ImplicitVolume {
    fn generate(&self, lattice: &Lattice, seed: u64) -> Result<Vec<f64>, SynthError> {
        self.values_from(Path::new(""), lattice, seed)
    }
}

impl InitialCondition for ImplicitVolume {
    const NAME: &'static str = NAME;

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        self.values_from(context.folder, &context.domain.lattice, context.seed).map_err(refusal)
    }
}

/// An implicit volume made ready.
///
/// ```
/// use std::path::Path;
/// use landform_synth::{Ball, ImplicitVolume, VolumeNode};
///
/// let ball = Ball { center_m: [5.0, 5.0, 5.0], radius_m: 3.0, rough: None };
/// let tree = ImplicitVolume { of: VolumeNode::Ball(ball), ..Default::default() };
/// let volume = tree.volume(Path::new(""), 1.0, 7)?;
/// assert_eq!(volume.value([5.0, 5.0, 9.0]), 1.0);
/// assert_eq!(volume.slope(), 1.0);
/// # Ok::<(), landform_synth::SynthError>(())
/// ```
#[derive(Debug)]
pub struct Volume {
    root: Box<dyn Solid>,
}

impl Volume {
    /// The function at a place in metres east, north and up: negative inside, 0 at the surface,
    /// positive outside.
    pub fn value(&self, place: [f64; 3]) -> f64 {
        self.root.value(place)
    }

    /// Largest change of the function a metre, its Lipschitz constant. Infinite over a terrain that
    /// has none.
    pub fn slope(&self) -> f64 {
        self.root.slope()
    }
}
