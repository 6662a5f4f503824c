//! Outputs that scenarios may name: pictures, animations, rasters and meshes.

mod animation;
mod due;
mod field_file;
mod look;
mod mesh;
mod panels;
mod picture;
mod when;

pub use animation::Animation;
pub use field_file::FieldFile;
pub use look::{Density, Flat, Look, Perspective, Relief};
pub use mesh::Mesh;
pub use panels::Panels;
pub use picture::Picture;
pub use when::When;

pub(crate) use field_file::{metadata, raster_of};
pub(crate) use mesh::write_mesh;
