//! Solids put together.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::VolumeNode;
use super::solid::{Place3, Solid};

/// Several solids with rounded seams: the polynomial minimum `min(a, b) - max(k - |a - b|, 0)^2 /
/// (4 k)` of one after another, for a union; its mirror image for an intersection. L is the largest
/// of theirs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Blended {
    /// The solids.
    pub of: Vec<VolumeNode>,
    /// Width k of the seam; 0 for a sharp one.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m"))]
    pub width_m: f64,
}

/// A solid without what another one takes away: `max(a, -b)`, with a seam as in [`Blended`]. L is
/// the larger of theirs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cut {
    /// What is left of it.
    pub of: Box<VolumeNode>,
    /// What is taken away.
    pub by: Box<VolumeNode>,
    /// Width of the seam; 0 for a sharp one.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m"))]
    pub width_m: f64,
}

/// How solids are put together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meeting {
    Union,
    Intersection,
    /// The first without all others.
    Difference,
}

/// Solids put together, made ready.
#[derive(Debug)]
pub(super) struct BlendedSolid {
    pub meeting: Meeting,
    /// At least one.
    pub of: Vec<Box<dyn Solid>>,
    pub width: f64,
}

impl Solid for BlendedSolid {
    fn value(&self, place: Place3) -> f64 {
        let mut values = self.of.iter().map(|solid| solid.value(place));
        let first = values.next().unwrap_or(f64::INFINITY);
        match self.meeting {
            Meeting::Union => values.fold(first, |a, b| least(a, b, self.width)),
            Meeting::Intersection => values.fold(first, |a, b| -least(-a, -b, self.width)),
            Meeting::Difference => values.fold(first, |a, b| -least(-a, b, self.width)),
        }
    }

    fn slope(&self) -> f64 {
        self.of.iter().map(|solid| solid.slope()).fold(0.0, f64::max)
    }
}

/// The lesser of two, with a smooth change from one to the other where they differ by less than
/// `width`. Its gradient is a mean of theirs, and so no longer than the longer one.
fn least(a: f64, b: f64, width: f64) -> f64 {
    let seam = (width - (a - b).abs()).max(0.0);
    let dip = if seam > 0.0 { seam * seam / (4.0 * width) } else { 0.0 };
    a.min(b) - dip
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seams_are_smooth_and_as_wide_as_asked() {
        assert_eq!(least(1.0, 3.0, 2.0), 1.0);
        assert_eq!(least(2.0, 2.0, 2.0), 1.5);
        assert_eq!(least(2.0, 3.0, 0.0), 2.0);
        let steps: Vec<f64> =
            (0..=400).map(|step| least(0.0, 0.01 * f64::from(step) - 2.0, 1.0)).collect();
        assert!(steps.windows(3).all(|three| (three[2] - 2.0 * three[1] + three[0]).abs() < 1e-4));
    }
}
