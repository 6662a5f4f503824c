//! Shorelines, rasters and maps of regions as the beginning of coasts, and coasts as lines and as
//! graphs.

use std::fs;

use landform::io::{LineCoordinates, ReadLimits, read_lines, read_raster};
use landform_tests::{Program, Scratch, repository, write_shore};
use serde_json::Value;

/// A shore in degrees whose sea takes nothing.
const STILL: &str = r#"(
    title: "Shore",
    seed: 2,
    domain: Shoreline(path: "shore.csv", nodes: 120, margin: 0.05, connectivity: Four),
    initial: [
        (field: "land", from: DomainRaster()),
        (field: "resistance", from: Uniform(value: 1.0)),
    ],
    stages: [
        (
            name: "still",
            processes: [CoastErosion(force: 0.001)],
            stop: Iterations(1),
        ),
    ],
    outputs: [
        LevelLines(file: "coast.geojson", field: "land", levels: [0.5]),
        LevelLines(file: "coast.csv", field: "land", levels: [0.5]),
        FieldFile(file: "land.tif", field: "land"),
    ],
)"#;

/// A ragged ring round 65 N, 18 W, and a triangle beside it.
fn shore_in_degrees() -> String {
    let mut text = "line,lon,lat\n".to_owned();
    for step in 0..90 {
        let angle = f64::from(step) * std::f64::consts::TAU / 90.0;
        let reach = 1.0 + 0.3 * (4.0 * angle).sin();
        let (lon, lat) = (-18.0 + 2.4 * reach * angle.cos(), 65.0 + reach * angle.sin());
        text += &format!("island,{lon:?},{lat:?}\n");
    }
    text + "skerry,-14,64\nskerry,-13.4,64\nskerry,-13.7,64.4\n"
}

fn distance(point: [f64; 2], [from, to]: [[f64; 2]; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let dot = (point[0] - from[0]) * along[0] + (point[1] - from[1]) * along[1];
    let share = if square > 0.0 { (dot / square).clamp(0.0, 1.0) } else { 0.0 };
    (point[0] - from[0] - share * along[0]).hypot(point[1] - from[1] - share * along[1])
}

/// Largest distance of the points of some lines from others, in metres.
fn farthest(points: &[Vec<[f64; 2]>], lines: &[Vec<[f64; 2]>]) -> f64 {
    let edges = |line: &Vec<[f64; 2]>| -> Vec<[[f64; 2]; 2]> {
        line.iter().zip(line.iter().cycle().skip(1)).map(|(&from, &to)| [from, to]).collect()
    };
    let edges: Vec<_> = lines.iter().flat_map(edges).collect();
    let nearest = |point: &[f64; 2]| {
        edges.iter().map(|edge| distance(*point, *edge)).fold(f64::INFINITY, f64::min)
    };
    points.iter().flatten().map(nearest).fold(0.0, f64::max)
}

#[test]
fn a_shore_in_degrees_comes_back_in_degrees() {
    let scratch = Scratch::new("shore");
    scratch.write("shore.csv", shore_in_degrees());
    scratch.write("still.ron", STILL);
    Program::within(scratch.folder()).line("run still.ron -o o --quiet").run().good();
    let limits = ReadLimits::default();
    // Metres on a plane at 65 N, by the series for the lengths of degrees.
    let metres = |file: &str| -> Vec<Vec<[f64; 2]>> {
        let file = read_lines(scratch.path(file), &limits).expect("lines");
        assert_eq!(file.coordinates, LineCoordinates::Geographic);
        let plane = |&[lon, lat]: &[f64; 2]| [lon * 47_176.8, lat * 111_491.5];
        file.lines.iter().map(|line| line.iter().map(plane).collect()).collect()
    };
    let given = metres("shore.csv");
    let report = fs::read_to_string(scratch.path("o/report.json")).expect("a report");
    let report: Value = serde_json::from_str(&report).expect("JSON");
    let spacing = report["spacing_m"].as_f64().expect("a spacing");
    for file in ["o/coast.geojson", "o/coast.csv"] {
        let found = metres(file);
        assert_eq!(found.len(), 2, "an island and a skerry");
        assert!(farthest(&found, &given) < 0.8 * spacing, "{file}: shore where none was");
        assert!(farthest(&given, &found) < 1.2 * spacing, "{file}: a shore is missing");
    }
    assert_eq!(metres("o/coast.geojson"), metres("o/coast.csv"));
    let land = read_raster(scratch.path("o/land.tif")).expect("a raster");
    let place = land.georeference.expect("a place");
    assert_eq!(place.coordinate_system.epsg, Some(4326));
    let [along, across] = place.ground_cell_size_m([land.width, land.height]);
    assert!(
        (along - spacing).abs() < 0.002 * spacing && (across - spacing).abs() < 0.002 * spacing
    );
}

#[test]
fn a_shore_in_metres_stays_in_metres() {
    let scratch = Scratch::new("shore");
    write_shore(&scratch.path("shore.csv"));
    scratch.write("still.ron", STILL);
    Program::within(scratch.folder()).line("run still.ron -o o --quiet").run().good();
    let limits = ReadLimits::default();
    let read = |file: &str| read_lines(scratch.path(file), &limits).expect("lines");
    let (given, found) = (read("shore.csv"), read("o/coast.geojson"));
    assert_eq!(found.coordinates, LineCoordinates::Planar);
    assert!(farthest(&found.lines, &given.lines) < 25.0);
    assert!(farthest(&given.lines, &found.lines) < 25.0);
    let text = fs::read_to_string(scratch.path("o/coast.geojson")).expect("text");
    let json: Value = serde_json::from_str(&text).expect("JSON");
    assert!(json["crs"].is_null() && json.get("crs").is_some());
    assert_eq!(json["features"][0]["properties"]["level"], 0.5);
}

#[test]
fn unusable_shorelines_are_refused_with_a_reason() {
    for (shore, part) in [
        ("lon,lat\n-179,60\n179,60\n179,61\n", "180 degrees east to west"),
        ("lon,lat\n1,88\n2,88\n2,89\n", "85 degrees of latitude"),
        ("x,y\n1,1\n1,1\n1,1\n", "lines that span an area"),
        ("x,y\n1,1\n5,1\n9,1\n", "no land meets the sea"),
        ("a,b\n1,2\n", "columns lon and lat"),
    ] {
        let scratch = Scratch::new("shore");
        scratch.write("shore.csv", shore);
        scratch.write("still.ron", STILL);
        let ended = Program::within(scratch.folder()).line("run still.ron -o o --quiet").run();
        assert!(ended.status == Some(1) || ended.status == Some(2), "{shore}: {ended:?}");
        assert!(ended.stderr.contains(part), "{shore}: {}", ended.stderr);
    }
}

/// Elevations of which the eastern half is above 10.
const RASTER: &str = "ncols 40\nnrows 30\nxllcorner 0\nyllcorner 0\ncellsize 20\n";

#[test]
fn level_sets_and_maps_of_regions_start_a_coast() {
    let scratch = Scratch::new("shore");
    let row = |value: &dyn Fn(usize) -> usize| -> String {
        (0..40).map(|column| format!("{} ", value(column))).collect::<String>() + "\n"
    };
    scratch.write("ground.asc", RASTER.to_owned() + &row(&|column| column / 2).repeat(30));
    // Region 1 in the northern third.
    let north = row(&|_| 1).repeat(10) + &row(&|_| 0).repeat(20);
    scratch.write("regions.asc", RASTER.to_owned() + &north);
    scratch.write(
        "ground.ron",
        r#"(
        title: "Half a map",
        seed: 2,
        domain: Raster(path: "ground.asc", connectivity: Four),
        initial: [
            (field: "land", from: LandAbove(level: 10.0)),
            (field: "resistance", from: Uniform(value: 0.5)),
            (field: "coast_region", from: RasterFile(path: "regions.asc")),
        ],
        stages: [(
            name: "eroded",
            processes: [CoastErosion(
                force: 0.0, attenuation: 0.0,
                regions: [(place: Numbered(1), force: 0.45)],
            )],
            stop: Iterations(3),
        )],
        outputs: [FieldFile(file: "land.asc", field: "land")],
    )"#,
    );
    Program::within(scratch.folder()).line("run ground.ron -o o --quiet").run().good();
    let land = read_raster(scratch.path("o/land.asc")).expect("land").values;
    // A straight coast of strength 0.5 (1 - 1/4) falls by a column an iteration, where it may.
    let first_land = |row: usize| land[40 * row..][..40].iter().position(|&land| land > 0.0);
    assert_eq!([0, 5, 9].map(first_land), [Some(25); 3]);
    assert_eq!([11, 20, 29].map(first_land), [Some(22); 3]);
}

/// Figure 4.9: one node falls, and what lies inland of it becomes coast.
#[test]
fn one_event_moves_the_agents_around_it() {
    let scratch = Scratch::new("event");
    let scenario = repository().join("scenarios/thesis/fig_4_9.ron");
    let run = Program::within(scratch.folder()).args(["run", "-o", "o", "--quiet"]);
    run.args([scenario]).run().good();
    let nodes = |file: &str| -> Vec<[usize; 2]> {
        let table = fs::read_to_string(scratch.path("o").join(file)).expect("a table");
        let number = |row: &str, at: usize| row.split(',').nth(at).expect("a cell").parse();
        let place = |row: &str| [1, 2].map(|at| number(row, at).expect("a number"));
        table.lines().skip(1).map(place).collect()
    };
    assert_eq!(nodes("eroded.csv"), [[4, 2]]);
    let coast = nodes("coast.csv");
    for joined in [[3, 1], [4, 1], [5, 1], [3, 2]] {
        assert!(coast.contains(&joined), "{joined:?} of {coast:?}");
    }
    assert_eq!(coast.len(), 13);
}

#[test]
fn maps_of_too_many_agents_are_refused() {
    let scratch = Scratch::new("event");
    scratch.write("shore.csv", shore_in_degrees());
    let map = "AgentMap(groups: [(group: \"coast\")], pixels_per_node: 400.0)";
    scratch.write("map.ron", STILL.replace("outputs: [", &format!("outputs: [{map},")));
    let ended = Program::within(scratch.folder()).line("check map.ron").run();
    assert_eq!(ended.status, Some(2), "{ended:?}");
    assert!(ended.stderr.contains("choose fewer pixels a node"), "{}", ended.stderr);
}
