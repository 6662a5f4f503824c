//! Four water-column algorithms behind one face.

use landform_graph::Lattice;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::exchange::Exchange;
use super::pipes::Pipes;
use super::sharing::{Levelling, UniformAverage, WeightedAverage};
use super::{Columns, PipeSettings};
use crate::RiverError;
use crate::frame::Frame;

/// How a node shares its water among lower neighbours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Algorithm {
    /// The lowest neighbour first, up to the level of the next, until the water is used up or all
    /// have a common level (thesis, section 4.3.1 and figure 4.11). Flow concentrates.
    #[default]
    Specialised,
    /// What stands above the average goes to all lower neighbours alike (thesis, listing 4.2).
    UniformAverage,
    /// What stands above the average goes to lower neighbours in proportion to the fall (thesis,
    /// listing 4.2).
    WeightedAverage,
    /// Water flows through a pipe to every neighbour and takes time to start and to stop (thesis,
    /// listing 4.3).
    Hydrostatic(PipeSettings),
}

/// Lets the water of columns flow by an [`Algorithm`].
pub struct Sweeper(Kind);

enum Kind {
    Specialised(Exchange<Levelling>),
    Uniform(Exchange<UniformAverage>),
    Weighted(Exchange<WeightedAverage>),
    Hydrostatic(Pipes),
}

impl Sweeper {
    /// Bytes a node that sweeps work in.
    pub const BYTES: usize = 33;

    /// Memory for sweeps on a lattice.
    ///
    /// # Errors
    /// [`RiverError::Volume`]; [`RiverError::Unstable`].
    pub fn new(lattice: &Lattice, algorithm: Algorithm) -> Result<Self, RiverError> {
        let frame = Frame::new(lattice)?;
        Ok(Self(match algorithm {
            Algorithm::Specialised => Kind::Specialised(Exchange::new(&frame)),
            Algorithm::UniformAverage => Kind::Uniform(Exchange::new(&frame)),
            Algorithm::WeightedAverage => Kind::Weighted(Exchange::new(&frame)),
            Algorithm::Hydrostatic(pipes) => Kind::Hydrostatic(Pipes::new(lattice, pipes)?),
        }))
    }

    /// Checks what [`Sweeper::new`] would, without its memory.
    ///
    /// # Errors
    /// As [`Sweeper::new`].
    pub fn check(lattice: &Lattice, algorithm: Algorithm) -> Result<(), RiverError> {
        Frame::new(lattice)?;
        match algorithm {
            Algorithm::Hydrostatic(pipes) => pipes.check(lattice),
            _ => Ok(()),
        }
    }

    /// Lets water flow once: every node gives to its lower neighbours, all at the same moment.
    ///
    /// `flows` are those of [`Algorithm::Hydrostatic`] on directed edges ([`Lattice::slots`]), in
    /// m³/s; other algorithms leave them alone, and they may be empty. Cost: that of the wet nodes,
    /// with pipes that of all.
    ///
    /// # Errors
    /// [`RiverError::Length`] if pipes lack flows.
    ///
    /// # Panics
    /// If the columns belong to a lattice of another size.
    pub fn sweep(&mut self, columns: &mut Columns, flows: &mut [f64]) -> Result<(), RiverError> {
        match &mut self.0 {
            Kind::Specialised(exchange) => exchange.sweep(columns),
            Kind::Uniform(exchange) => exchange.sweep(columns),
            Kind::Weighted(exchange) => exchange.sweep(columns),
            Kind::Hydrostatic(pipes) => return pipes.step(columns, flows),
        }
        Ok(())
    }
}
