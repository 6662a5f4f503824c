//! Voxels of at least a value as a body in perspective.

use landform_analysis::voxels::{Surface, VoxelSet, smooth_surface};
use landform_graph::Lattice;
use landform_view::body::{Body, BodyOptions, Cut, render};
use landform_view::{ColourMap, Image, ViewError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::slice::Across;

/// A plane that opens a body: what lies above it, north of it or east of it is left out.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Opening {
    /// What the plane lies across.
    pub across: Across,
    /// Where: 0 at the lowest, southern or western side of the block, 1 at the side opposite.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub at: f64,
    /// Whether what lies on the near side, below, south or west, is left out instead.
    pub near_side: bool,
}

impl Default for Opening {
    fn default() -> Self {
        Self { across: Across::Up, at: 0.5, near_side: false }
    }
}

/// The voxels of at least a value as a body in perspective, coloured by height: the passages of a
/// cave.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Passages {
    /// Voxels of at least this value are drawn.
    pub at_least: f64,
    /// Steps of 4-8 subdivision that smooth the surface.
    #[schemars(range(max = 5), extend("x-source" = "thesis A.3"))]
    pub smoothing: usize,
    /// Name of the colour map.
    pub colours: String,
    /// Width and height of the picture.
    #[schemars(extend("x-unit" = "pixels"))]
    pub size: (usize, usize),
    /// Compass bearing towards which the camera looks.
    #[schemars(extend("x-unit" = "degrees"))]
    pub bearing_deg: f64,
    /// How far the camera looks down; 90 is a plan.
    #[schemars(range(min = -90.0, max = 90.0), extend("x-unit" = "degrees"))]
    pub pitch_deg: f64,
    /// 1 fits the whole block into the picture; 2 halves the distance to its middle.
    #[schemars(range(min = 0.01, max = 1000.0))]
    pub zoom: f64,
    /// A plane beyond which nothing is drawn.
    pub opening: Option<Opening>,
    /// How much of its colour what is farthest away loses.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub depth_cue: f64,
}

impl Default for Passages {
    fn default() -> Self {
        Self {
            at_least: 0.5,
            smoothing: 2,
            colours: "batlow".to_owned(),
            size: (960, 640),
            bearing_deg: 25.0,
            pitch_deg: 30.0,
            zoom: 1.0,
            opening: None,
            depth_cue: 0.35,
        }
    }
}

impl Passages {
    pub(super) fn draw(&self, lattice: &Lattice, values: &[f64]) -> Result<Image, ViewError> {
        let set = VoxelSet::at_least(lattice.size(), values, self.at_least);
        let Surface { mut positions, triangles } = smooth_surface(&set, self.smoothing);
        let spacing_m = lattice.spacing();
        positions.iter_mut().flatten().for_each(|at| *at *= spacing_m);
        let top = lattice.size().map(|nodes| nodes as f64 * spacing_m);
        let options = BodyOptions {
            size: self.size.into(),
            bearing_deg: self.bearing_deg,
            pitch_deg: self.pitch_deg,
            zoom: self.zoom,
            cut: self.opening.map(|opening| opening.cut(top)),
            depth_cue: self.depth_cue,
            ..BodyOptions::new(ColourMap::named(&self.colours)?, [[0.0; 3], top])
        };
        render(&Body { positions: &positions, triangles: &triangles }, &options)
    }

    /// A tiny picture with all the settings, for what only drawing finds wrong.
    pub(super) fn trial(&self) -> Result<Image, ViewError> {
        let small = Self { size: (4, 4), ..self.clone() };
        let options = BodyOptions {
            size: small.size.into(),
            bearing_deg: small.bearing_deg,
            pitch_deg: small.pitch_deg,
            zoom: small.zoom,
            depth_cue: small.depth_cue,
            ..BodyOptions::new(ColourMap::named(&small.colours)?, [[0.0; 3], [1.0; 3]])
        };
        render(&Body { positions: &[], triangles: &[] }, &options)
    }
}

impl Opening {
    /// The plane in a block from the origin to its top.
    fn cut(&self, top: [f64; 3]) -> Cut {
        let axis = match self.across {
            Across::East => 0,
            Across::North => 1,
            Across::Up => 2,
        };
        let mut towards = [0.0; 3];
        towards[axis] = if self.near_side { -1.0 } else { 1.0 };
        Cut { towards, through: top.map(|side| side * self.at) }
    }
}
