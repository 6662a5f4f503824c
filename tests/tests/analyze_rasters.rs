//! `landform analyze` of rasters: measured terrain against numbers computed elsewhere, and rasters
//! at the edge of what can be measured.

use std::path::PathBuf;

use landform::io::{Georeference, IfExists, Metadata, Raster, write_raster};
use landform_tests::{Ended, Program, Scratch, hills, repository};
use serde_json::Value;

fn call(scratch: &Scratch, line: &str) -> Ended {
    Program::within(scratch.folder()).line("analyze").line(line).run()
}

fn object(scratch: &Scratch, line: &str) -> Value {
    serde_json::from_str(&call(scratch, &format!("{line} --json")).good()).expect("JSON")
}

#[track_caller]
fn near(what: &str, found: &Value, expected: f64, within: f64) {
    let value = found.as_f64().unwrap_or_else(|| panic!("{what}: {found} is no number"));
    let gap = (value - expected).abs();
    assert!(gap <= within, "{what}: {value} is not {expected} +- {within}");
}

/// Numbers of a measured raster, computed in double precision without Landform, by Python with NumPy
/// 2.4, SciPy 1.17 and scikit-image 0.26: `numpy.fft.fft2` and `numpy.polyfit` for spectra,
/// `skimage.morphology.reconstruction` by erosion for filling and `skimage.measure.label` for
/// depressions, `scipy.ndimage.convolve` with Sobel's weights and `numpy.percentile` for slopes,
/// `scipy.optimize.least_squares` for Strahler's family, block means for shores, and D8 with a
/// breadth-first search over flats for drainage.
struct Pins {
    file: &'static str,
    size: [u64; 2],
    cell_m: [f64; 2],
    integral: f64,
    /// RMS, R2, beta and its error, after the plane is removed and the window laid over the rest.
    prepared: [f64; 4],
    /// The same of the heights as they are.
    untreated: [f64; 4],
    variogram: f64,
    /// Level and dimension.
    shore: [f64; 2],
    /// Mean, 5, 50 and 95 % and largest, in degrees.
    slope: [f64; 5],
    /// Number, per cent of the area, volume, greatest depth.
    depressions: [f64; 4],
    /// a/d, z and misfit.
    family: [f64; 3],
    largest_basin_km2: f64,
    /// Exceedance of area, Hack's exponent, concavity.
    laws: [f64; 3],
}

/// The rasters of the data folder.
const PINS: [Pins; 8] = [
    Pins {
        file: "big_tujunga_30m.tif",
        size: [1197, 643],
        cell_m: [30.000000, 30.000000],
        integral: 0.46041951,
        prepared: [0.0445332, 0.7930500, 4.0692094, 0.0963713],
        untreated: [0.0579360, 0.6895261, 3.3133679, 0.0174666],
        variogram: 2.15725464,
        shore: [1253.0000, 1.26371685],
        slope: [21.519724, 5.951585, 21.908230, 35.673692, 64.346916],
        depressions: [979.0, 0.6244226, 1.8801000e+07, 46.0000],
        family: [0.0547, 0.2758, 0.0433],
        largest_basin_km2: 323.3709,
        laws: [0.5016, 0.4814, 0.2527],
    },
    Pins {
        file: "meghalaya_escarpment_50m.tif",
        size: [1000, 800],
        cell_m: [50.000000, 50.000947],
        integral: 0.62273669,
        prepared: [0.0508831, 0.7085805, 3.8445898, 0.0697517],
        untreated: [0.0553031, 0.6724414, 3.1329255, 0.0318928],
        variogram: 2.20804409,
        shore: [1487.0000, 1.36133942],
        slope: [16.857327, 2.290567, 13.950788, 38.573410, 68.020109],
        depressions: [6439.0, 4.7295000, 5.0491206e+08, 103.0000],
        family: [0.9999, 0.6066, 0.0536],
        largest_basin_km2: 475.7765,
        laws: [0.4839, 0.5334, 0.1325],
    },
    Pins {
        file: "jasper_athabasca_100m.asc",
        size: [400, 400],
        cell_m: [100.000000, 100.000000],
        integral: 0.28335821,
        prepared: [0.0479668, 0.8055311, 3.6910826, 0.0877736],
        untreated: [0.0605644, 0.7078356, 3.3367948, 0.0508748],
        variogram: 2.29090172,
        shore: [1376.0000, 1.39133959],
        slope: [9.552708, 1.132260, 6.822149, 28.245309, 56.974846],
        depressions: [593.0, 1.4112500, 9.2760000e+07, 81.0000],
        family: [0.0141, 0.3224, 0.0223],
        largest_basin_km2: 752.4900,
        laws: [0.4856, 0.5006, 0.2305],
    },
    Pins {
        file: "yosemite_valley_1arcsec.tif",
        size: [1027, 875],
        cell_m: [24.483061, 30.831001],
        integral: 0.52765688,
        prepared: [0.0565569, 0.6638411, 4.1117929, 0.0379231],
        untreated: [0.0635017, 0.6243935, 3.4017074, 0.0275778],
        variogram: 2.13775509,
        shore: [2436.3000, 1.18204355],
        slope: [16.985370, 2.798742, 14.419697, 39.811742, 85.240023],
        depressions: [641.0, 0.9068299, 9.1853472e+06, 13.0000],
        family: [0.0370, 0.1992, 0.0408],
        largest_basin_km2: 602.7776,
        laws: [0.5156, 0.4350, 0.2343],
    },
    Pins {
        file: "st_helens_crater_10m.asc",
        size: [303, 442],
        cell_m: [10.000000, 10.000000],
        integral: 0.50793452,
        prepared: [0.0719265, 0.6734088, 3.8861058, 0.0419118],
        untreated: [0.0848394, 0.5858940, 3.0053143, 0.0330721],
        variogram: 2.10285863,
        shore: [1997.2000, 1.18090656],
        slope: [28.531177, 8.614961, 28.895555, 51.510153, 77.744876],
        depressions: [108.0, 0.1814435, 3.2150000e+04, 7.9000],
        family: [0.5858, 0.6791, 0.0261],
        largest_basin_km2: 4.7466,
        laws: [0.6570, 0.4081, 0.1816],
    },
    Pins {
        file: "zuid_kennemerland_dunes_2m.asc",
        size: [396, 396],
        cell_m: [2.000000, 2.000000],
        integral: 0.30723970,
        prepared: [0.0989880, 0.7360699, 5.8936462, 0.3108148],
        untreated: [0.1360613, 0.5445280, 3.5308638, 0.0624700],
        variogram: 2.09836398,
        shore: [0.0000, 1.02175683],
        slope: [6.180264, 0.308045, 2.164209, 22.363013, 37.651247],
        depressions: [118.0, 9.6814101, 9.5227280e+04, 6.8800],
        family: [0.3842, 1.1568, 0.0196],
        largest_basin_km2: 0.1974,
        laws: [0.7808, 0.3243, -0.0360],
    },
    Pins {
        file: "monterey_bay_topobathy.asc",
        size: [540, 540],
        cell_m: [165.525918, 205.503044],
        integral: 0.62644939,
        prepared: [0.0462961, 0.7804287, 3.6222348, 0.0850425],
        untreated: [0.0581440, 0.6750095, 3.0453805, 0.0202116],
        variogram: 2.29473228,
        shore: [0.0000, 1.08247285],
        slope: [7.275734, 0.213340, 5.177914, 20.791716, 41.801219],
        depressions: [1407.0, 3.0233196, 1.9107785e+09, 66.5000],
        family: [0.0717, 0.1733, 0.0511],
        largest_basin_km2: 6586.5676,
        laws: [0.5645, 0.4416, 0.1116],
    },
    Pins {
        file: "hawaii_topobathy_2min.asc",
        size: [299, 209],
        cell_m: [3474.733758, 3687.876797],
        integral: 0.17631104,
        prepared: [0.0540954, 0.6371465, 3.4670577, 0.0731092],
        untreated: [0.0546684, 0.6481144, 3.2840561, 0.0575003],
        variogram: 2.31820204,
        shore: [0.0000, 1.44779262],
        slope: [1.711601, 0.089384, 0.615510, 7.912528, 22.425784],
        depressions: [1026.0, 20.9150118, 1.9149863e+13, 1022.0000],
        family: [0.0073, 0.4011, 0.0280],
        largest_basin_km2: 177274.2713,
        laws: [0.5812, 0.4808, 0.2626],
    },
];

/// The folder of measured terrain, if there is one.
fn folder() -> Option<PathBuf> {
    let beside = || repository().parent().map(|parent| parent.join("shared/data"));
    let data = std::env::var_os("LANDFORM_DATA").map(PathBuf::from).or_else(beside)?;
    let folder = data.join("dem");
    if !folder.is_dir() {
        println!("SKIPPED: no folder {}; set LANDFORM_DATA to the data", folder.display());
        return None;
    }
    Some(folder)
}

#[test]
fn measured_terrain_has_the_numbers_that_others_compute() {
    let Some(folder) = folder() else { return };
    let scratch = Scratch::new("measured");
    for pins in &PINS {
        let path = folder.join(pins.file);
        let program = Program::within(scratch.folder()).args(["analyze", "--json"]).args([&path]);
        let found: Value = serde_json::from_str(&program.run().good()).expect("JSON");
        compare(pins, &found);
    }
}

/// Tolerances are those of the printed digits, but for drainage: over flats the shortest ways are
/// not unique, and integer heights make wide ones.
fn compare(pins: &Pins, found: &Value) {
    let near = |part: &str, expected: f64, within: f64| {
        let value = found.pointer(part).unwrap_or(&Value::Null);
        near(&format!("{} {part}", pins.file), value, expected, within);
    };
    assert_eq!(found["size"], serde_json::json!(pins.size));
    assert_eq!(found["no_data_percent"], 0.0);
    for axis in 0..2 {
        near(&format!("/cell_m/{axis}"), pins.cell_m[axis], 1e-5);
    }
    near("/hypsometry/integral", pins.integral, 1e-8);
    for (key, expected) in ["a_over_d", "z", "misfit"].iter().zip(pins.family) {
        near(&format!("/hypsometry/{key}"), expected, 2e-4);
    }
    let spectra = [("/spectrum", pins.prepared), ("/spectrum/untreated", pins.untreated)];
    for (part, expected) in spectra {
        for (key, expected) in ["rms", "r2", "beta", "beta_error"].iter().zip(expected) {
            near(&format!("{part}/{key}"), expected, 1e-7);
        }
    }
    near("/dimension/variogram/dimension", pins.variogram, 1e-8);
    near("/dimension/shore/level_m", pins.shore[0], 1e-4);
    near("/dimension/shore/dimension", pins.shore[1], 1e-8);
    for (key, expected) in ["mean", "p5", "median", "p95", "steepest"].iter().zip(pins.slope) {
        near(&format!("/slope_deg/{key}"), expected, 1e-6);
    }
    let [count, percent, volume, deepest] = pins.depressions;
    near("/depressions/count", count, 0.0);
    near("/depressions/area_percent", percent, 1e-7);
    near("/depressions/volume", volume, 1e-7 * volume);
    near("/depressions/deepest", deepest, 1e-4);
    near("/drainage/largest_basin_m2", 1e6 * pins.largest_basin_km2, 1e3 * pins.largest_basin_km2);
    near("/drainage/exceedance/exponent", pins.laws[0], 0.003);
    near("/drainage/hack/exponent", pins.laws[1], 0.004);
    near("/drainage/slope_area/concavity/exponent", pins.laws[2], 0.009);
}

fn write(scratch: &Scratch, name: &str, raster: &Raster) {
    let path = scratch.path(name);
    write_raster(path, raster, &Metadata::default(), IfExists::Replace).expect("a raster");
}

/// All remarks in one text.
fn notes(found: &Value) -> String {
    let notes = found["notes"].as_array().expect("notes").iter().filter_map(Value::as_str);
    notes.collect::<Vec<_>>().join("\n")
}

#[test]
fn rasters_that_are_too_small_or_flat_say_what_is_missing() {
    let scratch = Scratch::new("small");
    let ramp = |cells: usize| (0..cells).map(|cell| cell as f64).collect::<Vec<_>>();
    for (name, width, height, values) in [
        ("one.tif", 1, 1, vec![7.0]),
        ("row.tif", 300, 1, ramp(300)),
        ("column.tif", 1, 300, ramp(300)),
        ("pair.tif", 2, 2, ramp(4)),
        ("flat.tif", 64, 64, vec![3.0; 4096]),
        ("few.tif", 12, 9, ramp(108)),
        ("thin.tif", 2, 3000, ramp(6000)),
    ] {
        write(&scratch, name, &Raster::local(width, height, 10.0, values));
        let found = object(&scratch, &format!("{name} -o out --force"));
        let remarks = notes(&found);
        let parts = [
            ("hypsometry: ", "/hypsometry"),
            ("spectrum (rms", "/spectrum/rms"),
            ("dimension (variogram)", "/dimension/variogram"),
            ("slope: ", "/slope_deg"),
            ("exceedance", "/drainage/exceedance"),
            ("horton", "/drainage/horton"),
        ];
        for (part, pointer) in parts {
            let missing = found.pointer(pointer).is_none_or(Value::is_null);
            assert_eq!(missing, remarks.contains(part), "{name} {part}: {found}\n{remarks}");
        }
        assert_eq!(found["depressions"]["count"], 0, "{name}");
        let stem = name.trim_end_matches(".tif");
        assert!(scratch.path(&format!("out/{stem}.png")).is_file(), "{name}");
        assert!(call(&scratch, name).good().contains("hypsometry"), "{name}");
    }
}

#[test]
fn a_raster_with_gaps_is_measured_on_what_it_has() {
    let scratch = Scratch::new("gaps");
    let mut raster = hills(90, 70);
    let whole = raster.clone();
    // A corner, and single cells in the east.
    for cell in 0..90 * 70 {
        let (column, row) = (cell % 90, cell / 90);
        if column + row < 30 || column > 80 && cell % 7 == 0 {
            raster.values[cell] = f64::NAN;
        }
    }
    raster.no_data = Some(-9999.0);
    write(&scratch, "gaps.tif", &raster);
    write(&scratch, "whole.tif", &whole);
    let [gaps, whole] = ["gaps.tif", "whole.tif"].map(|name| object(&scratch, name));
    let share = raster.missing_count() as f64 / 63.0;
    near("gaps", &gaps["no_data_percent"], share, 1e-9);
    let window = &gaps["spectrum"]["window"];
    let size = ["columns", "rows"].map(|key| window[key].as_u64().expect("a number"));
    let start = ["column", "row"].map(|key| window[key].as_u64().expect("a number"));
    assert!(start[0] + start[1] >= 30 && start[0] + size[0] <= 82, "{window}");
    assert!(
        size[0] * size[1] > 3000 && notes(&gaps).contains("largest part without any"),
        "{gaps}"
    );
    assert!(!notes(&whole).contains("gaps"), "{whole}");
    let slopes = [&gaps, &whole].map(|found| found["slope_deg"]["median"].as_f64().unwrap());
    assert!((slopes[0] - slopes[1]).abs() < 2.0, "{slopes:?}");
    call(&scratch, "gaps.tif -o out").good();
    // The same numbers as those of the window alone.
    let part = |cell: usize| {
        let (x, y) = (start[0] as usize + cell % size[0] as usize, cell / size[0] as usize);
        raster.values[x + 90 * (y + start[1] as usize)]
    };
    let values = (0..(size[0] * size[1]) as usize).map(part).collect();
    let cut = Raster::local(size[0] as usize, size[1] as usize, 30.0, values);
    write(&scratch, "cut.tif", &cut);
    let cut = object(&scratch, "cut.tif");
    for key in ["rms", "r2", "scatter_nats"] {
        assert_eq!(cut["spectrum"][key], gaps["spectrum"][key], "{key}");
    }
}

#[test]
fn cells_that_are_oblong_or_degrees_or_unknown_have_their_size() {
    let scratch = Scratch::new("cells");
    let mut raster = hills(80, 60);
    let place = raster.georeference.as_mut().expect("a place");
    *place = Georeference { cell_size: [20.0, 50.0], ..place.clone() };
    write(&scratch, "oblong.tif", &raster);
    let oblong = object(&scratch, "oblong.tif -o out");
    assert_eq!(oblong["cell_m"], serde_json::json!([20.0, 50.0]));
    // 8 periods per side of a square of 1600 m x 3000 m; the longer cells decide on the other end.
    let longest = (1600.0_f64 * 3000.0).sqrt() / 8.0;
    let range = [0, 1].map(|end| oblong["spectrum"]["beta_range_m"][end].as_f64().unwrap());
    assert!((200.0..240.0).contains(&range[0]), "{range:?}");
    assert!(range[1] <= longest && range[1] > 0.9 * longest, "{range:?}");

    let place = raster.georeference.as_mut().expect("a place");
    *place = Georeference { west: 10.0, north: 60.0, cell_size: [0.02, 0.02], ..place.clone() };
    place.coordinate_system = landform::io::CoordinateSystem::from_epsg(4326);
    write(&scratch, "degrees.tif", &raster);
    let degrees = object(&scratch, "degrees.tif");
    assert_eq!(degrees["geographic"], true);
    near("width", &degrees["cell_m"][0], 0.02 * 111_320.0 * 59.4_f64.to_radians().cos(), 5.0);
    near("height", &degrees["cell_m"][1], 0.02 * 111_400.0, 5.0);
    assert!(notes(&degrees).contains("1.8 % wider or narrower"), "{degrees}");

    raster.georeference = None;
    write(&scratch, "bare.npy", &raster);
    let bare = object(&scratch, "bare.npy");
    assert_eq!(bare["cell_m"], serde_json::json!([1.0, 1.0]));
    assert!(notes(&bare).contains("--spacing-m"), "{bare}");
    raster.georeference = Some(Georeference::local(60, 20.0));
    let metadata = Metadata { spacing_m: Some(20.0), ..Metadata::default() };
    write_raster(scratch.path("own.png"), &raster, &metadata, IfExists::Refuse).unwrap();
    let own = object(&scratch, "own.png");
    assert_eq!(own["cell_m"], serde_json::json!([20.0, 20.0]));
    let integral = |found: &Value| found["hypsometry"]["integral"].as_f64().unwrap();
    assert!((integral(&own) - integral(&bare)).abs() < 1e-4, "{own}");
    assert!(!notes(&own).contains("grey"), "{own}");

    let told = object(&scratch, "bare.npy --spacing-m 25");
    assert_eq!(told["cell_m"], serde_json::json!([25.0, 25.0]));
    assert!(!notes(&told).contains("--spacing-m"), "{told}");
}

#[test]
fn wrong_rasters_and_arguments_are_refused() {
    let scratch = Scratch::new("wrong_rasters");
    write(&scratch, "good.tif", &hills(64, 64));
    scratch.write("text.tif", "no TIFF at all");
    scratch.write("picture.jpg", [0xff, 0xd8, 0xff, 0xe0]);
    scratch.write(
        "gone.asc",
        "ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 5\nnodata_value -1\n-1 -1\n",
    );
    scratch.write(
        "huge.asc",
        "ncols 20000\nnrows 20000\nxllcorner 0\nyllcorner 0\ncellsize 5\n1 2 3\n",
    );
    std::fs::create_dir(scratch.path("folder.tif")).unwrap();
    for (line, parts) in [
        ("text.tif", &["text.tif"][..]),
        ("picture.jpg", &["picture.jpg", ".tif, .tiff, .asc, .npy"]),
        ("gone.asc", &["gone.asc", "all 2 cells are without data"]),
        ("folder.tif", &["folder.tif"]),
        ("none.asc", &["none.asc", "No such file"]),
        (
            "huge.asc --memory-limit-gib 8",
            &["20000 x 20000 is more than", "--memory-limit-gib", "8.0 GiB", "80 bytes"],
        ),
        ("good.tif --memory-limit-gib 0.0001", &["64 x 64 is more than", "80 bytes"]),
        ("good.tif --spacing-m 0", &["good.tif: a cell is 0 m wide", "--spacing-m"]),
        ("good.tif --spacing-m nan", &["good.tif: a cell is NaN m wide"]),
        ("good.tif --spacing-m inf", &["good.tif: a cell is inf m wide"]),
        ("good.tif --spacing-m 3km", &["invalid value '3km' for '--spacing-m"]),
    ] {
        let message = call(&scratch, line).refused();
        for part in parts {
            assert!(message.contains(part), "{line}: no `{part}` in\n{message}");
        }
    }
}
