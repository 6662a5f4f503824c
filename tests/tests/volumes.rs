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
