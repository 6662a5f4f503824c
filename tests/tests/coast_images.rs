//! Coasts as images (thesis, appendix B): the device that a scenario chooses, the equations in real
//! numbers, and what the first form of land leaves in the coast.

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

/// Lengths of shore of 4 x 4 tiles over their side, in real numbers.
fn tile_lengths(land: &[u8], side: usize) -> [[f64; 4]; 4] {
    let mut lengths = [[0.0; 4]; 4];
    let tile = side / 4;
    for y in 0..side - 1 {
        for x in 0..side - 1 {
            let at = |x: usize, y: usize| land[y * side + x];
            let [nw, ne, sw, se] = [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
            let length = match nw + ne + sw + se {
                1 | 3 => 0.5_f64.sqrt(),
                2 if nw == se => 2.0_f64.sqrt(),
                2 => 1.0,
                _ => 0.0,
            };
            lengths[y / tile][x / tile] += length / tile as f64;
        }
    }
    lengths
}

/// The nodes that fall by equation 4.2 and the weakening by shares, in real numbers.
fn falling(land: &[u8], rock: &[f64], side: usize, [force, g]: [f64; 2]) -> Vec<usize> {
    let lengths = tile_lengths(land, side);
    let between = |at: usize| {
        let place = ((at as f64 + 0.5) / (side as f64 / 4.0) - 0.5).clamp(0.0, 3.0);
        let tile = (place as usize).min(2);
        (tile, place - tile as f64)
    };
    let falls = |&node: &usize| {
        let [x, y] = [node % side, node / side];
        let beside = [(x.wrapping_sub(1), y), (x + 1, y), (x, y.wrapping_sub(1)), (x, y + 1)];
        let at_sea = |&&(x, y): &&(usize, usize)| x < side && y < side && land[y * side + x] == 0;
        let bare = beside.iter().filter(at_sea).count() as f64;
        let ((column, east), (row, south)) = (between(x), between(y));
        let along =
            |row: usize| lengths[row][column] * (1.0 - east) + lengths[row][column + 1] * east;
        let length = along(row) * (1.0 - south) + along(row + 1) * south;
        bare > 0.0 && rock[node] * (1.0 - bare / 4.0) < force / (1.0 + g * length)
    };
    (0..land.len()).filter(|&node| land[node] > 0).filter(falls).collect()
}

/// Whole numbers follow the equations: in a run to rest hardly a node falls otherwise.
#[test]
fn whole_numbers_follow_the_equations() {
    let (side, settings) = (256, ImageCoastSettings::default());
    let inside = |at: usize| (16..side - 16).contains(&at);
    let mut land: Vec<u8> =
        (0..side * side).map(|node| u8::from(inside(node % side) && inside(node / side))).collect();
    let random = RandomStream::new(1, "rock");
    let rock: Vec<f64> = (0..side * side).map(|node| random.unit(0, node, 0)).collect();
    let mut coast = ImageCoast::new([side; 2], settings, &rock).expect("a coast");
    let (mut all, mut otherwise) = (0, 0);
    loop {
        let before = land.clone();
        let expected = falling(&before, &rock, side, [settings.force, settings.attenuation]);
        let fallen = coast.step(&mut land).expect("a step");
        let agreed = expected.iter().filter(|&&node| land[node] == 0).count();
        otherwise += fallen + expected.len() - 2 * agreed;
        all += fallen;
        if fallen == 0 {
            break;
        }
    }
    println!("{otherwise} of {all} nodes fell otherwise");
    assert!(all > 5000 && otherwise <= all / 1000, "{otherwise} of {all}");
}
