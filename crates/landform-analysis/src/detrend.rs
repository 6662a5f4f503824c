//! What a terrain that does not repeat needs before its spectrum is taken.

use std::f64::consts::TAU;

use landform_graph::Lattice;

use crate::AnalysisError;
use crate::spectrum::check;

/// Subtracts the plane that fits `heights` best by least squares, and with it the mean.
///
/// # Errors
/// [`AnalysisError`] if the field does not fit the 2-D lattice or holds a value that is not
/// finite; `heights` is unchanged then.
pub fn remove_plane(lattice: &Lattice, heights: &mut [f64]) -> Result<(), AnalysisError> {
    check(lattice, heights)?;
    let [width, height] = [lattice.width(), lattice.height()];
    let mean = heights.iter().sum::<f64>() / heights.len() as f64;
    // Column and row numbers about their means are orthogonal, so each tilt is found alone.
    let from_middle = |index: usize, count: usize| index as f64 - (count - 1) as f64 / 2.0;
    let moment = |count: usize| (0..count).map(|i| from_middle(i, count).powi(2)).sum::<f64>();
    let [mut east, mut south] = [0.0; 2];
    for (node, value) in heights.iter().enumerate() {
        east += (value - mean) * from_middle(node % width, width);
        south += (value - mean) * from_middle(node / width, height);
    }
    // A single column or row has no tilt; its moment is 0, as is its sum.
    east /= (moment(width) * height as f64).max(f64::MIN_POSITIVE);
    south /= (moment(height) * width as f64).max(f64::MIN_POSITIVE);
    for (node, value) in heights.iter_mut().enumerate() {
        let [x, y] = [from_middle(node % width, width), from_middle(node / width, height)];
        *value -= mean + east * x + south * y;
    }
    Ok(())
}

/// Multiplies `heights` by a Hann window along the axes that do not repeat, so that they fall
/// to 0 at open borders; periodic axes are left alone.
///
/// The window is scaled to keep the mean square of a field that is alike everywhere, so powers
/// need no correction. Remove the plane first.
///
/// # Errors
/// [`AnalysisError`] if the field does not fit the 2-D lattice or holds a value that is not
/// finite; `heights` is unchanged then.
pub fn taper(lattice: &Lattice, heights: &mut [f64]) -> Result<(), AnalysisError> {
    check(lattice, heights)?;
    let width = lattice.width();
    let columns = window(width, lattice.is_periodic(0));
    let rows = window(lattice.height(), lattice.is_periodic(1));
    for (node, value) in heights.iter_mut().enumerate() {
        *value *= columns[node % width] * rows[node / width];
    }
    Ok(())
}

/// Hann window over `count` nodes with a mean square of 1.
fn window(count: usize, periodic: bool) -> Vec<f64> {
    if periodic || count == 1 {
        return vec![1.0; count];
    }
    let hann = |index: usize| 0.5 - 0.5 * (TAU * (index as f64 + 0.5) / count as f64).cos();
    let mean_square = (0..count).map(|index| hann(index).powi(2)).sum::<f64>() / count as f64;
    (0..count).map(|index| hann(index) / mean_square.sqrt()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{RadialSpectrum, Spectrum};
    use landform_graph::{Boundary, Connectivity};

    fn lattice(boundary: Boundary) -> Lattice {
        Lattice::plane([96, 64], 1.0, Connectivity::Eight, [boundary, Boundary::Open]).unwrap()
    }

    #[test]
    fn a_plane_vanishes() {
        let lattice = lattice(Boundary::Open);
        let mut heights: Vec<f64> = (0..96 * 64)
            .map(|node| 4.0 + 0.5 * (node % 96) as f64 - 2.0 * (node / 96) as f64)
            .collect();
        remove_plane(&lattice, &mut heights).unwrap();
        assert!(heights.iter().all(|height| height.abs() < 1e-11));
        let line = Lattice::plane([1, 3], 1.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
        let mut heights = [1.0, 2.0, 6.0];
        remove_plane(&line, &mut heights).unwrap();
        assert!((heights[0] - 0.5).abs() < 1e-12, "{heights:?}");
    }

    #[test]
    fn only_open_axes_are_tapered_and_power_is_kept() {
        let mut heights = vec![1.0; 96 * 64];
        taper(&lattice(Boundary::Periodic), &mut heights).unwrap();
        assert_eq!(heights[0], heights[95]);
        assert!(heights[0] < 0.01 && heights[96 * 32] > 1.5);
        let mean_square = heights.iter().map(|h| h * h).sum::<f64>() / heights.len() as f64;
        assert!((mean_square - 1.0).abs() < 1e-12);
    }

    /// A smooth surface that does not repeat seems to fall off slowly because of the step at
    /// its borders; both steps together show how smooth it is.
    #[test]
    fn detrending_shows_a_smooth_surface_as_smooth() {
        let lattice = lattice(Boundary::Open);
        let mut heights: Vec<f64> = (0..96 * 64)
            .map(|node| ((node % 96) as f64 / 40.0).exp() + (node / 96) as f64 / 20.0)
            .collect();
        let beta = |heights: &[f64]| {
            let spectrum = Spectrum::new(&lattice, heights).unwrap();
            RadialSpectrum::new(&spectrum, 10, [4.0, 20.0]).exponent().unwrap().beta
        };
        let stepped = beta(&heights);
        remove_plane(&lattice, &mut heights).unwrap();
        taper(&lattice, &mut heights).unwrap();
        assert!(stepped < 3.5 && beta(&heights) > 4.5, "{stepped} {}", beta(&heights));
    }
}
