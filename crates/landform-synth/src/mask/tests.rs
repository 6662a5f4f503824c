//! Masks against areas and distances that are known.

use landform_graph::{Boundary, Connectivity};

use super::*;

fn lattice(size: [usize; 2], spacing: f64, boundary: Boundary) -> Lattice {
    Lattice::plane(size, spacing, Connectivity::Eight, [boundary; 2]).unwrap()
}

fn rings(rings: &[&[[f64; 2]]]) -> Mask {
    let of = MaskSource::Rings(rings.iter().map(|ring| ring.to_vec()).collect());
    Mask { of, ..Default::default() }
}

const SQUARE: [[f64; 2]; 4] = [[10.0, 10.0], [50.0, 10.0], [50.0, 50.0], [10.0, 50.0]];

#[test]
fn rings_within_rings_are_holes() {
    let hole = [[20.0, 20.0], [40.0, 20.0], [40.0, 40.0], [20.0, 40.0], [20.0, 20.0]];
    let mask = Mask { edge_m: Some(2.0), ..rings(&[&SQUARE, &hole]) };
    let surface = MaskSurface::new(&mask, Path::new(""), 1.0).unwrap();
    for (point, expected) in [
        ([30.0, 30.0], 0.0),
        ([15.0, 30.0], 1.0),
        ([10.0, 30.0], 0.5),
        ([9.5, 30.0], 0.25),
        ([5.0, 5.0], 0.0),
        // Rays through corners.
        ([0.0, 10.5], 0.0),
        ([0.0, 50.0], 0.0),
        ([0.0, 20.0], 0.0),
        ([15.0, 20.0], 1.0),
    ] {
        assert!((surface.at(point) - expected).abs() < 1e-12, "{point:?}");
    }
    assert_eq!(surface.slope(), 0.5);
}

/// Smooth edges give areas, and the inside does not depend on which way a ring runs.
#[test]
fn shares_add_up_to_areas() {
    let lattice = lattice([120, 110], 1.0, Boundary::Open);
    let triangle = [[20.3, 15.2], [90.7, 40.1], [35.5, 95.9]];
    let area = 0.5 * ((90.7 - 20.3) * (95.9 - 15.2) - (35.5 - 20.3) * (40.1 - 15.2));
    let mut back = triangle;
    back.reverse();
    for ring in [triangle, back] {
        let shares = rings(&[&ring]).generate(&lattice, 0).unwrap();
        let sum: f64 = shares.iter().sum();
        assert!((sum / area - 1.0).abs() < 2e-3, "{sum} {area}");
    }
    for (shape, level, expected) in [
        (KnownFractal::Carpet, 3, (8.0_f64 / 9.0).powi(3)),
        (KnownFractal::Triangle, 4, 0.75_f64.sqrt() / 2.0 * 0.75_f64.powi(4)),
    ] {
        let of = MaskSource::Fractal { shape, level };
        let mask = Mask { of, scale: 80.0, at_m: [10.0; 2], ..Default::default() };
        let sum: f64 = mask.generate(&lattice, 0).unwrap().iter().sum();
        assert!((sum / 6400.0 / expected - 1.0).abs() < 0.02, "{shape:?} {}", sum / 6400.0);
    }
}

#[test]
fn pictures_lie_as_they_are_seen() {
    let folder = std::env::temp_dir().join(format!("landform_mask_{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    // White in the north-west, a pixel a node.
    let values = vec![1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5];
    let raster = landform_io::Raster::local(3, 3, 1.0, values);
    let path = folder.join("mask.png");
    let metadata = landform_io::Metadata::default();
    landform_io::write_raster(&path, &raster, &metadata, landform_io::IfExists::Replace).unwrap();
    let of = MaskSource::Picture("mask.png".into());
    let mask = Mask { of, outside: 2.0, inside: 4.0, ..Default::default() };
    let lattice = lattice([3; 2], 5.0, Boundary::Periodic);
    let found = mask.values_from(&folder, &lattice).unwrap();
    for (found, expected) in found.iter().zip([4.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 3.0]) {
        assert!((found - expected).abs() < 1e-4, "{found}");
    }
    let surface = MaskSurface::new(&mask, &folder, 5.0).unwrap();
    assert!((surface.at([2.5, 7.5]) - 2.5).abs() < 1e-4);
    assert!((surface.slope() - 2.0 * 2.0_f64.sqrt() / 5.0).abs() < 1e-4);
    let small = Mask { scale: 0.5, ..mask };
    assert!(small.values_from(&folder, &lattice).unwrap_err().to_string().contains("periodic"));
    let text = "ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n7 7\n";
    std::fs::write(folder.join("level.asc"), text).unwrap();
    let of = MaskSource::Picture("level.asc".into());
    let refused = MaskSurface::new(&Mask { of, ..Default::default() }, &folder, 5.0).unwrap_err();
    assert!(refused.to_string().contains("7 everywhere; it shows no region"), "{refused}");
    std::fs::remove_dir_all(&folder).unwrap();
}

/// At 60.005 degrees a degree of latitude is 111.4124 km on the ellipsoid, and one of longitude
/// 55.7916 km.
/// Rasters with cells of any width, whose corner lies at that of the first node's cell.
#[test]
fn rasters_are_ground() {
    let folder = std::env::temp_dir().join(format!("landform_ground_{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let head = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 80\n";
    std::fs::write(folder.join("coarse.asc"), format!("{head}30 50\n10 20\n")).unwrap();
    std::fs::write(folder.join("level.asc"), format!("{head}7 7\n7 7\n")).unwrap();
    let ground = RasterGround { path: "coarse.asc".into(), scale: 2.0, ..Default::default() };
    let surface = ground.surface(&folder, 10.0).unwrap();
    // The middle of the south-western cell lies 40 m from its corner, that of the node 5 m.
    for (point, height) in [
        ([35.0, 35.0], 20.0),
        ([115.0, 35.0], 40.0),
        ([35.0, 115.0], 60.0),
        ([75.0, 75.0], 55.0),
        ([0.0, 0.0], 20.0),
        ([999.0, 999.0], 100.0),
    ] {
        assert!((surface.at(point) - height).abs() < 1e-9, "{point:?} {}", surface.at(point));
    }
    assert!((surface.slope() - 60.0_f64.hypot(40.0) / 80.0).abs() < 1e-9, "{}", surface.slope());
    let moved = RasterGround { at_m: [100.0, 0.0], spacing_m: Some(40.0), ..ground.clone() };
    assert!((moved.surface(&folder, 10.0).unwrap().at([115.0, 15.0]) - 20.0).abs() < 1e-9);
    let level = RasterGround { path: "level.asc".into(), ..Default::default() };
    assert_eq!(level.surface(&folder, 10.0).unwrap().at([3.0, 4.0]), 7.0);
    for (path, message) in [("", "no file is named"), ("none.asc", "none.asc")] {
        let bad = RasterGround { path: path.into(), ..Default::default() };
        let refused = bad.surface(&folder, 10.0).unwrap_err().to_string();
        assert!(refused.contains(message), "{refused}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn files_of_lines_become_metres() {
    let folder = std::env::temp_dir().join(format!("landform_outline_{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let rows = "lon,lat\n10,60\n10.02,60\n10.02,60.01\n10,60.01\n";
    std::fs::write(folder.join("box.csv"), rows).unwrap();
    let of = MaskSource::Outline("box.csv".into());
    let mask = Mask { of, at_m: [100.0, 200.0], ..Default::default() };
    let surface = MaskSurface::new(&mask, &folder, 1.0).unwrap();
    let Shape::Outline(outline) = &surface.shape else { panic!("no outline") };
    assert!(outline.is_within(1, 200.0 + 1114.7) && !outline.is_within(1, 200.0 + 1114.6));
    let width = 0.02 * 55_791.6;
    assert!(outline.is_within(0, 100.6 + width) && !outline.is_within(0, 100.4 + width));
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn bad_masks_are_refused() {
    let file = |path: &str| Mask { of: MaskSource::Outline(path.into()), ..Default::default() };
    let picture = |path: &str| Mask { of: MaskSource::Picture(path.into()), ..Default::default() };
    let fractal = MaskSource::Fractal { shape: KnownFractal::Carpet, level: 6 };
    for (mask, message) in [
        (rings(&[]), "there is no ring"),
        (rings(&[&SQUARE, &[]]), "ring 1 has 0 points; a ring takes at least 3"),
        (rings(&[&SQUARE[..2]]), "ring 0 has 2 points"),
        (rings(&[&[SQUARE[0], SQUARE[1], SQUARE[0]]]), "ring 0 has 2 points"),
        (rings(&[&[SQUARE[0]; 4]]), "all points of ring 0 are at one place"),
        (rings(&[&[[f64::NAN, 0.0], SQUARE[0], SQUARE[1]]]), "Mask: of is NaN"),
        (file("absent.csv"), "absent.csv"),
        (file("mask.txt"), "mask.txt"),
        (picture("absent.png"), "absent.png"),
        (picture(""), "no picture is named"),
        (Mask { of: fractal, ..Default::default() }, "level is 6; it must be from 0 to 5"),
        (Mask { edge_m: Some(0.0), ..Default::default() }, "edge_m is 0"),
        (Mask { scale: f64::NAN, ..Default::default() }, "scale is NaN"),
    ] {
        let refused = mask.generate(&lattice([4; 2], 1.0, Boundary::Open), 0).unwrap_err();
        assert!(refused.to_string().contains(message), "{refused}\n{message}");
    }
    let beyond = rings(&[&SQUARE]).generate(&lattice([50; 2], 1.0, Boundary::Periodic), 0);
    assert!(beyond.unwrap_err().to_string().contains("periodic x axis"));
    assert!(rings(&[&SQUARE]).generate(&lattice([51; 2], 1.0, Boundary::Periodic), 0).is_ok());
}
