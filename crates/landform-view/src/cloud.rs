//! The values of a volume as a translucent cloud.
//!
//! A ray for every pixel gathers colour on its way through the block, half a voxel a step: what it
//! meets hides a share of what lies behind (Levoy 1988, emission and absorption). Values between the
//! middles of voxels are interpolated.

use glam::DVec3;
use rayon::prelude::*;

use crate::light::quantise;
use crate::mark::Mark;
use crate::perspective::Camera;
use crate::{ColourMap, Image, ViewError};

/// Values of voxels.
#[derive(Clone, Copy, Debug)]
pub struct Volume<'a> {
    /// Numbers of voxels from west to east, from north to south, and upwards.
    pub size: [usize; 3],
    /// Edge of a voxel in metres.
    pub spacing_m: f64,
    /// A value a voxel, west to east, then north to south, then from below.
    pub values: &'a [f64],
}

/// Which values hide what is behind them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Opacity {
    /// All alike.
    Even,
    /// The high ones.
    High,
    /// The low and the high ones; those in the middle of the range are clear.
    Ends,
}

/// How a cloud is drawn.
#[derive(Clone, Debug)]
pub struct CloudOptions {
    /// Width and height of the picture in pixels.
    pub size: [usize; 2],
    /// Compass bearing towards which the camera looks, in degrees: 0 north, 90 east.
    pub bearing_deg: f64,
    /// How far the camera looks down, in degrees: 0 level, 90 straight down.
    pub pitch_deg: f64,
    /// 1 fits the whole block into the picture; 2 halves the distance to its middle.
    pub zoom: f64,
    /// Colours by value.
    pub colours: ColourMap,
    /// Values of the first and the last colour.
    pub range: [f64; 2],
    /// Which values hide what is behind them.
    pub opacity: Opacity,
    /// Optical depth of the most opaque values across the block's diagonal.
    pub density: f64,
    /// Where water comes in and goes out, in metres.
    pub marks: Vec<(Mark, [f64; 3])>,
}

impl CloudOptions {
    /// A picture of 960 x 640 pixels that looks down on a block from the south.
    pub fn new(colours: ColourMap, range: [f64; 2]) -> Self {
        Self {
            size: [960, 640],
            bearing_deg: 25.0,
            pitch_deg: 30.0,
            zoom: 1.0,
            colours,
            range,
            opacity: Opacity::Even,
            density: 4.0,
            marks: Vec::new(),
        }
    }

    fn check(&self, volume: &Volume<'_>) -> Result<(), ViewError> {
        let check = ViewError::check_option;
        ViewError::check_size("a picture", self.size, 1)?;
        check("bearing_deg", self.bearing_deg, [-1e6, 1e6], "a bearing in degrees")?;
        check("pitch_deg", self.pitch_deg, [-90.0, 90.0], "from -90 to 90")?;
        check("zoom", self.zoom, [0.01, 1000.0], "from 0.01 to 1000")?;
        check("density", self.density, [0.0, 1e4], "from 0 to 10000")?;
        check("spacing_m", volume.spacing_m, [1e-9, 1e9], "a length of more than 0")?;
        for end in self.range {
            check("range", end, [-1e300, 1e300], "a finite number")?;
        }
        let voxels = volume.size.iter().product::<usize>();
        check("values", volume.values.len() as f64, [voxels as f64; 2], "a value a voxel")?;
        check("voxels", voxels as f64, [1.0, 1e12], "at least one")
    }
}

/// Draws the values of a volume. The same options give the same bytes on any number of threads.
///
/// # Errors
/// [`ViewError::Option`] for options out of range, [`ViewError::TooSmall`] and
/// [`ViewError::TooLarge`] for pictures of no size or beyond memory.
pub fn render(volume: &Volume<'_>, options: &CloudOptions) -> Result<Image, ViewError> {
    const BACKDROP: [f32; 3] = [0.93, 0.92, 0.90];
    options.check(volume)?;
    let [width, height] = options.size;
    let top = DVec3::from_array(volume.size.map(|count| count as f64 * volume.spacing_m));
    let corners: Vec<DVec3> = (0..8_usize)
        .map(|corner| DVec3::from_array([0, 1, 2].map(|axis| (corner >> axis & 1) as f64)) * top)
        .collect();
    let camera =
        Camera::new(DVec3::ZERO, options.bearing_deg, options.pitch_deg, 28.0, options.size);
    let mut camera = camera.framing(&corners, 0.05);
    camera.position = 0.5 * top + (camera.position - 0.5 * top) / options.zoom;
    let mut image = Image::filled(width, height, [0; 3])?;
    image.rgb.par_chunks_mut(width).enumerate().for_each(|(row, line)| {
        for (column, pixel) in line.iter_mut().enumerate() {
            let ray = camera.ray(column as f64 + 0.5, row as f64 + 0.5);
            let (colour, left) = gathered(volume, options, [camera.position, ray], top);
            let behind = BACKDROP.map(|channel| channel * left);
            let sum = std::array::from_fn(|channel| colour[channel] + behind[channel]);
            *pixel = quantise(sum, column, row);
        }
    });
    for &(mark, at) in &options.marks {
        if let Some(place) = camera.project(DVec3::from_array(at)) {
            mark.draw(&mut image, place.map(|at| at as f32), (width as f32 / 50.0).max(6.0));
        }
    }
    Ok(image)
}

/// The light that a ray gathers in the block, and the share of what is behind that it lets through.
fn gathered(
    volume: &Volume<'_>,
    options: &CloudOptions,
    [from, ray]: [DVec3; 2],
    top: DVec3,
) -> ([f32; 3], f32) {
    let (mut colour, mut left) = ([0.0; 3], 1.0);
    let Some([near, far]) = crossing(from, ray, top) else { return (colour, left) };
    let step_m = 0.5 * volume.spacing_m;
    let per_step = (options.density * step_m / top.length()) as f32;
    let steps = ((far - near) / step_m).ceil().max(0.0) as usize;
    for step in 0..steps {
        let value = sample(volume, from + ray * (near + (step as f64 + 0.5) * step_m));
        let span = options.range[1] - options.range[0];
        let share =
            if span == 0.0 { 0.5 } else { ((value - options.range[0]) / span).clamp(0.0, 1.0) };
        let weight = match options.opacity {
            Opacity::Even => 1.0,
            Opacity::High => share,
            Opacity::Ends => (2.0 * share - 1.0).abs(),
        };
        if share.is_nan() {
            continue;
        }
        let kept = left * (-per_step * weight as f32).exp();
        let here = options.colours.linear(share);
        colour = std::array::from_fn(|channel| colour[channel] + (left - kept) * here[channel]);
        left = kept;
    }
    (colour, left)
}

/// Distances at which a ray enters and leaves the block from the origin to its top.
fn crossing(from: DVec3, ray: DVec3, top: DVec3) -> Option<[f64; 2]> {
    let (mut near, mut far) = (0.0_f64, f64::INFINITY);
    for axis in 0..3 {
        let ends = [0.0, top[axis]].map(|side| (side - from[axis]) / ray[axis]);
        // A ray along a side passes it nowhere: NaN, which neither least nor greatest heeds.
        near = near.max(ends[0].min(ends[1]));
        far = far.min(ends[0].max(ends[1]));
    }
    (near < far).then_some([near, far])
}

/// The value at a point of the block, between the middles of eight voxels.
fn sample(volume: &Volume<'_>, point: DVec3) -> f64 {
    let [width, height, _] = volume.size;
    let place = point / volume.spacing_m;
    // Rows run south.
    let place = [place.x, height as f64 - place.y, place.z];
    let axis = |axis: usize| {
        let last = volume.size[axis] - 1;
        let at = (place[axis] - 0.5).clamp(0.0, last as f64);
        let low = (at as usize).min(last);
        ([low, (low + 1).min(last)], at - low as f64)
    };
    let (columns, x) = axis(0);
    let (rows, y) = axis(1);
    let (layers, z) = axis(2);
    let value = |column: usize, row: usize, layer: usize| {
        volume.values[columns[column] + width * (rows[row] + height * layers[layer])]
    };
    let between = |ends: [f64; 2], share: f64| ends[0] + (ends[1] - ends[0]) * share;
    let along = |row: usize, layer: usize| between([value(0, row, layer), value(1, row, layer)], x);
    let across = |layer: usize| between([along(0, layer), along(1, layer)], y);
    between([across(0), across(1)], z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options() -> CloudOptions {
        let colours = ColourMap::named("vik").unwrap();
        CloudOptions { size: [60, 40], ..CloudOptions::new(colours, [0.0, 1.0]) }
    }

    #[test]
    fn a_ray_keeps_what_the_optical_depth_lets_through() {
        let values = vec![1.0; 4 * 4 * 4];
        let volume = Volume { size: [4; 3], spacing_m: 2.0, values: &values };
        let top = DVec3::splat(8.0);
        let from = DVec3::new(4.0, -10.0, 4.0);
        let (colour, left) = gathered(&volume, &options(), [from, DVec3::Y], top);
        // 8 m of a diagonal of 8 times the root of 3.
        let expected = (-4.0 / 3_f32.sqrt()).exp();
        assert!((left - expected).abs() < 1e-5, "{left} {expected}");
        let red = options().colours.linear(1.0);
        assert!((colour[0] - red[0] * (1.0 - expected)).abs() < 1e-5);
        let aside = DVec3::new(9.0, -10.0, 4.0);
        assert_eq!(gathered(&volume, &options(), [aside, DVec3::Y], top).1, 1.0);
        let clear = CloudOptions { range: [0.0, 2.0], opacity: Opacity::Ends, ..options() };
        assert_eq!(gathered(&volume, &clear, [from, DVec3::Y], top).1, 1.0);
    }

    #[test]
    fn values_are_interpolated_and_rows_run_south() {
        let values: Vec<f64> = (0..2 * 3 * 2).map(f64::from).collect();
        let volume = Volume { size: [2, 3, 2], spacing_m: 1.0, values: &values };
        let at = |x, y, z| sample(&volume, DVec3::new(x, y, z));
        assert_eq!(at(0.5, 2.5, 0.5), 0.0);
        assert_eq!(at(1.5, 0.5, 1.5), 11.0);
        assert_eq!(at(1.0, 1.5, 1.0), 5.5);
    }

    #[test]
    fn bad_options_are_refused_and_threads_do_not_matter() {
        let values = vec![0.3; 8];
        let volume = Volume { size: [2; 3], spacing_m: 1.0, values: &values };
        let said = |options: CloudOptions| render(&volume, &options).unwrap_err().to_string();
        assert!(said(CloudOptions { zoom: 0.0, ..options() }).contains("zoom"));
        assert!(said(CloudOptions { range: [f64::NAN, 1.0], ..options() }).contains("range"));
        let few = Volume { values: &values[..7], ..volume };
        assert!(render(&few, &options()).unwrap_err().to_string().contains("values"));
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| render(&volume, &options()).unwrap())
        };
        assert_eq!(on(1), on(5));
    }
}
