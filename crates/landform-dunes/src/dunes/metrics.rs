//! Simple measures of a dune field: steepness, cover and volume.
//!
//! Measures take the surface or the thickness of sand in metres, one value a node in node
//! order. Sums run in node order, so a measure has the same bits on any number of threads.

use landform_graph::Lattice;

use super::error::{DuneError, check, check_length};

/// Slope of the steepest edge at each node, up or down, as a tangent.
///
/// # Errors
/// [`DuneError::Length`].
pub fn steepest_slopes(lattice: &Lattice, surface: &[f64]) -> Result<Vec<f64>, DuneError> {
    check_length("surface", surface.len(), lattice.node_count())?;
    let steepest = |node: usize| {
        let slope =
            |edge: landform_graph::Edge| (surface[node] - surface[edge.node]).abs() / edge.distance;
        lattice.neighbours(node).map(slope).fold(0.0, f64::max)
    };
    Ok((0..surface.len()).map(steepest).collect())
}

/// Share of nodes near repose, % of all nodes: how steep a dune field is (thesis, table 4.1).
///
/// A node is near repose when the tangent of its steepest edge is within `tolerance` (0.1 in
/// the thesis) of the tangent of `repose_deg`, above or below. The thesis says neither
/// tangent nor degrees; at 33 degrees the tangents are those of 30.3 to 35.5 degrees, and
/// 10 % of the degrees would be 29.7 to 36.3. After avalanches nothing is above.
///
/// # Errors
/// [`DuneError::Range`] for an angle outside (0, 90) or a tolerance outside [0, 1];
/// [`DuneError::Length`].
pub fn near_repose_percent(
    lattice: &Lattice,
    surface: &[f64],
    repose_deg: f64,
    tolerance: f64,
) -> Result<f64, DuneError> {
    let angle_fits = repose_deg > 0.0 && repose_deg < 90.0;
    check(angle_fits, "repose_deg", repose_deg, "between 0 and 90, exclusive")?;
    check((0.0..=1.0).contains(&tolerance), "tolerance", tolerance, "between 0 and 1")?;
    let repose = repose_deg.to_radians().tan();
    let slopes = steepest_slopes(lattice, surface)?;
    // A slope of exactly repose must count at a tolerance of zero.
    let margin = (tolerance + 1e-9) * repose;
    let near = slopes.iter().filter(|&slope| (slope - repose).abs() <= margin).count();
    Ok(100.0 * near as f64 / slopes.len() as f64)
}

/// Share of nodes with less than `thickness_m` metres of sand, % of all nodes; `None` for an
/// empty field. Transport calls ground bare where less than a slab lies.
pub fn bare_percent(sand: &[f64], thickness_m: f64) -> Option<f64> {
    let bare = sand.iter().filter(|&&sand| sand < thickness_m).count();
    (!sand.is_empty()).then(|| 100.0 * bare as f64 / sand.len() as f64)
}

/// Volume of sand in cubic metres. Summed with the rounding errors carried along (Neumaier),
/// so that a budget can be closed to 1e-15 of it on any lattice.
pub fn sand_volume_m3(lattice: &Lattice, sand: &[f64]) -> f64 {
    let (mut sum, mut lost) = (0.0_f64, 0.0_f64);
    for &thickness in sand {
        let next = sum + thickness;
        let (large, small) =
            if sum.abs() >= thickness.abs() { (sum, thickness) } else { (thickness, sum) };
        lost += (large - next) + small;
        sum = next;
    }
    (sum + lost) * lattice.spacing() * lattice.spacing()
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    fn plane(connectivity: Connectivity) -> Lattice {
        Lattice::plane([16, 8], 10.0, connectivity, [Boundary::Open; 2]).unwrap()
    }

    /// A plane that rises by `steps` metres a column and a row.
    fn ramp(lattice: &Lattice, steps: [f64; 2]) -> Vec<f64> {
        let height = |node| {
            let [x, y, _] = lattice.coordinates(node);
            x as f64 * steps[0] + y as f64 * steps[1]
        };
        (0..lattice.node_count()).map(height).collect()
    }

    #[test]
    fn a_ramp_is_as_steep_as_it_was_built() {
        let lattice = plane(Connectivity::Four);
        let slopes = steepest_slopes(&lattice, &ramp(&lattice, [3.0, 4.0])).unwrap();
        assert!(slopes.iter().all(|slope| (slope - 0.4).abs() < 1e-12));
        let lattice = plane(Connectivity::Eight);
        let slopes = steepest_slopes(&lattice, &ramp(&lattice, [3.0, 4.0])).unwrap();
        let diagonal = 0.7 / 2.0_f64.sqrt();
        assert!((slopes[lattice.node([5, 4, 0])] - diagonal).abs() < 1e-12);
    }

    #[test]
    fn near_repose_is_within_a_tenth_of_its_tangent() {
        let lattice = plane(Connectivity::FourEight);
        let repose = 33.0_f64.to_radians().tan();
        let share = |factor: f64| {
            let surface = ramp(&lattice, [10.0 * repose * factor, 0.0]);
            near_repose_percent(&lattice, &surface, 33.0, 0.1).unwrap()
        };
        assert_eq!(
            [0.0, 0.89, 0.91, 1.0, 1.09, 1.11].map(share),
            [0.0, 0.0, 100.0, 100.0, 100.0, 0.0]
        );
        assert!(near_repose_percent(&lattice, &[0.0; 3], 33.0, 0.1).is_err());
        assert!(near_repose_percent(&lattice, &ramp(&lattice, [0.0; 2]), 90.0, 0.1).is_err());
        assert!(near_repose_percent(&lattice, &ramp(&lattice, [0.0; 2]), 33.0, f64::NAN).is_err());
    }

    #[test]
    fn bare_ground_and_volume() {
        assert_eq!(bare_percent(&[0.0, 4.9, 5.0, 7.0], 5.0), Some(50.0));
        assert_eq!(bare_percent(&[], 5.0), None);
        let lattice = plane(Connectivity::Four);
        let mut sand = vec![1e16; 128];
        sand[1..].fill(1.0);
        assert_eq!(sand_volume_m3(&lattice, &sand), (1e16 + 127.0) * 100.0);
        assert_eq!(sand_volume_m3(&lattice, &[0.1; 10]), 100.0);
    }
}
