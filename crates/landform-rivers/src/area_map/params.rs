//! What the model may be asked for.

use landform_graph::{Connectivity, Lattice};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::RiverError;
use crate::water::Side;

/// Hillslopes that creep and valleys that streams cut, by the area that each node drains (thesis,
/// equation 4.3).
///
/// ```text
/// dz/dt = D lap(z) - K max(A^m S^n - theta, 0) + U
/// ```
///
/// with A the area that drains to the node by D8, depressions filled, and S the slope to the neighbour
/// that takes its water. Creep wins on small areas, streams on large ones; where they balance, valleys
/// begin. The length sqrt(D / K) with m = 0.5 and n = 1 sets their spacing. The field `drainage_area` is
/// the area map.
///
/// Explicit Euler, as many steps an iteration as stability takes, with the area map of its beginning.
/// The Laplacian is the compact isotropic nine-point formula.
///
/// # Conserves
/// The bed but for what erodes, what creep deposits, and uplift, which the ledger books.
///
/// # Limits
/// Eight neighbours, open borders. D8 runs in eight directions.
///
/// # Source
/// Perron, Dietrich and Kirchner 2008, Controls on the spacing of first-order valleys.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AreaMapErosion {
    /// Diffusivity D of creep.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m2/yr"))]
    pub diffusivity_m2_per_yr: f64,
    /// Erodibility K, in metres a year where the area is a square metre and the slope is 1.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m/yr"))]
    pub erodibility_m_per_yr: f64,
    /// Exponent m of the area.
    #[schemars(range(min = 0.0, max = 3.0), extend("x-source" = "thesis 4.3.1: 0.5"))]
    pub area_exponent: f64,
    /// Exponent n of the slope. Below 1 changes would run ever faster over ever gentler slopes.
    #[schemars(range(min = 1.0, max = 5.0), extend("x-source" = "thesis 4.3.1: close to 1"))]
    pub slope_exponent: f64,
    /// Threshold theta of area and slope below which streams do not erode.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-source" = "thesis 4.3.1: 0"))]
    pub threshold: f64,
    /// Uplift U.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m/yr"))]
    pub uplift_m_per_yr: f64,
    /// Time that an iteration stands for.
    #[schemars(range(min = 1e-6, max = 1e9), extend("x-unit" = "yr"))]
    pub step_yr: f64,
    /// Borders whose nodes keep their height. All when missing.
    pub base_level: Option<Vec<Side>>,
}

impl Default for AreaMapErosion {
    fn default() -> Self {
        Self {
            diffusivity_m2_per_yr: 0.01,
            erodibility_m_per_yr: 1e-4,
            area_exponent: 0.5,
            slope_exponent: 1.0,
            threshold: 0.0,
            uplift_m_per_yr: 1e-4,
            step_yr: 1000.0,
            base_level: None,
        }
    }
}

/// Largest diffusion in a step, in squares of the spacing.
const STABLE_DIFFUSION: f64 = 0.2;

/// Largest way of a knickpoint in a step, in spacings.
const STABLE_WAY: f64 = 0.5;

/// Most steps an iteration.
const MOST_STEPS: f64 = 1000.0;

impl AreaMapErosion {
    /// Checks that the settings suit the lattice.
    ///
    /// # Errors
    /// [`RiverError::Unsuited`]; [`RiverError::NoBorder`]; [`RiverError::LongStep`].
    pub fn check(&self, lattice: &Lattice) -> Result<(), RiverError> {
        let periodic = lattice.is_periodic(0) || lattice.is_periodic(1);
        if lattice.connectivity() != Connectivity::Eight || periodic {
            return Err(RiverError::Unsuited(lattice.connectivity()));
        }
        // Slopes are not known before; with an exponent of 1 they do not matter.
        let most_area = lattice.node_count() as f64 * lattice.spacing().powi(2);
        self.steps(lattice, most_area, 1.0).map(|_| ())
    }

    /// The sides whose nodes keep their height.
    pub(super) fn fixed_sides(&self) -> Vec<Side> {
        self.base_level.clone().unwrap_or_else(|| Side::ALL.to_vec())
    }

    /// Steps of an iteration with streams that drain at most so much on slopes of at most so much.
    pub(super) fn steps(
        &self,
        lattice: &Lattice,
        area_m2: f64,
        slope: f64,
    ) -> Result<f64, RiverError> {
        let spacing = lattice.spacing();
        let creep = self.diffusivity_m2_per_yr / (STABLE_DIFFUSION * spacing.powi(2));
        // Speed at which a change of height runs upstream.
        let celerity = self.erodibility_m_per_yr
            * area_m2.powf(self.area_exponent)
            * self.slope_exponent
            * slope.powf(self.slope_exponent - 1.0);
        let rate = creep.max(celerity / (STABLE_WAY * spacing));
        let steps = (self.step_yr * rate).ceil().max(1.0);
        if steps <= MOST_STEPS {
            return Ok(steps);
        }
        Err(RiverError::LongStep { step_yr: self.step_yr, most_yr: MOST_STEPS / rate })
    }
}
