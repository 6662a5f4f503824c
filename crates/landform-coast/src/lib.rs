//! Coasts that the sea erodes, as Landform processes.
//!
//! [`coast`] holds the kernels: plain functions and structs over slices and lattices. [`plugin`]
//! makes processes, metrics and initial conditions of them, for scenarios and apps.

pub mod coast;
pub mod plugin;

pub use plugin::register;
