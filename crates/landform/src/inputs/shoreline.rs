//! A domain round a shoreline.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use landform_graph::{Boundary, Lattice};
use landform_io::lines::extent;
use landform_io::{
    CoordinateSystem, Georeference, LineCoordinates, LocalPlane, ReadLimits, Registration,
    read_lines,
};
use landform_sim::domain::{Domain, DomainSource, Neighbourhood};
use landform_sim::parameters::Problem;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::scanline::within_rings;

/// A grid round the lines of a file (CSV or GeoJSON), closed to rings: shores of islands, lakes
/// within them, outlines of countries. The initial condition `DomainRaster` fills a field with 1
/// within them and 0 outside. Files in degrees give a map that is true along the middle parallel
/// of the lines, and what is written from it has degrees again.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ShorelineDomain {
    /// The file, relative to the scenario: a heading with `lon` and `lat` or `x` and `y`, or
    /// GeoJSON.
    pub path: PathBuf,
    /// Nodes along the longer side of the map.
    #[schemars(range(min = 8, max = 16384))]
    pub nodes: usize,
    /// Width of the sea on all sides of the lines, as a share of their longer extent.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub margin: f64,
    /// Which nodes are joined.
    #[schemars(extend("x-source" = "thesis 2.5"))]
    pub connectivity: Neighbourhood,
}

impl Default for ShorelineDomain {
    fn default() -> Self {
        Self {
            path: PathBuf::new(),
            nodes: 512,
            margin: 0.1,
            connectivity: Neighbourhood::FourEight,
        }
    }
}

/// Most points that are read.
const MOST_POINTS: u64 = 100_000;

impl DomainSource for ShorelineDomain {
    const NAME: &'static str = "Shoreline";

    /// At most so many: the shorter side follows from the file.
    fn nodes(&self) -> Option<u128> {
        Some((self.nodes as u128).pow(2))
    }

    fn make(&self, folder: &Path) -> Result<Domain, Problem> {
        if self.path.as_os_str().is_empty() {
            let expected = "a CSV or GeoJSON file of lines";
            return Err(Problem::new("path", "no shoreline is given", expected)
                .help("name one on the command line: --set domain.path=FILE"));
        }
        let path = folder.join(&self.path);
        let refused = |message: String, expected: &str| Problem::new("path", message, expected);
        let file = read_lines(&path, &ReadLimits { max_cells: MOST_POINTS });
        let file = file.map_err(|error| refused(error.to_string(), ""))?;
        if file.coordinates == LineCoordinates::Geographic {
            let [[west, south], [east, north]] = extent(&file.lines);
            if east - west > 180.0 || south.abs().max(north.abs()) > 85.0 {
                let message = format!(
                    "{} reaches from {west} to {east} degrees east and from {south} to {north} \
                     north",
                    path.display()
                );
                let expected = "at most 180 degrees east to west, and 85 degrees of latitude";
                return Err(refused(message, expected).help(
                    "cut the lines, add 360 to western longitudes beside the 180th meridian, or \
                     project them to metres (columns x, y)",
                ));
            }
        }
        let (lines, plane) = file.into_metres();
        let open = lines.iter().filter(|line| line.first() != line.last()).count();
        let mut domain = self.lay_out(lines, plane)?;
        if open > 0 {
            let path = path.display();
            domain.remarks.push(format!("{path}: {open} open lines were closed straight"));
        }
        Ok(domain)
    }
}

impl ShorelineDomain {
    /// The map round lines in metres.
    fn lay_out(
        &self,
        lines: Vec<Vec<[f64; 2]>>,
        plane: Option<LocalPlane>,
    ) -> Result<Domain, Problem> {
        let [low, high] = extent(&lines);
        let reach = [0, 1].map(|axis| high[axis] - low[axis]);
        let longer = reach[0].max(reach[1]);
        let spacing_m = longer * (1.0 + 2.0 * self.margin) / self.nodes as f64;
        let count = |reach: f64| {
            let nodes = (reach + 2.0 * self.margin * longer) / spacing_m;
            (nodes.round() as usize).clamp(1, self.nodes)
        };
        let size = reach.map(count);
        let lattice =
            Lattice::plane(size, spacing_m, self.connectivity.into(), [Boundary::Open; 2]);
        let lattice = lattice
            .map_err(|error| Problem::new("path", error.to_string(), "lines that span an area"))?;
        // The south-western corner of the map: half a spacing beyond the first node.
        let corner =
            [0, 1].map(|axis| low[axis] + 0.5 * (reach[axis] - size[axis] as f64 * spacing_m));
        let moved = |ring: &Vec<[f64; 2]>| {
            ring.iter().map(|at| [at[0] - corner[0], at[1] - corner[1]]).collect()
        };
        let rings: Vec<Vec<[f64; 2]>> = lines.iter().map(moved).collect();
        let land = within_rings(&lattice, &rings).into();
        Ok(Domain {
            georeference: Some(Arc::new(georeference(corner, &lattice, plane))),
            raster: Some(land),
            ..Domain::from(lattice)
        })
    }
}

/// The place of a map with a south-western corner in metres.
fn georeference(corner: [f64; 2], lattice: &Lattice, plane: Option<LocalPlane>) -> Georeference {
    let (rows, spacing_m) = (lattice.height() as f64, lattice.spacing());
    let Some(LocalPlane { origin, metres_per_degree }) = plane else {
        return Georeference {
            west: corner[0],
            north: corner[1] + rows * spacing_m,
            ..Georeference::local(lattice.height(), spacing_m)
        };
    };
    let cell_size = metres_per_degree.map(|metres| spacing_m / metres);
    let [west, south] = [0, 1].map(|axis| origin[axis] + corner[axis] / metres_per_degree[axis]);
    Georeference {
        west,
        north: south + rows * cell_size[1],
        cell_size,
        registration: Registration::Area,
        coordinate_system: CoordinateSystem::from_epsg(4326),
    }
}
