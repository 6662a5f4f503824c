//! Crests as lines: which way they run and how often they end.

use landform_graph::Lattice;
use serde::{Deserialize, Serialize};

use super::error::{DuneError, check, check_length};
use super::profiles::{Profiles, turning_points};

/// Which way crests run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CrestOrientation {
    /// Direction of the crests, degrees counter-clockwise from east in [0, 180).
    pub towards_deg: f64,
    /// How much they agree: 1 for parallel ridges, 0 for slopes in all directions alike.
    pub coherence: f64,
}

/// Direction of the crests by the structure tensor of the surface: the sum over all nodes of
/// the gradient's outer product with itself, whose lesser axis the crests follow.
///
/// Gradients are central differences over two spacings, one-sided at open borders. `None`
/// for a level surface.
///
/// # Errors
/// [`DuneError::Length`].
pub fn crest_orientation(
    lattice: &Lattice,
    surface: &[f64],
) -> Result<Option<CrestOrientation>, DuneError> {
    check_length("surface", surface.len(), lattice.node_count())?;
    let slope = |node: usize, step: [isize; 3]| {
        let origin = lattice.coordinates(node);
        let ahead = lattice.offset(origin, step);
        let behind = lattice.offset(origin, step.map(|step| -step));
        let spacings = f64::from(u8::from(ahead.is_some()) + u8::from(behind.is_some()));
        let rise = surface[ahead.unwrap_or(node)] - surface[behind.unwrap_or(node)];
        if spacings > 0.0 { rise / spacings } else { 0.0 }
    };
    let (mut east, mut north, mut both) = (0.0, 0.0, 0.0);
    for node in 0..surface.len() {
        let [x, y] = [slope(node, [1, 0, 0]), slope(node, [0, -1, 0])];
        east += x * x;
        north += y * y;
        both += x * y;
    }
    let total = east + north;
    if total <= 0.0 || !total.is_finite() {
        return Ok(None);
    }
    // The steeper axis lies at half the angle of (east - north, 2 both); crests run across it.
    let steepest = 0.5 * (2.0 * both).atan2(east - north);
    let towards_deg = (steepest.to_degrees() + 90.0).rem_euclid(180.0);
    let coherence = (east - north).hypot(2.0 * both) / total;
    Ok(Some(CrestOrientation { towards_deg, coherence }))
}

/// Ends of crests for each metre of crest: the density of defects, which falls while dunes
/// grow and order themselves (Werner and Kocurek 1999). `None` without crests.
///
/// A crest passes through the turning points, `swing_m` above the troughs on both sides, of
/// neighbouring profiles along the wind that are no more than two nodes apart along it. A crest
/// that meets no other in the profile on one side ends there; one that begins and ends in the
/// same profile has two ends. At open sides of the lattice crests go on unseen and do not end.
///
/// # Errors
/// [`DuneError::Range`] for a swing that is not above 0; [`DuneError::Length`].
pub fn crest_ends_per_m(
    lattice: &Lattice,
    surface: &[f64],
    towards_deg: f64,
    swing_m: f64,
) -> Result<Option<f64>, DuneError> {
    check_length("surface", surface.len(), lattice.node_count())?;
    check(swing_m > 0.0, "swing_m", swing_m, "above 0")?;
    let profiles = Profiles::new(lattice, towards_deg);
    let crests: Vec<Vec<usize>> = (0..profiles.count)
        .map(|profile| crests_of(&profiles, surface, profile, swing_m))
        .collect();
    let nodes: usize = crests.iter().map(Vec::len).sum();
    let mut ends = 0_usize;
    for (profile, places) in crests.iter().enumerate() {
        for side in [-1, 1] {
            let beside = profile as isize + side;
            let beside = match usize::try_from(beside)
                .ok()
                .filter(|&beside| beside < profiles.count)
            {
                Some(beside) => beside,
                None if profiles.sides_meet => beside.rem_euclid(profiles.count as isize) as usize,
                None => continue,
            };
            let goes_on = |place: &usize| {
                crests[beside].iter().any(|other| apart(&profiles, *place, *other) <= 2)
            };
            ends += places.iter().filter(|place| !goes_on(place)).count();
        }
    }
    Ok((nodes > 0).then(|| ends as f64 / (nodes as f64 * profiles.spacing)))
}

/// Places of the crests of one profile.
fn crests_of(profiles: &Profiles, surface: &[f64], profile: usize, swing_m: f64) -> Vec<usize> {
    let heights = profiles.heights(surface, profile);
    let turns = turning_points(&heights, swing_m, profiles.is_cyclic);
    let height = |place: usize| heights[place % profiles.length];
    let is_crest = |three: &&[usize]| {
        height(three[1]) > height(three[0]) && height(three[1]) > height(three[2])
    };
    turns.windows(3).filter(is_crest).map(|three| three[1] % profiles.length).collect()
}

/// Nodes between two places of a profile, the short way round.
fn apart(profiles: &Profiles, first: usize, second: usize) -> usize {
    let direct = first.abs_diff(second);
    if profiles.is_cyclic { direct.min(profiles.length - direct) } else { direct }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};
    use std::f64::consts::TAU;

    fn lattice(boundary: Boundary) -> Lattice {
        Lattice::plane([120, 60], 10.0, Connectivity::FourEight, [boundary; 2]).unwrap()
    }

    fn field(lattice: &Lattice, height: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let at = |node| {
            let position = lattice.position(node);
            height(position.x, position.y)
        };
        (0..lattice.node_count()).map(at).collect()
    }

    #[test]
    fn crests_of_plane_waves_run_across_them() {
        let lattice = lattice(Boundary::Open);
        for across_deg in [0.0, 30.0, 77.0, 135.0] {
            let (sine, cosine) = f64::to_radians(across_deg).sin_cos();
            let wave = |x: f64, y: f64| 10.0 * (TAU * (x * cosine + y * sine) / 150.0).sin();
            let found = crest_orientation(&lattice, &field(&lattice, wave)).unwrap().unwrap();
            let wanted = (across_deg + 90.0_f64).rem_euclid(180.0);
            let off = (found.towards_deg - wanted + 90.0).rem_euclid(180.0) - 90.0;
            assert!(off.abs() < 1.5, "{} for {wanted}", found.towards_deg);
            assert!(found.coherence > 0.99);
        }
    }

    #[test]
    fn a_round_hill_and_a_level_field_have_no_orientation() {
        let lattice = lattice(Boundary::Periodic);
        let egg_box = |x: f64, y: f64| (TAU * x / 150.0).sin() + (TAU * y / 150.0).sin();
        let found = crest_orientation(&lattice, &field(&lattice, egg_box)).unwrap().unwrap();
        assert!(found.coherence < 1e-9);
        assert_eq!(crest_orientation(&lattice, &vec![7.0; 7200]).unwrap(), None);
    }

    #[test]
    fn unbroken_ridges_have_no_ends_and_a_gap_has_two() {
        let lattice = lattice(Boundary::Periodic);
        let ridges = |x: f64| 10.0 * (TAU * x / 300.0).sin();
        let ends = |surface: &[f64]| crest_ends_per_m(&lattice, surface, 0.0, 5.0).unwrap();
        assert_eq!(ends(&field(&lattice, |x, _| ridges(x))), Some(0.0));
        // One of four ridges, from trough to trough, misses 10 of its 60 rows.
        let gap = |x: f64, y: f64| {
            if (225.0..525.0).contains(&x) && (200.0..300.0).contains(&y) {
                -10.0
            } else {
                ridges(x)
            }
        };
        assert_eq!(ends(&field(&lattice, gap)), Some(2.0 / (2300.0)));
        assert_eq!(ends(&vec![3.0; 7200]), None);
    }

    #[test]
    fn crests_go_on_beyond_open_sides() {
        let lattice = lattice(Boundary::Open);
        let surface = field(&lattice, |x, _| 10.0 * (TAU * x / 300.0).sin());
        assert_eq!(crest_ends_per_m(&lattice, &surface, 0.0, 5.0).unwrap(), Some(0.0));
        assert!(crest_ends_per_m(&lattice, &surface, 0.0, 0.0).is_err());
        assert!(crest_ends_per_m(&lattice, &surface[1..], 0.0, 1.0).is_err());
    }
}
