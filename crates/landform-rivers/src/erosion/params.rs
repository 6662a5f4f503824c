//! The numbers of hydraulic erosion.

use landform_graph::Lattice;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::RiverError;
use crate::water::Side;

/// Where diffusion smooths the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Diffusion {
    /// Where water flows, in proportion to the flow f: plants hold the ground elsewhere (equation
    /// 4.4).
    #[default]
    InChannels,
    /// Everywhere alike (equation 4.6).
    Everywhere,
}

/// Flowing water erodes the ground, and large rivers the ground beside them (thesis, section 4.3).
///
/// Needs the water that flows, [`WaterColumn`](crate::WaterColumn) before it in the stage. An
/// iteration lowers the bed by equation 4.4,
///
/// ```text
/// dz = max(f w_lap lap(z) - f (w_d |D_s| + w_0) + w_U, z_low - z)   if z > z_low
///      f w_lap lap(z) - f w_0 + w_U                                 otherwise
/// f  = (w_a f_a + w_c f_c)^m
/// ```
///
/// with `lap(z)` the Laplacian, `D_s` the slope along the steepest descent, `z_low` the lowest
/// neighbour, `f_c` the water that the node received, as a share of the most that any did, and `f_a`
/// what large flows add around them: a node adds `avalanche_fraction` of its f_c to every higher node
/// within `f_c avalanche_radius_m`.
///
/// Explicit Euler, as many steps an iteration as stability takes; slopes by quadric fits, the
/// Laplacian by the compact isotropic nine-point formula. Books what erodes, what diffusion
/// deposits, and uplift.
///
/// # Source
/// Thesis, equations 4.4 to 4.6 and tables 4.6 and 4.7, after Perron, Dietrich and Kirchner 2008.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct HydraulicErosion {
    /// Weight w_a of the flow that large rivers add to the ground beside them.
    #[schemars(range(min = 0.0, max = 1e3), extend("x-source" = "thesis, table 4.6 (a)"))]
    pub avalanche_weight: f64,
    /// Weight w_c of the flow of the node itself.
    #[schemars(range(min = 0.0, max = 1e3), extend("x-source" = "thesis, table 4.6 (a)"))]
    pub flow_weight: f64,
    /// Exponent m of the weighted flow. Below 1, small channels erode more beside large ones.
    #[schemars(range(min = 0.01, max = 10.0), extend("x-source" = "thesis, table 4.6 (a)"))]
    pub flow_exponent: f64,
    /// Diffusion w_lap an iteration where f is 1. A larger one smooths channels more.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m2", "x-source" = "thesis, table 4.6 (a)"))]
    pub diffusion_m2: f64,
    /// Incision w_d an iteration where f and the slope are 1.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m", "x-source" = "thesis, table 4.6 (a)"))]
    pub incision_m: f64,
    /// Erosion w_0 an iteration where f is 1, whatever the slope. It brings out small channels.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m", "x-source" = "thesis, table 4.6 (a)"))]
    pub bed_erosion_m: f64,
    /// Uplift w_U an iteration.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m", "x-source" = "thesis, table 4.7"))]
    pub uplift_m: f64,
    /// Where diffusion smooths the ground.
    #[schemars(extend("x-source" = "thesis, equations 4.4 and 4.6"))]
    pub diffusion: Diffusion,
    /// Share of its flow f_c that a node adds to every higher node in reach.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "chosen: the thesis says a fraction"))]
    pub avalanche_fraction: f64,
    /// Reach R_max of a node with the largest flow of all; a node with flow f_c reaches f_c times as
    /// far.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m", "x-source" = "chosen: the thesis says a constant"))]
    pub avalanche_radius_m: f64,
    /// Borders whose nodes keep their height: the level to which rivers erode.
    #[schemars(extend("x-source" = "thesis, figure 4.15: ground beside still water"))]
    pub base_level: Vec<Side>,
    /// Level of a sea: ground below it keeps its height, and land is not worn below it.
    #[schemars(range(min = -1e6, max = 1e6), extend("x-unit" = "m"))]
    pub sea_level_m: Option<f64>,
}

impl Default for HydraulicErosion {
    fn default() -> Self {
        Self {
            avalanche_weight: 1.0,
            flow_weight: 2.0,
            flow_exponent: 0.5,
            diffusion_m2: 10.0,
            incision_m: 3.0,
            bed_erosion_m: 1.5,
            uplift_m: 0.0,
            diffusion: Diffusion::InChannels,
            avalanche_fraction: 0.02,
            avalanche_radius_m: 100.0,
            base_level: Vec::new(),
            sea_level_m: None,
        }
    }
}

/// Largest diffusion in a step, in squares of the spacing: two thirds of what keeps the nine-point
/// formula from making new extremes (6/20).
const STABLE: f64 = 0.2;

/// Most steps an iteration.
const MOST_STEPS: f64 = 200.0;

impl HydraulicErosion {
    /// Checks that the settings suit the lattice.
    ///
    /// # Errors
    /// [`RiverError::Volume`]; [`RiverError::Stiff`]; [`RiverError::NoBorder`].
    pub fn check(&self, lattice: &Lattice) -> Result<(), RiverError> {
        if lattice.connectivity().is_volume() {
            return Err(RiverError::Volume(lattice.connectivity()));
        }
        if let Some(side) = self.base_level.iter().find(|side| !side.is_open(lattice)) {
            return Err(RiverError::NoBorder { border: side.border() });
        }
        let largest_flow = (self.avalanche_weight + self.flow_weight).powf(self.flow_exponent);
        let steps = self.steps(lattice, largest_flow);
        if steps <= MOST_STEPS {
            return Ok(());
        }
        let diffusion_m2 = self.diffusion_m2 * self.diffusion_share(largest_flow);
        let most_m2 = MOST_STEPS * STABLE * lattice.spacing().powi(2);
        Err(RiverError::Stiff { diffusion_m2, steps, most_m2 })
    }

    /// Part of [`HydraulicErosion::diffusion_m2`] that acts where the flow is f.
    #[inline]
    pub(super) fn diffusion_share(&self, f: f64) -> f64 {
        match self.diffusion {
            Diffusion::InChannels => f,
            Diffusion::Everywhere => 1.0,
        }
    }

    /// Steps of an iteration that the largest flow f needs.
    pub(super) fn steps(&self, lattice: &Lattice, largest_flow: f64) -> f64 {
        let diffusion_m2 = self.diffusion_m2 * self.diffusion_share(largest_flow);
        (diffusion_m2 / (STABLE * lattice.spacing().powi(2))).ceil().max(1.0)
    }
}
