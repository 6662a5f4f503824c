//! Pictures from inside: what a lamp shows of the walls around a camera, as in a cave.
//!
//! 1. Vertices of the walls are moved by noise, and their triangles sorted into cubes of a grid.
//! 2. A ray for every sample finds the wall it shows; above [`Pool`]s it parts into what is mirrored
//!    and what comes through, bent by Snell's law and dimmed by Beer and Lambert's.
//! 3. [`Rock`] gives colour and gloss by the slope of the wall and masks of noise, and bumps.
//! 4. A lamp beside the camera, with shadows, and light that walls throw back, less of it in corners
//!    that see little of their surroundings.
//!
//! Textures are solid: colours are functions of the place in space, so nothing is stretched over a
//! wall and there are no seams.
//!
//! # Limits
//! Triangles should be of like size: large ones among many small ones cost memory. Rays are mirrored
//! once. A camera below the surface of water sees through it, without its underside.

mod draw;
mod mesh;
mod noise;
mod pool;
mod rock;

pub use pool::Pool;
pub use rock::Rock;

use crate::{Image, ViewError};

/// A lamp that goes with the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// Where it is, seen from the camera: to the right, up and ahead, in metres. A lamp that would be
    /// in the rock is held closer.
    pub offset_m: [f64; 3],
    /// Distance at which its light is half as strong as close to it.
    pub reach_m: f64,
    /// Strength: 1 shows walls close to it in their own colours.
    pub strength: f64,
    /// Radius of the lamp, which makes shadows soft, in metres.
    pub radius_m: f64,
    /// Share of its light that walls throw back on each other.
    pub thrown_back: f64,
}

impl Default for Lamp {
    fn default() -> Self {
        Self {
            offset_m: [-0.5, 0.35, 0.0],
            reach_m: 8.0,
            strength: 1.3,
            radius_m: 0.08,
            thrown_back: 0.3,
        }
    }
}

impl Lamp {
    fn check(&self) -> Result<(), ViewError> {
        let check = ViewError::check_option;
        for offset in self.offset_m {
            check("offset_m", offset, [-1e6, 1e6], "from -1e6 to 1e6 m")?;
        }
        check("reach_m", self.reach_m, [1e-3, 1e6], "from 0.001 to 1e6 m")?;
        check("strength", self.strength, [0.0, 100.0], "from 0 to 100")?;
        check("radius_m", self.radius_m, [0.0, 1e3], "from 0 to 1000 m")?;
        check("thrown_back", self.thrown_back, [0.0, 1.0], "from 0 to 1")
    }

    /// Strength of its light at a distance.
    fn at(&self, distance_m: f64) -> f64 {
        self.strength / (1.0 + (distance_m / self.reach_m).powi(2))
    }
}

/// How a space is drawn from inside.
#[derive(Clone, Debug)]
pub struct InteriorOptions {
    /// Width and height of the picture in pixels.
    pub size: [usize; 2],
    /// Samples a pixel each way.
    pub supersampling: usize,
    /// Where the camera stands, in metres.
    pub eye_m: [f64; 3],
    /// Compass bearing towards which the camera looks, in degrees: 0 north, 90 east.
    pub bearing_deg: f64,
    /// How far the camera looks down, in degrees.
    pub pitch_deg: f64,
    /// Horizontal field of view in degrees.
    pub field_of_view_deg: f64,
    /// How far noise moves the walls, in metres.
    pub roughness_m: f64,
    /// Walls closer than this to a corner make it darker, in metres.
    pub corner_m: f64,
    /// The lamp.
    pub lamp: Lamp,
    /// The walls.
    pub rock: Rock,
    /// Water, if there is any.
    pub pool: Option<Pool>,
}

impl InteriorOptions {
    /// A picture of 960 x 640 pixels to the north.
    pub fn new(eye_m: [f64; 3]) -> Self {
        Self {
            size: [960, 640],
            supersampling: 3,
            eye_m,
            bearing_deg: 0.0,
            pitch_deg: 0.0,
            field_of_view_deg: 80.0,
            roughness_m: 0.25,
            corner_m: 1.5,
            lamp: Lamp::default(),
            rock: Rock::default(),
            pool: None,
        }
    }

    fn check(&self, positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<(), ViewError> {
        let check = ViewError::check_option;
        check("supersampling", self.supersampling as f64, [1.0, 8.0], "from 1 to 8")?;
        ViewError::check_size("a picture", self.size.map(|side| side * self.supersampling), 1)?;
        check("bearing_deg", self.bearing_deg, [-1e6, 1e6], "a bearing in degrees")?;
        check("pitch_deg", self.pitch_deg, [-90.0, 90.0], "from -90 to 90")?;
        check("field_of_view_deg", self.field_of_view_deg, [1.0, 150.0], "from 1 to 150")?;
        check("roughness_m", self.roughness_m, [0.0, 1e6], "from 0 to 1e6 m")?;
        check("corner_m", self.corner_m, [1e-3, 1e6], "from 0.001 to 1e6 m")?;
        self.lamp.check()?;
        self.rock.check()?;
        self.pool.map_or(Ok(()), |pool| pool.check())?;
        for &coordinate in positions.iter().flatten().chain(&self.eye_m) {
            check("a position", coordinate, [-1e12, 1e12], "a number of at most 1e12")?;
        }
        let last = positions.len() as f64 - 1.0;
        let outside = triangles.iter().flatten().find(|&&vertex| f64::from(vertex) > last);
        outside.map_or(Ok(()), |&vertex| {
            check("a vertex", vertex.into(), [0.0, last], "a vertex of the walls")
        })
    }
}

/// Draws walls from inside: vertices in metres, x east, y north, z up, and triangles of them,
/// counter-clockwise seen from outside the space. The same options give the same bytes on any number
/// of threads. Where there are no walls it is dark.
///
/// # Errors
/// [`ViewError::Option`] for options out of range, [`ViewError::TooSmall`] and
/// [`ViewError::TooLarge`] for pictures of no size or beyond memory.
pub fn render(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    options: &InteriorOptions,
) -> Result<Image, ViewError> {
    options.check(positions, triangles)?;
    let mesh = mesh::Mesh::new(positions, triangles, options.roughness_m);
    Ok(draw::picture(&mesh, options))
}

#[cfg(test)]
mod tests;
