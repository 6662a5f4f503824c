//! Least costs of paths, and the paths.

use landform_graph::Lattice;
use landform_graph::marching::{MarchError, Relaxation};

use super::weights::WeightTable;

/// Lowers `costs` to those of the cheapest paths from the nodes `starts`, whose own costs are set:
/// the cost at every other node is at most that of a neighbour and the edge between them.
///
/// Costs that were made before are carried on: where starts and weights only become cheaper, the
/// result is the same, bit for bit, as from the beginning, and the work is that of the nodes whose
/// costs fall.
///
/// # Errors
/// [`MarchError`] for costs that are not numbers.
pub fn least_costs(
    lattice: &Lattice,
    table: &WeightTable,
    width: f64,
    starts: &[usize],
    costs: &mut [f64],
    search: &mut Relaxation,
) -> Result<(), MarchError> {
    search.relax(lattice, costs, starts, width, |from, edge| table.weight(from, edge)).map(|_| ())
}

/// The neighbour from which the cheapest path comes to a node: of those whose cost and edge add up to
/// its own, the cheapest (Xu 2008, figure 3.5). None at generators.
pub fn came_from(
    lattice: &Lattice,
    table: &WeightTable,
    costs: &[f64],
    node: usize,
) -> Option<usize> {
    let mut best: Option<usize> = None;
    for edge in lattice.neighbours(node) {
        let fits = costs[edge.node] + table.weight(node, &edge) == costs[node];
        if fits
            && costs[edge.node] < costs[node]
            && best.is_none_or(|best| costs[edge.node] < costs[best])
        {
            best = Some(edge.node);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::super::weights::EdgeWeights;
    use super::*;
    use landform_graph::{Boundary, Connectivity};
    use std::cmp::Reverse;
    use std::collections::BinaryHeap;

    /// Dijkstra's algorithm with a heap (Xu 2008, figure 3.2).
    pub fn by_heap(lattice: &Lattice, table: &WeightTable, starts: &[usize]) -> Vec<f64> {
        let mut costs = vec![f64::INFINITY; lattice.node_count()];
        let mut heap = BinaryHeap::new();
        for &start in starts {
            costs[start] = 0.0;
            heap.push(Reverse((0_u64, start)));
        }
        while let Some(Reverse((bits, node))) = heap.pop() {
            let cost = f64::from_bits(bits);
            if cost > costs[node] {
                continue;
            }
            for edge in lattice.neighbours(node) {
                let through = cost + table.weight(node, &edge);
                if through < costs[edge.node] {
                    costs[edge.node] = through;
                    heap.push(Reverse((through.to_bits(), edge.node)));
                }
            }
        }
        costs
    }

    fn lattices() -> Vec<Lattice> {
        use Boundary::{Open, Periodic};
        let plane = |kind, boundary| Lattice::plane([40, 32], 2.0, kind, boundary).unwrap();
        vec![
            plane(Connectivity::Four, [Open; 2]),
            plane(Connectivity::FourEight, [Open; 2]),
            plane(Connectivity::Eight, [Periodic, Open]),
            Lattice::volume([12, 11, 10], 2.0, Connectivity::Voxel26, [Open; 3]).unwrap(),
        ]
    }

    /// Costs have the bits of Dijkstra's; carried on with a new generator and cheaper edges they
    /// have those of a new start; every path sums up to its cost.
    #[test]
    fn costs_and_paths_are_dijkstras() {
        for lattice in lattices() {
            for exponent in [0.0, 1.0, 4.0] {
                let weights = EdgeWeights { exponent, ..EdgeWeights::default() };
                let mut table = weights.table(&lattice, None, 3).unwrap();
                let mut costs = vec![f64::INFINITY; lattice.node_count()];
                let mut search = Relaxation::new();
                costs[77] = 0.0;
                let width = weights.cheap();
                least_costs(&lattice, &table, width, &[77], &mut costs, &mut search).unwrap();
                assert_eq!(costs, by_heap(&lattice, &table, &[77]));
                for start in (0..lattice.node_count()).step_by(13) {
                    let (mut at, mut sum) = (start, Vec::new());
                    while let Some(next) = came_from(&lattice, &table, &costs, at) {
                        let edge = lattice.neighbours(at).find(|edge| edge.node == next).unwrap();
                        sum.push(table.weight(at, &edge));
                        at = next;
                    }
                    assert_eq!(at, 77);
                    assert_eq!(sum.iter().rev().fold(0.0, |sum, w| sum + w), costs[start]);
                }
                let edge = lattice.neighbours(500).next().unwrap();
                table.multiply(500, &edge, 0.01);
                costs[900] = 0.0;
                let starts = [900, 500, edge.node];
                least_costs(&lattice, &table, width, &starts, &mut costs, &mut search).unwrap();
                assert_eq!(costs, by_heap(&lattice, &table, &[77, 900]));
            }
        }
    }
}
