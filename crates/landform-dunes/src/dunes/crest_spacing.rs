//! Spacing and drift of crests: the wavelength of a dune field and how fast it moves.
//!
//! All read the surface as profiles along the wind. Level fields have no wavelength: the answer is
//! `None`, never a number that means nothing.

use landform_graph::Lattice;
use rayon::prelude::*;

use super::error::{DuneError, check_length};
use super::profiles::Profiles;

/// Mean distance along the wind between places where the surface rises through its mean,
/// metres: the wavelength as counted by up-crossings (field standard for Werner's model).
/// `None` when nothing rises through the mean.
///
/// # Errors
/// [`DuneError::Length`].
pub fn crossing_spacing_m(
    lattice: &Lattice,
    surface: &[f64],
    towards_deg: f64,
) -> Result<Option<f64>, DuneError> {
    check_length("surface", surface.len(), lattice.node_count())?;
    let mean = surface.iter().sum::<f64>() / surface.len() as f64;
    let profiles = Profiles::new(lattice, towards_deg);
    let mut crossings = 0_usize;
    for profile in 0..profiles.count {
        let heights = profiles.heights(surface, profile);
        let rises = |pair: &&[f64]| pair[0] <= mean && pair[1] > mean;
        crossings += heights.windows(2).filter(rises).count();
        let closes =
            profiles.is_cyclic && heights[profiles.length - 1] <= mean && heights[0] > mean;
        crossings += usize::from(closes);
    }
    let along = (surface.len() as f64) * profiles.spacing;
    Ok((crossings > 0).then(|| along / crossings as f64))
}

/// Distance along the wind of the first peak of the surface's autocorrelation after its first
/// trough, metres, refined by a parabola: the wavelength of the strongest regular pattern.
/// `None` for a level surface and where no peak is found within half a profile.
///
/// # Errors
/// [`DuneError::Length`].
pub fn correlation_spacing_m(
    lattice: &Lattice,
    surface: &[f64],
    towards_deg: f64,
) -> Result<Option<f64>, DuneError> {
    check_length("surface", surface.len(), lattice.node_count())?;
    let profiles = Profiles::new(lattice, towards_deg);
    let heights = Heights::new(surface);
    let mut curve = vec![correlation(&profiles, &heights, &heights, 0)];
    // What rounding leaves of a level surface is no relief.
    let scale = surface.iter().fold(0.0, |most: f64, height| most.max(height.abs()));
    if curve[0] <= (1e-12 * scale).powi(2) {
        return Ok(None);
    }
    let mut past_trough = false;
    for lag in 1..=profiles.length / 2 {
        curve.push(correlation(&profiles, &heights, &heights, lag as isize));
        let before = lag - 1;
        if past_trough && curve[before] > curve[before - 1] && curve[before] >= curve[lag] {
            return Ok(Some(profiles.spacing * refined(&curve, before)));
        }
        past_trough |= curve[lag] >= curve[before];
    }
    Ok(None)
}

/// How far a dune field moved downwind between two surfaces, metres, refined below the spacing
/// by a parabola: the shift at which both correlate best, of those up to `furthest_m` either way.
///
/// Dune fields are nearly periodic, so `furthest_m` must be below half a wavelength; divide
/// by the number of ticks for a speed. `None` when either surface is level or when the best
/// shift is the furthest one.
///
/// # Errors
/// [`DuneError::Length`].
pub fn drift_m(
    lattice: &Lattice,
    before: &[f64],
    after: &[f64],
    towards_deg: f64,
    furthest_m: f64,
) -> Result<Option<f64>, DuneError> {
    check_length("before", before.len(), lattice.node_count())?;
    check_length("after", after.len(), lattice.node_count())?;
    let profiles = Profiles::new(lattice, towards_deg);
    let most = ((furthest_m / profiles.spacing) as usize + 1).min(profiles.length / 2) as isize;
    let [before, after] = [before, after].map(Heights::new);
    let curve: Vec<f64> =
        (-most..=most).map(|lag| correlation(&profiles, &before, &after, lag)).collect();
    let best =
        (0..curve.len()).fold(0, |best, lag| if curve[lag] > curve[best] { lag } else { best });
    let level = curve.iter().all(|&value| value == curve[0]);
    let inside = best > 0 && best + 1 < curve.len();
    Ok((inside && !level).then(|| profiles.spacing * (refined(&curve, best) - most as f64)))
}

/// A surface and its mean.
struct Heights<'a> {
    surface: &'a [f64],
    mean: f64,
}

impl<'a> Heights<'a> {
    fn new(surface: &'a [f64]) -> Self {
        Self { surface, mean: surface.iter().sum::<f64>() / surface.len() as f64 }
    }

    fn above_mean(&self, node: usize) -> f64 {
        self.surface[node] - self.mean
    }
}

/// Mean product of one surface with another `lag` places further downwind, each less its mean.
/// Pairs beyond the ends of open profiles are left out. Profiles are added in their order.
fn correlation(profiles: &Profiles, first: &Heights, second: &Heights, lag: isize) -> f64 {
    let length = profiles.length as isize;
    let of_profile = |profile: usize| {
        let (mut sum, mut count) = (0.0, 0_usize);
        for place in 0..length {
            let shifted = match place + lag {
                inside if (0..length).contains(&inside) => inside,
                outside if profiles.is_cyclic => outside.rem_euclid(length),
                _ => continue,
            };
            let here = first.above_mean(profiles.node(profile, place as usize));
            let there = second.above_mean(profiles.node(profile, shifted as usize));
            sum += here * there;
            count += 1;
        }
        (sum, count)
    };
    let sums: Vec<(f64, usize)> = (0..profiles.count).into_par_iter().map(of_profile).collect();
    let sum: f64 = sums.iter().map(|(sum, _)| sum).sum();
    let count: usize = sums.iter().map(|(_, count)| count).sum();
    sum / count.max(1) as f64
}

/// Place of the top of the parabola through a peak of a curve and its two neighbours.
fn refined(curve: &[f64], peak: usize) -> f64 {
    let [before, top, after] = [curve[peak - 1], curve[peak], curve[peak + 1]];
    let bend = before - 2.0 * top + after;
    let shift = if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
    peak as f64 + shift.clamp(-0.5, 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};
    use std::f64::consts::TAU;

    fn lattice(boundary: Boundary) -> Lattice {
        Lattice::plane([240, 12], 10.0, Connectivity::FourEight, [boundary; 2]).unwrap()
    }

    /// Sine dunes of a wavelength in metres, moved east by `shift` metres.
    fn sine(lattice: &Lattice, wavelength: f64, shift: f64) -> Vec<f64> {
        let height = |node| {
            let east = lattice.position(node).x;
            100.0 + 20.0 * (TAU * (east - shift) / wavelength).sin()
        };
        (0..lattice.node_count()).map(height).collect()
    }

    #[test]
    fn sine_dunes_have_their_wavelength() {
        let lattice = lattice(Boundary::Periodic);
        for wavelength in [100.0, 300.0, 400.0, 480.0] {
            let surface = sine(&lattice, wavelength, 3.7);
            for towards in [0.0, 180.0] {
                let counted = crossing_spacing_m(&lattice, &surface, towards).unwrap().unwrap();
                assert!((counted - wavelength).abs() < 1e-9, "{counted} for {wavelength}");
                let correlated =
                    correlation_spacing_m(&lattice, &surface, towards).unwrap().unwrap();
                assert!((correlated - wavelength).abs() < 0.1, "{correlated} for {wavelength}");
            }
        }
    }

    #[test]
    fn the_parabola_finds_wavelengths_between_nodes() {
        // 2400 m hold 8.5 dunes of an open field; its autocorrelation peaks between two nodes.
        let lattice = lattice(Boundary::Open);
        let surface = sine(&lattice, 283.0, 0.0);
        let correlated = correlation_spacing_m(&lattice, &surface, 0.0).unwrap().unwrap();
        assert!((correlated - 283.0).abs() < 4.0, "{correlated}");
    }

    #[test]
    fn drift_is_found_to_a_hundredth_of_a_node() {
        let lattice = lattice(Boundary::Periodic);
        let before = sine(&lattice, 400.0, 0.0);
        for shift in [-87.0, -3.0, 0.0, 0.4, 12.3, 66.6, 150.0] {
            let after = sine(&lattice, 400.0, shift);
            let found = drift_m(&lattice, &before, &after, 0.0, 190.0).unwrap().unwrap();
            assert!((found - shift).abs() < 0.1, "{found} for {shift}");
            let against = drift_m(&lattice, &before, &after, 180.0, 190.0).unwrap().unwrap();
            assert!((found + against).abs() < 1e-6);
        }
        // Further than looked for.
        let after = sine(&lattice, 400.0, 150.0);
        assert_eq!(drift_m(&lattice, &before, &after, 0.0, 60.0).unwrap(), None);
    }

    #[test]
    fn level_surfaces_have_no_wavelength_and_no_drift() {
        for boundary in [Boundary::Periodic, Boundary::Open] {
            let lattice = lattice(boundary);
            let level = vec![0.1; lattice.node_count()];
            assert_eq!(crossing_spacing_m(&lattice, &level, 0.0).unwrap(), None);
            assert_eq!(correlation_spacing_m(&lattice, &level, 0.0).unwrap(), None);
            assert_eq!(drift_m(&lattice, &level, &level, 0.0, 50.0).unwrap(), None);
        }
        let lattice = lattice(Boundary::Open);
        assert!(crossing_spacing_m(&lattice, &[1.0], 0.0).is_err());
        assert!(drift_m(&lattice, &[1.0], &[1.0], 0.0, 50.0).is_err());
    }
}
