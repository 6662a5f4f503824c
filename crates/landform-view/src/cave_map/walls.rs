//! One view of a cave: tints and the lines of walls.

use super::layers::{Layers, NONE};
use super::{CaveMapOptions, CaveView};
use crate::body::Body;
use crate::{Image, ViewError};

/// Samples a pixel each way.
const SAMPLES: usize = 3;
/// Half of the width of walls and of hidden walls, in samples.
const PEN: [isize; 2] = [3, 2];
/// Inks of walls and of hidden walls, sRGB.
const INKS: [[u8; 3]; 2] = [[25, 25, 25], [95, 95, 95]];
/// Length of a dash of hidden walls and of the gap after it, in samples.
const DASH: usize = 12;
/// Free pixels around the block in a view.
pub(super) const MARGIN: usize = 8;

/// A view that is drawn.
pub(super) struct Drawn {
    pub view: CaveView,
    pub image: Image,
    /// The place at the upper left corner of the picture, in metres to the right and up.
    pub corner: [f64; 2],
}

impl Drawn {
    /// Column and row of a place in metres.
    pub fn place(&self, at: [f64; 3], pixels_per_m: f64) -> [f32; 2] {
        let [right, up, _] = self.view.seen(at);
        [right - self.corner[0], self.corner[1] - up].map(|way| (way * pixels_per_m) as f32)
    }
}

/// Draws a body from a view.
pub(super) fn draw(
    body: &Body<'_>,
    view: CaveView,
    options: &CaveMapOptions,
) -> Result<Drawn, ViewError> {
    let [a, b] = options.block.map(|corner| view.seen(corner));
    let margin_m = MARGIN as f64 / options.pixels_per_m;
    let corner = [a[0].min(b[0]) - margin_m, a[1].max(b[1]) + margin_m];
    let pixels = [0, 1].map(|axis| {
        let side = (b[axis] - a[axis]).abs() * options.pixels_per_m;
        side.ceil().min(1e9) as usize + 2 * MARGIN
    });
    let size = pixels.map(|pixels| pixels * SAMPLES);
    ViewError::check_size("a map of a cave", size, 1)?;
    let scale = options.pixels_per_m * SAMPLES as f64;
    let layers = Layers::of(body, view, (corner, scale), size);
    let mut samples = tints(&layers, options);
    for hidden in [true, false] {
        ink(&layers, options.step_m as f32, hidden, &mut samples);
    }
    Ok(Drawn {
        view,
        image: Image { width: size[0], height: size[1], rgb: samples }.shrunk(pixels[0]),
        corner,
    })
}

/// White rock, and passages in a pale tint of their height, a little darker where they are steep.
fn tints(layers: &Layers, options: &CaveMapOptions) -> Vec<[u8; 3]> {
    let [low, high] = [0, 1].map(|end| options.block[end][2]);
    let tint = |(near, &[height, facing]): (&[f32; 2], &[f32; 2])| {
        if near[0] == NONE {
            return [255; 3];
        }
        let colour = pale(options.colours.colour((f64::from(height) - low) / (high - low)));
        let light = 0.82 + 0.18 * facing.clamp(0.0, 1.0);
        colour.map(|channel| (f32::from(channel) * light).round() as u8)
    };
    layers.near_m.iter().zip(&layers.top).map(tint).collect()
}

/// A colour as thin paint on white paper.
pub(super) fn pale(colour: [u8; 3]) -> [u8; 3] {
    colour.map(|channel| 255 - ((255 - u16::from(channel)) * 6 / 10) as u8)
}

/// Draws the walls of the nearest surfaces, or the dashed ones of those behind.
fn ink(layers: &Layers, step: f32, hidden: bool, samples: &mut [[u8; 3]]) {
    let [width, height] = layers.size;
    let pen = PEN[usize::from(hidden)];
    for row in 0..height {
        for column in 0..width {
            if hidden && (column + row / 2) / DASH % 2 == 1 {
                continue;
            }
            if !is_wall(layers, [column, row], usize::from(hidden), step) {
                continue;
            }
            for place in 0..(2 * pen + 1) * (2 * pen + 1) {
                let [x, y] = [place % (2 * pen + 1) - pen, place / (2 * pen + 1) - pen];
                let [x_at, y_at] = [column as isize + x, row as isize + y];
                let is_on_page = x_at >= 0 && y_at >= 0;
                if !is_on_page || x * x + y * y > pen * pen {
                    continue;
                }
                let [x_at, y_at] = [x_at as usize, y_at as usize];
                if x_at < width && y_at < height {
                    samples[x_at + width * y_at] = INKS[usize::from(hidden)];
                }
            }
        }
    }
}

/// Whether the surface of a sample ends there: a neighbour has none that is about as near.
fn is_wall(layers: &Layers, [column, row]: [usize; 2], layer: usize, step: f32) -> bool {
    let [width, height] = layers.size;
    let near = layers.near_m[column + width * row][layer];
    if near == NONE {
        return false;
    }
    let ends_at = |[x, y]: [usize; 2]| {
        let beside = layers.near_m[x + width * y];
        let goes_on = beside.iter().any(|&other| (other - near).abs() <= step);
        // Behind two others it may go on unseen.
        let is_hidden = beside[1] > near;
        !goes_on && !is_hidden
    };
    (column > 0 && ends_at([column - 1, row]))
        || (column + 1 < width && ends_at([column + 1, row]))
        || (row > 0 && ends_at([column, row - 1]))
        || (row + 1 < height && ends_at([column, row + 1]))
}
