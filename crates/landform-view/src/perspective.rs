//! Perspective views: a block of terrain, or terrain to the horizon, under a low sun.

use glam::DVec3;
use rayon::prelude::*;

pub use crate::camera::Camera;
use crate::light::{Light, Rgb, decode, mix, quantise, shoulder, tint};
use crate::march::{Marcher, Ray};
use crate::shade::{Ground, shade};
use crate::surface::{Sampling, Surface};
use crate::texture::Texture;
use crate::water::Water;
use crate::{HeightField, Image, ViewError};

/// What lies around the field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surroundings {
    /// Nothing: the field is a block with cut sides.
    Block {
        /// Height of the block below the lowest node in metres; when missing, a twentieth of
        /// the field's shorter side.
        depth_m: Option<f64>,
        /// Colour of the cut sides, sRGB.
        colour: [u8; 3],
    },
    /// The field again and again, to the horizon: for periodic fields.
    Repeat,
}

/// How a perspective view is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct PerspectiveOptions {
    /// Width and height of the picture in pixels.
    pub size: [usize; 2],
    /// Rays a pixel each way: 2 means four rays a pixel.
    pub supersampling: usize,
    /// Compass bearing towards which the camera looks, in degrees: 0 north, 90 east.
    pub bearing_deg: f64,
    /// How far the camera looks down, in degrees: 0 level, 90 straight down.
    pub pitch_deg: f64,
    /// Horizontal field of view in degrees.
    pub field_of_view_deg: f64,
    /// 1 fits the whole field into the picture; 2 halves the distance to its middle.
    pub zoom: f64,
    /// Factor of heights.
    pub vertical_exaggeration: f64,
    /// Standard deviation, in nodes, of a Gaussian that smooths the heights that are drawn: about
    /// 1 hides the steps of heights that are whole slabs of sand. 0 draws every height as it is.
    pub smoothing_nodes: f64,
    /// Colours and contour lines.
    pub ground: Ground,
    /// What lights it.
    pub light: Light,
    /// What lies around the field.
    pub surroundings: Surroundings,
    /// A level below which there is water.
    pub water: Option<Water>,
    /// Colours of the backdrop, sRGB: at the horizon (or the foot of the picture) and at its top.
    pub sky: [[u8; 3]; 2],
    /// Optical depth of the air over the field's diagonal; 0 is clear.
    pub haze: f64,
}

impl PerspectiveOptions {
    /// A block of 960 x 600 pixels that looks north-east under a low sun.
    pub fn new(ground: Ground) -> Self {
        Self {
            size: [960, 600],
            supersampling: 2,
            bearing_deg: 30.0,
            pitch_deg: 32.0,
            field_of_view_deg: 30.0,
            zoom: 1.0,
            vertical_exaggeration: 1.0,
            smoothing_nodes: 0.0,
            ground,
            light: Light::low_sun(),
            surroundings: Surroundings::Block { depth_m: None, colour: [150, 122, 92] },
            water: None,
            sky: [[236, 231, 222], [176, 200, 226]],
            haze: 0.12,
        }
    }

    fn check(&self) -> Result<(), ViewError> {
        self.ground.check()?;
        self.light.check()?;
        self.water.as_ref().map_or(Ok(()), Water::check)?;
        ViewError::check_size("a picture", self.size, 1)?;
        let check = ViewError::check_option;
        check("supersampling", self.supersampling as f64, [1.0, 16.0], "from 1 to 16")?;
        check("bearing_deg", self.bearing_deg, [-1e6, 1e6], "a bearing in degrees")?;
        check("pitch_deg", self.pitch_deg, [0.0, 90.0], "from 0 to 90")?;
        check("field_of_view_deg", self.field_of_view_deg, [1.0, 150.0], "from 1 to 150")?;
        check("zoom", self.zoom, [0.01, 1000.0], "from 0.01 to 1000")?;
        let range = [1e-6, 1e6];
        check("vertical_exaggeration", self.vertical_exaggeration, range, "from 1e-6 to 1e6")?;
        check("smoothing_nodes", self.smoothing_nodes, [0.0, 100.0], "from 0 to 100 nodes")?;
        check("haze", self.haze, [0.0, 100.0], "from 0 to 100")?;
        match self.surroundings {
            Surroundings::Block { depth_m: Some(depth), .. } => {
                check("depth_m", depth, [0.0, f64::MAX], "a height in metres, at least 0")
            }
            _ => Ok(()),
        }
    }
}

/// Draws a field in perspective. The same options give the same bytes on any number of threads.
///
/// # Errors
/// [`ViewError::Option`] for options out of range, [`ViewError::TooSmall`] or
/// [`ViewError::TooLarge`] for pictures of no size or beyond memory.
pub fn render(field: &HeightField<'_>, options: &PerspectiveOptions) -> Result<Image, ViewError> {
    options.check()?;
    let scene = Scene::surface(field, options)?;
    let scene = Scene::new(&scene, options);
    let [width, height] = options.size;
    let mut rgb = vec![[0; 3]; width * height];
    rgb.par_chunks_mut(width).enumerate().for_each(|(row, line)| {
        for (column, pixel) in line.iter_mut().enumerate() {
            *pixel = quantise(scene.pixel(column, row), column, row);
        }
    });
    Ok(Image { width, height, rgb })
}

/// The camera of [`render`], for placing labels: positions in metres, x east and y north from
/// the field's south-west node, z the height above the lowest node times the exaggeration.
///
/// # Errors
/// As for [`render`].
pub fn camera(field: &HeightField<'_>, options: &PerspectiveOptions) -> Result<Camera, ViewError> {
    options.check()?;
    let surface = Scene::surface(field, options)?;
    Ok(place_camera(&surface, options))
}

/// Everything a ray meets.
struct Scene<'a> {
    options: &'a PerspectiveOptions,
    surface: &'a Surface,
    marcher: Marcher<'a>,
    texture: Texture,
    camera: Camera,
    /// Height of the foot of the block; that of the lowest node for endless ground.
    foot: f64,
    water_level: Option<f64>,
    sun: Rgb,
    sky: [Rgb; 2],
    diagonal: f64,
    nearest: f64,
    /// Sines of the elevations at which the backdrop has its two colours.
    backdrop: [f64; 2],
}

impl<'a> Scene<'a> {
    fn surface(
        field: &HeightField<'_>,
        options: &PerspectiveOptions,
    ) -> Result<Surface, ViewError> {
        let periodic = options.surroundings == Surroundings::Repeat;
        let longest = field.width().max(field.height()) as f64;
        let wanted = (1.25 * options.size[0].max(options.size[1]) as f64).clamp(256.0, 2560.0);
        let step = match longest > wanted {
            true => (longest / wanted).floor(),
            false => 1.0 / (wanted / longest).round().clamp(1.0, 16.0),
        };
        let nodes = |size: usize| match periodic {
            true => (size as f64 / step).round() as usize,
            false => ((size - 1) as f64 / step).floor() as usize + 1,
        };
        let size = [nodes(field.width()), nodes(field.height())];
        let sampling = Sampling {
            size,
            origin: 0.0,
            step,
            periodic,
            smoothing: options.smoothing_nodes,
            exaggeration: options.vertical_exaggeration,
        };
        Surface::sample(field, sampling)
    }

    fn new(surface: &'a Surface, options: &'a PerspectiveOptions) -> Self {
        let camera = place_camera(surface, options);
        let colours = shade(surface, &options.ground, &options.light);
        let half = [surface.columns as f64, surface.rows as f64].map(|n| n * surface.spacing / 2.0);
        let diagonal = 2.0 * half[0].hypot(half[1]);
        let middle = DVec3::new(half[0], half[1], 0.0);
        let bottom = camera.ray(options.size[0] as f64 / 2.0, options.size[1] as f64).z;
        let top = camera.ray(options.size[0] as f64 / 2.0, 0.0).z;
        let endless = options.surroundings == Surroundings::Repeat;
        let scaled = |colour: [u8; 3], strength: f64| colour.map(|c| decode(c) * strength as f32);
        Self {
            options,
            surface,
            marcher: Marcher::new(surface),
            texture: Texture::new(surface, colours),
            camera,
            foot: -block_depth(surface, options),
            water_level: options.water.map(|water| f64::from(surface.raised(water.level_m))),
            sun: scaled(options.light.sun_colour, options.light.sun),
            sky: options.sky.map(|colour| colour.map(decode)),
            diagonal,
            nearest: match endless {
                true => 0.0,
                false => ((camera.position - middle).length() - diagonal / 2.0).max(0.0),
            },
            backdrop: [if endless { bottom.max(0.0) } else { bottom }, top.max(0.15)],
        }
    }

    /// Mean of the rays of a pixel.
    fn pixel(&self, column: usize, row: usize) -> Rgb {
        let rays = self.options.supersampling;
        let mut sum = [0.0; 3];
        for sub in 0..rays * rays {
            let x = column as f64 + ((sub % rays) as f64 + 0.5) / rays as f64;
            let y = row as f64 + ((sub / rays) as f64 + 0.5) / rays as f64;
            let colour = shoulder(self.seen(self.camera.ray(x, y)));
            sum = std::array::from_fn(|channel| sum[channel] + colour[channel]);
        }
        sum.map(|channel| channel / (rays * rays) as f32)
    }

    /// Colour seen along a direction.
    fn seen(&self, direction: DVec3) -> Rgb {
        let surface = self.surface;
        let (spacing, position) = (surface.spacing, self.camera.position);
        let south = (surface.rows - 1) as f64 - position.y / spacing;
        let ray = Ray {
            origin: [position.x / spacing, south, position.z],
            step: [direction.x / spacing, -direction.y / spacing, direction.z],
        };
        let backdrop = self.backdrop(direction);
        let range = self.over_ground(&ray);
        if range[0] > range[1] {
            return backdrop;
        }
        let Some((distance, colour)) = self.ground(&ray, range, backdrop) else {
            return backdrop;
        };
        let air = self.options.haze * (distance - self.nearest).max(0.0) / self.diagonal;
        let haze = mix(self.sky[0], self.sky[1], 0.25);
        mix(haze, colour, (-air).exp() as f32)
    }

    /// Distances between which the ray is over the field and below its highest point.
    fn over_ground(&self, ray: &Ray) -> [f64; 2] {
        let top = f64::from(self.surface.highest).max(self.water_level.unwrap_or(0.0));
        match self.options.surroundings {
            Surroundings::Repeat => ray.clip(2, f64::MIN, top, [0.0, 60.0 * self.diagonal]),
            Surroundings::Block { .. } => {
                let range = ray.clip(2, self.foot, top, [0.0, f64::MAX]);
                let range = ray.clip(0, 0.0, (self.surface.columns - 1) as f64, range);
                ray.clip(1, 0.0, (self.surface.rows - 1) as f64, range)
            }
        }
    }

    /// Distance and colour of what the ray meets first: a side of the block, water or ground.
    fn ground(&self, ray: &Ray, range: [f64; 2], backdrop: Rgb) -> Option<(f64, Rgb)> {
        let entry = ray.at(range[0]);
        let hit = self.marcher.hit(ray, range);
        let at_side = range[0] > 0.0 && entry[2] < f64::from(self.surface.highest) - 1e-6;
        if let (Some(distance), true) = (hit, at_side)
            && distance == range[0]
        {
            return Some((distance, self.side(entry)));
        }
        let ground = hit.map(|distance| (distance, self.ground_colour(ray, distance)));
        match (self.options.water, self.water_level) {
            (Some(water), Some(level)) => {
                self.through_water(ray, range, ground, &water, level, backdrop)
            }
            _ => ground,
        }
    }

    fn ground_colour(&self, ray: &Ray, distance: f64) -> Rgb {
        let [column, row, _] = ray.at(distance);
        let surface = self.surface;
        let node = |place: f64, size: usize| {
            crate::surface::bound(place.round() as isize, size, surface.periodic)
        };
        let [east, north] =
            surface.slope(node(column, surface.columns), node(row, surface.rows)).map(f64::from);
        let normal = DVec3::new(-east, -north, 1.0).normalize();
        let step = DVec3::new(ray.step[0], -ray.step[1], ray.step[2] / surface.spacing);
        let facing = normal.dot(step.normalize()).abs().max(0.05);
        let angle = self.camera.pixel_angle() / self.options.supersampling as f64;
        // Between the short and the long side of the pixel's footprint on the slope.
        let width = distance * angle / surface.spacing / facing.sqrt();
        self.texture.colour(column, row, width)
    }

    /// What is seen of ground below a water level, and of the water's own cut side.
    fn through_water(
        &self,
        ray: &Ray,
        range: [f64; 2],
        ground: Option<(f64, Rgb)>,
        water: &Water,
        level: f64,
        backdrop: Rgb,
    ) -> Option<(f64, Rgb)> {
        let below = ray.clip(2, f64::MIN, level, range);
        let end = ground.map_or(range[1], |(distance, _)| distance);
        if below[0] > below[1] || below[0] >= end {
            return ground;
        }
        let path = (end - below[0]) / self.surface.exaggeration;
        let bed = ground.map_or(self.sky[0], |(_, colour)| colour);
        let body = water.over(bed, path);
        if below[0] == range[0] && range[0] > 0.0 {
            return Some((below[0], body));
        }
        // Schlick's (1994) approximation of Fresnel's reflection on water.
        let grazing = 1.0 + ray.step[2].min(0.0);
        let mirrored = 0.02 + 0.98 * grazing.powi(5);
        let reflected = mix(backdrop, self.sky[1], 0.6);
        Some((below[0], mix(body, reflected, mirrored as f32)))
    }

    /// Colour of a cut side of the block at a place on it: column, row and height.
    fn side(&self, [column, row, height]: [f64; 3]) -> Rgb {
        let Surroundings::Block { colour, .. } = self.options.surroundings else {
            return self.sky[0];
        };
        let last = [(self.surface.columns - 1) as f64, (self.surface.rows - 1) as f64];
        let outward = [
            (column, [-1.0, 0.0]),
            (last[0] - column, [1.0, 0.0]),
            (row, [0.0, 1.0]),
            (last[1] - row, [0.0, -1.0]),
        ];
        let nearest = outward.into_iter().min_by(|one, other| one.0.total_cmp(&other.0));
        let [east, north] = nearest.map_or([0.0, 0.0], |(_, normal)| normal);
        let sun = self.options.light.direction();
        let facing = (east * sun[0] + north * sun[1]).max(0.0) as f32;
        let sky = self.options.light.sky as f32 * 0.7;
        let depth = (height / self.foot.min(-1e-9)).clamp(0.0, 1.0) as f32;
        let own = colour.map(decode).map(|channel| channel * (1.0 - 0.45 * depth));
        let light = self.sun.map(|channel| channel * (0.22 + 0.6 * facing) + sky);
        tint(own, light)
    }

    fn backdrop(&self, direction: DVec3) -> Rgb {
        let [low, high] = self.backdrop;
        let share = ((direction.z - low) / (high - low)).clamp(0.0, 1.0) as f32;
        mix(self.sky[0], self.sky[1], share)
    }
}

/// Height of the block below the lowest node, exaggerated.
fn block_depth(surface: &Surface, options: &PerspectiveOptions) -> f64 {
    let side = surface.columns.min(surface.rows) as f64 * surface.spacing;
    match options.surroundings {
        Surroundings::Block { depth_m, .. } => {
            depth_m.map_or(side / 20.0, |depth| depth * surface.exaggeration)
        }
        Surroundings::Repeat => 0.0,
    }
}

/// The camera that frames the surface and its block.
fn place_camera(surface: &Surface, options: &PerspectiveOptions) -> Camera {
    const MARGIN: f64 = 0.03;
    const POINTS: usize = 24;
    let depth = block_depth(surface, options);
    let mut points = Vec::new();
    for i in 0..=POINTS {
        for j in 0..=POINTS {
            let column = i * (surface.columns - 1) / POINTS;
            let row = j * (surface.rows - 1) / POINTS;
            let [x, y] = [column, surface.rows - 1 - row].map(|n| n as f64 * surface.spacing);
            let height = f64::from(surface.heights[column + surface.columns * row]);
            points.push(DVec3::new(x, y, height));
            points.push(DVec3::new(x, y, -depth));
        }
    }
    let (bearing, pitch) = (options.bearing_deg, options.pitch_deg);
    let camera = Camera::new(DVec3::ZERO, bearing, pitch, options.field_of_view_deg, options.size);
    let mut camera = camera.framing(&points, MARGIN);
    let middle = points.iter().sum::<DVec3>() / points.len() as f64;
    camera.position = middle + (camera.position - middle) / options.zoom;
    let clearance = 0.02 * (camera.position - middle).length();
    if options.surroundings == Surroundings::Repeat {
        camera.position.z = camera.position.z.max(f64::from(surface.highest) + clearance);
    }
    camera
}
