//! Where a raster lies on the Earth, and how long its cells are in metres.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// What a cell's position stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Registration {
    /// The value is the cell's: GeoTIFF `PixelIsArea`, ESRI `xllcorner`.
    #[default]
    Area,
    /// The value is that of the cell's centre: GeoTIFF `PixelIsPoint`, ESRI `xllcenter`.
    Point,
}

/// What kind of coordinates a system has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum CoordinateKind {
    /// Nothing says. Taken for metres, unless the numbers look like degrees.
    #[default]
    Unknown,
    /// Lengths on a map plane.
    Projected {
        /// Length of one unit in metres.
        metres_per_unit: f64,
    },
    /// Longitude and latitude in degrees.
    Geographic,
}

/// The GeoKeys of a GeoTIFF, verbatim (OGC 19-008r4, section 7.1).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GeoKeys {
    /// Tag 34735.
    pub directory: Vec<u16>,
    /// Tag 34736.
    pub doubles: Vec<f64>,
    /// Tag 34737.
    pub text: String,
}

/// A coordinate system as far as a file names it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct CoordinateSystem {
    /// Degrees or lengths.
    pub kind: CoordinateKind,
    /// Number in the EPSG register.
    pub epsg: Option<u16>,
    /// Citation, or the well-known text of a `.prj` file, verbatim.
    pub text: Option<String>,
    /// The keys of the GeoTIFF that it comes from; they are written again as they are, but for
    /// letters beyond ASCII.
    pub keys: Option<GeoKeys>,
}

/// Where a raster lies: corner, cell size and coordinate system. Axes are not rotated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Georeference {
    /// Western edge of the western column (its outer side).
    pub west: f64,
    /// Northern edge of the northern row (its outer side).
    pub north: f64,
    /// Size of a cell along x and y in units of the coordinate system, both positive.
    pub cell_size: [f64; 2],
    /// What a position stands for.
    #[serde(default)]
    pub registration: Registration,
    /// The coordinate system.
    #[serde(default)]
    pub coordinate_system: CoordinateSystem,
}

/// Why a raster has no single spacing in metres.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SpacingError {
    /// There is no georeference at all.
    #[error("the raster does not say how large its cells are; give the spacing in metres")]
    Unknown,
    /// The cells are measured in degrees.
    #[error(
        "the cells measure {degrees:?} degrees (about {metres:.1?} m east-west and \
         north-south at the centre); project the raster to metres, or give a spacing"
    )]
    Degrees {
        /// Size along x and y in degrees.
        degrees: [f64; 2],
        /// The same on the ground, at the raster's centre.
        metres: [f64; 2],
    },
    /// The cells are not square.
    #[error("the cells measure {0:?} m and are not square; resample the raster to square cells")]
    NotSquare([f64; 2]),
}

impl CoordinateSystem {
    /// The system that a text describes: `EPSG:32611 ...`, or well-known text.
    pub fn from_text(text: &str) -> Self {
        let text = text.trim();
        let upper = text.to_ascii_uppercase();
        let epsg = epsg_in(&upper);
        let is = |names: &[&str]| names.iter().any(|name| upper.starts_with(name));
        let kind = if is(&["GEOGCS", "GEOGCRS", "GEODCRS"]) || epsg.is_some_and(is_geographic) {
            CoordinateKind::Geographic
        } else if is(&["PROJCS", "PROJCRS", "PROJECTEDCRS"]) || upper.contains("METRES") {
            CoordinateKind::Projected { metres_per_unit: unit_in(&upper).unwrap_or(1.0) }
        } else {
            CoordinateKind::Unknown
        };
        Self { kind, epsg, text: Some(text.into()), keys: None }
    }

    /// The system of an EPSG number; `kind` is known for the common geographic ones and for
    /// UTM zones on WGS 84, ETRS89 and NAD83.
    pub fn from_epsg(epsg: u16) -> Self {
        let utm = matches!(epsg, 32601..=32660 | 32701..=32760 | 25828..=25838 | 26901..=26923);
        let kind = match (is_geographic(epsg), utm) {
            (true, _) => CoordinateKind::Geographic,
            (_, true) => CoordinateKind::Projected { metres_per_unit: 1.0 },
            _ => CoordinateKind::Unknown,
        };
        Self { kind, epsg: Some(epsg), text: None, keys: None }
    }
}

/// The common systems of longitude and latitude. The register has no ranges to go by.
fn is_geographic(epsg: u16) -> bool {
    const COMMON: [u16; 16] = [
        4019, 4167, 4258, 4267, 4269, 4283, 4326, 4490, 4612, 4617, 4674, 4979, 6318, 6668, 7844,
        9000,
    ];
    COMMON.contains(&epsg)
}

/// The number after the last `EPSG:` or `"EPSG",`: well-known text ends with its own.
fn epsg_in(upper: &str) -> Option<u16> {
    let tail = &upper[upper.rfind("EPSG")? + 4..];
    let tail = tail.trim_start_matches([':', '"', ',', ' ']);
    let end = tail.find(|letter: char| !letter.is_ascii_digit()).unwrap_or(tail.len());
    tail[..end].parse().ok()
}

/// The last unit of a well-known text, which is the one of its axes.
fn unit_in(upper: &str) -> Option<f64> {
    let tail = &upper[upper.rfind("UNIT[")?..];
    let number = tail.split(',').nth(1)?;
    let end = number.find(']').unwrap_or(number.len());
    number[..end].trim().parse().ok().filter(|unit: &f64| *unit > 0.0 && unit.is_finite())
}

impl Georeference {
    /// A local map of metres whose south-west corner is the origin.
    pub fn local(rows: usize, spacing_m: f64) -> Self {
        let kind = CoordinateKind::Projected { metres_per_unit: 1.0 };
        Self {
            west: 0.0,
            north: rows as f64 * spacing_m,
            cell_size: [spacing_m; 2],
            registration: Registration::Area,
            coordinate_system: CoordinateSystem { kind, ..CoordinateSystem::default() },
        }
    }

    /// Whether x and y are degrees: the system says so, or nothing says anything and the
    /// numbers fit no map of metres (a globe's range with cells below a fifth of a degree).
    pub fn is_geographic(&self, [columns, rows]: [usize; 2]) -> bool {
        let east = self.west + columns as f64 * self.cell_size[0];
        let south = self.north - rows as f64 * self.cell_size[1];
        match self.coordinate_system.kind {
            CoordinateKind::Geographic => true,
            CoordinateKind::Projected { .. } => false,
            CoordinateKind::Unknown => {
                self.cell_size[0] < 0.2
                    && self.west >= -180.5
                    && east <= 360.5
                    && self.north <= 90.5
                    && south >= -90.5
            }
        }
    }

    /// Size of a cell on the ground in metres, east-west and north-south. For degrees it is
    /// that at the raster's centre, on the ellipsoid of WGS 84.
    pub fn ground_cell_size_m(&self, size: [usize; 2]) -> [f64; 2] {
        if self.is_geographic(size) {
            let latitude = self.north - 0.5 * size[1] as f64 * self.cell_size[1];
            let [along, across] = metres_per_degree(latitude);
            return [self.cell_size[0] * along, self.cell_size[1] * across];
        }
        let unit = match self.coordinate_system.kind {
            CoordinateKind::Projected { metres_per_unit } => metres_per_unit,
            _ => 1.0,
        };
        self.cell_size.map(|length| length * unit)
    }

    /// The spacing of square cells in metres; sides may differ by a hundredth of a per cent.
    ///
    /// # Errors
    /// [`SpacingError::Degrees`] and [`SpacingError::NotSquare`].
    pub fn spacing_m(&self, size: [usize; 2]) -> Result<f64, SpacingError> {
        let metres = self.ground_cell_size_m(size);
        if self.is_geographic(size) {
            return Err(SpacingError::Degrees { degrees: self.cell_size, metres });
        }
        if (metres[0] - metres[1]).abs() > 1e-4 * metres[0] {
            return Err(SpacingError::NotSquare(metres));
        }
        Ok(metres[0])
    }
}

/// Length of a degree of longitude and of latitude on the ellipsoid of WGS 84, from its radii
/// of curvature along the parallel and the meridian.
pub(crate) fn metres_per_degree(latitude: f64) -> [f64; 2] {
    const EQUATORIAL_RADIUS: f64 = 6_378_137.0;
    const SQUARED_ECCENTRICITY: f64 = 0.006_694_379_990_14;
    let (sine, cosine) = latitude.to_radians().sin_cos();
    let curvature = 1.0 - SQUARED_ECCENTRICITY * sine * sine;
    let parallel = EQUATORIAL_RADIUS * cosine / curvature.sqrt();
    let meridian = EQUATORIAL_RADIUS * (1.0 - SQUARED_ECCENTRICITY) / curvature.powf(1.5);
    [parallel.to_radians(), meridian.to_radians()]
}
