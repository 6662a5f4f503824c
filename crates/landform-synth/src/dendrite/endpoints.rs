//! Where branches end.

use landform_graph::Lattice;
use landform_sim::random::RandomStream;
use rand::RngExt;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::place_node;
use crate::SynthError;
use crate::error::Checks;

/// Most end points that are drawn at a time.
const MOST: f64 = 1e7;

/// Where the branches of the first round end (Xu 2008, section 3.3.1).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Endpoints {
    /// At random nodes.
    Random {
        /// How many; fewer where there are not so many nodes.
        #[schemars(range(min = 1, max = 10000000))]
        count: u32,
    },
    /// At random nodes within a shape.
    Within {
        /// How many.
        #[schemars(range(min = 1, max = 10000000))]
        count: u32,
        /// Middle of the shape, as shares of the lattice from west to east, south to north and
        /// bottom to top.
        center: [f64; 3],
        /// Half its sides, or its half axes, as the same shares; 0 holds to the very node.
        half: [f64; 3],
        /// The shape.
        shape: EndShape,
    },
    /// At random nodes of about the same cost of the path there.
    ByCost {
        /// How many.
        #[schemars(range(min = 1, max = 10000000))]
        count: u32,
        /// The cost, as a share of the greatest one.
        #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "Xu 2008, figure 3.12, d"))]
        cost: f64,
        /// How far costs may be from it, as a share of it.
        #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "Xu 2008, figure 3.12, r"))]
        spread: f64,
    },
    /// At the nodes nearest to these places, given as shares of the lattice.
    Listed(Vec<[f64; 3]>),
}

impl Default for Endpoints {
    fn default() -> Self {
        Self::Random { count: 15 }
    }
}

/// A shape that end points lie within.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum EndShape {
    /// A rectangle, or a box.
    Box,
    /// An ellipse, or an ellipsoid.
    Ellipse,
    /// An ellipse, or an ellipsoid, without its inner half.
    Shell,
}

impl Endpoints {
    pub(super) fn check(&self, checks: &Checks) -> Result<(), SynthError> {
        let number = |count: u32| checks.range("endpoints.count", f64::from(count), 1.0..=MOST);
        let shares = |name, place: &[f64; 3]| {
            place.iter().try_for_each(|&share| checks.range(name, share, 0.0..=1.0))
        };
        match self {
            Self::Random { count } => number(*count),
            Self::Within { count, center, half, .. } => {
                number(*count)?;
                shares("endpoints.center", center)?;
                shares("endpoints.half", half)
            }
            Self::ByCost { count, cost, spread } => {
                number(*count)?;
                checks.range("endpoints.cost", *cost, 0.0..=1.0)?;
                checks.range("endpoints.spread", *spread, 0.0..=1.0)
            }
            Self::Listed(places) => places.iter().try_for_each(|place| shares("endpoints", place)),
        }
    }

    /// How many there are.
    pub(super) fn count(&self) -> u32 {
        match self {
            Self::Random { count } | Self::Within { count, .. } | Self::ByCost { count, .. } => {
                *count
            }
            Self::Listed(places) => places.len() as u32,
        }
    }

    /// The nodes, among those that paths lead to.
    pub(super) fn nodes(&self, lattice: &Lattice, costs: &[f64], seed: u64) -> Vec<usize> {
        let free = |node: &usize| costs[*node].is_finite() && costs[*node] > 0.0;
        let all = || (0..lattice.node_count()).filter(free);
        match self {
            Self::Random { count } => draw(all().collect(), *count, seed, 0),
            Self::Within { count, center, half, shape } => {
                let inside = |node: &usize| shape.holds(lattice, *node, *center, *half);
                draw(all().filter(inside).collect(), *count, seed, 0)
            }
            Self::ByCost { count, cost, spread } => {
                let most =
                    costs.iter().copied().filter(|cost| cost.is_finite()).fold(0.0, f64::max);
                draw(by_cost(costs, cost * most, *spread), *count, seed, 0)
            }
            Self::Listed(places) => {
                places.iter().filter_map(|&place| place_node(lattice, costs, place)).collect()
            }
        }
    }
}

impl EndShape {
    fn holds(self, lattice: &Lattice, node: usize, center: [f64; 3], half: [f64; 3]) -> bool {
        let position = lattice.position(node).to_array();
        let aside = [0, 1, 2].map(|axis| {
            let length = (lattice.size()[axis] - 1) as f64 * lattice.spacing();
            let off = (position[axis] - center[axis] * length).abs();
            // A node is within half a spacing of its place.
            let reach = (half[axis] * length).max(0.5 * lattice.spacing());
            if lattice.size()[axis] == 1 { 0.0 } else { off / reach }
        });
        let squared: f64 = aside.iter().map(|x| x * x).sum();
        match self {
            Self::Box => aside.iter().all(|&x| x <= 1.0),
            Self::Ellipse => squared <= 1.0,
            Self::Shell => (0.25..=1.0).contains(&squared),
        }
    }
}

/// Nodes whose costs are about `cost`.
pub(super) fn by_cost(costs: &[f64], cost: f64, spread: f64) -> Vec<usize> {
    let range = cost * (1.0 - spread)..=cost * (1.0 + spread);
    (0..costs.len()).filter(|&node| costs[node] > 0.0 && range.contains(&costs[node])).collect()
}

/// Draws `count` of the nodes without putting any back, all equally likely.
pub(super) fn draw(mut nodes: Vec<usize>, count: u32, seed: u64, round: u64) -> Vec<usize> {
    let count = (count as usize).min(nodes.len());
    let mut random = RandomStream::new(seed, "end points").at(round, 0);
    for place in 0..count {
        let other = random.random_range(place..nodes.len());
        nodes.swap(place, other);
    }
    nodes.truncate(count);
    nodes
}
