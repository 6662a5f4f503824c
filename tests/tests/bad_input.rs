//! Scenarios that must be refused: exit status 2, a message with file, place, what is wrong and
//! what would be right, nothing on standard output, no folder left, never a panic.

use landform_tests::{Program, SMALL, Scratch, changed};

/// Refuses `text` as `bad.ron` and returns the message.
#[track_caller]
fn refused(text: &str) -> String {
    let scratch = Scratch::new("bad_input");
    scratch.write("bad.ron", text);
    let message = Program::within(scratch.folder()).line("run bad.ron -o o").run().refused();
    assert_eq!(scratch.names(), ["bad.ron"], "nothing is left behind: {message}");
    message
}

/// Refuses the small scenario with `from` replaced by `to`; the message has every part.
#[track_caller]
fn case(from: &str, to: &str, parts: &[&str]) {
    let message = refused(&changed(from, to));
    for part in parts {
        assert!(message.contains(part), "`{to}`: no `{part}` in\n{message}");
    }
}

#[test]
fn text_that_is_no_scenario() {
    for (text, parts) in [
        ("", &["bad.ron"][..]),
        ("\n\n  // nothing\n", &["bad.ron"]),
        ("hello", &["bad.ron:1:1"]),
        ("{\"title\": \"JSON\"}", &["bad.ron:1:"]),
        ("(title: \"a\"", &["bad.ron:1:"]),
        ("(title: \"a)", &["bad.ron:1:"]),
        ("()", &["bad.ron:1:", "title"]),
        ("(title: \"a\", domain: Grid())", &["bad.ron:1:", "stages"]),
        ("(title: \"a\", domain: Grid(), stages: [(processes: [])])", &["no process"]),
        ("[1, 2, 3]", &["bad.ron:1:"]),
        ("\u{0}\u{1}\u{2}", &["bad.ron:1:1"]),
    ] {
        let message = refused(text);
        for part in parts {
            assert!(message.contains(part), "{text:?}: no `{part}` in\n{message}");
        }
    }
    let cut = &SMALL[..SMALL.len() / 2];
    assert!(refused(cut).contains("bad.ron:"), "a truncated scenario");
    assert!(refused(&format!("{SMALL} rest")).contains("bad.ron:22:"), "text after the end");
}

#[test]
fn bytes_that_are_no_text() {
    let scratch = Scratch::new("bytes");
    scratch.write("bad.ron", [0x89, b'P', b'N', b'G', 0xff, 0, 0xfe]);
    let message = Program::within(scratch.folder()).line("run bad.ron").run().refused();
    assert!(message.contains("bad.ron is not text in UTF-8"), "{message}");
    assert_eq!(scratch.names(), ["bad.ron"]);
}

#[test]
fn nesting_deeper_than_any_reader() {
    for (open, close) in [("(", ")"), ("[", "]"), ("{1:", "}"), ("Some(", ")")] {
        for depth in [200, 100_000] {
            let value = format!("{}{}", open.repeat(depth), close.repeat(depth));
            let message = refused(&changed("Smoothing()", &value));
            assert!(message.contains("bad.ron:"), "{open} {depth}: {message}");
            assert!(message.len() < 3000, "a message of {} bytes", message.len());
        }
    }
    let any = format!("{}Finished{}", "Any([".repeat(100), "])".repeat(100));
    assert!(refused(&changed("Iterations(6)", &any)).contains("bad.ron:9:"));
}

#[test]
fn unknown_names_are_refused_with_the_nearest() {
    case("Dunes(", "Dnes(", &["unknown process `Dnes`", "bad.ron:9:36", "did you mean \"Dunes\"?"]);
    case("WhiteNoise(", "WhiteNose(", &["unknown initial condition `WhiteNose`", "bad.ron:6:"]);
    case("WhiteNoise(", "WhiteNose(", &["did you mean \"WhiteNoise\"?", "one of "]);
    case("domain: Grid(", "domain: Gird(", &["unknown domain `Gird`", "\"Grid\"?", "bad.ron:4:13"]);
    case("DuneActivity", "DuneActivty", &["unknown metric `DuneActivty`", "\"DuneActivity\"?"]);
    case("Mesh(", "Mash(", &["unknown output `Mash`", "did you mean \"Mesh\"?", "bad.ron:19:"]);
    case("(field: \"sand\", from", "(field: \"sant\", from", &["no field is called `sant`"]);
    case("(field: \"sand\", from", "(field: \"sant\", from", &["\"sand\"?", "bad.ron:6:17"]);
    case("slab_m:", "slab:", &["unknown field \"slab\"", "bad.ron:9:", "\"slab_m\"?"]);
    case("seed: 3", "sead: 3", &["unknown field \"sead\"", "bad.ron:3:5", "\"seed\"?"]);
    case("(Periodic, Periodic)", "(Periodic, Closed)", &["Closed", "Open", "bad.ron:4:"]);
    case("Iterations(6)", "Iteration(6)", &["Iteration", "Iterations", "bad.ron:9:"]);
    case("Maximum", "Largest", &["Largest", "Maximum", "bad.ron:12:"]);
}

#[test]
fn fields_that_no_process_has() {
    let parts =
        ["metrics[0].field: no field is called `snad`", "did you mean \"sand\"?", "bad.ron:12"];
    case("FieldStatistic(field: \"sand\"", "FieldStatistic(field: \"snad\"", &parts);
    let parts = ["outputs[4].field: no field is called `water`", "bad.ron:18:", "one of "];
    case("file: \"surface.tif\"", "file: \"surface.tif\", field: \"water\"", &parts);
    let parts = ["field `surface` is computed from others", "a stored field", "bad.ron:6:"];
    case("(field: \"sand\", from", "(field: \"surface\", from", &parts);
}

#[test]
fn metrics_that_cannot_be_measured() {
    let error = |part: &str| format!("DuneActivity(), ProtectionError({part})");
    let weight = ["metrics[2]", "sum of weights is 0", "bad.ron:12:"];
    case("DuneActivity()", &error("wind: (weight: 0.0)"), &weight);
    let share = ["metrics[2]", "share is 1", "between 0 and 0.5", "bad.ron:12:"];
    case("DuneActivity()", &error("flanks: (share: 1.0)"), &share);
}

#[test]
fn values_of_a_wrong_type() {
    for (from, to, place) in [
        ("seed: 3", "seed: \"three\"", "bad.ron:3:11"),
        ("seed: 3", "seed: -3", "bad.ron:3:"),
        ("seed: 3", "seed: 1.5", "bad.ron:3:"),
        ("seed: 3", "seed: 99999999999999999999999", "bad.ron:3:"),
        ("slab_m: 3.0", "slab_m: \"3.0\"", "bad.ron:9:"),
        ("slab_m: 3.0", "slab_m: (3.0)", "bad.ron:9:"),
        ("(48, 32)", "48", "bad.ron:4:"),
        ("(48, 32)", "(48, 32, 5)", "bad.ron:4:"),
        ("(48, 32)", "(48.5, 32)", "bad.ron:4:"),
        ("(48, 32)", "(-48, 32)", "bad.ron:4:"),
        ("title: \"Small dunes\"", "title: 5", "bad.ron:2:"),
        ("outputs: [", "outputs: 5, x: [", "bad.ron:13:"),
        ("Mesh(file: \"surface.glb\")", "5", "bad.ron:19:"),
        ("processes: [Smoothing()]", "processes: Smoothing()", "bad.ron:10:"),
    ] {
        case(from, to, &["error[L", place]);
    }
    case("seed: 3", "seed: 3, seed: 4", &["seed", "bad.ron:3:"]);
}

#[test]
fn numbers_out_of_their_range() {
    let slab = "stages[0].processes[0].slab_m: -5 is out of range";
    case("slab_m: 3.0", "slab_m: -5.0", &[slab, "at least 1e-9, at most 1e9", "bad.ron:9:50"]);
    let repose = "slab_m: 3.0, repose_deg: 120.0";
    case("slab_m: 3.0", repose, &["repose_deg: 120 is out of range", "at most 89", "bad.ron:9:"]);
    let steep = ["slab_m is 30 m", "use a lower slab", "bad.ron:9:"];
    case("slab_m: 3.0", "slab_m: 30.0", &steep);
    case("slab_m: 3.0", "slab_m: 3.0, winds: []", &["the rose has no winds", "bad.ron:9:"]);
    let feed = "slab_m: 3.0, feed_slabs: 5.0";
    case("slab_m: 3.0", feed, &["no border is open", "bad.ron:9:"]);
    case("mean_m: 20.0", "mean_m: 1e13", &["initial[0].from.mean_m", "bad.ron:6:"]);
    case("mean_m: 20.0", "mean_m: -20.0", &["field `sand` starts with -", "at least 0 m"]);
    case("spacing_m: 10.0", "spacing_m: 0.0", &["domain.spacing_m: 0", "bad.ron:4:"]);
    case("every: 2", "every: 0", &["outputs[3].every: 0 is out of range", "bad.ron:17:"]);
    let look = "file: \"map.png\", look: Relief(pixels_per_node: -1.0)";
    case("file: \"map.png\"", look, &["outputs[0].look.pixels_per_node: -1", "bad.ron:14:"]);
    case("seed: 3", "measure_every: 0", &["measure_every", "at least 1", "bad.ron:3:"]);
}

#[test]
fn numbers_that_are_none() {
    for number in ["NaN", "inf", "-inf", "1e400", "-1e400"] {
        for (from, to) in [
            ("slab_m: 3.0", format!("slab_m: {number}")),
            ("slab_m: 3.0", format!("slab_m: 3.0, winds: [(towards_deg: {number})]")),
            ("mean_m: 20.0", format!("mean_m: {number}")),
            ("spacing_m: 10.0", format!("spacing_m: {number}")),
            (
                "file: \"map.png\"",
                format!("file: \"map.png\", look: Relief(range_m: (0.0, {number}))"),
            ),
            (
                "file: \"map.png\"",
                format!("file: \"map.png\", look: Relief(water_level_m: {number})"),
            ),
            ("Iterations(6)", format!("Below(metric: \"sand_maximum_m\", value: {number})")),
            ("Iterations(6)", format!("Steady(metric: \"a\", change: {number}, measurements: 3)")),
        ] {
            case(from, &to, &["error[L", "bad.ron:"]);
        }
    }
}

#[test]
fn sizes_that_cannot_be() {
    for (size, what) in [
        ("(0, 32)", "axis x has 0 nodes"),
        ("(0, 0)", "axis x has 0 nodes"),
        ("(1, 1)", "axis x has 1 nodes"),
        ("(48, 2)", "axis y has 2 nodes"),
    ] {
        case("(48, 32)", size, &[what, "bad.ron:4:24", "at least"]);
    }
    let open = changed("boundary: (Periodic, Periodic)", "boundary: (Open, Open)");
    let message = refused(&open.replace("(48, 32)", "(1, 1)"));
    assert!(message.contains("1 x 1 nodes span no surface"), "{message}");
    assert!(message.contains("bad.ron:14:"), "the first picture cannot be drawn: {message}");
}

#[test]
fn stages_that_never_end_or_never_begin() {
    case(", stop: Iterations(6)", "", &["the stage never ends", "bad.ron:9:", "Iterations(100)"]);
    case("Iterations(6)", "Iterations(0)", &["zero iterations", "at least one", "bad.ron:9:"]);
    case("Iterations(6)", "Any([])", &["no rule is given", "bad.ron:9:"]);
    let one = "Steady(metric: \"sand_maximum_m\", change: 0.1, measurements: 1)";
    case("Iterations(6)", one, &["one measurement cannot be steady", "bad.ron:9:"]);
    case("processes: [Smoothing()]", "processes: []", &["no process", "bad.ron:10:"]);
    let nothing = changed("Iterations(6)", "Above(metric: \"a\", value: 1.0)").replace(
        "metrics: [FieldStatistic(field: \"sand\", statistic: Maximum), DuneActivity()],",
        "",
    );
    assert!(refused(&nothing).contains("the scenario measures none"));
}

#[test]
fn one_process_twice_in_a_stage() {
    let parts = ["`Smoothing` stands twice in one stage", "bad.ron:10:", "a stage of its own"];
    case("processes: [Smoothing()]", "processes: [Smoothing(), Smoothing()]", &parts);
}

#[test]
fn outputs_that_cannot_be_written() {
    for name in ["../map.png", "/tmp/map.png", "a/../../map.png", "..", ".", "", "a/.."] {
        let parts = ["leads out of the output folder", "outputs[0].file", "bad.ron:14:"];
        case("\"map.png\"", &format!("{name:?}"), &parts);
    }
    case("\"map.png\"", "\"map.jpg\"", &["`map.jpg` ends in no format", ".png", "bad.ron:14:"]);
    case("\"growth.apng\"", "\"growth.avi\"", &["`growth.avi`", ".gif", "bad.ron:17:"]);
    case("\"surface.tif\"", "\"surface.xyz\"", &["`surface.xyz`", ".asc", "bad.ron:18:"]);
    case("\"surface.glb\"", "\"surface\"", &["`surface`", ".stl", "bad.ron:19:"]);
    case("\"map.png\"", "\"fields/map.png\"", &["folder of the final fields", "bad.ron:14:"]);
    case("\"panels.png\"", "\"map.png\"", &["outputs[0] writes `map.png` already", "bad.ron:16:"]);
    let sandy = "file: \"map.png\", look: Relief(colours: \"sandy\")";
    case("file: \"map.png\"", sandy, &["no colour map `sandy`", "batlow", "bad.ron:14:"]);
    let mesh = "file: \"surface.glb\", colours: \"sandy\"";
    case("file: \"surface.glb\"", mesh, &["no colour map `sandy`", "bad.ron:19:"]);
    let parts = ["100000 x 100000 pixels", "outputs[1].look", "bad.ron:15:"];
    case("size: (96, 64)", "size: (100000, 100000)", &parts);
    case("size: (96, 64)", "size: (0, 64)", &["0 x 64 pixels", "bad.ron:15:"]);
}
