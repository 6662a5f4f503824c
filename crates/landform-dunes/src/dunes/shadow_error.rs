//! How well emergent protection stands in for geometric shadow (thesis, table 4.1b).
//!
//! The thesis counts the nodes where the two disagree, then leaves out the nodes "in the peaks
//! and troughs of the dunes", where the error is systematic. It says neither how steep the
//! ray of the geometric test is, how three wind directions make one answer, nor what a peak
//! is. Here, see the book's page "Calibration of the dunes":
//!
//! - A node is in geometric shadow when the wind reaches it from none of the directions; the
//!   wind along one does not when a node upwind, within the reach, is above the ray.
//! - The **flanks** of a dune are what lies between its crest and its trough, less the highest
//!   and the lowest share of the height between them: those are the peaks and troughs.

use landform_graph::Lattice;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::{DuneError, check, check_length};
use super::plane::Plane;
use super::profiles::{Profiles, turning_points};
use super::{Axis, Rose, WindLine};

/// The geometric test of visibility.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct VisibilitySettings {
    /// Rise of the ray against the wind, degrees in [0, 90). Default 0: "a higher sandpile
    /// along the ray in the upwind direction" (thesis, section 4.1.2).
    pub rise_deg: f64,
    /// How far upwind to look, metres. Default 140 (thesis, table 4.2).
    pub reach_m: f64,
}

impl Default for VisibilitySettings {
    fn default() -> Self {
        Self { rise_deg: 0.0, reach_m: 140.0 }
    }
}

/// Nodes that the wind reaches from no direction of `rose`, by looking along every ray.
///
/// `surface` in metres, one value a node. A ray visits one node a step, the nearest to it, and
/// ends at open borders and where it would meet its own start again. Cost: nodes x directions
/// x steps within reach.
///
/// # Errors
/// [`DuneError::Range`], [`DuneError::Length`], [`DuneError::Volume`]; see [`Rose::validate`].
pub fn geometric_shadow(
    lattice: &Lattice,
    surface: &[f64],
    rose: &Rose,
    settings: &VisibilitySettings,
) -> Result<Vec<bool>, DuneError> {
    if lattice.connectivity().is_volume() {
        return Err(DuneError::Volume(lattice.connectivity()));
    }
    check_length("surface", surface.len(), lattice.node_count())?;
    let VisibilitySettings { rise_deg, reach_m } = *settings;
    check((0.0..90.0).contains(&rise_deg), "rise_deg", rise_deg, "at least 0 and below 90")?;
    check(reach_m > 0.0, "reach_m", reach_m, "above 0")?;
    let plane = Plane::new(lattice);
    let rays: Vec<Vec<RayStep>> = rose
        .directions()?
        .angles()
        .map(|angle| ray(lattice, &WindLine::new(angle, 0.5), settings))
        .collect();
    let mut shadow = vec![false; surface.len()];
    shadow.par_chunks_mut(plane.width).enumerate().for_each(|(row, shadow)| {
        for (column, shadow) in shadow.iter_mut().enumerate() {
            let height = surface[row * plane.width + column];
            *shadow = rays.iter().all(|ray| is_hidden(&plane, surface, [column, row], height, ray));
        }
    });
    Ok(shadow)
}

/// One step of a ray against the wind: columns and rows from its start, and the height of the
/// ray above its start, metres.
#[derive(Clone, Copy, Debug)]
struct RayStep {
    columns: isize,
    rows: isize,
    rise: f64,
}

/// The steps of the ray against a wind.
fn ray(lattice: &Lattice, wind: &WindLine, settings: &VisibilitySettings) -> Vec<RayStep> {
    let length = wind.step_length() * lattice.spacing();
    let rise = settings.rise_deg.to_radians().tan() * length;
    let size = if wind.axis() == Axis::Columns { lattice.width() } else { lattice.height() };
    // The radius includes a node that lies exactly on it.
    let steps = ((settings.reach_m / length + 1e-9) as usize).min(size - 1) as isize;
    let step = |step: isize| {
        let along = if wind.is_forward() { -step } else { step };
        let across = -wind.shift(step);
        let (columns, rows) = match wind.axis() {
            Axis::Columns => (along, across),
            Axis::Rows => (across, along),
        };
        RayStep { columns, rows, rise: rise * step as f64 }
    };
    (1..=steps).map(step).collect()
}

/// Whether something along a ray is above it.
fn is_hidden(
    plane: &Plane,
    surface: &[f64],
    from: [usize; 2],
    height: f64,
    ray: &[RayStep],
) -> bool {
    for step in ray {
        let column = plane.column(from[0], step.columns);
        let (Some(column), Some(row)) = (column, plane.row(from[1], step.rows)) else {
            return false;
        };
        if surface[row * plane.width + column] > height + step.rise {
            return true;
        }
    }
    false
}

/// What counts as the flank of a dune.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FlankSettings {
    /// Smallest height from trough to crest that makes a dune, metres, above 0. Default 5,
    /// the thesis' slab.
    pub swing_m: f64,
    /// Share of the height between trough and crest that is left out at either end, in
    /// [0, 0.5]. Default 0.2.
    pub share: f64,
}

impl Default for FlankSettings {
    fn default() -> Self {
        Self { swing_m: 5.0, share: 0.2 }
    }
}

/// Nodes on the flanks of dunes, seen along profiles in a wind to `towards_deg`: not on their
/// peaks, not in their troughs, and not where there is no dune.
///
/// # Errors
/// [`DuneError::Range`], [`DuneError::Length`].
pub fn flanks(
    lattice: &Lattice,
    surface: &[f64],
    towards_deg: f64,
    settings: &FlankSettings,
) -> Result<Vec<bool>, DuneError> {
    check_length("surface", surface.len(), lattice.node_count())?;
    let FlankSettings { swing_m, share } = *settings;
    check(swing_m > 0.0, "swing_m", swing_m, "above 0")?;
    check((0.0..=0.5).contains(&share), "share", share, "between 0 and 0.5")?;
    let profiles = Profiles::new(lattice, towards_deg);
    let mut flanks = vec![false; surface.len()];
    for profile in 0..profiles.count {
        let heights = profiles.heights(surface, profile);
        let turns = turning_points(&heights, swing_m, profiles.is_cyclic);
        for ends in turns.windows(2) {
            let height = |place: usize| heights[place % profiles.length];
            let (low, high) = {
                let [a, b] = [height(ends[0]), height(ends[1])];
                (a.min(b), a.max(b))
            };
            for place in ends[0]..=ends[1] {
                let above = height(place) - low;
                let inside = (share * (high - low)..=(1.0 - share) * (high - low)).contains(&above);
                if inside && high - low >= swing_m {
                    flanks[profiles.node(profile, place % profiles.length)] = true;
                }
            }
        }
    }
    Ok(flanks)
}

/// Disagreement of two tests of shelter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShadowError {
    /// Nodes where they disagree, % of all nodes.
    pub all_percent: f64,
    /// Nodes of the flanks where they disagree, % of the flanks; `None` without flanks.
    pub flanks_percent: Option<f64>,
    /// Nodes left out, % of all nodes.
    pub left_out_percent: f64,
    /// How much lower the second error is than the first, %; `None` if there is none.
    pub reduction_percent: Option<f64>,
}

/// Compares emergent with geometric shelter, on all nodes and on the flanks alone.
///
/// # Errors
/// [`DuneError::Length`] when the three have not the same length.
pub fn shadow_error(
    emergent: &[bool],
    geometric: &[bool],
    flanks: &[bool],
) -> Result<ShadowError, DuneError> {
    check_length("geometric", geometric.len(), emergent.len())?;
    check_length("flanks", flanks.len(), emergent.len())?;
    let (mut wrong, mut kept, mut kept_wrong) = (0_usize, 0_usize, 0_usize);
    for ((emergent, geometric), &flank) in emergent.iter().zip(geometric).zip(flanks) {
        let differs = emergent != geometric;
        wrong += usize::from(differs);
        kept += usize::from(flank);
        kept_wrong += usize::from(differs && flank);
    }
    let percent = |part: usize, whole: usize| 100.0 * part as f64 / whole.max(1) as f64;
    let all_percent = percent(wrong, emergent.len());
    let flanks_percent = (kept > 0).then(|| percent(kept_wrong, kept));
    let reduction = |kept: f64| 100.0 * (1.0 - kept / all_percent);
    Ok(ShadowError {
        all_percent,
        flanks_percent,
        left_out_percent: percent(emergent.len() - kept, emergent.len()),
        reduction_percent: flanks_percent.filter(|_| wrong > 0).map(reduction),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dunes::{ShadowSettings, Wind, cast_shadow};
    use landform_graph::{Boundary, Connectivity};
    use landform_sim::random::{RandomStream, unit};

    fn lattice(size: [usize; 2], boundary: Boundary) -> Lattice {
        Lattice::plane(size, 10.0, Connectivity::FourEight, [boundary; 2]).unwrap()
    }

    fn steady(towards_deg: f64) -> Rose {
        Rose { winds: vec![Wind::steady(towards_deg)] }
    }

    #[test]
    fn a_wall_hides_what_its_shadow_reaches() {
        let lattice = lattice([20, 4], Boundary::Open);
        let mut surface = vec![0.0; 80];
        (0..4).for_each(|row| surface[20 * row + 5] = 20.0);
        let hidden = |towards, rise_deg, reach_m| {
            let settings = VisibilitySettings { rise_deg, reach_m };
            let shadow = geometric_shadow(&lattice, &surface, &steady(towards), &settings).unwrap();
            (0..20).filter(|&column| shadow[40 + column]).collect::<Vec<_>>()
        };
        // 20 m high: at 15 degrees the shadow ends after 74.6 m.
        assert_eq!(hidden(0.0, 15.0, 140.0), [6, 7, 8, 9, 10, 11, 12]);
        assert_eq!(hidden(180.0, 15.0, 140.0), [0, 1, 2, 3, 4]);
        assert_eq!(hidden(0.0, 0.0, 50.0), [6, 7, 8, 9, 10]);
        assert_eq!(hidden(0.0, 80.0, 140.0), [0; 0]);
    }

    #[test]
    fn along_the_axes_it_is_the_shadow_that_dunes_form_by() {
        let lattice = lattice([64, 48], Boundary::Periodic);
        let stream = RandomStream::new(4, "surface");
        let height = |node| 60.0 * unit(stream.block(0, node, 0)[0]);
        let surface: Vec<f64> = (0..lattice.node_count()).map(height).collect();
        for towards in [0.0, 90.0, 180.0, 270.0] {
            let visibility = VisibilitySettings { rise_deg: 15.0, reach_m: 140.0 };
            let looked = geometric_shadow(&lattice, &surface, &steady(towards), &visibility);
            let mut cast = vec![false; surface.len()];
            let wind = WindLine::new(f64::to_radians(towards), 0.5);
            cast_shadow(&lattice, &surface, &wind, &ShadowSettings::default(), &mut cast);
            assert_eq!(looked.unwrap(), cast);
        }
    }

    #[test]
    fn wind_from_any_direction_counts_as_reached() {
        let lattice = lattice([32, 32], Boundary::Periodic);
        let mut surface = vec![0.0; 1024];
        surface[32 * 16 + 10] = 50.0;
        let settings = VisibilitySettings::default();
        let shadow = geometric_shadow(&lattice, &surface, &Rose::default(), &settings).unwrap();
        // Three winds, fanning out: only the first node is hidden from all of them.
        let hidden: Vec<usize> = (0..1024).filter(|&node| shadow[node]).collect();
        assert_eq!(hidden, [32 * 16 + 11]);
    }

    #[test]
    fn flanks_of_a_triangular_dune() {
        let lattice = lattice([40, 4], Boundary::Periodic);
        let height = |column: usize| if column < 30 { column } else { 3 * (40 - column) };
        let surface: Vec<f64> = (0..160).map(|node| height(node % 40) as f64).collect();
        let settings = FlankSettings { swing_m: 5.0, share: 0.2 };
        let flanks = flanks(&lattice, &surface, 0.0, &settings).unwrap();
        let inside: Vec<usize> = (0..40).filter(|&column| flanks[column]).collect();
        let wanted: Vec<usize> = (6..=24).chain(32..=38).collect();
        assert_eq!(inside, wanted);
    }

    #[test]
    fn level_ground_has_no_flanks() {
        let lattice = lattice([40, 4], Boundary::Open);
        let surface: Vec<f64> = (0..160).map(|node| (node % 3) as f64).collect();
        let found = flanks(&lattice, &surface, 0.0, &FlankSettings::default()).unwrap();
        assert!(!found.contains(&true));
        let error = shadow_error(&found, &found, &found).unwrap();
        assert_eq!(error.flanks_percent, None);
        assert_eq!((error.all_percent, error.reduction_percent), (0.0, None));
    }

    #[test]
    fn errors_are_counted_with_and_without_peaks_and_troughs() {
        let emergent = [true, true, false, false, true, false, true, false];
        let geometric = [true, false, true, false, false, false, true, false];
        let flanks = [true, true, false, true, false, true, false, false];
        let error = shadow_error(&emergent, &geometric, &flanks).unwrap();
        assert_eq!(error.all_percent, 37.5);
        assert_eq!(error.flanks_percent, Some(25.0));
        assert_eq!(error.left_out_percent, 50.0);
        assert!((error.reduction_percent.unwrap() - 100.0 / 3.0).abs() < 1e-12);
        assert!(shadow_error(&emergent, &geometric[1..], &flanks).is_err());
    }

    #[test]
    fn settings_out_of_range_are_refused() {
        let lattice = lattice([8, 8], Boundary::Periodic);
        let surface = [0.0; 64];
        let look = |rise_deg, reach_m| {
            let settings = VisibilitySettings { rise_deg, reach_m };
            geometric_shadow(&lattice, &surface, &Rose::default(), &settings)
        };
        assert!(look(90.0, 100.0).is_err() && look(f64::NAN, 100.0).is_err());
        assert!(look(0.0, 0.0).is_err() && look(0.0, 1e30).is_ok());
        for (swing_m, share) in [(0.0, 0.2), (f64::NAN, 0.2), (1.0, 0.6), (1.0, -0.1)] {
            assert!(flanks(&lattice, &surface, 0.0, &FlankSettings { swing_m, share }).is_err());
        }
    }
}
