//! Bad input and bad outputs are refused with a message that says where, what was expected
//! and what to do.

mod support;

use std::fs;
use std::path::PathBuf;

use landform_io::mesh::height_mesh;
use landform_io::{
    Georeference, IfExists, Metadata, Raster, ReadLimits, esri_ascii, read_raster,
    read_raster_file, write_mesh, write_raster,
};
use support::Scratch;

/// The message of reading `bytes` as `name`; it must name the file.
fn message(folder: &Scratch, name: &str, bytes: impl AsRef<[u8]>) -> String {
    let path = folder.path(name);
    fs::write(&path, bytes).unwrap();
    let message = read_raster(&path).unwrap_err().to_string();
    assert!(message.contains(name), "{message}");
    message
}

fn assert_says(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "no {part:?} in: {message}");
    }
}

const HEADER: &str = "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n";

#[test]
fn grids_that_contradict_themselves() {
    let folder = Scratch::new("bad_grids");
    let cases: &[(&str, String, &[&str])] = &[
        ("no key", HEADER.replace("nrows 2\n", ""), &["no nrows", "add the line"]),
        ("no size", HEADER.replace("cellsize 10\n", ""), &["no cellsize"]),
        ("no corner", HEADER.replace("xllcorner 0\n", ""), &["no xllcorner"]),
        (
            "twice",
            HEADER.replace("nrows 2", "nrows 2\nNROWS 2"),
            &["line 3", "nrows is given twice"],
        ),
        ("both", HEADER.replace("nrows", "xllcenter 5\nnrows"), &["line 2", "both xllcorner"]),
        (
            "negative",
            HEADER.replace("ncols 3", "ncols -3"),
            &["line 1", "ncols is -3", "at least 1"],
        ),
        ("fraction", HEADER.replace("ncols 3", "ncols 2.5"), &["line 1", "ncols is 2.5"]),
        ("zero", HEADER.replace("size 10", "size 0"), &["line 5", "cellsize is 0", "positive"]),
        ("nan", HEADER.replace("size 10", "size nan"), &["line 5", "cellsize is NaN"]),
        ("inf", HEADER.replace("xllcorner 0", "xllcorner inf"), &["line 3", "xllcorner is inf"]),
        ("word", HEADER.replace("nrows 2", "nrows two"), &["line 2", "\"two\" is not a number"]),
        ("unknown", HEADER.replace("nrows", "nlines"), &["line 2", "\"nlines\"", "one of ncols"]),
    ];
    for (name, header, parts) in cases {
        assert_says(&message(&folder, name, format!("{header}1 2 3\n4 5 6\n")), parts);
    }
}

#[test]
fn grids_with_wrong_numbers() {
    let folder = Scratch::new("bad_numbers");
    let grid = |rows: &str| message(&folder, "a.asc", format!("{HEADER}{rows}"));
    assert_says(&grid("1 2 3\n4 5\n"), &["line 8", "end after 5", "6 numbers", "cut off"]);
    assert_says(&grid("1 2 3\n4 5 6\n7\n"), &["line 8", "more numbers", "correct ncols or nrows"]);
    assert_says(&grid("1 2 3\n4 x5 6\n"), &["line 7", "\"x5\" is not a number"]);
    assert_says(&grid("1,5 2,5 3\n4 5 6"), &["line 6", "\"1,5\"", "decimals with a point"]);
    assert_says(&grid("1 2 3\n4 inf 6\n"), &["column 1, row 1", "inf", "no data"]);
    assert_says(&grid("1 2 3\n-3.4e38 5 6"), &["column 0, row 1", "declare it as no data"]);
    assert_says(&grid("nan nan nan\nnan nan nan"), &["all 6 cells are without data"]);
    let gaps = format!("{HEADER}nodata_value -1\n-1 -1 -1 -1 -1 -1");
    assert_says(
        &message(&folder, "a.asc", gaps),
        &["all 6 cells are without data", "no-data value"],
    );
    assert_says(&grid("1 2 \u{fffd} 4"), &["line 6", "is not a number"]);
    assert_says(&message(&folder, "a.asc", ""), &["no ncols"]);
    assert_says(&message(&folder, "a.asc", "ncols"), &["ends after ncols"]);
    assert_says(&message(&folder, "a.asc", [0xff; 5000]), &["is not a number"]);
}

#[test]
fn variants_of_grids_that_are_right() {
    let folder = Scratch::new("good_grids");
    let read = |text: &str| {
        fs::write(folder.path("a.asc"), text).unwrap();
        read_raster(folder.path("a.asc")).unwrap()
    };
    let plain = read(&format!("{HEADER}1 2 3\n4 5 6\n"));
    assert_eq!(plain.values, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!(plain.georeference.as_ref().map(|place| place.north), Some(20.0));
    assert_eq!(read(&format!("{HEADER}1 2 3\n4 5 6").replace('\n', "\r\n")), plain);
    assert_eq!(read(&format!("{HEADER}1 2 3 4\n5\t6 \n\n")), plain);
    let centre = read("NROWS 2 NCOLS 3 XLLCENTER 5 YLLCENTER 5 CELLSIZE 10 1 2 3 4 5 6");
    assert_eq!(
        centre.georeference.as_ref().map(|place| (place.west, place.north)),
        Some((0.0, 20.0))
    );
    let oblong = read("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ndx 10\ndy 5\n1 2 3 4 5 6");
    assert!(oblong.spacing_m().unwrap_err().to_string().contains("not square"));
}

/// Nothing of the claimed size is allocated: the limit and the length of the file come first.
#[test]
fn absurd_sizes_are_refused_at_once() {
    let folder = Scratch::new("absurd");
    let huge = HEADER.replace("ncols 3", "ncols 1000000000").replace("nrows 2", "nrows 1000000000");
    assert_says(
        &message(&folder, "a.asc", &huge),
        &["1000000000 x 1000000000", "limit of 268435456"],
    );
    let endless = HEADER.replace("ncols 3", "ncols 1e300");
    assert_says(&message(&folder, "a.asc", &endless), &["line 1", "whole number"]);
    let large = HEADER.replace("ncols 3", "ncols 16000").replace("nrows 2", "nrows 16000");
    assert_says(
        &message(&folder, "a.asc", large + "1 2"),
        &["bytes for 256000000 cells", "cut off"],
    );
    let array = |shape: &str| {
        let text = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}\n");
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((text.len() as u16).to_le_bytes());
        bytes.extend(text.as_bytes());
        message(&folder, "a.npy", bytes)
    };
    assert_says(&array("(4294967296, 4294967296)"), &["4294967296 x 4294967296", "limit"]);
    assert_says(&array("(16000, 16000)"), &["0 bytes of numbers", "2048000000 bytes", "cut off"]);
    assert_says(
        &message(&folder, "a.tif", tiff_header(1_000_000_000)),
        &["1000000000 x 1000000000"],
    );
    assert_says(
        &message(&folder, "b.tif", tiff_header(16_000)),
        &["b.tif", "134 bytes for 256000000 cells", "at least 500000 bytes", "cut off"],
    );
    assert_says(&message(&folder, "c.tif", tiff_header(256)), &["strip or tile 0", "cut off"]);
}

/// The decoder quotes a whole tag in its message; ours stays short.
#[test]
fn a_tag_without_end_makes_no_message_without_end() {
    let folder = Scratch::new("long_tag");
    let mut bytes = tiff_header(256);
    let end = bytes.len() as u32;
    let entry = bytes.len() - 4 - 12;
    // Thirty thousand sample formats, all unknown, behind the directory.
    bytes.splice(entry + 2..entry + 4, 3_u16.to_le_bytes());
    bytes.splice(entry + 4..entry + 8, 30_000_u32.to_le_bytes());
    bytes.splice(entry + 8..entry + 12, end.to_le_bytes());
    bytes.resize(bytes.len() + 60_000, 77);
    let message = message(&folder, "a.tif", bytes);
    assert!(message.contains("sample format") && message.len() < 600, "{message}");
}

/// Opening a pipe would wait for ever, and a device has no end.
#[cfg(unix)]
#[test]
fn pipes_and_devices_are_refused() {
    let message = read_raster("/dev/zero").unwrap_err().to_string();
    assert_says(&message, &["/dev/zero", "a pipe or a device", "save it to a file"]);
}

#[test]
fn a_text_without_end_beside_a_raster_is_refused() {
    let folder = Scratch::new("long_text");
    fs::write(folder.path("a.asc"), format!("{HEADER}1 2 3\n4 5 6\n")).unwrap();
    fs::write(folder.path("a.prj"), "EPSG:32611").unwrap();
    assert!(read_raster(folder.path("a.asc")).is_ok());
    fs::File::create(folder.path("a.prj")).unwrap().set_len(20 << 20).unwrap();
    let message = read_raster(folder.path("a.asc")).unwrap_err().to_string();
    assert_says(&message, &["a.prj", "too long", "at most 16777216 bytes"]);
}

/// The directory of a TIFF file that claims `side` x `side` doubles and holds no data.
fn tiff_header(side: u32) -> Vec<u8> {
    let size = [(256, side), (257, side), (258, 64), (259, 1), (262, 1)];
    let strips = [(273, 8), (277, 1), (278, side), (279, 100), (339, 3)];
    let tags: Vec<(u16, u32)> = size.into_iter().chain(strips).collect();
    let mut bytes = b"II\x2a\x00\x08\x00\x00\x00".to_vec();
    bytes.extend((tags.len() as u16).to_le_bytes());
    for (tag, value) in tags {
        bytes.extend(tag.to_le_bytes());
        bytes.extend(4_u16.to_le_bytes());
        bytes.extend(1_u32.to_le_bytes());
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend(0_u32.to_le_bytes());
    bytes
}

#[test]
fn a_smaller_limit_can_be_asked_for() {
    let folder = Scratch::new("limit");
    let path = folder.path("a.npy");
    let raster = Raster::local(10, 10, 1.0, vec![1.0; 100]);
    write_raster(&path, &raster, &Metadata::default(), IfExists::Refuse).unwrap();
    let read = |max_cells| read_raster_file(&path, &ReadLimits { max_cells });
    assert!(read(100).is_ok());
    assert_says(&read(99).unwrap_err().to_string(), &["10 x 10", "limit of 99 cells", "raise"]);
}

#[test]
fn missing_files_and_foreign_formats() {
    let folder = Scratch::new("foreign_formats");
    let absent = read_raster(folder.path("absent.tif")).unwrap_err().to_string();
    assert_says(&absent, &["absent.tif", "cannot read", "check the spelling"]);
    let text = message(&folder, "a.docx", "hello");
    assert_says(&text, &["the extension .docx", ".tif, .tiff, .asc, .npy"]);
    assert_says(&message(&folder, "plain", "hello"), &["a name without extension"]);
    assert_says(&message(&folder, "a.tif", "hello"), &["a TIFF file", "damaged"]);
    assert_says(&message(&folder, "a.npy", "hello"), &["not an array file of NumPy", "numpy.save"]);
    assert!(read_raster(folder.path("")).unwrap_err().to_string().contains("folder"));
}

#[test]
fn a_damaged_sidecar_is_named() {
    let folder = Scratch::new("sidecar");
    let raster = Raster::local(2, 1, 1.0, vec![1.0, 2.0]);
    let path = folder.path("a.npy");
    write_raster(&path, &raster, &Metadata::default(), IfExists::Refuse).unwrap();
    fs::write(folder.path("a.npy.json"), "{").unwrap();
    let message = read_raster(&path).unwrap_err().to_string();
    assert_says(&message, &["a.npy.json", "line 1", "repair it, or remove it"]);
}

const OUTPUTS: [&str; 5] = ["a.tif", "a.asc", "a.npy", "a.png", "a.raw"];

/// The message of a refused write, which must leave nothing behind.
fn refused(folder: &Scratch, path: PathBuf, raster: &Raster) -> String {
    let before = folder.file_count();
    let result = write_raster(path, raster, &Metadata::default(), IfExists::Refuse);
    assert_eq!(folder.file_count(), before);
    result.unwrap_err().to_string()
}

#[test]
fn outputs_that_exist_or_cannot_be_written() {
    let folder = Scratch::new("bad_outputs");
    let raster = Raster::local(2, 1, 1.0, vec![1.0, 2.0]);
    for name in OUTPUTS {
        let nowhere = refused(&folder, folder.path("nowhere").join(name), &raster);
        assert_says(&nowhere, &["cannot write", name, "the folder is there"]);
        fs::write(folder.path(name), "precious").unwrap();
        assert_says(&refused(&folder, folder.path(name), &raster), &[name, "exists already"]);
        assert_eq!(fs::read_to_string(folder.path(name)).unwrap(), "precious");
        let below = refused(&folder, folder.path(name).join(name), &raster);
        assert_says(&below, &["is a file, not a folder"]);
    }
    assert_says(&refused(&folder, folder.path("a.gif"), &raster), &[".gif", ".png"]);
}

#[test]
fn rasters_that_cannot_be_stored() {
    let folder = Scratch::new("bad_rasters");
    let infinite = Raster::local(2, 1, 1.0, vec![1.0, f64::INFINITY]);
    let short = Raster::local(2, 2, 1.0, vec![1.0]);
    for name in OUTPUTS {
        assert_says(&refused(&folder, folder.path(name), &infinite), &[name, "inf"]);
        assert_says(&refused(&folder, folder.path(name), &short), &["2 x 2 cells with 1 values"]);
    }
    let placeless = Raster { georeference: None, ..Raster::local(1, 1, 1.0, vec![1.0]) };
    let message = refused(&folder, folder.path("a.asc"), &placeless);
    assert_says(&message, &["no georeference", "Georeference::local"]);
    let mut oblong = placeless;
    oblong.georeference =
        Some(Georeference { cell_size: [1.0, 2.0], ..Georeference::local(1, 1.0) });
    let path = folder.path("a.asc");
    let error = esri_ascii::write(&path, &oblong, &Metadata::default(), IfExists::Refuse);
    assert_says(&error.unwrap_err().to_string(), &["1 x 2", "square cells", "GeoTIFF"]);
}

#[test]
fn gaps_are_named_where_none_may_be() {
    let raster = Raster::local(2, 2, 1.0, vec![1.0, 2.0, f64::NAN, f64::NAN]);
    let message = raster.complete("dem.tif".as_ref()).unwrap_err().to_string();
    assert_says(&message, &["dem.tif", "column 0, row 1", "2 cells", "fill the gaps"]);
}

#[test]
fn meshes_that_exist_or_have_no_format() {
    let folder = Scratch::new("bad_meshes");
    let mesh = height_mesh(&Raster::local(2, 2, 1.0, vec![0.0; 4]), 1.0).unwrap();
    let write = |name: &str| {
        let result = write_mesh(folder.path(name), &mesh, &Metadata::default(), IfExists::Refuse);
        result.map_err(|error| error.to_string())
    };
    for name in ["a.obj", "a.ply", "a.glb", "a.stl"] {
        assert_eq!(write(name), Ok(()));
        assert_says(&write(name).unwrap_err(), &[name, "exists already"]);
    }
    assert_says(&write("a.fbx").unwrap_err(), &[".fbx", ".obj, .ply, .glb, .stl"]);
}
