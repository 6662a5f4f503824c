//! What rock looks like: materials by slope, put together by masks of noise.

use glam::DVec3;

use super::noise::{noise, octaves};
use crate::ViewError;
use crate::light::{Rgb, decode, mix, smooth_step};

/// The rock around a space. Colours are sRGB.
#[derive(Clone, Debug, PartialEq)]
pub struct Rock {
    /// Sediment on what faces up.
    pub floor: [u8; 3],
    /// Walls.
    pub wall: [u8; 3],
    /// Darker beds in walls.
    pub bed: [u8; 3],
    /// What faces down.
    pub ceiling: [u8; 3],
    /// Streaks of iron and manganese below cracks.
    pub stain: [u8; 3],
    /// Wet flowstone.
    pub flowstone: [u8; 3],
    /// Thickness of a bed with its darker neighbour, in metres.
    pub bed_m: f64,
    /// Size of patches of stain and flowstone, in metres.
    pub patch_m: f64,
    /// Size of the largest bumps that only light shows, in metres.
    pub grain_m: f64,
    /// Slope of those bumps.
    pub relief: f64,
    /// Floors and ceilings are flatter than this, in degrees.
    pub flat_deg: f64,
    /// How much noise has a part in colours and masks: 0 leaves plain colours by slope.
    pub variety: f64,
}

impl Default for Rock {
    fn default() -> Self {
        Self {
            floor: [134, 100, 68],
            wall: [198, 170, 128],
            bed: [146, 112, 78],
            ceiling: [214, 196, 164],
            stain: [150, 82, 42],
            flowstone: [240, 222, 186],
            bed_m: 0.9,
            patch_m: 3.0,
            grain_m: 0.7,
            relief: 0.16,
            flat_deg: 40.0,
            variety: 1.0,
        }
    }
}

/// Rock at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ground {
    pub colour: Rgb,
    /// How much it shines: 0 dull, 1 wet.
    pub gloss: f32,
}

impl Rock {
    pub(super) fn check(&self) -> Result<(), ViewError> {
        let check = ViewError::check_option;
        for (name, length_m) in
            [("bed_m", self.bed_m), ("patch_m", self.patch_m), ("grain_m", self.grain_m)]
        {
            check(name, length_m, [1e-3, 1e6], "from 0.001 to 1e6 m")?;
        }
        check("relief", self.relief, [0.0, 5.0], "from 0 to 5")?;
        check("flat_deg", self.flat_deg, [0.0, 90.0], "from 0 to 90")?;
        check("variety", self.variety, [0.0, 1.0], "from 0 to 1")
    }

    /// The rock at a place whose normal rises by `up`: 1 a floor, -1 a ceiling.
    pub(super) fn at(&self, place: DVec3, up: f64) -> Ground {
        let variety = self.variety as f32;
        // Edges of materials are ragged.
        let ragged = up + 0.22 * self.variety * octaves(11, place / (0.4 * self.patch_m), 3);
        let flat = self.flat_deg.to_radians().cos() as f32;
        let flatter = |edge: f32, up: f64| {
            // What is level is flat whatever the edge.
            let edge = edge.min(1.0 - flat).max(1e-3);
            smooth_step(flat - edge, flat + edge, up as f32)
        };
        let floor = flatter(0.12, ragged);
        let ceiling = flatter(0.25, -ragged);
        let stain = variety * self.streaks(place) * (1.0 - ceiling * 0.6);
        let patch = octaves(13, place / self.patch_m, 3) as f32;
        let flowstone = variety * smooth_step(0.16, 0.34, patch);
        let speckle = 1.0 + 0.3 * variety * octaves(12, place / (0.25 * self.grain_m), 3) as f32;
        let mut colour = mix(self.beds(place), self.ceiling.map(decode), ceiling);
        colour = mix(colour, self.stain.map(decode), 0.75 * stain);
        colour = mix(colour, self.flowstone.map(decode), 0.8 * flowstone);
        colour = mix(colour, self.sediment(place), floor);
        let gloss = (0.15 + 0.85 * flowstone) * (1.0 - 0.7 * floor) * variety;
        Ground { colour: colour.map(|channel| channel * speckle.max(0.2)), gloss }
    }

    /// Level beds that bend a little.
    fn beds(&self, place: DVec3) -> Rgb {
        let bend = octaves(14, place / (5.0 * self.bed_m), 3);
        let height = place.z / self.bed_m + 0.9 * bend;
        // Beds are long and thin: noise that hardly changes along them.
        let level = DVec3::new(place.x, place.y, 0.0) / (60.0 * self.bed_m);
        let thin = octaves(15, level + DVec3::Z * (2.0 * height), 3);
        let share = self.variety as f32 * smooth_step(-0.05, 0.35, thin as f32);
        mix(self.wall.map(decode), self.bed.map(decode), share)
    }

    /// Share of streaks, which run down the walls.
    fn streaks(&self, place: DVec3) -> f32 {
        let drawn = DVec3::new(place.x, place.y, 0.12 * place.z) * (4.0 / self.patch_m);
        let where_wet = octaves(16, place / (1.3 * self.patch_m), 2) as f32;
        let lines = octaves(17, drawn, 3) as f32;
        smooth_step(0.0, 0.45, lines + 0.6 * where_wet - 0.1)
    }

    /// Mud with pebbles.
    fn sediment(&self, place: DVec3) -> Rgb {
        let flat = DVec3::new(place.x, place.y, 0.4 * place.z);
        let tone = octaves(18, flat / (0.6 * self.patch_m), 4) as f32;
        let pebbles = noise(19, flat * (3.5 / self.grain_m)) as f32;
        let light =
            1.0 + self.variety as f32 * (0.45 * tone + 0.35 * smooth_step(0.25, 0.5, pebbles));
        self.floor.map(|channel| decode(channel) * light)
    }

    /// A normal leant by the bumps at a place; `fineness_m` is how much of the wall a pixel shows.
    pub(super) fn bumped(&self, place: DVec3, normal: DVec3, fineness_m: f64) -> DVec3 {
        if self.relief == 0.0 {
            return normal;
        }
        // Bumps smaller than a pixel would only sparkle.
        let octave_count = (self.grain_m / fineness_m.max(1e-9)).log2().clamp(0.0, 4.0) as u32;
        let step = 0.02 * self.grain_m;
        let height = |at: DVec3| octaves(20, at / self.grain_m, octave_count) * self.grain_m;
        let here = height(place);
        let slope = DVec3::from_array(
            [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| (height(place + axis * step) - here) / step),
        );
        let along = slope - normal * slope.dot(normal);
        (normal - along * self.relief).normalize_or(normal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_near(found: Rgb, expected: Rgb) {
        let is_near = (0..3).all(|channel| (found[channel] - expected[channel]).abs() < 1e-6);
        assert!(is_near, "{found:?} {expected:?}");
    }

    /// Without noise, slopes of 40 degrees part floor and wall, and wall and ceiling.
    #[test]
    fn the_slope_picks_the_material() {
        let rock = Rock { variety: 0.0, ..Rock::default() };
        let colour = |slope_deg: f64| {
            rock.at(DVec3::new(3.1, -2.0, 9.4), slope_deg.to_radians().cos()).colour
        };
        for (slope_deg, expected) in [
            (0.0, rock.floor),
            (20.0, rock.floor),
            (60.0, rock.wall),
            (90.0, rock.wall),
            (180.0, rock.ceiling),
        ] {
            assert_near(colour(slope_deg), expected.map(decode));
        }
        assert_near(colour(40.0), mix(rock.wall.map(decode), rock.floor.map(decode), 0.5));
    }

    #[test]
    fn noise_makes_patches_of_every_material() {
        let rock = Rock::default();
        let wall = |number: i32| {
            let [x, z] = [f64::from(number % 100) * 0.31, f64::from(number / 100) * 0.13];
            rock.at(DVec3::new(x, 0.0, z), 0.0)
        };
        let of: Vec<Ground> = (0..10_000).map(wall).collect();
        let shiny = of.iter().filter(|ground| ground.gloss > 0.9).count();
        assert!((200..5000).contains(&shiny), "flowstone on {shiny} of 10000");
        let pale = of.iter().filter(|ground| ground.colour[2] > decode(rock.wall[2])).count();
        assert!((500..7000).contains(&pale), "{pale}");
        let plain = Rock { relief: 0.0, ..Rock::default() };
        assert_eq!(plain.bumped(DVec3::ONE, DVec3::X, 0.01), DVec3::X);
        let bumped = rock.bumped(DVec3::new(0.3, 0.7, 0.2), DVec3::X, 0.01);
        assert!((bumped.length() - 1.0).abs() < 1e-12 && bumped != DVec3::X);
    }
}
