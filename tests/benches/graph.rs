//! The simulation space: searches, rays, fronts and fitted surfaces.
//!
//! - `breadth-first, everything`: one search over 512x512 nodes, a visit, against `petgraph`'s `Bfs`
//!   on the same lattice; `radius 10`: many small searches, against the same;
//! - `small searches`: breadth-first, by distance and by a front of one's own, among four million
//!   nodes against the same among four thousand: the cost is that of the nodes visited;
//! - `ray`: rays of 120 nodes at all angles that add heights, a step, against the same steps
//!   without a lattice: rounding and a check of the bounds;
//! - `relaxation`: a front over 26 neighbours with a random cost a node, a voxel, against Dijkstra's
//!   algorithm with a heap, written here on the same neighbours; both give the same bits;
//! - `gradient`, `laplacian`: the fitted quadric at every node, against copying as many fields as
//!   are written.

mod measure;

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::hint::black_box;
use std::ops::ControlFlow;

use landform::graph::marching::{FastMarching, Front, MarchOptions, Relaxation};
use landform::graph::quadric::{gradient_field, laplacian_field};
use landform::graph::{Boundary, BreadthFirst, Connectivity, Edge, Lattice, Reach};
use landform::sim::random::{RandomStream, unit};
use measure::{Effort, pairs, table};
use petgraph::visit::Bfs;

fn main() {
    table("Graph", |effort| {
        let lattice = Lattice::plane([512, 512], 1.0, Connectivity::Eight, [Boundary::Open; 2]);
        let lattice = lattice.expect("a lattice");
        let heights = noise(lattice.node_count());
        searches(effort, &lattice);
        rays(effort, &lattice, &heights);
        quadrics(effort, &lattice, &heights);
        relaxation(effort);
    });
}

fn noise(nodes: usize) -> Vec<f64> {
    let random = RandomStream::new(1, "noise");
    (0..nodes).map(|node| 0.5 + unit(random.block(0, node, 0)[0])).collect()
}

fn searches(effort: Effort, lattice: &Lattice) {
    let mut search = BreadthFirst::new();
    let everywhere = |_: usize, _: &Edge| true;
    let mut visits = |sources: &[usize], reach: Reach| {
        let mut visits = 0;
        for &source in sources {
            search.search(lattice, &[source], reach, everywhere, |visit| {
                visits += 1;
                black_box(visit.node);
                ControlFlow::<()>::Continue(())
            });
        }
        visits
    };
    let petgraph = || {
        let mut search = Bfs::new(lattice, 0);
        let mut visits = 0;
        while let Some(node) = search.next(lattice) {
            black_box(node);
            visits += 1;
        }
        visits
    };
    let rounds = effort.rounds(15);
    let pair = pairs(rounds, || visits(&[0], Reach::UNLIMITED), petgraph);
    pair.print("breadth-first, everything, a visit", "petgraph Bfs", "");
    let middles: Vec<usize> = (0..600).map(|n| lattice.node([20 + n % 470, 250, 0])).collect();
    let pair = pairs(rounds, || visits(&middles, Reach::metres(10.0)), petgraph);
    pair.print("breadth-first, radius 10, a visit", "petgraph Bfs, everything", "");
    let [mut few, mut many] = [64, 2048].map(LocalSearches::new);
    let pair = pairs(rounds, || many.visits(), || few.visits());
    pair.print("small searches, 2048x2048, a visit", "the same, 64x64", "");
}

/// Searches of three kinds around the middle of a square, with the memory that they share.
struct LocalSearches {
    lattice: Lattice,
    breadth_first: BreadthFirst,
    marching: FastMarching,
    front: Front,
    /// Number of the last front that reached a node.
    reached: Vec<usize>,
    fronts: usize,
}

impl LocalSearches {
    fn new(side: usize) -> Self {
        let lattice = Lattice::plane([side; 2], 1.0, Connectivity::Eight, [Boundary::Open; 2]);
        let lattice = lattice.expect("a lattice");
        Self {
            breadth_first: BreadthFirst::new(),
            marching: FastMarching::new(),
            front: Front::new(),
            reached: vec![0; lattice.node_count()],
            fronts: 0,
            lattice,
        }
    }

    /// Runs a hundred searches of each kind and returns how many nodes they visited.
    fn visits(&mut self) -> usize {
        let Self { lattice, breadth_first, marching, front, reached, fronts } = self;
        let corner = lattice.width() / 2 - 5;
        let options = MarchOptions { limit: 8.0, ..MarchOptions::default() };
        let mut visits = 0;
        for number in 0..100 {
            let source = lattice.node([corner + number % 10, corner + number / 10, 0]);
            visits +=
                breadth_first.collect(lattice, &[source], Reach::metres(8.0), |_, _| true).len();
            let arrivals = marching.distance(lattice, &[source], options);
            visits += arrivals.expect("a march").order.len();
            *fronts += 1;
            let spread = |_: usize, edge: &Edge| {
                let first = std::mem::replace(&mut reached[edge.node], *fronts) != *fronts;
                first.then_some(number as f64 + edge.distance)
            };
            let mut left = 200;
            let stop = |_, _| {
                left -= 1;
                if left == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            let stopped = front.search(lattice, &[(source, 0.0)], spread, stop);
            assert_eq!(stopped, Ok(Some(())));
            visits += 200;
        }
        visits
    }
}

fn rays(effort: Effort, lattice: &Lattice, heights: &[f64]) {
    const LENGTH: f64 = 120.0;
    let angles: Vec<f64> = (0..2000).map(|n| f64::from(n) * 0.7).collect();
    let start = lattice.node([256, 256, 0]);
    let rays = || {
        let mut steps = 0;
        for &angle in &angles {
            let mut sum = 0.0;
            for step in lattice.ray(start, angle, LENGTH) {
                sum += heights[step.node];
                steps += 1;
            }
            black_box(sum);
        }
        steps
    };
    let by_hand = || {
        let mut steps = 0;
        for &angle in &angles {
            let (east, north) = (angle.cos(), angle.sin());
            let longest = east.abs().max(north.abs());
            let mut sum = 0.0;
            for step in 1..=(LENGTH * longest) as usize {
                let along = step as f64 / longest;
                let x = (256.0 + east * along).round() as usize;
                let y = (256.0 - north * along).round() as usize;
                if x >= 512 || y >= 512 {
                    break;
                }
                sum += heights[x + 512 * y];
                steps += 1;
            }
            black_box(sum);
        }
        steps
    };
    let pair = pairs(effort.rounds(15), rays, by_hand);
    pair.print("ray, a step", "rounding by hand", "");
}

fn quadrics(effort: Effort, lattice: &Lattice, heights: &[f64]) {
    let nodes = heights.len();
    let [mut east, mut north] = [vec![0.0; nodes], vec![0.0; nodes]];
    let [mut first, mut second] = [vec![0.0; nodes], vec![0.0; nodes]];
    let gradient = || {
        gradient_field(lattice, heights, &mut east, &mut north);
        nodes
    };
    let copies = || {
        first.copy_from_slice(black_box(heights));
        second.copy_from_slice(black_box(heights));
        black_box((&first, &second));
        nodes
    };
    pairs(effort.rounds(40), gradient, copies).print("gradient, a node", "copy of two fields", "");
    let laplacian = || {
        laplacian_field(lattice, heights, &mut east);
        nodes
    };
    let copy = || {
        first.copy_from_slice(black_box(heights));
        black_box(&first);
        nodes
    };
    pairs(effort.rounds(40), laplacian, copy).print("laplacian, a node", "copy of a field", "");
}

fn relaxation(effort: Effort) {
    let side = match effort {
        Effort::Quick => 48,
        Effort::Normal => 128,
        Effort::Full => 256,
    };
    let lattice = Lattice::volume([side; 3], 1.0, Connectivity::Voxel26, [Boundary::Open; 3]);
    let lattice = lattice.expect("a lattice");
    let nodes = lattice.node_count();
    let slopes = noise(nodes);
    let cost = |_: usize, edge: &Edge| slopes[edge.node] * edge.distance;
    let start = nodes / 2;
    let mut relaxation = Relaxation::new();
    let [mut values, mut expected] = [vec![0.0; nodes], vec![0.0; nodes]];
    let relax = || {
        values.fill(1e9);
        values[start] = 0.0;
        relaxation.relax(&lattice, &mut values, &[start], 2.0, cost).expect("a relaxed field");
        nodes
    };
    let by_heap = || {
        expected.fill(1e9);
        expected[start] = 0.0;
        dijkstra(&lattice, &mut expected, start, cost);
        nodes
    };
    let pair = pairs(effort.rounds(3), relax, by_heap);
    assert_eq!(values, expected, "both give the same bits");
    pair.print(&format!("relaxation {side}^3, a voxel"), "Dijkstra with a heap", "220 ns");
}

/// The same field by a heap: non-negative doubles sort like their bits.
fn dijkstra(
    lattice: &Lattice,
    values: &mut [f64],
    start: usize,
    cost: impl Fn(usize, &Edge) -> f64,
) {
    let mut heap = BinaryHeap::from([Reverse((values[start].to_bits(), start))]);
    while let Some(Reverse((bits, node))) = heap.pop() {
        if bits > values[node].to_bits() {
            continue;
        }
        for edge in lattice.neighbours(node) {
            let value = values[node] + cost(node, &edge);
            if value < values[edge.node] {
                values[edge.node] = value;
                heap.push(Reverse((value.to_bits(), edge.node)));
            }
        }
    }
}
