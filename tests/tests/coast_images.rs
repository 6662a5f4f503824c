//! Coasts as images (thesis, appendix B): the device that a scenario chooses, and what the first
//! form of land leaves in the coast.

use landform::coast::image::{ImageCoast, ImageCoastSettings};
use landform::sim::random::RandomStream;
use landform_tests::{Program, Scratch};

/// A small coast at rest, whose device is still to be named.
const COAST: &str = r#"(
    title: "Small coast",
    domain: Grid(size: (96, 64), connectivity: Four),
    initial: [
        (field: "land", from: StartingLand()),
        (field: "resistance", from: WhiteNoise(mean_m: 0.5, amplitude_m: 0.5)),
    ],
    stages: [(
        processes: [ImageCoastErosion(force: 0.55, device: DEVICE)],
        stop: Below(metric: "image_coast_events", value: 0.5),
    )],
    metrics: [ImageCoastActivity(), Islands()],
)"#;

fn scratch() -> Scratch {
    let scratch = Scratch::new("coast-images");
    for device in ["Processor", "Graphics"] {
        scratch.write(&format!("{device}.ron"), COAST.replace("DEVICE", device));
    }
    scratch
}

#[test]
#[cfg(not(feature = "gpu"))]
fn a_device_that_is_not_in_the_program_is_refused_where_it_is_named() {
    let scratch = scratch();
    for command in ["run Graphics.ron -o o", "check Graphics.ron"] {
        let message = Program::within(scratch.folder()).line(command).run().refused();
        for part in ["Graphics.ron:9:60", "--features gpu", "device: Processor"] {
            assert!(message.contains(part), "{command}, {part}: {message}");
        }
    }
    assert!(!scratch.path("o").exists());
    Program::within(scratch.folder()).line("run Processor.ron -o o --quiet").run().good();
}

#[test]
#[cfg(feature = "gpu")]
fn a_device_is_named_and_leaves_the_same_files() {
    use std::fs;

    let scratch = scratch();
    let run = |device: &str| {
        let line = format!("run {device}.ron -o {device} --quiet");
        Program::within(scratch.folder()).line(&line).run()
    };
    let ended = run("Graphics");
    if ended.stderr.contains("no graphics processor was found") {
        assert!(ended.stderr.contains("device: Processor"), "{ended:?}");
        return println!("NOT TESTED: {}", ended.stderr);
    }
    let told = ended.stderr.clone();
    ended.good();
    run("Processor").good();
    for file in ["fields/land.npy", "series.csv"] {
        let [here, there] = ["Processor", "Graphics"]
            .map(|device| fs::read(scratch.path(device).join(file)).expect("a file"));
        assert!(here == there, "{file}");
    }
    let report = fs::read_to_string(scratch.path("Graphics/report.json")).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
    let note = report["notes"][0].as_str().expect("a note");
    assert!(note.starts_with("ImageCoastErosion runs on "), "{note}");
    assert!(told.contains(note), "{told}");
}

/// How square land is about the middle of a square map, by its moments of the fourth order: 3/7
/// for a square with the directions of the map, 0 for a disc, -3/7 for a square on its corner.
fn squareness(land: &[u8], side: usize) -> f64 {
    let (mut square, mut all) = (0.0, 0.0);
    for node in (0..land.len()).filter(|&node| land[node] > 0) {
        let [x, y] = [node % side, node / side].map(|at| at as f64 + 0.5 - 0.5 * side as f64);
        square += 6.0 * x * x * y * y - x.powi(4) - y.powi(4);
        all += (x * x + y * y).powi(2);
    }
    square / all
}

/// Section B.1.3 of the thesis: few tiles leave the initial shape noticeable. Square land stays
/// square. A disc becomes a square on its corner: the tiles in the corners of the map hold least of
/// its shore, so the sea is strongest there.
#[test]
fn the_first_form_of_land_shows_in_the_coast() {
    let side = 512;
    let inside = |node: usize, round: bool| {
        let [x, y] = [node % side, node / side].map(|at| at as f64 + 0.5 - 256.0);
        if round { x.hypot(y) < 224.0 } else { x.abs().max(y.abs()) < 224.0 }
    };
    let squareness_of = |round: bool, g: f64, seed: u64| {
        let mut land: Vec<u8> =
            (0..side * side).map(|node| u8::from(inside(node, round))).collect();
        let first = squareness(&land, side);
        let random = RandomStream::new(seed, "rock");
        let rock: Vec<f64> = (0..side * side).map(|node| random.unit(0, node, 0)).collect();
        let settings = ImageCoastSettings { attenuation: g, ..ImageCoastSettings::default() };
        let mut coast = ImageCoast::new([side; 2], settings, &rock).expect("a coast");
        assert!(coast.run(&mut land, 2000).expect("a run") < 2000);
        [first, squareness(&land, side)]
    };
    for seed in 1..=5 {
        let [[disc, round], [square, edged]] =
            [(true, 0.12), (false, 0.15)].map(|(round, g)| squareness_of(round, g, seed));
        assert!(disc.abs() < 1e-3 && (square - 3.0 / 7.0).abs() < 1e-3, "{disc} {square}");
        println!("seed {seed}: {round:.3} from a disc, {edged:.3} from a square");
        assert!(round < -0.2 && edged > 0.3, "{round} {edged}");
    }
}
