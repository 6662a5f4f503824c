//! Which triangle each sample of a picture shows.

use glam::DVec3;
use rayon::prelude::*;

use super::{Body, BodyOptions};
use crate::perspective::Camera;

/// No triangle.
pub(super) const NOTHING: u32 = u32::MAX;

/// Rows of samples that are filled at once.
const BAND: usize = 16;

/// What a sample shows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// Number of the triangle, or [`NOTHING`].
    pub triangle: u32,
    /// Distance along the camera's axis in metres; infinite where there is nothing.
    pub depth: f32,
    /// Weights of the second and the third vertex.
    pub weights: [f32; 2],
}

/// The nearest triangle of every sample, row by row.
pub(super) fn nearest(body: &Body<'_>, camera: &Camera, options: &BodyOptions) -> Vec<Sample> {
    let [width, height] = options.size.map(|side| side * options.supersampling);
    let seen: Vec<Option<[f64; 3]>> = body
        .positions
        .par_iter()
        .map(|&position| {
            let point = DVec3::from_array(position);
            let [column, row] = camera.project(point)?;
            Some([column, row, camera.depth(point)])
        })
        .collect();
    // The bands that each triangle touches, and the triangles of each band.
    let mut bands = vec![Vec::new(); height.div_ceil(BAND)];
    for (number, triangle) in body.triangles.iter().enumerate() {
        // Triangles that reach behind the camera are left out: it stands outside of the block.
        let [Some(a), Some(b), Some(c)] = triangle.map(|vertex| seen[vertex as usize]) else {
            continue;
        };
        let top = a[1].min(b[1]).min(c[1]).max(0.0);
        let foot = a[1].max(b[1]).max(c[1]).min(height as f64 - 1.0);
        if top <= foot {
            let touched = top as usize / BAND..=foot as usize / BAND;
            bands[touched].iter_mut().for_each(|band| band.push(number as u32));
        }
    }
    let nothing = Sample { triangle: NOTHING, depth: f32::INFINITY, weights: [0.0; 2] };
    let mut samples = vec![nothing; width * height];
    let of_bands = samples.par_chunks_mut(BAND * width).zip(&bands).enumerate();
    of_bands.for_each(|(band, (samples, triangles))| {
        let rows = Rows { first: band * BAND, width, cut: cut(options) };
        for &number in triangles {
            let triangle = body.triangles[number as usize];
            if let [Some(a), Some(b), Some(c)] = triangle.map(|vertex| seen[vertex as usize]) {
                let corners = triangle.map(|vertex| body.positions[vertex as usize]);
                rows.fill(samples, number, [a, b, c], corners.map(DVec3::from_array));
            }
        }
    });
    samples
}

/// Normal and offset of the plane beyond which nothing is drawn.
fn cut(options: &BodyOptions) -> Option<(DVec3, f64)> {
    options.cut.map(|cut| {
        let towards = DVec3::from_array(cut.towards);
        (towards, towards.dot(DVec3::from_array(cut.through)))
    })
}

/// Some rows of samples.
struct Rows {
    first: usize,
    width: usize,
    cut: Option<(DVec3, f64)>,
}

impl Rows {
    /// Puts a triangle into the samples that it covers and nothing nearer does. `seen` has column,
    /// row and depth of its corners.
    fn fill(&self, samples: &mut [Sample], number: u32, seen: [[f64; 3]; 3], corners: [DVec3; 3]) {
        let [a, b, c] = seen;
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if area == 0.0 {
            return;
        }
        let range = |axis: usize, from: usize, count: usize| {
            let low = a[axis].min(b[axis]).min(c[axis]) - 0.5;
            let high = a[axis].max(b[axis]).max(c[axis]) - 0.5;
            let first = low.ceil().max(from as f64) as usize;
            let last = high.floor().min((from + count) as f64 - 1.0);
            first..if last < 0.0 { 0 } else { last as usize + 1 }
        };
        for row in range(1, self.first, samples.len() / self.width) {
            for column in range(0, 0, self.width) {
                let [x, y] = [column as f64 + 0.5, row as f64 + 0.5];
                let weight = |from: [f64; 3], to: [f64; 3]| {
                    ((to[0] - from[0]) * (y - from[1]) - (to[1] - from[1]) * (x - from[0])) / area
                };
                let flat = [weight(b, c), weight(c, a), weight(a, b)];
                if flat.iter().any(|&weight| weight < 0.0) {
                    continue;
                }
                // Inverse depths are linear over the picture.
                let inverse: f64 =
                    flat.iter().zip([a, b, c]).map(|(w, corner)| w / corner[2]).sum();
                let depth = (1.0 / inverse) as f32;
                let sample = &mut samples[column + self.width * (row - self.first)];
                if depth < sample.depth {
                    let weights = [1, 2].map(|at| flat[at] / [a, b, c][at][2] / inverse);
                    let point = at(corners, weights);
                    if self.cut.is_some_and(|(towards, offset)| towards.dot(point) > offset) {
                        continue;
                    }
                    let weights = weights.map(|weight| weight as f32);
                    *sample = Sample { triangle: number, depth, weights };
                }
            }
        }
    }
}

/// The point of a triangle with the given weights of its second and third corner.
pub(super) fn at(corners: [DVec3; 3], [second, third]: [f64; 2]) -> DVec3 {
    corners[0] + (corners[1] - corners[0]) * second + (corners[2] - corners[0]) * third
}
