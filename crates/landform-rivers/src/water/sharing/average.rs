//! Rules by averaging (thesis, listing 4.2; Olsen 2004, Realtime procedural terrain generation).

use super::Sharing;

/// What listing 4.2 moves: the node's height above the average of all that take part, itself
/// included, but no more than its water. Also the number of lower neighbours and the sum of the
/// falls to them.
///
/// The average must count the node itself: without it, two nodes would swap their levels for ever.
#[inline(always)]
fn excess(level: i64, depth: i64, around: &[i64]) -> (i64, i64, i64) {
    let (mut lower, mut falls) = (0, 0);
    for &neighbour in around {
        let fall = (level - neighbour).max(0);
        falls += fall;
        lower += i64::from(fall > 0);
    }
    (depth.min(falls / (lower + 1)), lower, falls)
}

/// Averaging, all lower neighbours alike (thesis, listing 4.2).
pub struct UniformAverage;

impl Sharing for UniformAverage {
    /// What each lower neighbour gets.
    type Share = i64;

    const NOTHING: i64 = 0;

    #[inline(always)]
    fn share(level: i64, depth: i64, around: &[i64]) -> (i64, i64) {
        let (excess, lower, _) = excess(level, depth, around);
        let each = excess / lower.max(1);
        (each, each * lower)
    }

    #[inline(always)]
    fn gift(share: i64, giver: i64, receiver: i64) -> i64 {
        if receiver < giver { share } else { 0 }
    }
}

/// Averaging, each lower neighbour in proportion to the fall (thesis, listing 4.2).
pub struct WeightedAverage;

impl Sharing for WeightedAverage {
    /// Share of the fall that each lower neighbour gets.
    type Share = f64;

    const NOTHING: f64 = 0.0;

    #[inline(always)]
    fn share(level: i64, depth: i64, around: &[i64]) -> (f64, i64) {
        let (excess, _, falls) = excess(level, depth, around);
        if excess == 0 {
            return (0.0, 0);
        }
        // A hair less than the quotient, so that rounded gifts never add up to more.
        let share = excess as f64 / falls as f64 * (1.0 - 4.0 * f64::EPSILON);
        (share, around.iter().map(|&neighbour| Self::gift(share, level, neighbour)).sum())
    }

    #[inline(always)]
    fn gift(share: f64, giver: i64, receiver: i64) -> i64 {
        ((giver - receiver).max(0) as f64 * share) as i64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Listing 4.2 with real numbers.
    fn listing(level: f64, depth: f64, around: &[i64], weighted: bool) -> Vec<f64> {
        let fall = |&neighbour: &i64| (level - neighbour as f64).max(0.0);
        let taking_part = around.iter().filter(|&k| fall(k) > 0.0).count() as f64;
        let falls: f64 = around.iter().map(fall).sum();
        let average = level - falls / (taking_part + 1.0);
        let moved = depth.min(level - average);
        let part = |k| match fall(k) {
            0.0 => 0.0,
            fall if weighted => moved * fall / falls,
            _ => moved / taking_part,
        };
        around.iter().map(part).collect()
    }

    fn check<S: Sharing>(around: &[i64], depth: i64, level: i64, weighted: bool) {
        let (share, given) = S::share(level, depth, around);
        let gifts: Vec<i64> = around.iter().map(|&k| S::gift(share, level, k)).collect();
        assert_eq!(gifts.iter().sum::<i64>(), given);
        assert!(given <= depth, "{given} of {depth}");
        let expected = listing(level as f64, depth as f64, around, weighted);
        for (gift, expected) in gifts.iter().zip(expected) {
            // The whole number below, with a unit lost before and after the division.
            assert!((-2.0..1e-3).contains(&(*gift as f64 - expected)), "{gift} {expected}");
        }
    }

    proptest! {
        #[test]
        fn gifts_are_those_of_the_listing(
            around in prop::collection::vec(-4_000_000_i64..6_000_000, 1..=8),
            (depth, bed) in (0_i64..9_000_000, -2_000_000_i64..2_000_000),
        ) {
            check::<UniformAverage>(&around, depth, bed + depth, false);
            check::<WeightedAverage>(&around, depth, bed + depth, true);
        }
    }
}
