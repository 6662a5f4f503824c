//! Paths made finer on sub-lattices.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use landform_graph::Lattice;
use landform_sim::random::{RandomStream, unit};

use super::grow::Grown;
use super::weights::WeightTable;
use crate::branching::Branching;

/// Paths made finer (Xu 2008, section 4.4): every node becomes a sub-lattice of `parts` nodes a side,
/// and a new path is planned through those of the old one.
pub(super) struct Refinement<'a> {
    pub lattice: &'a Lattice,
    pub table: &'a WeightTable,
    /// Nodes along a side of a sub-lattice, odd.
    pub parts: usize,
    /// Share of the old weight in the new one; the rest is random.
    pub faith: f64,
    pub random: RandomStream,
}

/// A node of the fine lattice: steps of `spacing / parts` from the first node's sub-lattice.
type Fine = [i64; 3];

impl Refinement<'_> {
    /// The branches of a dendrite through sub-lattices; the same number of trees, and one branch for
    /// each end point that was a tip.
    pub fn refine(&self, grown: &Grown) -> Branching {
        let coarse = self.coarse(grown);
        let mut fine = Branching::default();
        // The nodes of the finer dendrite in each sub-lattice.
        let mut homes: Vec<BTreeMap<Fine, u32>> = vec![BTreeMap::new(); grown.nodes.len()];
        for branch in coarse.branches() {
            let root = branch[0] as usize;
            if homes[root].is_empty() {
                let middle = self.middle(grown.nodes[root]);
                let number = fine.add(self.position(middle), None, 0.0);
                homes[root].insert(middle, number);
            }
            if branch.len() < 2 {
                continue;
            }
            let cells: Vec<usize> = branch.iter().map(|&n| grown.nodes[n as usize]).collect();
            let path = self.path(&cells, &homes[root]);
            let Some(mut parent) = path.first().and_then(|at| homes[root].get(at)).copied() else {
                continue;
            };
            let mut number = 0;
            for &at in &path[1..] {
                // Steps of a path go on to the next sub-lattice or stay.
                while number + 1 < cells.len()
                    && self.cell_of(at) != self.cell_of(self.middle(cells[number]))
                {
                    number += 1;
                }
                parent = fine.add(self.position(at), Some(parent), 0.0);
                homes[branch[number] as usize].insert(at, parent);
            }
        }
        fine
    }

    /// The dendrite with the coordinates of its nodes.
    fn coarse(&self, grown: &Grown) -> Branching {
        let positions: Vec<_> =
            grown.nodes.iter().map(|&node| self.lattice.position(node).to_array()).collect();
        let radii = vec![0.0; positions.len()];
        Branching { positions, parents: grown.parents.clone(), radii }
    }

    /// The middle of a node's sub-lattice.
    fn middle(&self, node: usize) -> Fine {
        let at = self.lattice.position(node) / self.lattice.spacing();
        let parts = self.parts as f64;
        at.to_array().map(|at| (at.round() * parts) as i64 + self.parts as i64 / 2)
    }

    /// Steps of whole sub-lattices.
    fn cell_of(&self, at: Fine) -> Fine {
        at.map(|at| at.div_euclid(self.parts as i64))
    }

    fn position(&self, at: Fine) -> [f64; 3] {
        let half = (self.parts / 2) as i64;
        let step = self.lattice.spacing() / self.parts as f64;
        let mut position = at.map(|at| (at - half) as f64 * step);
        if self.lattice.depth() == 1 {
            position[2] = 0.0;
        }
        position
    }

    /// The cheapest path through the sub-lattices of a path, from one of `starts` in the first of them
    /// to the middle of the last.
    fn path(&self, cells: &[usize], starts: &BTreeMap<Fine, u32>) -> Vec<Fine> {
        let places: Vec<Fine> = cells.iter().map(|&node| self.cell_of(self.middle(node))).collect();
        let block = self.block();
        let size = block.len();
        let local = |number: usize, at: Fine| {
            let parts = self.parts as i64;
            let [x, y, z] = at.map(|at| at.rem_euclid(parts) as usize);
            number * size
                + x
                + self.parts * (y + self.parts * if self.lattice.depth() > 1 { z } else { 0 })
        };
        let mut costs = vec![f64::INFINITY; size * cells.len()];
        let mut from = vec![None; costs.len()];
        let mut heap = BinaryHeap::new();
        for &at in starts.keys() {
            costs[local(0, at)] = 0.0;
            heap.push(Reverse((0_u64, 0_usize, at)));
        }
        let weights = self.weights(cells);
        let goal = self.middle(cells[cells.len() - 1]);
        while let Some(Reverse((bits, number, at))) = heap.pop() {
            if f64::from_bits(bits) > costs[local(number, at)] {
                continue;
            }
            if number + 1 == cells.len() && at == goal {
                break;
            }
            for (step, length) in self.steps() {
                let to = [0, 1, 2].map(|axis| at[axis] + step[axis]);
                let place = self.cell_of(to);
                let next = [Some(number), number.checked_add(1), number.checked_sub(1)];
                let next = next.into_iter().flatten().find(|&n| places.get(n) == Some(&place));
                let Some(next) = next else { continue };
                let through =
                    f64::from_bits(bits) + self.weight(&weights, [number, next], at, to) * length;
                if through < costs[local(next, to)] {
                    costs[local(next, to)] = through;
                    from[local(next, to)] = Some((number, at));
                    heap.push(Reverse((through.to_bits(), next, to)));
                }
            }
        }
        let mut path = vec![goal];
        let mut at = (cells.len() - 1, goal);
        while let Some(before) = from[local(at.0, at.1)] {
            path.push(before.1);
            at = before;
        }
        path.reverse();
        path
    }

    /// Fine nodes of a sub-lattice, as steps from its corner.
    fn block(&self) -> Vec<Fine> {
        let parts = self.parts as i64;
        let layers = if self.lattice.depth() > 1 { parts } else { 1 };
        (0..parts * parts * layers)
            .map(|n| [n % parts, n / parts % parts, n / (parts * parts)])
            .collect()
    }

    /// Steps to the neighbours of a fine node and their lengths: those of the lattice.
    fn steps(&self) -> Vec<(Fine, f64)> {
        let middle = self.lattice.size().map(|nodes| nodes / 2);
        // Of a 4-8 mesh a node with eight neighbours.
        let even = (middle[0] + middle[1]) % 2;
        let node = self.lattice.node([middle[0] - even.min(middle[0]), middle[1], middle[2]]);
        self.lattice
            .neighbours(node)
            .map(|edge| {
                let [x, south, z] = edge.step.map(i64::from);
                ([x, -south, z], edge.distance / self.lattice.spacing())
            })
            .collect()
    }

    /// The weight of the old path at each of its nodes: the mean of the edges on both sides.
    fn weights(&self, cells: &[usize]) -> Vec<f64> {
        let edge = |pair: &[usize]| {
            let edge = self.lattice.neighbours(pair[0]).find(|edge| edge.node == pair[1]);
            edge.map_or(1.0, |edge| self.table.weight(pair[0], &edge))
        };
        let edges: Vec<f64> = cells.windows(2).map(edge).collect();
        let last = edges.len() - 1;
        (0..cells.len()).map(|n| 0.5 * (edges[n.max(1) - 1] + edges[n.min(last)])).collect()
    }

    /// Weight of a fine edge: a part from the old path, interpolated, and a random one.
    fn weight(&self, weights: &[f64], [here, there]: [usize; 2], at: Fine, to: Fine) -> f64 {
        let old = 0.5 * (weights[here] + weights[there]);
        let chance = self.chance(at.min(to), at.max(to));
        let drawn = 1.0 + chance * (old - 1.0).max(0.0);
        self.faith * old + (1.0 - self.faith) * drawn
    }

    /// A number in [0, 1) for an edge between two fine nodes.
    fn chance(&self, low: Fine, high: Fine) -> f64 {
        let step = [0, 1, 2].map(|axis| high[axis] - low[axis] + 1);
        let direction = (step[0] + 3 * (step[1] + 3 * step[2])) as u32;
        let [x, y, z] = low.map(|at| at as u64);
        unit(self.random.block(x | y << 32, z as usize, direction)[0])
    }
}
