//! The initial condition `HypsometricGround`.

use landform_analysis::StrahlerCurve;
use landform_sim::initial::{InitialCondition, InitialContext};
use landform_sim::parameters::Problem;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A hypsometric curve: relative heights by the share of the area above them.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub enum KnownCurve {
    /// A member of Strahler's family (thesis, equation 2.9 and figure 2.11).
    Strahler {
        /// Ratio a/d.
        #[schemars(range(min = 0.0, max = 1.0))]
        a_over_d: f64,
        /// Exponent z.
        #[schemars(range(min = 0.0, max = 100.0))]
        z: f64,
    },
    /// Convex throughout, `1 - x^2` (thesis, figure 2.13 a).
    Convex,
    /// More than one inflection, `1 - x + 0.06 sin 4 pi x` (thesis, figure 2.13 b).
    ManyInflections,
    /// Convex above and concave below, `1/2 + 1/2 cos pi x` (thesis, figure 2.13 c).
    Reversed,
}

/// Ground that falls from west to east so that it has a known hypsometric curve: what Strahler's
/// stages look like (thesis, section 2.4.1).
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct HypsometricGround {
    /// The curve.
    pub curve: KnownCurve,
    /// Height of the western side above the eastern one.
    #[schemars(range(min = 1e-6, max = 1e6), extend("x-unit" = "m"))]
    pub relief_m: f64,
}

impl Default for HypsometricGround {
    fn default() -> Self {
        Self { curve: KnownCurve::Strahler { a_over_d: 0.1, z: 0.35 }, relief_m: 100.0 }
    }
}

impl KnownCurve {
    /// Relative height above which a share of the area lies.
    fn heights(self) -> Result<Box<dyn Fn(f64) -> f64>, Problem> {
        use std::f64::consts::PI;
        Ok(match self {
            Self::Strahler { a_over_d, z } => {
                let curve = StrahlerCurve::new(a_over_d, z).ok_or_else(|| {
                    let message = format!("a/d is {a_over_d} and z is {z}");
                    Problem::new(
                        "curve",
                        message,
                        "a ratio between 0 and 1 and an exponent above 0",
                    )
                })?;
                Box::new(move |share| curve.height_at(share))
            }
            Self::Convex => Box::new(|share| 1.0 - share * share),
            Self::ManyInflections => {
                Box::new(|share| 1.0 - share + 0.06 * (4.0 * PI * share).sin())
            }
            Self::Reversed => Box::new(|share| 0.5 + 0.5 * (PI * share).cos()),
        })
    }
}

impl InitialCondition for HypsometricGround {
    const NAME: &'static str = "HypsometricGround";

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        let height = self.curve.heights()?;
        let lattice = &context.domain.lattice;
        let last = lattice.width().saturating_sub(1).max(1) as f64;
        let of_column = |column: usize| self.relief_m * height(column as f64 / last);
        let row: Vec<f64> = (0..lattice.width()).map(of_column).collect();
        Ok((0..lattice.node_count()).map(|node| row[node % lattice.width()]).collect())
    }
}
