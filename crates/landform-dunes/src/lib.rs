//! Wind-blown dunes and sandpiles as Landform processes.
//!
//! [`dunes`] and [`sandpile`] hold the kernels: plain functions and structs over slices and
//! lattices. [`plugin`] makes processes and metrics of them, for scenarios and apps.

pub mod dunes;
pub mod plugin;
pub mod sandpile;

pub use plugin::register;
