//! How thick branches are.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Branching;
use crate::SynthError;
use crate::error::Checks;

/// Largest radius.
const MOST_M: f64 = 1e6;

/// The radius of branches along their course.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum BranchWidth {
    /// The same everywhere.
    Even {
        /// Radius of all branches.
        #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m"))]
        radius_m: f64,
    },
    /// Tapers in proportion to length, from the root of every branch to its tip (Xu 2008, section
    /// 4.3). A branch that leaves another begins with `share` of the radius there.
    Taper {
        /// Radius at the root of a tree.
        #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m"))]
        root_m: f64,
        /// Radius at every tip.
        #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m"))]
        tip_m: f64,
        /// Radius of a branch where it leaves another, as a share of the other's.
        #[schemars(range(min = 0.0, max = 1.0))]
        share: f64,
    },
    /// Branches hold as much as those that they carry: `r^exponent` is the sum over the tips
    /// beyond. 2 keeps the area of the cross-section (the pipe model of Shinozaki et al. 1964),
    /// 3 is Murray's law for vessels.
    Pipes {
        /// Radius at every tip.
        #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m"))]
        tip_m: f64,
        /// Exponent of the radius.
        #[schemars(range(min = 1.0, max = 10.0))]
        exponent: f64,
    },
}

impl Default for BranchWidth {
    fn default() -> Self {
        Self::Even { radius_m: 1.0 }
    }
}

impl BranchWidth {
    pub(crate) fn check(&self, checks: &Checks) -> Result<(), SynthError> {
        let radius = |value: f64| checks.range("width", value, 0.0..=MOST_M);
        match *self {
            Self::Even { radius_m } => radius(radius_m),
            Self::Taper { root_m, tip_m, share } => {
                radius(root_m)?;
                radius(tip_m)?;
                checks.range("width", share, 0.0..=1.0)
            }
            Self::Pipes { tip_m, exponent } => {
                radius(tip_m)?;
                checks.range("width", exponent, 1.0..=10.0)
            }
        }
    }

    /// Sets the radii of all nodes.
    pub fn apply(&self, branching: &mut Branching) {
        match *self {
            Self::Even { radius_m } => branching.radii.fill(radius_m),
            Self::Taper { root_m, tip_m, share } => taper(branching, root_m, tip_m, share),
            Self::Pipes { tip_m, exponent } => {
                let tips = branching.tips_beyond();
                for (radius, tips) in branching.radii.iter_mut().zip(tips) {
                    *radius = tip_m * f64::from(tips).powf(exponent.recip());
                }
            }
        }
    }
}

fn taper(branching: &mut Branching, root_m: f64, tip_m: f64, share: f64) {
    let lengths = branching.root_lengths();
    let mut known = vec![false; branching.len()];
    // A branch is listed after the one that it leaves, so the radius there is known.
    for branch in branching.branches() {
        let (first, last) = (branch[0] as usize, branch[branch.len() - 1] as usize);
        let leaves = known[first];
        let from = if leaves { branching.radii[first] * share } else { root_m };
        let (start, length) = (lengths[first], lengths[last] - lengths[first]);
        for &node in &branch[usize::from(leaves)..] {
            let along = if length > 0.0 { (lengths[node as usize] - start) / length } else { 1.0 };
            branching.radii[node as usize] = from + along * (tip_m.min(from) - from);
            known[node as usize] = true;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A stem of two pieces with a twig in its middle.
    fn fork() -> Branching {
        let mut fork = Branching::default();
        let root = fork.add([0.0; 3], None, 0.0);
        let middle = fork.add([0.0, 0.0, 4.0], Some(root), 0.0);
        fork.add([0.0, 0.0, 8.0], Some(middle), 0.0);
        fork.add([2.0, 0.0, 4.0], Some(middle), 0.0);
        fork
    }

    #[test]
    fn branches_taper_from_root_to_tip() {
        let mut fork = fork();
        BranchWidth::Taper { root_m: 5.0, tip_m: 1.0, share: 0.5 }.apply(&mut fork);
        assert_eq!(fork.radii, [5.0, 3.0, 1.0, 1.0]);
        BranchWidth::Even { radius_m: 2.0 }.apply(&mut fork);
        assert_eq!(fork.radii, [2.0; 4]);
    }

    #[test]
    fn pipes_keep_their_cross_section() {
        let mut fork = fork();
        BranchWidth::Pipes { tip_m: 1.0, exponent: 2.0 }.apply(&mut fork);
        let root_two = 2.0_f64.sqrt();
        assert_eq!(fork.radii, [root_two, root_two, 1.0, 1.0]);
    }

    #[test]
    fn radii_that_mean_nothing_are_refused() {
        let checks = Checks("Test");
        assert!(BranchWidth::Even { radius_m: f64::NAN }.check(&checks).is_err());
        assert!(BranchWidth::Pipes { tip_m: 1.0, exponent: 0.0 }.check(&checks).is_err());
        assert!(BranchWidth::default().check(&checks).is_ok());
    }
}
