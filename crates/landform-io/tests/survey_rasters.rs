//! Measured terrain is read with the sizes and ranges that its notes name.
//!
//! The folder is `LANDFORM_DATA`, or `shared/data` beside the checkout; the test says so and
//! passes when there is none.

use std::path::{Path, PathBuf};

use landform_io::{Georeference, SpacingError, read_raster};

/// Name, columns, rows, least and greatest height, EPSG number.
const RASTERS: [(&str, usize, usize, f64, f64, u16); 8] = [
    ("big_tujunga_30m.tif", 1197, 643, 315.0, 2295.0, 32611),
    ("meghalaya_escarpment_50m.tif", 1000, 800, 16.0, 1959.0, 32646),
    ("jasper_athabasca_100m.asc", 400, 400, 952.0, 2581.0, 3402),
    ("yosemite_valley_1arcsec.tif", 1027, 875, 1175.0, 3568.0, 4269),
    ("st_helens_crater_10m.asc", 303, 442, 1362.0, 2538.0, 26910),
    ("zuid_kennemerland_dunes_2m.asc", 396, 396, -4.0, 22.1, 28992),
    ("monterey_bay_topobathy.asc", 540, 540, -2806.0, 1516.0, 4326),
    ("hawaii_topobathy_2min.asc", 299, 209, -6134.0, 4000.0, 4326),
];

/// The folder of elevation data, if there is one.
fn folder() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let data = std::env::var_os("LANDFORM_DATA").map_or(beside, PathBuf::from);
    let folder = data.join("dem");
    if folder.is_dir() {
        return Some(folder);
    }
    println!("SKIPPED: no folder {}; set LANDFORM_DATA to the data folder", folder.display());
    None
}

#[test]
fn sizes_ranges_and_systems_are_those_of_the_notes() {
    let Some(folder) = folder() else { return };
    for (name, width, height, least, greatest, epsg) in RASTERS {
        let raster = read_raster(folder.join(name)).unwrap();
        assert_eq!(raster.size(), [width, height], "{name}");
        let [low, high] = raster.range().unwrap();
        assert!(
            (low - least).abs() <= 0.5 && (high - greatest).abs() <= 0.5,
            "{name} {low} {high}"
        );
        assert_eq!(raster.missing_count(), 0, "{name}");
        let place = raster.georeference.unwrap();
        assert_eq!(place.coordinate_system.epsg, Some(epsg), "{name}");
    }
}

fn read(name: &str) -> Option<(Georeference, Result<f64, SpacingError>)> {
    let raster = read_raster(folder()?.join(name)).unwrap();
    let spacing = raster.spacing_m();
    Some((raster.georeference.unwrap(), spacing))
}

#[test]
fn projected_rasters_have_a_spacing_and_a_corner() {
    let Some((place, spacing)) = read("big_tujunga_30m.tif") else { return };
    assert_eq!(spacing, Ok(30.0));
    assert!((place.west - 376_313.66).abs() < 0.01, "{}", place.west);
    assert!((place.north - 643.0 * 30.0 - 3_788_627.83).abs() < 0.01, "{}", place.north);
    assert_eq!(read("zuid_kennemerland_dunes_2m.asc").unwrap().1, Ok(2.0));
    assert_eq!(read("jasper_athabasca_100m.asc").unwrap().1, Ok(100.0));
}

/// The notes give 24.5 m by 30.9 m for Yosemite and 165 m by 206 m for Monterey Bay.
#[test]
fn degrees_are_refused_with_their_length_on_the_ground() {
    for (name, [x, y]) in [
        ("yosemite_valley_1arcsec.tif", [24.5, 30.9]),
        ("monterey_bay_topobathy.asc", [165.0, 206.0]),
    ] {
        let Some((_, spacing)) = read(name) else { return };
        let Err(SpacingError::Degrees { metres, .. }) = spacing else { panic!("{spacing:?}") };
        assert!((metres[0] / x - 1.0).abs() < 0.01, "{name} {metres:?}");
        assert!((metres[1] / y - 1.0).abs() < 0.01, "{name} {metres:?}");
    }
}
