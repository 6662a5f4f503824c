//! Helpers shared by the tests of the whole of Landform.

mod bits;
mod book;
mod cuts;
pub mod fuzzing;
mod program;
mod rasters;
mod repository;
mod runs;
mod scratch;
mod small;
mod tree;

pub use bits::{bits_of, fnv};
pub use book::{Block, blocks, links};
pub use cuts::cuts;
pub use program::{Ended, Program, build_folder, executable};
pub use rasters::{hills, write_hills, write_shore};
pub use repository::{files_below, repository, shown};
pub use runs::Run;
pub use scratch::Scratch;
pub use small::{SMALL, changed};
pub use tree::{differences, tree};
