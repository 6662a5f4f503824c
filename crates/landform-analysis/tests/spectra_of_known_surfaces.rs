//! Spectra of surfaces whose spectra are known: the thesis' 33 fractional Brownian surfaces
//! and white noise.

use landform_analysis::{RadialSpectrum, SpectralFit, Spectrum};
use landform_graph::{Boundary, Connectivity, Lattice};
use landform_synth::{AmplitudeLaw, Generator, SpectralFbm, WhiteNoise};

fn lattice(side: usize) -> Lattice {
    Lattice::plane([side, side], 1.0, Connectivity::Eight, [Boundary::Periodic; 2]).unwrap()
}

fn spectrum(lattice: &Lattice, surface: &dyn Generator, seed: u64) -> Spectrum {
    Spectrum::new(lattice, &surface.generate(lattice, seed).unwrap()).unwrap()
}

/// Section 2.1.6: 33 surfaces with H from 0.5 to 0.98 on 256 x 256 nodes gave RMS in
/// 0.199-0.223 and R2 in 0.331-0.526, and at most 3 % of the points were left out. Each bound is
/// the mean over five repetitions of the experiment, each with its own seeds.
#[test]
fn the_thesis_fbm_experiment_is_reproduced() {
    let lattice = lattice(256);
    let repetitions = 5;
    let [mut least, mut most] = [[0.0; 3]; 2];
    for repetition in 0..repetitions {
        let [mut low, mut high] = [[f64::INFINITY; 3], [0.0_f64; 3]];
        for terrain in 0..33 {
            let hurst = 0.5 + 0.48 * terrain as f64 / 32.0;
            let surface = SpectralFbm { hurst, ..Default::default() };
            let spectrum = spectrum(&lattice, &surface, 1000 * repetition + terrain);
            let fit = SpectralFit::new(&spectrum).unwrap();
            let measured = [fit.rms, fit.r_squared, fit.rejected_share];
            for number in 0..3 {
                low[number] = low[number].min(measured[number]);
                high[number] = high[number].max(measured[number]);
            }
        }
        for number in 0..3 {
            least[number] += low[number] / repetitions as f64;
            most[number] += high[number] / repetitions as f64;
        }
    }
    println!("RMS {:.4} to {:.4}", least[0], most[0]);
    println!("R2 {:.4} to {:.4}; rejected at most {:.4}", least[1], most[1], most[2]);
    assert!((least[0] - 0.199).abs() < 0.005 && (most[0] - 0.223).abs() < 0.005);
    assert!((least[1] - 0.331).abs() < 0.01 && (most[1] - 0.526).abs() < 0.01);
    assert!(most[2] < 0.035, "share of points left out: {}", most[2]);
}

/// Scatter of the logarithm of a folded Gaussian: pi / sqrt(8) = 1.1107; of a Rayleigh
/// variable: pi / sqrt(24) = 0.6413.
#[test]
fn the_amplitude_laws_scatter_as_theory_says() {
    let lattice = lattice(128);
    let pi = std::f64::consts::PI;
    for (amplitude_law, expected) in [
        (AmplitudeLaw::RealGaussian, pi / 8.0_f64.sqrt()),
        (AmplitudeLaw::ComplexGaussian, pi / 24.0_f64.sqrt()),
    ] {
        // Heights large enough that the floor rejects nothing.
        let surface = SpectralFbm { amplitude_m: 1e9, amplitude_law, ..Default::default() };
        let fit = SpectralFit::new(&spectrum(&lattice, &surface, 2)).unwrap();
        assert_eq!(fit.rejected_share, 0.0);
        assert!((fit.scatter_nats / expected - 1.0).abs() < 0.03, "{amplitude_law:?} {fit:?}");
        assert!((fit.slope + 1.8).abs() < 0.05, "{amplitude_law:?} {fit:?}");
    }
}

#[test]
fn white_noise_has_no_fall_off() {
    let lattice = lattice(256);
    for seed in 0..5 {
        let noise = WhiteNoise { amplitude_m: 10.0, ..Default::default() };
        let spectrum = spectrum(&lattice, &noise, seed);
        let fit = SpectralFit::new(&spectrum).unwrap();
        assert!(fit.r_squared < 0.002, "seed {seed}: {fit:?}");
        let exponent = RadialSpectrum::usual(&spectrum).exponent().unwrap();
        assert!(exponent.beta.abs() < 0.15, "seed {seed}: {exponent:?}");
        assert!(exponent.beta.abs() < 4.0 * exponent.beta_error, "seed {seed}: {exponent:?}");
    }
}

#[test]
fn the_radial_exponent_measures_the_hurst_exponent() {
    let lattice = lattice(512);
    for hurst in [0.3, 0.5, 0.7, 0.9] {
        let amplitude_law = AmplitudeLaw::ComplexGaussian;
        let surface = SpectralFbm { hurst, amplitude_law, ..Default::default() };
        let measured: Vec<f64> = (0..4)
            .map(|seed| spectrum(&lattice, &surface, seed))
            .map(|spectrum| RadialSpectrum::usual(&spectrum).exponent().unwrap().hurst())
            .collect();
        let mean = measured.iter().sum::<f64>() / 4.0;
        assert!((mean - hurst).abs() < 0.02, "{hurst}: {measured:?}");
    }
}

#[test]
fn same_bits_on_any_number_of_threads() {
    let lattice = lattice(100);
    let heights = SpectralFbm::default().generate(&lattice, 1).unwrap();
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| Spectrum::new(&lattice, &heights).unwrap())
    };
    assert_eq!(on(1), on(8));
}
