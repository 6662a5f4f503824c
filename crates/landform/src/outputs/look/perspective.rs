//! A view from a camera.

use landform_view::ViewError;
use landform_view::perspective::{PerspectiveOptions, Surroundings};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::ground;
use super::subject::{WaterDepths, water_of};

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
    /// Water of a field of depths over the heights; none when missing.
    pub water: Option<WaterDepths>,
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
            water: None,
        }
    }
}

impl Perspective {
    pub(super) fn options(&self) -> Result<PerspectiveOptions, ViewError> {
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
        options.water = water_of(self.water_level_m, self.water.as_ref());
        if self.repeat {
            options.surroundings = Surroundings::Repeat;
        }
        Ok(options)
    }
}
