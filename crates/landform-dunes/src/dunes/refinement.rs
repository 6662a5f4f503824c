//! Refinement: after the main run, slabs half as high, then a quarter, and so on.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// High slabs build dunes in few ticks; phases of ever lower slabs then smooth their steps.
///
/// Phase `j` runs `2^j` ticks with slabs of `2^-j` of the height, for `j` from 1 to `phases`
/// (thesis, section 4.1.1), so every phase moves about as much sand as the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Refinement {
    /// Ticks of the main run, with slabs of full height. Default 20 (thesis, table 4.2).
    pub coarse_ticks: u64,
    /// Number of phases, at most 30; the thesis' k. Default 3.
    pub phases: u32,
}

impl Default for Refinement {
    fn default() -> Self {
        Self { coarse_ticks: 20, phases: 3 }
    }
}

/// The most phases: a slab is then a billionth of what it was.
const MOST_PHASES: u32 = 30;

impl Refinement {
    /// Ticks of the main run and all phases: 34 for the thesis' numbers.
    pub fn ticks(&self) -> u64 {
        self.coarse_ticks.saturating_add((2 << self.phases.min(MOST_PHASES)) - 2)
    }

    /// Part of the full height that slabs have in tick `iteration` (the first is 0); after
    /// the last phase it stays.
    pub fn slab_share(&self, iteration: u64) -> f64 {
        let passed = iteration.saturating_sub(self.coarse_ticks);
        if iteration < self.coarse_ticks {
            return 1.0;
        }
        // Phase j starts 2^j - 2 ticks after the main run.
        let phase = passed.saturating_add(2).ilog2().min(self.phases.min(MOST_PHASES));
        0.5_f64.powi(phase as i32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_last_as_long_as_the_thesis_says() {
        let refinement = Refinement::default();
        assert_eq!(refinement.ticks(), 34);
        let shares: Vec<f64> = (0..34).map(|tick| refinement.slab_share(tick)).collect();
        let count = |share: f64| shares.iter().filter(|&&other| other == share).count();
        assert_eq!([1.0, 0.5, 0.25, 0.125].map(count), [20, 2, 4, 8]);
        assert!(shares.is_sorted_by(|before, after| before >= after));
    }

    #[test]
    fn without_phases_slabs_keep_their_height() {
        let refinement = Refinement { coarse_ticks: 5, phases: 0 };
        assert_eq!(refinement.ticks(), 5);
        assert_eq!(refinement.slab_share(1_000), 1.0);
        assert_eq!(Refinement { coarse_ticks: u64::MAX, phases: 99 }.ticks(), u64::MAX);
    }
}
