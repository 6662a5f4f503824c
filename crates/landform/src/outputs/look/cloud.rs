//! Values of a volume as a translucent cloud.

use landform_graph::Lattice;
use landform_view::cloud::{CloudOptions, Opacity, Volume, render};
use landform_view::{ColourMap, Image, ViewError, flat};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Subject, marks};

/// Which values of a cloud hide what is behind them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum CloudOpacity {
    /// All alike.
    Even,
    /// The high ones.
    High,
    /// The low and the high ones; those in the middle of the range are clear.
    Ends,
}

/// The values of a volume as a translucent cloud in perspective, such as the pressure around caves:
/// blue where it is low, red where it is high.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Cloud {
    /// Name of the colour map.
    pub colours: String,
    /// Values of the first and the last colour; the field's own range when missing.
    pub range: Option<(f64, f64)>,
    /// Which values hide what is behind them.
    pub opacity: CloudOpacity,
    /// Optical depth of the most opaque values across the block's diagonal.
    #[schemars(range(min = 0.0, max = 10000.0))]
    pub density: f64,
    /// Width and height of the picture.
    #[schemars(extend("x-unit" = "pixels"))]
    pub size: (usize, usize),
    /// Compass bearing towards which the camera looks.
    #[schemars(extend("x-unit" = "degrees"))]
    pub bearing_deg: f64,
    /// How far the camera looks down; 90 is a plan.
    #[schemars(range(min = -90.0, max = 90.0), extend("x-unit" = "degrees"))]
    pub pitch_deg: f64,
    /// 1 fits the whole block into the picture; 2 halves the distance to its middle.
    #[schemars(range(min = 0.01, max = 1000.0))]
    pub zoom: f64,
    /// Whether sources and sinks of caves are marked.
    pub marks: bool,
}

impl Default for Cloud {
    fn default() -> Self {
        Self {
            colours: "vik".to_owned(),
            range: None,
            opacity: CloudOpacity::Ends,
            density: 8.0,
            size: (960, 640),
            bearing_deg: 25.0,
            pitch_deg: 30.0,
            zoom: 1.0,
            marks: true,
        }
    }
}

impl Cloud {
    pub(super) fn draw(&self, lattice: &Lattice, subject: &Subject) -> Result<Image, ViewError> {
        let (size, spacing_m) = (lattice.size(), lattice.spacing());
        let volume = Volume { size, spacing_m, values: &subject.values };
        let own = || flat::finite_range(&subject.values);
        let range = self.range.map_or_else(own, |(low, high)| [low, high]);
        let options = CloudOptions { marks: marks::of(&subject.places), ..self.options(range)? };
        render(&volume, &options)
    }

    fn options(&self, range: [f64; 2]) -> Result<CloudOptions, ViewError> {
        Ok(CloudOptions {
            size: self.size.into(),
            bearing_deg: self.bearing_deg,
            pitch_deg: self.pitch_deg,
            zoom: self.zoom,
            opacity: match self.opacity {
                CloudOpacity::Even => Opacity::Even,
                CloudOpacity::High => Opacity::High,
                CloudOpacity::Ends => Opacity::Ends,
            },
            density: self.density,
            ..CloudOptions::new(ColourMap::named(&self.colours)?, range)
        })
    }

    /// A tiny picture with all the settings, for what only drawing finds wrong.
    pub(super) fn trial(&self) -> Result<Image, ViewError> {
        let small = Self { size: (4, 4), ..self.clone() };
        let range = self.range.map_or([0.0, 1.0], |(low, high)| [low, high]);
        let volume = Volume { size: [1; 3], spacing_m: 1.0, values: &[0.0] };
        render(&volume, &small.options(range)?)
    }
}
