//! The growth of channels after breakthrough: pressure, flow and erosion in turn (thesis, section
//! 5.2.2).

use landform_graph::Lattice;

use crate::CaveError;
use crate::erosion::{Contributions, Dissolution};
use crate::error::{check_length, check_values};
use crate::passages::Passages;
use crate::pressure::{Avalanches, Rates, initial_pressure};
use crate::stage_one::{Seed, weighted_distances};
use crate::water::{DownPressure, Falling, PoreWater, Rule, UNIT};

/// Where water comes in and goes out, by voxels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Openings {
    /// The voxels of each source.
    pub sources: Vec<Vec<usize>>,
    /// Pressure of each source among others.
    pub pressures: Vec<f64>,
    /// Share of its volume that each voxel of a source is given in an iteration, by source.
    pub strengths: Vec<f64>,
    /// The voxels of all sinks, in order.
    pub sinks: Vec<usize>,
}

impl Openings {
    /// Checks that no two openings share a voxel, and that there is a source.
    ///
    /// # Errors
    /// [`CaveError::NoSource`]; [`CaveError::Shared`].
    pub fn check(&self) -> Result<(), CaveError> {
        let mut nodes: Vec<usize> = self.sources.iter().flatten().copied().collect();
        if nodes.is_empty() {
            return Err(CaveError::NoSource);
        }
        nodes.extend(&self.sinks);
        nodes.sort_unstable();
        match nodes.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(CaveError::Shared { node: pair[0] }),
            None => Ok(()),
        }
    }

    /// The voxels of sources with their pressure.
    pub fn seeds(&self) -> Vec<Seed> {
        let of = |(source, nodes): (usize, &Vec<usize>)| -> Vec<Seed> {
            let pressure = self.pressures[source];
            nodes.iter().map(|&node| Seed { node, source: source as u32, pressure }).collect()
        };
        self.sources.iter().enumerate().flat_map(of).collect()
    }
}

/// How water moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// Down the pressure, by this exponent of [`DownPressure`].
    Pressure {
        /// How steeply pressure may rise.
        rates: Rates,
        /// Weight of differences of pressure.
        exponent: u32,
        /// Pressure at sources before breakthrough.
        most: f64,
        /// Share of it by which pressure falls to the ends of the zones.
        fall: f64,
    },
    /// Down only ([`Falling`]).
    Falling,
}

/// Parameters of the growth of channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrowthLaw {
    /// How water moves.
    pub motion: Motion,
    /// How it dissolves rock.
    pub dissolution: Dissolution,
    /// Porosity from which a voxel is part of a passage.
    pub passage: f64,
    /// Sweeps of water an iteration.
    pub sweeps: u32,
}

/// What an iteration moved, in volumes of a voxel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Turnover {
    /// Water that came in.
    pub fed: f64,
    /// Water that left.
    pub drained: f64,
    /// Rock that was dissolved.
    pub dissolved: f64,
}

/// A cave that grows. Porosity, pressure and water are the caller's; all else follows from them and
/// from parameters.
#[derive(Clone, Debug)]
pub struct ChannelGrowth {
    law: GrowthLaw,
    openings: Openings,
    passages: Passages,
    avalanches: Avalanches,
    contributions: Contributions,
}

impl ChannelGrowth {
    /// Bytes a voxel of working memory, water with it, where everything is wet: pages of pores, of
    /// contributions and of passages, and the front of an avalanche.
    pub const BYTES: usize = 20 + 8 + 4 + 1 + 16;

    /// A cave in rock of this `porosity`, a share of a voxel's volume.
    ///
    /// # Errors
    /// [`CaveError`] for porosity and parameters out of range and for openings that share voxels.
    pub fn new(
        lattice: &Lattice,
        law: GrowthLaw,
        openings: Openings,
        porosity: &[f64],
    ) -> Result<Self, CaveError> {
        law.dissolution.check()?;
        if let Motion::Pressure { rates, .. } = law.motion {
            rates.check()?;
        }
        openings.check()?;
        let voxels = lattice.node_count();
        check_values("porosity", porosity, voxels, [0.0, 1.0])?;
        Ok(Self {
            law,
            openings,
            passages: Passages::new(lattice, porosity, law.passage),
            avalanches: Avalanches::new(),
            contributions: Contributions::new(voxels),
        })
    }

    /// The pressure before anything breaks through, settled around the sinks; 0 everywhere where water
    /// falls.
    ///
    /// # Errors
    /// [`CaveError`] as of [`weighted_distances`].
    pub fn first_pressure(
        &mut self,
        lattice: &Lattice,
        porosity: &[f64],
    ) -> Result<Vec<f64>, CaveError> {
        let Motion::Pressure { rates, most, fall, .. } = self.law.motion else {
            return Ok(vec![0.0; lattice.node_count()]);
        };
        let seeds = self.openings.seeds();
        let distances = weighted_distances(lattice, |node| porosity[node] > 0.0, &seeds)?;
        let mut pressure = initial_pressure(&distances, most, fall);
        for &sink in &self.openings.sinks {
            pressure[sink] = 0.0;
        }
        let passage = |node: usize| self.passages.contains(node);
        self.avalanches.settle(lattice, &mut pressure, rates, passage)?;
        Ok(pressure)
    }

    /// An iteration: sources bring water, it flows, sinks take it, rock dissolves, channels open, and
    /// pressure falls around them.
    ///
    /// # Errors
    /// [`CaveError::March`] if the pressure is not a number somewhere, [`CaveError::Length`] if the
    /// water is that of another lattice.
    pub fn step(
        &mut self,
        lattice: &Lattice,
        water: &mut PoreWater,
        porosity: &mut [f64],
        pressure: &mut [f64],
    ) -> Result<Turnover, CaveError> {
        check_length("pore_water", water.voxels(), lattice.node_count())?;
        match self.law.motion {
            Motion::Pressure { rates, exponent, .. } => {
                let rule = DownPressure { pressure, exponent };
                let (turnover, opened) = self.flow(lattice, &rule, water, porosity);
                let passage = |node: usize| self.passages.contains(node);
                self.avalanches.follow(lattice, pressure, rates, passage, &opened)?;
                Ok(turnover)
            }
            Motion::Falling => Ok(self.flow(lattice, &Falling, water, porosity).0),
        }
    }

    /// Water and erosion of an iteration; also the voxels that opened.
    fn flow(
        &mut self,
        lattice: &Lattice,
        rule: &impl Rule,
        water: &mut PoreWater,
        porosity: &mut [f64],
    ) -> (Turnover, Vec<usize>) {
        let Self { law, openings, passages, contributions, .. } = self;
        let (mut fed, mut drained) = (0, 0);
        water.begin_iteration();
        for (nodes, &strength) in openings.sources.iter().zip(&openings.strengths) {
            for &node in nodes {
                fed += u64::from(water.feed(porosity, node, strength));
            }
        }
        for _ in 0..law.sweeps {
            water.sweep(lattice, rule, porosity);
            for &sink in &openings.sinks {
                drained += u64::from(water.drain(sink));
            }
        }
        let rock = (porosity, law.passage);
        let dissolved = law.dissolution.dissolve(lattice, water, rule, rock, contributions);
        for &node in &dissolved.opened {
            passages.open(lattice, node);
        }
        let turnover = Turnover {
            fed: fed as f64 / UNIT,
            drained: drained as f64 / UNIT,
            dissolved: dissolved.volume,
        };
        (turnover, dissolved.opened)
    }

    /// Where water comes in and goes out.
    pub fn openings(&self) -> &Openings {
        &self.openings
    }

    /// The passages, and where water comes in and goes out.
    pub fn passages(&mut self) -> (&mut Passages, &Openings) {
        (&mut self.passages, &self.openings)
    }
}

#[cfg(test)]
#[path = "growth_tests.rs"]
mod tests;
