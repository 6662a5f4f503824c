//! Metrics of terrain in scenarios: they find what the initial condition is made of.

use landform_tests::Run;

/// What is measured of an initial condition.
fn measured(domain: &str, initial: &str, metric: &str) -> Vec<(String, f64)> {
    let text = format!(
        "(title: \"terrain\", domain: Grid({domain}), initial: [(field: \"bed\", from: {initial})],
          stages: [], metrics: [{metric}])"
    );
    let run = Run::of(&text, landform::registry(), 2);
    assert!(run.report.stages.is_empty(), "nothing happens without a stage");
    run.report.initial_metrics.into_iter().collect()
}

fn value(measured: &[(String, f64)], name: &str) -> f64 {
    let found = measured.iter().find(|(known, _)| known == name);
    found.unwrap_or_else(|| panic!("no {name} in {measured:?}")).1
}

const SQUARE: &str = "size: (256, 256), spacing_m: 10.0, boundary: (Periodic, Periodic)";
const OPEN: &str = "size: (96, 64), spacing_m: 10.0";

/// A ramp has the curve 1 - x: a straight one, of the equilibrium stage.
#[test]
fn a_ramp_has_the_hypsometry_of_a_ramp() {
    let found = measured(OPEN, "Ramp(tilt_deg: 10.0)", "Hypsometry()");
    assert!((value(&found, "hypsometry_integral") - 0.5).abs() < 1e-9, "{found:?}");
    assert_eq!(value(&found, "hypsometry_equilibrium"), 1.0);
    for none in ["inequilibrium", "monadnock", "unusual", "convex", "change"] {
        assert_eq!(value(&found, &format!("hypsometry_{none}")), 0.0, "{none}");
    }
    assert!(measured(OPEN, "Uniform(value: 3.0)", "Hypsometry()").is_empty(), "a flat field");
}

/// Sand that slips changes the curve, and the metric says by how much.
#[test]
fn the_change_of_hypsometry_is_since_the_first_measurement() {
    let text = "(title: \"slips\", domain: Grid(size: (64, 64), spacing_m: 10.0),
        initial: [(field: \"sand\", from: WhiteNoise(mean_m: 20.0, amplitude_m: 20.0))],
        stages: [(processes: [SandLike()], stop: Iterations(5))], metrics: [Hypsometry()])";
    let whole = Run::of(text, landform::registry(), 2);
    let changes = whole.series.values("hypsometry_change");
    assert_eq!(changes[0], 0.0);
    assert!(changes[5] > 0.05 && changes[5] <= 1.0, "{changes:?}");
    let broken = Run::broken(text, landform::registry, 3, [1, 2]);
    assert_eq!(broken.series.values("hypsometry_change")[..], changes[..], "after a resume");
}

#[test]
fn a_pit_of_known_size_is_found() {
    let dent = "GaussianHill(height_m: -8.0, radius_m: 60.0)";
    let found = measured(OPEN, dent, "Depressions()");
    assert_eq!(value(&found, "depressions_count"), 1.0, "{found:?}");
    // The rim is not quite level at the borders of the domain.
    assert!((value(&found, "depressions_deepest_m") - 8.0).abs() < 0.5, "{found:?}");
    // Volume of a Gaussian: 2 pi s^2 h.
    let volume = std::f64::consts::TAU * 3600.0 * 8.0;
    assert!((value(&found, "depressions_volume_m3") / volume - 1.0).abs() < 0.1, "{found:?}");
}

/// Noise that nothing has drained: slope hardly depends on area. Where pits keep their water the
/// basins are small.
#[test]
fn noise_is_not_drained_like_a_river_basin() {
    let fbm = "SpectralFbm(amplitude_m: 30.0)";
    let filled = measured(SQUARE, fbm, "Drainage()");
    assert!(value(&filled, "drainage_concavity").abs() < 0.15, "{filled:?}");
    assert!((0.48..0.75).contains(&value(&filled, "drainage_exceedance")), "{filled:?}");
    let kept = measured(SQUARE, fbm, "Drainage(pits: Kept)");
    let [filled, kept] = [filled, kept].map(|found| value(&found, "drainage_largest_basin_m2"));
    assert!(kept < 0.5 * filled, "{kept} {filled}");
}

/// The level sets of a fractional Brownian surface have D = 2 - H, a straight shore D = 1.
#[test]
fn shores_have_the_dimension_of_their_surface() {
    let straight = measured(OPEN, "Ramp(tilt_deg: 10.0)", "ShoreDimension()");
    assert!((value(&straight, "shore_dimension") - 1.0).abs() < 1e-6, "{straight:?}");
    let law = "amplitude_law: ComplexGaussian";
    for hurst in [0.3, 0.7] {
        let fbm = format!("SpectralFbm(hurst: {hurst}, {law})");
        let found = measured(SQUARE, &fbm, "ShoreDimension(level: At(0.0))");
        let dimension = value(&found, "shore_dimension");
        assert!((dimension - (2.0 - hurst)).abs() < 0.15, "{hurst}: {found:?}");
        assert!(value(&found, "longest_shore_dimension") < dimension + 0.1, "{hurst}: {found:?}");
    }
    assert!(measured(SQUARE, "Uniform(value: 1.0)", "ShoreDimension()").is_empty());
}

#[test]
fn waves_that_are_missing_are_counted() {
    let empty = |initial: &str| {
        value(&measured(SQUARE, initial, "SpectralFalloff()"), "spectral_empty_percent")
    };
    assert!(empty("SpectralFbm(hurst: 0.8)") < 1.0);
    let octaves = |count: u32| empty(&format!("FractalNoise(octaves: {count})"));
    let shares = [1, 2, 4, 8].map(octaves);
    assert!(shares.is_sorted_by(|few, many| few > many), "{shares:?}");
    assert!(shares[0] > 90.0 && shares[3] < 1.0, "{shares:?}");
}

/// Figure 2.5: without displacement only the interpolant of the coarse shape is left.
#[test]
fn diamond_square_leaves_creases() {
    let sharpest = |subdivision: &str| {
        let peak = "coarse_m: [[0.0, 0.0, 0.0], [0.0, 80.0, 0.0], [0.0, 0.0, 0.0]]";
        let initial = format!(
            "MidpointDisplacement(amplitude_m: 0.0, levels: 5, subdivision: {subdivision}, {peak})"
        );
        let found = measured("size: (65, 65)", &initial, "Creases(cell_nodes: 32)");
        value(&found, "crease_largest")
    };
    assert!(sharpest("DiamondSquare") >= 2.0 * sharpest("FourEight"));
}

/// Koch's curve of level 6 is (4/3)^6 long; the triangle and Cantor's set have no ends.
#[test]
fn known_lines_have_their_shape() {
    let shape = |of: &str| measured(OPEN, "Uniform()", &format!("LineShape(of: {of})"));
    let koch = shape("Koch(level: 6), scales_m: (4.0, 64.0)");
    assert!((value(&koch, "line_tortuosity") / (4.0_f64 / 3.0).powi(6) - 1.0).abs() < 1e-9);
    assert_eq!(value(&koch, "line_crossings"), 0.0);
    assert!((value(&koch, "line_divider_dimension") - 1.2619).abs() < 0.03, "{koch:?}");
    let triangle = shape("Triangle(level: 7), scales_m: (16.0, 128.0)");
    assert!((value(&triangle, "line_box_dimension") - 1.585).abs() < 0.05, "{triangle:?}");
    assert_eq!(triangle.len(), 1, "{triangle:?}");
    let squig = shape("Squig(level: 7, shortcut: 0.75), scales_m: (8.0, 128.0)");
    assert_eq!(value(&squig, "line_crossings"), 0.0);
    assert!((1.05..1.3).contains(&value(&squig, "line_divider_dimension")), "{squig:?}");
}

/// An aggregate is one tree, a dendrite with two generators two; no branch stands on another.
#[test]
fn branches_make_the_trees_that_they_should() {
    let shape =
        |of: &str| measured(OPEN, "Uniform()", &format!("BranchShape(of: {of}, skipped: 50)"));
    let aggregate = shape("Aggregate(particles: 600)");
    assert_eq!(value(&aggregate, "branch_trees"), 1.0);
    assert!((1.4..2.0).contains(&value(&aggregate, "branch_gyration_dimension")), "{aggregate:?}");
    let two = shape("Dendrite(generators: [(0.0, 0.0, 0.0), (1.0, 1.0, 0.0)])");
    assert_eq!([value(&two, "branch_trees"), value(&two, "branch_meetings")], [2.0, 0.0]);
    assert!((1.0..3.0).contains(&value(&two, "branch_tortuosity")), "{two:?}");
}

/// The distance from a ball is as steep as its bound, 1, and (1 - x) / (1 + x) has the integral
/// 2 ln 2 - 1.
#[test]
fn bounds_of_volumes_and_curves_of_ground_are_the_known_ones() {
    let ball = "VolumeSlope(of: (of: Ball(center_m: (300.0, 300.0, 0.0), radius_m: 90.0)))";
    let found = measured(OPEN, "Uniform()", ball);
    assert!((0.99..=1.0 + 1e-9).contains(&value(&found, "volume_slope_share")), "{found:?}");
    let ground = "HypsometricGround(curve: Strahler(a_over_d: 0.5, z: 1.0))";
    let curve = measured("size: (2001, 2), spacing_m: 1.0", ground, "Hypsometry()");
    let expected = 2.0 * std::f64::consts::LN_2 - 1.0;
    assert!((value(&curve, "hypsometry_integral") - expected).abs() < 1e-3, "{curve:?}");
    assert!((value(&curve, "hypsometry_a_over_d") - 0.5).abs() < 0.05, "{curve:?}");
}
