//! Which nodes lie on the level sets of a terrain, and which between them.

use landform_graph::marching::MarchError;
use landform_graph::{Lattice, LatticeError};
use thiserror::Error;

/// Why level sets cannot be interpolated.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LevelSetsError {
    /// A field does not hold one value a node.
    #[error("the {field} field has {found} values; the lattice has {expected} nodes")]
    Length {
        /// Which field.
        field: &'static str,
        /// Number of nodes.
        expected: usize,
        /// Number of values given.
        found: usize,
    },
    /// The lattice is a volume.
    #[error("level sets lie on a plane; the lattice has {layers} layers")]
    Volume {
        /// Number of layers of the lattice.
        layers: usize,
    },
    /// Height between level sets is not a positive finite number.
    #[error("the interval between level sets is {interval_m} m; give a positive finite number")]
    Interval {
        /// The interval given.
        interval_m: f64,
    },
    /// A height lies outside the level sets around its node.
    #[error(
        "the height of node {node} is {height_m} m; between the level sets round it are \
         {} to {} m", range[0], range[1]
    )]
    Outside {
        /// The first such node.
        node: usize,
        /// Its height.
        height_m: f64,
        /// Heights of the level sets below and above it.
        range: [f64; 2],
    },
    /// The lattice of eight neighbours could not be made.
    #[error(transparent)]
    Lattice(#[from] LatticeError),
    /// The search for the nearest level set failed.
    #[error(transparent)]
    March(#[from] MarchError),
}

/// Level sets of a terrain at equal intervals of height, numbered from the lowest, number 0.
///
/// A front that moves inland leaves them behind: `band` is the number of the last level set that
/// had been marked when the front passed a node, so that the node lies between that one and the
/// next; `on_level` tells the nodes that lie on their level set itself.
#[derive(Clone, Copy, Debug)]
pub struct LevelSets<'a> {
    /// Number of the level set that a node lies on or above, one value a node.
    pub band: &'a [u32],
    /// 1 where a node lies on that level set, 0 elsewhere, one value a node.
    pub on_level: &'a [u8],
    /// Height from one level set to the next in metres.
    pub interval_m: f64,
}

/// Where level sets run, seen from the nodes that lie on them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Course {
    /// Through these nodes, which have the height of the level set (thesis, listing 4.1, line 13).
    #[default]
    Through,
    /// Right outside of them, as a shore does: they lie between this level set and the next, like
    /// the nodes behind them. Level set 0, the sea, keeps its height.
    Outside,
}

impl LevelSets<'_> {
    /// Checks that the fields belong to a 2-D lattice.
    pub(super) fn check(&self, lattice: &Lattice) -> Result<(), LevelSetsError> {
        let layers = lattice.depth();
        if layers > 1 || lattice.connectivity().is_volume() {
            return Err(LevelSetsError::Volume { layers });
        }
        let expected = lattice.node_count();
        for (field, found) in [("band", self.band.len()), ("on_level", self.on_level.len())] {
            if found != expected {
                return Err(LevelSetsError::Length { field, expected, found });
            }
        }
        let interval_m = self.interval_m;
        if !(interval_m > 0.0 && interval_m.is_finite()) {
            return Err(LevelSetsError::Interval { interval_m });
        }
        Ok(())
    }

    /// Checks that there is one height for each node.
    pub(super) fn check_heights(&self, heights: &[f64]) -> Result<(), LevelSetsError> {
        let (expected, found) = (self.band.len(), heights.len());
        if found != expected {
            return Err(LevelSetsError::Length { field: "heights", expected, found });
        }
        Ok(())
    }

    /// Rank of a node on its way up: level set 0, between, level set 1, between and so on.
    pub(super) fn rank(&self, node: usize) -> u64 {
        2 * u64::from(self.band[node]) + u64::from(self.on_level[node] == 0)
    }

    /// Height of the level set that a node lies on or above.
    pub(super) fn base_m(&self, node: usize) -> f64 {
        f64::from(self.band[node]) * self.interval_m
    }

    /// Whether a node has the height of its level set.
    pub(super) fn is_held(&self, node: usize, course: Course) -> bool {
        self.on_level[node] > 0 && (course == Course::Through || self.band[node] == 0)
    }

    /// Least and greatest height of a node: its level set, or the two round it.
    pub(super) fn range_m(&self, node: usize, course: Course) -> [f64; 2] {
        let above = if self.is_held(node, course) { 0.0 } else { 1.0 };
        let band = f64::from(self.band[node]);
        [band * self.interval_m, (band + above) * self.interval_m]
    }
}

/// Every node at the height of the lower of the two level sets nearest to it, in metres: the top
/// row of figure 4.16.
///
/// # Errors
/// See [`LevelSetsError`].
pub fn terraces(lattice: &Lattice, levels: &LevelSets<'_>) -> Result<Vec<f64>, LevelSetsError> {
    levels.check(lattice)?;
    Ok((0..lattice.node_count()).map(|node| levels.base_m(node)).collect())
}

/// At how many nodes a surface (metres, one value a node) leaves the range between the level set
/// below and the one above, so that level sets cross there: 0 for a good interpolant. Below level
/// set 0 is the floor of the sea.
///
/// # Errors
/// See [`LevelSetsError`].
pub fn crossings(
    lattice: &Lattice,
    levels: &LevelSets<'_>,
    course: Course,
    heights: &[f64],
) -> Result<usize, LevelSetsError> {
    levels.check(lattice)?;
    levels.check_heights(heights)?;
    let crosses = |node: &usize| {
        let [low, high] = levels.range_m(*node, course);
        let low = if high > 0.0 { low } else { f64::NEG_INFINITY };
        !(low..=high).contains(&heights[*node])
    };
    Ok((0..heights.len()).filter(crosses).count())
}

#[cfg(test)]
mod tests {
    use super::super::testing::Cone;
    use super::*;

    #[test]
    fn a_surface_crosses_where_it_leaves_its_range() {
        let cone = Cone::new(41, 5);
        let levels = cone.levels();
        let mut heights = terraces(&cone.lattice, &levels).unwrap();
        assert_eq!(crossings(&cone.lattice, &levels, Course::Through, &heights), Ok(0));
        // The floor of the sea, a summit that is too high, a level set off its height.
        let summit = 20 * 41 + 20;
        let on_level = (0..41 * 41).find(|&n| levels.band[n] == 2 && levels.on_level[n] > 0);
        heights[0] = -5.0;
        heights[summit] += 10.1;
        heights[on_level.unwrap()] += 0.1;
        assert_eq!(crossings(&cone.lattice, &levels, Course::Through, &heights), Ok(2));
        assert_eq!(crossings(&cone.lattice, &levels, Course::Outside, &heights), Ok(1));
        heights[1] = f64::NAN;
        assert_eq!(crossings(&cone.lattice, &levels, Course::Through, &heights), Ok(3));
        assert!(crossings(&cone.lattice, &levels, Course::Through, &[]).is_err());
    }
}
