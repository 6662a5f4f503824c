//! Wind-blown dunes and sandpiles as Landform processes.

pub mod dunes;
pub mod sandpile;
