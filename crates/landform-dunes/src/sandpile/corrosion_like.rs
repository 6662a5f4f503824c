//! The corrosion-like model of figure 3.1: exposed rock that disintegrates and weakens the rock
//! around.

use landform_graph::Lattice;
use landform_sim::random::{RandomStream, unit};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SandpileError;
use super::disc::Disc;

/// Rock that corrodes where it is exposed, and exposes more by it (thesis, section 3.1.3 and
/// figure 3.1, bottom row).
///
/// As on Sapoval's coast, every block of rock has a random resistance, evenly spread from 0 to
/// 1, and disintegrates once its exposure exceeds it. In each iteration the exposure of the
/// uppermost block of a node is
///
/// `top + side * (missing neighbours / neighbours) + avalanching * (events / nodes in the disc)`
///
/// A neighbour is missing where the ground beside the block lies below it, in part if only a
/// part of the block sticks out. Events are the blocks that disintegrated within `radius_m`
/// since the block came to the surface: the avalanching of definition 8. `avalanching` is the
/// number of blocks that an event takes with it on average, so avalanches die out below 1 and
/// are of all sizes close to it.
///
/// Not conserved: rock leaves; [`CorrosionState::removed`] counts the blocks. Source: thesis,
/// section 3.1.3, which leaves the rule open; this one is the simplest that has its properties.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CorrosionLike {
    /// Thickness of a block.
    #[schemars(range(min = 1e-9, max = 1e12), extend("x-unit" = "m"))]
    pub block_m: f64,
    /// Exposure of a block through its upper face.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub top: f64,
    /// Exposure of a block whose neighbours are all missing.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub side: f64,
    /// Number of blocks that one event takes with it.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub avalanching: f64,
    /// Avalanching radius: how far an event weakens the rock.
    #[schemars(range(min = 0.0), extend("x-unit" = "m"))]
    pub radius_m: f64,
}

impl Default for CorrosionLike {
    fn default() -> Self {
        Self { block_m: 1.0, top: 0.001, side: 0.3, avalanching: 0.5, radius_m: 50.0 }
    }
}

/// What the corrosion-like model needs beside the heights.
#[derive(Clone, Debug)]
pub struct CorrosionState {
    /// Blocks that have disintegrated at each node.
    pub removed: Vec<u32>,
    /// Events within the radius of each node since its uppermost block came to the surface.
    pub weakened: Vec<u32>,
    stream: RandomStream,
    disc: Disc,
    events: Vec<u8>,
}

impl CorrosionLike {
    /// Checks the parameters and makes the state of fresh rock, whose resistances depend on
    /// `seed`.
    ///
    /// # Errors
    /// [`SandpileError`] for volumes and for parameters out of range.
    pub fn state(&self, lattice: &Lattice, seed: u64) -> Result<CorrosionState, SandpileError> {
        let share = |parameter, value: f64| match (0.0..=1.0).contains(&value) {
            true => Ok(()),
            false => Err(SandpileError::Parameter { parameter, value, expected: "from 0 to 1" }),
        };
        share("top", self.top)?;
        share("side", self.side)?;
        share("avalanching", self.avalanching)?;
        if !(1e-9..=1e12).contains(&self.block_m) {
            let (parameter, value) = ("block_m", self.block_m);
            return Err(SandpileError::Parameter { parameter, value, expected: "1e-9 to 1e12" });
        }
        let nodes = lattice.node_count();
        Ok(CorrosionState {
            removed: vec![0; nodes],
            weakened: vec![0; nodes],
            stream: RandomStream::new(seed, "rock resistance"),
            disc: Disc::new(lattice, self.radius_m)?,
            events: vec![0; nodes],
        })
    }

    /// Runs one iteration on `heights` (metres, one a node) and returns the number of blocks
    /// that disintegrated; 0 means that the rock is at rest. Same bits on any number of threads.
    ///
    /// # Errors
    /// [`SandpileError::Length`] if `heights` is not of the lattice that `state` was made for.
    pub fn step(
        &self,
        lattice: &Lattice,
        state: &mut CorrosionState,
        heights: &mut [f64],
    ) -> Result<usize, SandpileError> {
        let sites = lattice.node_count();
        if heights.len() != sites || state.removed.len() != sites {
            return Err(SandpileError::Length { values: heights.len(), sites });
        }
        let CorrosionState { removed, weakened, stream, disc, events } = state;
        let per_event = self.avalanching / disc.area() as f64;
        let ground: &[f64] = heights;
        events.par_iter_mut().enumerate().for_each(|(node, event)| {
            let exposure = self.top
                + self.side * self.missing_neighbours(lattice, ground, node)
                + per_event * f64::from(weakened[node]);
            let words = stream.block(u64::from(removed[node]), node, 0);
            *event = u8::from(unit(words[0]) < exposure);
        });
        for (node, &event) in events.iter().enumerate() {
            if event == 1 {
                removed[node] += 1;
                heights[node] -= self.block_m;
                weakened[node] = 0;
            }
        }
        disc.add_events(lattice, events, weakened);
        Ok(events.iter().filter(|&&event| event == 1).count())
    }

    /// Share of the neighbours that are missing beside the uppermost block of a node.
    fn missing_neighbours(&self, lattice: &Lattice, heights: &[f64], node: usize) -> f64 {
        let [mut missing, mut neighbours] = [0.0; 2];
        for edge in lattice.neighbours(node) {
            missing += ((heights[node] - heights[edge.node]) / self.block_m).clamp(0.0, 1.0);
            neighbours += 1.0;
        }
        missing / f64::max(neighbours, 1.0)
    }
}
