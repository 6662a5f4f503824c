//! Rivers on rasters: where data end, and back at the same place on Earth.

use std::fs;
use std::path::Path;

use landform::io::{
    CoordinateSystem, Georeference, IfExists, Metadata, Raster, read_raster, write_raster,
};
use landform_tests::{Program, Run, Scratch, hills, repository};
use serde_json::Value;

/// Hills in zone 11 of UTM.
fn placed_hills(width: usize, height: usize) -> Raster {
    let mut raster = hills(width, height);
    raster.georeference = Some(Georeference {
        west: 376_313.66,
        north: 3_824_537.83,
        coordinate_system: CoordinateSystem::from_epsg(32611),
        ..Georeference::local(height, 30.0)
    });
    raster
}

/// The same with a hole, and without a corner.
fn holey() -> Raster {
    let mut raster = placed_hills(48, 40);
    for (cell, value) in raster.values.iter_mut().enumerate() {
        let (x, y) = ((cell % 48) as f64, (cell / 48) as f64);
        if (x - 30.0).hypot(y - 25.0) <= 5.0 || x + y < 14.0 {
            *value = f64::NAN;
        }
    }
    raster.no_data = Some(-9999.0);
    raster
}

fn write(path: &Path, raster: &Raster) {
    write_raster(path, raster, &Metadata::default(), IfExists::Replace).expect("a raster");
}

/// Runs the scenario of the gallery on `dem.tif` of a folder.
fn run(scratch: &Scratch, sets: &[&str]) -> Value {
    let mut options = vec!["domain.path=dem.tif", "stages[0].stop=Iterations(10)"];
    options.extend(["stages[1].stop=Iterations(10)"].iter().chain(sets));
    // Paths are relative to the scenario.
    let scenario = repository().join("scenarios/gallery/rivers_on_dem.ron");
    fs::copy(scenario, scratch.path("rivers.ron")).expect("the scenario can be read");
    let options = options.iter().flat_map(|set| ["--set", set]);
    Program::within(scratch.folder())
        .line("run rivers.ron -o o --quiet")
        .args(options)
        .run()
        .good();
    let report = fs::read_to_string(scratch.path("o/report.json")).expect("a report");
    serde_json::from_str(&report).expect("JSON")
}

#[test]
fn rivers_leave_where_data_end_and_rasters_return_to_their_place() {
    let scratch = Scratch::new("holey");
    let before = holey();
    write(&scratch.path("dem.tif"), &before);
    let report = run(&scratch, &[]);
    let missing =
        |raster: &Raster| -> Vec<bool> { raster.values.iter().map(|v| v.is_nan()).collect() };
    let [bed, water] = ["bed", "water"].map(|name| {
        let raster = read_raster(scratch.path(&format!("o/{name}.tif"))).expect("a raster");
        // The system is read from keys, which the first raster had none of.
        let [there, back] = [&before, &raster].map(|raster| raster.georeference.clone().unwrap());
        let place = |place: &Georeference| (place.west, place.north, place.cell_size);
        assert_eq!(place(&back), place(&there));
        assert_eq!(back.coordinate_system.epsg, Some(32611));
        assert_eq!(missing(&raster), missing(&before), "{name}");
        assert_eq!(raster.no_data, Some(-9999.0));
        raster
    });
    let change = |cell: usize| bed.values[cell] - before.values[cell];
    assert!((0..48 * 40).any(|cell| change(cell) < -1.0), "rivers have cut");
    // Water is gone from the edge and never stood in front of it.
    let beside_hole = 25 * 48 + 24;
    assert_eq!(water.values[beside_hole], 0.0);
    assert!(water.values[beside_hole + 1].is_nan());
    let accounts = &report["ledger"]["accounts"];
    let left = |place: &str| accounts["water"]["left"][place].as_f64().unwrap_or(0.0);
    assert!(left("edge of the map") > left("west border"), "{accounts}");
    assert!(left("west border") > 0.0);
    for account in ["bed", "water"] {
        assert!(accounts[account]["largest_gap"].as_f64().unwrap() < 1e-12, "{accounts}");
    }
    let notes = report["warnings"].to_string();
    let count = missing(&before).iter().filter(|&&missing| missing).count();
    assert!(notes.contains(&format!("{count} nodes without data lie outside")), "{notes}");
}

/// A map in a frame without data is worn as the map alone.
#[test]
fn an_edge_of_data_is_an_open_border() {
    const FRAME: usize = 3;
    let [alone, framed] = [Scratch::new("alone"), Scratch::new("framed")];
    let map = placed_hills(48, 40);
    let width = 48 + 2 * FRAME;
    let within = |cell: usize| {
        let [x, y] = [cell % width, cell / width].map(|at| at.checked_sub(FRAME));
        x.zip(y).filter(|&(x, y)| x < 48 && y < 40).map(|(x, y)| x + 48 * y)
    };
    let mut wider = placed_hills(width, 40 + 2 * FRAME);
    for (cell, value) in wider.values.iter_mut().enumerate() {
        *value = within(cell).map_or(f64::NAN, |cell| map.values[cell]);
    }
    write(&alone.path("dem.tif"), &map);
    write(&framed.path("dem.tif"), &wider);
    let [small, large] = [&alone, &framed].map(|scratch| {
        run(scratch, &[]);
        read_raster(scratch.path("o/bed.tif")).expect("a raster").values
    });
    // What is worn at nodes so far from the border, and by how much both runs differ there.
    let worn = |least: usize| {
        let far = |cell: usize| {
            let [x, y] = [cell % 48, cell / 48];
            x.min(47 - x).min(y).min(39 - y) >= least
        };
        let pairs = (0..wider.values.len()).filter_map(|at| Some((at, within(at)?)));
        pairs.filter(|&(_, cell)| far(cell)).fold([0.0, 0.0], |[worn, apart], (at, cell)| {
            [worn + map.values[cell] - small[cell], apart + (large[at] - small[cell]).abs()]
        })
    };
    // Slopes at a border are fitted to fewer nodes, those at the edge of a map to level ground.
    for (least, share) in [(0, 0.1), (8, 0.02)] {
        let [worn, apart] = worn(least);
        assert!(worn > 1.0 * 48.0 * 40.0, "{worn} m");
        assert!(apart < share * worn, "{least}: {apart} m of {worn} m");
    }
}

#[test]
fn thinned_rasters_keep_the_middles_of_their_cells() {
    let scratch = Scratch::new("thinned");
    write(&scratch.path("dem.tif"), &placed_hills(48, 40));
    run(&scratch, &["domain.every=3"]);
    let place = read_raster(scratch.path("o/bed.tif")).unwrap().georeference.unwrap();
    assert_eq!(place.cell_size, [90.0; 2]);
    assert_eq!(place.west + 45.0, 376_313.66 + 15.0);
    assert_eq!(place.north - 45.0, 3_824_537.83 - 15.0);
}

#[test]
fn oblong_cells_are_named_with_the_error_of_slopes() {
    let scratch = Scratch::new("oblong");
    let mut raster = hills(48, 40);
    raster.georeference = Some(Georeference {
        west: -119.7,
        north: 60.0,
        cell_size: [1.0 / 3600.0; 2],
        coordinate_system: CoordinateSystem::from_epsg(4326),
        ..Georeference::local(40, 1.0)
    });
    write(&scratch.path("dem.tif"), &raster);
    let notes = run(&scratch, &[])["warnings"].to_string();
    // An arc second at 60 degrees north: 15.5 by 30.9 m on the ellipsoid.
    let known = "15.5 m by 30.9 m are taken as squares of 21.9 m: \
                 slopes are off by -29 % from east to west and +41 % from north to south";
    assert!(notes.contains(known), "{notes}");
}

/// Ground, cells and weights that are all four times as large wear alike: the rule by which the
/// book says to choose weights.
#[test]
fn weights_go_with_the_cell() {
    let bed = |factor: f64| {
        let text = format!(
            r#"(title: "Scaled", seed: 5,
            domain: Grid(size: (48, 40), spacing_m: {spacing}, connectivity: Eight, boundary: (Open, Open)),
            initial: [
                (field: "bed", from: Ramp(tilt_deg: 12.0, uphill_deg: 90.0)),
                (field: "bed", combine: Add, from: WhiteNoise(amplitude_m: {noise})),
            ],
            stages: [(
                name: "rivers",
                processes: [
                    WaterColumn(rain_m: {rain}),
                    HydraulicErosion(diffusion_m2: {diffusion}, incision_m: {incision}, bed_erosion_m: {floor}, avalanche_radius_m: {reach}),
                ],
                stop: Iterations(5),
            )],
        )"#,
            spacing = 10.0 * factor,
            noise = 4.0 * factor,
            rain = factor / 64.0,
            diffusion = 10.0 * factor * factor,
            incision = 3.0 * factor,
            floor = 1.5 * factor,
            reach = 100.0 * factor,
        );
        Run::of(&text, landform::registry(), 1).field("bed").to_vec()
    };
    let [small, large] = [bed(1.0), bed(4.0)];
    let far = small.iter().zip(&large).map(|(small, large)| (4.0 * small - large).abs());
    let far = far.fold(0.0, f64::max);
    // Later the last bits of a level may send water another way.
    assert!(far < 1e-6, "{far} m");
}
