//! The corrosion-like model of figure 3.1: exposed rock that disintegrates and weakens the rock
//! around.

use landform_graph::Lattice;
use landform_sim::checkpoint::{Damage, Keep, Loader, Saver};
use landform_sim::random::{RandomStream, unit};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SandpileError;
use super::disc::Disc;

/// Rock that corrodes where it is exposed, and exposes more by it (thesis, section 3.1.3 and
/// figure 3.1, bottom row).
///
/// As on Sapoval's coast, every block of rock has a random resistance from 0 to 1, and
/// disintegrates once its exposure exceeds it. A part of the resistance is that of the node, as
/// joints run through many layers, and a part is the block's own:
///
/// `resistance = jointing * random(node) + (1 - jointing) * random(node, layer)`
///
/// In each iteration the exposure of the uppermost block of a node is
///
/// `top + side * (missing neighbours / neighbours) + avalanching * (events / nodes in the disc)`
///
/// A neighbour is missing where the ground beside the block lies below it, in part if only a
/// part of the block sticks out. Events are the blocks that disintegrated within `radius_m`
/// since the block came to the surface: the avalanching of definition 8.
///
/// With little exposure avalanches die out and the rock comes to rest. With more, pits grow from
/// the weakest nodes along joints, and go on growing: the number of iterations decides how far.
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
    /// Exposure of a block after an event at every node within the radius.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub avalanching: f64,
    /// Share of the resistance that all blocks of a node have in common.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub jointing: f64,
    /// Avalanching radius: how far an event weakens the rock.
    #[schemars(range(min = 0.0), extend("x-unit" = "m"))]
    pub radius_m: f64,
}

impl Default for CorrosionLike {
    fn default() -> Self {
        Self { block_m: 1.0, top: 0.04, side: 1.0, avalanching: 0.2, jointing: 0.7, radius_m: 30.0 }
    }
}

/// What the corrosion-like model needs beside the heights.
#[derive(Clone, Debug)]
pub struct CorrosionState {
    /// Blocks that have disintegrated at each node.
    pub removed: Vec<u32>,
    /// Events within the radius of each node since its uppermost block came to the surface.
    pub weakened: Vec<u32>,
    seed: u64,
    /// Made by the first step where it is missing.
    work: Option<Work>,
}

/// What one step needs that none depends on.
#[derive(Clone, Debug)]
struct Work {
    stream: RandomStream,
    disc: Disc,
    events: Vec<u8>,
}

impl Keep for CorrosionState {
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        to.array("removed", &self.removed);
        to.array("weakened", &self.weakened);
        to.value("seed", &self.seed);
    }

    fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
        let removed = from.array("removed")?.to_vec();
        let weakened = from.array_of("weakened", removed.len())?.to_vec();
        Ok(Self { removed, weakened, seed: from.value("seed")?, work: None })
    }
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
        share("jointing", self.jointing)?;
        if !(1e-9..=1e12).contains(&self.block_m) {
            let (parameter, value) = ("block_m", self.block_m);
            return Err(SandpileError::Parameter { parameter, value, expected: "1e-9 to 1e12" });
        }
        let nodes = lattice.node_count();
        Ok(CorrosionState {
            removed: vec![0; nodes],
            weakened: vec![0; nodes],
            seed,
            work: Some(self.work(lattice, seed)?),
        })
    }

    fn work(&self, lattice: &Lattice, seed: u64) -> Result<Work, SandpileError> {
        Ok(Work {
            stream: RandomStream::new(seed, "rock resistance"),
            disc: Disc::new(lattice, self.radius_m)?,
            events: vec![0; lattice.node_count()],
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
        let CorrosionState { removed, weakened, seed, work } = state;
        let Work { stream, disc, events } = match work {
            Some(work) => work,
            None => work.insert(self.work(lattice, *seed)?),
        };
        let per_event = self.avalanching / disc.area() as f64;
        let ground: &[f64] = heights;
        events.par_iter_mut().enumerate().for_each(|(node, event)| {
            let exposure = self.top
                + self.side * self.missing_neighbours(lattice, ground, node)
                + per_event * f64::from(weakened[node]);
            *event = u8::from(self.resistance(stream, node, removed[node]) < exposure);
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

    /// Resistance of a block: `layer` is the number of blocks that lay above it.
    fn resistance(&self, stream: &RandomStream, node: usize, layer: u32) -> f64 {
        let of_node = unit(stream.block(0, node, 1)[0]);
        let of_block = unit(stream.block(u64::from(layer), node, 0)[0]);
        self.jointing * of_node + (1.0 - self.jointing) * of_block
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

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    fn lattice(side: usize) -> Lattice {
        let periodic = [Boundary::Periodic; 2];
        Lattice::plane([side, side], 10.0, Connectivity::Eight, periodic).unwrap()
    }

    fn run(model: &CorrosionLike, side: usize, iterations: usize) -> (Vec<f64>, CorrosionState) {
        let lattice = lattice(side);
        let mut state = model.state(&lattice, 5).unwrap();
        let mut heights = vec![100.0; lattice.node_count()];
        for _ in 0..iterations {
            model.step(&lattice, &mut state, &mut heights).unwrap();
        }
        (heights, state)
    }

    #[test]
    fn the_ledger_holds_every_block() {
        let model = CorrosionLike { block_m: 0.5, ..Default::default() };
        let (heights, state) = run(&model, 64, 40);
        for (height, &removed) in heights.iter().zip(&state.removed) {
            assert_eq!(*height, 100.0 - 0.5 * f64::from(removed));
        }
        assert!(state.removed.iter().any(|&removed| removed > 10), "pits");
        assert!(state.removed.contains(&0), "and untouched ground");
    }

    #[test]
    fn rock_that_is_not_exposed_rests() {
        let model = CorrosionLike { top: 0.0, ..Default::default() };
        assert!(run(&model, 32, 5).1.removed.iter().all(|&removed| removed == 0));
        // Few blocks go at first, and they take hardly any with them.
        let model = CorrosionLike { side: 0.2, avalanching: 0.0, ..Default::default() };
        let (mut heights, mut state) = run(&model, 32, 60);
        assert_eq!(model.step(&lattice(32), &mut state, &mut heights), Ok(0));
        assert!(state.removed.iter().any(|&removed| removed > 0));
    }

    /// Definition 8: after an event, blocks within the radius disintegrate that would have held,
    /// and none beyond it.
    #[test]
    fn an_event_makes_events_within_the_radius_likelier() {
        let lattice = lattice(64);
        let model = CorrosionLike { top: 0.0, side: 0.0, radius_m: 100.0, ..Default::default() };
        let mut state = model.state(&lattice, 5).unwrap();
        let mut events = vec![0; lattice.node_count()];
        // As many as weaken the middle by more than the strongest block can bear.
        let center = lattice.node([32, 32, 0]);
        events[center] = 1;
        let disc = Disc::new(&lattice, model.radius_m).unwrap();
        for _ in 0..6 * disc.area() {
            disc.add_events(&lattice, &events, &mut state.weakened);
        }
        let mut heights = vec![0.0; lattice.node_count()];
        assert_eq!(model.step(&lattice, &mut state, &mut heights), Ok(disc.area()));
        for (node, height) in heights.iter().enumerate() {
            let [x, y, _] = lattice.coordinates(node);
            let near = x.abs_diff(32).pow(2) + y.abs_diff(32).pow(2) <= 100;
            assert_eq!(*height < 0.0, near, "node {node}");
        }
    }

    #[test]
    fn same_bits_on_any_number_of_threads() {
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let (heights, state) = run(&CorrosionLike::default(), 48, 30);
                (heights, state.removed, state.weakened)
            })
        };
        assert_eq!(on(1), on(8));
    }

    #[test]
    fn parameters_out_of_range_are_refused() {
        let lattice = lattice(16);
        let usual = CorrosionLike::default();
        for refused in [
            CorrosionLike { block_m: 0.0, ..usual },
            CorrosionLike { top: -0.1, ..usual },
            CorrosionLike { side: 1.1, ..usual },
            CorrosionLike { avalanching: f64::NAN, ..usual },
            CorrosionLike { jointing: 2.0, ..usual },
            CorrosionLike { radius_m: 80.0, ..usual },
        ] {
            assert!(refused.state(&lattice, 1).is_err(), "{refused:?}");
        }
        let mut state = usual.state(&lattice, 1).unwrap();
        assert!(usual.step(&lattice, &mut state, &mut [0.0; 3]).is_err());
    }
}
