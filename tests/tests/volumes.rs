//! Scenarios on volumes: fields as arrays and as VTK image data, slices, and what is refused.

use std::fs;

use landform::io::{ReadLimits, npy};
use landform_tests::{Program, Scratch};

/// A block of 5 x 4 x 3 voxels.
const BLOCK: &str = r#"(
    title: "Block",
    seed: 3,
    domain: Volume(size: (5, 4, 3), spacing_m: 0.5),
    initial: [(field: "bed", from: WhiteNoise(mean_m: 1.0, amplitude_m: 1.0))],
    stages: [],
    metrics: [FieldStatistic(field: "bed", statistic: Maximum)],
    outputs: [
        FieldFile(file: "block.npy", field: "bed"),
        FieldFile(file: "block.vti", field: "bed"),
        Picture(file: "layer.png", field: "bed", look: Slice(at: 1.0)),
        Picture(file: "section.png", field: "bed", look: Slice(across: East, bar: false)),
    ],
)"#;

#[test]
fn a_volume_is_written_as_arrays_image_data_and_slices() {
    let scratch = Scratch::new("volume");
    scratch.write("block.ron", BLOCK);
    Program::within(scratch.folder()).line("run block.ron -o o --quiet").run().good();
    let array = npy::read_array(&scratch.path("o/block.npy"), &ReadLimits::default());
    let array = array.expect("an array");
    assert_eq!(array.shape, [3, 4, 5]);
    let fields = npy::read_array(&scratch.path("o/fields/bed.npy"), &ReadLimits::default());
    assert_eq!(fields.expect("the final field").values, array.values);
    let image = fs::read(scratch.path("o/block.vti")).expect("image data");
    let extent = br#"WholeExtent="0 4 0 3 0 2" Origin="0 0 0" Spacing="0.5 0.5 0.5""#;
    assert!(image.windows(extent.len()).any(|bytes| bytes == extent));
    // The first values of image data are the southern row of the lowest layer.
    let south: Vec<u8> = array.values[15..20].iter().flat_map(|v| v.to_le_bytes()).collect();
    assert!(image.windows(south.len()).any(|bytes| bytes == south));
    let section = fs::read(scratch.path("o/section.png")).expect("a picture");
    // Four rows and three layers of six pixels a voxel; width and height stand after the signature.
    assert_eq!(section[16..24], [0, 0, 0, 24, 0, 0, 0, 18]);
}

#[test]
fn maps_of_volumes_are_refused() {
    let scratch = Scratch::new("volume_refused");
    for (from, to, message) in [
        ("Slice(at: 1.0)", "Relief()", "the look Slice"),
        ("block.npy", "block.tif", ".npy or .vti"),
        ("FieldFile(file: \"block.npy\"", "Mesh(file: \"block.glb\"", "a domain with two sizes"),
        ("(5, 4, 3)", "(5, 4, 0)", "axis z has 0 nodes"),
        ("(5, 4, 3)", "(99999, 99999, 99999)", "domain"),
    ] {
        scratch.write("block.ron", BLOCK.replacen(from, to, 1));
        let said = Program::within(scratch.folder()).line("check block.ron").run().refused();
        assert!(said.contains(message), "{to}: {said}");
    }
}

/// Passages along a plane between two kinds of noise: what other programs read of them.
#[test]
fn passages_are_written_as_meshes_and_surveys() {
    let scratch = Scratch::new("passages");
    let outputs = r#"FieldFile(file: "block.npy", field: "bed"),
        VoxelMesh(file: "cave.glb", field: "bed", at_least: 1.0, smoothing: 1),
        VoxelMesh(file: "cave.obj", field: "bed", at_least: 1.0),
        Centreline(file: "cave.svx", field: "bed", at_least: 1.0),
        Centreline(file: "cave.th", field: "bed", at_least: 1.0),
        Centreline(file: "cave.csv", field: "bed", at_least: 1.0),"#;
    let text = BLOCK.replace("(5, 4, 3)", "(20, 16, 12)");
    let text = text.replace("FieldFile(file: \"block.npy\", field: \"bed\"),", outputs);
    let metrics = "CaveShape(field: \"bed\", at_least: 1.0, near_m: 2.0)]";
    scratch.write(
        "block.ron",
        text.replace("FieldStatistic(field: \"bed\", statistic: Maximum)]", metrics),
    );
    Program::within(scratch.folder()).line("run block.ron -o o --quiet").run().good();
    let read = |file: &str| fs::read_to_string(scratch.path(file)).expect("text");
    let report: serde_json::Value = serde_json::from_str(&read("o/report.json")).expect("JSON");
    let measured = |name: &str| report["metrics"][name].as_f64().expect("a number");
    // Half of the voxels of half a metre.
    assert!((measured("cave_volume_m3") - 20.0 * 16.0 * 12.0 / 16.0).abs() < 20.0);
    let numbers = |line: &str| -> Vec<f64> {
        line.split([' ', ',']).filter_map(|word| word.parse().ok()).collect()
    };
    // Legs of the survey are the differences of the stations of the table.
    let table: Vec<Vec<f64>> = read("o/cave.csv").lines().skip(1).map(numbers).collect();
    let survey = read("o/cave.svx");
    let legs = survey.lines().skip_while(|line| !line.starts_with("*data cartesian")).skip(1);
    let legs: Vec<Vec<f64>> = legs.take_while(|line| !line.starts_with('*')).map(numbers).collect();
    assert!(legs.len() > 20 && legs.len() == table.len());
    for (leg, row) in legs.iter().zip(&table) {
        assert_eq!(leg[..2], row[..2]);
        for axis in 0..3 {
            assert!((leg[2 + axis] - (row[5 + axis] - row[2 + axis])).abs() < 6e-4);
        }
    }
    let walls = survey.lines().skip_while(|line| !line.starts_with("*data passage")).skip(1);
    let stations = walls.take_while(|line| !line.starts_with('*')).count();
    let highest = table.iter().flat_map(|row| [row[0], row[1]]).fold(0.0, f64::max);
    assert_eq!(stations, highest as usize);
    assert!(read("o/cave.th").contains("data dimensions station left right up down"));
    // A closed surface: every vertex of the text is used, and faces are three to two edges.
    let mesh = read("o/cave.obj");
    let count = |start: &str| mesh.lines().filter(|line| line.starts_with(start)).count();
    assert!(count("v ") > 1000 && count("f ") % 2 == 0);
    assert!(fs::read(scratch.path("o/cave.glb")).expect("a mesh").starts_with(b"glTF"));
    let nothing = text.replace("at_least: 1.0, smoothing: 1", "at_least: 9.0");
    scratch.write("block.ron", nothing);
    let said = Program::within(scratch.folder()).line("run block.ron -o p --quiet").run();
    assert!(said.stderr.contains("no voxel of `bed` is at least 9"), "{}", said.stderr);
}
