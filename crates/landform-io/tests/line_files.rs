//! Line files: what is read, and what is refused with which words.

mod support;

use std::fs;

use landform_io::{LineCoordinates, LineFile, ReadLimits, read_lines};
use support::Scratch;

fn read(name: &str, text: &str) -> Result<LineFile, String> {
    let folder = Scratch::new("lines");
    let path = folder.path(name);
    fs::write(&path, text).unwrap();
    let result = read_lines(&path, &ReadLimits { max_cells: 1000 });
    assert_eq!(folder.file_count(), 1, "reading leaves nothing beside");
    result.map_err(|error| error.to_string())
}

#[test]
fn csv_in_degrees_or_metres_with_lines_or_without() {
    let coast = read("a.csv", "lon,lat\n1.5,50\n-2,51.25\r\n\n3,-4e1\n").unwrap();
    assert_eq!(coast.coordinates, LineCoordinates::Geographic);
    assert_eq!(coast.lines, [vec![[1.5, 50.0], [-2.0, 51.25], [3.0, -40.0]]]);
    let text =
        "\u{feff}name, \"Y\" ,line,X\na,1,p,2\nb,3,p,4\nc,5,q,6\nd,7,q,8\ne,9,p,0\nf,1,p,1\n";
    let plane = read("a.CSV", text).unwrap();
    assert_eq!(plane.coordinates, LineCoordinates::Planar);
    assert_eq!(
        plane.lines,
        [vec![[2.0, 1.0], [4.0, 3.0]], vec![[6.0, 5.0], [8.0, 7.0]], vec![[0.0, 9.0], [1.0, 1.0]]]
    );
    assert_eq!(plane.point_count(), 6);
}

#[test]
fn geojson_lines_and_rings_are_found() {
    let text = r#"{"type": "FeatureCollection", "features": [
        {"type": "Feature", "geometry": null},
        {"type": "Feature", "geometry": {"type": "Point", "coordinates": [0, 0]}},
        {"type": "Feature", "geometry": {"type": "GeometryCollection", "geometries": [
            {"type": "LineString", "coordinates": [[0, 1], [2, 3, 99]]},
            {"type": "MultiLineString", "coordinates": [[[4, 5], [6, 7]], [[8, 9], [10, 11]]]}]}},
        {"type": "Feature", "geometry":
            {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [0, 1], [0, 0]]]}},
        {"type": "Feature", "geometry":
            {"type": "MultiPolygon", "coordinates": [[[[5, 5], [6, 5], [5, 6], [5, 5]]]]}}]}"#;
    let file = read("a.geojson", text).unwrap();
    assert_eq!(file.coordinates, LineCoordinates::Geographic);
    assert_eq!(file.lines.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2, 2, 4, 4]);
    assert_eq!(file.lines[0], [[0.0, 1.0], [2.0, 3.0]]);
    assert_eq!(file.lines[4][2], [5.0, 6.0]);
    let named = r#"{"crs": {"properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}},
        "type": "LineString", "coordinates": [[0, 1], [2, 3]]}"#;
    assert_eq!(read("a.json", named).unwrap().lines.len(), 1);
}

#[test]
fn bad_files_are_refused_with_place_and_advice() {
    for (name, text, parts) in [
        ("a.txt", "lon,lat\n", ["extension .txt", ".csv, .geojson"]),
        ("a.csv", "", ["the file is empty", "lon,lat"]),
        ("a.csv", "a,b\n1,2\n", ["line 1: the heading", "x and y"]),
        ("a.csv", "lon,lat\n", ["no line", "at least one"]),
        ("a.csv", "lon,lat\n1,2\n", ["single point", "remove"]),
        ("a.csv", "lon,lat\n1,2\n\n3\n", ["line 4: the row has 1 columns", "complete"]),
        ("a.csv", "lon,lat\n1,2\n1,north\n", ["line 3: \"north\" is not a number", "point"]),
        ("a.csv", "x,y\n1,2\n1,nan\n", ["line 3: the point is 1, NaN", "correct"]),
        ("a.csv", "lon,lat\n1,2\n1,93\n", ["line 3: longitude 1, latitude 93", "columns x and y"]),
        ("a.json", "{\n[", ["line 2: this is no JSON", "correct"]),
        ("a.json", "[]", ["an object of type \"\"", "RFC 7946"]),
        ("a.json", r#"{"type": "FeatureCollection"}"#, ["without features", "save"]),
        ("a.json", r#"{"type": "Point", "coordinates": [1, 2]}"#, ["no line", "check"]),
        ("a.json", r#"{"type": "LineString"}"#, ["no list", "correct"]),
        (
            "a.json",
            r#"{"type": "LineString", "coordinates": [[1, 2], [3]]}"#,
            ["line number 1", "[3] is no point"],
        ),
        (
            "a.json",
            r#"{"crs": {"properties": {"name": "EPSG:28992"}}, "type": "LineString"}"#,
            ["EPSG:28992", "convert"],
        ),
    ] {
        let message = read(name, text).unwrap_err();
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    }
    let long = format!("x,y\n{}", "1,2\n".repeat(1001));
    assert!(read("a.csv", &long).unwrap_err().contains("limit of 1000"));
    let deep = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(read("a.json", &deep).unwrap_err().contains("no JSON"));
    let folder = Scratch::new("lines_bytes");
    fs::write(folder.path("a.csv"), [b'x', b',', 0xff, b'\n']).unwrap();
    let error = read_lines(folder.path("a.csv"), &ReadLimits::default()).unwrap_err().to_string();
    assert!(error.contains("byte 2: this is not UTF-8"), "{error}");
    assert!(read_lines(folder.path("none.csv"), &ReadLimits::default()).is_err());
    assert!(read_lines(folder.path("."), &ReadLimits::default()).is_err());
}
