//! Passages from inside, as a caver's lamp shows them.

use landform_analysis::voxels::{Surface, VoxelSet, smooth_surface};
use landform_graph::Lattice;
use landform_view::interior::{InteriorOptions, Lamp, Pool, Rock, render};
use landform_view::{Image, ViewError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Subject;
use super::standpoint::Standpoint;

/// Passages, the voxels of at least a value, from inside (thesis, figure 5.13): a lamp beside the
/// camera shows walls whose materials follow their slope and masks of Perlin noise; water stands in
/// them up to a level, and the deeper it is the less of what is below comes through. Lengths suit
/// voxels of 1 m.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CaveInterior {
    /// Voxels of at least this value are passages.
    pub at_least: f64,
    /// Steps of 4-8 subdivision that smooth the walls.
    #[schemars(range(max = 5), extend("x-source" = "thesis A.3"))]
    pub smoothing: usize,
    /// How far noise moves the walls after that.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m"))]
    pub roughness_m: f64,
    /// Width and height of the picture.
    #[schemars(extend("x-unit" = "pixels"))]
    pub size: (usize, usize),
    /// Where the camera stands, as shares of the way from west to east, from south to north and from
    /// the foot of the block to its top; if that is in the rock, in the nearest passage. When missing,
    /// on the centreline where passages are wide and the view is long.
    pub eye: Option<(f64, f64, f64)>,
    /// Compass bearing towards which the camera looks; where the view is longest when missing.
    #[schemars(extend("x-unit" = "degrees"))]
    pub bearing_deg: Option<f64>,
    /// How far the camera looks down.
    #[schemars(range(min = -90.0, max = 90.0), extend("x-unit" = "degrees"))]
    pub pitch_deg: f64,
    /// Horizontal field of view.
    #[schemars(range(min = 1.0, max = 150.0), extend("x-unit" = "degrees"))]
    pub field_of_view_deg: f64,
    /// The lamp.
    pub lamp: CaveLamp,
    /// The walls.
    pub rock: CaveRock,
    /// Water in the passages.
    pub water: Option<CaveWater>,
}

/// A lamp beside the camera.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CaveLamp {
    /// How far it is to the right of the camera, above it and ahead of it; less where rock is in the way.
    #[schemars(extend("x-unit" = "m"))]
    pub offset_m: (f64, f64, f64),
    /// Distance at which its light is half as strong as close to it.
    #[schemars(range(min = 0.001, max = 1e6), extend("x-unit" = "m"))]
    pub reach_m: f64,
    /// Strength: 1 shows what is close in its own colours.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub strength: f64,
    /// Share of its light that walls throw back on each other.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub thrown_back: f64,
}

impl Default for CaveLamp {
    fn default() -> Self {
        let Lamp { offset_m: [x, y, z], reach_m, strength, thrown_back, .. } = Lamp::default();
        Self { offset_m: (x, y, z), reach_m, strength, thrown_back }
    }
}

/// What walls of caves are made of. Colours are red, green and blue, sRGB.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CaveRock {
    /// Sediment on floors.
    pub floor: (u8, u8, u8),
    /// Walls.
    pub wall: (u8, u8, u8),
    /// Darker beds in walls.
    pub bed: (u8, u8, u8),
    /// Ceilings.
    pub ceiling: (u8, u8, u8),
    /// Streaks on walls.
    pub stain: (u8, u8, u8),
    /// Wet flowstone.
    pub flowstone: (u8, u8, u8),
    /// Thickness of a bed with its darker neighbour.
    #[schemars(range(min = 0.001, max = 1e6), extend("x-unit" = "m"))]
    pub bed_m: f64,
    /// Size of the patches that masks of noise make.
    #[schemars(range(min = 0.001, max = 1e6), extend("x-unit" = "m"))]
    pub patch_m: f64,
    /// Size of the largest bumps that only light shows.
    #[schemars(range(min = 0.001, max = 1e6), extend("x-unit" = "m"))]
    pub grain_m: f64,
    /// Slope of these bumps.
    #[schemars(range(min = 0.0, max = 5.0))]
    pub relief: f64,
    /// Floors and ceilings are flatter than this.
    #[schemars(range(min = 0.0, max = 90.0), extend("x-unit" = "degrees"))]
    pub flat_deg: f64,
    /// How much noise has a part in colours and masks; 0 leaves plain colours by slope.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub variety: f64,
}

impl Default for CaveRock {
    fn default() -> Self {
        let rock = Rock::default();
        let colour = |[red, green, blue]: [u8; 3]| (red, green, blue);
        Self {
            floor: colour(rock.floor),
            wall: colour(rock.wall),
            bed: colour(rock.bed),
            ceiling: colour(rock.ceiling),
            stain: colour(rock.stain),
            flowstone: colour(rock.flowstone),
            bed_m: rock.bed_m,
            patch_m: rock.patch_m,
            grain_m: rock.grain_m,
            relief: rock.relief,
            flat_deg: rock.flat_deg,
            variety: rock.variety,
        }
    }
}

/// Water in caves.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CaveWater {
    /// Height of its surface above the foot of the block.
    #[schemars(extend("x-unit" = "m"))]
    pub level_m: f64,
    /// How fast red, green and blue light fade: `exp(-k d)` is left after d metres.
    #[schemars(extend("x-unit" = "1/m", "x-source" = "Beer and Lambert's law"))]
    pub absorption_per_m: (f64, f64, f64),
    /// Colour of deep water, sRGB.
    pub colour: (u8, u8, u8),
    /// Slope of ripples; 0 is a mirror.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub ripple: f64,
}

impl Default for CaveWater {
    fn default() -> Self {
        Self {
            level_m: 1.0,
            absorption_per_m: (0.75, 0.24, 0.2),
            colour: (14, 60, 64),
            ripple: 0.035,
        }
    }
}

impl Default for CaveInterior {
    fn default() -> Self {
        Self {
            at_least: 0.5,
            smoothing: 4,
            roughness_m: 0.25,
            size: (960, 640),
            eye: None,
            bearing_deg: None,
            pitch_deg: 5.0,
            field_of_view_deg: 80.0,
            lamp: CaveLamp::default(),
            rock: CaveRock::default(),
            water: None,
        }
    }
}

impl CaveInterior {
    pub(super) fn draw(&self, lattice: &Lattice, subject: &Subject) -> Result<Image, ViewError> {
        let spacing_m = lattice.spacing();
        let set = VoxelSet::at_least(lattice.size(), &subject.values, self.at_least);
        let Surface { mut positions, triangles } = smooth_surface(&set, self.smoothing);
        positions.iter_mut().flatten().for_each(|at| *at *= spacing_m);
        let dry_above = self.water.map_or(f64::NEG_INFINITY, |water| water.level_m / spacing_m);
        let top = lattice.size().map(|voxels| voxels as f64);
        let wanted = self.eye.map(|(x, y, z)| [x * top[0], y * top[1], z * top[2]]);
        let standpoint = match wanted {
            Some(wanted) => Standpoint::near(&set, wanted),
            None => Standpoint::with_a_view(&set, dry_above),
        };
        let Standpoint { eye, bearing_deg } = standpoint.unwrap_or_default();
        render(&positions, &triangles, &self.options(eye.map(|at| at * spacing_m), bearing_deg))
    }

    fn options(&self, eye_m: [f64; 3], bearing_deg: f64) -> InteriorOptions {
        let CaveLamp { offset_m: (x, y, z), reach_m, strength, thrown_back } = self.lamp;
        InteriorOptions {
            size: self.size.into(),
            bearing_deg: self.bearing_deg.unwrap_or(bearing_deg),
            pitch_deg: self.pitch_deg,
            field_of_view_deg: self.field_of_view_deg,
            roughness_m: self.roughness_m,
            lamp: Lamp { offset_m: [x, y, z], reach_m, strength, thrown_back, ..Lamp::default() },
            rock: self.rock.into(),
            pool: self.water.map(Pool::from),
            ..InteriorOptions::new(eye_m)
        }
    }

    /// A tiny picture with all the settings, for what only drawing finds wrong.
    pub(super) fn trial(&self) -> Result<Image, ViewError> {
        let small = Self { size: (4, 4), ..self.clone() };
        let (x, y, z) = self.eye.unwrap_or_default();
        render(&[], &[], &small.options([x, y, z], 0.0))
    }
}

impl From<CaveRock> for Rock {
    fn from(rock: CaveRock) -> Self {
        Self {
            floor: rock.floor.into(),
            wall: rock.wall.into(),
            bed: rock.bed.into(),
            ceiling: rock.ceiling.into(),
            stain: rock.stain.into(),
            flowstone: rock.flowstone.into(),
            bed_m: rock.bed_m,
            patch_m: rock.patch_m,
            grain_m: rock.grain_m,
            relief: rock.relief,
            flat_deg: rock.flat_deg,
            variety: rock.variety,
        }
    }
}

impl From<CaveWater> for Pool {
    fn from(water: CaveWater) -> Self {
        Self {
            level_m: water.level_m,
            absorption_per_m: water.absorption_per_m.into(),
            colour: water.colour.into(),
            ripple: water.ripple,
        }
    }
}
