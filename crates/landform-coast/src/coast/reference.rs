//! The coast model as the thesis tells it, node by node: for reading, and to test [`super::Coast`]
//! against.
//!
//! Every number is found anew from land and resistance. A coast agent asks the nodes around its
//! own for the artifacts of the sea, measures its piece of shore square by square, looks for
//! marks within a radius by breadth-first search, or walks along the shore side by side.

use std::collections::BTreeSet;

use landform_graph::{BreadthFirst, Lattice, Reach};

use super::compass::{SIDES, STEPS, diagonal, edges, left_of};
use super::error::check_length;
use super::regions::Rules;
use super::sides::{Side, next_side, side_of};
use super::{CoastError, CoastSettings, PARTS, Perimeter, Shore, spacings};

/// Whether a land node has a neighbour at sea.
pub fn is_coast(lattice: &Lattice, land: &[u8], node: usize) -> bool {
    land[node] > 0 && lattice.neighbours(node).any(|edge| land[edge.node] == 0)
}

/// The shore of a node in parts of a spacing: half of each piece, in the four squares around
/// it, that crosses one of its own edges.
pub fn shore_length(lattice: &Lattice, land: &[u8], node: usize) -> u64 {
    let [x, y, _] = lattice.coordinates(node);
    // Beyond an open border lies what lies at it.
    let place = |along: usize, axis: usize, step: isize| {
        let size = lattice.size()[axis] as isize;
        let moved = along as isize + step;
        let moved = if lattice.is_periodic(axis) { moved.rem_euclid(size) } else { moved };
        moved.clamp(0, size - 1) as usize
    };
    let is_land = |east: isize, south: isize| {
        land[lattice.node([place(x, 0, east), place(y, 1, south), 0])] > 0
    };
    if land[node] == 0 {
        return 0;
    }
    let mut length = 0;
    for [east, south] in [[1, -1], [-1, -1], [-1, 1], [1, 1]] {
        let [beside, below, across] = [is_land(east, 0), is_land(0, south), is_land(east, south)];
        // Two land nodes beside each other: a straight piece; else it cuts a corner.
        let straight = beside != below && !across;
        let half = if straight { PARTS / 2 } else { 181 };
        length += u64::from(half) * (u64::from(!beside) + u64::from(!below));
    }
    length
}

/// The shore of all marks within a radius of a node, in parts, by breadth-first search.
pub fn near_length(lattice: &Lattice, land: &[u8], node: usize, radius_m: f64) -> u64 {
    let mut search = BreadthFirst::new();
    let visits = search.collect(lattice, &[node], Reach::metres(radius_m), |_, _| true);
    visits.iter().map(|visit| shore_length(lattice, land, visit.node)).sum()
}

/// The shore that hangs together with a node within a radius, in parts, by walking along it.
pub fn contiguous_length(lattice: &Lattice, land: &[u8], node: usize, radius_m: f64) -> u64 {
    let shore = Shore::new(lattice, land);
    let mut backwards = vec![None; 4 * land.len()];
    for other in (0..land.len()).filter(|&other| land[other] > 0) {
        for direction in (0..4).filter(|d| shore.around(other) & SIDES & (1 << d) != 0) {
            let side = side_of(other, direction);
            if let Some((next, step, _)) = next_side(&shore, side, shore.place(other)) {
                backwards[next as usize] = Some((side, step.map(|along| -along)));
            }
        }
    }
    let forth = |side: Side| {
        let at = shore.place((side / 4) as usize);
        next_side(&shore, side, at).map(|(next, step, _)| (next, step))
    };
    let back = |side: Side| backwards[side as usize];
    let reach = radius_m / lattice.spacing();
    let mut found: Vec<BTreeSet<Side>> = Vec::new();
    for (side, from) in beginnings(&shore, node) {
        if found.iter().any(|run| run.contains(&side)) {
            continue;
        }
        let mut run = BTreeSet::from([side]);
        walk(side, from, reach, forth, &mut run);
        walk(side, from, reach, back, &mut run);
        found.push(run);
    }
    let length = |&side: &Side| {
        let node = (side / 4) as usize;
        u64::from(shore.side_lengths(node, shore.place(node))[(side % 4) as usize])
    };
    found.iter().flatten().map(length).sum()
}

/// Adds the sides that `next` leads to, one after the other, until one lies out of reach.
fn walk(
    mut side: Side,
    mut at: [isize; 2],
    reach: f64,
    next: impl Fn(Side) -> Option<(Side, [isize; 2])>,
    run: &mut BTreeSet<Side>,
) {
    while let Some((following, step)) = next(side) {
        at = [at[0] + step[0], at[1] + step[1]];
        let squared = (at[0] * at[0] + at[1] * at[1]) as f64;
        if squared > reach * reach || !run.insert(following) {
            return;
        }
        side = following;
    }
}

/// The sides from which a node looks along the shore, and the steps from it to their nodes: its
/// own, or those at its corners.
fn beginnings(shore: &Shore, node: usize) -> Vec<(Side, [isize; 2])> {
    let around = shore.around(node);
    let own: Vec<_> = (0..4)
        .filter(|direction| around >> direction & 1 == 1)
        .map(|direction| (side_of(node, direction), [0, 0]))
        .collect();
    if !own.is_empty() {
        return own;
    }
    let at = shore.place(node);
    let corners = around & edges(shore.lattice(), at);
    let beside = |side: usize| {
        let step = STEPS[side];
        let land = shore.lattice().offset([at[0], at[1], 0], [step[0], step[1], 0])?;
        Some((side_of(land, left_of(side)), step))
    };
    (0..4).filter(|&side| corners >> diagonal(side) & 1 == 1).filter_map(beside).collect()
}

/// One iteration of the model; gives the nodes that fell, in node order. `initial` is the whole
/// shore at the beginning in parts.
///
/// # Errors
/// See [`CoastSettings::validate`]; [`CoastError::Length`].
pub fn step(
    lattice: &Lattice,
    settings: &CoastSettings,
    land: &mut [u8],
    resistance: &mut [f64],
    initial: u64,
) -> Result<Vec<usize>, CoastError> {
    settings.validate(lattice)?;
    check_length("land", land.len(), lattice.node_count())?;
    check_length("resistance", resistance.len(), lattice.node_count())?;
    let rules = Rules::new(lattice, settings);
    let perimeter = |node: usize| match settings.perimeter {
        Perimeter::Whole => {
            let whole: u64 = (0..land.len()).map(|n| shore_length(lattice, land, n)).sum();
            whole as f64 / initial as f64
        }
        Perimeter::Near { radius_m } => {
            let near = near_length(lattice, land, node, radius_m);
            spacings(near) * lattice.spacing() / (2.0 * radius_m)
        }
        Perimeter::Contiguous { radius_m } => {
            let along = contiguous_length(lattice, land, node, radius_m);
            spacings(along) * lattice.spacing() / (2.0 * radius_m)
        }
    };
    let coast: Vec<usize> = (0..land.len()).filter(|&node| is_coast(lattice, land, node)).collect();
    let force = |node: &usize| rules.of(*node).force_at(perimeter(*node));
    let forces: Vec<f64> = coast.iter().map(force).collect();
    let mut fallen = Vec::new();
    for (&node, &force) in coast.iter().zip(&forces) {
        let exposed = lattice.neighbours(node).filter(|edge| land[edge.node] == 0).count();
        let degree =
            edges(lattice, [0, 1].map(|axis| lattice.coordinates(node)[axis])).count_ones();
        let exposure = (exposed as u32, degree);
        if settings.weakening.strength(resistance[node], exposure) < force {
            fallen.push(node);
        } else if let Some(wear) = settings.wear {
            resistance[node] = (resistance[node] - wear.rate * force).max(0.0);
        }
    }
    for &node in &fallen {
        land[node] = 0;
        resistance[node] = 0.0;
    }
    if let Some(wear) = settings.wear {
        for &node in &fallen {
            weaken(lattice, rules.of(node).weakening, wear.radius_m, node, land, resistance);
        }
    }
    Ok(fallen)
}

/// Takes material from the land around a node that fell, less and less up to a radius.
fn weaken(
    lattice: &Lattice,
    weakening: f64,
    radius_m: f64,
    node: usize,
    land: &[u8],
    resistance: &mut [f64],
) {
    let mut search = BreadthFirst::new();
    let visits = search.collect(lattice, &[node], Reach::metres(radius_m), |_, _| true);
    for visit in visits.iter().filter(|visit| land[visit.node] > 0) {
        let distance = f64::from(visit.moved[0]).hypot(f64::from(visit.moved[1]));
        let loss = weakening * (1.0 - distance / (radius_m / lattice.spacing()));
        resistance[visit.node] = (resistance[visit.node] - loss.max(0.0)).max(0.0);
    }
}
