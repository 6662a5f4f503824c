//! Lessons: small processes, one of each style, to read and to copy.
//!
//! | style | process | what it shows |
//! |---|---|---|
//! | a field and a kernel | [`Life`] | a rule for every node, at the speed of memory |
//! | the same with agents | [`LivingCells`] | births and deaths; the same model twice |
//! | agents at some nodes | [`ForestFire`] | two groups, parity, a derived field |
//! | values on edges | [`Pipes`] | flows between neighbours, a budget that is checked |
//! | agents that move | [`Trails`] | claims, state, globals, marks on the ground |
//! | agents that move | [`Aggregation`] | random walks, in maps and volumes; agents that settle |
//!
//! They are processes like any other: they use nothing that a crate of your own could not use.
//! The chapter "Lessons" of the book walks through them.

mod aggregation;
mod forest_fire;
mod life;
mod living_cells;
mod pipes;
mod trails;

pub use aggregation::{Aggregation, AggregationSeed, Arrival, Drifters};
pub use forest_fire::{Burnt, Fires, ForestFire, Trees};
pub use life::{Alive, Life, generation, generation_reference};
pub use living_cells::{Cells, Company, LivingCells};
pub use pipes::{Flow, Pipes};
pub use trails::{Trails, Walkers, Wear};

use landform_sim::registry::Registry;

/// Registers the processes of this crate.
pub fn register(registry: &mut Registry) {
    registry
        .process::<Life>()
        .process::<LivingCells>()
        .process::<ForestFire>()
        .process::<Pipes>()
        .process::<Trails>()
        .process::<Aggregation>();
}
