//! Passages as a map of a cave.

use landform_analysis::caves::CaveNetwork;
use landform_analysis::voxels::{Surface, VoxelSet, smooth_surface};
use landform_graph::Lattice;
use landform_view::body::Body;
use landform_view::cave_map::{CaveMapOptions, CaveView, draw};
use landform_view::{ColourMap, Image, ViewError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Subject, marks};

/// From where a cave is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum CaveMapView {
    /// From above, north at the top.
    Plan,
    /// From the south, west at the left.
    FromSouth,
    /// From the east, south at the left.
    FromEast,
}

/// The voxels of at least a value as those who survey caves draw them: plan and elevations without
/// perspective, walls as lines, dashed where another passage hides them, tints by height; with scale
/// bar, north arrow, heights, where water comes in and goes out, length and height of the cave. The
/// length is that of the legs of a survey.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CaveMap {
    /// Voxels of at least this value are passages.
    pub at_least: f64,
    /// The views, from the top of the page, all to the same scale.
    #[schemars(length(min = 1, max = 3))]
    pub views: Vec<CaveMapView>,
    /// Steps of 4-8 subdivision that smooth the walls.
    #[schemars(range(max = 5), extend("x-source" = "thesis A.3"))]
    pub smoothing: usize,
    /// Name of the colour map of the tints.
    pub colours: String,
    /// Width of the widest view.
    #[schemars(range(min = 50, max = 10000), extend("x-unit" = "pixels"))]
    pub width: usize,
    /// Whether sources and sinks are marked.
    pub marks: bool,
}

impl Default for CaveMap {
    fn default() -> Self {
        Self {
            at_least: 0.5,
            views: vec![CaveMapView::Plan, CaveMapView::FromSouth],
            smoothing: 2,
            colours: "batlow".to_owned(),
            width: 800,
            marks: true,
        }
    }
}

impl CaveMap {
    /// Width and height in metres of each view of a block.
    fn extents(&self, [x, y, z]: [f64; 3]) -> impl Iterator<Item = [f64; 2]> {
        self.views.iter().map(move |view| match view {
            CaveMapView::Plan => [x, y],
            CaveMapView::FromSouth => [x, z],
            CaveMapView::FromEast => [y, z],
        })
    }

    fn pixels_per_m(&self, top: [f64; 3]) -> f64 {
        let widest = self.extents(top).map(|[width, _]| width).fold(f64::MIN_POSITIVE, f64::max);
        self.width as f64 / widest
    }

    /// Width and height in samples of the pictures that it takes, one below the other.
    pub(super) fn samples(&self, lattice: &Lattice) -> [f64; 2] {
        /// Samples a pixel each way.
        const SIDE: f64 = 3.0;
        let top = lattice.size().map(|nodes| nodes as f64 * lattice.spacing());
        let tall: f64 = self.extents(top).map(|[_, height]| height).sum();
        [SIDE * self.width as f64, SIDE * (tall * self.pixels_per_m(top)).max(1.0)]
    }

    pub(super) fn draw(&self, lattice: &Lattice, subject: &Subject) -> Result<Image, ViewError> {
        let spacing_m = lattice.spacing();
        let top = lattice.size().map(|nodes| nodes as f64 * spacing_m);
        let set = VoxelSet::at_least(lattice.size(), &subject.values, self.at_least);
        let Surface { mut positions, triangles } = smooth_surface(&set, self.smoothing);
        positions.iter_mut().flatten().for_each(|at| *at *= spacing_m);
        let options = CaveMapOptions {
            marks: marks::of(&subject.places),
            words: words(&set, spacing_m),
            step_m: 1.5 * spacing_m,
            ..self.options(top)?
        };
        draw(&Body { positions: &positions, triangles: &triangles, paint: &[] }, &options)
    }

    fn options(&self, top: [f64; 3]) -> Result<CaveMapOptions, ViewError> {
        let view = |view: &CaveMapView| match view {
            CaveMapView::Plan => CaveView::Plan,
            CaveMapView::FromSouth => CaveView::FromSouth,
            CaveMapView::FromEast => CaveView::FromEast,
        };
        Ok(CaveMapOptions {
            views: self.views.iter().map(view).collect(),
            pixels_per_m: self.pixels_per_m(top),
            colours: ColourMap::named(&self.colours)?,
            block: [[0.0; 3], top],
            step_m: 1.0,
            marks: Vec::new(),
            words: Vec::new(),
        })
    }

    /// A tiny map with all the settings, for what only drawing finds wrong.
    pub(super) fn trial(&self) -> Result<Image, ViewError> {
        let small = Self { width: 4, ..self.clone() };
        draw(&Body { positions: &[], triangles: &[], paint: &[] }, &small.options([1.0; 3])?)
    }
}

/// How long the passages are, and how high.
fn words(set: &VoxelSet, spacing_m: f64) -> Vec<String> {
    let Ok(network) = CaveNetwork::of_passages(set, spacing_m) else { return Vec::new() };
    let layers = || set.iter().map(|[_, _, layer]| layer);
    let range = layers().max().unwrap_or(0) + 1 - layers().min().unwrap_or(0);
    vec![
        format!("length {:.0} m", network.resampled(spacing_m).length_m()),
        format!("vertical range {} m", range as f64 * spacing_m),
    ]
}
