//! Table 4.1 of the thesis: dunes by shadow and by protection, from two initial conditions.
//!
//! Medians over five seeds against the bands that count as reproduced. What the thesis leaves
//! open, and how it was settled: the book's page "Calibration of the dunes". The test prints
//! its numbers beside the thesis' own (`cargo test --test table_4_1 -- --nocapture`).

use landform_dunes::dunes::{
    DuneSettings, Engine, FlankSettings, Protection, ProtectionSettings, Refinement, Rose, Shadow,
    ShadowSettings, Shelter, SmoothingSettings, VisibilitySettings, flanks, geometric_shadow,
    near_repose_percent, sand_volume_m3, shadow_error, smooth,
};
use landform_graph::{Boundary, Connectivity, Lattice};
use landform_synth::{Generator, SmoothNoise, WhiteNoise};

/// An initial condition and what the thesis gives with it.
struct InitialCondition {
    /// The thickness of the sand; below zero there is none.
    sand: Box<dyn Generator>,
    /// Wind strength that the thesis gives for protection, metres.
    protection_hop_m: f64,
}

/// Hills of sand: much sand, high relief.
fn first() -> InitialCondition {
    let sand = SmoothNoise {
        mean_m: 180.0,
        standard_deviation_m: 60.0,
        correlation_length_m: 50.0,
        ..SmoothNoise::default()
    };
    InitialCondition { sand: Box::new(sand), protection_hop_m: 80.0 }
}

/// A thin sheet of sand, rough and without hills.
fn second() -> InitialCondition {
    let sand = WhiteNoise { mean_m: 8.0, amplitude_m: 4.0, ..WhiteNoise::default() };
    InitialCondition { sand: Box::new(sand), protection_hop_m: 0.0 }
}

/// What table 4.1 holds, all in per cent.
struct Row {
    near_repose_shadow: f64,
    near_repose_protection: f64,
    error: f64,
    error_on_flanks: f64,
    reduction: f64,
}

fn lattice() -> Lattice {
    let boundary = [Boundary::Periodic; 2];
    Lattice::plane([256, 128], 10.0, Connectivity::FourEight, boundary).unwrap()
}

fn initial_sand(initial: &InitialCondition, seed: u64) -> Vec<f64> {
    let sand = initial.sand.generate(&lattice(), seed).unwrap();
    sand.into_iter().map(|sand| sand.max(0.0)).collect()
}

/// Twenty coarse ticks and three phases of refinement (table 4.2).
fn build_dunes(
    initial: &InitialCondition,
    hop_m: f64,
    seed: u64,
    shelter: &mut dyn Shelter,
) -> Vec<f64> {
    let lattice = lattice();
    let mut sand = initial_sand(initial, seed);
    let bed = vec![0.0; sand.len()];
    let volume = sand_volume_m3(&lattice, &sand);
    let mut settings = DuneSettings::default();
    settings.transport.hop_m = hop_m;
    let slab_m = settings.transport.slab_m;
    let mut engine = Engine::new(lattice.clone(), settings, seed).unwrap();
    engine.settle(&bed, &mut sand).unwrap();
    let refinement = Refinement::default();
    for tick in 0..refinement.ticks() {
        engine.set_slab_m(slab_m * refinement.slab_share(tick)).unwrap();
        engine.tick(&bed, &mut sand, tick, shelter).unwrap();
        let change = sand_volume_m3(&lattice, &sand) / volume - 1.0;
        assert!(change.abs() < 1e-12, "tick {tick}: sand changed by a share of {change:e}");
    }
    sand
}

fn row(initial: &InitialCondition, seed: u64) -> Row {
    let lattice = lattice();
    let rose = Rose::default();
    let near_repose = |surface: &[f64]| near_repose_percent(&lattice, surface, 33.0, 0.1).unwrap();

    // The horizontal ray of the visibility test, as nearly as a shadow that must end can be.
    let horizontal = ShadowSettings { angle_deg: 0.01, ..ShadowSettings::default() };
    let mut shadow = Shadow::new(horizontal).unwrap();
    let by_shadow = build_dunes(initial, 140.0, seed, &mut shadow);

    let settings = ProtectionSettings::default();
    let mut protection = Protection::new(settings, &rose, &lattice).unwrap();
    let mut sand = build_dunes(initial, initial.protection_hop_m, seed, &mut protection);
    let near_repose_protection = near_repose(&sand);

    smooth(&lattice, &SmoothingSettings::default(), &vec![0.0; sand.len()], &mut sand).unwrap();
    let mut emergent = vec![false; sand.len()];
    protection.update(0, &sand).unwrap();
    protection.mark(0, &mut emergent);
    let visibility = VisibilitySettings::default();
    let geometric = geometric_shadow(&lattice, &sand, &rose, &visibility).unwrap();
    let flanks = flanks(&lattice, &sand, 0.0, &FlankSettings::default()).unwrap();
    let error = shadow_error(&emergent, &geometric, &flanks).unwrap();
    Row {
        near_repose_shadow: near_repose(&by_shadow),
        near_repose_protection,
        error: error.all_percent,
        error_on_flanks: error.flanks_percent.unwrap(),
        reduction: error.reduction_percent.unwrap(),
    }
}

fn median(rows: &[Row], value: impl Fn(&Row) -> f64) -> f64 {
    let mut values: Vec<f64> = rows.iter().map(value).collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Medians over five seeds, printed beside the thesis' numbers.
fn medians(name: &str, initial: &InitialCondition, thesis: [f64; 5]) -> Row {
    let rows: Vec<Row> = (1..=5).map(|seed| row(initial, seed)).collect();
    let ours = Row {
        near_repose_shadow: median(&rows, |row| row.near_repose_shadow),
        near_repose_protection: median(&rows, |row| row.near_repose_protection),
        error: median(&rows, |row| row.error),
        error_on_flanks: median(&rows, |row| row.error_on_flanks),
        reduction: median(&rows, |row| row.reduction),
    };
    println!(
        "{name}: near repose, shadow {:.1} (thesis {}), protection {:.1} ({}); error {:.1} ({}), \
         on the flanks {:.1} ({}), reduction {:.1} ({})",
        ours.near_repose_shadow,
        thesis[0],
        ours.near_repose_protection,
        thesis[1],
        ours.error,
        thesis[2],
        ours.error_on_flanks,
        thesis[3],
        ours.reduction,
        thesis[4],
    );
    let mut reductions: Vec<f64> = rows.iter().map(|row| row.reduction).collect();
    reductions.sort_by(f64::total_cmp);
    println!("{name}: reduction by seed {reductions:.1?}");
    ours
}

#[test]
fn first_initial_condition() {
    let ours = medians("IC1", &first(), [19.7, 50.8, 36.5, 10.1, 72.4]);
    assert!(ours.near_repose_protection >= 2.0 * ours.near_repose_shadow);
    assert!(ours.near_repose_shadow > 0.0, "a ratio to nothing means nothing");
    assert!(ours.error > 15.0 && ours.error_on_flanks <= 15.0);
    assert!(ours.reduction >= 70.0);
}

#[test]
fn second_initial_condition() {
    let ours = medians("IC2", &second(), [3.4, 10.2, 20.8, 1.7, 91.9]);
    assert!(ours.near_repose_protection >= 2.0 * ours.near_repose_shadow);
    assert!(ours.near_repose_shadow > 0.0, "a ratio to nothing means nothing");
    assert!(ours.error > 15.0 && ours.error_on_flanks <= 5.0);
    assert!(ours.reduction >= 70.0);
}
