//! Still water in a space.

use glam::DVec3;

use super::noise::octaves;
use crate::ViewError;
use crate::light::{Rgb, decode};

/// Water up to a level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pool {
    /// Height of the surface in metres.
    pub level_m: f64,
    /// Share of red, green and blue light that a metre of water takes: light that comes through d
    /// metres is `exp(-k d)` of what went in (Beer and Lambert).
    pub absorption_per_m: [f64; 3],
    /// What deep water looks like in the light of the lamp, sRGB.
    pub colour: [u8; 3],
    /// Slope of ripples on the surface; 0 is a mirror.
    pub ripple: f64,
}

/// Refractive index of water.
const INDEX: f64 = 1.33;

impl Pool {
    pub(super) fn check(&self) -> Result<(), ViewError> {
        let check = ViewError::check_option;
        check("level_m", self.level_m, [-1e12, 1e12], "a number of at most 1e12")?;
        for rate in self.absorption_per_m {
            check("absorption_per_m", rate, [0.0, 1e6], "from 0 to 1e6")?;
        }
        check("ripple", self.ripple, [0.0, 1.0], "from 0 to 1")
    }

    /// Distance along a ray at which it comes to the surface from above.
    pub(super) fn reach(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let is_above = origin.z > self.level_m && direction.z < 0.0;
        is_above.then(|| (self.level_m - origin.z) / direction.z)
    }

    /// Length of a ray below the level, from its origin to `distance`.
    pub(super) fn wet_length(&self, origin: DVec3, direction: DVec3, distance: f64) -> f64 {
        let [from, to] = [origin.z, origin.z + direction.z * distance];
        let depth = |height: f64| (self.level_m - height).max(0.0);
        if direction.z == 0.0 {
            return if depth(from) > 0.0 { distance } else { 0.0 };
        }
        ((depth(from) - depth(to)) / direction.z).abs()
    }

    /// What is left of light after some metres of water, and what the water itself adds where it
    /// is lit by `light`.
    pub(super) fn through(&self, light_in: Rgb, length_m: f64, light: f32) -> Rgb {
        std::array::from_fn(|channel| {
            let left = (-self.absorption_per_m[channel] * length_m).exp() as f32;
            light_in[channel] * left + decode(self.colour[channel]) * light * (1.0 - left)
        })
    }

    /// Normal of the surface at a place.
    pub(super) fn normal(&self, place: DVec3) -> DVec3 {
        /// Metres from crest to crest, about.
        const LENGTH_M: f64 = 0.6;
        const STEP: f64 = 0.01;
        if self.ripple == 0.0 {
            return DVec3::Z;
        }
        let height = |at: DVec3| octaves(30, at / LENGTH_M, 2) * LENGTH_M;
        let here = height(place);
        let slope = [DVec3::X, DVec3::Y].map(|axis| (height(place + axis * STEP) - here) / STEP);
        DVec3::new(-self.ripple * slope[0], -self.ripple * slope[1], 1.0).normalize()
    }

    /// Directions of what is mirrored and of what comes through, and the share of the first (Snell;
    /// Fresnel's law as Schlick 1994 has it).
    pub(super) fn part(&self, place: DVec3, direction: DVec3) -> (DVec3, DVec3, f32) {
        let normal = self.normal(place);
        let cosine = -direction.dot(normal).min(0.0);
        let mut mirrored = direction + normal * (2.0 * cosine);
        // Ripples mirror nothing from below the surface.
        mirrored.z = mirrored.z.abs();
        let sine_below = (1.0 - cosine * cosine).max(0.0) / (INDEX * INDEX);
        let below = (1.0 - sine_below).sqrt();
        let through = direction / INDEX + normal * (cosine / INDEX - below);
        let straight = ((INDEX - 1.0) / (INDEX + 1.0)).powi(2);
        let share = straight + (1.0 - straight) * (1.0 - cosine).powi(5);
        (mirrored.normalize_or(normal), through.normalize_or(-normal), share as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POOL: Pool =
        Pool { level_m: 2.0, absorption_per_m: [0.5, 0.1, 0.0], colour: [0; 3], ripple: 0.0 };

    #[test]
    fn water_takes_light_as_beer_and_lambert_say() {
        let left = POOL.through([1.0, 0.5, 0.25], 3.0, 7.0);
        assert_eq!(left, [(-1.5_f64).exp() as f32, 0.5 * (-0.3_f64).exp() as f32, 0.25]);
        let slant = DVec3::new(0.6, 0.0, -0.8);
        // From 1 m above the surface, 1.25 m through air.
        let origin = DVec3::new(0.0, 0.0, 3.0);
        assert!((POOL.wet_length(origin, slant, 5.0) - 3.75).abs() < 1e-12);
        assert_eq!(POOL.wet_length(origin, slant, 1.0), 0.0);
        assert_eq!(POOL.wet_length(DVec3::ZERO, DVec3::X, 4.0), 4.0, "level and below");
        assert_eq!(POOL.reach(origin, slant), Some(1.25));
        assert_eq!(POOL.reach(origin, -slant), None);
    }

    /// Straight down 2 % comes back and nothing bends; at 60 degrees Snell's law gives 40.63.
    #[test]
    fn water_mirrors_and_bends_rays() {
        let (mirrored, through, share) = POOL.part(DVec3::ZERO, -DVec3::Z);
        assert_eq!((mirrored, through), (DVec3::Z, -DVec3::Z));
        assert!((share - 0.020_06).abs() < 1e-4);
        let (sin, cos) = 60_f64.to_radians().sin_cos();
        let (mirrored, through, share) = POOL.part(DVec3::ZERO, DVec3::new(sin, 0.0, -cos));
        assert!((mirrored - DVec3::new(sin, 0.0, cos)).length() < 1e-12);
        assert!((through.x - sin / INDEX).abs() < 1e-12 && through.z < 0.0);
        assert!((through.length() - 1.0).abs() < 1e-12);
        assert!((f64::from(share) - (0.020_06 + 0.979_94 * 0.5_f64.powi(5))).abs() < 1e-4);
        let rippled = Pool { ripple: 0.2, ..POOL };
        let normal = rippled.normal(DVec3::new(0.2, 0.5, 2.0));
        assert!(normal.z > 0.9 && normal != DVec3::Z);
    }
}
