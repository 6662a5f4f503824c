//! Fields: a number at every node.
//!
//! A field is a marker type that names it; its values live in one table column of the entity
//! component system, in node order, so that a system hands kernels a plain slice.
//!
//! ```
//! use landform_sim::field::NodeField;
//!
//! /// Thickness of the soil.
//! struct Soil;
//!
//! impl NodeField for Soil {
//!     type Value = f64;
//!     const NAME: &'static str = "soil";
//!     const UNIT: &'static str = "m";
//!     const MEANING: &'static str = "thickness of the soil";
//! }
//! ```

mod column;
mod edges;
mod param;
mod table;
mod vocabulary;

pub use column::{Column, NodeField, Number};
pub use edges::{EdgeField, EdgeFieldEntry, OnEdges};
pub use param::{Field, FieldMut};
pub use table::{FieldEntry, FieldTable, UnknownField, read_column, stored_values, surface};
pub use vocabulary::{Bed, Sand, Water};
