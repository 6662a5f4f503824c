//! `landform analyze` of lines: known curves, real coasts, and what is refused.

use std::f64::consts::TAU;
use std::fmt::Write;
use std::path::PathBuf;

use landform_tests::{Ended, Program, Scratch, repository};
use serde_json::Value;

fn call(scratch: &Scratch, line: &str) -> Ended {
    Program::within(scratch.folder()).line("analyze").line(line).run()
}

fn object(scratch: &Scratch, line: &str) -> Value {
    serde_json::from_str(&call(scratch, &format!("{line} --json")).good()).expect("JSON")
}

#[track_caller]
fn near(found: &Value, expected: f64, within: f64) {
    let value = found.as_f64().unwrap_or_else(|| panic!("{found} is no number"));
    assert!((value - expected).abs() <= within, "{value} is not {expected} +- {within}");
}

/// A circle of a radius in metres as CSV.
fn circle(radius: f64, points: usize) -> String {
    let mut text = "x,y\n".to_owned();
    for index in 0..=points {
        let angle = TAU * (index % points) as f64 / points as f64;
        writeln!(text, "{},{}", radius * angle.cos(), radius * angle.sin()).unwrap();
    }
    text
}

#[test]
fn a_circle_has_its_length_and_dimension_one() {
    let scratch = Scratch::new("circle");
    scratch.write("circle.csv", circle(10_000.0, 4000));
    let found = object(&scratch, "circle.csv");
    near(&found["length_m"], TAU * 10_000.0, 1.0);
    near(&found["divider"]["dimension"], 1.0, 0.01);
    near(&found["box"]["dimension"], 1.0, 0.03);
    assert_eq!(
        (&found["lines"], &found["closed"], &found["points"]),
        (&1.into(), &1.into(), &4001.into())
    );
    assert_eq!((&found["kind"], &found["geographic"]), (&"lines".into(), &false.into()));
    let asked = object(&scratch, "circle.csv --rulers 200m..2km");
    for method in ["divider", "box"] {
        near(&asked[method]["range_m"][0], 200.0, 1e-6);
        near(&asked[method]["range_m"][1], 2000.0, 1e-6);
        assert_eq!(asked[method]["scales"].as_array().map(Vec::len), Some(25));
    }
    let table = call(&scratch, "circle.csv").good();
    assert!(table.starts_with("circle.csv: a closed line of 4001 points in metres\n"), "{table}");
    assert!(table.contains("\n  length       62.83 km\n"), "{table}");
}

/// Koch's curve as GeoJSON in a few degrees near the equator: D = ln 4 / ln 3.
#[test]
fn kochs_curve_on_the_globe_has_its_dimension_and_a_figure() {
    let mut points = vec![[0.0, 0.0], [1.0, 0.0]];
    for _ in 0..7 {
        let mut finer = vec![points[0]];
        for pair in points.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            let [dx, dy] = [(b[0] - a[0]) / 3.0, (b[1] - a[1]) / 3.0];
            let (half, high) = (0.5, 0.75_f64.sqrt());
            let tip = [a[0] + dx + half * dx - high * dy, a[1] + dy + high * dx + half * dy];
            finer.extend([[a[0] + dx, a[1] + dy], tip, [a[0] + 2.0 * dx, a[1] + 2.0 * dy], b]);
        }
        points = finer;
    }
    let scratch = Scratch::new("koch");
    let geometry = serde_json::json!({ "type": "LineString", "coordinates": points });
    scratch.write("koch.geojson", geometry.to_string());
    let found = object(&scratch, "koch.geojson --rulers 153m..4118m -o out");
    let dimension = 4.0_f64.ln() / 3.0_f64.ln();
    near(&found["divider"]["dimension"], dimension, 0.03);
    near(&found["box"]["dimension"], dimension, 0.03);
    let length = (4.0_f64 / 3.0).powi(7) * 6_371_008.8_f64.to_radians();
    near(&found["length_m"], length, 1e-3 * length);
    let svg = std::fs::read_to_string(scratch.path("out/koch.svg")).unwrap();
    for words in ["ruler (km)", "length (km)", "number of boxes", "slope \u{2212}0.", "D = 1.2"] {
        assert!(svg.contains(words), "{words}");
    }
}

/// Points, length in metres, dimension by dividers and by boxes, rulers of 2 to 100 km.
///
/// Computed without Landform, by Python with NumPy 2.4: walks over chords searched point by point;
/// boxes entered by points that stand closer than a sixtieth of a box along the line, which miss
/// boxes that are only touched at a corner.
const COASTS: [(&str, u64, f64, f64, f64); 4] = [
    ("ireland.csv", 27864, 5_619_347.204, 1.307010, 1.308157),
    ("iceland.csv", 39220, 6_657_627.727, 1.319314, 1.310817),
    ("great_britain_east.csv", 14700, 3_036_215.962, 1.196545, 1.173825),
    ("australia_mainland.csv", 27578, 36_740_759.434, 1.179391, 1.171835),
];

#[test]
fn real_coasts_have_the_dimensions_that_others_compute() {
    let beside = || repository().parent().map(|parent| parent.join("shared/data"));
    let data = std::env::var_os("LANDFORM_DATA").map(PathBuf::from).or_else(beside);
    let Some(folder) = data.map(|data| data.join("coast")).filter(|folder| folder.is_dir()) else {
        println!("SKIPPED: no shores; set LANDFORM_DATA to the data");
        return;
    };
    let scratch = Scratch::new("coasts");
    for (name, points, length, divider, boxes) in COASTS {
        let program = Program::within(scratch.folder()).args(["analyze", "--json"]);
        let program = program.args([folder.join(name)]).args(["--rulers", "2km..100km"]);
        let found: Value = serde_json::from_str(&program.run().good()).expect("JSON");
        assert_eq!(found["points"], points);
        near(&found["length_m"], length, 0.01);
        near(&found["divider"]["dimension"], divider, 1e-5);
        near(&found["box"]["dimension"], boxes, 1e-3);
    }
}

#[test]
fn lines_that_are_too_coarse_are_measured_as_far_as_they_go() {
    let scratch = Scratch::new("coarse");
    scratch.write("two.csv", "x,y,line\n0,0,a\n3,4,a\n10,0,b\n10,9,b\n");
    let found = object(&scratch, "two.csv");
    near(&found["length_m"], 14.0, 1e-12);
    assert!(found["divider"].is_null() && found["box"].is_null());
    assert!(found["notes"][0].as_str().is_some_and(|note| note.contains("give a range of scales")));
    let folder = call(&scratch, "two.csv -o out");
    assert!(folder.good().contains("2 lines, 0 of them closed, of 4 points"));
    assert!(
        std::fs::read_to_string(scratch.path("out/two.svg")).unwrap().contains("see the notes")
    );
}

#[test]
fn wrong_lines_and_rulers_are_refused() {
    let scratch = Scratch::new("wrong_lines");
    scratch.write("circle.csv", circle(1000.0, 100));
    scratch.write("point.csv", "lon,lat\n3,50\n");
    scratch.write("columns.csv", "a,b\n3,50\n");
    scratch.write("off.csv", "lon,lat\n3,50\n4,95\n");
    scratch.write("broken.geojson", "{");
    for (line, parts) in [
        ("circle.csv --rulers 2km", &["2km..100km", "--rulers"][..]),
        ("circle.csv --rulers 5km..2km", &["the second larger"]),
        ("circle.csv --rulers 100m..50km", &["circle.csv: scales up to 50000 m are larger"]),
        ("circle.csv --rulers 0.0001m..1km", &["circle.csv: scales from", "too fine"]),
        ("point.csv", &["point.csv", "single point"]),
        ("columns.csv", &["columns.csv", "lon"]),
        ("off.csv", &["off.csv", "line 3", "no place on the globe"]),
        ("broken.geojson", &["broken.geojson"]),
        ("circle.csv --memory-limit-gib 0.00001", &["circle.csv", "--memory-limit-gib", "GiB"]),
        ("circle.csv --memory-limit-gib 0", &["--memory-limit-gib is 0"]),
        ("circle.txt", &["circle.txt"]),
        ("", &["<FILES>"]),
    ] {
        let message = call(&scratch, line).refused();
        for part in parts {
            assert!(message.contains(part), "{line}: no `{part}` in\n{message}");
        }
    }
}
