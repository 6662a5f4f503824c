//! The sand-like model of figure 3.1: slopes that slip and shake the slopes around.

use landform_graph::Lattice;
use landform_sim::checkpoint::{Damage, Keep, Loader, Saver};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SandpileError;
use super::disc::Disc;

/// Stands for "no node".
const NOBODY: u32 = u32::MAX;

/// Sand that slips where it is too steep and makes the sand around slip too (thesis, section
/// 3.1.3 and figure 3.1, top row).
///
/// As in Duran's pile, the surface is made of slabs and a slab that moves drags along the one
/// underneath. In each iteration
/// 1. a node **oversteepens** if the slope to its steepest lower neighbour exceeds the angle of
///    repose; nodes that were shaken by the iteration before need only exceed `shaken_deg`;
/// 2. it **slips**: two slabs (or `slabs_together`) move to that neighbour. Each node takes in
///    from one neighbour at most, the steepest, so no hollow is heaped up into a peak;
/// 3. each slip **shakes** all nodes within `radius_m`. That is the avalanching of definition 8:
///    a slip makes slips around it likelier.
///
/// A slip needs a fall of more than the slabs that move, so every slip lowers the sum of squared
/// heights and the sand comes to rest.
///
/// Conserved: sand. Source: thesis, section 3.1.3, which leaves the rule open; this one is the
/// simplest that has its properties.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SandLike {
    /// Steepest slope at rest.
    #[schemars(range(min = 0.0, max = 89.0), extend("x-unit" = "deg"))]
    pub repose_deg: f64,
    /// Steepest slope of shaken sand, at most the angle of repose.
    #[schemars(range(min = 0.0, max = 89.0), extend("x-unit" = "deg"))]
    pub shaken_deg: f64,
    /// Thickness of a slab.
    #[schemars(range(min = 1e-9, max = 1e12), extend("x-unit" = "m"))]
    pub slab_m: f64,
    /// Number of slabs that move together.
    #[schemars(range(min = 1, max = 1000))]
    pub slabs_together: u32,
    /// Avalanching radius: how far a slip shakes the sand.
    #[schemars(range(min = 0.0), extend("x-unit" = "m"))]
    pub radius_m: f64,
}

impl Default for SandLike {
    fn default() -> Self {
        Self { repose_deg: 33.0, shaken_deg: 25.0, slab_m: 0.5, slabs_together: 2, radius_m: 50.0 }
    }
}

/// What the sand-like model needs beside the heights: which nodes are shaken, and working
/// space.
#[derive(Clone, Debug)]
pub struct SandState {
    /// Number of slips of the last iteration within the radius of each node. This is all that
    /// a later iteration depends on.
    pub shaken: Vec<u32>,
    /// Made by the first step where it is missing.
    work: Option<Work>,
}

/// What one step needs that none depends on.
#[derive(Clone, Debug)]
struct Work {
    disc: Disc,
    rises: [f64; 2],
    targets: Vec<u32>,
    givers: Vec<u32>,
    slipped: Vec<u8>,
}

impl Keep for SandState {
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        to.array("shaken", &self.shaken);
    }

    fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
        Ok(Self { shaken: from.array("shaken")?.to_vec(), work: None })
    }
}

impl SandLike {
    /// Checks the parameters and makes the state of sand at rest.
    ///
    /// # Errors
    /// [`SandpileError`] for volumes and for parameters out of range.
    pub fn state(&self, lattice: &Lattice) -> Result<SandState, SandpileError> {
        let refuse = |parameter, value, expected| {
            Err(SandpileError::Parameter { parameter, value, expected })
        };
        if !(0.0..=89.0).contains(&self.repose_deg) {
            return refuse("repose_deg", self.repose_deg, "from 0 to 89");
        }
        if !(0.0..=self.repose_deg).contains(&self.shaken_deg) {
            return refuse("shaken_deg", self.shaken_deg, "from 0 to repose_deg");
        }
        if !(1e-9..=1e12).contains(&self.slab_m) {
            return refuse("slab_m", self.slab_m, "from 1e-9 to 1e12");
        }
        if !(1..=1000).contains(&self.slabs_together) {
            return refuse("slabs_together", self.slabs_together.into(), "from 1 to 1000");
        }
        let shaken = vec![0; lattice.node_count()];
        Ok(SandState { shaken, work: Some(self.work(lattice)?) })
    }

    fn work(&self, lattice: &Lattice) -> Result<Work, SandpileError> {
        let nodes = lattice.node_count();
        Ok(Work {
            disc: Disc::new(lattice, self.radius_m)?,
            rises: [self.repose_deg, self.shaken_deg].map(|angle| angle.to_radians().tan()),
            targets: vec![NOBODY; nodes],
            givers: vec![NOBODY; nodes],
            slipped: vec![0; nodes],
        })
    }

    /// Runs one iteration on `heights` (metres, one a node) and returns the number of slips; 0
    /// means that the sand is at rest. Same bits on any number of threads.
    ///
    /// # Errors
    /// [`SandpileError::Length`] if `heights` is not of the lattice that `state` was made for.
    pub fn step(
        &self,
        lattice: &Lattice,
        state: &mut SandState,
        heights: &mut [f64],
    ) -> Result<usize, SandpileError> {
        let sites = lattice.node_count();
        if heights.len() != sites || state.shaken.len() != sites {
            return Err(SandpileError::Length { values: heights.len(), sites });
        }
        let thickness = self.slab_m * f64::from(self.slabs_together);
        let SandState { shaken, work } = state;
        let work = match work {
            Some(work) => work,
            None => work.insert(self.work(lattice)?),
        };
        work.choose_targets(lattice, heights, thickness, shaken);
        work.choose_givers(lattice, heights);
        let Work { targets, givers, .. } = &*work;
        heights.par_iter_mut().enumerate().for_each(|(node, height)| {
            let target = targets[node];
            let gives = target != NOBODY && givers[target as usize] == node as u32;
            let takes = givers[node] != NOBODY;
            *height += thickness * (f64::from(u8::from(takes)) - f64::from(u8::from(gives)));
        });
        Ok(work.shake(lattice, shaken))
    }
}

impl Work {
    /// Finds the nodes that are too steep and where each would slip to.
    fn choose_targets(
        &mut self,
        lattice: &Lattice,
        heights: &[f64],
        thickness: f64,
        shaken: &[u32],
    ) {
        let Self { targets, rises, .. } = self;
        targets.par_iter_mut().zip(shaken).enumerate().for_each(|(node, (target, shaken))| {
            let mut steepest = if *shaken > 0 { rises[1] } else { rises[0] };
            *target = NOBODY;
            for edge in lattice.neighbours(node) {
                let fall = heights[node] - heights[edge.node];
                if fall > thickness && fall / edge.distance > steepest {
                    steepest = fall / edge.distance;
                    *target = edge.node as u32;
                }
            }
        });
    }

    /// Lets each node take in from the steepest of those that would slip to it.
    fn choose_givers(&mut self, lattice: &Lattice, heights: &[f64]) {
        let Self { targets, givers, .. } = self;
        givers.par_iter_mut().enumerate().for_each(|(node, giver)| {
            let mut steepest = 0.0;
            *giver = NOBODY;
            for edge in lattice.neighbours(node) {
                let slope = (heights[edge.node] - heights[node]) / edge.distance;
                if targets[edge.node] == node as u32 && slope > steepest {
                    steepest = slope;
                    *giver = edge.node as u32;
                }
            }
        });
    }

    /// Marks what the slips shake and returns their number.
    fn shake(&mut self, lattice: &Lattice, shaken: &mut [u32]) -> usize {
        let Self { targets, givers, slipped, .. } = self;
        slipped.par_iter_mut().enumerate().for_each(|(node, slipped)| {
            let target = targets[node];
            *slipped = u8::from(target != NOBODY && givers[target as usize] == node as u32);
        });
        shaken.fill(0);
        self.disc.add_events(lattice, &self.slipped, shaken);
        self.slipped.iter().filter(|&&slipped| slipped == 1).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};
    use landform_synth::{Generator, WhiteNoise};

    fn lattice(side: usize) -> Lattice {
        let periodic = [Boundary::Periodic; 2];
        Lattice::plane([side, side], 10.0, Connectivity::Eight, periodic).unwrap()
    }

    fn noise(lattice: &Lattice) -> Vec<f64> {
        let noise = WhiteNoise { amplitude_m: 50.0, ..Default::default() };
        noise.generate(lattice, 1).unwrap()
    }

    #[test]
    fn sand_is_conserved_and_comes_to_rest_below_repose() {
        let lattice = lattice(64);
        let model = SandLike::default();
        let mut state = model.state(&lattice).unwrap();
        let mut heights = noise(&lattice);
        let before: f64 = heights.iter().sum();
        let size: f64 = heights.iter().map(|height| height.abs()).sum();
        let mut iterations = 0;
        while model.step(&lattice, &mut state, &mut heights).unwrap() > 0 {
            iterations += 1;
            assert!((heights.iter().sum::<f64>() - before).abs() < 1e-12 * size);
            assert!(iterations < 1000, "never at rest");
        }
        let steepest = model.repose_deg.to_radians().tan();
        for node in 0..heights.len() {
            for edge in lattice.neighbours(node) {
                let fall = heights[node] - heights[edge.node];
                assert!(fall <= steepest * edge.distance + 1e-9, "node {node}");
            }
        }
        assert!(iterations > 10);
    }

    /// Definition 8: a slope that holds alone slips after a slip nearby, and not after one
    /// beyond the radius.
    #[test]
    fn a_slip_makes_slips_within_the_radius_likelier() {
        let lattice = lattice(32);
        let model = SandLike { radius_m: 40.0, ..Default::default() };
        let between = 10.0 * 29.0_f64.to_radians().tan();
        let slips_with_trigger_at = |trigger: Option<usize>| {
            let mut heights = vec![0.0; lattice.node_count()];
            let gentle = lattice.node([16, 16, 0]);
            heights[gentle] = between;
            if let Some(column) = trigger {
                heights[lattice.node([column, 16, 0])] = 7.0;
            }
            let mut state = model.state(&lattice).unwrap();
            for _ in 0..2 {
                model.step(&lattice, &mut state, &mut heights).unwrap();
            }
            heights[gentle] < between
        };
        assert!(!slips_with_trigger_at(None));
        assert!(slips_with_trigger_at(Some(20)));
        assert!(!slips_with_trigger_at(Some(21)));
    }

    #[test]
    fn same_bits_on_any_number_of_threads() {
        let lattice = lattice(48);
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let model = SandLike::default();
                let mut state = model.state(&lattice).unwrap();
                let mut heights = noise(&lattice);
                for _ in 0..40 {
                    model.step(&lattice, &mut state, &mut heights).unwrap();
                }
                (heights, state.shaken)
            })
        };
        assert_eq!(on(1), on(8));
    }

    #[test]
    fn parameters_out_of_range_are_refused() {
        let lattice = lattice(16);
        let usual = SandLike::default();
        for refused in [
            SandLike { repose_deg: 90.0, ..usual },
            SandLike { shaken_deg: 34.0, ..usual },
            SandLike { slab_m: 0.0, ..usual },
            SandLike { slabs_together: 0, ..usual },
            SandLike { radius_m: 80.0, ..usual },
            SandLike { repose_deg: f64::NAN, ..usual },
        ] {
            assert!(refused.state(&lattice).is_err(), "{refused:?}");
        }
        let mut state = usual.state(&lattice).unwrap();
        assert!(usual.step(&lattice, &mut state, &mut [0.0; 3]).is_err());
    }
}
