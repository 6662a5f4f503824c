//! How a field is drawn: as a map under light, in perspective, or as flat colours.

use std::path::Path;

use landform_graph::Lattice;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_view::flat::{self, ColourBar};
use landform_view::perspective::{self, PerspectiveOptions, Surroundings};
use landform_view::relief::{ReliefOptions, shaded_relief};
use landform_view::{ColourMap, Ground, HeightField, Image, MOST_PIXELS, ViewError, Water};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a field is drawn.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub enum Look {
    /// A map of heights under sun and sky, with cast shadows.
    Relief(Relief),
    /// A view from a camera.
    Perspective(Perspective),
    /// Colours by value, without light.
    Flat(Flat),
}

impl Default for Look {
    fn default() -> Self {
        Self::Relief(Relief::default())
    }
}

/// A map of heights under sun and sky, with cast shadows.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Relief {
    /// Name of the colour map.
    pub colours: String,
    /// Heights of the first and the last colour; the field's own range when missing.
    #[schemars(extend("x-unit" = "m"))]
    pub range_m: Option<(f64, f64)>,
    /// Factor of heights for light and shadow.
    #[schemars(range(min = 1e-6, max = 1e6))]
    pub vertical_exaggeration: f64,
    /// Smooths the heights that are drawn; about 1 hides the steps of single slabs.
    #[schemars(range(min = 0.0, max = 100.0), extend("x-unit" = "nodes"))]
    pub smoothing_nodes: f64,
    /// Width of a node in pixels.
    #[schemars(range(min = 1e-3, max = 64.0))]
    pub pixels_per_node: f64,
    /// Compass bearing of the sun.
    #[schemars(extend("x-unit" = "degrees"))]
    pub sun_bearing_deg: f64,
    /// Height of the sun above the horizon.
    #[schemars(range(min = 1.0, max = 90.0), extend("x-unit" = "degrees"))]
    pub sun_altitude_deg: f64,
    /// Elevation of a water surface; none when missing.
    #[schemars(extend("x-unit" = "m"))]
    pub water_level_m: Option<f64>,
}

impl Default for Relief {
    fn default() -> Self {
        Self {
            colours: "sand".to_owned(),
            range_m: None,
            vertical_exaggeration: 1.0,
            smoothing_nodes: 0.0,
            pixels_per_node: 2.0,
            sun_bearing_deg: 315.0,
            sun_altitude_deg: 40.0,
            water_level_m: None,
        }
    }
}

/// A view from a camera that frames the whole field.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Perspective {
    /// Width and height of the picture.
    #[schemars(extend("x-unit" = "pixels"))]
    pub size: (usize, usize),
    /// Name of the colour map.
    pub colours: String,
    /// Heights of the first and the last colour; the field's own range when missing.
    #[schemars(extend("x-unit" = "m"))]
    pub range_m: Option<(f64, f64)>,
    /// Compass bearing towards which the camera looks: 0 north, 90 east.
    #[schemars(extend("x-unit" = "degrees"))]
    pub bearing_deg: f64,
    /// How far the camera looks down: 0 level, 90 straight down.
    #[schemars(range(min = 0.0, max = 90.0), extend("x-unit" = "degrees"))]
    pub pitch_deg: f64,
    /// Horizontal field of view.
    #[schemars(range(min = 1.0, max = 150.0), extend("x-unit" = "degrees"))]
    pub field_of_view_deg: f64,
    /// 1 fits the whole field into the picture; 2 halves the distance to its middle.
    #[schemars(range(min = 0.01, max = 1000.0))]
    pub zoom: f64,
    /// Factor of heights.
    #[schemars(range(min = 1e-6, max = 1e6))]
    pub vertical_exaggeration: f64,
    /// Smooths the heights that are drawn; about 1 hides the steps of single slabs.
    #[schemars(range(min = 0.0, max = 100.0), extend("x-unit" = "nodes"))]
    pub smoothing_nodes: f64,
    /// Compass bearing of the sun.
    #[schemars(extend("x-unit" = "degrees"))]
    pub sun_bearing_deg: f64,
    /// Height of the sun above the horizon.
    #[schemars(range(min = 1.0, max = 90.0), extend("x-unit" = "degrees"))]
    pub sun_altitude_deg: f64,
    /// Whether the field is repeated to the horizon instead of shown as a block.
    pub repeat: bool,
    /// Optical depth of the air over the field's diagonal; 0 is clear.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub haze: f64,
    /// Elevation of a water surface; none when missing.
    #[schemars(extend("x-unit" = "m"))]
    pub water_level_m: Option<f64>,
}

impl Default for Perspective {
    fn default() -> Self {
        Self {
            size: (1280, 800),
            colours: "sand".to_owned(),
            range_m: None,
            bearing_deg: 30.0,
            pitch_deg: 32.0,
            field_of_view_deg: 30.0,
            zoom: 1.0,
            vertical_exaggeration: 1.0,
            smoothing_nodes: 0.0,
            sun_bearing_deg: 285.0,
            sun_altitude_deg: 28.0,
            repeat: false,
            haze: 0.12,
            water_level_m: None,
        }
    }
}

/// Colours by value, without light, with a colour bar.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Flat {
    /// Name of the colour map.
    pub colours: String,
    /// Values of the first and the last colour; the field's own range when missing.
    pub range: Option<(f64, f64)>,
    /// Width of a node in pixels.
    #[schemars(range(min = 1, max = 64))]
    pub pixels_per_node: usize,
    /// Whether a colour bar is drawn beside the map.
    pub bar: bool,
}

impl Default for Flat {
    fn default() -> Self {
        Self { colours: "viridis".to_owned(), range: None, pixels_per_node: 2, bar: true }
    }
}

/// Thickness of water in metres below which the ground shows through.
const CLEAR_WATER_M: f64 = 10.0;

impl Look {
    /// Draws a field of `lattice`, whose values are in `unit`.
    pub(crate) fn draw(
        &self,
        lattice: &Lattice,
        values: &[f64],
        unit: &str,
    ) -> Result<Image, ViewError> {
        let size = [lattice.width(), lattice.height()];
        let periodic = lattice.is_periodic(0) && lattice.is_periodic(1);
        self.picture(size, lattice.spacing(), periodic, values, unit)
    }

    fn picture(
        &self,
        [width, height]: [usize; 2],
        spacing_m: f64,
        periodic: bool,
        values: &[f64],
        unit: &str,
    ) -> Result<Image, ViewError> {
        let heights = || HeightField::new(width, height, spacing_m, values);
        match self {
            Self::Relief(relief) => shaded_relief(&heights()?, &relief.options(periodic)?),
            Self::Perspective(view) => perspective::render(&heights()?, &view.options()?),
            Self::Flat(flat) => flat.draw(values, width, height, unit),
        }
    }

    /// Refuses what cannot be drawn of any field of `lattice`.
    pub(crate) fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        let nodes = [lattice.width() as f64, lattice.height() as f64];
        let [width, height] = match self {
            Self::Relief(relief) => nodes.map(|nodes| nodes * relief.pixels_per_node),
            Self::Perspective(view) => <[usize; 2]>::from(view.size).map(|size| size as f64),
            Self::Flat(flat) => nodes.map(|nodes| nodes * flat.pixels_per_node as f64),
        };
        let pixels = width * height;
        if !(1.0..=MOST_PIXELS as f64).contains(&pixels) {
            let message = format!("the picture would have {width:.0} x {height:.0} pixels");
            return Err(Problem::new("look", message, format!("from 1 to {MOST_PIXELS} pixels")));
        }
        let heights = !matches!(self, Self::Flat(_));
        if heights && lattice.width().min(lattice.height()) < 2 {
            let message = format!("{} x {} nodes span no surface", nodes[0], nodes[1]);
            return Err(Problem::new("look", message, "at least 2 x 2 nodes, or the look Flat"));
        }
        self.trial().map(|_| ()).map_err(|error| Problem::new("look", error.to_string(), ""))
    }

    /// A tiny picture with all the settings, for what only drawing finds wrong.
    fn trial(&self) -> Result<Image, ViewError> {
        const SIDE: usize = 4;
        let mut small = self.clone();
        if let Self::Perspective(view) = &mut small {
            view.size = (SIDE, SIDE);
        }
        small.picture([SIDE, SIDE], 1.0, false, &[0.0; SIDE * SIDE], "")
    }

    /// The values of the first and the last colour, when they are given.
    pub(crate) fn range(&self) -> Option<(f64, f64)> {
        match self {
            Self::Relief(relief) => relief.range_m,
            Self::Perspective(view) => view.range_m,
            Self::Flat(flat) => flat.range,
        }
    }

    /// The same look with colours over a given range.
    pub(crate) fn with_range(mut self, range: (f64, f64)) -> Self {
        match &mut self {
            Self::Relief(relief) => relief.range_m = Some(range),
            Self::Perspective(view) => view.range_m = Some(range),
            Self::Flat(flat) => flat.range = Some(range),
        }
        self
    }
}

fn ground(colours: &str, range_m: Option<(f64, f64)>) -> Result<Ground, ViewError> {
    let range_m = range_m.map(|(low, high)| [low, high]);
    Ok(Ground { range_m, ..Ground::new(ColourMap::named(colours)?) })
}

impl Relief {
    fn options(&self, periodic: bool) -> Result<ReliefOptions, ViewError> {
        let mut options = ReliefOptions::new(ground(&self.colours, self.range_m)?);
        options.vertical_exaggeration = self.vertical_exaggeration;
        options.smoothing_nodes = self.smoothing_nodes;
        options.pixels_per_node = self.pixels_per_node;
        options.light.bearing_deg = self.sun_bearing_deg;
        options.light.altitude_deg = self.sun_altitude_deg;
        options.water = self.water_level_m.map(|level| Water::at(level, CLEAR_WATER_M));
        options.periodic = periodic;
        Ok(options)
    }
}

impl Perspective {
    fn options(&self) -> Result<PerspectiveOptions, ViewError> {
        let mut options = PerspectiveOptions::new(ground(&self.colours, self.range_m)?);
        options.size = self.size.into();
        options.bearing_deg = self.bearing_deg;
        options.pitch_deg = self.pitch_deg;
        options.field_of_view_deg = self.field_of_view_deg;
        options.zoom = self.zoom;
        options.vertical_exaggeration = self.vertical_exaggeration;
        options.smoothing_nodes = self.smoothing_nodes;
        options.light.bearing_deg = self.sun_bearing_deg;
        options.light.altitude_deg = self.sun_altitude_deg;
        options.haze = self.haze;
        options.water = self.water_level_m.map(|level| Water::at(level, CLEAR_WATER_M));
        if self.repeat {
            options.surroundings = Surroundings::Repeat;
        }
        Ok(options)
    }
}

impl Flat {
    fn draw(
        &self,
        values: &[f64],
        width: usize,
        height: usize,
        unit: &str,
    ) -> Result<Image, ViewError> {
        let colours = ColourMap::named(&self.colours)?;
        let range = self.range.map_or_else(|| flat::finite_range(values), <[f64; 2]>::from);
        let pixels = self.pixels_per_node;
        let image = flat::colour_field(values, width, height, colours, Some(range), pixels)?;
        match self.bar {
            true => {
                ColourBar { colours, range, label: unit.to_owned(), text_size: 14.0 }.beside(&image)
            }
            false => Ok(image),
        }
    }
}

/// A failure to draw as a problem of the output that wanted the picture.
pub(crate) fn problem(error: &ViewError) -> Problem {
    Problem::new("", error.to_string(), "")
}

/// What goes into the text of a picture of a field: where it came from and its scale.
pub(crate) fn picture_text(snapshot: &Snapshot<'_>, field: &str) -> Vec<(String, String)> {
    let clock = snapshot.clock();
    let unit = snapshot.entry(field).map_or("", |entry| entry.unit);
    let pairs = [
        ("Title", snapshot.title().to_owned()),
        ("Software", concat!("landform ", env!("CARGO_PKG_VERSION")).to_owned()),
        ("field", format!("{field} ({unit})")),
        ("spacing_m", snapshot.lattice().spacing().to_string()),
        ("seed", clock.seed.to_string()),
        ("iteration", clock.tick.to_string()),
    ];
    pairs.map(|(key, value)| (key.to_owned(), value)).into()
}

/// Writes a picture with its text.
pub(crate) fn write_picture(
    image: &Image,
    path: &Path,
    text: &[(String, String)],
) -> Result<(), Problem> {
    let text: Vec<_> = text.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect();
    image.write_png(path, &text).map_err(|error| problem(&error))
}
