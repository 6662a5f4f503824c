//! A domain the size and spacing of a raster file.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use landform_graph::Lattice;
use landform_io::Raster;
use landform_sim::code::Code;
use landform_sim::domain::{Border, Domain, DomainSource, Neighbourhood};
use landform_sim::outside::Outside;
use landform_sim::parameters::Problem;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What happens to cells without data.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Gaps {
    /// The raster is refused.
    #[default]
    Refuse,
    /// They get the lowest elevation of the raster, as if the sea were there.
    Lowest,
    /// They do not belong to the map, whose open border runs round them: water that reaches it is
    /// gone. They hold the elevation of the nearest cell with data, and outputs write no data there.
    Outside,
}

/// A grid with the size, the spacing and the place of a raster file (GeoTIFF, ESRI ASCII, NPY).
/// The initial condition `DomainRaster` fills a field with its values.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RasterDomain {
    /// The raster file, relative to the scenario.
    pub path: PathBuf,
    /// Distance between nodes; needed where the file does not say it in metres, used instead
    /// of the file's own where given.
    #[schemars(range(min = 1e-6, max = 1e6), extend("x-unit" = "m"))]
    pub spacing_m: Option<f64>,
    /// Keep only every n-th column and row.
    #[schemars(range(min = 1))]
    pub every: usize,
    /// Which nodes are joined.
    #[schemars(extend("x-source" = "thesis 2.5"))]
    pub connectivity: Neighbourhood,
    /// Boundary of the west-east axis and of the north-south axis.
    pub boundary: (Border, Border),
    /// What happens to cells without data.
    pub gaps: Gaps,
}

impl Default for RasterDomain {
    fn default() -> Self {
        Self {
            path: PathBuf::new(),
            spacing_m: None,
            every: 1,
            connectivity: Neighbourhood::FourEight,
            boundary: (Border::Open, Border::Open),
            gaps: Gaps::Refuse,
        }
    }
}

impl DomainSource for RasterDomain {
    const NAME: &'static str = "Raster";

    fn nodes(&self) -> Option<u128> {
        None
    }

    fn make(&self, folder: &Path) -> Result<Domain, Problem> {
        if self.path.as_os_str().is_empty() {
            return Err(Problem::new(
                "path",
                "no raster is given",
                "a GeoTIFF, ESRI ASCII or NPY file",
            )
            .help("name one on the command line: --set domain.path=FILE"));
        }
        let path = folder.join(&self.path);
        let mut raster = super::raster::read(&path, "path")?;
        let mut remarks = Vec::new();
        self.fill_gaps(&mut raster, &path, &mut remarks)?;
        let spacing_m = self.spacing(&raster, &mut remarks)?;
        let mut raster = super::raster::thin(raster, self.every.max(1));
        let boundary = [self.boundary.0.into(), self.boundary.1.into()];
        let spacing_m = spacing_m * self.every.max(1) as f64;
        let connectivity = self.connectivity.into();
        let lattice = Lattice::plane(raster.size(), spacing_m, connectivity, boundary)
            .map_err(|error| Problem::new("path", error.to_string(), "a larger raster"))?;
        let missing: Vec<bool> = raster.values.iter().map(|value| value.is_nan()).collect();
        let outside = Outside::new(&lattice, &missing);
        outside.extend(&mut raster.values);
        raster.complete(&path).map_err(|error| {
            Problem::new("path", error.to_string(), "data at one of the nodes that are kept")
                .code(Code::Gaps)
        })?;
        if !outside.is_empty() {
            let count = outside.pairs().len();
            remarks.push(format!("{count} nodes without data lie outside the map"));
        }
        Ok(Domain {
            raster: Some(raster.values.into()),
            georeference: raster.georeference.map(|place| Arc::new(place) as Arc<_>),
            no_data: raster.no_data,
            outside,
            remarks,
            ..Domain::from(lattice)
        })
    }
}

impl RasterDomain {
    fn fill_gaps(
        &self,
        raster: &mut Raster,
        path: &Path,
        remarks: &mut Vec<String>,
    ) -> Result<(), Problem> {
        let missing = raster.missing_count();
        let Some([lowest, _]) = raster.range() else {
            let problem = Problem::new("path", "the raster has no data at all", "elevations");
            return Err(problem.code(Code::Gaps));
        };
        match self.gaps {
            _ if missing == 0 => {}
            Gaps::Refuse => {
                let error = raster.complete(path).err().map_or(String::new(), |e| e.to_string());
                return Err(Problem::new("path", error, "a value in every cell")
                    .code(Code::Gaps)
                    .help("or choose what becomes of them: gaps: Outside, gaps: Lowest"));
            }
            Gaps::Lowest => {
                raster.values.iter_mut().filter(|v| v.is_nan()).for_each(|value| *value = lowest);
                remarks.push(format!("{missing} cells without data were set to {lowest} m"));
            }
            Gaps::Outside => {}
        }
        Ok(())
    }

    /// Distance between nodes of the file's grid, in metres.
    fn spacing(&self, raster: &Raster, remarks: &mut Vec<String>) -> Result<f64, Problem> {
        if let Some(spacing_m) = self.spacing_m {
            return Ok(spacing_m);
        }
        if let Ok(spacing_m) = raster.spacing_m() {
            return Ok(spacing_m);
        }
        let ground =
            raster.georeference.as_ref().map(|place| place.ground_cell_size_m(raster.size()));
        match (ground, raster.spacing_m()) {
            (Some([east, north]), _) if east > 0.0 && north > 0.0 => {
                let spacing_m = (east * north).sqrt();
                let error = |side: f64| 100.0 * (side / spacing_m - 1.0);
                remarks.push(format!(
                    "cells of {east:.1} m by {north:.1} m are taken as squares of {spacing_m:.1} m: \
                     slopes are off by {:+.0} % from east to west and {:+.0} % from north to south",
                    error(east),
                    error(north),
                ));
                Ok(spacing_m)
            }
            (_, Err(error)) => Err(Problem::new("spacing_m", error.to_string(), "metres")
                .code(Code::NoSpacing)
                .help("say the distance between nodes: spacing_m: 30.0")),
            (_, Ok(spacing_m)) => Ok(spacing_m),
        }
    }
}
