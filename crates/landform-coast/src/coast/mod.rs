//! Coasts that the sea erodes (thesis, section 4.2).
//!
//! Sapoval's model (2004): rock of random resistance meets a sea whose force sinks as the shore
//! grows longer. Weak rock falls and lays bare what lies behind it, in avalanches, until the
//! shore is long and strong enough. The coasts that come to rest are fractal.
//!
//! - [`Coast`]: one iteration after another, fast;
//! - [`Perimeter`]: which shore weakens the sea; [`Weakening`]: how exposure weakens rock;
//!   [`Wear`]: rock that gives way in time, and around events; [`Region`]: coasts of mixed kinds;
//! - [`Shore`]: how long the shore is, and where;
//! - [`Front`]: how rough the shore is that the sea leaves in rock which hardens inland;
//! - [`islands`]: the pieces of land and their shores;
//! - [`mod@reference`]: the same model, literally and slowly, for reading and for tests.

#[cfg(test)]
mod agreement;
mod arcs;
mod blocks;
mod compass;
mod concerned;
mod disc_sums;
mod engine;
mod error;
mod front;
mod islands;
mod marks;
pub mod reference;
mod regions;
mod row_changes;
mod sea;
mod settings;
mod shore;
mod shore_lines;
mod sides;
mod stretch;
#[cfg(test)]
mod testing;
mod watch;
mod weakest;
mod wear;
mod withstood;

pub use engine::{Coast, Events};
pub use error::CoastError;
pub use front::Front;
pub use islands::{Island, islands};
pub use regions::{MapSide, Place, Region};
pub use settings::{CoastSettings, Perimeter, Weakening, Wear};
pub use shore::{PARTS, Shore, spacings};
