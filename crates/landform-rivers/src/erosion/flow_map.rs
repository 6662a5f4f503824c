//! The flow f of equation 4.5: of the water itself, and added beside large rivers.

use landform_graph::Lattice;
use rayon::prelude::*;

use super::HydraulicErosion;

/// The flow f of equation 4.5, one value a node, from 0 to `(w_a + w_c)^m`: see
/// [`HydraulicErosion`]. `bed` holds elevations and `received` the water that came in, in metres.
///
/// # Panics
/// If a slice is not as long as the lattice.
pub fn flow_map(
    lattice: &Lattice,
    settings: &HydraulicErosion,
    bed: &[f64],
    received: &[f64],
) -> Vec<f64> {
    let mut flow = relative_flow(received);
    let HydraulicErosion { avalanche_weight, flow_weight, flow_exponent, .. } = *settings;
    let combine = |added: f64, flow: f64| {
        let sum = avalanche_weight * added + flow_weight * flow;
        match flow_exponent {
            1.0 => sum,
            0.5 => sum.sqrt(),
            exponent => sum.powf(exponent),
        }
    };
    if avalanche_weight > 0.0 {
        let [fraction, radius_m] = [settings.avalanche_fraction, settings.avalanche_radius_m];
        let mut added = additional_flow(lattice, bed, &flow, fraction, radius_m);
        let most = added.par_iter().copied().reduce(|| 0.0, f64::max);
        if most > 1.0 {
            added.par_iter_mut().for_each(|added| *added /= most);
        }
        flow.par_iter_mut().zip(&added).for_each(|(flow, &added)| *flow = combine(added, *flow));
    } else {
        flow.par_iter_mut().for_each(|flow| *flow = combine(0.0, *flow));
    }
    flow
}

/// The flows f_c: what nodes received, as a share of the most that any did; all 0 where nothing
/// flows.
pub fn relative_flow(received: &[f64]) -> Vec<f64> {
    let most = received.par_iter().copied().reduce(|| 0.0, f64::max);
    let share = |&amount: &f64| if most > 0.0 { amount / most } else { 0.0 };
    received.par_iter().map(share).collect()
}

/// The flows f_a: every node with flow f_c adds `fraction` of it to all higher nodes within
/// `f_c radius_m` (thesis, section 4.3.1).
///
/// On a periodic axis a node reaches at most half way round. Cost: the nodes within reach of all
/// nodes; those that reach no neighbour cost nothing.
///
/// # Panics
/// If a slice is not as long as the lattice.
pub fn additional_flow(
    lattice: &Lattice,
    bed: &[f64],
    flow: &[f64],
    fraction: f64,
    radius_m: f64,
) -> Vec<f64> {
    let [width, height] = [lattice.width(), lattice.height()];
    let nodes_a_flow = radius_m / lattice.spacing();
    let rivers: Vec<Vec<River>> = (flow.par_chunks(width).zip(bed.par_chunks(width)))
        .map(|(flow, bed)| {
            let row = flow.iter().zip(bed).enumerate();
            row.map(|(column, (&flow, &height))| River {
                column,
                height,
                reach: flow * nodes_a_flow,
                gift: flow * fraction,
            })
            .filter(|river| river.reach >= 1.0)
            .collect()
        })
        .collect();
    let farthest = rivers.iter().flatten().map(|river| river.reach).fold(0.0, f64::max) as isize;
    let rows = farthest.min(most_steps(lattice, 1));
    let mut added = vec![0.0; bed.len()];
    added.par_chunks_mut(width).enumerate().for_each(|(row, added)| {
        let ground = &bed[row * width..][..width];
        for step in -rows..=rows {
            let other = lattice.offset([0, row, 0], [0, step, 0]);
            let rivers = other.map_or(&[][..], |node| &rivers[node / width % height]);
            rivers.iter().for_each(|river| river.add(lattice, step, ground, added));
        }
    });
    added
}

/// A node whose flow reaches neighbours.
struct River {
    column: usize,
    height: f64,
    /// How far it reaches, in nodes.
    reach: f64,
    /// What it adds.
    gift: f64,
}

impl River {
    /// Adds to a row that lies `step` rows from the river's, with this `ground`.
    fn add(&self, lattice: &Lattice, step: isize, ground: &[f64], added: &mut [f64]) {
        let squared = self.reach * self.reach - (step * step) as f64;
        if squared < 0.0 {
            return;
        }
        let beside = (squared.sqrt() as isize).min(most_steps(lattice, 0));
        for across in -beside..=beside {
            let column = self.column as isize + across;
            let width = ground.len() as isize;
            let column = match lattice.is_periodic(0) {
                true => column.rem_euclid(width),
                false if (0..width).contains(&column) => column,
                false => continue,
            };
            // The river is not higher than itself, so it adds nothing to its own node.
            if ground[column as usize] > self.height {
                added[column as usize] += self.gift;
            }
        }
    }
}

/// Most steps along an axis that never meet a node twice.
fn most_steps(lattice: &Lattice, axis: usize) -> isize {
    let size = lattice.size()[axis];
    (if lattice.is_periodic(axis) { (size - 1) / 2 } else { size }) as isize
}
