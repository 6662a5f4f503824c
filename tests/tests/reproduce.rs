//! `landform reproduce`: numbers beside those of the thesis, from a target file.

use std::fs;

use landform_tests::{Ended, Program, SMALL, Scratch};
use serde_json::Value;

const TARGETS: &str = r#"(
    id: "table 0.1",
    title: "small dunes",
    seeds: 3,
    runs: [(name: "small", scenario: "small.ron")],
    targets: [
        (
            name: "highest sand (m)",
            value: Metric(run: "small", stage: "wind", metric: "sand_maximum_m"),
            thesis: 30.0,
            band: Within(20.0, 90.0),
        ),
        (
            name: "highest sand, end / start",
            value: Ratio(
                (run: "small", stage: "smooth", metric: "sand_maximum_m"),
                (run: "small", stage: "initial", metric: "sand_maximum_m"),
            ),
            band: AtLeast(1000.0),
            reason: "no dune grows a thousandfold",
        ),
    ],
)"#;

fn reproduce(scratch: &Scratch, targets: &str, line: &str) -> Ended {
    scratch.write("small.ron", SMALL);
    scratch.write("t.targets.ron", targets);
    Program::within(scratch.folder()).line("reproduce t.targets.ron -o o").line(line).run()
}

#[test]
fn numbers_stand_beside_those_of_the_thesis() {
    let scratch = Scratch::new("reproduce");
    let told = reproduce(&scratch, TARGETS, "").good();
    for part in ["table 0.1: small dunes", "highest sand (m)", "Reproduced", "Missed", "20 to 90"] {
        assert!(told.contains(part), "{part} in {told}");
    }
    let report = fs::read_to_string(scratch.path("o/report.json")).expect("a report");
    let report: Value = serde_json::from_str(&report).expect("JSON");
    let figure = &report["figures"][0];
    assert_eq!(figure["id"], "table 0.1");
    assert_eq!(figure["scenarios"], Value::from(vec!["small.ron"]));
    let pictures = figure["pictures"].as_array().expect("pictures");
    assert_eq!(pictures.len(), 3, "of the first seed only: {pictures:?}");
    for picture in pictures {
        let path = scratch.path("o").join(picture.as_str().expect("a path"));
        assert!(path.is_file(), "{}", path.display());
    }
    let [height, ratio] = [0, 1].map(|index| &figure["targets"][index]);
    let seeds: Vec<f64> =
        height["seeds"].as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect();
    let mut sorted = seeds.clone();
    sorted.sort_by(f64::total_cmp);
    assert_eq!(height["value"].as_f64(), Some(sorted[1]), "the median of three");
    assert!(seeds[0] != seeds[1] && seeds[1] != seeds[2], "every seed has its own: {seeds:?}");
    assert_eq!((&height["thesis"], &height["verdict"]), (&30.0.into(), &"reproduced".into()));
    assert_eq!((&ratio["thesis"], &ratio["verdict"]), (&Value::Null, &"missed".into()));
    assert_eq!(ratio["reason"], "no dune grows a thousandfold");
    // The same number as a plain run of the scenario with that seed.
    let set = "run small.ron -o single --seed 2 --set stages[1].stop=Iterations(1)";
    Program::within(scratch.folder()).line(set).run().good();
    let single = fs::read_to_string(scratch.path("single/report.json")).unwrap();
    let single: Value = serde_json::from_str(&single).unwrap();
    assert_eq!(single["stages"][0]["metrics"]["sand_maximum_m"].as_f64(), Some(seeds[1]));
}

#[test]
fn target_files_that_cannot_work_are_refused_before_the_first_run() {
    for (from, to, parts) in [
        ("scenario: \"small.ron\"", "scenario: \"big.ron\"", &["big.ron"][..]),
        ("(name: \"small\"", "(name: \"../small\"", &["`../small` cannot name a folder"]),
        ("(name: \"small\"", "(name: \"\"", &["`` cannot name a folder"]),
        (
            "run: \"small\", stage: \"wind\"",
            "run: \"smal\", stage: \"wind\"",
            &["no run is called `smal`", "highest sand (m)", "small"],
        ),
        ("stage: \"wind\"", "stage: \"wand\"", &["no stage `wand`", "wind, smooth, initial"]),
        ("seeds: 3", "seeds: 0", &["zero seeds"]),
        ("seeds: 3", "seeds: -3", &["t.targets.ron:4:"]),
        ("band: AtLeast(1000.0)", "band: Least(1000.0)", &["t.targets.ron:19:", "AtLeast"]),
        ("title: ", "tilte: ", &["t.targets.ron:3:5", "\"title\"?"]),
    ] {
        assert_eq!(TARGETS.matches(from).count(), 1, "{from}");
        let scratch = Scratch::new("reproduce_bad");
        let message = reproduce(&scratch, &TARGETS.replace(from, to), "").refused();
        for part in parts {
            assert!(message.contains(part), "{to}: no `{part}` in\n{message}");
        }
        assert!(message.contains("t.targets.ron"), "{message}");
        assert_eq!(scratch.names(), ["small.ron", "t.targets.ron"], "{to}");
    }
    let scratch = Scratch::new("reproduce_none");
    let message = Program::within(scratch.folder()).line("reproduce table_9_9").run().refused();
    assert!(message.contains("there is no target file table_9_9"), "{message}");
}

#[test]
fn the_target_files_of_the_repository_can_work() {
    let files = landform_tests::files_below("scenarios", "ron");
    let files: Vec<_> =
        files.iter().filter(|file| file.to_string_lossy().ends_with(".targets.ron")).collect();
    assert!(!files.is_empty(), "there are target files");
    for file in files {
        // Zero seeds are refused, but only when nothing else is wrong.
        let scratch = Scratch::new("targets");
        let call = Program::within(scratch.folder()).line("reproduce --seeds 0 -o o").args([file]);
        let message = call.run().refused();
        assert!(message.contains("zero seeds"), "{message}");
    }
}
