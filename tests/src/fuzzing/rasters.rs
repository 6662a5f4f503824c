//! Files of rasters, of every format that is read.

use std::borrow::Cow;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use landform::graph::{Boundary, Connectivity, Lattice};
use landform::io::geotiff::{self, Options};
use landform::io::npz::{Content, Member};
use landform::io::{
    IfExists, IoError, Metadata, Raster, RasterFile, ReadLimits, SampleType, Sidecar,
    esri_ascii as text_grid, npy as array, npz as archive, png16 as picture, read_raster_file,
};

use crate::{Scratch, files_below, hills};

/// A GeoTIFF. What can be read is written and read again.
pub fn geotiff(bytes: &[u8]) -> bool {
    let scratch = Scratch::new("geotiff");
    let Some(file) = read(&scratch.write("a.tif", bytes)) else { return false };
    if file.raster.values.len() > 1 << 12 {
        return true;
    }
    let (again, options) = (scratch.path("again.tif"), Options::default());
    geotiff::write(&again, &file.raster, &file.metadata, &options, IfExists::Refuse)
        .expect("what was read can be written");
    let again = read(&again).expect("what was written can be read");
    assert_same(&file, &again);
    true
}

/// A grid as text. What can be read is written and read again.
pub fn esri_ascii(bytes: &[u8]) -> bool {
    let scratch = Scratch::new("esri_ascii");
    let Some(file) = read(&scratch.write("a.asc", bytes)) else { return false };
    if file.raster.values.len() > 1 << 12 {
        return true;
    }
    let again = scratch.path("again.asc");
    // Cells that are not square have no place in the format.
    if text_grid::write(&again, &file.raster, &file.metadata, IfExists::Refuse).is_ok() {
        assert_same(&file, &read(&again).expect("what was written can be read"));
    }
    true
}

/// A grey picture.
pub fn png(bytes: &[u8]) -> bool {
    read(&Scratch::new("png").write("a.png", bytes)).is_some()
}

/// An array file.
pub fn npy(bytes: &[u8]) -> bool {
    let scratch = Scratch::new("npy");
    let path = scratch.write("a.npy", bytes);
    read(&path);
    let array = looked_at(&path, array::read_array(&path, &ReadLimits::default()));
    array.is_some_and(|array| {
        assert_eq!(array.shape.iter().product::<usize>(), array.values.len());
        true
    })
}

/// An archive of arrays and texts, as checkpoints are. What can be read is written and read again.
pub fn npz(bytes: &[u8]) -> bool {
    let scratch = Scratch::new("npz");
    let path = scratch.write("a.npz", bytes);
    let Some(members) = looked_at(&path, archive::read(&path)) else { return false };
    let again = scratch.path("again.npz");
    archive::write(&again, &members, IfExists::Refuse).expect("what was read can be written");
    assert!(archive::read(&again).expect("what was written can be read") == members);
    true
}

/// Text beside a raster: the sidecar of an array, and the coordinate system of a grid.
pub fn sidecar(bytes: &[u8]) -> bool {
    static ARRAY: LazyLock<(String, Vec<u8>)> = LazyLock::new(|| {
        written("a.npy", |path| {
            array::write(path, &hills(3, 2), &metadata(), SampleType::F64, IfExists::Refuse)
        })
    });
    let scratch = Scratch::new("sidecar");
    let array_file = scratch.write("a.npy", &ARRAY.1);
    scratch.write("a.npy.json", bytes);
    let accepted = read(&array_file).is_some();
    let grid =
        scratch.write("a.asc", "ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 30\n1 2\n");
    scratch.write("a.prj", bytes);
    read(&grid).is_some() || accepted
}

/// Reads a raster by the door for all formats and looks at what came of it.
fn read(path: &Path) -> Option<RasterFile> {
    let file = looked_at(path, read_raster_file(path, &ReadLimits::default()))?;
    let raster = &file.raster;
    assert_eq!(raster.values.len(), raster.width * raster.height);
    assert!(raster.values.iter().all(|value| !value.is_infinite()), "infinite values");
    assert!(raster.range().is_some(), "no values at all");
    if let Some(place) = &raster.georeference {
        let sizes = [place.west, place.north, place.cell_size[0], place.cell_size[1]];
        assert!(sizes.iter().all(|number| number.is_finite()), "{place:?}");
        assert!(place.cell_size[0] > 0.0 && place.cell_size[1] > 0.0, "{place:?}");
        place.ground_cell_size_m(raster.size());
    }
    if let Ok(spacing_m) = raster.spacing_m() {
        // Refused or not, it must not panic.
        let _ = Lattice::plane(raster.size(), spacing_m, Connectivity::Eight, [Boundary::Open; 2]);
    }
    Some(file)
}

/// What was read; a refusal names the file and says what to do, in a few lines.
fn looked_at<T>(path: &Path, result: Result<T, IoError>) -> Option<T> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let stem = name.split('.').next().unwrap_or_default().to_owned();
    result
        .inspect_err(|error| {
            let message = error.to_string();
            assert!(message.contains(&stem) && message.len() < 2000, "{message}");
        })
        .ok()
}

/// The same values at the same place.
fn assert_same(left: &RasterFile, right: &RasterFile) {
    let (a, b) = (&left.raster, &right.raster);
    assert_eq!(a.size(), b.size());
    let same = |(a, b): (&f64, &f64)| a == b || (a.is_nan() && b.is_nan());
    assert!(a.values.iter().zip(&b.values).all(same), "{:?}\n{:?}", a.values, b.values);
    let cells = |raster: &Raster| raster.georeference.as_ref().map(|place| place.cell_size);
    if let (Some(before), Some(after)) = (cells(a), cells(b)) {
        assert_eq!(before, after);
    }
}

/// A small raster, and one with gaps.
fn rasters() -> [(&'static str, Raster); 2] {
    let mut gaps = hills(7, 5);
    gaps.values[3] = f64::NAN;
    gaps.no_data = Some(-9999.0);
    [("hills", hills(12, 9)), ("gaps", gaps)]
}

fn metadata() -> Metadata {
    let notes = [("iteration".to_owned(), "12".to_owned())].into();
    let [title, unit] = ["Düne & <1>", "m"].map(|text| Some(text.to_owned()));
    Metadata { title, unit, seed: Some(7), spacing_m: Some(30.0), notes, ..Metadata::default() }
}

/// Bytes of a file that `write` makes.
fn written(name: &str, write: impl Fn(&Path) -> Result<(), IoError>) -> (String, Vec<u8>) {
    let scratch = Scratch::new("seed");
    let path = scratch.path(name);
    write(&path).expect("a seed can be written");
    (name.to_owned(), fs::read(path).expect("a seed can be read"))
}

/// Files of other programs with this extension.
fn foreign(extension: &str) -> Vec<(String, Vec<u8>)> {
    let read = |path: &std::path::PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        (name, fs::read(path).expect("a file of the repository"))
    };
    files_below("crates/landform-io/tests/foreign", extension).iter().map(read).collect()
}

/// GeoTIFF of every sample type, and those of other programs.
pub fn geotiff_seeds() -> Vec<(String, Vec<u8>)> {
    let mut seeds = foreign("tif");
    for (name, raster) in rasters() {
        for sample in [SampleType::F64, SampleType::F32, SampleType::I16] {
            let options = Options { sample, ..Options::default() };
            seeds.push(written(&format!("{name}_{sample:?}.tif"), |path| {
                geotiff::write(path, &raster, &metadata(), &options, IfExists::Refuse)
            }));
        }
    }
    seeds
}

/// Grids as text.
pub fn esri_ascii_seeds() -> Vec<(String, Vec<u8>)> {
    let write = |(name, raster): (&str, Raster)| {
        written(&format!("{name}.asc"), |path| {
            text_grid::write(path, &raster, &metadata(), IfExists::Refuse)
        })
    };
    let mut seeds: Vec<_> = rasters().map(write).into();
    let centred = "NCOLS 3\r\nNROWS 2\r\nXLLCENTER 10\r\nYLLCENTER 2e3\r\nDX 5\r\nDY 2.5\r\n\
        NODATA_VALUE nan\r\n1 2 3\r\n-4 +5. nan\r\n";
    seeds.push(("centred.asc".to_owned(), centred.into()));
    seeds
}

/// Grey pictures with their scale.
pub fn png_seeds() -> Vec<(String, Vec<u8>)> {
    let write = |(name, raster): (&str, Raster)| {
        written(&format!("{name}.png"), |path| {
            picture::write(path, &raster, &metadata(), None, IfExists::Refuse)
        })
    };
    rasters().map(write).into()
}

/// Arrays of several sample types, and those of NumPy.
pub fn npy_seeds() -> Vec<(String, Vec<u8>)> {
    let mut seeds = foreign("npy");
    let [(_, raster), _] = rasters();
    for sample in [SampleType::F64, SampleType::F32, SampleType::I32, SampleType::I16] {
        seeds.push(written(&format!("{sample:?}.npy"), |path| {
            array::write(path, &raster, &metadata(), sample, IfExists::Refuse)
        }));
    }
    seeds
}

/// A small archive with texts and arrays of several types, and an empty one.
pub fn npz_seeds() -> Vec<(String, Vec<u8>)> {
    let array = |kind: &str, shape: Vec<usize>, bytes: &'static [u8]| Content::Array {
        kind: kind.to_owned(),
        shape,
        bytes: Cow::Borrowed(bytes),
    };
    let contents = [
        ("manifest.json", Content::Text(Cow::Borrowed("{\"tick\": 3}"))),
        ("fields/sand.npy", array("f8", vec![1, 2], &[0; 16])),
        ("groups/trees/nodes.npy", array("u4", vec![1], &[7, 0, 0, 0])),
        ("state/shaken.npy", array("u1", vec![3], &[1, 0, 1])),
    ];
    let members = contents.map(|(name, content)| Member { name: name.to_owned(), content });
    let write = |name, members: &[Member<'_>]| {
        written(name, |path| archive::write(path, members, IfExists::Refuse))
    };
    vec![write("small.npz", &members), write("text.npz", &members[..1])]
}

/// A sidecar, and texts of coordinate systems.
pub fn sidecar_seeds() -> Vec<(String, Vec<u8>)> {
    let scratch = Scratch::new("sidecar_seed");
    let path = scratch.path("a.npy");
    array::write(&path, &hills(3, 2), &metadata(), SampleType::F64, IfExists::Refuse)
        .expect("an array can be written");
    let json = fs::read(Sidecar::path_of(&path)).expect("a sidecar stands beside it");
    let known_text = "PROJCS[\"UTM 11N\",GEOGCS[\"WGS 84\",UNIT[\"degree\",0.0174532925199433]],\
        UNIT[\"metre\",1,AUTHORITY[\"EPSG\",\"9001\"]],AUTHORITY[\"EPSG\",\"32611\"]]";
    vec![
        ("sidecar.json".to_owned(), json),
        ("known_text.prj".to_owned(), known_text.into()),
        ("number.prj".to_owned(), "EPSG:4326".into()),
    ]
}

fn owned(words: &[&str]) -> Vec<String> {
    words.iter().map(|&word| word.to_owned()).collect()
}

/// Words of grids and their companions.
pub fn text_words() -> Vec<String> {
    owned(&[
        "ncols ",
        "nrows ",
        "xllcorner ",
        "xllcenter ",
        "yllcorner ",
        "yllcenter ",
        "cellsize ",
        "dx ",
        "dy ",
        "nodata_value ",
        "nan",
        "inf",
        "-",
        "1e308",
        "1e-308",
        "1e999",
        "\r\n",
        "\t",
        "999999999",
        "EPSG:",
        "UNIT[",
        "GEOGCS[",
        "PROJCS[",
        "METRES",
        "]",
        ",",
        "\"west\": ",
        "\"no_data\": ",
        "null",
        "\"scale\": ",
        "\"offset\": ",
        "{",
        "}",
        "[",
        "\"Geographic\"",
    ])
}

/// Words of pictures.
pub fn png_words() -> Vec<String> {
    owned(&["scale", "offset", "no_data", "spacing_m", "nan", "inf", "1e308", "IHDR", "IDAT"])
}

/// Words of array files.
pub fn npy_words() -> Vec<String> {
    owned(&[
        "'descr': ",
        "'fortran_order': ",
        "'shape': ",
        "True",
        "False",
        "'<f8'",
        "'>i2'",
        "'|u1'",
        "'<u8'",
        "'<i8'",
        "'|b1'",
        "'=f4'",
        "(",
        ")",
        ",",
        "18446744073709551615",
        "4294967296",
        "0",
        "1",
        "L",
        "\u{1}\0",
        "\u{2}\0",
        "\u{3}\0",
        "'",
        "\"",
    ])
}

/// Signatures of archives, and what stands in array files.
pub fn npz_words() -> Vec<String> {
    let mut words =
        owned(&["PK\u{3}\u{4}", "PK\u{1}\u{2}", "PK\u{5}\u{6}", "PK\u{6}\u{6}", ".npy"]);
    words.extend(npy_words());
    words
}

/// Tags and numbers of TIFF files.
pub fn geotiff_words() -> Vec<String> {
    owned(&[
        "II*\0",
        "MM\0*",
        "II+\0",
        "\0\u{1}",
        "\u{1}\0",
        "\0\0\0\0",
        "\u{7f}\u{7f}\u{7f}\u{7f}",
        "\u{1}\u{1}",
        "\u{2}\u{1}",
        "\u{3}\u{1}",
        "\u{6}\u{1}",
        "\u{11}\u{1}",
        "\u{15}\u{1}",
        "\u{16}\u{1}",
        "\u{17}\u{1}",
        "=\u{1}",
        "B\u{1}",
        "C\u{1}",
        "D\u{1}",
        "E\u{1}",
        "S\u{1}",
        "<Item name=\"SCALE\" role=\"scale\">",
        "role=\"offset\"",
        "&#x",
        "&amp;",
        "</Item>",
        "nan",
        "-9999",
        "1e308",
        "|",
        "\0",
    ])
}
