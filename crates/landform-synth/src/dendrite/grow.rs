//! Growth of a dendrite in rounds.

use landform_graph::Lattice;
use landform_graph::marching::Relaxation;

use super::endpoints::{by_cost, draw};
use super::least_cost::{came_from, least_costs};
use super::weights::WeightTable;
use super::{Dendrite, unusable};
use crate::SynthError;

/// No node of the dendrite.
const NONE: u32 = u32::MAX;

/// A dendrite on its lattice, a parent before its children.
#[derive(Clone, Debug)]
pub struct Grown {
    /// Nodes of the lattice.
    pub nodes: Vec<usize>,
    /// Number of the node that each is joined to; none at generators.
    pub parents: Vec<Option<u32>>,
    /// Round in which each came, from 0; generators belong to the first.
    pub rounds: Vec<u32>,
    /// Least cost of a path to every node of the lattice from a generator, at the end: from any
    /// node of the dendrite where former paths cost nothing.
    pub costs: Vec<f64>,
    /// End points that were joined.
    pub endpoints: usize,
}

/// A dendrite as it grows.
pub(super) struct Growing<'a> {
    lattice: &'a Lattice,
    table: WeightTable,
    /// Range of costs in a bucket of the search.
    width: f64,
    search: Relaxation,
    grown: Grown,
    /// Costs from the nearest node of the dendrite, where former paths keep a part of theirs.
    nearness: Option<Vec<f64>>,
    /// Number in the dendrite of every node of the lattice.
    members: Vec<u32>,
}

impl<'a> Growing<'a> {
    pub fn new(
        lattice: &'a Lattice,
        table: WeightTable,
        width: f64,
        generators: &[usize],
        keeps_costs: bool,
    ) -> Result<Self, SynthError> {
        let nodes = lattice.node_count();
        let grown = Grown {
            nodes: Vec::new(),
            parents: Vec::new(),
            rounds: Vec::new(),
            costs: vec![f64::INFINITY; nodes],
            endpoints: 0,
        };
        let search = Relaxation::new();
        let members = vec![NONE; nodes];
        let mut growing = Self { lattice, table, width, search, grown, nearness: None, members };
        for &node in generators {
            if growing.members[node] == NONE {
                growing.add(node, None, 0);
            }
        }
        growing.restart(0)?;
        if keeps_costs {
            growing.nearness = Some(growing.grown.costs.clone());
        }
        Ok(growing)
    }

    fn add(&mut self, node: usize, parent: Option<u32>, round: u32) {
        self.members[node] = self.grown.nodes.len() as u32;
        self.grown.nodes.push(node);
        self.grown.parents.push(parent);
        self.grown.rounds.push(round);
    }

    /// Makes the nodes from number `first` on generators and lowers the costs around them.
    fn restart(&mut self, first: usize) -> Result<(), SynthError> {
        let starts = &self.grown.nodes[first..];
        let costs = self.nearness.as_mut().unwrap_or(&mut self.grown.costs);
        starts.iter().for_each(|&node| costs[node] = 0.0);
        least_costs(self.lattice, &self.table, self.width, starts, costs, &mut self.search)
            .map_err(|error| unusable("weights", error.to_string()))
    }

    /// Costs by which later end points are chosen.
    pub fn nearness(&self) -> &[f64] {
        self.nearness.as_ref().unwrap_or(&self.grown.costs)
    }

    /// Joins end points to the dendrite by their cheapest paths; former paths then cost `keep` times
    /// what they did.
    pub fn join(&mut self, endpoints: &[usize], round: u32, keep: f64) -> Result<(), SynthError> {
        self.check_scale()?;
        let first = self.grown.nodes.len();
        let mut path = Vec::new();
        for &endpoint in endpoints {
            path.clear();
            let mut at = endpoint;
            while self.members[at] == NONE {
                path.push(at);
                let Some(next) = came_from(self.lattice, &self.table, &self.grown.costs, at) else {
                    break;
                };
                at = next;
            }
            if self.members[at] == NONE {
                // Nothing leads there.
                continue;
            }
            self.grown.endpoints += 1;
            let mut parent = self.members[at];
            for &node in path.iter().rev() {
                self.add(node, Some(parent), round);
                parent = self.members[node];
            }
        }
        self.cheapen(first, keep)?;
        self.restart(first)
    }

    /// Makes the edges from number `first` on cheaper, where former paths keep a part of their costs.
    fn cheapen(&mut self, first: usize, keep: f64) -> Result<(), SynthError> {
        if self.nearness.is_none() {
            return Ok(());
        }
        let mut starts = Vec::new();
        for number in first..self.grown.nodes.len() {
            let Some(parent) = self.grown.parents[number] else { continue };
            let [node, parent] = [number, parent as usize].map(|number| self.grown.nodes[number]);
            let edge = self.lattice.neighbours(node).find(|edge| edge.node == parent);
            if let Some(edge) = edge {
                self.table.multiply(node, &edge, keep);
                starts.extend([node, parent]);
            }
        }
        let (costs, search) = (&mut self.grown.costs, &mut self.search);
        least_costs(self.lattice, &self.table, self.width, &starts, costs, search)
            .map_err(|error| unusable("weights", error.to_string()))
    }

    /// Refuses weights so far apart that a sum cannot hold the smallest beside the largest.
    fn check_scale(&self) -> Result<(), SynthError> {
        let finite = self.grown.costs.iter().copied().filter(|cost| cost.is_finite());
        let most = finite.fold(0.0, f64::max);
        match self.table.least() > most * 2.0 * f64::EPSILON {
            true => Ok(()),
            false => {
                let problem = "the weights differ so much that path costs cannot be told apart; \
                               take a smaller range, exponent or bias";
                Err(unusable("weights", problem.to_owned()))
            }
        }
    }

    pub fn done(self) -> (Grown, WeightTable) {
        (self.grown, self.table)
    }
}

/// Grows a dendrite (Xu 2008, figure 3.12): the first end points as they are asked for, then
/// `branching` times more in each round, at path costs `attenuation` times smaller.
pub(super) fn grow(
    form: &Dendrite,
    lattice: &Lattice,
    table: WeightTable,
    generators: &[usize],
    seed: u64,
) -> Result<(Grown, WeightTable), SynthError> {
    let keep = form.former_paths;
    let width = form.weights.cheap();
    let mut growing = Growing::new(lattice, table, width, generators, keep > 0.0)?;
    let finite = growing.nearness().iter().copied().filter(|cost| cost.is_finite());
    let greatest = finite.fold(0.0, f64::max);
    let first = form.endpoints.nodes(lattice, growing.nearness(), seed);
    growing.join(&first, 0, keep)?;
    let rounds = &form.rounds;
    let mut count = f64::from(form.endpoints.count());
    let mut cost = greatest * rounds.cost;
    for round in 1..rounds.count {
        count = (count * rounds.branching).min(1e7);
        let near = by_cost(growing.nearness(), cost, rounds.spread);
        let endpoints = draw(near, count as u32, seed, u64::from(round));
        growing.join(&endpoints, round, keep)?;
        cost /= rounds.attenuation;
    }
    Ok(growing.done())
}
