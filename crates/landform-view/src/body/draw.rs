//! Colours of samples, and the edges of the block.

use glam::DVec3;
use rayon::prelude::*;

use super::samples::{NOTHING, Sample, at};
use super::{Body, BodyOptions, corners};
use crate::Image;
use crate::light::{Rgb, decode, mix, quantise};
use crate::perspective::Camera;

/// Backdrop at the foot of the picture and at its top, sRGB.
const BACKDROP: [[u8; 3]; 2] = [[246, 244, 240], [226, 230, 236]];
/// Edges of the block, sRGB.
const EDGE: [u8; 3] = [120, 120, 125];
/// Walls seen from within, where a cut opens them, sRGB.
const INSIDE: [u8; 3] = [92, 70, 58];

/// Colours the samples and takes the mean of those of a pixel.
pub(super) fn picture(
    body: &Body<'_>,
    camera: &Camera,
    options: &BodyOptions,
    samples: &[Sample],
) -> Image {
    let [width, height] = options.size;
    let side = options.supersampling;
    let scene = Scene::new(body, camera, options, samples);
    let lines = scene.lines();
    let mut rgb = vec![[0; 3]; width * height];
    rgb.par_chunks_mut(width).enumerate().for_each(|(row, line)| {
        for (column, pixel) in line.iter_mut().enumerate() {
            let mut sum = [0.0; 3];
            for place in 0..side * side {
                let [x, y] = [column * side + place % side, row * side + place / side];
                let colour = scene.colour(x, y, lines[x + scene.width * y]);
                sum = std::array::from_fn(|channel| sum[channel] + colour[channel]);
            }
            let mean = sum.map(|channel| channel / (side * side) as f32);
            *pixel = quantise(mean, column, row);
        }
    });
    Image { width, height, rgb }
}

struct Scene<'a> {
    body: &'a Body<'a>,
    camera: &'a Camera,
    options: &'a BodyOptions,
    samples: &'a [Sample],
    normals: Vec<DVec3>,
    width: usize,
    height: usize,
    /// Least and greatest depth of the corners of the block.
    depths: [f64; 2],
    lamp: DVec3,
    backdrop: [Rgb; 2],
}

impl<'a> Scene<'a> {
    fn new(
        body: &'a Body<'a>,
        camera: &'a Camera,
        options: &'a BodyOptions,
        samples: &'a [Sample],
    ) -> Self {
        let [width, height] = options.size.map(|side| side * options.supersampling);
        let of_corners = || corners(options.block).map(|corner| camera.depth(corner));
        let depths = [of_corners().fold(f64::MAX, f64::min), of_corners().fold(f64::MIN, f64::max)];
        // Above the left shoulder of the viewer: against the way to the lower right.
        let lamp = -camera.ray(1.3 * width as f64, 1.9 * height as f64);
        Self {
            body,
            camera,
            options,
            samples,
            normals: normals(body),
            width,
            height,
            depths,
            lamp,
            backdrop: BACKDROP.map(|colour| colour.map(decode)),
        }
    }

    /// Linear colour of a sample.
    fn colour(&self, column: usize, row: usize, is_line: bool) -> Rgb {
        let sample = self.samples[column + self.width * row];
        let height = 1.0 - row as f32 / self.height as f32;
        let backdrop = mix(self.backdrop[0], self.backdrop[1], height);
        if is_line {
            return mix(backdrop, EDGE.map(decode), 0.8);
        }
        if sample.triangle == NOTHING {
            return backdrop;
        }
        let triangle = self.body.triangles[sample.triangle as usize].map(|vertex| vertex as usize);
        let weights = sample.weights.map(f64::from);
        let point = at(triangle.map(|v| DVec3::from_array(self.body.positions[v])), weights);
        let normal = at(triangle.map(|v| self.normals[v]), weights).normalize_or_zero();
        let towards = (self.camera.position - point).normalize_or_zero();
        let is_inside = normal.dot(towards) < 0.0;
        let normal = if is_inside { -normal } else { normal };
        let material = match is_inside {
            true => INSIDE,
            false => self.material(triangle, weights, point.z),
        };
        let light = 0.62 * normal.dot(self.lamp).max(0.0) + 0.30 + 0.16 * normal.z;
        let light = (light * self.openness(column, row, sample.depth)) as f32;
        let lit = material.map(|channel| decode(channel) * light);
        let [near, far] = self.depths;
        let share = ((f64::from(sample.depth) - near) / (far - near)).clamp(0.0, 1.0);
        mix(lit, backdrop, (share * self.options.depth_cue) as f32)
    }

    /// Colour of a point of a triangle: that of its height, or of the paint of its vertices.
    fn material(&self, triangle: [usize; 3], [second, third]: [f64; 2], height_m: f64) -> [u8; 3] {
        let paint = triangle.map(|vertex| self.body.paint.get(vertex).copied().flatten());
        let [Some(a), Some(b), Some(c)] = paint else {
            let [low, high] = [0, 1].map(|end| self.options.block[end][2]);
            return self.options.colours.colour((height_m - low) / (high - low));
        };
        let first = 1.0 - second - third;
        std::array::from_fn(|channel| {
            let of = |colour: [u8; 3], share: f64| f64::from(colour[channel]) * share;
            (of(a, first) + of(b, second) + of(c, third)).round() as u8
        })
    }

    /// How much of its surroundings a sample sees: 1 all, down to about a half in narrow corners.
    /// Depths in two rings around it stand for its surroundings.
    fn openness(&self, column: usize, row: usize, depth: f32) -> f64 {
        const DIRECTIONS: usize = 8;
        // A fiftieth of the block's diagonal.
        let [low, high] = self.options.block.map(DVec3::from_array);
        let reach_m = (high - low).length() / 50.0;
        let reach = (reach_m / (f64::from(depth) * self.camera.pixel_angle())).clamp(2.0, 64.0);
        let mut hidden = 0.0;
        for place in 0..2 * DIRECTIONS {
            let angle = (place % DIRECTIONS) as f64 * std::f64::consts::TAU / DIRECTIONS as f64;
            let radius = if place < DIRECTIONS { 0.4 * reach } else { reach };
            let x = column as f64 + radius * angle.cos();
            let y = row as f64 + radius * angle.sin();
            if x < 0.0 || y < 0.0 || x >= self.width as f64 || y >= self.height as f64 {
                continue;
            }
            let other = self.samples[x as usize + self.width * y as usize].depth;
            let nearer = f64::from(depth - other) / reach_m;
            // What is far in front is another passage, and hides nothing of this one.
            hidden += nearer.clamp(0.0, 1.0) * (2.0 - nearer).clamp(0.0, 1.0);
        }
        1.0 - 0.8 * hidden / (2 * DIRECTIONS) as f64
    }

    /// Samples on edges of the block that the body does not hide.
    fn lines(&self) -> Vec<bool> {
        let mut lines = vec![false; self.samples.len()];
        let corners: Vec<DVec3> = corners(self.options.block).collect();
        let thick = self.options.supersampling as isize;
        for (from, to) in (0..8).flat_map(|corner: usize| {
            let far = (0..3).map(move |axis| corner | 1 << axis);
            far.filter(move |&other| other != corner).map(move |other| (corner, other))
        }) {
            let steps = 2 * (self.width + self.height);
            for step in 0..=steps {
                let point = corners[from].lerp(corners[to], step as f64 / steps as f64);
                let Some([x, y]) = self.camera.project(point) else { continue };
                let depth = self.camera.depth(point) as f32;
                for place in 0..thick * thick {
                    let [x, y] = [x as isize + place % thick, y as isize + place / thick];
                    if x >= 0 && y >= 0 && (x as usize) < self.width && (y as usize) < self.height {
                        let index = x as usize + self.width * y as usize;
                        lines[index] |= depth < self.samples[index].depth;
                    }
                }
            }
        }
        lines
    }
}

/// Normals of the vertices: means of their triangles, by area.
fn normals(body: &Body<'_>) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; body.positions.len()];
    for triangle in body.triangles {
        let [a, b, c] = triangle.map(|vertex| DVec3::from_array(body.positions[vertex as usize]));
        let normal = (b - a).cross(c - a);
        triangle.iter().for_each(|&vertex| sums[vertex as usize] += normal);
    }
    sums.into_iter().map(DVec3::normalize_or_zero).collect()
}
