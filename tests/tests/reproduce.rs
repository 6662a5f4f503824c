//! `landform reproduce`: numbers beside those of the thesis, from a target file.

use std::fs;

use landform_tests::{Ended, Program, SMALL, Scratch, write_hills};
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

/// Runs that differ in parameters, several runs of one name, and one figure of all pictures.
#[test]
fn runs_are_changed_repeated_and_put_together() {
    let scratch = Scratch::new("reproduce_set");
    scratch.write(
        "ramp.ron",
        "(title: \"ramp\", domain: Grid(size: (20, 20), spacing_m: 1.0),
          initial: [(field: \"bed\", from: Cone(height_m: 5.0, radius_m: 8.0))], stages: [],
          metrics: [FieldStatistic(statistic: Maximum)], outputs: [Picture(file: \"p.png\")])",
    );
    let source =
        |run: &str| format!("(run: \"{run}\", stage: \"initial\", metric: \"surface_maximum_m\")");
    let [low, high, many] = ["low", "high", "many"].map(source);
    let targets = format!(
        "(id: \"figure 0/1\", title: \"cones\", seeds: 2, columns: 2,
          runs: [
            (name: \"low\", scenario: \"ramp.ron\"),
            (name: \"high\", scenario: \"ramp.ron\", set: [\"initial[0].from.height_m=50.0\"]),
            (name: \"many\", scenario: \"ramp.ron\",
             over: (path: \"initial[0].from.height_m\", from: 10.0, to: 30.0, count: 3)),
          ],
          targets: [
            (name: \"difference\", value: Difference({high}, {low}), band: AtLeast(30.0)),
            (name: \"smallest\", value: Smallest{many}, band: AtMost(10.0)),
            (name: \"ratio\", value: Ratio({high}, {low}), band: Within(9.999, 10.001)),
            (name: \"largest\", value: Largest{many}, thesis: 30.0, band: Printed),
          ])"
    );
    scratch.write("c.targets.ron", &targets);
    let reproduce = || Program::within(scratch.folder()).line("reproduce c.targets.ron -o o");
    let told = reproduce().run().good();
    assert!(told.contains("10.000") && !told.contains("Missed"), "{told}");
    let report = fs::read_to_string(scratch.path("o/report.json")).expect("a report");
    let report: Value = serde_json::from_str(&report).expect("JSON");
    let value = |target: usize| report["figures"][0]["targets"][target]["value"].as_f64().unwrap();
    let share = value(1) / 10.0;
    assert!((0.8..=1.0).contains(&share), "the top lies between nodes: {share}");
    for (target, height) in [(0, 45.0), (1, 10.0), (3, 30.0)] {
        assert!((value(target) - share * height).abs() < 1e-9, "{target}: {}", value(target));
    }
    let pictures = report["figures"][0]["pictures"].as_array().expect("pictures");
    let expected = ["c/figure_0_1.png", "c/low/p.png", "c/high/p.png", "c/many/p.png"];
    assert_eq!(pictures.iter().map(|p| p.as_str().unwrap()).collect::<Vec<_>>(), expected);
    assert!(expected.iter().all(|picture| scratch.path("o").join(picture).is_file()));
    for (from, to, part) in [
        ("Smallest(run", "Metric(run", "several runs are called `many`"),
        ("count: 3", "count: 0", "`over` wants a `count`"),
        ("height_m=50.0", "height_m", "no PATH=VALUE"),
        ("height_m=50.0", "hight_m=50.0", "did you mean"),
    ] {
        scratch.write("c.targets.ron", targets.replace(from, to));
        let message = reproduce().line("--force").run().refused();
        assert!(message.contains(part), "{to}: no `{part}` in\n{message}");
    }
}

#[test]
fn other_papers_have_folders_means_and_names_of_their_own() {
    let scratch = Scratch::new("reproduce_folder");
    fs::create_dir_all(scratch.path("scenarios/paper")).expect("a folder");
    scratch.write("scenarios/paper/small.ron", SMALL);
    let of_seeds = |average: &str| {
        let head = format!("source: \"paper\", average: {average}, seeds: 3,");
        let targets = TARGETS.replace("seeds: 3,", &head);
        scratch.write("scenarios/paper/t.targets.ron", targets);
        let line = "reproduce paper/t -o o --force";
        let told = Program::within(scratch.folder()).line(line).run().good();
        assert!(told.contains("paper") && !told.contains("thesis"), "{told}");
        let report = fs::read_to_string(scratch.path("o/report.json")).expect("a report");
        let report: Value = serde_json::from_str(&report).expect("JSON");
        let target = &report["figures"][0]["targets"][0];
        let seeds = target["seeds"].as_array().expect("seeds").iter();
        let seeds: Vec<f64> = seeds.map(|value| value.as_f64().expect("a number")).collect();
        (target["value"].as_f64().expect("a number"), seeds)
    };
    let (mean, mut seeds) = of_seeds("Mean");
    assert!((mean - seeds.iter().sum::<f64>() / 3.0).abs() < 1e-12);
    seeds.sort_by(f64::total_cmp);
    assert_eq!(of_seeds("Median").0, seeds[1]);
}

/// What is done is kept; the report has the same bits however the work was cut up.
#[test]
fn work_that_was_ended_goes_on() {
    let scratch = Scratch::new("reproduce_resume");
    let read = |file: &str| fs::read_to_string(scratch.path(file)).expect("a file");
    reproduce(&scratch, TARGETS, "--jobs 1").good();
    let whole = ["report.json", "report.html"].map(|name| read(&format!("o/{name}")));
    let again = |line: &str| {
        let line = format!("reproduce t.targets.ron -o p {line}");
        Program::within(scratch.folder()).line(&line).run()
    };
    // Two of three seeds, as if it had been ended before the last.
    again("--seeds 2").good();
    let ended = again("--resume --jobs 2");
    assert!(ended.stderr.contains("1/1 table 0.1: small, seed 3 of 3"), "{}", ended.stderr);
    assert!(!ended.stderr.contains("seed 1 of"), "{}", ended.stderr);
    ended.good();
    assert_eq!(whole, ["report.json", "report.html"].map(|name| read(&format!("p/{name}"))));
    // A text that has changed is run again, and a record that is none is named.
    let changed = format!("{SMALL}\n// another text\n");
    scratch.write("small.ron", changed);
    let ended = again("--resume");
    assert!(ended.stderr.contains("1/3 table 0.1: small, seed 1 of 3"), "{}", ended.stderr);
    ended.good();
    scratch.write("p/done.json", "[]");
    assert!(again("--resume").refused().contains("done.json"));
    assert!(again("").refused().contains("not empty"));
}

/// All target files of a chapter of the thesis, in its order, and one page of all.
#[test]
fn a_chapter_is_reproduced_as_one() {
    let scratch = Scratch::new("reproduce_chapter");
    fs::create_dir_all(scratch.path("scenarios/thesis")).expect("folders");
    scratch.write("scenarios/thesis/small.ron", SMALL);
    for (file, id) in [("fig_3_10", "figure 3.10"), ("fig_3_2", "figure 3.2"), ("fig_b_1", "B")] {
        let targets = TARGETS.replace("table 0.1", id).replace("small dunes", "dunes < hills");
        scratch.write(&format!("scenarios/thesis/{file}.targets.ron"), targets);
    }
    // Another source, with a figure of the same name.
    fs::create_dir_all(scratch.path("scenarios/paper")).expect("folders");
    scratch.write("scenarios/paper/small.ron", SMALL);
    let paper = TARGETS.replace("table 0.1", "paper 2");
    scratch.write("scenarios/paper/fig_3_2.targets.ron", paper);
    let run = |line: &str| Program::within(scratch.folder()).line("reproduce").line(line).run();
    let told = run("--chapter 3 --quick -o o").good();
    let [second, tenth] = ["figure 3.2", "figure 3.10"].map(|id| told.find(id).expect(id));
    assert!(second < tenth && !told.contains("B:"), "{told}");
    assert!(
        told.contains("4 numbers with a band: 2 reproduced (50 %), 0 partly, 2 missed"),
        "{told}"
    );
    let text = fs::read_to_string(scratch.path("o/report.md")).expect("a text");
    for part in [
        "| Chapter 3 | 2 | 2 | 0 | 2 | 0 | 0 |",
        "### figure 3.10: dunes < hills\n\n`fig_3_10`",
        "| at least 1000 | **missed** |",
        "- highest sand, end / start: no dune grows a thousandfold.",
    ] {
        assert!(text.contains(part), "{part} in\n{text}");
    }
    let page = fs::read_to_string(scratch.path("o/report.html")).expect("a page");
    for part in [
        "figure 3.2: dunes &lt; hills",
        "src=\"data:image/",
        "missed 2<",
        "<h2 class=\"part\">Chapter 3</h2>",
        "slab_m: 3.0",
        "<circle",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("http"), "needs nothing else");
    let told = run("--all --quick -o all").good();
    let [appendix, paper] = ["B: dunes", "paper 2: small"].map(|id| told.find(id).expect(id));
    assert!(appendix < paper, "{told}");
    assert!(scratch.path("all/paper/fig_3_2").is_dir() && scratch.path("all/fig_3_2").is_dir());
    assert!(run("--chapter 7 -o none").refused().contains("no target files of chapter 7"));
    for line in ["", "--quick --seeds 2 fig_3_2", "--jobs 0 fig_3_2", "--all --chapter 3"] {
        assert_eq!(run(line).status, Some(2), "{line}");
    }
}

const DATA: &str = r#"(
    id: "figure 0.2",
    title: "hills",
    seeds: 2,
    columns: 1,
    analyses: [(name: "hills", file: "hills.tif"), (name: "dales", file: "dales.tif")],
    targets: [
        (
            name: "hills, one of two stages",
            value: Sum(
                (run: "hills", stage: "analysis", metric: "hypsometry_unusual"),
                (run: "hills", stage: "analysis", metric: "hypsometry_equilibrium"),
            ),
            band: AtLeast(0.0),
        ),
        (
            name: "hills, R2",
            value: Metric(run: "hills", stage: "analysis", metric: "spectral_r2"),
            band: Printed,
        ),
        (
            name: "hills less dales, integral",
            value: Difference(
                (run: "hills", stage: "analysis", metric: "hypsometry_integral"),
                (run: "dales", stage: "analysis", metric: "hypsometry_integral"),
            ),
            band: AtLeast(0.0),
            reason: "hills are higher",
        ),
    ],
)"#;

/// Numbers of data are reproduced where there are data, and neither that nor missed elsewhere.
#[test]
fn data_are_brought_by_the_user_or_absent() {
    let scratch = Scratch::new("reproduce_data");
    scratch.write("d.targets.ron", DATA);
    fs::create_dir(scratch.path("data")).expect("a folder");
    write_hills(&scratch.path("data/hills.tif"), 60, 44);
    let run = |line: &str| {
        Program::within(scratch.folder()).line("reproduce d.targets.ron").line(line).run()
    };
    let report = |folder: &str| -> Value {
        let text = fs::read_to_string(scratch.path(folder).join("report.json")).expect("a report");
        serde_json::from_str::<Value>(&text).expect("JSON")["figures"][0].clone()
    };
    let verdicts = |figure: &Value| -> Vec<String> {
        let targets = figure["targets"].as_array().expect("targets");
        targets.iter().map(|target| target["verdict"].as_str().unwrap().to_owned()).collect()
    };
    let told = run("-o without").good();
    assert!(told.contains("Absent") && told.contains("--data DIR"), "{told}");
    let figure = report("without");
    assert_eq!(verdicts(&figure), ["absent"; 3]);
    assert_eq!(figure["targets"][0]["value"], Value::Null);
    assert_eq!(
        (&figure["data"], &figure["pictures"]),
        (&Value::Array(vec![]), &Value::Array(vec![]))
    );

    let told = run("-o with --data data").good();
    assert!(told.contains("dales.tif is not in data"), "{told}");
    let figure = report("with");
    assert_eq!(verdicts(&figure), ["reproduced", "printed", "absent"]);
    assert_eq!(figure["data"], Value::from(vec!["data/hills.tif"]));
    assert_eq!(figure["pictures"], Value::from(vec!["d/figure_0_2.png", "d/hills/analysis.png"]));
    assert!(scratch.path("with/d/hills/analysis.png").is_file());
    // What was absent is looked for again.
    run("-o without --resume --data data").good();
    assert_eq!(verdicts(&report("without")), ["reproduced", "printed", "absent"]);
    // The same number as `landform analyze` gives.
    let analysis = Program::within(scratch.folder()).line("analyze --json data/hills.tif").run();
    let analysis: Value = serde_json::from_str(&analysis.good()).expect("JSON");
    let r2 = &analysis["spectrum"]["untreated"]["r2"];
    assert!(r2.is_f64() && figure["targets"][1]["value"] == *r2, "{r2}");

    let message = run("-o none --data nowhere").refused();
    assert!(message.contains("there is no folder nowhere"), "{message}");
    fs::write(scratch.path("data/dales.tif"), "no raster").expect("a file");
    let broken = run("-o broken --data data");
    assert!(broken.status == Some(1) && broken.stderr.contains("dales.tif"), "{broken:?}");
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
        assert_eq!(message.matches("error[").count(), 1, "{message}");
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
