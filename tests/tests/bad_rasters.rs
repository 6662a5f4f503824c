//! Rasters that a scenario cannot start from.

use std::fs;

use landform::io::{IfExists, Metadata, Raster, write_raster};
use landform_tests::{Program, Scratch, hills, write_hills};

const SCENARIO: &str = r#"(
    title: "On a raster",
    domain: Raster(path: "dem.tif"),
    initial: [
        (field: "bed", from: DomainRaster()),
        (field: "sand", from: Uniform(value: 4.0)),
    ],
    stages: [(processes: [Dunes(slab_m: 3.0)], stop: Iterations(2))],
    outputs: [FieldFile(file: "surface.tif")],
)"#;

fn run(scratch: &Scratch, sets: &[&str]) -> landform_tests::Ended {
    scratch.write("raster.ron", SCENARIO);
    let sets = sets.iter().flat_map(|set| ["--set", set]);
    Program::within(scratch.folder()).args(["run", "raster.ron", "-o", "o"]).args(sets).run()
}

#[track_caller]
fn refused(scratch: &Scratch, sets: &[&str], parts: &[&str]) {
    let message = run(scratch, sets).refused();
    for part in parts {
        assert!(message.contains(part), "{sets:?}: no `{part}` in\n{message}");
    }
    assert!(!scratch.path("o").exists(), "no folder is left: {message}");
}

#[test]
fn a_good_raster_keeps_its_place_from_file_to_file() {
    let scratch = Scratch::new("good_raster");
    let mut raster = hills(30, 20);
    let place = raster.georeference.as_mut().expect("a place");
    (place.west, place.north) = (500_000.0, 4_200_000.0);
    let metadata = Metadata::default();
    write_raster(scratch.path("dem.tif"), &raster, &metadata, IfExists::Refuse).unwrap();
    run(&scratch, &[]).good();
    let left = landform::io::read_raster(scratch.path("o/surface.tif")).expect("a raster");
    let left = left.georeference.expect("a place");
    assert_eq!((left.west, left.north, left.cell_size), (500_000.0, 4_200_000.0, [30.0; 2]));
}

#[test]
fn missing_files_and_other_things_than_rasters() {
    let scratch = Scratch::new("no_raster");
    fs::create_dir(scratch.path("folder.tif")).unwrap();
    scratch.write("text.tif", "no TIFF at all");
    scratch.write("empty.tif", "");
    scratch.write("picture.jpg", [0xff, 0xd8, 0xff, 0xe0]);
    refused(&scratch, &[], &["domain.path", "dem.tif", "No such file", "raster.ron:3:"]);
    let none = ["no raster is given", "a GeoTIFF", "--set domain.path=FILE"];
    refused(&scratch, &["domain.path="], &none);
    for name in ["folder.tif", "text.tif", "empty.tif"] {
        refused(&scratch, &[&format!("domain.path={name}")], &["domain.path", name]);
    }
    let known = ["picture.jpg", ".tif, .tiff, .asc, .npy"];
    refused(&scratch, &["domain.path=picture.jpg"], &known);
}

#[test]
fn truncated_and_damaged_files() {
    let scratch = Scratch::new("damaged");
    for name in ["dem.tif", "dem.asc", "dem.npy"] {
        write_hills(&scratch.path(name), 40, 30);
        let whole = fs::read(scratch.path(name)).unwrap();
        for length in [3, 20, whole.len() / 2, whole.len() - 20] {
            scratch.write(name, &whole[..length]);
            let set = format!("domain.path={name}");
            refused(&scratch, &[&set, "domain.spacing_m=30.0"], &["domain.path", name]);
        }
    }
}

#[test]
fn rasters_without_values() {
    let scratch = Scratch::new("gaps");
    let mut raster = hills(30, 20);
    raster.values[45] = f64::NAN;
    raster.no_data = Some(-9999.0);
    let write = |raster: &Raster| {
        write_raster(scratch.path("dem.tif"), raster, &Metadata::default(), IfExists::Replace)
            .expect("a raster can be written");
    };
    write(&raster);
    refused(&scratch, &[], &["domain.path", "dem.tif", "gaps: Lowest", "raster.ron:3:"]);
    let told = run(&scratch, &["domain.gaps=Lowest"]).good();
    assert!(told.contains("note: 1 cells without data were set to"), "{told}");
    fs::remove_dir_all(scratch.path("o")).unwrap();
    raster.values.fill(f64::NAN);
    write(&raster);
    refused(&scratch, &["domain.gaps=Lowest"], &["all 600 cells are without data"]);
}

#[test]
fn headers_that_claim_the_absurd() {
    let scratch = Scratch::new("absurd");
    let header = |columns: &str, rows: &str, cell: &str| {
        format!(
            "ncols {columns}\nnrows {rows}\nxllcorner 0\nyllcorner 0\ncellsize {cell}\n1 2\n3 4\n"
        )
    };
    for (columns, rows, cell) in [
        ("1000000000", "1000000000", "30"),
        ("99999999999999999999", "2", "30"),
        ("-2", "2", "30"),
        ("0", "2", "30"),
        ("2", "2", "0"),
        ("2", "2", "-30"),
        ("2", "2", "nan"),
        ("two", "2", "30"),
        ("3", "2", "30"),
    ] {
        scratch.write("dem.asc", header(columns, rows, cell));
        refused(&scratch, &["domain.path=dem.asc"], &["domain.path", "dem.asc"]);
    }
    scratch.write("dem.asc", header("2", "2", "30").replace('4', "four"));
    refused(&scratch, &["domain.path=dem.asc"], &["dem.asc", "four"]);
    scratch.write("dem.asc", header("2", "2", "30").replace('4', "1e39"));
    refused(&scratch, &["domain.path=dem.asc"], &["domain.path"]);
}

#[test]
fn parameters_that_do_not_suit_the_raster() {
    let scratch = Scratch::new("unsuited");
    write_hills(&scratch.path("dem.tif"), 30, 20);
    refused(&scratch, &["domain.every=0"], &["domain.every: 0 is out of range", "at least 1"]);
    refused(&scratch, &["domain.spacing_m=-1.0"], &["domain.spacing_m: -1 is out of range"]);
    refused(&scratch, &["domain.spacing_m=NaN"], &["domain", "spacing"]);
    refused(
        &scratch,
        &["domain=Grid(size: (30, 20))"],
        &["the domain comes from no raster", "Raster(path: ...)"],
    );
    refused(
        &scratch,
        &["domain=Grid(size: (31, 20))", "initial[0].from=RasterFile(path: \"dem.tif\")"],
        &["dem.tif has 30 columns and 20 rows", "31 columns and 20 rows"],
    );
    let sparse = ["domain.every=1000", "stages[0].processes.Dunes.slab_m=3.0"];
    let ended = run(&scratch, &sparse);
    assert_eq!(ended.status, Some(0), "a single node is a domain like any other: {ended:?}");
}
