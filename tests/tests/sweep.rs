//! `landform sweep` and `landform collect`: what they leave, that nothing but the sweep matters to
//! it, that they go on after every kind of stop, and what they refuse.

use std::fs;
use std::path::{Path, PathBuf};

use landform::view::Image;
use landform_tests::{Ended, Program, SMALL, Scratch, executable, files_below, shown};
use serde_json::Value;

/// Six runs of the small scenario with one picture, two seeds at each of three points.
const SWEEP: &str = r#"(
    title: "Slabs",
    scenario: "small.ron",
    set: [(path: "outputs", value: [Picture(file: "map.png")])],
    vary: [Grid([(path: "stages[0].processes.Dunes.slab_m", values: [1.0, 2.0, 3.0])])],
    seeds: Count(2),
)"#;

fn scratch() -> Scratch {
    let scratch = Scratch::new("sweep");
    scratch.write("small.ron", SMALL);
    scratch.write("s.sweep.ron", SWEEP);
    scratch
}

fn call(scratch: &Scratch, line: &str) -> Ended {
    Program::within(scratch.folder()).line(line).run()
}

/// Every file below a folder with its content; reports without what depends on the machine.
fn files(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut found = Vec::new();
    collect(folder, folder, &mut found);
    found.sort();
    found
}

fn collect(root: &Path, folder: &Path, found: &mut Vec<(PathBuf, Vec<u8>)>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            collect(root, &path, found);
            continue;
        }
        let mut content = fs::read(&path).expect("a file");
        if path.ends_with("report.json") {
            let mut report: Value = serde_json::from_slice(&content).expect("JSON");
            report["seconds"] = Value::Null;
            report["threads"] = Value::Null;
            for stage in report["stages"].as_array_mut().expect("stages") {
                stage["seconds"] = Value::Null;
            }
            content = report.to_string().into_bytes();
        }
        found.push((path.strip_prefix(root).expect("below").to_owned(), content));
    }
}

/// The rows of a table without its header, cells without quotes in them.
fn rows(scratch: &Scratch, folder: &str) -> Vec<Vec<String>> {
    let table = fs::read_to_string(scratch.path(folder).join("table.csv")).expect("a table");
    table.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn a_sweep_leaves_its_runs_a_table_a_contact_sheet_and_plots() {
    let scratch = scratch();
    let told = call(&scratch, "sweep s.sweep.ron -o o --jobs 2").good();
    assert!(told.starts_with("6 runs are done\n"), "{told}");
    let table = fs::read_to_string(scratch.path("o/table.csv")).expect("a table");
    let header = "run,seed,slab_m,status,reason,iterations,avalanche_slid_m,";
    assert!(table.starts_with(header), "{table}");
    let rows = rows(&scratch, "o");
    let slabs: Vec<&str> = rows.iter().map(|row| row[2].as_str()).collect();
    assert_eq!(slabs, ["1.0", "1.0", "2.0", "2.0", "3.0", "3.0"]);
    assert!(rows.iter().all(|row| row[3] == "done" && row[5] == "8"), "{table}");
    let seeds: std::collections::BTreeSet<&String> = rows.iter().map(|row| &row[1]).collect();
    assert_eq!(seeds.len(), 6, "no two runs share random numbers");
    let (plot, _) = Image::read_png(&scratch.path("o/plots.png")).expect("a plot");
    assert!(plot.width >= 960);
    let svg = fs::read_to_string(scratch.path("o/plots.svg")).expect("a plot");
    assert!(svg.contains(">slab (m)</text>") && svg.contains(">sand maximum (m)</text>"), "{svg}");
    let (sheet, _) = Image::read_png(&scratch.path("o/pictures.png")).expect("a sheet");
    assert_eq!(sheet.width, 3 * 96 + 4 * 16, "a picture for each point");

    // A run is the run that its scenario makes alone.
    call(&scratch, "run o/runs/0004/scenario.ron -o alone").good();
    let [alone, among] = ["alone", "o/runs/0004"].map(|folder| files(&scratch.path(folder)));
    let among: Vec<_> = among.into_iter().filter(|(path, _)| !path.ends_with("run.json")).collect();
    assert!(alone == among);
}

#[test]
fn jobs_threads_and_shares_do_not_matter() {
    let scratch = scratch();
    call(&scratch, "sweep s.sweep.ron -o one --jobs 1 --threads 1").good();
    call(&scratch, "sweep s.sweep.ron -o many --jobs 3 --threads 4 --memory-limit-gib 0.001")
        .good();
    assert!(files(&scratch.path("one")) == files(&scratch.path("many")));
    for share in ["2/3", "1/3", "3/3"] {
        let told = call(&scratch, &format!("sweep s.sweep.ron -o shares --index {share}")).good();
        assert!(told.starts_with("2 runs of this share ended"), "{told}");
    }
    assert!(!scratch.path("shares/table.csv").exists());
    assert!(call(&scratch, "collect shares").good().starts_with("6 runs are done\n"));
    assert!(files(&scratch.path("one")) == files(&scratch.path("shares")));
}

#[test]
fn a_sweep_goes_on_where_it_was_stopped() {
    let scratch = scratch();
    call(&scratch, "sweep s.sweep.ron -o whole").good();
    let expected = files(&scratch.path("whole"));
    // As killed runs leave it: nothing, half of the files, an outcome without a report.
    call(&scratch, "sweep s.sweep.ron -o o").good();
    fs::remove_dir_all(scratch.path("o/runs/0002")).unwrap();
    fs::remove_file(scratch.path("o/runs/0003/run.json")).unwrap();
    fs::write(scratch.path("o/runs/0003/.map.png.1.part"), "half").unwrap();
    fs::remove_file(scratch.path("o/runs/0004/report.json")).unwrap();
    fs::write(scratch.path("o/runs/0005/run.json"), "{\"digest\":").unwrap();
    let kept = fs::metadata(scratch.path("o/runs/0001/report.json")).unwrap().modified().unwrap();
    let told = call(&scratch, "collect o").good();
    assert!(told.starts_with("2 runs are done, 4 are missing\n"), "{told}");
    assert_eq!(rows(&scratch, "o")[1][3], "missing");
    call(&scratch, "sweep s.sweep.ron -o o").good();
    assert!(files(&scratch.path("o")) == expected);
    let now = fs::metadata(scratch.path("o/runs/0001/report.json")).unwrap().modified().unwrap();
    assert_eq!(kept, now, "a run that is done stays");
}

#[cfg(unix)]
#[test]
fn interrupted_and_killed_sweeps_go_on_to_the_same_bits() {
    let scratch = scratch();
    // Long enough to be stopped in the middle.
    let long =
        SWEEP.replace("set: [", "set: [(path: \"stages[0].stop\", value: Iterations(120)), ");
    scratch.write("long.sweep.ron", long);
    call(&scratch, "sweep long.sweep.ron -o whole --jobs 1").good();
    let stop = |signal: &str| {
        let mut command = std::process::Command::new(executable());
        command.current_dir(scratch.folder()).args("sweep long.sweep.ron -o o --jobs 1".split(' '));
        command.stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
        let mut child = command.spawn().expect("the program starts");
        let first = scratch.path("o/runs/0002");
        while !first.exists() && child.try_wait().expect("a child").is_none() {
            std::thread::sleep(std::time::Duration::from_millis(2));
        }
        let mut kill = std::process::Command::new("kill");
        kill.arg(signal).arg(child.id().to_string()).status().expect("kill");
        child.wait_with_output().expect("an end")
    };
    let output = stop("-INT");
    let ended = Ended::of(output);
    // A machine may be so fast that nothing was left to stop.
    if ended.status != Some(0) {
        assert_eq!(ended.status, Some(130), "{ended:?}");
        assert!(ended.stderr.contains("goes on"), "{ended:?}");
    }
    fs::remove_dir_all(scratch.path("o")).unwrap();
    stop("-KILL");
    call(&scratch, "sweep long.sweep.ron -o o").good();
    assert!(files(&scratch.path("o")) == files(&scratch.path("whole")));
}

/// A folder that another sweep works in is left alone; shares work side by side.
#[test]
fn two_sweeps_never_work_in_one_folder() {
    let scratch = scratch();
    fs::create_dir(scratch.path("o")).expect("a folder");
    let other = fs::File::open(scratch.path("o")).expect("a folder");
    other.lock_shared().expect("a lock");
    let refused = call(&scratch, "sweep s.sweep.ron -o o").refused();
    assert!(refused.contains("another sweep is at work in o"), "{refused}");
    call(&scratch, "sweep s.sweep.ron -o o --index 1/3").good();
    drop(other);
    call(&scratch, "sweep s.sweep.ron -o o").good();
}

#[test]
fn a_plot_of_what_nobody_measures_is_named() {
    let scratch = scratch();
    let plots = r#"seeds: Count(1), plots: [(metric: "avalanche_slide_m")],"#;
    scratch.write("s.sweep.ron", SWEEP.replace("seeds: Count(2),", plots));
    let told = call(&scratch, "sweep s.sweep.ron -o o").good();
    let note = r#"no run measured "avalanche_slide_m", which is to be plotted; did you mean "avalanche_slid_m"?"#;
    assert!(told.contains(note), "{told}");
}

#[test]
fn a_run_that_fails_says_why_and_the_others_go_on() {
    let scratch = scratch();
    // Less sand than the noise takes away: that shows when the field is filled.
    let path = "initial[0].from.amplitude_m";
    scratch.write(
        "f.sweep.ron",
        format!(
            "(scenario: \"small.ron\", vary: [Grid([(path: \"{path}\", values: [5.0, 90.0])])])"
        ),
    );
    let ended = call(&scratch, "sweep f.sweep.ron -o o");
    assert_eq!(ended.status, Some(1), "{ended:?}");
    assert!(ended.stderr.contains("1 runs failed, run 2 by: L0305: initial[0]"), "{ended:?}");
    let table = fs::read_to_string(scratch.path("o/table.csv")).expect("a table");
    let last = table.lines().last().unwrap();
    assert!(last.starts_with("2,") && last.contains(",90.0,failed,L0305: initial[0]"), "{table}");
    assert!(table.lines().nth(1).unwrap().contains(",done,,8,"), "{table}");
}

#[test]
fn a_changed_sweep_is_refused_with_the_reason() {
    let scratch = scratch();
    call(&scratch, "sweep s.sweep.ron -o o --jobs 2").good();
    for (from, to, part) in [
        ("3.0]", "3.5]", "run 5 had slab_m 3.0 and has slab_m 3.5 now"),
        ("Count(2)", "Count(3)", "it had 6 runs and has 9 now"),
        ("seeds:", "seed: 4, seeds:", "run 1 had the seed"),
        (".slab_m", ".wind_strength_m", "it varied stages[0].processes.Dunes.slab_m"),
        ("map.png", "map2.png", "the scenario of run 1 is another one"),
    ] {
        scratch.write("changed.sweep.ron", SWEEP.replace(from, to));
        let told = call(&scratch, "sweep changed.sweep.ron -o o").refused();
        assert!(told.contains(part), "{part} in {told}");
    }
    // What concerns no run may change.
    scratch.write("titled.sweep.ron", SWEEP.replace("Slabs", "Thick slabs"));
    call(&scratch, "sweep titled.sweep.ron -o o").good();
    let svg = fs::read_to_string(scratch.path("o/plots.svg")).expect("a plot");
    assert!(svg.contains(">Thick slabs</text>"));
}

#[test]
fn what_is_wrong_is_refused_before_the_first_run() {
    let scratch = scratch();
    scratch.write("x.txt", "nothing");
    let many: String = (0..9)
        .map(|index| format!("(path: \"outputs[0].x{index}\", values: [1,2,3,4,5,6,7,8,9,10]),"))
        .collect();
    for (from, to, parts) in [
        (
            "Dunes.slab_m",
            "Dunes.slab_n",
            &["run 1 with slab_n = 1.0", "did you mean \"slab_m\"", "s.sweep.ron:5:18"][..],
        ),
        ("Dunes.slab_m", "Dnes.slab_m", &["has no \"Dnes\"", "did you mean \"Dunes\""]),
        ("3.0]", "-3.0]", &["run 5 with slab_m = -3.0 is refused", "out of range"]),
        ("3.0]", "\"thick\"]", &["run 5 with slab_m = \"thick\"", "a number"]),
        ("small.ron", "smal.ron", &["cannot read the scenario", "s.sweep.ron:3:15"]),
        ("title:", "titel:", &["unknown field \"titel\"", "did you mean \"title\""]),
        ("Grid(", "Gird(", &["Gird", "did you mean \"Grid\""]),
        ("Count(2)", "Count(-2)", &["s.sweep.ron:6:"]),
        ("path: \"outputs\"", "path: \"outputz[1].x\"", &["cannot be changed so", "outputs"]),
        (
            "(path: \"stages[0].processes.Dunes.slab_m\", values: [1.0, 2.0, 3.0])",
            &many,
            &["2000000000 runs", "at most 100000"][..],
        ),
        (
            "title:",
            "plots: [(metric: \"sand_maximum_m\", by: \"slab\")], title:",
            &["no parameter of the sweep is called `slab`", "did you mean \"slab_m\""],
        ),
    ] {
        assert!(SWEEP.contains(from), "{from}");
        scratch.write("s.sweep.ron", SWEEP.replace(from, to));
        let told = call(&scratch, "sweep s.sweep.ron -o o").refused();
        for part in parts {
            assert!(told.contains(part), "{part} in {told}");
        }
        assert!(!scratch.path("o").exists(), "{to}");
    }
    scratch.write("s.sweep.ron", SWEEP);
    fs::create_dir(scratch.path("full")).unwrap();
    scratch.write("full/mine.txt", "mine");
    for (line, part) in [
        ("sweep s.sweep.ron -o full", "not empty"),
        ("sweep s.sweep.ron -o x.txt", "is a file"),
        ("sweep s.sweep.ron -o o --index 0/2", "counted from 1"),
        ("sweep s.sweep.ron --index 1/2", "--index needs -o"),
        ("sweep s.sweep.ron -o o --jobs 0", "--jobs must be from 1"),
        ("sweep s.sweep.ron -o o --disk-limit-gib 0.0001", "on the disk"),
        ("sweep s.sweep.ron -o o --memory-limit-gib 0.0000001", "nodes need about"),
        ("collect full", "holds no sweep"),
        ("sweep none.sweep.ron", "cannot read"),
    ] {
        let told = call(&scratch, line).refused();
        assert!(told.contains(part), "{line}: {told}");
    }
    assert!(!scratch.path("o").exists());
}

#[test]
fn sweeps_of_the_repository_are_good() {
    let mut files = files_below("scenarios", "ron");
    files.retain(|file| shown(file).ends_with(".sweep.ron"));
    assert!(!files.is_empty(), "there are sweeps");
    let scratch = Scratch::new("sweeps");
    for file in files {
        let dry = Program::within(scratch.folder()).args(["sweep", "--dry-run"]).args([&file]);
        assert!(dry.run().good().lines().count() > 2, "{}", shown(&file));
        let checked = Program::within(scratch.folder()).args(["check"]).args([&file]).run();
        assert!(checked.good().contains("good, "), "{}", shown(&file));
    }
    assert_eq!(scratch.names(), [""; 0], "nothing is written");
}
