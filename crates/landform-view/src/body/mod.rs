//! Pictures of bodies: closed surfaces of triangles, such as the passages of a cave.
//!
//! 1. The camera stands where the block around the body fits into the picture.
//! 2. For every sample the nearest triangle is found (a depth buffer, in bands of rows).
//! 3. Samples take the colour of their height, in the light of a lamp beside the camera and of the
//!    sky, are darker in corners that see little of their surroundings, and paler the farther away
//!    they are.
//! 4. The edges of the block are drawn where the body does not hide them.
//!
//! [`Parts`] puts a body together from surfaces, tubes and arrows.

mod draw;
mod parts;
mod samples;

pub use parts::Parts;

use glam::DVec3;

use crate::perspective::Camera;
use crate::{ColourMap, Image, ViewError};

/// A surface of triangles in metres: x east, y north, z up.
#[derive(Clone, Copy, Debug)]
pub struct Body<'a> {
    /// Positions of the vertices.
    pub positions: &'a [[f64; 3]],
    /// Three vertices each, counter-clockwise seen from outside.
    pub triangles: &'a [[u32; 3]],
    /// Colours of the vertices, sRGB; those without one, and all when it is empty, take the colour of
    /// their height.
    pub paint: &'a [Option<[u8; 3]>],
}

/// A plane beyond which nothing is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// The way across the plane, towards what is left out; of any length but 0.
    pub towards: [f64; 3],
    /// A point on it, in metres.
    pub through: [f64; 3],
}

/// How a body is drawn.
#[derive(Clone, Debug)]
pub struct BodyOptions {
    /// Width and height of the picture in pixels.
    pub size: [usize; 2],
    /// Samples a pixel each way.
    pub supersampling: usize,
    /// Compass bearing towards which the camera looks, in degrees: 0 north, 90 east.
    pub bearing_deg: f64,
    /// How far the camera looks down, in degrees: 0 level, 90 straight down.
    pub pitch_deg: f64,
    /// Horizontal field of view in degrees.
    pub field_of_view_deg: f64,
    /// 1 fits the whole frame into the picture; 2 halves the distance to where the camera looks.
    pub zoom: f64,
    /// Where the camera looks, in metres; the middle of the block when missing.
    pub focus: Option<[f64; 3]>,
    /// What the camera frames, if not the block: its lowest and highest corner.
    pub frame: Option<[[f64; 3]; 2]>,
    /// Colours by height, from the foot of the block to its top.
    pub colours: ColourMap,
    /// What is left out, if anything.
    pub cut: Option<Cut>,
    /// Lowest and highest corner of the block whose edges are drawn.
    pub block: [[f64; 3]; 2],
    /// How much of its colour what is farthest away loses to the backdrop, 0 to 1.
    pub depth_cue: f64,
}

impl BodyOptions {
    /// A picture of 960 x 640 pixels that looks down on a block from the south.
    pub fn new(colours: ColourMap, block: [[f64; 3]; 2]) -> Self {
        Self {
            size: [960, 640],
            supersampling: 2,
            bearing_deg: 25.0,
            pitch_deg: 30.0,
            field_of_view_deg: 28.0,
            zoom: 1.0,
            focus: None,
            frame: None,
            colours,
            cut: None,
            block,
            depth_cue: 0.35,
        }
    }

    fn check(&self, body: &Body<'_>) -> Result<(), ViewError> {
        let check = ViewError::check_option;
        check("supersampling", self.supersampling as f64, [1.0, 8.0], "from 1 to 8")?;
        ViewError::check_size("a picture", self.size.map(|side| side * self.supersampling), 1)?;
        check("bearing_deg", self.bearing_deg, [-1e6, 1e6], "a bearing in degrees")?;
        check("pitch_deg", self.pitch_deg, [-90.0, 90.0], "from -90 to 90")?;
        check("field_of_view_deg", self.field_of_view_deg, [1.0, 150.0], "from 1 to 150")?;
        check("zoom", self.zoom, [0.01, 1000.0], "from 0.01 to 1000")?;
        check("depth_cue", self.depth_cue, [0.0, 1.0], "from 0 to 1")?;
        let [low, high] = self.block;
        let sides = [0, 1, 2].map(|axis| high[axis] - low[axis]);
        for side in sides {
            check("block", side, [1e-9, 1e12], "a block of more than no size")?;
        }
        let whole = body.positions.iter().flatten().chain(low.iter());
        let whole =
            whole.chain(self.frame.iter().flatten().flatten()).chain(self.focus.iter().flatten());
        for &coordinate in whole {
            check("a position", coordinate, [-1e12, 1e12], "a number of at most 1e12")?;
        }
        let count = body.positions.len();
        if !body.paint.is_empty() {
            let painted = body.paint.len() as f64;
            check("colours", painted, [count as f64; 2], "a colour for each vertex, or none")?;
        }
        let outside = body.triangles.iter().flatten().find(|&&vertex| vertex as usize >= count);
        match outside {
            Some(&vertex) => {
                check("a vertex", vertex.into(), [0.0, count as f64 - 1.0], "a vertex of the body")
            }
            None => Ok(()),
        }
    }

    /// The camera that frames the block, or what is framed instead.
    fn camera(&self) -> Camera {
        let middle = corners(self.block).sum::<DVec3>() / 8.0;
        let corners: Vec<DVec3> = corners(self.frame.unwrap_or(self.block)).collect();
        let size = self.size.map(|side| side * self.supersampling);
        let view = self.field_of_view_deg;
        let camera = Camera::new(DVec3::ZERO, self.bearing_deg, self.pitch_deg, view, size);
        let mut camera = camera.framing(&corners, 0.03);
        let focus = self.focus.map_or(middle, DVec3::from_array);
        camera.position = focus + (camera.position - middle) / self.zoom;
        camera
    }
}

/// The corners of a block; number x + 2 y + 4 z, 0 at its low sides.
fn corners(block: [[f64; 3]; 2]) -> impl Iterator<Item = DVec3> {
    (0..8).map(move |corner: usize| {
        DVec3::from_array([0, 1, 2].map(|axis| block[corner >> axis & 1][axis]))
    })
}

/// Draws a body. The same options give the same bytes on any number of threads.
///
/// # Errors
/// [`ViewError::Option`] for options out of range, [`ViewError::TooSmall`] and
/// [`ViewError::TooLarge`] for pictures of no size or beyond memory.
pub fn render(body: &Body<'_>, options: &BodyOptions) -> Result<Image, ViewError> {
    options.check(body)?;
    let camera = options.camera();
    let samples = samples::nearest(body, &camera, options);
    Ok(draw::picture(body, &camera, options, &samples))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box with its triangles outwards.
    fn cube(low: f64, high: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let positions = corners([[low; 3], [high; 3]]).map(|corner| corner.to_array()).collect();
        let faces =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        (positions, triangles)
    }

    fn options() -> BodyOptions {
        BodyOptions {
            size: [90, 60],
            ..BodyOptions::new(ColourMap::named("batlow").unwrap(), [[0.0; 3], [10.0; 3]])
        }
    }

    #[test]
    fn a_box_hides_what_is_behind_it_and_a_cut_opens_it() {
        let (positions, triangles) = cube(2.0, 8.0);
        let body = Body { positions: &positions, triangles: &triangles, paint: &[] };
        let empty =
            render(&Body { positions: &[], triangles: &[], paint: &[] }, &options()).unwrap();
        let whole = render(&body, &options()).unwrap();
        assert_ne!(whole.pixel(45, 30), empty.pixel(45, 30));
        assert_eq!(whole.pixel(1, 1), empty.pixel(1, 1));
        let through = [5.0, 5.0, 5.0];
        let all = Cut { towards: [0.0, 0.0, -1.0], through: [5.0, 5.0, 9.0] };
        let gone = render(&body, &BodyOptions { cut: Some(all), ..options() }).unwrap();
        assert_eq!(gone, empty, "all of the box lies beyond the plane");
        let half = Cut { towards: [0.0, 0.0, 1.0], through };
        let open = render(&body, &BodyOptions { cut: Some(half), ..options() }).unwrap();
        assert!(open != whole && open != empty);
    }

    #[test]
    fn painted_vertices_keep_their_colour_and_the_focus_is_in_the_middle() {
        let (positions, triangles) = cube(4.0, 6.0);
        let red = vec![Some([255, 0, 0]); positions.len()];
        let body = Body { positions: &positions, triangles: &triangles, paint: &red };
        let clear = BodyOptions { depth_cue: 0.0, ..options() };
        let middle = render(&body, &clear).unwrap().pixel(45, 30);
        assert!(middle[0] > 100 && middle[0] / 3 > middle[1], "{middle:?}");
        let aside = BodyOptions { focus: Some([1.0; 3]), zoom: 3.0, ..options() };
        let empty = Body { positions: &[], triangles: &[], paint: &[] };
        let drawn = render(&body, &aside).unwrap();
        assert_eq!(drawn.pixel(45, 30), render(&empty, &aside).unwrap().pixel(45, 30));
    }

    #[test]
    fn the_same_bytes_on_any_number_of_threads() {
        let (positions, triangles) = cube(1.0, 9.0);
        let body = Body { positions: &positions, triangles: &triangles, paint: &[] };
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| render(&body, &options()).unwrap())
        };
        assert_eq!(on(1), on(7));
    }

    #[test]
    fn bad_options_are_refused() {
        let (positions, triangles) = cube(1.0, 9.0);
        let body = Body { positions: &positions, triangles: &triangles, paint: &[] };
        let said = |options: BodyOptions| render(&body, &options).unwrap_err().to_string();
        assert!(said(BodyOptions { zoom: 0.0, ..options() }).contains("zoom"));
        assert!(said(BodyOptions { size: [0, 3], ..options() }).contains("nothing to show"));
        assert!(said(BodyOptions { block: [[0.0; 3]; 2], ..options() }).contains("block"));
        let beyond = Body { positions: &positions[..2], triangles: &triangles, paint: &[] };
        let half = Body { positions: &positions, triangles: &triangles, paint: &[None; 3] };
        assert!(render(&half, &options()).unwrap_err().to_string().contains("colours"));
        assert!(render(&beyond, &options()).unwrap_err().to_string().contains("a vertex"));
    }
}
