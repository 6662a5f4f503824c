//! Sweeps by definition, over the neighbours of a lattice, for tests.

use landform_graph::{Edge, Lattice};

use super::PipeSettings;
use super::pipes::{most_units, part_of};
use super::sharing::Sharing;
use super::units::UNIT_M;

/// Water columns without frame and marks: ground and level in units.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PlainColumns {
    pub(super) bed: Vec<i64>,
    pub(super) level: Vec<i64>,
    pub(super) received: Vec<i64>,
}

/// A sweep by rule `S`: see [`super::exchange`].
pub(super) fn sweep<S: Sharing>(lattice: &Lattice, columns: &mut PlainColumns) {
    let level = columns.level.clone();
    let nodes = 0..level.len();
    let neighbours = |node: usize| lattice.neighbours(node).map(|edge: Edge| edge.node);
    let share = |node: usize| {
        let around: Vec<i64> = neighbours(node).map(|other| level[other]).collect();
        S::share(level[node], level[node] - columns.bed[node], &around)
    };
    let decided: Vec<_> = nodes.clone().map(share).collect();
    let offer = |giver: usize, to: usize| S::gift(decided[giver].0, level[giver], level[to]);
    let part = |node: usize| {
        let givers = neighbours(node).filter(|&giver| offer(giver, node) > 0);
        let highest = givers.map(|giver| level[giver] - decided[giver].1).max()?;
        let offered: i64 = neighbours(node).map(|giver| offer(giver, node)).sum();
        let room = (highest - level[node]).max(0);
        (room < offered).then(|| room as f64 / offered as f64)
    };
    let parts: Vec<Option<f64>> = nodes.clone().map(part).collect();
    for giver in nodes {
        for to in neighbours(giver) {
            let offered = offer(giver, to);
            let taken = parts[to].map_or(offered, |part| (offered as f64 * part) as i64);
            columns.level[giver] -= taken;
            columns.level[to] += taken;
            columns.received[to] += taken;
        }
    }
}

/// A step of pipes: listing 4.3 of the thesis.
pub(super) fn pipes(
    lattice: &Lattice,
    settings: PipeSettings,
    columns: &mut PlainColumns,
    flows: &mut [f64],
) {
    let area = lattice.spacing().powi(2);
    let moved = settings.step_s / area / UNIT_M;
    let friction = settings.persistence.powf(settings.step_s);
    let mut parts = vec![1.0; columns.level.len()];
    for node in 0..columns.level.len() {
        let mut volume = 0;
        for edge in lattice.neighbours(node) {
            let push =
                settings.step_s * settings.cross_section * area * 9.81 * UNIT_M / edge.distance;
            let fall = (columns.level[node] - columns.level[edge.node]) as f64;
            let flow = &mut flows[lattice.slot(node, &edge)];
            *flow = friction * *flow + push * fall;
            volume += most_units(*flow, moved);
        }
        parts[node] = part_of(columns.level[node] - columns.bed[node], volume);
    }
    for node in 0..columns.level.len() {
        for edge in lattice.neighbours(node) {
            let flow = &mut flows[lattice.slot(node, &edge)];
            *flow *= if *flow > 0.0 { parts[node] } else { parts[edge.node] };
            if *flow > 0.0 {
                let amount = (*flow * moved) as i64;
                columns.level[node] -= amount;
                columns.level[edge.node] += amount;
                columns.received[edge.node] += amount;
            }
        }
    }
}
