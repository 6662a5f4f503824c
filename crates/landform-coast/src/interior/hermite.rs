//! Cubic interpolation from level set to level set.

use landform_graph::Lattice;

use super::distance::{Nearest, Side};
use super::{Course, LevelSets, LevelSetsError};

/// Height of a summit above the highest level set round it, at most, in intervals.
const SUMMIT: f64 = 0.75;

/// Heights in metres by cubic Hermite interpolation between the level sets: the middle row of
/// figure 4.16, after the idea of Hormann, Spinello and Schroeder (2003).
///
/// A node at distance `a` from the level set below and `b` from the one above lies at `a / (a + b)`
/// of a cubic from one to the other. Its slopes at both ends are those of the nearest nodes of
/// the level sets: at each the harmonic mean of the slopes to the level set before and to the one
/// after (one of them, where there is no other), at most twice the mean slope of the cubic, so that
/// it never falls (Fritsch and Carlson 1980).
///
/// Within the highest level set of a hill, the ground rises with the slope at that level set and
/// levels off at the innermost node: by three quarters of an interval at most.
///
/// # Errors
/// See [`LevelSetsError`].
pub fn hermite(lattice: &Lattice, levels: &LevelSets<'_>) -> Result<Vec<f64>, LevelSetsError> {
    levels.check(lattice)?;
    let below = Nearest::new(lattice, levels, Side::Below)?;
    let above = Nearest::new(lattice, levels, Side::Above)?;
    let summits = summit_distances(lattice, levels, &below, &above);
    let slope = |node: u32| {
        let node = node as usize;
        let distances = [below.distance[node], above.distance[node]];
        slope_at_level(levels.interval_m, distances)
    };
    let height = |node: usize| {
        let base = levels.base_m(node);
        let [to_below, to_above] = [below.distance[node], above.distance[node]];
        if levels.on_level[node] > 0 || !to_below.is_finite() {
            return base;
        }
        let foot = slope(below.source[node]);
        let rise = match to_above.is_finite() {
            true => {
                let head = slope(above.source[node]);
                cubic(levels.interval_m, [to_below, to_above], [foot, head])
            }
            false => dome(levels.interval_m, to_below, summits[node], foot),
        };
        // Rounding must not take a node over a level set.
        let [low, high] = levels.range_m(node, Course::Through);
        (base + rise).clamp(low, high)
    };
    Ok((0..lattice.node_count()).map(height).collect())
}

/// Slope at a node of a level set from its distances to the level sets before and after it.
fn slope_at_level(interval: f64, [before, after]: [f64; 2]) -> f64 {
    match (before.is_finite(), after.is_finite()) {
        (true, true) => 2.0 * interval / (before + after),
        (true, false) => interval / before,
        (false, true) => interval / after,
        (false, false) => 0.0,
    }
}

/// Height above the level set below on the cubic of one interval.
fn cubic(interval: f64, [to_below, to_above]: [f64; 2], slopes: [f64; 2]) -> f64 {
    let length = to_below + to_above;
    let t = to_below / length;
    // Slopes per length of the cubic; the mean one is 1 interval.
    let [foot, head] = slopes.map(|slope| (slope * length).min(2.0 * interval));
    let (rise, fall) = (t * t * (3.0 - 2.0 * t), 1.0 - t);
    interval * rise + foot * t * fall * fall - head * t * t * fall
}

/// Height above the highest level set of a hill, `inward` metres from it, where the innermost
/// node of the hill lies `innermost` metres from it.
fn dome(interval: f64, inward: f64, innermost: f64, slope: f64) -> f64 {
    let highest = 0.5 * slope * innermost;
    let slope =
        if highest > SUMMIT * interval { 2.0 * SUMMIT * interval / innermost } else { slope };
    slope * inward * (1.0 - 0.5 * inward / innermost)
}

/// For the nodes of summits, which no level set lies above, the greatest distance of any node of
/// the same summit from the level set below.
fn summit_distances(
    lattice: &Lattice,
    levels: &LevelSets<'_>,
    below: &Nearest,
    above: &Nearest,
) -> Vec<f64> {
    let of_summit = |node: usize| levels.on_level[node] == 0 && above.distance[node].is_infinite();
    let mut innermost = vec![0.0; lattice.node_count()];
    let mut seen = vec![false; lattice.node_count()];
    for start in 0..lattice.node_count() {
        if seen[start] || !of_summit(start) {
            continue;
        }
        seen[start] = true;
        let mut patch = vec![start];
        let mut next = 0;
        while let Some(&node) = patch.get(next) {
            next += 1;
            for edge in lattice.neighbours(node) {
                let same_band = levels.band[edge.node] == levels.band[start];
                if same_band
                    && of_summit(edge.node)
                    && !std::mem::replace(&mut seen[edge.node], true)
                {
                    patch.push(edge.node);
                }
            }
        }
        let distances = patch.iter().map(|&node| below.distance[node]);
        let greatest = distances.filter(|distance| distance.is_finite()).fold(0.0, f64::max);
        patch.iter().for_each(|&node| innermost[node] = greatest);
    }
    innermost
}

#[cfg(test)]
mod tests {
    use super::super::terraces;
    use super::super::testing::{Cone, random_levels};
    use super::*;

    /// A cone comes out as a cone: straight between rings at equal distances.
    #[test]
    fn a_cone_stays_a_cone() {
        let cone = Cone::new(121, 10);
        let levels = cone.levels();
        let heights = hermite(&cone.lattice, &levels).unwrap();
        let middle = 60;
        for (node, height) in heights.iter().enumerate() {
            let [x, y, _] = cone.lattice.coordinates(node);
            let radius = (x as f64 - middle as f64).hypot(y as f64 - middle as f64);
            // Level sets run within a spacing and a half of the radius that they stand for.
            if (11.0..50.0).contains(&radius) {
                let exact = 59.5 - radius;
                assert!((height - exact).abs() < 1.3, "{height} for {exact}");
            }
        }
    }

    #[test]
    fn level_sets_never_cross() {
        for seed in 0..5 {
            let (lattice, band, on_level) = random_levels([50, 40], seed);
            let levels = LevelSets { band: &band, on_level: &on_level, interval_m: 3.0 };
            let heights = hermite(&lattice, &levels).unwrap();
            let steps = terraces(&lattice, &levels).unwrap();
            for node in 0..lattice.node_count() {
                let [low, high] = levels.range_m(node, Course::Through);
                assert!(
                    (low..=high).contains(&heights[node]),
                    "{} of {low}..{high}",
                    heights[node]
                );
                assert_eq!(steps[node], low);
            }
        }
    }

    #[test]
    fn a_cubic_meets_its_ends_with_its_slopes() {
        let height = |at: f64| cubic(2.0, [at, 5.0 - at], [0.3, 0.5]);
        assert!(height(0.0).abs() < 1e-12 && (height(5.0) - 2.0).abs() < 1e-12);
        assert!((height(1e-6) / 1e-6 - 0.3).abs() < 1e-5);
        assert!(((height(5.0) - height(5.0 - 1e-6)) / 1e-6 - 0.5).abs() < 1e-5);
        assert!((dome(2.0, 4.0, 4.0, 9.0) - 1.5).abs() < 1e-12);
    }
}
