//! Dendry: branching patterns as a function that is computed locally.

mod cell;
mod course;
mod fill;
mod forest;
mod function;
mod growth;
mod heights;
mod piece;
mod reference;
#[cfg(test)]
mod tests;
mod window;

use std::path::Path;

use landform_graph::Lattice;
use landform_sim::initial::{InitialCondition, InitialContext};
use landform_sim::parameters::Problem;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use function::DendryFunction;

use crate::error::Checks;
use crate::scenario::refusal;
use crate::{Generator, Node, RadialRamp, SynthError, Terrain};
use cell::Keys;
use growth::Growth;
use heights::Hillslope;

/// Name of the generator in messages.
const NAME: &str = "Dendry";

/// Branching patterns, and terrain with rivers and ridges, from a function that is computed
/// locally (Gaillard et al. 2019, "Dendry: a procedural model for dendritic patterns").
///
/// Level 0 has square cells of `cell_m`, every further level cells of half the width. In every cell
/// lies a key point, at random, at least `epsilon` of the width from its sides; key points of a
/// coarser level are kept. On level 0 a branch leads from every key point to the one with the
/// lowest `control` in the eight cells around it, if that is lower than its own. On finer levels a
/// branch leads from every new key point to the nearest curve of the coarser ones. Branches are
/// smooth curves, with bends that are pushed aside by `displacement`. The tree is all of them:
/// `shows` says what is made of it.
///
/// A value depends on the seed and the place alone, not on the lattice: tiles cut by `from_nodes`
/// fit each other bit for bit.
///
/// # Limits
/// 2-D, open axes. The finest cells must not be smaller than the spacing, or four times that for a
/// terrain. Branches are looked for as far as two cells away, as in the paper; bends pushed far
/// aside may cross other branches. Heights may step where ridges part rivers of different heights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Dendry {
    /// The control function: heights in metres, as a node of a construction tree. Coarse branches
    /// lead to where it is low, and terrain takes its heights from it (section 4.3 of the paper).
    pub control: Node,
    /// Width of a cell of level 0, about the distance between the main branches.
    #[schemars(
        range(min = 1e-6, max = 1e12),
        extend("x-unit" = "m", "x-source" = "Gaillard et al. 2019, section 4.1")
    )]
    pub cell_m: f64,
    /// Number of levels n: 1 has main branches only, every further one adds branches half as long.
    #[schemars(range(min = 1, max = 6), extend("x-source" = "Gaillard et al. 2019, section 3"))]
    pub levels: u32,
    /// Least distance of key points from the sides of their cells, as a share of the width: at 0
    /// they lie anywhere, at 0.5 in the middle.
    #[schemars(
        range(min = 0.0, max = 0.5),
        extend("x-source" = "Gaillard et al. 2019, section 4.3")
    )]
    pub epsilon: f64,
    /// How far at most bends are pushed aside, as a share of the length of the branch: of level 0,
    /// of level 1, and so on; the last counts for all further levels.
    #[schemars(
        length(min = 1, max = 6), inner(range(min = 0.0, max = 0.2)),
        extend("x-source" = "Gaillard et al. 2019, section 4.3")
    )]
    pub displacement: Vec<f64>,
    /// Whether branches are smooth curves that flow into each other; else they are straight from
    /// bend to bend.
    pub smooth: bool,
    /// What is shown of the tree.
    pub shows: DendryView,
    /// Columns and rows of nodes from the place 0, 0 of the function, east and north, to the
    /// south-western node: tiles of one map differ in this. The control function goes with it.
    #[schemars(inner(range(min = -1_000_000_000, max = 1_000_000_000)))]
    pub from_nodes: [i64; 2],
}

/// What is shown of the tree of a [`Dendry`].
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub enum DendryView {
    /// The distance to it in metres (equation 1 of the paper).
    #[default]
    Distance,
    /// Terrain: the tree is a network of rivers from which hillslopes rise.
    Terrain(DendryTerrain),
}

/// Terrain around the tree of a [`Dendry`], whose branches are rivers (section 5 of the paper).
///
/// A river starts at the height `c` of the control function at its key point, or higher: on its way
/// to the river that it joins it falls by the slope `S = least_slope (2 mu - 1)^-0.6` at least
/// (Flint 1974, simplified), where mu is 1 on the finest level and three times as much on every
/// coarser one. It joins at the angle with the cosine `S_river / S` (Howard 1971). Key points three
/// levels finer have the height of the nearest point of the tree plus `tan(steepest)
/// sigma^slope_power` times the distance to it, where sigma goes smoothly from 0 to 1 between the
/// two heights of `relief_m`; in between lies their mean, weighted by `(1 - r^2)^3`, with r the
/// distance in units of two of their cells.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DendryTerrain {
    /// Least slope of the finest branches, rho in Flint's law, in metres a metre.
    #[schemars(
        range(min = 0.0, max = 10.0),
        extend("x-unit" = "m/m", "x-source" = "Gaillard et al. 2019, section 5")
    )]
    pub least_slope: f64,
    /// Angle of the hillslopes of the highest rivers.
    #[schemars(
        range(min = 0.0, max = 85.0),
        extend("x-unit" = "deg", "x-source" = "Gaillard et al. 2019, equation 7")
    )]
    pub steepest_deg: f64,
    /// How hillslopes grow with the height of their river, beta in the paper: 0 for slopes alike, 1
    /// and more for wide valleys and sharp ridges.
    #[schemars(
        range(min = 0.0, max = 2.0),
        extend("x-source" = "Gaillard et al. 2019, equation 7")
    )]
    pub slope_power: f64,
    /// Lowest and highest value of the control function, between which hillslopes grow. Taken
    /// from 33 by 33 places of the lattice when missing: name it where tiles shall fit.
    #[schemars(inner(range(min = -1e12, max = 1e12)), extend("x-unit" = "m"))]
    pub relief_m: Option<[f64; 2]>,
}

impl Default for DendryTerrain {
    fn default() -> Self {
        Self { least_slope: 0.15, steepest_deg: 30.0, slope_power: 0.5, relief_m: None }
    }
}

impl Default for Dendry {
    fn default() -> Self {
        Self {
            control: Node::RadialRamp(RadialRamp::default()),
            cell_m: 250.0,
            levels: 3,
            epsilon: 0.25,
            displacement: vec![0.05],
            smooth: true,
            shows: DendryView::Distance,
            from_nodes: [0; 2],
        }
    }
}

impl Dendry {
    /// The function of these parameters with the random numbers of `seed`, for nodes `spacing_m`
    /// apart. Files of the control function are relative to `folder`.
    ///
    /// # Errors
    /// [`SynthError`] if a parameter is out of its range, or a terrain has no `relief_m`.
    pub fn function(
        &self,
        folder: &Path,
        spacing_m: f64,
        seed: u64,
    ) -> Result<DendryFunction, SynthError> {
        self.check(spacing_m)?;
        let control = self.control(folder, spacing_m, seed)?;
        let (least_slope, hillslope) = self.slopes()?;
        let last = self.displacement.len() - 1;
        let displacement =
            (0..self.levels as usize).map(|level| self.displacement[level.min(last)]);
        let growth = Growth {
            keys: Keys::new(seed, self.epsilon),
            levels: self.levels,
            displacement: displacement.collect(),
            smooth: self.smooth,
            control,
            cell_m: self.cell_m,
            least_slope,
        };
        Ok(DendryFunction { growth, hillslope, spacing_m })
    }

    /// The least slope of rivers and the hillslopes, if there is a terrain.
    fn slopes(&self) -> Result<(Option<f64>, Option<Hillslope>), SynthError> {
        let DendryView::Terrain(terrain) = self.shows else { return Ok((None, None)) };
        let DendryTerrain { least_slope, steepest_deg, slope_power: power, relief_m } = terrain;
        let Some(relief) = relief_m else {
            let parameter = "shows.relief_m";
            let problem =
                "name the lowest and the highest value of the control function".to_owned();
            return Err(SynthError::Unusable { generator: NAME, parameter, problem });
        };
        let steepest = steepest_deg.to_radians().tan();
        Ok((Some(least_slope), Some(Hillslope { steepest, power, relief })))
    }

    /// The control function.
    fn control(&self, folder: &Path, spacing_m: f64, seed: u64) -> Result<Terrain, SynthError> {
        Terrain::of_node(&self.control, "control", folder, spacing_m, seed)
    }

    fn check(&self, spacing_m: f64) -> Result<(), SynthError> {
        let checks = Checks(NAME);
        checks.length("spacing_m", spacing_m, f64::MIN_POSITIVE)?;
        checks.range("levels", f64::from(self.levels), 1.0..=6.0)?;
        let nodes = match self.shows {
            DendryView::Distance => 1.0,
            DendryView::Terrain(_) => 4.0,
        };
        let finest = nodes * spacing_m * f64::from(1_u32 << (self.levels - 1));
        checks.length("cell_m", self.cell_m, finest.max(1e-6))?;
        checks.range("epsilon", self.epsilon, 0.0..=0.5)?;
        if !(1..=6).contains(&self.displacement.len()) {
            let problem = format!("{} numbers; there must be 1 to 6", self.displacement.len());
            return Err(SynthError::Unusable {
                generator: NAME,
                parameter: "displacement",
                problem,
            });
        }
        for &share in &self.displacement {
            checks.range("displacement", share, 0.0..=0.2)?;
        }
        for nodes in self.from_nodes {
            checks.range("from_nodes", nodes as f64, -1e9..=1e9)?;
        }
        let DendryView::Terrain(terrain) = &self.shows else { return Ok(()) };
        checks.range("shows.least_slope", terrain.least_slope, 0.0..=10.0)?;
        checks.range("shows.steepest_deg", terrain.steepest_deg, 0.0..=85.0)?;
        checks.range("shows.slope_power", terrain.slope_power, 0.0..=2.0)?;
        terrain.relief_m.map_or(Ok(()), |relief| checks.place("shows.relief_m", relief))
    }

    /// One value a node.
    fn values_from(
        &self,
        folder: &Path,
        lattice: &Lattice,
        seed: u64,
    ) -> Result<Vec<f64>, SynthError> {
        Checks(NAME).plane(lattice)?;
        for (axis, name) in ['x', 'y'].into_iter().enumerate() {
            if lattice.is_periodic(axis) {
                let remedy = "make the axis open";
                return Err(SynthError::DoesNotClose { generator: NAME, axis: name, remedy });
            }
        }
        let spacing = lattice.spacing();
        let size = [lattice.width(), lattice.height()];
        let mut dendry = self.clone();
        if let DendryView::Terrain(terrain @ DendryTerrain { relief_m: None, .. }) =
            &mut dendry.shows
        {
            terrain.relief_m = Some(self.relief(folder, lattice, seed)?);
        }
        let function = dendry.function(folder, spacing, seed)?;
        Ok(function.values(self.from_nodes, size))
    }

    /// The range of the control function at some places of a lattice.
    fn relief(&self, folder: &Path, lattice: &Lattice, seed: u64) -> Result<[f64; 2], SynthError> {
        const PLACES: usize = 33;
        let control = self.control(folder, lattice.spacing(), seed)?;
        let size = [lattice.width(), lattice.height()];
        let place = |axis: usize, step: usize| {
            let nodes = step as f64 / (PLACES - 1) as f64 * (size[axis] - 1) as f64;
            (self.from_nodes[axis] as f64 + nodes) * lattice.spacing()
        };
        let places: Vec<[f64; 2]> = (0..PLACES * PLACES)
            .map(|number| [place(0, number % PLACES), place(1, number / PLACES)])
            .collect();
        let values = control.elevations(&places);
        Ok(values.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
            [low.min(value), high.max(value)]
        }))
    }
}

impl Generator for Dendry {
    fn generate(&self, lattice: &Lattice, seed: u64) -> Result<Vec<f64>, SynthError> {
        self.values_from(Path::new(""), lattice, seed)
    }
}

impl InitialCondition for Dendry {
    const NAME: &'static str = NAME;

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        self.values_from(context.folder, &context.domain.lattice, context.seed).map_err(refusal)
    }
}
