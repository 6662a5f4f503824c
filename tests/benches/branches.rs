//! Branching lines.
//!
//! - `path field`: costs of the cheapest paths to all nodes of a lattice with random weights, a node,
//!   against Dijkstra's algorithm with a heap, written here on the same table of weights; both give
//!   the same bits;
//! - `fractal dendrite`: five rounds with some 8900 end points, with the drawing of its weights, an end
//!   point, against Dijkstra's algorithm anew in every round, on weights that are there;
//! - `aggregation`: particles without a lattice, a particle, against a textbook's walk on a lattice:
//!   step by step, with a launch circle and a killing circle, as many particles.

mod measure;

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::hint::black_box;
use std::path::Path;

use landform::graph::marching::Relaxation;
use landform::graph::{Boundary, Connectivity, Lattice};
use landform::sim::random::{RandomStream, unit};
use landform::synth::{
    Dendrite, EdgeWeights, Endpoints, Growth, Origin, Rounds, WeightTable, aggregate, least_costs,
};
use measure::{Effort, pairs, table};

fn main() {
    table("Branching lines", |effort| {
        for connectivity in [Connectivity::Four, Connectivity::Eight] {
            path_field(effort, &plane(600, connectivity), &format!("600x600, {connectivity:?}"));
        }
        let side = if effort == Effort::Full { 128 } else { 64 };
        let volume = Lattice::volume([side; 3], 1.0, Connectivity::Voxel26, [Boundary::Open; 3]);
        path_field(effort, &volume.expect("a lattice"), &format!("{side}^3, Voxel26"));
        fractal(effort);
        aggregation(effort);
    });
}

fn plane(side: usize, connectivity: Connectivity) -> Lattice {
    let open = [Boundary::Open; 2];
    Lattice::plane([side; 2], 1.0, connectivity, open).expect("a lattice")
}

fn weights(lattice: &Lattice) -> (EdgeWeights, WeightTable) {
    let weights = EdgeWeights::default();
    let table = weights.table(lattice, None, 1).expect("a table");
    (weights, table)
}

fn path_field(effort: Effort, lattice: &Lattice, name: &str) {
    let (weights, table) = weights(lattice);
    let middle = lattice.node(lattice.size().map(|nodes| nodes / 2));
    let nodes = lattice.node_count();
    let mut search = Relaxation::new();
    let ours = || {
        let mut costs = vec![f64::INFINITY; nodes];
        costs[middle] = 0.0;
        let width = weights.cheap();
        least_costs(lattice, &table, width, &[middle], &mut costs, &mut search).expect("costs");
        black_box(costs).len()
    };
    let theirs = || black_box(by_heap(lattice, &table, &[middle])).len();
    // 0.025 s for 600 x 600 nodes.
    pairs(effort.rounds(9), ours, theirs).print(
        &format!("path field, {name}"),
        "a heap",
        if lattice.directions() == 4 { "70 ns" } else { "" },
    );
}

/// Dijkstra's algorithm.
fn by_heap(lattice: &Lattice, table: &WeightTable, starts: &[usize]) -> Vec<f64> {
    let mut costs = vec![f64::INFINITY; lattice.node_count()];
    let mut heap = BinaryHeap::new();
    for &start in starts {
        costs[start] = 0.0;
        heap.push(Reverse((0_u64, start as u32)));
    }
    while let Some(Reverse((bits, node))) = heap.pop() {
        let (cost, node) = (f64::from_bits(bits), node as usize);
        if cost > costs[node] {
            continue;
        }
        for edge in lattice.neighbours(node) {
            let through = cost + table.weight(node, &edge);
            if through < costs[edge.node] {
                costs[edge.node] = through;
                heap.push(Reverse((through.to_bits(), edge.node as u32)));
            }
        }
    }
    costs
}

fn fractal(effort: Effort) {
    let lattice = plane(512, Connectivity::Four);
    let rounds = Rounds { count: 5, ..Rounds::default() };
    let endpoints = Endpoints::ByCost { count: 74, cost: 0.7, spread: 0.05 };
    let form = Dendrite { endpoints, rounds, ..Dendrite::default() };
    let grow = || form.grow(Path::new(""), &lattice, 1).expect("a dendrite");
    let grown = grow();
    let (_, table) = weights(&lattice);
    let ours = || black_box(grow()).endpoints;
    let theirs = || {
        for round in 0..rounds.count {
            let is_there = |number: &usize| grown.rounds[*number] < round || *number == 0;
            let starts: Vec<usize> =
                (0..grown.nodes.len()).filter(is_there).map(|number| grown.nodes[number]).collect();
            black_box(by_heap(&lattice, &table, &starts));
        }
        grown.endpoints
    };
    let name = format!("fractal dendrite, 512x512, {} ends", grown.endpoints);
    // 0.08 s in all.
    pairs(effort.rounds(5), ours, theirs).print(&name, "a heap anew in every round", "9000 ns");
}

fn aggregation(effort: Effort) {
    let few = if effort == Effort::Quick { 1000 } else { 5000 };
    let growth = |particles: usize| Growth {
        origin: Origin::Point,
        particles,
        reach: f64::INFINITY,
        sticking: 1.0,
        seed: 1,
    };
    let ours = |particles| black_box(aggregate::<2>(&growth(particles))).places.len();
    let name = |particles| format!("aggregation, {particles} particles");
    pairs(effort.rounds(3), || ours(few), || textbook(few)).print(
        &name(few),
        "a walk on a lattice, as many",
        "",
    );
    if effort == Effort::Full {
        // 20 s for a million.
        let many = 1_000_000;
        let against = format!("the walk, {few} particles");
        pairs(1, || ours(many), || textbook(few)).print(&name(many), &against, "20000 ns");
    }
}

/// Diffusion-limited aggregation as textbooks have it.
fn textbook(particles: usize) -> usize {
    const SIDE: i32 = 1024;
    let random = RandomStream::new(1, "textbook");
    let mut taken = vec![false; (SIDE * SIDE) as usize];
    let at = |[x, y]: [i32; 2]| ((y + SIDE / 2) * SIDE + x + SIDE / 2) as usize;
    taken[at([0, 0])] = true;
    let mut extent = 0.0_f64;
    for particle in 1..particles {
        let launch = extent + 2.0;
        let mut place = [0, 0];
        let mut outside = true;
        for step in 0.. {
            let [angle, way, ..] = random.block(step, particle, 0);
            if outside {
                let (sine, cosine) = (unit(angle) * std::f64::consts::TAU).sin_cos();
                place = [cosine, sine].map(|x| (x * launch).round() as i32);
            }
            let steps = [[1, 0], [-1, 0], [0, 1], [0, -1]];
            if steps.iter().any(|step| taken[at([place[0] + step[0], place[1] + step[1]])]) {
                break;
            }
            let step = steps[(way >> 30) as usize];
            place = [place[0] + step[0], place[1] + step[1]];
            let away = f64::from(place[0]).hypot(f64::from(place[1]));
            outside = away > (2.0 * launch).min(f64::from(SIDE / 2 - 4));
        }
        taken[at(place)] = true;
        extent = extent.max(f64::from(place[0]).hypot(f64::from(place[1])));
    }
    particles
}
