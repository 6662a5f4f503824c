//! The initial condition `LandAbove`.

use std::path::PathBuf;

use landform_sim::initial::{InitialCondition, InitialContext};
use landform_sim::parameters::Problem;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::raster::{DomainRaster, RasterFile};

/// Land within a level set of a raster: 1 where it lies above a level, 0 elsewhere.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LandAbove {
    /// The level: 0 for a coast on a raster of elevations and depths.
    #[schemars(extend("x-unit" = "unit of the raster"))]
    pub level: f64,
    /// A raster of the domain's size, relative to the scenario; the raster that the domain was
    /// made from when missing.
    pub path: Option<PathBuf>,
}

impl InitialCondition for LandAbove {
    const NAME: &'static str = "LandAbove";

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        if !self.level.is_finite() {
            let message = format!("the level is {}", self.level);
            return Err(Problem::new("level", message, "a finite number"));
        }
        let elevations = match &self.path {
            Some(path) => {
                RasterFile { path: path.clone(), ..RasterFile::default() }.values(context)?
            }
            None => DomainRaster::default().values(context)?,
        };
        let land = |elevation: f64| f64::from(u8::from(elevation > self.level));
        Ok(elevations.into_iter().map(land).collect())
    }
}
