//! Pictures and animations of terrain: plain functions from heights to pixels.
//!
//! A [`HeightField`] is checked once; then [`relief::shaded_relief`] draws it as a map and
//! [`perspective::render`] as a block or as ground to the horizon. [`flat`] draws any other field
//! with a colour bar, [`body`] closed surfaces such as caves, [`interior`] what a lamp shows inside
//! them, [`cave_map`] their maps, [`cloud`] values of a volume, [`graph`] draws nodes and edges, [`montage`] puts pictures together as figures, [`plot`] draws curves with
//! axes, and [`animation`] writes frames to a file as a run goes on. Everything is computed on the CPU, and the bytes do not
//! depend on the number of threads.
//!
//! Rows run south (row 0 is the northernmost), directions of cameras and suns are compass
//! bearings in degrees, lengths are metres.
//!
//! ```
//! use landform_view::{ColourMap, Ground, HeightField, perspective};
//!
//! let heights: Vec<f64> = (0..64 * 64).map(|i| 2.0 * (f64::from(i % 64) / 5.0).sin()).collect();
//! let field = HeightField::new(64, 64, 1.0, &heights)?;
//! let ground = Ground::new(ColourMap::named("sand")?);
//! let options = perspective::PerspectiveOptions {
//!     size: [120, 80],
//!     ..perspective::PerspectiveOptions::new(ground)
//! };
//! let picture = perspective::render(&field, &options)?;
//! assert_eq!((picture.width, picture.height), (120, 80));
//! # Ok::<(), landform_view::ViewError>(())
//! ```
//!
//! How a surface is lit: heights are resampled with Catmull-Rom splines to about a node a pixel;
//! each node looks along the ground towards the sun (with a penumbra) and in sixteen directions
//! at the sky; Lambert's law, the sky's view factor and light thrown back by the ground give
//! linear colours, which both kinds of picture share.

pub mod animation;
mod atomic_file;
pub mod body;
pub mod cave_map;
pub mod cloud;
mod colour_map;
mod error;
pub mod flat;
pub mod graph;
mod height_field;
mod horizon;
mod image;
pub mod interior;
mod light;
pub mod mark;
pub mod montage;
pub mod perspective;
pub mod plot;
pub mod relief;
mod shade;
mod smoothing;
mod surface;
mod text;
mod water;

pub use colour_map::ColourMap;
pub use error::{MOST_PIXELS, ViewError};
pub use height_field::HeightField;
pub use image::Image;
pub use light::Light;
pub use shade::Ground;
pub use water::Water;
