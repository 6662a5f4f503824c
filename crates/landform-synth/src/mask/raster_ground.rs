//! Rasters of heights as ground.

use std::path::{Path, PathBuf};

use landform_io::{ReadLimits, read_raster_file};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::picture::Picture;
use super::{MOST_PIXELS, MaskSurface, Shape};
use crate::SynthError;
use crate::error::Checks;

/// Name of the node in messages.
const NAME: &str = "RasterGround";

/// The heights of a raster file (GeoTIFF, ESRI ASCII, NPY, PNG), of weight 1 everywhere, with
/// straight lines between the middles of its cells and those of the border beyond it. Its cells may
/// be much larger than the spacing. L is the largest change from cell to cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RasterGround {
    /// The file.
    pub path: PathBuf,
    /// Width of its cells; the file's own when missing.
    #[schemars(range(min = 1e-6, max = 1e12), extend("x-unit" = "m"))]
    pub spacing_m: Option<f64>,
    /// Factor of heights: metres in a unit of the file.
    #[schemars(range(min = -1e9, max = 1e9))]
    pub scale: f64,
    /// Where its south-western corner lies, east and north of that of the cell of the
    /// south-western node.
    #[schemars(inner(range(min = -1e12, max = 1e12)), extend("x-unit" = "m"))]
    pub at_m: [f64; 2],
}

impl Default for RasterGround {
    fn default() -> Self {
        Self { path: PathBuf::new(), spacing_m: None, scale: 1.0, at_m: [0.0; 2] }
    }
}

impl RasterGround {
    /// Reads the raster, relative to `folder`, for nodes `spacing` metres apart.
    pub(crate) fn surface(&self, folder: &Path, spacing: f64) -> Result<MaskSurface, SynthError> {
        let checks = Checks(NAME);
        checks.range("scale", self.scale, -1e9..=1e9)?;
        checks.place("at_m", self.at_m)?;
        if self.path.as_os_str().is_empty() {
            return Err(unusable("no file is named; name a raster".to_owned()));
        }
        let path = folder.join(&self.path);
        let limits = ReadLimits { max_cells: MOST_PIXELS as u64 };
        let file = read_raster_file(&path, &limits).map_err(|error| unusable(error.to_string()))?;
        let raster = file.raster;
        raster.complete(&path).map_err(|error| unusable(error.to_string()))?;
        let pixel = match self.spacing_m {
            Some(pixel) => pixel,
            None => raster
                .spacing_m()
                .map_err(|error| unusable(format!("{}: {error}, as spacing_m", path.display())))?,
        };
        checks.length("spacing_m", pixel, 1e-6)?;
        let [least, most] = raster.range().unwrap_or_default().map(|height| height * self.scale);
        let [outside, inside] = [least, most];
        checks.elevation("scale", outside)?;
        checks.elevation("scale", inside)?;
        let at = self.at_m.map(|corner| corner + 0.5 * (pixel - spacing));
        let picture = Picture::new(raster, at, pixel);
        Ok(MaskSurface { shape: Shape::Picture(Box::new(picture)), outside, inside })
    }
}

fn unusable(problem: String) -> SynthError {
    SynthError::Unusable { generator: NAME, parameter: "path", problem }
}
