//! Coasts from the scenario to the files.

use std::fs;

use landform::io::{LineCoordinates, ReadLimits, read_lines};
use landform_tests::{Program, Run, Scratch};

/// A square that erodes until it rests, and loses its small islands.
const COAST: &str = r#"(
    title: "Small coast",
    seed: 2,
    domain: Grid(size: (96, 80), spacing_m: 10.0, connectivity: Four),
    initial: [
        (field: "land", from: StartingLand(margin: 0.1)),
        (field: "resistance", from: WhiteNoise(mean_m: 0.5, amplitude_m: 0.5)),
    ],
    stages: [
        (
            name: "eroded",
            processes: [CoastErosion(perimeter: Near(radius_m: 150.0), force: 0.5, attenuation: 0.2)],
            stop: Below(metric: "coast_events", value: 0.5),
        ),
        (name: "pruned", processes: [IslandPruning(least_shore_m: 240.0)]),
    ],
    metrics: [
        CoastActivity(),
        Islands(),
        AgentCount(group: "coast"),
        AgentCount(group: "eroded"),
        AgentStatistic(group: "coast_marks", quantity: "length", statistic: Sum),
        FieldStatistic(field: "land", statistic: Sum),
    ],
)"#;

fn run() -> Run {
    Run::of(COAST, landform::registry(), 2)
}

#[test]
fn a_coast_rests_and_its_agents_know_it() {
    let run = run();
    let [eroded, pruned] = [0, 1].map(|stage| &run.report.stages[stage]);
    assert!(eroded.stopped.contains("coast_events"), "{}", eroded.stopped);
    let first = run.report.initial_metrics["land_sum"];
    for stage in [eroded, pruned] {
        let metric = |name: &str| stage.metrics[name];
        let close = |found: f64, expected: f64| (found - expected).abs() < 1e-6 * expected;
        assert!(close(metric("coast_marks_length_sum_m"), metric("shore_m")), "{}", stage.name);
        assert_eq!(metric("eroded_count"), first - metric("land_sum"), "{}", stage.name);
        assert!(metric("coast_count") > 100.0);
    }
    assert!(eroded.metrics["shore_ratio"] > 1.5, "{:?}", eroded.metrics);
    assert!(eroded.metrics["mean_force"] < 0.4, "{:?}", eroded.metrics);
}

#[test]
fn small_islands_are_pruned_and_booked() {
    let run = run();
    let [eroded, pruned] = [0, 1].map(|stage| &run.report.stages[stage].metrics);
    assert!(eroded["islands"] > eroded["large_islands"], "{eroded:?}");
    assert_eq!(pruned["islands"], eroded["large_islands"]);
    assert_eq!(pruned["large_islands_shore_m"], eroded["large_islands_shore_m"]);
    let account = &run.report.ledger.accounts()["land"];
    let lost = 100.0 * (run.report.initial_metrics["land_sum"] - pruned["land_sum"]);
    assert_eq!(account.left.values().sum::<f64>(), lost);
    assert_eq!(account.left["islands pruned"], 100.0 * (eroded["land_sum"] - pruned["land_sum"]));
    assert_eq!(account.largest_gap, 0.0);
}

#[test]
fn coasts_and_islands_are_written_as_tables() {
    let scratch = Scratch::new("coast");
    let outputs = "outputs: [LevelLines(file: \"coast.csv\", field: \"land\", levels: [0.5]), \
                   IslandTable(file: \"islands.csv\")],\n)";
    let text = COAST.strip_suffix(')').expect("a scenario").to_owned() + outputs;
    scratch.write("coast.ron", &text);
    Program::within(scratch.folder()).line("run coast.ron -o o --quiet").run().good();
    let file = read_lines(scratch.path("o/coast.csv"), &ReadLimits::default()).expect("lines");
    assert_eq!(file.coordinates, LineCoordinates::Planar);
    let points = file.lines.iter().flatten();
    assert!(points.clone().all(|&[x, y]| (0.0..960.0).contains(&x) && (0.0..800.0).contains(&y)));
    assert!(file.lines.iter().all(|line| line.first() == line.last()), "all shores are closed");

    let table = fs::read_to_string(scratch.path("o/islands.csv")).expect("a table");
    let mut rows = table.lines();
    assert_eq!(rows.next(), Some("island,area_m2,shore_m,x_m,y_m"));
    let rows: Vec<Vec<f64>> = rows
        .map(|row| row.split(',').map(|cell| cell.parse().expect("a number")).collect())
        .collect();
    let metrics = &run().report.stages[1].metrics;
    assert_eq!(rows.len() as f64, metrics["islands"]);
    assert_eq!(rows.iter().map(|row| row[1]).sum::<f64>(), 100.0 * metrics["land_sum"]);
    let shore: f64 = rows.iter().map(|row| row[2]).sum();
    assert!((shore - metrics["shore_m"]).abs() < 1e-6 * shore);
    assert!(rows.windows(2).all(|pair| pair[0][1] >= pair[1][1]), "the largest first");
}

#[test]
fn what_cannot_erode_is_refused_with_a_reason() {
    let told = |from: &str, to: &str| {
        let scratch = Scratch::new("coast");
        assert_eq!(COAST.matches(from).count(), 1, "{from}");
        scratch.write("coast.ron", COAST.replacen(from, to, 1));
        let ended = Program::within(scratch.folder()).line("run coast.ron -o o --quiet").run();
        assert!(ended.status == Some(1) || ended.status == Some(2), "{ended:?}");
        ended.stderr
    };
    for (from, to, part) in [
        ("StartingLand(margin: 0.1)", "Uniform(value: 1.0)", "no land meets the sea"),
        ("StartingLand(margin: 0.1)", "StartingLand(margin: 0.5)", "leave no land"),
        (
            "field: \"resistance\", from",
            "field: \"land\", combine: Max, from",
            "nothing provides field `resistance`",
        ),
        ("amplitude_m: 0.5", "amplitude_m: 5.0", "at least 0"),
        ("radius_m: 150.0", "radius_m: 12.0", "between 15 and 9500 m"),
        ("force: 0.5", "regions: [(place: Sides([]))]", "region 0 names no part of the map"),
        ("connectivity: Four", "boundary: (Periodic, Periodic), connectivity: Fore", "Four"),
    ] {
        let message = told(from, to);
        assert!(message.contains(part), "{to}: {message}");
    }
}
