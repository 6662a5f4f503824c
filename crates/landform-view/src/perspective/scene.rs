//! What a ray of the camera meets: ground, water, the sides of the block, or the backdrop.

use glam::DVec3;

use super::block::Block;
use super::camera::Camera;
use super::march::{Marcher, Ray};
use super::texture::Texture;
use super::{PerspectiveOptions, Surroundings};
use crate::light::{Rgb, decode, mix, shoulder};
use crate::shade::shade;
use crate::surface::{Surface, bound};
use crate::water::Water;

/// Distance to which endless ground is drawn, in diagonals of the field.
const FARTHEST: f64 = 60.0;

/// Everything a ray meets.
pub(super) struct Scene<'a> {
    options: &'a PerspectiveOptions,
    surface: &'a Surface,
    marcher: Marcher<'a>,
    texture: Texture,
    camera: Camera,
    /// The cut sides; nothing for endless ground.
    block: Option<Block>,
    /// The water, and where its surface is.
    water: Option<(Water, Pool<'a>)>,
    /// Colours of the backdrop, at its foot and at its top.
    sky: [Rgb; 2],
    /// Vertical parts of the directions in which the backdrop has them.
    sky_range: [f64; 2],
    /// Length of the field's diagonal, in metres.
    diagonal: f64,
    /// Distance at which the haze begins, in metres.
    clear: f64,
}

/// Where the surface of water is.
enum Pool<'a> {
    /// At a height above the datum, exaggerated.
    Level(f64),
    /// On a surface with the datum of the ground.
    Surface(&'a Surface, Marcher<'a>),
}

impl Pool<'_> {
    fn highest(&self) -> f64 {
        match self {
            Self::Level(level) => *level,
            Self::Surface(surface, _) => surface.highest.into(),
        }
    }

    /// Distance, within `range`, at which a ray first is below the water, and the cosine between
    /// the ray and the normal of the water there.
    fn hit(&self, ray: &Ray, range: [f64; 2]) -> Option<(f64, f64)> {
        match self {
            Self::Level(level) => {
                let [from, to] = ray.clip(2, f64::MIN, *level, range);
                (from < to).then_some((from, -ray.step[2].min(0.0)))
            }
            Self::Surface(surface, marcher) => {
                let distance = marcher.hit(ray, range)?;
                let [column, row, _] = ray.at(distance);
                Some((distance, facing(surface, [column, row], ray)))
            }
        }
    }
}

/// Cosine between a ray and the normal of a surface below it, at least 0.
fn facing(surface: &Surface, [column, row]: [f64; 2], ray: &Ray) -> f64 {
    let node = |place: f64, size: usize| bound(place.round() as isize, size, surface.periodic);
    let node = [node(column, surface.columns), node(row, surface.rows)];
    let [east, north] = surface.slope(node[0], node[1]).map(f64::from);
    let normal = DVec3::new(-east, -north, 1.0).normalize();
    let [columns, rows, up] = ray.step;
    let along = DVec3::new(columns * surface.spacing, -rows * surface.spacing, up);
    (-normal.dot(along)).max(0.0)
}

impl<'a> Scene<'a> {
    /// Lights the surface and places the camera. `water` is the surface of water of a field.
    pub(super) fn new(
        surface: &'a Surface,
        water: Option<&'a Surface>,
        options: &'a PerspectiveOptions,
    ) -> Self {
        let camera = super::place_camera(surface, options);
        let colours = shade(surface, &options.ground, &options.light);
        let half = [surface.columns, surface.rows].map(|n| n as f64 * surface.spacing / 2.0);
        let diagonal = 2.0 * half[0].hypot(half[1]);
        let to_middle = (camera.position - DVec3::new(half[0], half[1], 0.0)).length();
        let edge = |row: usize| camera.ray(options.size[0] as f64 / 2.0, row as f64).z;
        let (top, foot) = (edge(0), edge(options.size[1]));
        let endless = options.surroundings == Surroundings::Repeat;
        // Endless ground ends at the horizon, where the sky has to begin.
        let sky_range = if endless { [0.0, top.max(0.15)] } else { [foot, top] };
        let pool = |look: Water| {
            let level = |level_m: f64| Pool::Level(surface.raised(level_m).into());
            let pool = water.map(|water| Pool::Surface(water, Marcher::new(water)));
            pool.or_else(|| look.level_m.map(level)).map(|pool| (look, pool))
        };
        Self {
            options,
            surface,
            marcher: Marcher::new(surface),
            texture: Texture::new(surface, colours),
            camera,
            block: Block::new(surface, options),
            water: options.water.and_then(pool),
            sky: options.sky.map(|colour| colour.map(decode)),
            sky_range,
            diagonal,
            clear: if endless { 0.0 } else { (to_middle - diagonal / 2.0).max(0.0) },
        }
    }

    /// Mean of the rays of a pixel.
    pub(super) fn pixel(&self, column: usize, row: usize) -> Rgb {
        let rays = self.options.supersampling;
        let mut sum = [0.0; 3];
        for sub in 0..rays * rays {
            let x = column as f64 + ((sub % rays) as f64 + 0.5) / rays as f64;
            let y = row as f64 + ((sub / rays) as f64 + 0.5) / rays as f64;
            let colour = self.seen(self.camera.ray(x, y));
            sum = std::array::from_fn(|channel| sum[channel] + colour[channel]);
        }
        sum.map(|channel| channel / (rays * rays) as f32)
    }

    /// Colour seen along a direction.
    fn seen(&self, direction: DVec3) -> Rgb {
        let backdrop = self.backdrop(direction);
        let (spacing, position) = (self.surface.spacing, self.camera.position);
        let south = (self.surface.rows - 1) as f64 - position.y / spacing;
        let ray = Ray {
            origin: [position.x / spacing, south, position.z],
            step: [direction.x / spacing, -direction.y / spacing, direction.z],
        };
        let range = self.over_field(&ray);
        if range[0] > range[1] {
            return backdrop;
        }
        let Some((distance, colour)) = self.first(&ray, range, backdrop) else {
            return backdrop;
        };
        let air = self.options.haze * (distance - self.clear).max(0.0) / self.diagonal;
        // Highlights are compressed here and not in the mean of a pixel's rays, so that bright
        // edges are smooth and the backdrop keeps its colours.
        mix(self.sky[0], shoulder(colour), (-air).exp() as f32)
    }

    /// Distances between which the ray is over the field and not above everything.
    fn over_field(&self, ray: &Ray) -> [f64; 2] {
        let level = self.water.as_ref().map_or(0.0, |(_, pool)| pool.highest());
        let top = f64::from(self.surface.highest).max(level);
        let Some(block) = &self.block else {
            return ray.clip(2, f64::MIN, top, [0.0, FARTHEST * self.diagonal]);
        };
        let range = ray.clip(2, block.foot, top, [0.0, f64::MAX]);
        let range = ray.clip(0, 0.0, (self.surface.columns - 1) as f64, range);
        ray.clip(1, 0.0, (self.surface.rows - 1) as f64, range)
    }

    /// Distance and colour of what the ray meets first, if anything.
    fn first(&self, ray: &Ray, range: [f64; 2], backdrop: Rgb) -> Option<(f64, Rgb)> {
        let hit = self.marcher.hit(ray, range);
        let entry = ray.at(range[0]);
        // A ray that is below ground where it enters has met a cut side.
        let below = entry[2] < f64::from(self.surface.highest) * (1.0 - 1e-6);
        if let (Some(block), Some(distance)) = (&self.block, hit)
            && distance == range[0]
            && below
            && distance > 0.0
        {
            return Some((distance, block.side(entry)));
        }
        let ground = hit.map(|distance| (distance, self.ground(ray, distance)));
        match &self.water {
            Some((water, pool)) => self.wet(ray, range, ground, (water, pool), backdrop),
            None => ground,
        }
    }

    /// Colour of the ground at a distance along a ray, averaged over a ray's footprint.
    fn ground(&self, ray: &Ray, distance: f64) -> Rgb {
        let [column, row, _] = ray.at(distance);
        let surface = self.surface;
        let facing = facing(surface, [column, row], ray).max(0.05);
        let angle = self.camera.pixel_angle() / self.options.supersampling as f64;
        // Between the short and the long side of the footprint on the slope.
        let width = distance * angle / surface.spacing / facing.sqrt();
        self.texture.colour(column, row, width)
    }

    /// What is seen of the ground when there is water before it.
    fn wet(
        &self,
        ray: &Ray,
        range: [f64; 2],
        ground: Option<(f64, Rgb)>,
        (water, pool): (&Water, &Pool<'_>),
        backdrop: Rgb,
    ) -> Option<(f64, Rgb)> {
        let end = ground.map_or(range[1], |(distance, _)| distance);
        let Some((surface, facing)) = pool.hit(ray, range).filter(|(at, _)| *at < end) else {
            return ground;
        };
        let path_m = (end - surface) / self.surface.exaggeration;
        // A ray that meets no ground leaves by a far side; a deep body has nothing bright there.
        let bed = ground.map_or(water.colour.map(decode), |(_, colour)| colour);
        let body = water.over(bed, path_m);
        if surface == range[0] {
            return Some((surface, body));
        }
        // Reflection by the approximation of Schlick (1994, "An inexpensive BRDF model for
        // physically-based rendering").
        let mirrored = 0.02 + 0.98 * (1.0 - facing).powi(5);
        let reflected = mix(backdrop, self.sky[1], 0.6);
        Some((surface, mix(body, reflected, mirrored as f32)))
    }

    /// Colour of the backdrop: between its two colours by the vertical part of the direction.
    fn backdrop(&self, direction: DVec3) -> Rgb {
        let [low, high] = self.sky_range;
        let share = ((direction.z - low) / (high - low)).clamp(0.0, 1.0) as f32;
        mix(self.sky[0], self.sky[1], share)
    }
}
