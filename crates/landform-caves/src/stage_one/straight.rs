//! Distances from sources by looking at every seed from every voxel.

use landform_graph::Lattice;

use super::zones::Seed;
use crate::place::between;

/// Seeds up to which looking at all of them is faster than a front.
const MOST_SEEDS: usize = 64;

/// The distances that a front finds, found without one where they are sure to come out the same: `None`
/// elsewhere. Infinite where the rock is closed.
///
/// The nearest seed of a voxel is that of the definition. A front gives a voxel this seed when voxels
/// of the same seed lead there, so a flood over them tells whether it does. Which of two equally near
/// seeds a front gives a voxel hangs on its order, so such voxels are not flooded over.
pub(super) fn straight_distances(
    lattice: &Lattice,
    open: impl Fn(usize) -> bool,
    seeds: &[Seed],
    max_pressure: f64,
) -> Option<Vec<f64>> {
    let nodes = lattice.node_count();
    if seeds.len() > MOST_SEEDS || seeds.iter().any(|seed| seed.node >= nodes) {
        return None;
    }
    let mut nearest = Vec::with_capacity(nodes);
    for layer in 0..lattice.depth() {
        for row in 0..lattice.height() {
            let voxels = (0..lattice.width()).map(|column| [column, row, layer]);
            nearest.extend(voxels.map(|voxel| Nearest::of(lattice, voxel, seeds, max_pressure)));
        }
    }
    let reached = flood(lattice, &open, seeds, &nearest);
    let is_sure = (0..nodes).all(|node| reached[node] || !open(node));
    is_sure.then(|| {
        let distance = |(nearest, reached): (Nearest, bool)| match reached {
            true => nearest.distance,
            false => f64::INFINITY,
        };
        nearest.into_iter().zip(reached).map(distance).collect()
    })
}

/// The seed nearest to a voxel.
#[derive(Clone, Copy)]
struct Nearest {
    /// Weighted distance.
    distance: f64,
    /// Number of the seed, the first of several.
    seed: u32,
    /// Whether another seed is as near.
    is_shared: bool,
}

impl Nearest {
    fn of(lattice: &Lattice, voxel: [usize; 3], seeds: &[Seed], max_pressure: f64) -> Self {
        let mut nearest = Self { distance: f64::INFINITY, seed: 0, is_shared: false };
        for (number, seed) in seeds.iter().enumerate() {
            let distance = weighted(lattice, voxel, seed, max_pressure);
            if distance < nearest.distance {
                nearest = Self { distance, seed: number as u32, is_shared: false };
            } else if distance == nearest.distance {
                nearest.is_shared = true;
            }
        }
        nearest
    }
}

/// Distance to a seed times the largest pressure over its own.
#[inline]
fn weighted(lattice: &Lattice, voxel: [usize; 3], seed: &Seed, max_pressure: f64) -> f64 {
    let way = between(lattice, voxel, lattice.coordinates(seed.node));
    max_pressure / seed.pressure * way.length()
}

/// Which open voxels their nearest seed reaches over voxels of its own.
fn flood(
    lattice: &Lattice,
    open: &impl Fn(usize) -> bool,
    seeds: &[Seed],
    nearest: &[Nearest],
) -> Vec<bool> {
    let mut reached = vec![false; nearest.len()];
    let mut waiting: Vec<u32> = Vec::new();
    for seed in seeds {
        reached[seed.node] = true;
        if !nearest[seed.node].is_shared {
            waiting.push(seed.node as u32);
        }
    }
    while let Some(from) = waiting.pop() {
        let number = nearest[from as usize].seed;
        for edge in lattice.neighbours(from as usize) {
            let there = nearest[edge.node];
            if there.seed == number && !reached[edge.node] && open(edge.node) {
                reached[edge.node] = true;
                if !there.is_shared {
                    waiting.push(edge.node as u32);
                }
            }
        }
    }
    reached
}
