//! The same pressure in three other ways, as they are written down.

use landform_graph::Lattice;
use landform_graph::marching::Front;

use super::Rates;

/// Pressure by sweeps over all edges until none is too steep: the definition.
pub(super) fn by_sweeps(lattice: &Lattice, pressure: &mut [f64], rates: Rates, channel: &[bool]) {
    loop {
        let mut changed = false;
        for node in 0..lattice.node_count() {
            for edge in lattice.neighbours(node) {
                let allowed = pressure[node] + rates.rise(node, &edge, |node| channel[node]);
                changed |= allowed < pressure[edge.node];
                pressure[edge.node] = pressure[edge.node].min(allowed);
            }
        }
        if !changed {
            return;
        }
    }
}

/// Thesis, listing 5.2: a front with a time that is 0 where pressure was lowered.
pub(super) fn by_front(
    lattice: &Lattice,
    pressure: &mut [f64],
    rates: Rates,
    channel: &[bool],
    starts: &[usize],
) {
    let starts: Vec<(usize, f64)> = starts.iter().map(|&node| (node, 0.0)).collect();
    let marched = Front::new().march(lattice, &starts, |from, edge| {
        let new_pressure = pressure[from] + rates.rise(from, edge, |node| channel[node]);
        (new_pressure < pressure[edge.node]).then(|| {
            pressure[edge.node] = new_pressure;
            0.0
        })
    });
    assert!(marched.is_ok());
}

/// Thesis, listing 5.4: rounds over the whole domain, without a heap. The listing adds every site
/// once, as its pressure is lowered little by little; here a site whose neighbour fell again returns
/// to the front.
pub(super) fn by_rounds(
    lattice: &Lattice,
    pressure: &mut [f64],
    rates: Rates,
    channel: &[bool],
    sinks: &[usize],
) {
    let mut front = vec![false; lattice.node_count()];
    sinks.iter().for_each(|&sink| front[sink] = true);
    while front.contains(&true) {
        let mut transition = vec![false; lattice.node_count()];
        for node in (0..lattice.node_count()).filter(|&node| front[node]) {
            for edge in lattice.neighbours(node) {
                let allowed = pressure[node] + rates.rise(node, &edge, |node| channel[node]);
                if allowed < pressure[edge.node] {
                    pressure[edge.node] = allowed;
                    transition[edge.node] = true;
                }
            }
        }
        front = transition;
    }
}
