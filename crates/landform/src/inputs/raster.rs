//! Initial conditions from raster files.

use std::path::{Path, PathBuf};

use landform_io::{Raster, read_raster};
use landform_sim::code::Code;
use landform_sim::initial::{InitialCondition, InitialContext};
use landform_sim::parameters::Problem;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::explain::file_problem;

/// The values of the raster that the domain was made from (domain `Raster`), scaled and raised.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DomainRaster {
    /// Factor of the values.
    pub scale: f64,
    /// Added after the factor, in the unit of the field.
    pub offset: f64,
}

impl Default for DomainRaster {
    fn default() -> Self {
        Self { scale: 1.0, offset: 0.0 }
    }
}

impl InitialCondition for DomainRaster {
    const NAME: &'static str = "DomainRaster";

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        let raster = context.domain.raster.as_deref().ok_or_else(|| {
            Problem::new("", "the domain comes from no raster", "the domain `Raster(path: ...)`")
        })?;
        Ok(raster.iter().map(|value| value * self.scale + self.offset).collect())
    }
}

/// The values of a raster file of the domain's size, scaled and raised.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RasterFile {
    /// The raster file, relative to the scenario.
    pub path: PathBuf,
    /// Factor of the values.
    pub scale: f64,
    /// Added after the factor, in the unit of the field.
    pub offset: f64,
}

impl Default for RasterFile {
    fn default() -> Self {
        Self { path: PathBuf::new(), scale: 1.0, offset: 0.0 }
    }
}

impl InitialCondition for RasterFile {
    const NAME: &'static str = "RasterFile";

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        let path = context.folder.join(&self.path);
        let raster = read(&path, "path")?;
        let [width, height, depth] = context.domain.lattice.size();
        if depth != 1 || raster.size() != [width, height] {
            let [columns, rows] = raster.size();
            let message = format!("{} has {columns} columns and {rows} rows", path.display());
            let expected = format!("{width} columns and {height} rows");
            return Err(Problem::new("path", message, expected).code(Code::OtherSize));
        }
        raster.complete(&path).map_err(|error| {
            Problem::new("path", error.to_string(), "a value in every cell").code(Code::Gaps)
        })?;
        Ok(raster.values.iter().map(|value| value * self.scale + self.offset).collect())
    }
}

/// Reads a raster for the parameter `parameter`.
pub(super) fn read(path: &Path, parameter: &str) -> Result<Raster, Problem> {
    read_raster(path).map_err(|error| file_problem(parameter, &error))
}

/// Every `step`-th column and row of a raster, from the north-west corner. The middles of the cells
/// that are left stay where they are.
pub(super) fn thin(raster: Raster, step: usize) -> Raster {
    if step == 1 {
        return raster;
    }
    let rows = (0..raster.height).step_by(step);
    let values = rows
        .flat_map(|row| {
            (0..raster.width).step_by(step).map(move |column| row * raster.width + column)
        })
        .map(|cell| raster.values[cell])
        .collect();
    let georeference = raster.georeference.map(|mut place| {
        let grown = 0.5 * (step as f64 - 1.0);
        place.west -= grown * place.cell_size[0];
        place.north += grown * place.cell_size[1];
        place.cell_size = place.cell_size.map(|size| size * step as f64);
        place
    });
    Raster {
        width: raster.width.div_ceil(step),
        height: raster.height.div_ceil(step),
        values,
        georeference,
        no_data: raster.no_data,
    }
}
