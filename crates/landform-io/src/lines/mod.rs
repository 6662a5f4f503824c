//! Lines: shores, rivers, contours.
//!
//! - CSV (`.csv`): a heading with `lon` and `lat` in degrees, or `x` and `y` in metres, and
//!   perhaps `line`, in any case and order; other columns are passed over. Rows with the same
//!   text in `line` that follow one another are one line; without that column all rows are.
//! - GeoJSON (`.geojson`, `.json`): lines and the rings of polygons, in longitude and latitude,
//!   or in metres where the member `crs` is null; points are passed over.
//!
//! A line that ends at the point where it starts is closed.

mod csv;
mod geojson;
mod plane;
mod write;

pub use plane::{LocalPlane, extent};
pub use write::{Feature, FeatureSystem, Geometry, Points, write_features};

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::files::{extension, unknown};
use crate::{Fault, IoError, Place, ReadLimits};

/// What the coordinates of lines mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineCoordinates {
    /// Longitude and latitude in degrees.
    Geographic,
    /// x and y in metres on a plane.
    Planar,
}

/// The lines of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct LineFile {
    /// What the coordinates mean.
    pub coordinates: LineCoordinates,
    /// The points of each line, two or more, as `[longitude, latitude]` or `[x, y]`.
    pub lines: Vec<Vec<[f64; 2]>>,
}

impl LineFile {
    /// Number of points of all lines.
    pub fn point_count(&self) -> usize {
        self.lines.iter().map(Vec::len).sum()
    }
}

/// Longest file that is read.
const LONGEST: u64 = 1 << 28;

/// Reads the lines of a CSV or GeoJSON file. `limits` bounds the number of points as it does
/// that of cells; files of more than 256 MiB are refused.
///
/// # Errors
/// [`IoError`]: an unknown extension, no such file, no or unknown columns, text that is no
/// number, places that are not on the globe, lines of a single point, or no line at all.
pub fn read_lines(path: impl AsRef<Path>, limits: &ReadLimits) -> Result<LineFile, IoError> {
    let path = path.as_ref();
    let parse = match extension(path).as_str() {
        "csv" => csv::parse,
        "geojson" | "json" => geojson::parse,
        extension => return Err(unknown(path, extension, ".csv, .geojson, .json")),
    };
    let text = text(path)?;
    let file = parse(text.strip_prefix('\u{feff}').unwrap_or(&text));
    let file = file.and_then(checked).map_err(|fault| fault.reading(path))?;
    limits.cells(path, &[file.point_count() as u64])?;
    Ok(file)
}

pub(crate) fn text(path: &Path) -> Result<String, IoError> {
    let system = |error| IoError::system(path, "read", error);
    let kind = std::fs::metadata(path).map_err(system)?.file_type();
    // Opening a pipe waits until somebody writes.
    if !kind.is_file() && !kind.is_dir() {
        let fault = Fault::new("this is a pipe or a device", "a file", "save it to a file first");
        return Err(fault.reading(path));
    }
    let mut bytes = Vec::new();
    let mut file = File::open(path).map_err(system)?.take(LONGEST + 1);
    file.read_to_end(&mut bytes).map_err(system)?;
    if bytes.len() as u64 > LONGEST {
        let expected = format!("at most {LONGEST} bytes");
        let fault = Fault::new("the file is too long", expected, "split it, or thin the lines");
        return Err(fault.reading(path));
    }
    String::from_utf8(bytes).map_err(|error| {
        let place = Place::Byte(error.utf8_error().valid_up_to() as u64);
        let fault = Fault::new("this is not UTF-8 text", "UTF-8", "convert the file");
        fault.at(place).reading(path)
    })
}

/// Passes what can be measured.
fn checked(file: LineFile) -> Result<LineFile, Fault> {
    if file.lines.is_empty() {
        let expected = "at least one line of two points";
        return Err(Fault::new("there is no line in it", expected, "check what was saved"));
    }
    if let Some(index) = file.lines.iter().position(|line| line.len() < 2) {
        let problem = format!("line number {} of the file has a single point", index + 1);
        return Err(Fault::new(problem, "two points or more", "remove it"));
    }
    Ok(file)
}

/// Passes a point that is finite, and on the globe if it is a place on it.
fn check_point(point: [f64; 2], coordinates: LineCoordinates) -> Result<[f64; 2], Fault> {
    let [x, y] = point;
    if x.abs() > 1e30 || y.abs() > 1e30 || !(x + y).is_finite() {
        let problem = format!("the point is {x}, {y}");
        return Err(Fault::new(problem, "numbers up to 1e30", "correct or remove it"));
    }
    if coordinates == LineCoordinates::Geographic && (x.abs() > 360.0 || y.abs() > 90.0) {
        let problem = format!("longitude {x}, latitude {y} is no place on the globe");
        let expected = "-360 to 360 and -90 to 90 degrees";
        let advice = "correct it; projected metres belong in a CSV file with columns x and y";
        return Err(Fault::new(problem, expected, advice));
    }
    Ok(point)
}
