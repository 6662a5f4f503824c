//! `landform analyze`: what it prints, and what it refuses.

use landform::io::{IfExists, Metadata, Raster, write_raster};
use landform::view::Image;
use landform_tests::{Ended, Program, Scratch, write_hills};
use serde_json::Value;

fn call(scratch: &Scratch, line: &str) -> Ended {
    Program::within(scratch.folder()).line("analyze").line(line).run()
}

/// The only object that a call with `--json` prints.
fn object(scratch: &Scratch, line: &str) -> Value {
    serde_json::from_str(&call(scratch, &format!("{line} --json")).good()).expect("JSON")
}

#[track_caller]
fn near(found: &Value, expected: f64, within: f64) {
    let value = found.as_f64().unwrap_or_else(|| panic!("{found} is no number"));
    assert!((value - expected).abs() <= within, "{value} is not {expected} +- {within}");
}

fn write(scratch: &Scratch, name: &str, raster: &Raster) {
    let path = scratch.path(name);
    write_raster(path, raster, &Metadata::default(), IfExists::Replace).expect("a raster");
}

#[test]
fn a_raster_gives_a_table_and_an_object_with_all_keys() {
    let scratch = Scratch::new("analyze");
    write_hills(&scratch.path("hills.tif"), 120, 90);
    let table = call(&scratch, "hills.tif").good();
    assert!(table.starts_with("hills.tif: 120 x 90 cells of 30 m, 3.6 x 2.7 km, no gaps\n"));
    for part in
        ["hypsometry   integral 0.", "spectrum     beta ", "RMS ", "drainage     exceedance"]
    {
        assert!(table.contains(part), "{part} in {table}");
    }
    let found = object(&scratch, "hills.tif");
    let keys: Vec<&String> = found.as_object().expect("an object").keys().collect();
    for key in [
        "file",
        "kind",
        "size",
        "cell_m",
        "geographic",
        "no_data_percent",
        "heights",
        "hypsometry",
        "spectrum",
        "dimension",
        "slope_deg",
        "depressions",
        "drainage",
        "notes",
    ] {
        assert!(keys.iter().any(|found| *found == key), "{key} in {keys:?}");
    }
    for (part, keys) in [
        ("hypsometry", &["integral", "stage", "a_over_d", "z"][..]),
        ("spectrum", &["rms", "r2", "beta", "beta_error", "untreated", "window"]),
        ("depressions", &["count", "area_percent", "volume"]),
        ("drainage", &["exceedance", "hack", "slope_area", "density", "horton"]),
    ] {
        for key in keys {
            assert!(found[part].get(key).is_some(), "{part}.{key} in {found}");
        }
    }
    assert_eq!(found["size"], serde_json::json!([120, 90]));
    near(&found["dimension"]["variogram"]["range_m"][0], 30.0, 1e-9);
}

/// A plane that falls 1 m in 10 m to the east: everything about it is known.
#[test]
fn a_tilted_plane_has_the_numbers_of_a_plane() {
    let scratch = Scratch::new("plane");
    let heights = (0..64 * 48).map(|cell| 100.0 - f64::from(cell % 64)).collect();
    write(&scratch, "plane.tif", &Raster::local(64, 48, 10.0, heights));
    let found = object(&scratch, "plane.tif");
    near(&found["hypsometry"]["integral"], 0.5, 1e-12);
    assert_eq!(found["hypsometry"]["stage"], "equilibrium");
    for quantile in ["mean", "p5", "median", "p95", "steepest"] {
        near(&found["slope_deg"][quantile], 0.1_f64.atan().to_degrees(), 1e-9);
    }
    assert_eq!(found["depressions"]["count"], 0);
    near(&found["dimension"]["shore"]["dimension"], 1.0, 1e-9);
    near(&found["drainage"]["largest_basin_m2"], 64.0 * 100.0, 1e-9);
    assert!(found["drainage"]["hack"].is_null());
    let notes = found["notes"].to_string();
    assert!(notes.contains("hack") && notes.contains("three bins"), "{notes}");
}

/// Map, view, spectrum and curve side by side, as picture and as text.
#[test]
fn a_folder_takes_the_numbers_and_a_figure() {
    let scratch = Scratch::new("figure");
    write_hills(&scratch.path("hills.tif"), 60, 90);
    let table = call(&scratch, "hills.tif -o out").good();
    assert!(table.ends_with("  figure       out/hills.png\n"), "{table}");
    let names = ["hills.json", "hills.png", "hills.svg"];
    let folder = scratch.path("out");
    let found: Vec<String> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    assert!(found.len() == 3 && names.iter().all(|name| found.iter().any(|f| f == name)));
    let (image, text) = Image::read_png(&folder.join("hills.png")).expect("a picture");
    assert_eq!((image.width, image.height), (4 * 800, 740 + 56));
    assert!(text.contains(&("Title".to_owned(), "hills.tif".to_owned())), "{text:?}");
    let svg = std::fs::read_to_string(folder.join("hills.svg")).unwrap();
    assert_eq!(svg.matches("<image ").count(), 3, "map, view and spectrum");
    for words in [
        "(a) map",
        "(b) view",
        "(c) spectral density",
        "(d) hypsometric curve",
        "height (m)",
        "km from the western edge",
        "RMS 0.",
        "share of the area above",
        "integral 0.",
    ] {
        assert!(svg.contains(words), "{words}");
    }
    let json = std::fs::read_to_string(folder.join("hills.json")).unwrap();
    let json: Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json, object(&scratch, "hills.tif"));
}

#[test]
fn what_is_there_is_not_overwritten_and_no_two_files_share_a_name() {
    let scratch = Scratch::new("folders");
    write_hills(&scratch.path("a.tif"), 20, 20);
    write_hills(&scratch.path("a.asc"), 20, 20);
    call(&scratch, "a.tif a.asc -o out").good();
    let names = || {
        let entries = std::fs::read_dir(scratch.path("out")).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    };
    let both = ["a-2.json", "a-2.png", "a-2.svg", "a.json", "a.png", "a.svg"];
    assert_eq!(names(), both);
    let message = call(&scratch, "a.tif -o out").refused();
    assert!(message.contains("out exists and is not empty") && message.contains("--force"));
    call(&scratch, "a.tif -o out --force").good();
    assert_eq!(names(), both);
    assert!(call(&scratch, "a.tif -o a.asc").refused().contains("is a file"));
    call(&scratch, "none.tif -o new").refused();
    assert!(!scratch.path("new").exists(), "nothing to write, no folder");
    assert_eq!(call(&scratch, "a.tif --force").status, Some(2), "--force is for -o");
}

#[test]
fn several_files_are_an_array_and_a_wrong_one_does_not_stop_the_others() {
    let scratch = Scratch::new("several");
    write_hills(&scratch.path("a.tif"), 40, 40);
    write_hills(&scratch.path("b.asc"), 40, 40);
    let ended = call(&scratch, "a.tif none.tif b.asc --json");
    assert_eq!(ended.status, Some(2));
    assert!(
        ended.stderr.starts_with("error[L0401]: cannot read none.tif: No such file"),
        "{ended:?}"
    );
    let found: Value = serde_json::from_str(&ended.stdout).expect("JSON");
    assert_eq!(found.as_array().map(Vec::len), Some(3));
    assert_eq!((&found[0]["file"], &found[2]["file"]), (&"a.tif".into(), &"b.asc".into()));
    assert_eq!(found[1]["code"], "L0401");
    assert!(found[1]["error"].as_str().is_some_and(|text| text.contains("none.tif")));
    let same = |key: &str| assert_eq!(found[0][key], found[2][key], "{key}");
    ["hypsometry", "spectrum", "depressions", "drainage"].iter().for_each(|key| same(key));
    let ended = call(&scratch, "a.tif none.tif");
    assert_eq!((ended.status, ended.stdout.lines().count() > 5), (Some(2), true));
    assert_eq!(call(&scratch, "none.tif --json").stdout, "");
}
