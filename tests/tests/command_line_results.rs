//! What is done with the results of a run: `landform export` and `landform view`.

use std::fs;

use landform::io::read_raster;
use landform::view::Image;
use landform_tests::{Ended, Program, SMALL, Scratch, write_hills};

/// A folder with a finished run in `o`.
fn finished() -> Scratch {
    let scratch = Scratch::new("results");
    scratch.write("small.ron", SMALL);
    call(&scratch, "run small.ron -o o --set outputs=[]").good();
    scratch
}

fn call(scratch: &Scratch, line: &str) -> Ended {
    Program::within(scratch.folder()).line(line).run()
}

#[test]
fn a_field_is_exported_to_every_format() {
    let scratch = finished();
    let values = read_raster(scratch.path("o/fields/sand.npy")).expect("a field").values;
    for name in ["s.npy", "s.tif", "s.tiff", "s.asc"] {
        let told = call(&scratch, &format!("export o --field sand --to {name}")).good();
        assert_eq!(told, format!("{name}\n"));
        let raster = read_raster(scratch.path(name)).expect("a raster");
        assert_eq!(raster.size(), [48, 32], "{name}");
        assert_eq!(raster.values, values, "{name}");
        assert_eq!(raster.spacing_m().ok(), Some(10.0), "{name}");
    }
    let first_bytes: [(&str, &[u8]); 6] = [
        ("s.png", b"\x89PNG"),
        ("s.raw", &(values[0] as f32).to_le_bytes()),
        ("s.glb", b"glTF"),
        ("s.ply", b"ply\n"),
        ("s.obj", b"#"),
        ("s.stl", b""),
    ];
    for (name, start) in first_bytes {
        call(&scratch, &format!("export o --field sand --to {name}")).good();
        let bytes = fs::read(scratch.path(name)).expect("a file");
        assert!(bytes.len() > 3000 && bytes.starts_with(start), "{name}: {:?}", &bytes[..8]);
    }
}

#[test]
fn exports_replace_nothing_without_force_and_refuse_what_is_not_there() {
    let scratch = finished();
    scratch.write("there.tif", "mine");
    scratch.write("there.glb", "mine");
    for (line, parts) in [
        ("export o --field sand --to there.tif", &["there.tif", "exists"][..]),
        ("export o --field sand --to there.glb", &["there.glb", "exists"]),
        ("export o --field snad --to a.tif", &["no field `snad`", "bed, sand, surface"]),
        ("export o --field ../sand --to a.tif", &["no field `../sand`"]),
        ("export nowhere --field sand --to a.tif", &["nowhere is not the output folder of a run"]),
        ("export o --field sand --to a.xyz", &[".xyz", ".tif"]),
        ("export o --field sand --to nowhere/a.tif", &["nowhere/a.tif"]),
        ("export o --field sand", &["--to <FILE>"]),
    ] {
        let message = call(&scratch, line).refused();
        for part in parts {
            assert!(message.contains(part), "{line}: {part} in {message}");
        }
    }
    assert_eq!(scratch.names(), ["o", "small.ron", "there.glb", "there.tif"]);
    assert_eq!(fs::read(scratch.path("there.tif")).unwrap(), b"mine");
    call(&scratch, "export o --field sand --to there.tif --force").good();
    assert!(read_raster(scratch.path("there.tif")).is_ok());
}

#[test]
fn runs_and_rasters_are_drawn_in_every_look() {
    let scratch = finished();
    write_hills(&scratch.path("hills.tif"), 40, 30);
    for (line, size) in [
        ("view o -o 1.png", (96, 64)),
        ("view o -o 2.png --field sand --look flat --colours batlow", (0, 64)),
        ("view hills.tif -o 3.png --exaggeration 2 --water 310", (80, 60)),
        ("view o/fields/bed.npy -o 4.png --colours viridis", (96, 64)),
    ] {
        call(&scratch, line).good();
        let file = line.split_whitespace().nth(3).expect("a file");
        let (image, _) = Image::read_png(&scratch.path(file)).expect("a picture");
        assert!(image.height >= size.1 && image.width >= size.0, "{line}: {}", image.width);
    }
    let sizes = ["1.png", "3.png"]
        .map(|file| Image::read_png(&scratch.path(file)).map(|(image, _)| image.width).ok());
    assert_eq!(sizes, [Some(96), Some(80)]);
}

#[test]
fn a_perspective_turns_with_its_camera() {
    let scratch = Scratch::new("camera");
    write_hills(&scratch.path("hills.asc"), 12, 9);
    let pictures = ["10", "100"].map(|bearing| {
        let line = format!(
            "view hills.asc -o {bearing}.png --look perspective --bearing {bearing} --pitch 40 --zoom 0.5"
        );
        call(&scratch, &line).good();
        Image::read_png(&scratch.path(&format!("{bearing}.png"))).expect("a picture").0
    });
    assert_eq!((pictures[0].width, pictures[0].height), (1280, 800));
    assert!(pictures[0].rgb != pictures[1].rgb);
}

#[test]
fn views_that_cannot_be_drawn_are_refused() {
    let scratch = finished();
    scratch.write("there.png", "mine");
    scratch.write("text.txt", "no raster");
    for (line, parts) in [
        ("view o -o there.png", &["there.png exists", "--force"][..]),
        ("view o -o a.jpg", &["a.jpg", ".png"]),
        ("view o -o a.png --colours sandy", &["no colour map `sandy`", "sand"]),
        ("view o -o a.png --field snad", &["no field `snad`", "surface"]),
        ("view o -o a.png --exaggeration -1", &["-1"]),
        ("view o -o a.png --exaggeration=nan", &["NaN"]),
        ("view o -o a.png --water=inf", &["inf"]),
        ("view o -o a.png --look perspective --zoom 0", &["zoom"]),
        ("view text.txt -o a.png", &["text.txt", ".tif"]),
        ("view nowhere.tif -o a.png", &["nowhere.tif"]),
        ("view . -o a.png", &[". is not the output folder of a run"]),
        ("view o -o nowhere/a.png", &["nowhere/a.png"]),
    ] {
        let message = call(&scratch, line).refused();
        for part in parts {
            assert!(message.contains(part), "{line}: {part} in {message}");
        }
    }
    assert_eq!(scratch.names(), ["o", "small.ron", "text.txt", "there.png"]);
}
