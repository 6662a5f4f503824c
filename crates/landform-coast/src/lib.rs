//! Coasts that the sea erodes, as Landform processes.
//!
//! [`coast`], [`image`] and [`interior`] hold the kernels: plain functions and structs over slices
//! and lattices. [`plugin`] makes processes, metrics and initial conditions of them, for scenarios
//! and apps.

pub mod coast;
pub mod image;
pub mod interior;
pub mod plugin;

pub use plugin::register;
