//! Dendrites by path planning.

mod endpoints;
mod grow;
mod intensity;
mod least_cost;
mod refine;
#[cfg(test)]
mod tests;
mod weights;

pub use endpoints::{EndShape, Endpoints};
pub use grow::Grown;
pub use least_cost::{came_from, least_costs};
pub use weights::{CheapPlace, EdgeWeights, WeightBias, WeightTable};

use std::path::Path;

use landform_graph::Lattice;
use landform_graph::marching::{FastMarching, MarchOptions};
use landform_sim::initial::{InitialCondition, InitialContext};
use landform_sim::parameters::Problem;
use landform_sim::random::RandomStream;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::branching::{BranchWidth, Branching, Shown, paint};
use crate::error::Checks;
use crate::scenario::refusal;
use crate::{Generator, Mask, SynthError};

/// Name of the generator in messages.
const NAME: &str = "Dendrite";

/// Most rounds.
const MOST_ROUNDS: u32 = 32;

/// A dendrite by path planning (Xu 2008, "Modeling dendritic shapes using path planning"): the
/// cheapest paths over a lattice with random weights from end points to a generator.
///
/// In later rounds more end points, nearer to the dendrite, are joined to what has grown, which makes
/// it a fractal. Several generators compete for space: each end point joins the one to which its
/// path is cheapest, and the trees never meet.
///
/// # Limits
/// Paths do not leave the lattice; lines, tubes and distances do not go round periodic axes. At most
/// 268 million edges, 10 million end points a round.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Dendrite {
    /// Roots of the trees, as shares of the lattice from west to east, south to north and bottom to top.
    /// The nearest node where something may grow counts.
    pub generators: Vec<[f64; 3]>,
    /// Where the branches of the first round end.
    pub endpoints: Endpoints,
    /// How the weights of edges are drawn.
    pub weights: EdgeWeights,
    /// The later rounds.
    pub rounds: Rounds,
    /// What the edges of former paths cost in later rounds, as a share of what they did before: 0
    /// makes the dendrite a generator; with more, later branches run beside earlier ones
    /// for a while.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "Xu 2008, section 3.3.2, D"))]
    pub former_paths: f64,
    /// Where something may grow: nodes with a value of at least half way between `outside` and
    /// `inside`. Everywhere when missing.
    pub within: Option<Mask>,
    /// What weights are multiplied with: a picture, say.
    pub factor: Option<Mask>,
    /// How thick branches are.
    pub width: BranchWidth,
    /// Finer paths.
    pub refinement: Refined,
    /// How often courses are smoothed: every node goes half way to the middle between its
    /// neighbours on the branch.
    #[schemars(range(max = 100))]
    pub smoothing: u32,
    /// Seed of its random numbers, so that several fields and files show the same dendrite; of the run
    /// when missing.
    pub seed: Option<u64>,
    /// What is shown of it.
    pub show: DendriteShown,
    /// Factor of what is shown.
    #[schemars(range(min = -1e12, max = 1e12))]
    pub scale: f64,
}

impl Default for Dendrite {
    fn default() -> Self {
        Self {
            generators: vec![[0.5; 3]],
            endpoints: Endpoints::default(),
            weights: EdgeWeights::default(),
            rounds: Rounds::default(),
            former_paths: 0.0,
            within: None,
            factor: None,
            width: BranchWidth::default(),
            refinement: Refined::default(),
            smoothing: 0,
            seed: None,
            show: DendriteShown::default(),
            scale: 1.0,
        }
    }
}

/// The rounds of a fractal dendrite (Xu 2008, section 3.3.2, figure 3.12).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Rounds {
    /// Number of rounds; 1 is a simple dendrite.
    #[schemars(range(min = 1, max = 32))]
    pub count: u32,
    /// How many times more end points a round has than the one before.
    #[schemars(range(min = 0.0, max = 1000.0), extend("x-source" = "Xu 2008, figure 3.12, beta"))]
    pub branching: f64,
    /// How many times smaller their path costs are than in the round before.
    #[schemars(range(min = 0.01, max = 1000.0), extend("x-source" = "Xu 2008, figure 3.12, alpha"))]
    pub attenuation: f64,
    /// Path cost from the dendrite to the end points of the second round, as a share of the greatest
    /// cost from a generator.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "Xu 2008, figure 3.12, d"))]
    pub cost: f64,
    /// How far costs may be from it, as a share of it.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "Xu 2008, figure 3.12, r"))]
    pub spread: f64,
}

impl Default for Rounds {
    fn default() -> Self {
        Self { count: 1, branching: 3.0, attenuation: 2.0, cost: 0.2, spread: 0.1 }
    }
}

/// Paths that are planned again on sub-lattices (Xu 2008, section 4.4).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Refined {
    /// Nodes along a side of the sub-lattice of a node: odd; 1 keeps paths as they are.
    #[schemars(range(min = 1, max = 31))]
    pub parts: u32,
    /// Share of the old weight in the new one; the rest is random.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "Xu 2008, section 4.4, e: 0.5 to 1"))]
    pub faith: f64,
}

impl Default for Refined {
    fn default() -> Self {
        Self { parts: 1, faith: 0.75 }
    }
}

/// What a field shows of a dendrite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum DendriteShown {
    /// Its branches.
    Branches(Shown),
    /// Its light, from 0 to 1: by path cost, so that edges are ragged (section 4.3). Courses are
    /// neither finer nor smooth.
    Intensity,
    /// Cost of the cheapest path to every node; 0 where nothing leads.
    PathCost,
}

impl Default for DendriteShown {
    fn default() -> Self {
        Self::Branches(Shown::default())
    }
}

/// A dendrite and what it grew on.
struct Plan {
    grown: Grown,
    table: WeightTable,
    seed: u64,
}

impl Dendrite {
    /// The dendrite on its lattice; `seed` counts unless it has its own. Files of masks are relative to
    /// `folder`.
    ///
    /// # Errors
    /// [`SynthError`] if a parameter is out of its range, a mask cannot be read, or nothing can grow.
    pub fn grow(&self, folder: &Path, lattice: &Lattice, seed: u64) -> Result<Grown, SynthError> {
        self.plan(folder, lattice, seed).map(|plan| plan.grown)
    }

    /// The dendrite as branches, as [`Dendrite::grow`] makes it, with its widths, finer and smooth.
    ///
    /// # Errors
    /// As there.
    pub fn branching(
        &self,
        folder: &Path,
        lattice: &Lattice,
        seed: u64,
    ) -> Result<Branching, SynthError> {
        Ok(self.branches(lattice, &self.plan(folder, lattice, seed)?))
    }

    /// One value a node, as [`DendriteShown`] says.
    ///
    /// # Errors
    /// As [`Dendrite::grow`].
    pub fn values_from(
        &self,
        folder: &Path,
        lattice: &Lattice,
        seed: u64,
    ) -> Result<Vec<f64>, SynthError> {
        let plan = self.plan(folder, lattice, seed)?;
        let mut values = match self.show {
            DendriteShown::Branches(shown) => paint(&self.branches(lattice, &plan), lattice, shown),
            DendriteShown::PathCost => {
                let reached = |&cost: &f64| if cost.is_finite() { cost } else { 0.0 };
                plan.grown.costs.iter().map(reached).collect()
            }
            DendriteShown::Intensity => {
                let mut coarse = coarse(lattice, &plan.grown);
                self.width.apply(&mut coarse);
                let (table, weights) = (&plan.table, &self.weights);
                intensity::intensity(lattice, table, weights, &plan.grown, &coarse.radii)?
            }
        };
        values.iter_mut().for_each(|value| *value *= self.scale);
        Ok(values)
    }

    /// Refuses parameters out of their ranges, before anything is read or grown.
    ///
    /// # Errors
    /// [`SynthError`] names the parameter.
    pub fn check(&self) -> Result<(), SynthError> {
        let checks = Checks(NAME);
        if self.generators.is_empty() {
            return Err(unusable("generators", "there is none; name at least one".to_owned()));
        }
        for share in self.generators.iter().flatten() {
            checks.range("generators", *share, 0.0..=1.0)?;
        }
        self.endpoints.check(&checks)?;
        self.weights.check(&checks)?;
        let rounds = &self.rounds;
        checks.range("rounds.count", f64::from(rounds.count), 1.0..=f64::from(MOST_ROUNDS))?;
        checks.range("rounds.branching", rounds.branching, 0.0..=1000.0)?;
        checks.range("rounds.attenuation", rounds.attenuation, 0.01..=1000.0)?;
        checks.range("rounds.cost", rounds.cost, 0.0..=1.0)?;
        checks.range("rounds.spread", rounds.spread, 0.0..=1.0)?;
        checks.range("former_paths", self.former_paths, 0.0..=1.0)?;
        self.width.check(&checks)?;
        checks.range("refinement.parts", f64::from(self.refinement.parts), 1.0..=31.0)?;
        if self.refinement.parts.is_multiple_of(2) {
            let problem = "a sub-lattice has a node in its middle: give an odd number".to_owned();
            return Err(unusable("refinement.parts", problem));
        }
        checks.range("refinement.faith", self.refinement.faith, 0.0..=1.0)?;
        checks.range("smoothing", f64::from(self.smoothing), 0.0..=100.0)?;
        checks.elevation("scale", self.scale)
    }

    fn plan(&self, folder: &Path, lattice: &Lattice, seed: u64) -> Result<Plan, SynthError> {
        self.check()?;
        let seed = self.seed.unwrap_or(seed);
        let factors = self.factors(folder, lattice)?;
        let table = self.weights.table(lattice, factors.as_deref(), seed)?;
        let free = factors.unwrap_or_else(|| vec![1.0; lattice.node_count()]);
        let generators: Vec<usize> =
            self.generators.iter().filter_map(|&place| place_node(lattice, &free, place)).collect();
        if generators.is_empty() {
            return Err(unusable("within", "nothing may grow anywhere on the lattice".to_owned()));
        }
        let (grown, table) = grow::grow(self, lattice, table, &generators, seed)?;
        Ok(Plan { grown, table, seed })
    }

    /// What weights are multiplied with at every node, infinite where nothing may grow; none if they are
    /// all 1.
    fn factors(&self, folder: &Path, lattice: &Lattice) -> Result<Option<Vec<f64>>, SynthError> {
        if self.within.is_none() && self.factor.is_none() && self.weights.biases.is_empty() {
            return Ok(None);
        }
        let mut factors = vec![1.0; lattice.node_count()];
        if let Some(mask) = &self.within {
            let half = 0.5 * (mask.outside + mask.inside);
            let up = mask.inside >= mask.outside;
            let values = mask.values_from(folder, lattice).map_err(|e| e.within("within"))?;
            for (factor, value) in factors.iter_mut().zip(values) {
                if (value >= half) != up {
                    *factor = f64::INFINITY;
                }
            }
        }
        let depths = self.depths(lattice, &factors)?;
        for bias in &self.weights.biases {
            for (node, factor) in factors.iter_mut().enumerate() {
                *factor *= bias.factor(lattice, node, depths.get(node).copied().unwrap_or(0.0));
            }
        }
        if let Some(mask) = &self.factor {
            let values = mask.values_from(folder, lattice).map_err(|e| e.within("factor"))?;
            for (factor, value) in factors.iter_mut().zip(values) {
                Checks(NAME).range("factor", value, 1e-6..=1e6)?;
                *factor *= value;
            }
        }
        Ok(Some(factors))
    }

    /// Distance of every node from where nothing may grow, as a share of the greatest; empty where no
    /// bias asks for it.
    fn depths(&self, lattice: &Lattice, factors: &[f64]) -> Result<Vec<f64>, SynthError> {
        if !self.weights.biases.iter().any(|bias| bias.cheap == CheapPlace::Core) {
            return Ok(Vec::new());
        }
        let is_border = |node: usize| {
            factors[node].is_infinite() || lattice.neighbours(node).count() < lattice.directions()
        };
        let starts: Vec<_> = (0..lattice.node_count()).filter(|&node| is_border(node)).collect();
        let mut march = FastMarching::new();
        let times = march.distance(lattice, &starts, MarchOptions::default());
        let times = times.map_err(|error| unusable("weights", error.to_string()))?.time;
        let most = times.iter().copied().filter(|time| time.is_finite()).fold(0.0, f64::max);
        Ok(times.iter().map(|time| (time / most.max(f64::MIN_POSITIVE)).min(1.0)).collect())
    }

    fn branches(&self, lattice: &Lattice, plan: &Plan) -> Branching {
        let mut branching = match self.refinement.parts {
            1 => coarse(lattice, &plan.grown),
            parts => refine::Refinement {
                lattice,
                table: &plan.table,
                parts: parts as usize,
                faith: self.refinement.faith,
                random: RandomStream::new(plan.seed, "refined weights"),
            }
            .refine(&plan.grown),
        };
        branching.smooth(self.smoothing);
        self.width.apply(&mut branching);
        branching
    }
}

impl Generator for Dendrite {
    fn generate(&self, lattice: &Lattice, seed: u64) -> Result<Vec<f64>, SynthError> {
        self.values_from(Path::new(""), lattice, seed)
    }
}

impl InitialCondition for Dendrite {
    const NAME: &'static str = NAME;

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        self.values_from(context.folder, &context.domain.lattice, context.seed).map_err(refusal)
    }
}

/// The nodes of a dendrite as branches without width.
fn coarse(lattice: &Lattice, grown: &Grown) -> Branching {
    let positions: Vec<_> =
        grown.nodes.iter().map(|&node| lattice.position(node).to_array()).collect();
    Branching { radii: vec![0.0; positions.len()], positions, parents: grown.parents.clone() }
}

/// The node nearest to a place, given as shares of the lattice, among those of finite cost; of equally
/// near ones the first.
fn place_node(lattice: &Lattice, costs: &[f64], place: [f64; 3]) -> Option<usize> {
    let top = lattice.size().map(|nodes| (nodes - 1) as f64 * lattice.spacing());
    let at = [0, 1, 2].map(|axis| place[axis] * top[axis]);
    let away = |node: usize| crate::branching::distance(lattice.position(node).to_array(), at);
    (0..lattice.node_count())
        .filter(|&node| costs[node].is_finite())
        .min_by(|&a, &b| away(a).total_cmp(&away(b)))
}

fn unusable(parameter: &'static str, problem: String) -> SynthError {
    SynthError::Unusable { generator: NAME, parameter, problem }
}
