//! Water columns: water that stands on the ground and flows to lower neighbours (thesis, sections
//! 4.3.1 and 4.4.3).
//!
//! [`Columns`] holds ground and water of a lattice in whole units, so that nothing is lost;
//! [`Sweeper`] lets the water flow by one of four [`Algorithm`]s. An iteration:
//!
//! ```
//! use landform_graph::{Boundary, Connectivity, Lattice};
//! use landform_rivers::water::{Algorithm, Columns, Sweeper};
//!
//! let lattice = Lattice::plane([3, 1], 10.0, Connectivity::Eight, [Boundary::Open; 2])?;
//! let bed = [2.0, 1.0, 0.0];
//! let mut water = [0.5, 0.0, 0.0];
//! let mut flow = [0.0; 3];
//! let mut columns = Columns::new(&lattice)?;
//! let mut sweeper = Sweeper::new(&lattice, Algorithm::Specialised)?;
//! columns.begin(&bed, &water)?;
//! for _ in 0..2 {
//!     sweeper.sweep(&mut columns, &mut [])?;
//! }
//! columns.finish(&mut water, &mut flow);
//! assert_eq!((water, flow), ([0.0, 0.0, 0.5], [0.0, 0.5, 0.5]));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod columns;
mod exchange;
mod marks;
mod pipes;
mod places;
#[cfg(test)]
mod reference;
mod sharing;
mod sweeper;
#[cfg(test)]
mod tests;
mod units;

pub use columns::Columns;
pub use pipes::PipeSettings;
pub use places::{Place, Side, border_nodes, nodes_beside};
pub use sweeper::{Algorithm, Sweeper};
pub use units::{MOST_M, UNIT_M};
