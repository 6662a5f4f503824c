//! Voxels of at least a value as a body in perspective.

use landform_analysis::voxels::{Rule, Turns, VoxelSet, centreline, plan_sheet};
use landform_graph::Lattice;
use landform_sim::parameters::Problem;
use landform_view::body::{BodyOptions, Cut, Parts, render};
use landform_view::{ColourMap, Image, ViewError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::slice::Across;
use super::{Subject, passage_body};

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

/// What thinning leaves of voxels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Thinned {
    /// Lines through their middle, thinned side by side (thesis, listing A.5).
    Centreline,
    /// Lines through their middle, thinned by the number of open sides (thesis, figure A.4 c).
    ExposedSides,
    /// A sheet through the middle of passages, thinned from above and below (thesis, section 5.4.2).
    Sheet,
}

impl Thinned {
    /// What is left of a set.
    pub(super) fn of(self, set: &VoxelSet) -> VoxelSet {
        match self {
            Self::Centreline => centreline(set, Turns::Sides, Rule::Supported),
            Self::ExposedSides => centreline(set, Turns::ExposedSides, Rule::Supported),
            Self::Sheet => plan_sheet(set),
        }
    }
}

/// The voxels of at least a value as a body in perspective, coloured by height or by another field:
/// the passages of a cave. Arrows show where water comes in and goes out.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Passages {
    /// Voxels of at least this value are drawn.
    pub at_least: f64,
    /// What of the voxels is drawn: all of them when missing.
    pub thinned: Option<Thinned>,
    /// Steps of 4-8 subdivision that smooth the surface.
    #[schemars(range(max = 5), extend("x-source" = "thesis A.3"))]
    pub smoothing: usize,
    /// Radius of tubes through the middles of the voxels, drawn instead of their surface: for channels
    /// a voxel wide, which are whole even where voxels touch at a corner.
    #[schemars(range(min = 1e-6, max = 1e6), extend("x-unit" = "m"))]
    pub tube_radius_m: Option<f64>,
    /// Name of the colour map.
    pub colours: String,
    /// Name of the field that colours the passages; their height when missing.
    pub colour_by: Option<String>,
    /// Values of that field for the first and the last colour; its range in the passages when missing.
    pub range: Option<(f64, f64)>,
    /// Width and height of the picture.
    #[schemars(extend("x-unit" = "pixels"))]
    pub size: (usize, usize),
    /// Compass bearing towards which the camera looks.
    #[schemars(extend("x-unit" = "degrees"))]
    pub bearing_deg: f64,
    /// How far the camera looks down; 90 is a plan.
    #[schemars(range(min = -90.0, max = 90.0), extend("x-unit" = "degrees"))]
    pub pitch_deg: f64,
    /// 1 fits the whole block into the picture; 2 halves the distance to where the camera looks.
    #[schemars(range(min = 0.01, max = 1000.0))]
    pub zoom: f64,
    /// Where the camera looks, as shares of the way from west to east, from south to north and from
    /// the foot of the block to its top; the middle of the block when missing.
    pub focus: Option<(f64, f64, f64)>,
    /// A plane beyond which nothing is drawn.
    pub opening: Option<Opening>,
    /// How much of its colour what is farthest away loses.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub depth_cue: f64,
    /// Whether arrows show sources and sinks of caves.
    pub marks: bool,
}

impl Default for Passages {
    fn default() -> Self {
        Self {
            at_least: 0.5,
            thinned: None,
            smoothing: 2,
            tube_radius_m: None,
            colours: "batlow".to_owned(),
            colour_by: None,
            range: None,
            size: (960, 640),
            bearing_deg: 25.0,
            pitch_deg: 30.0,
            zoom: 1.0,
            focus: None,
            opening: None,
            depth_cue: 0.35,
            marks: true,
        }
    }
}

impl Passages {
    pub(super) fn draw(&self, lattice: &Lattice, subject: &Subject) -> Result<Image, ViewError> {
        let top = lattice.size().map(|nodes| nodes as f64 * lattice.spacing());
        let colours = ColourMap::named(&self.colours)?;
        let parts = passage_body::parts(self, lattice, subject, colours);
        render(&parts.body(), &self.options(colours, top))
    }

    fn options(&self, colours: ColourMap, top: [f64; 3]) -> BodyOptions {
        BodyOptions {
            size: self.size.into(),
            bearing_deg: self.bearing_deg,
            pitch_deg: self.pitch_deg,
            zoom: self.zoom,
            focus: self.focus.map(|(x, y, z)| [x * top[0], y * top[1], z * top[2]]),
            frame: self.marks.then(|| passage_body::frame(top)),
            cut: self.opening.map(|opening| opening.cut(top)),
            depth_cue: self.depth_cue,
            ..BodyOptions::new(colours, [[0.0; 3], top])
        }
    }

    /// Refuses a camera that looks far away from the block.
    pub(super) fn check(&self) -> Result<(), Problem> {
        const FARTHEST: f64 = 10.0;
        let Some((x, y, z)) = self.focus else { return Ok(()) };
        if [x, y, z].iter().all(|share| share.abs() <= FARTHEST) {
            return Ok(());
        }
        let message = format!("the camera looks at ({x}, {y}, {z})");
        Err(Problem::new("focus", message, "shares of the block, from -10 to 10"))
    }

    /// A tiny picture with all the settings, for what only drawing finds wrong.
    pub(super) fn trial(&self) -> Result<Image, ViewError> {
        let small = Self { size: (4, 4), ..self.clone() };
        let colours = ColourMap::named(&small.colours)?;
        render(&Parts::default().body(), &small.options(colours, [1.0; 3]))
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
