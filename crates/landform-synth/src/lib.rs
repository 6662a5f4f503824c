//! Initial conditions: noise, ramps, hills and waves on a lattice.
//!
//! Every generator is a struct of parameters with documented units, ranges and defaults. It
//! turns a lattice and a seed into a field of one value a node, in node order:
//!
//! ```
//! use landform_graph::{Boundary, Connectivity, Lattice};
//! use landform_synth::{Generator, WhiteNoise};
//!
//! let lattice = Lattice::plane([64, 32], 10.0, Connectivity::Eight, [Boundary::Periodic; 2])?;
//! let heights = WhiteNoise { amplitude_m: 2.0, ..Default::default() }.generate(&lattice, 7)?;
//! assert!(heights.len() == 64 * 32 && heights.iter().all(|height| height.abs() <= 2.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! All generators give the same bits for the same lattice and seed on any number of threads,
//! finite values for all the parameters that they accept, and fields without a seam on
//! periodic axes.

mod branching;
mod course;
mod dendrite;
mod dendry;
mod dla;
mod error;
pub mod exact;
mod faulting;
mod fbm;
mod fractal;
mod hills;
mod lsystem;
mod mask;
mod midpoint;
mod noise;
mod place;
mod ramp;
mod ridge;
mod scenario;
mod sinusoid;
mod smooth;
mod tree;
mod uniform;
mod volume;

pub use branching::{BranchWidth, Branching, Shown, TubeMesh, tubes};
pub use dendrite::{
    CheapPlace, Dendrite, DendriteShown, EdgeWeights, EndShape, Endpoints, Grown, Refined, Rounds,
    WeightBias, WeightTable, came_from, least_costs,
};
pub use dendry::{Dendry, DendryFunction, DendryTerrain, DendryView};
pub use dla::{Aggregate, AggregateOrigin, Aggregated, Growth, Origin, aggregate};
pub use error::SynthError;
pub use faulting::{FaultProfile, FaultTrace, Faulting};
pub use fbm::{AmplitudeLaw, SpectralFbm};
pub use fractal::{Basis, Cascade, FractalNoise, OctaveShape, Warp};
pub use hills::{Cone, GaussianHill};
pub use lsystem::{LSystem, Rule, Turtle, rewrite, walk};
pub use mask::{KnownFractal, Mask, MaskSource, RasterGround};
pub use midpoint::{MidpointDisplacement, Subdivision};
pub use noise::{Distribution, WhiteNoise};
pub use ramp::Ramp;
pub use ridge::{Ridge, RidgeCourse};
pub use scenario::register;
pub use sinusoid::Sinusoid;
pub use smooth::SmoothNoise;
pub use tree::{
    Bell, Bounds, ConstructionTree, Curve, Deform, Disc, Node, Onto, Place, Plane, RadialRamp,
    SelectiveScaling, Squig, Terraces, Terrain, VerticalMap, Warped, Weigh,
};
pub use uniform::Uniform;
pub use volume::{
    Ball, Blended, Block, Cut, ImplicitVolume, Instance, Instances, Noised, Roughness, Tube,
    Volume, VolumeNode,
};

use landform_graph::Lattice;

/// A way to fill a field before the first iteration.
pub trait Generator: Send + Sync {
    /// One value for each node of `lattice`, in node order; `seed` is used by random fields
    /// only.
    ///
    /// # Errors
    /// [`SynthError`] if a parameter is out of its range or the field cannot be made on this
    /// lattice.
    fn generate(&self, lattice: &Lattice, seed: u64) -> Result<Vec<f64>, SynthError>;
}
