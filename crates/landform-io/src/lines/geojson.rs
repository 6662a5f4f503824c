//! Lines in GeoJSON (RFC 7946).

use serde_json::Value;

use super::{LineCoordinates, LineFile, check_point};
use crate::{Fault, Place};

/// Reads all lines, and rings of polygons, wherever they stand.
pub(super) fn parse(text: &str) -> Result<LineFile, Fault> {
    let value: Value = serde_json::from_str(text).map_err(|error| {
        let expected = "GeoJSON in UTF-8";
        let place = Place::Line(error.line() as u64);
        Fault::new(format!("this is no JSON ({error})"), expected, "correct the text").at(place)
    })?;
    let coordinates = coordinates(&value)?;
    let mut lines = Vec::new();
    collect(&value, &mut lines)?;
    for (index, line) in lines.iter().enumerate() {
        let known = line.iter().try_for_each(|&at| check_point(at, coordinates).map(|_| ()));
        known.map_err(|fault| of_line(index + 1, fault))?;
    }
    Ok(LineFile { coordinates, lines })
}

/// A fault in a line of the file.
fn of_line(number: usize, fault: Fault) -> Fault {
    Fault { problem: format!("line number {number} of the file: {}", fault.problem), ..fault }
}

/// GeoJSON of 2008 may say that its numbers are no places on Earth (null), which are taken as
/// metres, or name another coordinate system, of which nothing is known here.
fn coordinates(value: &Value) -> Result<LineCoordinates, Fault> {
    if value.get("crs").is_some_and(Value::is_null) {
        return Ok(LineCoordinates::Planar);
    }
    let Some(name) = value.pointer("/crs/properties/name").and_then(Value::as_str) else {
        return Ok(LineCoordinates::Geographic);
    };
    if name.ends_with("CRS84") || name.ends_with(":4326") {
        return Ok(LineCoordinates::Geographic);
    }
    let problem = format!("its coordinate system is {name:?}");
    let expected = "longitude and latitude (WGS 84), as RFC 7946 demands";
    let advice = "convert it, or save it as CSV with columns x and y in metres";
    Err(Fault::new(problem, expected, advice))
}

/// Adds the lines of an object; depth is bounded by the parser.
fn collect(object: &Value, lines: &mut Vec<Vec<[f64; 2]>>) -> Result<(), Fault> {
    let kind = object.get("type").and_then(Value::as_str).unwrap_or_default();
    let coordinates = object.get("coordinates").unwrap_or(&Value::Null);
    match kind {
        "FeatureCollection" => each(object, "features", |feature| collect(feature, lines)),
        "GeometryCollection" => each(object, "geometries", |part| collect(part, lines)),
        // A feature without a place has a null for a geometry.
        "Feature" => match object.get("geometry") {
            None | Some(Value::Null) => Ok(()),
            Some(geometry) => collect(geometry, lines),
        },
        "LineString" => nested(coordinates, 0, lines),
        "MultiLineString" | "Polygon" => nested(coordinates, 1, lines),
        "MultiPolygon" => nested(coordinates, 2, lines),
        "Point" | "MultiPoint" => Ok(()),
        other => {
            let problem = format!("an object of type {other:?}");
            let expected = "a FeatureCollection, Feature or geometry of RFC 7946";
            Err(Fault::new(problem, expected, "save it as GeoJSON"))
        }
    }
}

fn each(
    object: &Value,
    name: &str,
    visit: impl FnMut(&Value) -> Result<(), Fault>,
) -> Result<(), Fault> {
    let Some(list) = object.get(name).and_then(Value::as_array) else {
        let problem = format!("a collection without {name}");
        return Err(Fault::new(problem, format!("a list named {name}"), "save it as GeoJSON"));
    };
    list.iter().try_for_each(visit)
}

/// Adds the lines in lists of lists, `depth` deep.
fn nested(list: &Value, depth: usize, lines: &mut Vec<Vec<[f64; 2]>>) -> Result<(), Fault> {
    let Some(items) = list.as_array() else {
        let problem = format!("in geometry after line number {}: no list", lines.len());
        return Err(Fault::new(problem, "lists of [longitude, latitude]", "correct the geometry"));
    };
    if depth > 0 {
        return items.iter().try_for_each(|item| nested(item, depth - 1, lines));
    }
    let points = items.iter().map(point).collect::<Result<_, _>>();
    lines.push(points.map_err(|fault| of_line(lines.len() + 1, fault))?);
    Ok(())
}

fn point(item: &Value) -> Result<[f64; 2], Fault> {
    let number = |axis: usize| item.get(axis).and_then(Value::as_f64);
    match [number(0), number(1)] {
        [Some(x), Some(y)] => Ok([x, y]),
        _ => {
            let shown: String = item.to_string().chars().take(40).collect();
            let problem = format!("{shown} is no point");
            Err(Fault::new(problem, "[longitude, latitude]", "correct or remove it"))
        }
    }
}
