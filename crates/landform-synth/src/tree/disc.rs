//! Hills and massifs over discs.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::region::Region;
use super::surface::{Samples, Surface, falloff, falloff_slope};
use super::{Bounds, NAME};
use crate::error::Checks;
use crate::fractal::{Frame, NoiseSurface, Scratch};
use crate::{FractalNoise, SynthError};

/// A hill or a massif over a disc. The elevation is that of the centre plus what the noise rises
/// from there, `h(p) = height + t(p) - t(center)`; the weight fades towards the rim,
/// `a = (1 - d^2 / r^2)^3`. L is that of the noise, A is `1.717 / r`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Disc {
    /// Centre: east and north of the south-western node.
    #[schemars(inner(range(min = -1e12, max = 1e12)), extend("x-unit" = "m"))]
    pub center_m: [f64; 2],
    /// Distance at which the weight has faded.
    #[schemars(range(min = 1e-6, max = 1e12), extend("x-unit" = "m"))]
    pub radius_m: f64,
    /// Height of the centre.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub height_m: f64,
    /// Detail; without it the disc is level, and only its weight shapes the ground.
    pub noise: Option<FractalNoise>,
}

impl Default for Disc {
    fn default() -> Self {
        Self { center_m: [0.0; 2], radius_m: 200.0, height_m: 50.0, noise: None }
    }
}

/// A disc made ready.
#[derive(Debug)]
pub(super) struct DiscSurface {
    disc: Disc,
    noise: Option<NoiseSurface>,
    /// Height of the noise at the centre.
    noise_at_center: f64,
}

impl DiscSurface {
    pub fn new(disc: &Disc, frame: &Frame, seed: u64) -> Result<Self, SynthError> {
        let checks = Checks(NAME);
        checks.place("center_m", disc.center_m)?;
        checks.length("radius_m", disc.radius_m, 1e-6)?;
        checks.elevation("height_m", disc.height_m)?;
        let noise = disc.noise.map(|noise| NoiseSurface::new(noise, frame, seed));
        let noise = noise.transpose().map_err(|error| error.within("noise"))?;
        let mut center = [0.0];
        if let Some(noise) = &noise {
            noise.heights(&mut [disc.center_m], &mut Scratch::new(1), &mut center);
        }
        Ok(Self { disc: *disc, noise, noise_at_center: center[0] })
    }
}

impl Surface for DiscSurface {
    fn sample(&self, points: &[[f64; 2]]) -> Samples {
        let Disc { center_m: [x, y], radius_m, height_m, .. } = self.disc;
        let weight = points.iter().map(|point| {
            let [east, north] = [point[0] - x, point[1] - y];
            falloff(east * east + north * north, radius_m)
        });
        let mut samples =
            Samples { weight: weight.collect(), elevation: vec![height_m; points.len()] };
        let Some(noise) = &self.noise else { return samples };
        // Only what has weight is worth making noise for.
        let within: Vec<usize> =
            (0..points.len()).filter(|&number| samples.weight[number] > 0.0).collect();
        let mut places: Vec<[f64; 2]> = within.iter().map(|&number| points[number]).collect();
        let mut heights = vec![0.0; within.len()];
        noise.heights(&mut places, &mut Scratch::new(within.len()), &mut heights);
        for (number, height) in within.into_iter().zip(heights) {
            samples.elevation[number] += height - self.noise_at_center;
        }
        samples
    }

    fn support(&self) -> Region {
        Region::around(self.disc.center_m, self.disc.radius_m)
    }

    fn range(&self, _region: &Region) -> [f64; 2] {
        let Disc { radius_m, height_m, .. } = self.disc;
        let Some(noise) = &self.noise else { return [height_m; 2] };
        let bound = noise.bound();
        let farthest = bound.slope * radius_m;
        let [least, most] = bound.range.map(|height| height - self.noise_at_center);
        [height_m + least.max(-farthest), height_m + most.min(farthest)]
    }

    fn bounds(&self, region: &Region) -> Bounds {
        if self.support().intersection(region).is_empty() {
            return Bounds::NOTHING;
        }
        let slope = self.noise.as_ref().map_or(0.0, |noise| noise.bound().slope);
        Bounds::new(self.range(region), slope, [0.0, 1.0], falloff_slope(self.disc.radius_m))
    }
}
