//! `landform reproduce`: laws beside our numbers, exponents, and plots of both.

use std::fs;

use landform_tests::{Program, Scratch};
use serde_json::Value;

const CONE: &str = "(title: \"cone\", domain: Grid(size: (20, 20), spacing_m: 1.0),
    initial: [(field: \"bed\", from: Cone(height_m: 5.0, radius_m: 8.0))], stages: [],
    metrics: [FieldStatistic(statistic: Maximum)], outputs: [Picture(file: \"p.png\")])";

const LAWS: &str = r#"(
    id: "cones",
    title: "as high as they are made",
    source: "law",
    seeds: 2,
    runs: [
        (name: "low", scenario: "cone.ron"),
        (name: "high", scenario: "cone.ron", set: ["initial[0].from.height_m=40.0"]),
    ],
    targets: [
        (
            name: "exponent",
            value: Exponent([
                (5.0, (run: "low", stage: "initial", metric: "surface_maximum_m")),
                (40.0, (run: "high", stage: "initial", metric: "surface_maximum_m")),
            ]),
            thesis: 1,
            band: Within(0.999999, 1.000001),
        ),
        (
            name: "by the law",
            value: ByLaw(
                (run: "high", stage: "initial", metric: "surface_maximum_m"),
                (run: "low", stage: "initial", metric: "surface_maximum_m"),
                Power(8.0, 1.0),
            ),
            band: Within(0.999999, 1.000001),
        ),
        (
            name: "low",
            value: Metric(run: "low", stage: "initial", metric: "surface_maximum_m"),
            thesis: 5.0,
            band: AtMost(5.0),
        ),
        (
            name: "high",
            value: Metric(run: "high", stage: "initial", metric: "surface_maximum_m"),
            thesis: 40.0,
            band: AtMost(40.0),
        ),
    ],
    plots: [
        (
            x: "height asked for (m)",
            y: "height (m)",
            log_x: true,
            log_y: true,
            series: [(name: "ours", points: [At(5.0, "low"), At(40.0, "high")], exponent: 1.0)],
        ),
        (
            title: "each other",
            y_range: (30.0, 50.0),
            x: "low (m)",
            y: "high (m)",
            series: [(name: "ours", points: [Of("low", "high")], law: Constant(40.0), law_name: "40")],
        ),
    ],
)"#;

/// The program in a folder with `laws.targets.ron` below `scenarios/physics`.
fn reproduce(scratch: &Scratch, laws: &str, line: &str) -> landform_tests::Ended {
    fs::create_dir_all(scratch.path("scenarios/physics")).expect("a folder");
    scratch.write("scenarios/physics/cone.ron", CONE);
    scratch.write("scenarios/physics/laws.targets.ron", laws);
    Program::within(scratch.folder()).line("reproduce").line(line).run()
}

#[test]
fn numbers_are_held_against_laws_and_plotted() {
    let scratch = Scratch::new("laws");
    let told = reproduce(&scratch, LAWS, "physics -o o").good();
    assert!(told.contains("cones: as high") && !told.contains("Missed"), "{told}");
    let report = fs::read_to_string(scratch.path("o/report.json")).expect("a report");
    let report: Value = serde_json::from_str(&report).expect("JSON");
    let figure = &report["figures"][0];
    for target in [0, 1] {
        let value = figure["targets"][target]["value"].as_f64().expect("a number");
        assert!((value - 1.0).abs() < 1e-12, "{value}");
    }
    assert_eq!(figure["pictures"][0], "physics/laws/plot.png");
    let plot = fs::read(scratch.path("o/physics/laws/plot.png")).expect("a plot");
    assert!(plot.starts_with(b"\x89PNG"));
    let page = fs::read_to_string(scratch.path("o/report.html")).expect("a page");
    assert!(page.contains("plot.png"));
}

#[test]
fn plots_and_exponents_that_cannot_work_are_refused_before_the_first_run() {
    for (from, to, part) in [
        ("At(5.0, \"low\")", "At(5.0, \"lower\")", "no target is called `lower`"),
        ("Of(\"low\"", "Of(\"lower\"", "the plot of high (m) against low (m)"),
        ("At(5.0, \"low\")", "At(0.0, \"low\")", "0 cannot stand on its axis"),
        ("y_range: (30.0", "y_range: (60.0", "(60, 50) is no range of its axis"),
        ("points: [Of(\"low\", \"high\")]", "points: []", "each of them points"),
        ("                (5.0, (run", "                (40.0, (run", "two different numbers"),
        (
            "metric: \"surface_maximum_m\")),\n                (40.0, (run: \"high\"",
            "metric: \"surface_maximum_m\")),\n                (40.0, (run: \"hihg\"",
            "no run is called `hihg`",
        ),
    ] {
        assert_eq!(LAWS.matches(from).count(), 1, "{from}");
        let scratch = Scratch::new("laws_bad");
        let message = reproduce(&scratch, &LAWS.replace(from, to), "physics/laws -o o").refused();
        assert!(message.contains(part), "{to}: no `{part}` in\n{message}");
        assert!(!scratch.path("o").exists(), "{to}");
    }
    let scratch = Scratch::new("laws_none");
    assert!(reproduce(&scratch, LAWS, "physic -o o").refused().contains("no target file physic"));
}
