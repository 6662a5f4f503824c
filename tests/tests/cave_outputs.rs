//! What a growing cave leaves: events, maps, clouds, close views.

use std::fs;

use landform::view::Image;
use landform::view::mark::Mark;
use landform_tests::{Program, Scratch};
use serde_json::Value;

/// Three sources above a sink, with a stage of protochannels before.
const CAVE: &str = r#"(
    title: "Cave",
    seed: 2,
    domain: Volume(size: (30, 24, 12), spacing_m: 2.0),
    initial: [(field: "porosity", from: Uniform(value: 0.2))],
    stages: [
        (
            name: "first, fine",
            processes: [Protochannels(sources: [(center: (0.1, 0.2, 1.0)), (center: (0.5, 0.8, 1.0))], protosinks: 12)],
            stop: Iterations(1),
        ),
        (
            name: "grown",
            processes: [CaveGrowth(
                sources: [(center: (0.1, 0.2, 1.0)), (center: (0.5, 0.8, 1.0)), (center: (0.6, 0.3, 1.0))],
                sinks: [(center: (1.0, 0.5, 0.1))],
            )],
            stop: Iterations(90),
        ),
    ],
    metrics: [CaveCourses()],
    measure_every: 30,
    outputs: [
        CaveEventTable(file: "events.csv"),
        Picture(file: "map.png", field: "porosity", look: CaveMap(at_least: 0.35, views: [Plan, FromEast], width: 300)),
        Picture(file: "zones.png", field: "protochannels", look: Passages(
            at_least: 1.0, tube_radius_m: 0.5, colour_by: "pressure_zone", size: (160, 120),
        )),
        Picture(file: "close.png", field: "porosity", look: Passages(
            at_least: 0.35, focus: (0.9, 0.5, 0.1), zoom: 4.0, size: (160, 120),
        )),
        Picture(file: "cloud.png", field: "pressure", look: Cloud(size: (480, 360))),
        Picture(file: "slice.png", field: "pressure", look: Slice(at: 1.0)),
        Figure(file: "growth.png", panels: [
            (at: "grown", after: 40, field: "porosity", look: Slice(pixels_per_node: 4, bar: false, range: (0.0, 1.0))),
            (at: "grown", after: 4000, field: "porosity", look: Slice(pixels_per_node: 4, bar: false, range: (0.0, 1.0))),
            (at: "grown", field: "porosity", look: Slice(pixels_per_node: 4, bar: false, range: (0.0, 1.0))),
        ]),
        Picture(file: "at_40.png", field: "porosity", look: Slice(pixels_per_node: 4, bar: false, range: (0.0, 1.0)), when: Every(41)),
        Picture(file: "end.png", field: "porosity", look: Slice(pixels_per_node: 4, bar: false, range: (0.0, 1.0))),
    ],
)"#;

fn run(scenario: &str) -> Scratch {
    let scratch = Scratch::new("cave_outputs");
    scratch.write("cave.ron", scenario);
    Program::within(scratch.folder()).line("run cave.ron -o o --quiet").run().good();
    scratch
}

fn picture(scratch: &Scratch, file: &str) -> Image {
    Image::read_png(&scratch.path("o").join(file)).expect("a picture").0
}

/// Pixels of a mark's colour.
fn marked(image: &Image, mark: Mark) -> usize {
    image.rgb.iter().filter(|&&pixel| pixel == mark.colour()).count()
}

#[test]
fn events_are_a_table_and_as_many_as_the_metric_counts() {
    let scratch = run(CAVE);
    let table = fs::read_to_string(scratch.path("o/events.csv")).expect("a table");
    let mut lines = table.lines();
    let head = "stage,iteration,event,source,other,x,y,z,rise_m,length_m";
    assert_eq!(lines.next(), Some(head));
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let report = fs::read_to_string(scratch.path("o/report.json")).expect("a report");
    let report: Value = serde_json::from_str(&report).expect("JSON");
    for (kind, metric) in
        [("link", "links"), ("breakthrough", "breakthroughs"), ("capture", "captures")]
    {
        let count = rows.iter().filter(|row| row[2] == kind).count();
        assert_eq!(report["metrics"][metric], count as f64, "{table}");
    }
    // All three drain in the end, and each of them once.
    let drained = rows.iter().filter(|row| ["breakthrough", "capture"].contains(&row[2]));
    let mut sources: Vec<&str> = drained.map(|row| row[3]).collect();
    sources.sort_unstable();
    assert_eq!(sources, ["1", "2", "3"], "{table}");
    let mut before = 0;
    for row in &rows {
        assert_eq!((row.len(), row[0]), (10, "grown"));
        let iteration: u64 = row[1].parse().expect("an iteration");
        assert!((before..=90).contains(&iteration), "{table}");
        before = iteration;
        let at: Vec<f64> = row[5..8].iter().map(|at| at.parse().expect("a place")).collect();
        assert!(at[0] <= 58.0 && at[1] <= 46.0 && at[2] <= 22.0, "{row:?}");
        assert_eq!(row[4].is_empty(), ["breakthrough", "phreatic_loop"].contains(&row[2]));
        let rise_m: f64 = row[8].parse().expect("a rise");
        assert!(rise_m >= if row[2] == "phreatic_loop" { 2.0 } else { 0.0 }, "{row:?}");
        let length_m: f64 = row[9].parse().expect("a length");
        assert_eq!(length_m > 0.0, row[2] != "link", "{row:?}");
    }
}

#[test]
fn pictures_of_caves_show_where_water_comes_in_and_goes_out() {
    let scratch = run(CAVE);
    for file in ["map.png", "cloud.png"] {
        let image = picture(&scratch, file);
        for mark in [Mark::Source, Mark::Sink] {
            assert!(marked(&image, mark) > 30, "{file}: {mark:?}");
        }
    }
    // The top layer has the sources; the sink is below.
    let slice = picture(&scratch, "slice.png");
    assert!(marked(&slice, Mark::Source) > 60 && marked(&slice, Mark::Sink) == 0);
    let bare = CAVE.replace("Slice(at: 1.0)", "Slice(at: 1.0, marks: false)");
    let bare = bare.replace("Cloud(", "Cloud(marks: false, ");
    let bare = run(&bare.replace("width: 300", "width: 300, marks: false"));
    for file in ["map.png", "cloud.png", "slice.png"] {
        let image = picture(&bare, file);
        assert_eq!([Mark::Source, Mark::Sink].map(|mark| marked(&image, mark)), [0, 0], "{file}");
    }
}

/// How often a picture stands in another one.
fn count(part: &Image, whole: &Image) -> usize {
    let stands_at = |left: usize, top: usize| {
        (0..part.height).all(|row| {
            let from = left + whole.width * (top + row);
            let line = part.width * row..part.width * (row + 1);
            whole.rgb[from..from + part.width] == part.rgb[line]
        })
    };
    let places = (0..=whole.height - part.height)
        .flat_map(|top| (0..=whole.width - part.width).map(move |left| (left, top)));
    places.filter(|&(left, top)| stands_at(left, top)).count()
}

#[test]
fn panels_show_a_stage_on_its_way_and_no_later_than_its_end() {
    let scratch = run(CAVE);
    let figure = picture(&scratch, "growth.png");
    // The pictures count the iteration of the first stage too.
    assert_eq!(count(&picture(&scratch, "at_40_000041.png"), &figure), 1);
    assert_eq!(count(&picture(&scratch, "at_40_000082.png"), &figure), 0);
    assert_eq!(count(&picture(&scratch, "end.png"), &figure), 2);
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let scratch = Scratch::new("cave_outputs_refused");
    for (from, to, message) in [
        ("colour_by: \"pressure_zone\"", "colour_by: \"pressure_zones\"", "pressure_zone"),
        ("views: [Plan, FromEast]", "views: []", "views"),
        ("width: 300", "width: 10", "width"),
        ("after: 40,", "after: 0,", "after"),
        ("at: \"grown\", after: 40", "at: \"initial\", after: 40", "after"),
        ("events.csv", "events.json", ".csv"),
        ("focus: (0.9,", "focus: (1e11,", "focus"),
        ("Cloud(", "Cloud(colours: \"blues\", ", "blues"),
    ] {
        scratch.write("cave.ron", CAVE.replacen(from, to, 1));
        let said = Program::within(scratch.folder()).line("check cave.ron").run().refused();
        assert!(said.contains(message), "{to}: {said}");
    }
}
