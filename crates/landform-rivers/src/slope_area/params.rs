//! What the model may be asked for.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a river does that comes to a local minimum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Pits {
    /// It ends there, and the minimum stays as high as it is (thesis, section 4.4.5).
    #[default]
    End,
    /// It fills the depression and flows on over the lowest point of its rim, which it cuts down:
    /// lakes drain, and all water leaves the domain over its borders.
    Spill,
}

/// The erosion model of Rodriguez-Iturbe and Rinaldo (thesis, sections 2.3.2 and 4.4.5, figures
/// 2.10 and 4.25): rivers cut down the sites at which the stress of their water is too large.
///
/// Every site drains to the steepest of its eight neighbours (D8). Its stress is `sqrt(A) S`: A
/// the area that it drains, in m², S the slope to the neighbour. Where that is above
/// `threshold_m` the site is lowered to `z_next + d threshold_m / sqrt(A)`, d the distance to the
/// neighbour. All such sites erode at once, an iteration; then the network is found anew. At
/// rest, slope falls with area as `S = threshold_m A^-0.5` where rivers have cut. The field
/// `drainage_area` is the area map.
///
/// # Conserves
/// The bed but for what is eroded, which the ledger books: rivers carry it away at once.
///
/// # Limits
/// Eight neighbours, open borders. Rivers are infinitely thin and run in eight directions. No
/// hillslopes: a site that drains only itself erodes as a river does. The book erodes one site
/// at a time, here all do.
///
/// # Source
/// Rinaldo, Rodriguez-Iturbe, Rigon, Bras and Ijjasz-Vasquez 1993, Self-organized fractal river
/// networks; Rodriguez-Iturbe and Rinaldo 1997, Fractal River Basins.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SlopeAreaErosion {
    /// Largest stable product of slope and square root of area: the slope at which a site that
    /// drains a square of this side is stable at 45 degrees.
    #[schemars(range(min = 1e-9, max = 1e9), extend("x-unit" = "m"))]
    pub threshold_m: f64,
    /// What a river does that comes to a local minimum.
    pub pits: Pits,
}

impl Default for SlopeAreaErosion {
    fn default() -> Self {
        Self { threshold_m: 1.0, pits: Pits::End }
    }
}
