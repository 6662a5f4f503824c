//! A map of heights under sun and sky.

use landform_view::ViewError;
use landform_view::relief::ReliefOptions;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::ground;
use super::subject::{WaterDepths, water_of};

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
    /// Water of a field of depths over the heights; none when missing.
    pub water: Option<WaterDepths>,
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
            water: None,
        }
    }
}

impl Relief {
    pub(super) fn options(&self, periodic: bool) -> Result<ReliefOptions, ViewError> {
        let mut options = ReliefOptions::new(ground(&self.colours, self.range_m)?);
        options.vertical_exaggeration = self.vertical_exaggeration;
        options.smoothing_nodes = self.smoothing_nodes;
        options.pixels_per_node = self.pixels_per_node;
        options.light.bearing_deg = self.sun_bearing_deg;
        options.light.altitude_deg = self.sun_altitude_deg;
        options.water = water_of(self.water_level_m, self.water.as_ref());
        options.periodic = periodic;
        Ok(options)
    }
}
