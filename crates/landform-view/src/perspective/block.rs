//! The cut sides of a block of terrain.

use super::{PerspectiveOptions, Surroundings};
use crate::light::{Rgb, decode, tint};
use crate::surface::Surface;

/// Share of the field's shorter side that a block goes down when its depth is not given.
const DEFAULT_DEPTH: f64 = 0.05;

/// Darkening of the sides from the top to the foot.
const FADE: f32 = 0.45;

/// A block below a surface.
pub(super) struct Block {
    /// Height of its foot above the datum, exaggerated; not positive.
    pub(super) foot: f64,
    /// Column and row of the south-east corner.
    last: [f64; 2],
    /// Colours of the west, east, south and north sides at their top.
    sides: [Rgb; 4],
}

impl Block {
    /// The block that the options ask for.
    pub(super) fn new(surface: &Surface, options: &PerspectiveOptions) -> Option<Self> {
        let Surroundings::Block { depth_m, colour } = options.surroundings else { return None };
        let shorter = surface.columns.min(surface.rows) as f64 * surface.spacing;
        let depth = depth_m.map_or(DEFAULT_DEPTH * shorter, |depth| depth * surface.exaggeration);
        let light = &options.light;
        let [east, north, _] = light.direction();
        let side = |facing: f64| -> Rgb {
            // A little of the sun reaches every side by way of the ground before it.
            let sun = (light.sun * (0.22 + 0.6 * facing.max(0.0))) as f32;
            let sky = (0.7 * light.sky) as f32;
            tint(colour.map(decode), light.sun_colour.map(|part| decode(part) * sun + sky))
        };
        Some(Self {
            foot: -depth,
            last: [surface.columns, surface.rows].map(|nodes| (nodes - 1) as f64),
            sides: [side(-east), side(east), side(-north), side(north)],
        })
    }

    /// Colour of the side at a column, a row and a height.
    pub(super) fn side(&self, [column, row, height]: [f64; 3]) -> Rgb {
        let off = [column, self.last[0] - column, self.last[1] - row, row];
        let nearest = (1..4).fold(0, |best, side| if off[side] < off[best] { side } else { best });
        let depth = (height / self.foot.min(-f64::MIN_POSITIVE)).clamp(0.0, 1.0) as f32;
        self.sides[nearest].map(|channel| channel * (1.0 - FADE * depth))
    }
}
