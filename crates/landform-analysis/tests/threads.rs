//! Every measure gives the same bits on 1, 2 and 8 threads.

use landform_analysis::derivatives::{Scheme, derivatives};
use landform_analysis::grid::Grid;
use landform_analysis::hydrology::{DInfinity, Drainage, FlowDirections, fill_depressions};
use landform_analysis::{
    HypsometricCurve, RadialSpectrum, Spectrum, perimeter_dimension, variogram_dimension,
};
use landform_graph::{Boundary, Connectivity, Lattice};
use landform_synth::{Generator, SpectralFbm};

const SIZE: [usize; 2] = [150, 97];

fn lattice() -> Lattice {
    Lattice::plane(SIZE, 30.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap()
}

/// A rough terrain with gaps.
fn heights() -> Vec<f64> {
    let fbm = SpectralFbm { amplitude_m: 250.0, ..Default::default() };
    let mut heights = fbm.generate(&lattice(), 4).unwrap();
    heights.iter_mut().skip(3000).step_by(611).for_each(|height| *height = f64::NAN);
    heights
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// What is measured, as text; floating-point numbers are printed with all their digits.
fn on_threads(threads: usize, measure: impl Fn() -> String + Send + Sync) -> String {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(measure)
}

fn same_on_any(measure: impl Fn() -> String + Send + Sync) {
    let alone = on_threads(1, &measure);
    assert!(!alone.is_empty());
    for threads in [2, 8] {
        assert!(on_threads(threads, &measure) == alone, "{threads} threads differ");
    }
}

#[test]
fn drainage_has_the_same_bits() {
    let grid = Grid::new(SIZE, [30.0, 25.0]).unwrap();
    let heights = heights();
    same_on_any(|| {
        let filled = fill_depressions(&grid, &heights).unwrap();
        let directions = FlowDirections::over_filled(&grid, &filled).unwrap();
        let steepest = FlowDirections::steepest(&grid, &heights).unwrap();
        let infinity = DInfinity::over_filled(&grid, &filled).unwrap();
        let drainage = Drainage::over_filled(&grid, &filled).unwrap();
        let areas = bits(&infinity.contributing_area());
        let cells = directions.contributing_cells();
        format!(
            "{:?}{directions:?}{steepest:?}{infinity:?}{areas:?}{cells:?}{drainage:?}",
            bits(&filled)
        )
    });
}

#[test]
fn derivatives_and_dimensions_have_the_same_bits() {
    let grid = Grid::new(SIZE, [30.0, 25.0]).unwrap();
    let heights = heights();
    let land: Vec<bool> = heights.iter().map(|height| *height > 0.0).collect();
    same_on_any(|| {
        let derivatives = derivatives(&grid, &heights, Scheme::Horn).unwrap();
        let variogram = variogram_dimension(&heights, SIZE, [30.0, 25.0]).unwrap();
        let perimeter = perimeter_dimension(&land, SIZE, 30.0).unwrap();
        format!("{derivatives:?}{variogram:?}{perimeter:?}")
    });
}

#[test]
fn spectra_and_curves_have_the_same_bits() {
    let lattice = lattice();
    let heights = SpectralFbm::default().generate(&lattice, 9).unwrap();
    same_on_any(|| {
        let spectrum = Spectrum::new(&lattice, &heights).unwrap();
        let radial = RadialSpectrum::new(&spectrum, 12, [2.0, 40.0]);
        let curve = HypsometricCurve::new(&heights);
        format!("{spectrum:?}{radial:?}{curve:?}")
    });
}
