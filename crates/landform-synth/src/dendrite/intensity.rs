//! The light of a dendrite.

use landform_graph::Lattice;
use landform_graph::marching::Relaxation;

use super::grow::Grown;
use super::least_cost::{came_from, least_costs};
use super::unusable;
use super::weights::{EdgeWeights, WeightTable};
use crate::SynthError;

/// Light above this is full (Xu 2008, section 4.3).
const FULL: f64 = 0.7;

/// Light that is told from none.
const LEAST: f64 = 1e-4;

/// Brightness of every node of the lattice: `V = exp(-(c / (w r))^2)`, with c the cost of the
/// cheapest path to the dendrite, r the radius there in spacings and w the weight of a cheap edge; 1
/// where V is above 0.7 (Xu 2008, figure 4.8, with `T = 1 / r` and `alpha = w^-2`).
pub(super) fn intensity(
    lattice: &Lattice,
    table: &WeightTable,
    weights: &EdgeWeights,
    grown: &Grown,
    radii: &[f64],
) -> Result<Vec<f64>, SynthError> {
    let (nodes, cheap) = (lattice.node_count(), weights.cheap());
    let mut costs = vec![f64::INFINITY; nodes];
    let mut radius = vec![0.0_f64; nodes];
    for (&node, &own) in grown.nodes.iter().zip(radii) {
        costs[node] = 0.0;
        radius[node] = own / lattice.spacing();
    }
    let search = &mut Relaxation::new();
    least_costs(lattice, table, cheap, &grown.nodes, &mut costs, search)
        .map_err(|error| unusable("weights", error.to_string()))?;
    let thickest = grown.nodes.iter().map(|&node| radius[node]).fold(0.0, f64::max);
    let farthest = cheap * thickest * (-LEAST.ln()).sqrt();
    // In the order of their costs, so that the radius of the place before is known.
    let mut order: Vec<u32> =
        (0..nodes as u32).filter(|&node| costs[node as usize] <= farthest).collect();
    order.sort_by(|&a, &b| costs[a as usize].total_cmp(&costs[b as usize]).then(a.cmp(&b)));
    let mut light = vec![0.0; nodes];
    for node in order.into_iter().map(|node| node as usize) {
        if let Some(before) = came_from(lattice, table, &costs, node) {
            radius[node] = radius[before];
        }
        let away = costs[node] / (cheap * radius[node]).max(f64::MIN_POSITIVE);
        let value = (-away * away).exp();
        light[node] = match value {
            full if full > FULL => 1.0,
            dark if dark < LEAST => 0.0,
            value => value,
        };
    }
    Ok(light)
}
