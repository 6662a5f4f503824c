//! Colours of a surface in its light, before any camera looks at it.
//!
//! In linear light a node has the colour
//!
//! ```text
//! C = K (S s max(0, n.l) + H v + B K S (1 - v))
//! ```
//!
//! - `K`: the ground's own colour, from the colour map (contour lines darken it);
//! - `S`, `H`: colours and strengths of the sun and of the sky;
//! - `n.l`: cosine between the normal of the slope and the direction of the sun (Lambert's law);
//!   with `Light::spread` a share of it is the mean over all bearings of the sun;
//! - `s`: share of the sun's disc above the horizon of the terrain, 0 in shadow;
//! - `v`: view factor of the sky, 1 on a plain and less in hollows;
//! - `B`: how much of the light that falls on the ground beside comes back.
//!
//! The last term treats everything that hides the sky as ground of the same colour in full sun.
//! It keeps hollows and slip faces warm where the sky alone would leave them blue and dark; it
//! is not a solution for light that is reflected more than once.

use rayon::prelude::*;

use crate::ViewError;
use crate::colour_map::ColourMap;
use crate::horizon::{sky_view, sun_visibility};
use crate::light::{Light, Rgb, decode, mix, tint};
use crate::surface::Surface;

/// Colour of the light that the ground throws into hollows, as a share of the ground's own
/// colour times the sun.
const BOUNCE: f32 = 0.35;

/// What the ground looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Colours by height.
    pub colours: ColourMap,
    /// Heights in metres of the first and the last colour; the field's own range when missing.
    pub range_m: Option<[f64; 2]>,
    /// Height in metres of the middle colour, for maps with a break or a turn there such as
    /// `oleron` (sea level) and `vik` (no change); halfway when missing.
    pub middle_m: Option<f64>,
    /// Height in metres between contour lines; none when missing.
    pub contour_m: Option<f64>,
}

impl Ground {
    /// Colours of a map over the whole range of heights, without contour lines.
    pub fn new(colours: ColourMap) -> Self {
        Self { colours, range_m: None, middle_m: None, contour_m: None }
    }

    /// Place in the colour map of a height, on a surface whose heights have the range `own`.
    pub(crate) fn place(&self, metres: f64, own: [f64; 2]) -> f64 {
        let [low, high] = self.range_m.unwrap_or(own);
        let middle = self.middle_m.unwrap_or(low / 2.0 + high / 2.0);
        let upper = (metres - middle) * (high - low) >= 0.0;
        let [start, end] = if upper { [middle, high] } else { [low, middle] };
        let share = if end == start { f64::from(!upper) } else { (metres - start) / (end - start) };
        0.5 * (share + f64::from(upper))
    }

    /// Checks the range and the contour interval.
    pub(crate) fn check(&self) -> Result<(), ViewError> {
        let finite = [f64::MIN, f64::MAX];
        for height in self.range_m.unwrap_or_default() {
            ViewError::check_option("range_m", height, finite, "a finite height in metres")?;
        }
        if let Some(middle) = self.middle_m {
            ViewError::check_option("middle_m", middle, finite, "a finite height in metres")?;
        }
        let interval = self.contour_m.unwrap_or(1.0);
        let range = [f64::MIN_POSITIVE, f64::MAX];
        ViewError::check_option("contour_m", interval, range, "a positive number of metres")
    }
}

/// Linear colours of every node of a surface.
pub(crate) fn shade(surface: &Surface, ground: &Ground, light: &Light) -> Vec<Rgb> {
    let sun = sun_visibility(surface, light);
    let sky = sky_view(surface);
    let lamp = Lamp::new(light);
    let range = [surface.datum, surface.metres(surface.highest)];
    let mut colours = vec![[0.0; 3]; sun.len()];
    colours.par_chunks_mut(surface.columns).enumerate().for_each(|(row, line)| {
        for (column, colour) in line.iter_mut().enumerate() {
            let node = column + surface.columns * row;
            let metres = surface.metres(surface.heights[node]);
            let slope = surface.slope(column, row);
            let mut own = ground.colours.linear(ground.place(metres, range));
            if let Some(interval) = ground.contour_m {
                own = own.map(|channel| channel * contour(surface, metres, slope, interval));
            }
            *colour = lamp.lit(own, slope, sun[node], sky[node]);
        }
    });
    colours
}

/// A light prepared for many slopes.
struct Lamp {
    direction: [f32; 3],
    sun: Rgb,
    sky: Rgb,
    shadow: f32,
    spread: f32,
}

impl Lamp {
    fn new(light: &Light) -> Self {
        let scaled = |colour: [u8; 3], strength: f64| {
            colour.map(|channel| decode(channel) * strength as f32)
        };
        Self {
            direction: light.direction().map(|part| part as f32),
            sun: scaled(light.sun_colour, light.sun),
            sky: scaled(light.sky_colour, light.sky),
            shadow: light.shadow as f32,
            spread: light.spread as f32,
        }
    }

    /// Colour of a slope (towards east and north) that sees shares `sun` and `sky` of both.
    fn lit(&self, own: Rgb, [east, north]: [f32; 2], sun: f32, sky: f32) -> Rgb {
        let [x, y, z] = self.direction;
        let upright = 1.0 / (1.0 + east * east + north * north).sqrt();
        let facing = (upright * (z - east * x - north * y)).max(0.0);
        let direct = facing * (1.0 - self.shadow * (1.0 - sun));
        // The mean over all bearings of a sun that stands as high.
        let around = upright * z;
        let direct = mix([direct; 3], [around; 3], self.spread)[0];
        let sunlight = self.sun.map(|channel| channel * direct);
        let skylight = self.sky.map(|channel| channel * sky);
        let bounced = tint(own, self.sun).map(|channel| channel * BOUNCE * (1.0 - sky));
        std::array::from_fn(|channel| {
            own[channel] * (sunlight[channel] + skylight[channel] + bounced[channel])
        })
    }
}

/// Darkness of contour lines: 1 away from them, less on them; about a node wide.
fn contour(surface: &Surface, metres: f64, [east, north]: [f32; 2], interval: f64) -> f32 {
    let to_line = (metres / interval - (metres / interval).round()).abs() * interval;
    let rise = f64::from(east.hypot(north)) * surface.spacing / surface.exaggeration;
    let nodes = to_line / rise.max(1e-12);
    0.55 + 0.45 * (nodes - 0.3).clamp(0.0, 1.0) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_take_their_places_around_the_middle() {
        let mut ground = Ground::new(ColourMap::named("oleron").unwrap());
        let own = [-400.0, 100.0];
        assert_eq!(ground.place(-150.0, own), 0.5);
        assert_eq!(ground.place(100.0, own), 1.0);
        ground.middle_m = Some(0.0);
        assert_eq!(
            [-400.0, -100.0, 0.0, 50.0].map(|z| ground.place(z, own)),
            [0.0, 0.375, 0.5, 0.75]
        );
        ground.range_m = Some([10.0, -10.0]);
        assert_eq!([10.0, 5.0, 0.0, -10.0].map(|z| ground.place(z, own)), [0.0, 0.25, 0.5, 1.0]);
        // A plain has one colour, whatever its height.
        let plain = Ground { range_m: None, middle_m: None, ..ground };
        assert_eq!(plain.place(7.0, [7.0, 7.0]), 0.5);
    }

    /// Contour lines run where heights are multiples of the interval and nowhere else.
    #[test]
    fn contour_lines_follow_the_heights() {
        let heights: Vec<f64> = (0..400).map(|node| f64::from(node % 40)).collect();
        let field = crate::HeightField::new(40, 10, 1.0, &heights).unwrap();
        let sampling = crate::surface::Sampling {
            size: [40, 10],
            origin: 0.0,
            step: 1.0,
            periodic: false,
            smoothing: 0.0,
            exaggeration: 3.0,
        };
        let surface = Surface::sample(&field, sampling).unwrap();
        for column in 0..40 {
            let metres = surface.metres(surface.heights[column]);
            let dark = contour(&surface, metres, surface.slope(column, 5), 10.0) < 0.7;
            assert_eq!(dark, column % 10 == 0, "column {column}");
        }
    }
}
