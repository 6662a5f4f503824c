//! Weights of the edges of a lattice.

use landform_graph::{Edge, Lattice};
use landform_sim::random::{RandomStream, unit};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::SynthError;
use crate::error::Checks;

/// Largest weight of an edge by its random part alone: beyond it sums lose the smallest.
const MOST: f64 = 1e12;

/// Most weights of a table: a gibibyte.
const MOST_WEIGHTS: usize = 1 << 28;

/// How the weights of edges are drawn: `length (1 + v^exponent) bias`, with v evenly spread between
/// 0 and `range` and the length of the edge in spacings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct EdgeWeights {
    /// Largest random number; 0 gives all edges the same weight.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-source" = "Xu 2008, section 3.2: 10 to 100"))]
    pub range: f64,
    /// Exponent of the random number: paths wind more where it is larger. `range^exponent` may be
    /// 1e12 at most.
    #[schemars(range(min = 0.0, max = 12.0), extend("x-source" = "Xu 2008, section 4.2, n"))]
    pub exponent: f64,
    /// Places where edges are cheap, so that branches turn towards them.
    pub biases: Vec<WeightBias>,
}

impl Default for EdgeWeights {
    fn default() -> Self {
        Self { range: 100.0, exponent: 1.0, biases: Vec::new() }
    }
}

/// Edges that are cheap at one place and dear at the opposite one: the weight is multiplied by
/// `1 + strength s`, where s goes from 0 to 1 with the distance (Xu 2008, section 4.2, figure 4.5).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WeightBias {
    /// Where edges are cheap.
    pub cheap: CheapPlace,
    /// How much dearer they are at the opposite place.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub strength: f64,
}

/// Where edges are cheap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum CheapPlace {
    /// The western side.
    West,
    /// The eastern side.
    East,
    /// The southern side.
    South,
    /// The northern side.
    North,
    /// The floor of a volume.
    Bottom,
    /// The top of a volume.
    Top,
    /// The middle between west and east; in volumes the vertical axis.
    Middle,
    /// West and east, away from the middle; in volumes away from the vertical axis.
    Sides,
    /// Far from the nodes where nothing grows and from the border: the skeleton of a letter.
    Core,
}

/// The weights of all edges of a lattice, one for the two directions of an edge.
#[derive(Clone, Debug)]
pub struct WeightTable {
    /// Number of each direction among those that are kept; the others are the opposites of them.
    forward: Vec<Option<usize>>,
    kept: usize,
    opposite: Vec<u8>,
    weights: Vec<f32>,
}

impl EdgeWeights {
    pub(super) fn check(&self, checks: &Checks) -> Result<(), SynthError> {
        checks.range("weights.range", self.range, 0.0..=1e6)?;
        checks.range("weights.exponent", self.exponent, 0.0..=12.0)?;
        checks.range("range^exponent", self.range.powf(self.exponent), 0.0..=MOST)?;
        let strengths = self.biases.iter().map(|bias| bias.strength);
        strengths
            .into_iter()
            .try_for_each(|it| checks.range("weights.biases.strength", it, 0.0..=1e6))
    }

    /// Weight of a cheap edge of one spacing, as paths have them: at a quarter of the range. The
    /// search takes nodes together whose costs differ by less.
    pub fn cheap(&self) -> f64 {
        1.0 + (0.25 * self.range).powf(self.exponent)
    }

    /// Draws the weights. `factors` multiply them, the mean of those of both ends; an edge to a
    /// node with an infinite factor cannot be taken. None are all 1.
    ///
    /// # Errors
    /// [`SynthError::TooLarge`] for tables beyond a gibibyte.
    pub fn table(
        &self,
        lattice: &Lattice,
        factors: Option<&[f64]>,
        seed: u64,
    ) -> Result<WeightTable, SynthError> {
        let directions = lattice.directions() as u8;
        let opposite: Vec<u8> = (0..directions).map(|way| lattice.opposite(way)).collect();
        let mut kept = 0;
        let mut forward = vec![None; usize::from(directions)];
        for way in 0..directions {
            if way < opposite[usize::from(way)] {
                forward[usize::from(way)] = Some(kept);
                kept += 1;
            }
        }
        let count = lattice.node_count().saturating_mul(kept);
        if count > MOST_WEIGHTS {
            let what = "edges";
            return Err(SynthError::TooLarge { generator: super::NAME, what, most: MOST_WEIGHTS });
        }
        let random = RandomStream::new(seed, "edge weights");
        let factor = |node: usize| factors.map_or(1.0, |factors| factors[node]);
        let mut weights = vec![f32::INFINITY; count];
        weights.par_chunks_mut(kept.max(1)).enumerate().for_each(|(node, weights)| {
            let mut words = [0; 4];
            let mut drawn = u32::MAX;
            for edge in lattice.neighbours(node) {
                let Some(number) = forward[usize::from(edge.direction)] else { continue };
                let block = (number / 4) as u32;
                if block != drawn {
                    (words, drawn) = (random.block(0, node, block), block);
                }
                let part = self.power(self.range * unit(words[number % 4]));
                let length = edge.distance / lattice.spacing();
                let bias = 0.5 * (factor(node) + factor(edge.node));
                weights[number] = (length * (1.0 + part) * bias) as f32;
            }
        });
        Ok(WeightTable { forward, kept, opposite, weights })
    }

    fn power(&self, value: f64) -> f64 {
        if self.exponent == 1.0 { value } else { value.powf(self.exponent) }
    }
}

impl WeightTable {
    #[inline]
    fn slot(&self, from: usize, edge: &Edge) -> usize {
        match self.forward[usize::from(edge.direction)] {
            Some(number) => from * self.kept + number,
            None => {
                let back = self.opposite[usize::from(edge.direction)];
                edge.node * self.kept + self.forward[usize::from(back)].unwrap_or(0)
            }
        }
    }

    /// Weight of an edge that leaves a node.
    #[inline]
    pub fn weight(&self, from: usize, edge: &Edge) -> f64 {
        f64::from(self.weights[self.slot(from, edge)])
    }

    /// Multiplies the weight of an edge.
    pub(super) fn multiply(&mut self, from: usize, edge: &Edge, factor: f64) {
        let slot = self.slot(from, edge);
        self.weights[slot] = (f64::from(self.weights[slot]) * factor) as f32;
    }

    /// The smallest weight.
    pub(super) fn least(&self) -> f64 {
        f64::from(self.weights.iter().copied().fold(f32::INFINITY, f32::min))
    }
}

impl WeightBias {
    /// Its factor at every node; `depths` are the distances of nodes from where nothing grows.
    pub(super) fn factor(&self, lattice: &Lattice, node: usize, depth: f64) -> f64 {
        let [x, y, z] = lattice.coordinates(node);
        let [width, height, layers] = lattice.size();
        let share = |at: usize, count: usize| at as f64 / (count - 1).max(1) as f64;
        let [east, south, up] = [share(x, width), share(y, height), share(z, layers)];
        let aside = match layers {
            1 => (2.0 * east - 1.0).abs(),
            _ => (2.0 * east - 1.0).hypot(2.0 * south - 1.0) / 2.0_f64.sqrt(),
        };
        let share = match self.cheap {
            CheapPlace::West => east,
            CheapPlace::East => 1.0 - east,
            CheapPlace::South => 1.0 - south,
            CheapPlace::North => south,
            CheapPlace::Bottom => up,
            CheapPlace::Top => 1.0 - up,
            CheapPlace::Middle => aside,
            CheapPlace::Sides => 1.0 - aside,
            CheapPlace::Core => 1.0 - depth,
        };
        1.0 + self.strength * share
    }
}
