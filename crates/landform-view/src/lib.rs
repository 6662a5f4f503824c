//! Pictures and animations of terrain.

pub mod animation;
mod atomic_file;
mod camera;
mod colour_map;
mod error;
pub mod flat;
mod height_field;
mod horizon;
mod image;
mod light;
mod march;
pub mod montage;
pub mod perspective;
pub mod relief;
mod shade;
mod smoothing;
mod surface;
mod text;
mod texture;
mod water;

pub use colour_map::ColourMap;
pub use error::{MOST_PIXELS, ViewError};
pub use height_field::HeightField;
pub use image::Image;
pub use light::Light;
pub use shade::Ground;
pub use water::Water;
