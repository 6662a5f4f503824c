//! The surface of least bending energy between level sets.

use landform_graph::Lattice;

use super::bounded::Bounded;
use super::plate::Plate;
use super::{Course, LevelSets, LevelSetsError};

/// When the search for the least energy ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelaxationLimits {
    /// Share of the first projected gradient that is small enough.
    pub tolerance: f64,
    /// Most rounds of the solver.
    pub rounds: usize,
}

impl Default for RelaxationLimits {
    /// A millionth of the first gradient, 200 rounds at most.
    fn default() -> Self {
        Self { tolerance: 1e-6, rounds: 200 }
    }
}

/// What relaxation did to a surface.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Relaxation {
    /// Rounds of the solver.
    pub rounds: usize,
    /// Projected gradient of the energy at the end as a share of the first one.
    pub residual: f64,
    /// Bending energy before.
    pub energy_before: f64,
    /// Bending energy after.
    pub energy_after: f64,
}

impl Relaxation {
    /// By how much the energy fell, in per cent: the thesis reports 43.67 for figure 4.16.
    pub fn reduction_percent(&self) -> f64 {
        if self.energy_before > 0.0 {
            100.0 * (1.0 - self.energy_after / self.energy_before)
        } else {
            0.0
        }
    }
}

/// Relaxes `heights` (metres, one value a node) to the surface of least bending energy between
/// the level sets: the bottom row of figure 4.16, after Szeliski and Terzopoulos (1989).
///
/// Nodes on a level set that runs through them stay at its height; all others stay between the
/// level sets round them, so that level sets never cross. The result is unique but for the
/// tolerance, and has the same bits on any number of threads.
///
/// # Errors
/// See [`LevelSetsError`].
pub fn relax_bending(
    lattice: &Lattice,
    levels: &LevelSets<'_>,
    course: Course,
    limits: RelaxationLimits,
    heights: &mut [f64],
) -> Result<Relaxation, LevelSetsError> {
    levels.check(lattice)?;
    check_range(levels, course, heights)?;
    let plate = Plate::new(lattice);
    let energy_before = plate.energy(heights);
    let free: Vec<u32> = (0..heights.len())
        .filter(|&node| !levels.is_held(node, course))
        .map(|n| n as u32)
        .collect();
    let bounds = free.iter().map(|&node| levels.range_m(node as usize, course));
    let (low, high) = bounds.map(|[low, high]| (low, high)).unzip();
    let (matrix, right) = plate.equations(&free, heights);
    let places = plate.places(&free);
    let mut x: Vec<f64> = free.iter().map(|&node| heights[node as usize]).collect();
    let bounded = Bounded { matrix, right, places, low, high };
    let progress = bounded.minimise(&mut x, limits.tolerance, limits.rounds);
    free.iter().zip(x).for_each(|(&node, height)| heights[node as usize] = height);
    let energy_after = plate.energy(heights);
    let (rounds, residual) = (progress.rounds, progress.residual);
    Ok(Relaxation { rounds, residual, energy_before, energy_after })
}

/// Refuses heights that are not between the level sets round them.
fn check_range(
    levels: &LevelSets<'_>,
    course: Course,
    heights: &[f64],
) -> Result<(), LevelSetsError> {
    levels.check_heights(heights)?;
    for (node, &height_m) in heights.iter().enumerate() {
        let range = levels.range_m(node, course);
        if !(range[0]..=range[1]).contains(&height_m) {
            return Err(LevelSetsError::Outside { node, height_m, range });
        }
    }
    Ok(())
}

/// Bending energy of a surface, `h_xx^2 + 2 h_xy^2 + h_yy^2` summed over the nodes in units of a
/// spacing: second differences along both axes where both neighbours exist, and the mixed one over
/// every square of four nodes.
///
/// # Errors
/// [`LevelSetsError::Length`].
pub fn bending_energy(lattice: &Lattice, heights: &[f64]) -> Result<f64, LevelSetsError> {
    let (expected, found) = (lattice.node_count(), heights.len());
    if found != expected {
        return Err(LevelSetsError::Length { field: "heights", expected, found });
    }
    Ok(Plate::new(lattice).energy(heights))
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Cone, random_levels};
    use super::super::{crossings, hermite};
    use super::*;

    /// The Hermite surface relaxes to one of less energy that no small change between the level
    /// sets improves; the less nodes are held, the more.
    #[test]
    fn relaxation_finds_the_least_energy() {
        let (lattice, band, on_level) = random_levels([30, 24], 4);
        let levels = LevelSets { band: &band, on_level: &on_level, interval_m: 5.0 };
        let limits = RelaxationLimits { tolerance: 1e-10, rounds: 100 };
        let mut reductions = Vec::new();
        for course in [Course::Through, Course::Outside] {
            let mut heights = hermite(&lattice, &levels).unwrap();
            let relaxed = relax_bending(&lattice, &levels, course, limits, &mut heights).unwrap();
            assert!(relaxed.residual < 1e-10, "{relaxed:?}");
            assert_eq!(crossings(&lattice, &levels, course, &heights), Ok(0));
            assert_eq!(bending_energy(&lattice, &heights), Ok(relaxed.energy_after));
            for node in 0..lattice.node_count() {
                let [low, high] = levels.range_m(node, course);
                for change in [-1e-3, 1e-3] {
                    let mut changed = heights.clone();
                    changed[node] = (heights[node] + change).clamp(low, high);
                    let energy = bending_energy(&lattice, &changed).unwrap();
                    assert!(energy >= relaxed.energy_after - 1e-9, "{node}");
                }
            }
            reductions.push(relaxed.reduction_percent());
        }
        assert!(reductions[0] > 5.0 && reductions[1] > reductions[0] + 5.0, "{reductions:?}");
    }

    #[test]
    fn heights_between_level_sets_only() {
        let cone = Cone::new(21, 5);
        let levels = cone.levels();
        let mut heights = vec![-1.0; 441];
        let limits = RelaxationLimits::default();
        let refused = relax_bending(&cone.lattice, &levels, Course::Through, limits, &mut heights);
        assert!(matches!(refused, Err(LevelSetsError::Outside { node: 0, .. })), "{refused:?}");
        let refused = relax_bending(&cone.lattice, &levels, Course::Through, limits, &mut []);
        assert!(matches!(refused, Err(LevelSetsError::Length { field: "heights", .. })));
        assert!(bending_energy(&cone.lattice, &[]).is_err());
    }
}
