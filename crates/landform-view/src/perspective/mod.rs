//! Perspective views: a block of terrain, or terrain to the horizon, under a low sun.
//!
//! 1. The heights are resampled to a surface of about a node a pixel, and every node gets its
//!    colour in sun and sky (the same as in a shaded relief).
//! 2. The camera stands where the whole block fits into the picture, divided by the zoom.
//! 3. Each ray passes over groups of cells by their greatest height until it comes to a cell
//!    that it may hit, and meets that cell's bilinear patch exactly.
//! 4. The colour at the hit is averaged over the ray's footprint, seen through water and haze,
//!    and the rays of a pixel are averaged.
//!
//! Limits: the sun's shadows are those of the resampled nodes, so a camera very near the ground
//! sees them soft; water mirrors the backdrop but not the terrain; endless ground is drawn to
//! sixty times the field's diagonal.

mod block;
mod camera;
mod march;
mod scene;
mod texture;

use glam::DVec3;
use rayon::prelude::*;

use self::block::Block;
pub use self::camera::Camera;
use self::scene::Scene;
use crate::light::{Light, quantise};
use crate::shade::Ground;
use crate::surface::{Sampling, Surface, check_relief};
use crate::water::Water;
use crate::{HeightField, Image, ViewError};

/// What lies around the field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surroundings {
    /// Nothing: the field is a block with cut sides.
    Block {
        /// Height of the block below the lowest node in metres; when missing, a twentieth of
        /// the field's shorter side.
        depth_m: Option<f64>,
        /// Colour of the cut sides, sRGB.
        colour: [u8; 3],
    },
    /// The field again and again, to the horizon: for periodic fields.
    Repeat,
}

/// How a perspective view is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct PerspectiveOptions {
    /// Width and height of the picture in pixels.
    pub size: [usize; 2],
    /// Rays a pixel each way: 2 means four rays a pixel.
    pub supersampling: usize,
    /// Compass bearing towards which the camera looks, in degrees: 0 north, 90 east.
    pub bearing_deg: f64,
    /// How far the camera looks down, in degrees: 0 level, 90 straight down.
    pub pitch_deg: f64,
    /// Horizontal field of view in degrees.
    pub field_of_view_deg: f64,
    /// 1 fits the whole field into the picture; 2 halves the distance to its middle.
    pub zoom: f64,
    /// Factor of heights.
    pub vertical_exaggeration: f64,
    /// Standard deviation, in nodes, of a Gaussian that smooths the heights that are drawn: about
    /// 1 hides the steps of heights that are whole slabs of sand. 0 draws every height as it is.
    pub smoothing_nodes: f64,
    /// Colours and contour lines.
    pub ground: Ground,
    /// What lights it.
    pub light: Light,
    /// What lies around the field.
    pub surroundings: Surroundings,
    /// Water at a level, or of the field's own depths; none is drawn when missing.
    pub water: Option<Water>,
    /// Colours of the backdrop, sRGB: at the horizon (or the foot of the picture) and at its top.
    pub sky: [[u8; 3]; 2],
    /// Optical depth of the air over the field's diagonal; 0 is clear.
    pub haze: f64,
}

impl PerspectiveOptions {
    /// A block of 960 x 600 pixels that looks north-east under a low sun.
    pub fn new(ground: Ground) -> Self {
        Self {
            size: [960, 600],
            supersampling: 2,
            bearing_deg: 30.0,
            pitch_deg: 32.0,
            field_of_view_deg: 30.0,
            zoom: 1.0,
            vertical_exaggeration: 1.0,
            smoothing_nodes: 0.0,
            ground,
            light: Light::low_sun(),
            surroundings: Surroundings::Block { depth_m: None, colour: [150, 122, 92] },
            water: None,
            sky: [[238, 233, 224], [182, 203, 226]],
            haze: 0.12,
        }
    }

    fn check(&self) -> Result<(), ViewError> {
        self.ground.check()?;
        self.light.check()?;
        self.water.as_ref().map_or(Ok(()), Water::check)?;
        ViewError::check_size("a picture", self.size, 1)?;
        let check = ViewError::check_option;
        check("supersampling", self.supersampling as f64, [1.0, 16.0], "from 1 to 16")?;
        check("bearing_deg", self.bearing_deg, [-1e6, 1e6], "a bearing in degrees")?;
        check("pitch_deg", self.pitch_deg, [0.0, 90.0], "from 0 to 90")?;
        check("field_of_view_deg", self.field_of_view_deg, [1.0, 150.0], "from 1 to 150")?;
        check("zoom", self.zoom, [0.01, 1000.0], "from 0.01 to 1000")?;
        let range = [1e-6, 1e6];
        check("vertical_exaggeration", self.vertical_exaggeration, range, "from 1e-6 to 1e6")?;
        check("smoothing_nodes", self.smoothing_nodes, [0.0, 100.0], "from 0 to 100 nodes")?;
        check("haze", self.haze, [0.0, 100.0], "from 0 to 100")?;
        match self.surroundings {
            Surroundings::Block { depth_m: Some(depth), .. } => {
                check("depth_m", depth, [0.0, 1e12], "a height in metres, at least 0")
            }
            _ => Ok(()),
        }
    }
}

/// Draws a field in perspective. The same options give the same bytes on any number of threads.
///
/// # Errors
/// [`ViewError::Option`] for options out of range, [`ViewError::TooSmall`] or
/// [`ViewError::TooLarge`] for pictures of no size or beyond memory.
pub fn render(field: &HeightField<'_>, options: &PerspectiveOptions) -> Result<Image, ViewError> {
    options.check()?;
    let sampling = sampling(field, options)?;
    let surface = Surface::sample(field, sampling)?;
    let water = options.water.map(|water| water.surface(field, sampling)).transpose()?.flatten();
    let scene = Scene::new(&surface, water.as_ref(), options);
    let [width, height] = options.size;
    let mut rgb = vec![[0; 3]; width * height];
    rgb.par_chunks_mut(width).enumerate().for_each(|(row, line)| {
        for (column, pixel) in line.iter_mut().enumerate() {
            *pixel = quantise(scene.pixel(column, row), column, row);
        }
    });
    Ok(Image { width, height, rgb })
}

/// The camera of [`render`], for placing labels: positions in metres, x east and y north from
/// the field's south-west node, z the height above the lowest node times the exaggeration.
///
/// # Errors
/// As for [`render`].
pub fn camera(field: &HeightField<'_>, options: &PerspectiveOptions) -> Result<Camera, ViewError> {
    options.check()?;
    let surface = Surface::sample(field, sampling(field, options)?)?;
    Ok(place_camera(&surface, options))
}

/// The surface that is drawn: about a node a pixel, so that small fields have smooth slopes and
/// large ones no more detail than the picture shows.
fn sampling(field: &HeightField<'_>, options: &PerspectiveOptions) -> Result<Sampling, ViewError> {
    let exaggeration = options.vertical_exaggeration;
    if let Some(level_m) = options.water.and_then(|water| water.level_m) {
        check_relief(field, level_m - field.range()[0], exaggeration)?;
    }
    if let Surroundings::Block { depth_m: Some(depth), .. } = options.surroundings {
        check_relief(field, depth, exaggeration)?;
    }
    let periodic = options.surroundings == Surroundings::Repeat;
    let longest = field.width().max(field.height()) as f64;
    let wanted = (1.25 * options.size[0].max(options.size[1]) as f64).clamp(256.0, 2560.0);
    let step = match longest > wanted {
        true => (longest / wanted).floor(),
        false => 1.0 / (wanted / longest).round().clamp(1.0, 16.0),
    };
    let nodes = |size: usize| match periodic {
        true => (size as f64 / step).round() as usize,
        false => ((size - 1) as f64 / step).floor() as usize + 1,
    };
    Ok(Sampling {
        size: [nodes(field.width()), nodes(field.height())].map(|nodes| nodes.max(2)),
        origin: 0.0,
        step,
        periodic,
        smoothing: options.smoothing_nodes,
        exaggeration,
    })
}

/// The camera that frames the surface and its block.
fn place_camera(surface: &Surface, options: &PerspectiveOptions) -> Camera {
    /// Free share of the picture on each side.
    const MARGIN: f64 = 0.03;
    let points = outline(surface, options);
    let [bearing, pitch] = [options.bearing_deg, options.pitch_deg];
    let camera = Camera::new(DVec3::ZERO, bearing, pitch, options.field_of_view_deg, options.size);
    let mut camera = camera.framing(&points, MARGIN);
    let middle = points.iter().sum::<DVec3>() / points.len() as f64;
    camera.position = middle + (camera.position - middle) / options.zoom;
    if options.surroundings == Surroundings::Repeat {
        let clearance = 0.02 * (camera.position - middle).length();
        camera.position.z = camera.position.z.max(f64::from(surface.highest) + clearance);
    }
    camera
}

/// Points that have to be in the picture: the corners of the block at its foot and, for each of
/// some hundred parts of the surface, the highest node or the water above it.
fn outline(surface: &Surface, options: &PerspectiveOptions) -> Vec<DVec3> {
    const PARTS: usize = 24;
    let foot = Block::new(surface, options).map_or(0.0, |block| block.foot);
    let sea = options.water.and_then(|water| water.level_m);
    let level = sea.map_or(0.0, |level_m| surface.raised(level_m));
    let [columns, rows] = [surface.columns, surface.rows];
    let point = |column: usize, row: usize, height: f64| {
        let [x, y] = [column, rows - 1 - row].map(|node| node as f64 * surface.spacing);
        DVec3::new(x, y, height)
    };
    let bounds = |part: usize, nodes: usize| part * nodes / PARTS..(part + 1) * nodes / PARTS;
    let mut points = Vec::new();
    for part in 0..PARTS * PARTS {
        let across = bounds(part % PARTS, columns);
        let down = bounds(part / PARTS, rows);
        let nodes = down.flat_map(|row| across.clone().map(move |column| (column, row)));
        let height = |&(column, row): &(usize, usize)| surface.heights[column + columns * row];
        let highest = nodes.max_by(|one, other| height(one).total_cmp(&height(other)));
        points.extend(highest.map(|(column, row)| {
            let height = height(&(column, row)).max(level);
            point(column, row, height.into())
        }));
    }
    for (column, row) in [(0, 0), (columns - 1, 0), (0, rows - 1), (columns - 1, rows - 1)] {
        let top = surface.heights[column + columns * row].max(level);
        points.extend([point(column, row, foot), point(column, row, top.into())]);
    }
    points
}
