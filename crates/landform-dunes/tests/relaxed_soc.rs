//! Figure 3.1 of the thesis: the spectra of the two relaxed models.

use landform_analysis::{SpectralFit, Spectrum};
use landform_dunes::sandpile::{CorrosionLike, SandLike};
use landform_graph::{Boundary, Connectivity, Lattice};
use landform_synth::{Generator, WhiteNoise};

fn lattice(side: usize) -> Lattice {
    Lattice::plane([side, side], 10.0, Connectivity::Eight, [Boundary::Periodic; 2]).unwrap()
}

fn r_squared(lattice: &Lattice, heights: &[f64]) -> f64 {
    SpectralFit::new(&Spectrum::new(lattice, heights).unwrap()).unwrap().r_squared
}

/// White noise has no fall-off, the hills that it is smoothed into have that of fractional
/// Brownian motion (R2 of 0.331 and more) or better.
#[test]
fn sand_smooths_white_noise_into_hills() {
    let lattice = lattice(128);
    let noise = WhiteNoise { amplitude_m: 100.0, ..Default::default() };
    let mut heights = noise.generate(&lattice, 1).unwrap();
    assert!(r_squared(&lattice, &heights) < 0.05);
    let model = SandLike::default();
    let mut state = model.state(&lattice).unwrap();
    let rested = (0..1000).any(|_| model.step(&lattice, &mut state, &mut heights).unwrap() == 0);
    assert!(rested);
    let after = r_squared(&lattice, &heights);
    assert!(after >= 0.33, "{after}");
}

#[test]
fn corrosion_pits_a_flat_surface_at_all_frequencies() {
    let lattice = lattice(256);
    let model = CorrosionLike::default();
    let mut state = model.state(&lattice, 1).unwrap();
    let mut heights = vec![0.0; lattice.node_count()];
    for _ in 0..100 {
        model.step(&lattice, &mut state, &mut heights).unwrap();
    }
    let after = r_squared(&lattice, &heights);
    assert!(after >= 0.33, "{after}");
}
