//! Landforms along curves.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::region::Region;
use super::surface::{Samples, Surface, falloff, falloff_slope};
use super::{Bounds, NAME};
use crate::SynthError;
use crate::course::Course;
use crate::error::{Checks, check_steps};

/// A river bed, a valley, a dike or a ridge along a curve of straight pieces:
/// `h(p) = z(p) + c(d)`, where d is the distance to the curve, c the cross-section and z the
/// height of the curve; the weight is `a = (1 - d^2 / r^2)^3`.
///
/// On the curve, z is its height there. Beside it, z is not simply taken from the nearest place,
/// which would tear the ground where two places of a bend are equally near, but half-way between
/// McShane's greatest and least extension, `min over q of (z_q + s |p - q|)` and
/// `max over q of (z_q - s |p - q|)`, which beside a straight piece is the height of the nearest
/// place. `s` is the steepest slope in a straight line from point to point of the curve, at least
/// 2 and at most 32 times the steepest slope along it.
///
/// L is s plus the steepest slope of the cross-section, A is `1.717 / r`.
///
/// # Limits
/// Where the curve nearly meets itself at another height, so that 32 times is too little, the
/// heights of both arms are drawn together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Curve {
    /// Its points: east and north of the south-western node, and height. At least two.
    #[schemars(inner(inner(range(min = -1e12, max = 1e12))), extend("x-unit" = "m"))]
    pub points_m: Vec<[f64; 3]>,
    /// Cross-section: `(distance from the curve, height above the curve)` with increasing
    /// distances, joined by straight lines; level before the first and after the last. Empty
    /// means level.
    #[schemars(inner(inner(range(min = -1e12, max = 1e12))), extend("x-unit" = "m"))]
    pub profile_m: Vec<[f64; 2]>,
    /// Distance at which the weight has faded.
    #[schemars(range(min = 1e-6, max = 1e12), extend("x-unit" = "m"))]
    pub reach_m: f64,
}

impl Default for Curve {
    fn default() -> Self {
        Self {
            points_m: vec![[0.0, 0.0, 0.0], [1000.0, 0.0, 0.0]],
            profile_m: Vec::new(),
            reach_m: 100.0,
        }
    }
}

/// A curve made ready.
#[derive(Debug)]
pub(super) struct CurveSurface {
    course: Course,
    profile: Vec<[f64; 2]>,
    reach: f64,
}

impl CurveSurface {
    pub fn new(curve: &Curve) -> Result<Self, SynthError> {
        let checks = Checks(NAME);
        checks.length("reach_m", curve.reach_m, 1e-6)?;
        for &[x, y, height] in &curve.points_m {
            checks.place("points_m", [x, y])?;
            checks.elevation("points_m", height)?;
        }
        check_steps(NAME, "profile_m", &curve.profile_m, 0)?;
        for &point in &curve.profile_m {
            checks.place("profile_m", point)?;
        }
        let course = Course::new(&curve.points_m).ok_or_else(|| SynthError::Unusable {
            generator: NAME,
            parameter: "points_m",
            problem: match curve.points_m.len() {
                count @ 0..2 => format!("{count} points; a curve takes at least two"),
                _ => "all points are at one place; a curve takes two places".to_owned(),
            },
        })?;
        Ok(Self { course, profile: curve.profile_m.clone(), reach: curve.reach_m })
    }

    /// Height of the cross-section above the curve.
    fn profile(&self, distance: f64) -> f64 {
        let next = self.profile.partition_point(|point| point[0] < distance);
        match (next.checked_sub(1).map(|last| self.profile[last]), self.profile.get(next)) {
            (Some([from, low]), Some(&[to, high])) => {
                low + (distance - from) / (to - from) * (high - low)
            }
            (Some([_, height]), None) => height,
            (None, Some(&[_, height])) => height,
            (None, None) => 0.0,
        }
    }
}

impl Surface for CurveSurface {
    fn sample(&self, points: &[[f64; 2]]) -> Samples {
        let mut samples = Samples::none(points.len());
        for (number, &point) in points.iter().enumerate() {
            if let Some(nearest) = self.course.nearest(point, self.reach) {
                let distance = nearest.distance;
                samples.weight[number] = falloff(distance * distance, self.reach);
                let height = self.course.height(point, nearest);
                samples.elevation[number] = height + self.profile(distance);
            }
        }
        samples
    }

    fn support(&self) -> Region {
        let [low, high] = self.course.extent();
        Region { low, high }.grown(self.reach)
    }

    fn range(&self, _region: &Region) -> [f64; 2] {
        let profile = self.profile.iter().map(|point| point[1]);
        let ends = [self.profile(0.0), self.profile(self.reach)];
        let within = profile.zip(&self.profile).filter(|(_, point)| point[0] <= self.reach);
        let [low, high] = within
            .map(|(height, _)| height)
            .fold([ends[0].min(ends[1]), ends[0].max(ends[1])], |[low, high], height| {
                [low.min(height), high.max(height)]
            });
        let [lowest, highest] = self.course.heights();
        [lowest + low, highest + high]
    }

    fn bounds(&self, region: &Region) -> Bounds {
        if self.support().intersection(region).is_empty() {
            return Bounds::NOTHING;
        }
        let pieces = self.profile.windows(2);
        let steepest = pieces
            .map(|pair| ((pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0])).abs())
            .fold(0.0, f64::max);
        let slope = self.course.slope() + steepest;
        Bounds::new(self.range(region), slope, [0.0, 1.0], falloff_slope(self.reach))
    }
}
