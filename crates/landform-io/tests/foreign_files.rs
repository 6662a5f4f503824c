//! Files that GDAL 3 and NumPy 2 wrote are read with the numbers that they were given:
//! `z = 100 + 3 column - 7 row + 0.25 (column row mod 5)` on 21 columns and 19 rows.

use std::path::{Path, PathBuf};

use landform_io::{
    CoordinateKind, Raster, ReadLimits, Registration, SpacingError, npy, read_raster,
    read_raster_file,
};

const SIZE: [usize; 2] = [21, 19];

fn foreign(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/foreign").join(name)
}

fn read(name: &str) -> Raster {
    let raster = read_raster(foreign(name)).unwrap();
    assert_eq!(raster.size(), SIZE, "{name}");
    raster
}

/// The height of a cell.
fn height(column: usize, row: usize) -> f64 {
    100.0 + 3.0 * column as f64 - 7.0 * row as f64 + 0.25 * ((column * row) % 5) as f64
}

fn heights() -> Vec<f64> {
    (0..SIZE[0] * SIZE[1]).map(|cell| height(cell % SIZE[0], cell / SIZE[0])).collect()
}

/// To the nearest, ties to even, as NumPy rounds.
fn rounded() -> Vec<f64> {
    heights().iter().map(|height| height.round_ties_even()).collect()
}

#[test]
fn tiles_strips_predictors_and_byte_orders() {
    assert_eq!(read("tiled_f32_predictor3.tif").values, heights());
    assert_eq!(read("bigtiff_f64.tif").values, heights());
    // Unsigned: heights below zero have wrapped round in the file.
    let wrapped: Vec<f64> = rounded().iter().map(|height| height.rem_euclid(65536.0)).collect();
    assert_eq!(read("lzw_u16_big_endian.tif").values, wrapped);
}

#[test]
fn a_utm_zone_has_corner_spacing_and_number() {
    let raster = read("bigtiff_f64.tif");
    assert_eq!(raster.spacing_m(), Ok(10.0));
    let place = raster.georeference.unwrap();
    assert_eq!((place.west, place.north), (500_000.5, 4_100_000.25));
    assert_eq!(place.coordinate_system.epsg, Some(32611));
    let name = place.coordinate_system.text.unwrap();
    assert!(name.contains("UTM zone 11N"), "{name}");
}

#[test]
fn declared_gaps_are_missing() {
    let raster = read("packbits_i32_nodata.tif");
    assert_eq!(raster.no_data, Some(-9999.0));
    for (cell, (value, expected)) in raster.values.iter().zip(rounded()).enumerate() {
        match cell % SIZE[0] {
            3 => assert!(value.is_nan()),
            _ => assert_eq!(*value, expected),
        }
    }
}

/// GDAL was given the outer corner (-119.5, 37.8) and cells of one second.
#[test]
fn points_in_degrees_have_the_same_outer_corner() {
    let raster = read("point_degrees.tif");
    assert!(matches!(raster.spacing_m(), Err(SpacingError::Degrees { .. })));
    let place = raster.georeference.unwrap();
    assert_eq!(place.registration, Registration::Point);
    assert!((place.west + 119.5).abs() < 1e-12 && (place.north - 37.8).abs() < 1e-12, "{place:?}");
    assert_eq!(place.coordinate_system.epsg, Some(4326));
    assert_eq!(place.coordinate_system.kind, CoordinateKind::Geographic);
}

/// Stored as `4 z`, scale 0.25, offset 0.5, in US survey feet (EPSG 2227).
#[test]
fn scale_offset_unit_and_feet_are_applied() {
    let file = read_raster_file(foreign("scaled_i16.tif"), &ReadLimits::default()).unwrap();
    let expected: Vec<f64> = heights().iter().map(|height| height + 0.5).collect();
    assert_eq!(file.raster.values, expected);
    assert_eq!(file.metadata.unit.as_deref(), Some("ft"));
    assert_eq!(file.metadata.field.as_deref(), Some("height"));
    assert_eq!((file.encoding.scale, file.encoding.offset), (0.25, 0.5));
    let spacing = file.raster.spacing_m().unwrap();
    assert!((spacing - 10.0 * 1200.0 / 3937.0).abs() < 1e-9, "{spacing}");
}

#[test]
fn what_cannot_be_a_height_field_is_refused_with_advice() {
    for (name, problem, advice) in [
        ("two_bands.tif", "the image has 2 bands", "gdal_translate -b 1"),
        ("rotated.tif", "rotates or flips", "gdalwarp"),
        ("ground_control.tif", "ground control points", "gdalwarp"),
        ("volume_u2.npy", "3 axes: [2, 3, 4]", "slice of two axes"),
    ] {
        let message = read_raster(foreign(name)).unwrap_err().to_string();
        assert!(message.contains(name) && message.contains(problem), "{message}");
        assert!(message.contains(advice), "{message}");
    }
}

#[test]
fn arrays_in_other_orders_are_turned() {
    assert_eq!(read("fortran_i8.npy").values, rounded());
    assert_eq!(read("big_endian_f4.npy").values, heights());
    let volume = npy::read_array(&foreign("volume_u2.npy"), &ReadLimits::default()).unwrap();
    assert_eq!(volume.shape, [2, 3, 4]);
    assert_eq!(volume.values, (0..24).map(f64::from).collect::<Vec<_>>());
}
