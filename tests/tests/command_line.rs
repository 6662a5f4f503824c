//! The command line as a user meets it: files, streams, exit status.

use std::fs;
use std::path::Path;

use landform::io::read_raster;
use landform::view::Image;
use landform_tests::{Ended, Program, SMALL, Scratch, changed};
use serde_json::Value;

/// Everything that a run of [`SMALL`] leaves, without what lies in `fields`.
const LEFT: [&str; 10] = [
    "fields",
    "growth.apng",
    "map.png",
    "panels.png",
    "report.json",
    "scenario.ron",
    "series.csv",
    "surface.glb",
    "surface.tif",
    "view.png",
];

/// A folder with the small scenario in it.
fn scratch() -> Scratch {
    let scratch = Scratch::new("command_line");
    scratch.write("small.ron", SMALL);
    scratch
}

fn call(scratch: &Scratch, line: &str) -> Ended {
    Program::within(scratch.folder()).line(line).run()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn report(folder: &Path) -> Value {
    let text = fs::read_to_string(folder.join("report.json")).expect("a report");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn a_run_leaves_pictures_rasters_a_mesh_a_series_and_the_final_fields() {
    let scratch = scratch();
    let ended = call(&scratch, "run small.ron -o o");
    assert_eq!(ended.stderr, "", "a progress bar is for terminals only");
    let told = ended.good();
    for part in ["Small dunes: 1536 nodes", "wind: 6 iterations", "picture o/map.png"] {
        assert!(told.contains(part), "{part} in {told}");
    }
    let folder = scratch.path("o");
    assert_eq!(names(&folder), LEFT);
    let fields =
        ["bed", "sand", "surface"].map(|name| [format!("{name}.npy"), format!("{name}.npy.json")]);
    assert_eq!(names(&folder.join("fields")), fields.concat());
    let (map, text) = Image::read_png(&folder.join("map.png")).expect("a picture");
    assert_eq!((map.width, map.height), (96, 64));
    for (key, value) in [("Title", "Small dunes"), ("spacing_m", "10"), ("seed", "3")] {
        assert!(text.contains(&(key.to_owned(), value.to_owned())), "{key} in {text:?}");
    }
    let (view, _) = Image::read_png(&folder.join("view.png")).expect("a picture");
    assert_eq!((view.width, view.height), (96, 64));
    let raster = read_raster(folder.join("surface.tif")).expect("a raster");
    assert_eq!((raster.size(), raster.spacing_m().expect("metres")), ([48, 32], 10.0));
    let last = read_raster(folder.join("fields/surface.npy")).expect("a field");
    assert_eq!(raster.values, last.values);
    let series = fs::read_to_string(folder.join("series.csv")).expect("a series");
    assert!(series.starts_with("iteration,sand_maximum_m"), "{series}");
    assert_eq!(series.lines().count(), 1 + 1 + 8, "a header, the start, eight iterations");
}

#[test]
fn the_report_holds_what_the_run_was_and_did() {
    let scratch = scratch();
    call(&scratch, "run small.ron -o o --threads 2").good();
    let report = report(&scratch.path("o"));
    for (key, value) in [
        ("title", Value::from("Small dunes")),
        ("seed", Value::from(3)),
        ("version", Value::from(env!("CARGO_PKG_VERSION"))),
        ("size", Value::from(vec![48, 32, 1])),
        ("nodes", Value::from(48 * 32)),
        ("spacing_m", Value::from(10.0)),
        ("threads", Value::from(2)),
        ("warnings", Value::Array(Vec::new())),
    ] {
        assert_eq!(report[key], value, "{key}");
    }
    assert!(report["seconds"].as_f64().is_some_and(|seconds| seconds > 0.0));
    let stages = report["stages"].as_array().expect("stages");
    let seen: Vec<_> =
        stages.iter().map(|stage| (stage["name"].as_str(), stage["iterations"].as_u64())).collect();
    assert_eq!(seen, [(Some("wind"), Some(6)), (Some("smooth"), Some(2))]);
    assert_eq!(stages[0]["stopped"], "6 iterations are done");
    assert_eq!(stages[0]["processes"], Value::from(vec!["Dunes"]));
    for metric in ["sand_maximum_m", "slabs_lifted", "hops_per_lift"] {
        assert!(report["metrics"][metric].is_f64(), "{metric}");
        assert!(stages[0]["metrics"][metric].is_f64(), "{metric}");
    }
    let sand = &report["ledger"]["accounts"]["sand"];
    assert_eq!(sand["unit"], "m3");
    assert!(sand["largest_gap"].as_f64().is_some_and(|gap| gap <= 1e-12), "{sand}");
    let outputs = report["outputs"].as_array().expect("outputs");
    assert_eq!(outputs.len(), 6 + 3 + 2, "outputs, fields, series and scenario");
    for output in outputs {
        let file = scratch.path("o").join(output["file"].as_str().expect("a file"));
        assert!(fs::metadata(&file).is_ok_and(|data| data.len() > 0), "{}", file.display());
    }
}

#[test]
fn an_existing_folder_is_left_alone_without_force() {
    let scratch = scratch();
    fs::create_dir(scratch.path("o")).unwrap();
    scratch.write("o/precious.txt", "mine");
    let message = call(&scratch, "run small.ron -o o").refused();
    assert!(message.contains("the output folder o exists and is not empty"), "{message}");
    assert!(message.contains("--force"), "{message}");
    assert_eq!(names(&scratch.path("o")), ["precious.txt"]);
    call(&scratch, "run small.ron -o o --force").good();
    assert_eq!(fs::read_to_string(scratch.path("o/precious.txt")).unwrap(), "mine");
    assert_eq!(names(&scratch.path("o")).len(), LEFT.len() + 1);
}

#[test]
fn without_a_folder_a_new_one_below_out_is_made_each_time() {
    let scratch = scratch();
    assert!(call(&scratch, "run small.ron").good().contains("out/small/map.png"));
    assert!(call(&scratch, "run small.ron").good().contains("out/small-2/map.png"));
    assert!(call(&scratch, "run small.ron").good().contains("out/small-3/map.png"));
    assert_eq!(names(&scratch.path("out")), ["small", "small-2", "small-3"]);
}

#[test]
fn the_seed_decides_the_bits() {
    let scratch = scratch();
    for (folder, options) in [("a", ""), ("b", "--seed 3"), ("c", "--seed 4")] {
        call(&scratch, &format!("run small.ron -o {folder} {options}")).good();
    }
    let sand = |folder: &str| fs::read(scratch.path(folder).join("fields/sand.npy")).unwrap();
    assert_eq!(sand("a"), sand("b"), "the seed of the scenario is 3");
    assert_ne!(sand("a"), sand("c"));
    assert_eq!(report(&scratch.path("c"))["seed"], 4);
}

#[test]
fn any_number_of_threads_leaves_the_same_bytes() {
    let scratch = scratch();
    for threads in [1, 2, 8] {
        call(&scratch, &format!("run small.ron -o t{threads} --threads {threads}")).good();
        assert_eq!(report(&scratch.path(&format!("t{threads}")))["threads"], threads);
    }
    let fields = names(&scratch.path("t1/fields")).into_iter().map(|name| format!("fields/{name}"));
    let rest = LEFT.iter().map(|&name| name.to_owned());
    let files: Vec<String> =
        fields.chain(rest).filter(|name| name != "fields" && name != "report.json").collect();
    assert_eq!(files.len(), 6 + 8);
    for file in files {
        let [one, two, eight] =
            ["t1", "t2", "t8"].map(|folder| fs::read(scratch.path(folder).join(&file)).unwrap());
        assert!(one == two && two == eight, "{file} depends on the number of threads");
    }
}

#[test]
fn values_are_set_from_the_command_line() {
    let scratch = scratch();
    let set = "run small.ron -o o --set domain.size=(20,10) --set stages[0].stop=Iterations(1) \
               --set title=Windy --set stages[0].processes.Dunes.repose_deg=30";
    assert!(call(&scratch, set).good().starts_with("Windy: 200 nodes"));
    assert_eq!(report(&scratch.path("o"))["stages"][0]["iterations"], 1);
    let kept = fs::read_to_string(scratch.path("o/scenario.ron")).unwrap();
    assert!(kept.contains("size: (20,10)") && kept.contains("repose_deg: 30"), "{kept}");
}

#[test]
fn a_run_that_fails_says_so_by_its_exit_status_and_keeps_its_report() {
    let scratch = scratch();
    let text = changed("Iterations(6)", "Below(metric: \"sand_maximun_m\", value: 1.0)");
    scratch.write("endless.ron", text);
    let ended = call(&scratch, "run endless.ron -o o");
    assert_eq!((ended.status, ended.stdout.as_str()), (Some(1), ""), "{ended:?}");
    for part in ["nothing measures `sand_maximun_m`", "did you mean \"sand_maximum_m\"?"] {
        assert!(ended.stderr.contains(part), "{}", ended.stderr);
    }
    assert!(ended.stderr.contains("what was done until then is in o"), "{}", ended.stderr);
    assert_eq!(report(&scratch.path("o"))["stages"][0]["iterations"], 1);
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_exits_with_130_and_leaves_its_report() {
    use std::process::Command;
    use std::time::{Duration, Instant};

    let scratch = Scratch::new("interrupt");
    scratch.write("long.ron", changed("Iterations(6)", "Iterations(1000000000)"));
    let child = Program::within(scratch.folder()).line("run long.ron -o o").start();
    let begun = Instant::now();
    // The folder is made right before the first iteration, the handler well before it.
    while !scratch.path("o").exists() && begun.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(10));
    }
    std::thread::sleep(Duration::from_millis(300));
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(sent.is_ok_and(|status| status.success()), "the signal was sent");
    let ended = Ended::of(child.wait_with_output().unwrap());
    assert_eq!((ended.status, ended.stdout.as_str()), (Some(130), ""), "{ended:?}");
    assert!(ended.stderr.contains("interrupted after"), "{}", ended.stderr);
    let report = report(&scratch.path("o"));
    let stage = &report["stages"][0];
    assert!(stage["stopped"].as_str().is_some_and(|why| why.starts_with("interrupted after")));
    assert!(stage["iterations"].as_u64().is_some_and(|done| done >= 1), "{stage}");
    assert_eq!(read_raster(scratch.path("o/fields/sand.npy")).unwrap().size(), [48, 32]);
}

#[test]
fn check_runs_nothing_and_names_every_bad_file() {
    let scratch = scratch();
    scratch.write("bad.ron", changed("Smoothing()", "Smothing()"));
    assert_eq!(call(&scratch, "check small.ron small.ron").good(), "small.ron: good\n".repeat(2));
    let ended = call(&scratch, "check bad.ron small.ron nowhere.ron");
    assert_eq!((ended.status, ended.stdout.as_str()), (Some(2), "small.ron: good\n"));
    for part in ["bad.ron:10:", "did you mean \"Smoothing\"?", "nowhere.ron"] {
        assert!(ended.stderr.contains(part), "{part} in {}", ended.stderr);
    }
    assert_eq!(scratch.names(), ["bad.ron", "small.ron"], "nothing was written");
}
