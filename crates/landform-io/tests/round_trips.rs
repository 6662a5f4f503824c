//! What is written is read back: every bit of the values, place and metadata.

#[expect(dead_code, reason = "not every test counts files")]
mod support;

use std::path::Path;

use landform_io::georeference::GeoKeys;
use landform_io::geotiff::{self, Options};
use landform_io::{
    CoordinateKind, CoordinateSystem, Georeference, IfExists, Metadata, Raster, RasterFile,
    ReadLimits, Registration, SampleType, npy, read_raster, read_raster_file, write_raster,
};
use proptest::prelude::*;
use support::Scratch;

fn metadata() -> Metadata {
    let mut metadata = Metadata {
        title: Some("Dunes — a \"test\" & more".into()),
        field: Some("sand".into()),
        unit: Some("m³".into()),
        spacing_m: Some(0.1),
        seed: Some(u64::MAX),
        ..Metadata::default()
    };
    metadata.notes.insert("version".into(), "0.1.0".into());
    metadata
}

fn place(registration: Registration) -> Georeference {
    Georeference {
        west: 376_313.66,
        north: 3_808_117.83,
        cell_size: [0.1; 2],
        registration,
        coordinate_system: CoordinateSystem::from_epsg(32611),
    }
}

/// Values that are hard to keep: extremes, a negative zero, and gaps.
fn raster() -> Raster {
    let hard = [0.0, -0.0, 0.1, -1.0 / 3.0, 5e-324, 1e29, -9999.0, f64::NAN, 1e-5, 123_456.789];
    let values = hard.iter().cycle().take(7 * 10).copied().collect();
    let georeference = Some(place(Registration::Area));
    Raster { width: 7, height: 10, values, no_data: None, georeference }
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| if value.is_nan() { 1 } else { value.to_bits() }).collect()
}

fn again(path: &Path, raster: &Raster) -> RasterFile {
    write_raster(path, raster, &metadata(), IfExists::Replace).unwrap();
    read_raster_file(path, &ReadLimits::default()).unwrap()
}

/// Some programs write the names of coordinate systems in UTF-8; tags hold ASCII. A run on such a
/// raster must not fail when it writes its first output.
#[test]
fn names_of_coordinate_systems_may_have_any_letters() {
    let folder = Scratch::new("letters");
    let mut raster = raster();
    let place = raster.georeference.as_mut().unwrap();
    let text = "Zürich \0 grid|UTM 11|";
    let start = text.find("UTM").unwrap() as u16;
    let directory = [[1, 1, 0, 2], [1024, 0, 1, 1], [1026, 34737, 7, start]].concat();
    let keys = GeoKeys { directory, doubles: Vec::new(), text: text.into() };
    place.coordinate_system.keys = Some(keys);
    let read = again(&folder.path("a.tif"), &raster).raster.georeference.unwrap();
    let system = read.coordinate_system;
    assert_eq!(system.keys.unwrap().text, "Z??rich ? grid|UTM 11|");
    assert_eq!(system.text.as_deref(), Some("UTM 11"), "keys find their part of the text");
}

#[test]
fn every_format_keeps_values_place_and_metadata() {
    let folder = Scratch::new("round_trips");
    for name in ["a.tif", "a.asc", "a.npy"] {
        let before = raster();
        let after = again(&folder.path(name), &before);
        assert_eq!(bits(&after.raster.values), bits(&before.values), "{name}");
        assert_eq!(after.metadata, metadata(), "{name}");
        let mut place = after.raster.georeference.unwrap();
        // A GeoTIFF brings its keys along.
        place.coordinate_system.keys = None;
        assert_eq!(Some(place), before.georeference, "{name}");
    }
}

#[test]
fn centres_of_cells_are_kept() {
    let folder = Scratch::new("centres");
    for name in ["a.tif", "a.asc", "a.npy"] {
        let georeference = Some(place(Registration::Point));
        let after = again(&folder.path(name), &Raster { georeference, ..raster() });
        let place = after.raster.georeference.unwrap();
        assert_eq!(place.registration, Registration::Point, "{name}");
        assert!((place.west - 376_313.66).abs() < 1e-9, "{name} {}", place.west);
        assert!((place.north - 3_808_117.83).abs() < 1e-9, "{name} {}", place.north);
    }
}

#[test]
fn keys_of_a_geotiff_are_written_again_verbatim() {
    let folder = Scratch::new("keys");
    let keys = GeoKeys {
        directory: vec![1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 1026, 34737, 10, 0],
        doubles: vec![0.1, 2.0],
        text: "Local map|".into(),
    };
    let mut raster = raster();
    raster.georeference.as_mut().unwrap().coordinate_system.keys = Some(keys.clone());
    let after = again(&folder.path("a.tif"), &raster).raster;
    let system = after.georeference.unwrap().coordinate_system;
    assert_eq!(system.keys, Some(keys));
    assert_eq!(system.text.as_deref(), Some("Local map"));
    assert_eq!(system.kind, CoordinateKind::Projected { metres_per_unit: 1.0 });
}

/// All whole numbers of 16 bits but the one that marks gaps.
#[test]
fn sixteen_bits_keep_whole_numbers() {
    let folder = Scratch::new("sixteen_bits");
    let mut values: Vec<f64> = (-32768..32768).map(f64::from).collect();
    values[0] = f64::NAN;
    let raster = Raster::local(256, 256, 2.0, values);
    let options = Options { sample: SampleType::I16, ..Options::default() };
    let tif = folder.path("a.tif");
    geotiff::write(&tif, &raster, &metadata(), &options, IfExists::Refuse).unwrap();
    let array = folder.path("a.npy");
    npy::write(&array, &raster, &metadata(), SampleType::I16, IfExists::Refuse).unwrap();
    for path in [tif, array] {
        let after = read_raster(&path).unwrap();
        assert_eq!(bits(&after.values), bits(&raster.values), "{}", path.display());
        assert_eq!(after.no_data, Some(-32768.0));
        assert_eq!(after.spacing_m(), Ok(2.0));
    }
}

#[test]
fn singles_keep_singles() {
    let folder = Scratch::new("singles");
    let values = (0..5000).map(|cell| f64::from((cell as f32).sqrt())).collect();
    let raster = Raster::local(100, 50, 1.0, values);
    let path = folder.path("a.tif");
    let options = Options { sample: SampleType::F32, ..Options::default() };
    geotiff::write(&path, &raster, &metadata(), &options, IfExists::Refuse).unwrap();
    assert_eq!(read_raster(&path).unwrap().values, raster.values);
}

/// The grey of a cell leads back to its value within half a step of the scale in the file.
#[test]
fn pictures_say_how_grey_becomes_height() {
    let folder = Scratch::new("pictures");
    let values = vec![-10.0, f64::NAN, 0.0, 2.5, 90.0, 33.3];
    let raster = Raster::local(3, 2, 1.0, values);
    let path = folder.path("a.png");
    write_raster(&path, &raster, &metadata(), IfExists::Refuse).unwrap();
    let file = std::io::BufReader::new(std::fs::File::open(&path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut bytes).unwrap();
    let info = reader.info();
    assert_eq!((info.width, info.height, info.bit_depth), (3, 2, png::BitDepth::Sixteen));
    let latin = info.uncompressed_latin1_text.iter().map(|text| (&text.keyword, text.text.clone()));
    let other = info.utf8_text.iter().map(|text| (&text.keyword, text.get_text().unwrap()));
    let texts: std::collections::BTreeMap<_, _> = latin.chain(other).collect();
    let text = |name: &str| texts[&name.to_string()].clone();
    let number = |name: &str| text(name).parse::<f64>().unwrap();
    assert_eq!((text("unit"), text("seed")), ("m³".into(), u64::MAX.to_string()));
    assert_eq!(number("no_data"), 0.0);
    for (grey, value) in bytes.as_chunks().0.iter().zip(&raster.values) {
        let grey = f64::from(u16::from_be_bytes(*grey));
        let read = number("offset") + number("scale") * grey;
        let missing = grey == 0.0 && value.is_nan();
        assert!(missing || (read - value).abs() <= 0.5001 * number("scale"), "{grey} {value}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_raster_is_kept_bit_for_bit(
        width in 1_usize..12,
        cells in prop::collection::vec(prop_oneof![4 => -1e30..1e30, 1 => Just(f64::NAN), 1 => -1e-300..1e-300], 1..120),
        corner in prop::array::uniform2(-1e7..1e7),
        spacing in 1e-3..1e4,
        no_data in prop::option::of(-1e4..1e4),
    ) {
        let height = cells.len() / width;
        prop_assume!(height > 0 && cells[..width * height].iter().any(|value: &f64| !value.is_nan()));
        let mut raster = Raster::local(width, height, spacing, cells[..width * height].to_vec());
        raster.no_data = no_data;
        let place = raster.georeference.as_mut().unwrap();
        [place.west, place.north] = corner;
        let folder = Scratch::new("any_raster");
        for name in ["a.tif", "a.asc", "a.npy"] {
            let after = again(&folder.path(name), &raster).raster;
            prop_assert_eq!(bits(&after.values), bits(&raster.values));
            let place = after.georeference.unwrap();
            prop_assert_eq!(place.west, corner[0]);
            prop_assert!((place.north - corner[1]).abs() <= 4e-16 * (corner[1].abs() + spacing * height as f64));
            prop_assert_eq!(place.cell_size, [spacing; 2]);
        }
    }
}
