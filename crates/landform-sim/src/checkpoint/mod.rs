//! Checkpoints: everything that a run needs to go on later with the same bits.
//!
//! A [`Checkpoint`] is a set of named arrays and texts in memory. Fields and agents are saved
//! by the framework; what else a process keeps between iterations it names with
//! [`Declaration::keeps`](crate::process::Declaration::keeps). How a checkpoint becomes a file
//! is no matter of this crate.

mod array;
mod damage;
mod keep;
mod store;

pub use array::{Array, Element};
pub use damage::Damage;
pub use keep::Keep;
pub use store::{Checkpoint, Loader, Saver};

/// Name of the folder, in the output folder of a run, that holds its checkpoint and the
/// unfinished files of its outputs. It is removed when the run is over.
pub const FOLDER: &str = "checkpoint";

#[cfg(test)]
mod tests;
