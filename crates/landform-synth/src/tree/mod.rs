//! Construction trees: terrain put together from landforms.

mod blend;
mod bounds;
mod build;
mod curve;
mod disc;
mod mask;
mod node;
mod noise;
mod onto;
mod place;
mod plane;
mod radial_ramp;
mod region;
mod squig;
mod surface;
#[cfg(test)]
mod tests;
mod vertical;
mod warp;
mod weigh;

use std::path::Path;

use landform_graph::Lattice;
use landform_sim::initial::{InitialCondition, InitialContext};
use landform_sim::parameters::Problem;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use bounds::Bounds;
pub use curve::Curve;
pub use disc::Disc;
pub use node::Node;
pub use onto::Onto;
pub use place::Place;
pub use plane::{Bell, Plane};
pub use radial_ramp::RadialRamp;
pub use squig::Squig;
pub use vertical::{Deform, SelectiveScaling, Terraces, VerticalMap};
pub use warp::Warped;
pub use weigh::Weigh;

use crate::error::Checks;
use crate::fractal::Frame;
use crate::place::fill_by_tiles;
use crate::scenario::refusal;
use crate::{Generator, SynthError};
use build::Builder;
use onto::{Meeting, OntoSurface};
use plane::PlaneSurface;
use region::Region;
use surface::Surface;

/// Name of the generator in messages.
const NAME: &str = "ConstructionTree";

/// Terrain put together from landforms in a tree (Génevaux et al. 2015, "Terrain modelling from
/// feature primitives"; Guérin et al. 2016, "Sparse representation of terrains").
///
/// Every node of the tree gives an elevation `h(p)` and a weight `a(p)`, at least 0, for every
/// place `p`: metres east and north of the south-western node of the lattice. Leaves are landforms
/// (`Disc`, `Curve`, `Squig`, `Bell`, `Plane`, `RadialRamp`, `Noise`, `Mask`, `Raster`), the other
/// nodes put them together (`Blend`, `Replace`, `Add`, `Carve`, `Raise`) or change them (`Weigh`,
/// `Place`, `Warp`, `Deform`). Where the root has a weight below 1, that share of it replaces
/// `ground_m`.
///
/// From node to node goes a bound of the slope, a Lipschitz constant; every kind of node states
/// its formula.
///
/// # Limits
/// 2-D, open axes: landforms do not close on periodic ones. Trees of at most 50 levels, 10 000
/// nodes and 100 000 points of curves. Cost: nodes of the lattice times nodes of the tree;
/// curves find their nearest piece through boxes, and noise in a disc is made within it only.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ConstructionTree {
    /// Height of the ground where the tree has no weight.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub ground_m: f64,
    /// The root.
    pub of: Node,
}

impl Default for ConstructionTree {
    fn default() -> Self {
        Self { ground_m: 0.0, of: Node::Disc(Disc::default()) }
    }
}

impl ConstructionTree {
    /// The terrain of this tree with the random numbers of `seed`. Noise has no waves that are
    /// shorter than `spacing_m`.
    ///
    /// # Errors
    /// [`SynthError`] if a parameter is out of its range or the tree is too large. The message
    /// names the node.
    pub fn terrain(&self, spacing_m: f64, seed: u64) -> Result<Terrain, SynthError> {
        self.terrain_from(Path::new(""), spacing_m, seed)
    }

    /// As [`ConstructionTree::terrain`], with the files of masks relative to `folder`.
    ///
    /// # Errors
    /// As there, and if a file cannot be read.
    pub fn terrain_from(
        &self,
        folder: &Path,
        spacing_m: f64,
        seed: u64,
    ) -> Result<Terrain, SynthError> {
        Checks(NAME).elevation("ground_m", self.ground_m)?;
        let mut terrain = Terrain::of_node(&self.of, "of", folder, spacing_m, seed)?;
        terrain.root.ground = Box::new(PlaneSurface::level(self.ground_m));
        Ok(terrain)
    }
}

impl Generator for ConstructionTree {
    fn generate(&self, lattice: &Lattice, seed: u64) -> Result<Vec<f64>, SynthError> {
        self.heights_from(Path::new(""), lattice, seed)
    }
}

impl InitialCondition for ConstructionTree {
    const NAME: &'static str = NAME;

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        self.heights_from(context.folder, &context.domain.lattice, context.seed).map_err(refusal)
    }
}

impl ConstructionTree {
    /// One height a node.
    fn heights_from(
        &self,
        folder: &Path,
        lattice: &Lattice,
        seed: u64,
    ) -> Result<Vec<f64>, SynthError> {
        Checks(NAME).plane(lattice)?;
        for (axis, name) in ['x', 'y'].into_iter().enumerate() {
            if lattice.is_periodic(axis) {
                let remedy = "make the axis open";
                return Err(SynthError::DoesNotClose { generator: NAME, axis: name, remedy });
            }
        }
        let terrain = self.terrain_from(folder, lattice.spacing(), seed)?;
        Ok(fill_by_tiles(
            lattice,
            |_| (),
            |(), points, heights| {
                heights.copy_from_slice(&terrain.elevations(points));
            },
        ))
    }
}

/// A construction tree made ready: elevations at any place. Give it many points at a time where
/// there are many.
///
/// ```
/// use landform_synth::{Bell, ConstructionTree, Node};
///
/// let hill = Bell { center_m: [100.0, 50.0], height_m: 30.0, radius_m: 40.0 };
/// let terrain = ConstructionTree { ground_m: 0.0, of: Node::Bell(hill) }.terrain(1.0, 7)?;
/// assert_eq!(terrain.elevation([100.0, 50.0]), 30.0);
/// assert!(terrain.bounds().slope < 0.5);
/// # Ok::<(), landform_synth::SynthError>(())
/// ```
#[derive(Debug)]
pub struct Terrain {
    root: OntoSurface,
}

impl Terrain {
    /// The terrain of a node on ground at height 0. Problems, and random numbers, are those of the
    /// node at `path`; files are relative to `folder`.
    pub(crate) fn of_node(
        node: &Node,
        path: &str,
        folder: &Path,
        spacing_m: f64,
        seed: u64,
    ) -> Result<Self, SynthError> {
        Checks(NAME).length("spacing_m", spacing_m, f64::MIN_POSITIVE)?;
        let by = Builder::new(Frame::open(spacing_m), folder, seed).build(node, path, 1)?;
        let ground = Box::new(PlaneSurface::level(0.0));
        Ok(Self { root: OntoSurface { meeting: Meeting::Replace, ground, by } })
    }

    /// Elevation in metres at a point, in metres east and north of the origin.
    pub fn elevation(&self, point: [f64; 2]) -> f64 {
        self.root.sample(&[point]).elevation[0]
    }

    /// Elevations in metres at many points.
    pub fn elevations(&self, points: &[[f64; 2]]) -> Vec<f64> {
        self.root.sample(points).elevation
    }

    /// What is known of the elevation everywhere: its range, and how steep it can be. A tilted
    /// plane has no end, and so no range.
    pub fn bounds(&self) -> Bounds {
        self.root.bounds(&Region::EVERYWHERE)
    }

    /// What is known of the elevation in a rectangle, given by its south-western and its
    /// north-eastern corner in metres. What lies outside counts nothing, so this is closer.
    pub fn bounds_within(&self, south_west: [f64; 2], north_east: [f64; 2]) -> Bounds {
        let region = Region { low: south_west, high: north_east };
        if region.is_empty() { Bounds::NOTHING } else { self.root.bounds(&region) }
    }
}
