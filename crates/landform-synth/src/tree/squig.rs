//! Rivers that wind at all scales.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Curve, NAME};
use crate::SynthError;
use crate::error::Checks;
use crate::exact::squig;

/// A [`Curve`] that winds as a river does: a squig (Mandelbrot 1982; thesis, section 2.3.2 and
/// figure 2.9), which never meets itself. Its height falls evenly along it.
///
/// L and A are those of a curve; it falls less a metre than `from_m` to `to_m` would.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Squig {
    /// Where it begins: east and north of the south-western node, and height.
    #[schemars(inner(range(min = -1e12, max = 1e12)), extend("x-unit" = "m"))]
    pub from_m: [f64; 3],
    /// Where it ends.
    #[schemars(inner(range(min = -1e12, max = 1e12)), extend("x-unit" = "m"))]
    pub to_m: [f64; 3],
    /// How often its pieces are parted: every level halves them. The first are a quarter of the
    /// way long.
    #[schemars(range(min = 0, max = 9), extend("x-source" = "thesis 2.3.2"))]
    pub level: u32,
    /// Chance of the shorter way round every bend: 0.5 is Mandelbrot's squig, of dimension 1.32;
    /// 0.75 gives 1.19, near that of rivers; 1 a straight line.
    #[schemars(range(min = 0.5, max = 1.0))]
    pub shortcut: f64,
    /// Cross-section, as that of a curve.
    #[schemars(inner(inner(range(min = -1e12, max = 1e12))), extend("x-unit" = "m"))]
    pub profile_m: Vec<[f64; 2]>,
    /// Distance at which the weight has faded.
    #[schemars(range(min = 1e-6, max = 1e12), extend("x-unit" = "m"))]
    pub reach_m: f64,
}

impl Default for Squig {
    fn default() -> Self {
        Self {
            from_m: [0.0; 3],
            to_m: [1000.0, 0.0, 0.0],
            level: 5,
            shortcut: 0.75,
            profile_m: Vec::new(),
            reach_m: 100.0,
        }
    }
}

impl Squig {
    /// The curve, with the random numbers of `seed`.
    pub(super) fn curve(&self, seed: u64) -> Result<Curve, SynthError> {
        let checks = Checks(NAME);
        for (name, [x, y, height]) in [("from_m", self.from_m), ("to_m", self.to_m)] {
            checks.place(name, [x, y])?;
            checks.elevation(name, height)?;
        }
        checks.range("level", f64::from(self.level), 0.0..=9.0)?;
        checks.range("shortcut", self.shortcut, 0.5..=1.0)?;
        let [east, north, rise] = [0, 1, 2].map(|axis| self.to_m[axis] - self.from_m[axis]);
        let points = squig(self.level, self.shortcut, seed)?;
        // All pieces are alike in length.
        let pieces = (points.len() - 1) as f64;
        let placed = points.iter().enumerate().map(|(number, [x, y])| {
            [
                self.from_m[0] + east * x - north * y,
                self.from_m[1] + north * x + east * y,
                self.from_m[2] + rise * number as f64 / pieces,
            ]
        });
        Ok(Curve {
            points_m: placed.collect(),
            profile_m: self.profile_m.clone(),
            reach_m: self.reach_m,
        })
    }
}
