//! What the fields of the generators look like.

use landform_graph::{Boundary, Connectivity, Lattice};
use landform_synth::*;

fn plane(size: [usize; 2], boundary: [Boundary; 2]) -> Lattice {
    Lattice::plane(size, 10.0, Connectivity::Eight, boundary).unwrap()
}

fn periodic(size: [usize; 2]) -> Lattice {
    plane(size, [Boundary::Periodic; 2])
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn standard_deviation(values: &[f64]) -> f64 {
    let mean = mean(values);
    (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt()
}

/// The field moved east by `columns` and south by `rows` on a lattice that repeats.
fn moved(lattice: &Lattice, field: &[f64], [columns, rows]: [usize; 2]) -> Vec<f64> {
    let [width, height, _] = lattice.size();
    (0..field.len())
        .map(|node| {
            let x = (node % width + width - columns) % width;
            let y = (node / width + height - rows) % height;
            field[x + width * y]
        })
        .collect()
}

fn same(first: &[f64], second: &[f64]) -> bool {
    first.iter().zip(second).all(|(a, b)| (a - b).abs() < 1e-9)
}

#[test]
fn white_noise_has_the_moments_of_its_distribution() {
    let lattice = periodic([256, 256]);
    let noise = WhiteNoise { mean_m: 3.0, amplitude_m: 2.0, ..WhiteNoise::default() };
    let field = noise.generate(&lattice, 1).unwrap();
    assert!(field.iter().all(|v| (1.0..=5.0).contains(v)));
    assert!((mean(&field) - 3.0).abs() < 0.02);
    assert!((standard_deviation(&field) - 2.0 / 3.0_f64.sqrt()).abs() < 0.01);

    let noise = WhiteNoise { distribution: Distribution::Gaussian, ..noise };
    let field = noise.generate(&lattice, 1).unwrap();
    assert!((mean(&field) - 3.0).abs() < 0.03);
    assert!((standard_deviation(&field) - 2.0).abs() < 0.03);
    let beyond = field.iter().filter(|v| (*v - 3.0).abs() > 4.0).count() as f64;
    assert!((beyond / 65_536.0 - 0.0455).abs() < 0.005, "share beyond two standard deviations");
}

#[test]
fn smooth_noise_has_its_standard_deviation_and_length() {
    let lattice = periodic([240, 240]);
    for distribution in [Distribution::Uniform, Distribution::Gaussian] {
        let noise = SmoothNoise {
            mean_m: -4.0,
            standard_deviation_m: 2.0,
            correlation_length_m: 60.0,
            distribution,
        };
        let field = noise.generate(&lattice, 4).unwrap();
        assert!((mean(&field) + 4.0).abs() < 0.25);
        assert!((standard_deviation(&field) - 2.0).abs() < 0.2);
        // Correlation of a cubic spline: 1191/2416 at one cell, 1/2416 at three, 0 at four.
        let correlation = |columns| {
            let other = moved(&lattice, &field, [columns, 0]);
            let products: Vec<f64> =
                field.iter().zip(&other).map(|(a, b)| (a + 4.0) * (b + 4.0)).collect();
            mean(&products) / standard_deviation(&field).powi(2)
        };
        assert!((correlation(6) - 1191.0 / 2416.0).abs() < 0.08, "{}", correlation(6));
        assert!(correlation(24).abs() < 0.12, "{}", correlation(24));
    }
}

/// The step over the seam is an ordinary one: as large as those elsewhere at most.
#[test]
fn smooth_fields_close_on_periodic_axes() {
    let lattice = periodic([50, 34]);
    let noise = FractalNoise { wavelength_m: 150.0, octaves: 3, ..Default::default() };
    let generators: [(&str, Box<dyn Generator>); 8] = [
        ("gradient noise", Box::new(noise)),
        ("simplex noise", Box::new(FractalNoise { basis: Basis::Simplex, ..noise })),
        ("warped noise", Box::new(FractalNoise { warp: Some(Warp::default()), ..noise })),
        ("SmoothNoise", Box::new(SmoothNoise::default())),
        ("Sinusoid", Box::new(Sinusoid { direction_deg: 30.0, ..Default::default() })),
        ("Cone", Box::new(Cone { center: [0.03, 0.98], ..Default::default() })),
        ("GaussianHill", Box::new(GaussianHill { center: [1.0, 0.1], ..Default::default() })),
        ("SpectralFbm", Box::new(SpectralFbm { hurst: 1.0, ..Default::default() })),
    ];
    for (name, generator) in generators {
        let field = generator.generate(&lattice, 9).unwrap();
        let step = |node: usize, other: usize| (field[node] - field[other]).abs();
        let east = |x: usize| (0..34).map(move |y| step(x + 50 * y, (x + 1) % 50 + 50 * y));
        let south = |y: usize| (0..50).map(move |x| step(x + 50 * y, x + 50 * ((y + 1) % 34)));
        let largest = (0..49).flat_map(east).chain((0..33).flat_map(south)).fold(0.0, f64::max);
        let seam = east(49).chain(south(33)).fold(0.0, f64::max);
        assert!(seam <= largest * 1.05 && seam > 0.0, "{name}: {seam} > {largest}");
    }
}

/// All ways to make fractal noise, with their names.
fn fractal_noises() -> Vec<(String, FractalNoise)> {
    use Basis::{CellularDifference, CellularNearest, CellularSecond, Gradient, Simplex};
    use OctaveShape::{CrossedRidges, Plain, Ridges, SharpRidges, Turbulence};
    let plain = FractalNoise { wavelength_m: 120.0, octaves: 4, ..Default::default() };
    let mut all = Vec::new();
    for basis in [Gradient, Simplex, CellularNearest, CellularSecond, CellularDifference] {
        for shape in [Plain, Turbulence, Ridges, SharpRidges, CrossedRidges] {
            for cascade in [
                Cascade::Sum,
                Cascade::Multiplicative { offset: 1.0 },
                Cascade::Hybrid { offset: 0.7 },
                Cascade::Ridged { gain: 2.0 },
            ] {
                let name = format!("{basis:?} {shape:?} {cascade:?}");
                all.push((name, FractalNoise { basis, shape, cascade, ..plain }));
            }
        }
    }
    all
}

/// A larger lattice shows more of the same surface, bit for bit, whatever it is made of.
#[test]
fn fractal_noise_is_a_function_of_the_place() {
    let open = [Boundary::Open; 2];
    let [small, large] = [plane([30, 20], open), plane([47, 33], open)];
    for (name, noise) in fractal_noises() {
        let noise = FractalNoise { warp: Some(Warp::default()), ..noise };
        let [part, whole] = [&small, &large].map(|lattice| noise.generate(lattice, 8).unwrap());
        for (row, heights) in part.chunks(30).enumerate() {
            // Both lattices have their south-western node in common.
            let start = 47 * (row + 13);
            assert_eq!(heights, &whole[start..start + 30], "{name}");
        }
    }
}

/// A single octave of any basis and shape stays between -1 and 1.
#[test]
fn octaves_keep_to_their_range() {
    let lattice = plane([200, 200], [Boundary::Open; 2]);
    for (name, noise) in fractal_noises() {
        if noise.cascade == Cascade::Sum {
            let noise = FractalNoise { amplitude_m: 1.0, octaves: 1, ..noise };
            let field = noise.generate(&lattice, 3).unwrap();
            assert!(field.iter().all(|height| (-1.0..=1.0).contains(height)), "{name}");
            assert!(standard_deviation(&field) > 0.1, "{name}");
        }
    }
}

/// Share of the curvature of a surface that lies in the upper half of its heights.
fn roughness_above_the_median(field: &[f64], width: usize) -> f64 {
    let mut heights = field.to_vec();
    heights.sort_by(f64::total_cmp);
    let median = heights[heights.len() / 2];
    let [mut above, mut all] = [0.0; 2];
    for node in width + 1..field.len() - width - 1 {
        let around = field[node - 1] + field[node + 1] + field[node - width] + field[node + width];
        let curvature = (around - 4.0 * field[node]).abs();
        all += curvature;
        above += if field[node] > median { curvature } else { 0.0 };
    }
    above / all
}

/// Fractional Brownian motion is equally rough everywhere, multifractals where they are high.
#[test]
fn multifractals_are_rough_where_they_are_high() {
    let lattice = plane([256, 256], [Boundary::Open; 2]);
    let plain = FractalNoise { wavelength_m: 640.0, hurst: 0.5, ..Default::default() };
    let share = |noise: FractalNoise| {
        let shares: Vec<f64> = (0..5)
            .map(|seed| roughness_above_the_median(&noise.generate(&lattice, seed).unwrap(), 256))
            .collect();
        mean(&shares)
    };
    assert!((share(plain) - 0.5).abs() < 0.03, "{}", share(plain));
    for cascade in [Cascade::Multiplicative { offset: 1.0 }, Cascade::Hybrid { offset: 0.7 }] {
        let share = share(FractalNoise { cascade, ..plain });
        assert!(share > 0.55, "{cascade:?}: {share}");
    }
}

#[test]
fn nested_parameters_are_checked() {
    let lattice = plane([30, 20], [Boundary::Open; 2]);
    let noise = FractalNoise::default();
    let wrong = [
        FractalNoise { cascade: Cascade::Hybrid { offset: f64::NAN }, ..noise },
        FractalNoise { cascade: Cascade::Ridged { gain: 11.0 }, ..noise },
        FractalNoise { warp: Some(Warp { octaves: 0, ..Default::default() }), ..noise },
        FractalNoise { warp: Some(Warp { wavelength_m: 1.0, ..Default::default() }), ..noise },
        FractalNoise { warp: Some(Warp { amplitude_m: 1e9, ..Default::default() }), ..noise },
    ];
    for noise in wrong {
        let refused = noise.generate(&lattice, 0).unwrap_err();
        assert!(matches!(refused, SynthError::OutOfRange { .. }), "{refused}");
    }
}

#[test]
fn hills_move_with_their_centre() {
    let lattice = periodic([40, 20]);
    let cone = |center| Cone { center, ..Default::default() }.generate(&lattice, 0).unwrap();
    // Half a width east and a quarter of the height north.
    let expected = moved(&lattice, &cone([0.25, 0.5]), [20, 15]);
    assert!(same(&cone([0.75, 0.75]), &expected));
}

#[test]
fn a_cone_has_its_height_slope_and_volume() {
    let lattice = plane([81, 81], [Boundary::Open; 2]);
    let field = Cone { base_m: 7.0, height_m: 60.0, radius_m: 300.0, center: [0.5; 2] }
        .generate(&lattice, 0)
        .unwrap();
    assert!((field[40 + 81 * 40] - 67.0).abs() < 1e-9);
    assert!((field[40 + 81 * 40] - field[45 + 81 * 40] - 10.0).abs() < 1e-9);
    let volume: f64 = field.iter().map(|height| (height - 7.0) * 100.0).sum();
    let expected = std::f64::consts::PI * 300.0_f64.powi(2) * 60.0 / 3.0;
    assert!((volume / expected - 1.0).abs() < 0.01);
}

#[test]
fn a_gaussian_hill_has_its_radius() {
    let lattice = plane([81, 81], [Boundary::Open; 2]);
    let field = GaussianHill { base_m: 0.0, height_m: 10.0, radius_m: 100.0, center: [0.5; 2] }
        .generate(&lattice, 0)
        .unwrap();
    assert!((field[50 + 81 * 40] - 10.0 * (-0.5_f64).exp()).abs() < 1e-9);
}

#[test]
fn a_ramp_rises_where_it_is_said_to() {
    let lattice = plane([5, 9], [Boundary::Open; 2]);
    let north = Ramp { lowest_m: 2.0, tilt_deg: 45.0, uphill_deg: 90.0 };
    let field = north.generate(&lattice, 0).unwrap();
    assert!((field[0] - 82.0).abs() < 1e-9, "row 0 is the northern one");
    assert!((field[5 * 8 + 3] - 2.0).abs() < 1e-9);
    let west = Ramp { uphill_deg: 180.0, ..north }.generate(&lattice, 0).unwrap();
    assert!((west[0] - 42.0).abs() < 1e-9 && (west[4] - 2.0).abs() < 1e-9);

    let lattice = plane([5, 9], [Boundary::Periodic, Boundary::Open]);
    assert!(north.generate(&lattice, 0).is_ok());
    let refused = Ramp { uphill_deg: 0.0, ..north }.generate(&lattice, 0).unwrap_err();
    assert!(matches!(refused, SynthError::DoesNotClose { axis: 'x', .. }), "{refused}");
}

#[test]
fn a_wave_has_its_length_direction_and_phase() {
    let lattice = plane([40, 40], [Boundary::Open; 2]);
    let wave = Sinusoid { wavelength_m: 80.0, direction_deg: 90.0, ..Default::default() };
    let field = wave.generate(&lattice, 0).unwrap();
    let south = 40 * 39;
    assert!(field[south].abs() < 1e-9, "starts at the mean in the south-west");
    assert!((field[south - 40 * 2] - 1.0).abs() < 1e-9, "crest a quarter of a wave north");
    assert!(same(&field[..40 * 32], &field[40 * 8..]), "repeats after 8 nodes");
    assert!((field[3] - field[17]).abs() < 1e-9, "alike along the crest");

    let small = periodic([4, 4]);
    let refused = Sinusoid { wavelength_m: 300.0, ..wave }.generate(&small, 0).unwrap_err();
    assert!(matches!(refused, SynthError::DoesNotClose { axis: 'y', .. }), "{refused}");
}

#[test]
fn a_ridge_lies_across_the_wind() {
    let lattice = periodic([40, 20]);
    let ridge = Ridge { height_m: 10.0, width_m: 100.0, place: 0.0, ..Default::default() };
    let field = ridge.generate(&lattice, 0).unwrap();
    assert_eq!(field[40 * 7], 10.0);
    assert!((field[1] - 8.0).abs() < 1e-9 && (field[39] - 8.0).abs() < 1e-9);
    assert_eq!(field[20], 0.0);
    let turned = Ridge { course: RidgeCourse::EastWest, place: 0.5, ..ridge };
    let field = turned.generate(&lattice, 0).unwrap();
    let highest = (0..20).max_by(|a, b| field[40 * a].total_cmp(&field[40 * b])).unwrap();
    assert!((9..=10).contains(&highest), "row {highest}");
}
