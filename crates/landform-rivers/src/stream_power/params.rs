//! What the model may be asked for.

use landform_graph::{Connectivity, Lattice};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::RiverError;
use crate::water::{Side, border_nodes};

/// Ground that rises, rivers that cut it down by stream power, and hillslopes that creep.
///
/// ```text
/// dz/dt = U - K A^m S^n + D lap(z)
/// ```
///
/// with A the area that drains to the node, S the slope to the neighbour that takes its water (D8), lap
/// the Laplacian. A river at rest has the slopes (U / K)^(1/n) A^(-m/n); a change of its base level runs
/// upstream at n K A^m S^(n-1). Lakes fill their depressions and spill over the lowest point of their rims;
/// nothing is cut under water.
///
/// An iteration finds where water goes, raises the ground and solves incision along the rivers from their
/// mouths upwards by backward Euler, which is stable for steps of any length. Half of the creep comes
/// before that, half after it, each in as many explicit steps as stability needs. The field
/// `drainage_area` is the area map, `erosion_rate` what streams and creep removed; the field `uplift`
/// (m/yr) is added to `uplift_m_per_yr`.
///
/// # Conserves
/// The bed but for uplift, incision and what creeps over the base level, each booked by the ledger:
/// rivers carry rock away at once.
///
/// # Limits
/// Eight neighbours; D8 runs in eight directions. First order in time: a knickpoint that crosses many
/// nodes a step is smeared.
///
/// # Source
/// Howard 1994, A detachment-limited model of drainage basin evolution; scheme: Braun and Willett 2013,
/// A very efficient O(n), implicit and parallel method to solve the stream power equation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StreamPowerErosion {
    /// Erodibility K, in metres a year where the area is a square metre and the slope is 1.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m/yr"))]
    pub erodibility_m_per_yr: f64,
    /// Exponent m of the area.
    #[schemars(range(min = 0.0, max = 3.0), extend("x-source" = "thesis 4.3.1: 0.5"))]
    pub area_exponent: f64,
    /// Exponent n of the slope.
    #[schemars(range(min = 0.2, max = 5.0), extend("x-source" = "thesis 4.3.1: close to 1"))]
    pub slope_exponent: f64,
    /// Diffusivity D of creep.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m2/yr"))]
    pub diffusivity_m2_per_yr: f64,
    /// Uplift U everywhere but at the base level.
    #[schemars(range(min = -1e6, max = 1e6), extend("x-unit" = "m/yr"))]
    pub uplift_m_per_yr: f64,
    /// Time that an iteration stands for.
    #[schemars(range(min = 1e-6, max = 1e9), extend("x-unit" = "yr"))]
    pub step_yr: f64,
    /// Borders whose nodes keep their height, and over which water leaves. The others are walls. Every
    /// open border when missing.
    pub base_level: Option<Vec<Side>>,
    /// Level of a sea: ground below it keeps its height and takes the water; to the land around it the
    /// sea is ground at its level.
    #[schemars(range(min = -1e5, max = 1e5), extend("x-unit" = "m"))]
    pub sea_level_m: Option<f64>,
}

impl Default for StreamPowerErosion {
    fn default() -> Self {
        Self {
            erodibility_m_per_yr: 1e-5,
            area_exponent: 0.5,
            slope_exponent: 1.0,
            diffusivity_m2_per_yr: 0.01,
            uplift_m_per_yr: 1e-3,
            step_yr: 1e4,
            base_level: None,
            sea_level_m: None,
        }
    }
}

/// Largest diffusion in a step, in squares of the spacing: two thirds of what keeps the nine-point
/// formula from making new extremes (6/20).
const STABLE: f64 = 0.2;

/// Most steps of creep an iteration.
const MOST_STEPS: f64 = 1000.0;

impl StreamPowerErosion {
    /// Checks that the settings suit the lattice.
    ///
    /// # Errors
    /// [`RiverError::Directions`]; [`RiverError::NoBorder`]; [`RiverError::NoOutlet`] if there is neither
    /// a border nor a sea to take the water; [`RiverError::LongStep`] if creep needs too many steps.
    pub fn check(&self, lattice: &Lattice) -> Result<(), RiverError> {
        if lattice.connectivity() != Connectivity::Eight {
            return Err(RiverError::Directions(lattice.connectivity()));
        }
        let sides = self.base_level_sides(lattice);
        if let Some(side) = sides.iter().find(|side| !side.is_open(lattice)) {
            return Err(RiverError::NoBorder { border: side.border() });
        }
        if sides.is_empty() && self.sea_level_m.is_none() {
            return Err(RiverError::NoOutlet);
        }
        let steps = self.creep_steps(lattice);
        if steps <= MOST_STEPS {
            return Ok(());
        }
        Err(RiverError::LongStep {
            step_yr: self.step_yr,
            most_yr: self.step_yr * MOST_STEPS / steps,
        })
    }

    /// Steps of creep that an iteration needs.
    pub(super) fn creep_steps(&self, lattice: &Lattice) -> f64 {
        let diffusion = self.diffusivity_m2_per_yr * self.step_yr / lattice.spacing().powi(2);
        (diffusion / STABLE).ceil()
    }

    /// Nodes of the borders that are base level, in order.
    pub(super) fn base_level_nodes(&self, lattice: &Lattice) -> Vec<usize> {
        let sides = self.base_level_sides(lattice);
        let mut nodes: Vec<usize> =
            sides.into_iter().flat_map(|side| border_nodes(lattice, side)).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    fn base_level_sides(&self, lattice: &Lattice) -> Vec<Side> {
        let open = || Side::ALL.into_iter().filter(|side| side.is_open(lattice)).collect();
        self.base_level.clone().unwrap_or_else(open)
    }
}
