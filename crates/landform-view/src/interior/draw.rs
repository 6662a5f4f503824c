//! Light on the walls.

use std::sync::OnceLock;

use glam::DVec3;
use rayon::prelude::*;

use super::mesh::{Hit, Mesh};
use super::{InteriorOptions, Pool};
use crate::Image;
use crate::light::{Rgb, mix, quantise, shoulder};
use crate::perspective::Camera;

/// Draws the picture, the mean of some samples a pixel.
pub(super) fn picture(mesh: &Mesh, options: &InteriorOptions) -> Image {
    let [width, height] = options.size;
    let side = options.supersampling;
    let scene = Scene::new(mesh, options);
    let mut rgb = vec![[0; 3]; width * height];
    rgb.par_chunks_mut(width).enumerate().for_each(|(row, line)| {
        for (column, pixel) in line.iter_mut().enumerate() {
            let mut sum = [0.0; 3];
            for place in 0..side * side {
                let [x, y] = [column * side + place % side, row * side + place / side];
                let direction = scene.camera.ray(x as f64 + 0.5, y as f64 + 0.5);
                let colour = shoulder(scene.colour(direction, place));
                sum = std::array::from_fn(|channel| sum[channel] + colour[channel]);
            }
            let mean = sum.map(|channel| channel / (side * side) as f32);
            *pixel = quantise(mean, column, row);
        }
    });
    Image { width, height, rgb }
}

pub(super) struct Scene<'a> {
    mesh: &'a Mesh,
    options: &'a InteriorOptions,
    pub camera: Camera,
    /// Where the lamp is for each sample of a pixel.
    lamps: Vec<DVec3>,
    /// How much of its surroundings each vertex sees, found when it is first asked for.
    openness: Vec<OnceLock<f32>>,
}

/// No ray goes farther, in metres.
const FARTHEST: f64 = 1e9;

impl<'a> Scene<'a> {
    pub fn new(mesh: &'a Mesh, options: &'a InteriorOptions) -> Self {
        let size = options.size.map(|side| side * options.supersampling);
        let eye = DVec3::from_array(options.eye_m);
        let [bearing, pitch] = [options.bearing_deg, options.pitch_deg];
        let camera = Camera::new(eye, bearing, pitch, options.field_of_view_deg, size);
        let openness = (0..mesh.positions.len()).map(|_| OnceLock::new()).collect();
        let mut scene = Self { mesh, options, camera, lamps: Vec::new(), openness };
        scene.lamps = scene.lamps();
        scene
    }

    /// Places of the lamp, as many as a pixel has samples, on spirals around its middle.
    fn lamps(&self) -> Vec<DVec3> {
        let lamp = &self.options.lamp;
        let count = self.options.supersampling.pow(2);
        let place = |number: usize| {
            let share = (number as f64 / count as f64).sqrt();
            // The golden angle.
            let (up, right) = (2.399_963 * number as f64).sin_cos();
            let [x, y, z] = lamp.offset_m;
            let away = share * lamp.radius_m;
            let offset = self.camera.turned([x + away * right, y + away * up, z]);
            let length = offset.length();
            let eye = self.camera.position;
            let way = offset.normalize_or_zero();
            let room = match self.mesh.nearest(eye, way, 2.0 * length) {
                Some(wall) if length > 0.0 => length.min(0.6 * wall.distance),
                _ => length,
            };
            eye + way * room
        };
        (0..count).map(place).collect()
    }

    /// Linear colour of what a ray from the camera shows, in the light of one of the lamp's places.
    pub fn colour(&self, direction: DVec3, lamp: usize) -> Rgb {
        let eye = self.camera.position;
        let wall = self.mesh.nearest(eye, direction, FARTHEST);
        let surface = self.options.pool.and_then(|pool| Some((pool, pool.reach(eye, direction)?)));
        match surface {
            Some((pool, reach)) if wall.is_none_or(|wall| wall.distance > reach) => {
                self.water(pool, eye + direction * reach, direction, reach, lamp)
            }
            _ => self.through_water(eye, direction, wall, 0.0, lamp),
        }
    }

    /// Colour of the surface of water at a place, `way_m` from the camera.
    fn water(&self, pool: Pool, place: DVec3, direction: DVec3, way_m: f64, lamp: usize) -> Rgb {
        let (mirrored, through, share) = pool.part(place, direction);
        let from = |direction: DVec3| {
            let wall = self.mesh.nearest(place, direction, FARTHEST);
            self.through_water(place, direction, wall, way_m, lamp)
        };
        mix(from(through), from(mirrored), share)
    }

    /// Colour of a wall, dimmed by the water along the ray; `way_m` is the way to its origin.
    fn through_water(
        &self,
        origin: DVec3,
        direction: DVec3,
        wall: Option<Hit>,
        way_m: f64,
        lamp: usize,
    ) -> Rgb {
        let Some(wall) = wall else { return [0.0; 3] };
        let colour = self.wall(origin, direction, wall, way_m, lamp);
        let Some(pool) = self.options.pool else { return colour };
        let wet_m = pool.wet_length(origin, direction, wall.distance);
        let light = self.options.lamp.at(self.lamps[lamp].distance(origin)) as f32;
        pool.through(colour, wet_m, light)
    }

    /// Colour of a wall in the light of the lamp.
    fn wall(&self, origin: DVec3, direction: DVec3, hit: Hit, way_m: f64, lamp: usize) -> Rgb {
        let (place, flat, normal) = self.surface(origin, direction, hit);
        let ground = self.options.rock.at(place, normal.z);
        let fineness_m = (way_m + hit.distance) * self.camera.pixel_angle();
        let bumped = self.options.rock.bumped(place, normal, fineness_m);
        let towards = self.lamps[lamp] - place;
        let distance = towards.length();
        let towards = towards.normalize_or(-direction);
        let light = self.options.lamp.at(distance);
        // Bumps lean normals, but light from behind the wall is none.
        let is_lit = flat.dot(towards) > 0.0 && !self.is_shadowed(place, flat, lamp);
        let direct = if is_lit { bumped.dot(towards).max(0.0) } else { 0.0 };
        let shine = if is_lit { shine(bumped, towards - direction) } else { 0.0 };
        let around = self.options.lamp.thrown_back * self.openness_at(hit);
        // What is thrown back comes from everywhere, a little more from where the lamp shines.
        let around = around * (0.75 + 0.25 * bumped.dot(-direction));
        let sum = (light * (direct + around)) as f32;
        let white = ground.gloss * (light * shine) as f32;
        ground.colour.map(|channel| channel * sum + white)
    }

    /// Where a ray meets a wall, the normal of its triangle and that of the smooth wall, both
    /// towards the ray.
    fn surface(&self, origin: DVec3, direction: DVec3, hit: Hit) -> (DVec3, DVec3, DVec3) {
        let [a, b, c] = self.mesh.corners(hit.triangle);
        let flat = (c - a).cross(b - a).normalize_or_zero();
        let [second, third] = hit.weights;
        let [i, j, k] = self.mesh.triangles[hit.triangle].map(|v| self.mesh.normals[v as usize]);
        let smooth = (i + (j - i) * second + (k - i) * third).normalize_or(flat);
        let side = if flat.dot(direction) > 0.0 { -1.0 } else { 1.0 };
        (origin + direction * hit.distance, flat * side, smooth * side)
    }

    /// Whether a wall stands between a place on another and the lamp.
    fn is_shadowed(&self, place: DVec3, flat: DVec3, lamp: usize) -> bool {
        let from = place + flat * (1e-3 * self.options.corner_m);
        self.mesh.nearest(from, self.lamps[lamp] - from, 1.0).is_some()
    }

    /// How much of its surroundings a place on a wall sees.
    fn openness_at(&self, hit: Hit) -> f64 {
        let [a, b, c] = self.mesh.triangles[hit.triangle].map(|vertex| self.openness(vertex));
        let [second, third] = hit.weights;
        a + (b - a) * second + (c - a) * third
    }

    /// How much of its surroundings a vertex sees: the mean, over directions by the cosine, of the
    /// way to the next wall as a share of `corner_m`.
    fn openness(&self, vertex: u32) -> f64 {
        const RAYS: usize = 32;
        let found = self.openness[vertex as usize].get_or_init(|| {
            let normal = self.mesh.normals[vertex as usize];
            let reach = self.options.corner_m;
            let from = self.mesh.positions[vertex as usize] + normal * (1e-3 * reach);
            let across = normal.any_orthonormal_vector();
            let third = normal.cross(across);
            let open = |number: usize| {
                let square = (number as f64 + 0.5) / RAYS as f64;
                let (sin, cos) = (2.399_963 * number as f64).sin_cos();
                let level = (across * cos + third * sin) * square.sqrt();
                let way = level + normal * (1.0 - square).sqrt();
                self.mesh.nearest(from, way, reach).map_or(1.0, |wall| wall.distance / reach)
            };
            ((0..RAYS).map(open).sum::<f64>() / RAYS as f64) as f32
        });
        f64::from(*found)
    }
}

/// How much of the lamp wet rock mirrors (Blinn 1977); `half` is half-way between the lamp and the
/// camera, of any length.
fn shine(normal: DVec3, half: DVec3) -> f64 {
    const SHARPNESS: i32 = 40;
    0.35 * normal.dot(half.normalize_or_zero()).max(0.0).powi(SHARPNESS)
}
