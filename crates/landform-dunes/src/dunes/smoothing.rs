//! Smoothing: the final diffusion of sand (thesis, equation 4.1).
//!
//! `dh/dt = K lap(h)` with h the surface (metres), t counted in steps and K the diffusivity
//! times the step (square metres). Explicit Euler, five-point Laplacian, in flux form: along
//! every axis edge `K / spacing^2 (h_u - h_v)` metres of sand go down. A node that would give
//! more sand than it has gives all of it, in proportion: the hard bed is never smoothed.
//!
//! Stable and free of new extremes while `K <= spacing^2 / 4`. The thesis' K = 5 with one unit of time a step and a
//! spacing of 10 m is 0.05 spacings squared. Conserves sand to rounding.

use landform_graph::Lattice;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::{DuneError, check_length};
use super::plane::Plane;

/// How much the sand is smoothed at the end (thesis, table 4.2).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SmoothingSettings {
    /// Diffusivity times the step in square metres, from 0 to a quarter of the spacing
    /// squared. Default 5 (thesis, with a step of one unit of time).
    pub diffusivity_m2: f64,
    /// Number of steps. Default 10 (thesis).
    pub steps: u32,
}

impl Default for SmoothingSettings {
    fn default() -> Self {
        Self { diffusivity_m2: 5.0, steps: 10 }
    }
}

impl SmoothingSettings {
    /// Checks that the scheme is stable on a lattice.
    ///
    /// # Errors
    /// [`DuneError::Unstable`]; [`DuneError::Volume`].
    pub fn validate(&self, lattice: &Lattice) -> Result<(), DuneError> {
        if lattice.connectivity().is_volume() {
            return Err(DuneError::Volume(lattice.connectivity()));
        }
        let most_m2 = lattice.spacing() * lattice.spacing() / 4.0;
        let diffusivity_m2 = self.diffusivity_m2;
        if (0.0..=most_m2).contains(&diffusivity_m2) {
            Ok(())
        } else {
            Err(DuneError::Unstable { diffusivity_m2, most_m2 })
        }
    }
}

/// Smooths `sand` (thickness, metres) on `bed` (metres), one value a node.
///
/// # Errors
/// See [`SmoothingSettings::validate`]; [`DuneError::Length`].
pub fn smooth(
    lattice: &Lattice,
    settings: &SmoothingSettings,
    bed: &[f64],
    sand: &mut [f64],
) -> Result<(), DuneError> {
    settings.validate(lattice)?;
    check_length("bed", bed.len(), lattice.node_count())?;
    check_length("sand", sand.len(), lattice.node_count())?;
    let rate = settings.diffusivity_m2 / (lattice.spacing() * lattice.spacing());
    let mut surface = vec![0.0; sand.len()];
    let mut given = vec![0.0; sand.len()];
    for _ in 0..settings.steps {
        let ground = bed.par_iter().zip(&*sand);
        surface
            .par_iter_mut()
            .zip(ground)
            .with_min_len(1 << 14)
            .for_each(|(height, (bed, sand))| *height = bed + sand);
        visit(lattice, &mut given, |given, node, around| {
            let falls = around.map(|other| (surface[node] - surface[other]).max(0.0));
            let asked = rate * falls.iter().sum::<f64>();
            *given = if asked > sand[node] { rate * sand[node] / asked } else { rate };
        });
        visit(lattice, sand, |sand, node, around| {
            let gained = around.map(|other| {
                let rise = surface[other] - surface[node];
                rise * if rise > 0.0 { given[other] } else { given[node] }
            });
            // A node that gives all it has may be left with less than nothing by rounding.
            *sand = (*sand + gained.iter().sum::<f64>()).max(0.0);
        });
    }
    Ok(())
}

/// Changes the values of a field with the node and its neighbours along the axes; beyond an
/// open border a node is its own neighbour, so nothing flows.
fn visit(
    lattice: &Lattice,
    values: &mut [f64],
    change: impl Fn(&mut f64, usize, [usize; 4]) + Sync,
) {
    let plane = Plane::new(lattice);
    let width = plane.width;
    values.par_chunks_mut(width).enumerate().for_each(|(row, values)| {
        let [north, south] = [-1, 1].map(|step| plane.row(row, step).unwrap_or(row) * width);
        let here = row * width;
        let mut change_at = |column: usize, [west, east]: [usize; 2]| {
            let around = [here + west, here + east, north + column, south + column];
            change(&mut values[column], here + column, around);
        };
        // Inner nodes need not ask what lies beyond the border.
        for column in 1..width.max(2) - 1 {
            change_at(column, [column - 1, column + 1]);
        }
        let ends = if width == 1 { &[0][..] } else { &[0, width - 1] };
        for &column in ends {
            change_at(column, [-1, 1].map(|step| plane.column(column, step).unwrap_or(column)));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    fn torus(size: [usize; 2]) -> Lattice {
        Lattice::plane(size, 10.0, Connectivity::Four, [Boundary::Periodic; 2]).unwrap()
    }

    /// A cosine of wave number q decays by 1 - 2r (1 - cos q) a step.
    #[test]
    fn a_wave_decays_at_the_exact_rate() {
        let lattice = torus([64, 4]);
        let wave = |node: usize| (std::f64::consts::TAU * 3.0 * (node % 64) as f64 / 64.0).cos();
        let mut sand: Vec<f64> = (0..256).map(|node| 5.0 + wave(node)).collect();
        let settings = SmoothingSettings::default();
        smooth(&lattice, &settings, &vec![1.0; 256], &mut sand).unwrap();
        let decay = 1.0 - 0.1 * (1.0 - (std::f64::consts::TAU * 3.0 / 64.0).cos());
        for (node, sand) in sand.iter().enumerate() {
            let expected = 5.0 + wave(node) * decay.powi(10);
            assert!((sand - expected).abs() < 1e-12, "node {node}: {sand}, expected {expected}");
        }
    }

    #[test]
    fn sand_is_conserved_and_never_negative_on_a_rough_bed() {
        let lattice = torus([32, 32]);
        let bed: Vec<f64> = (0..1024).map(|node| ((node * 7919) % 101) as f64).collect();
        let mut sand: Vec<f64> =
            (0..1024).map(|node| ((node * 104_729) % 7) as f64 / 3.0).collect();
        let before: f64 = sand.iter().sum();
        let settings = SmoothingSettings { diffusivity_m2: 25.0, steps: 50 };
        smooth(&lattice, &settings, &bed, &mut sand).unwrap();
        let after: f64 = sand.iter().sum();
        assert!((after / before - 1.0).abs() < 1e-12, "{before} m became {after} m");
        assert!(sand.iter().all(|&sand| sand >= 0.0));
    }

    #[test]
    fn an_unstable_step_is_refused() {
        let settings = SmoothingSettings { diffusivity_m2: 25.1, steps: 1 };
        let error = settings.validate(&torus([8, 8])).unwrap_err();
        assert!(matches!(error, DuneError::Unstable { most_m2: 25.0, .. }), "{error}");
    }
}
