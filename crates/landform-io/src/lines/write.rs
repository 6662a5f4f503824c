//! Lines and areas with properties into CSV and GeoJSON files.

use std::io::{self, Write};
use std::path::Path;

use serde_json::{Map, Value, json};

use crate::files::{extension, unknown};
use crate::{CoordinateKind, Georeference, IfExists, IoError, write_atomically};

/// Points in the coordinates of the map, `[x, y]` or `[longitude, latitude]`. The last point of a
/// closed line is its first.
pub type Points = Vec<[f64; 2]>;

/// What lies on the map.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// A line.
    Line(Points),
    /// Areas: each an outer ring, counter-clockwise, and rings round its holes, clockwise.
    Areas(Vec<Vec<Points>>),
}

/// A thing on the map with what is known about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Feature {
    /// Where it is.
    pub geometry: Geometry,
    /// Names and numbers, the same names in the same order for all lines of a file.
    pub properties: Vec<(&'static str, f64)>,
}

/// What the coordinates of a file's features are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeatureSystem {
    /// Longitude and latitude in degrees.
    Geographic,
    /// Lengths of the system with this number in the EPSG register.
    Projected(u16),
    /// Metres on a map of its own.
    Local,
}

impl FeatureSystem {
    /// The system of a raster of some columns and rows.
    pub fn of(place: &Georeference, size: [usize; 2]) -> Self {
        let system = &place.coordinate_system;
        match (place.is_geographic(size), system.kind, system.epsg) {
            (true, _, _) => Self::Geographic,
            (_, CoordinateKind::Projected { .. }, Some(number)) => Self::Projected(number),
            _ => Self::Local,
        }
    }
}

/// Writes features to a file whose extension names the format: `.csv`, a point a row with the
/// number of its line, its properties and its coordinates, each ring of an area a line; or
/// `.geojson`, a `LineString` or `MultiPolygon` each.
///
/// RFC 7946 knows only degrees. Features in metres carry the `crs` member of the older GeoJSON
/// (2008), which geographic information systems read: a name, or null where there is none.
///
/// # Errors
/// [`IoError`]: another extension, or what the system refuses.
pub fn write_features(
    path: impl AsRef<Path>,
    features: &[Feature],
    system: FeatureSystem,
    exists: IfExists,
) -> Result<(), IoError> {
    let path = path.as_ref();
    match extension(path).as_str() {
        "csv" => write_atomically(path, exists, |file| table(file, features, system)),
        "geojson" => write_atomically(path, exists, |file| collection(file, features, system)),
        extension => Err(unknown(path, extension, ".csv, .geojson")),
    }
}

fn table(file: &mut impl Write, features: &[Feature], system: FeatureSystem) -> io::Result<()> {
    write!(file, "line")?;
    for (name, _) in features.first().map_or(&[][..], |feature| &feature.properties) {
        write!(file, ",{name}")?;
    }
    writeln!(file, "{}", if system == FeatureSystem::Geographic { ",lon,lat" } else { ",x,y" })?;
    let mut number = 0;
    for feature in features {
        let known: String =
            feature.properties.iter().map(|(_, value)| format!(",{value:?}")).collect();
        for line in feature.geometry.lines() {
            number += 1;
            for [x, y] in line {
                writeln!(file, "{number}{known},{x:?},{y:?}")?;
            }
        }
    }
    Ok(())
}

/// One feature a line, so that files can be looked at and compared.
fn collection(
    file: &mut impl Write,
    features: &[Feature],
    system: FeatureSystem,
) -> io::Result<()> {
    let crs = match system {
        FeatureSystem::Geographic => String::new(),
        FeatureSystem::Projected(number) => {
            let name = format!("urn:ogc:def:crs:EPSG::{number}");
            let crs = json!({ "type": "name", "properties": { "name": name } });
            format!("\"crs\": {crs}, ")
        }
        FeatureSystem::Local => "\"crs\": null, ".to_owned(),
    };
    writeln!(file, "{{\"type\": \"FeatureCollection\", {crs}\"features\": [")?;
    for (index, feature) in features.iter().enumerate() {
        let comma = if index + 1 < features.len() { "," } else { "" };
        writeln!(file, "{}{comma}", object(feature))?;
    }
    writeln!(file, "]}}")
}

fn object(feature: &Feature) -> Value {
    let named = feature.properties.iter().map(|&(name, value)| (name.to_owned(), json!(value)));
    let (kind, coordinates) = match &feature.geometry {
        Geometry::Line(points) => ("LineString", json!(points)),
        Geometry::Areas(areas) => ("MultiPolygon", json!(areas)),
    };
    json!({
        "type": "Feature",
        "properties": named.collect::<Map<_, _>>(),
        "geometry": { "type": kind, "coordinates": coordinates },
    })
}

impl Geometry {
    /// The line, or the rings.
    fn lines(&self) -> Vec<&Points> {
        match self {
            Self::Line(points) => vec![points],
            Self::Areas(areas) => areas.iter().flatten().collect(),
        }
    }
}
