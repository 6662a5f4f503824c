//! The thesis' own rule (section 4.3.1, figure 4.11): the lowest neighbours first.

use super::Sharing;

/// The specialised rule of the thesis (figure 4.11).
///
/// The lower neighbours are sorted; the lowest is raised to the level of the second, both to that of
/// the third, and so on, until the water is used up; if it is not, the node and all neighbours that
/// are still lower come to a common level. Where water is scarce the lowest neighbour gets all of
/// it, and flow concentrates.
///
/// All neighbours that get water end at one level r: the greatest whole r for which the node has
/// enough water and does not fall below it,
///
/// ```text
/// g(r) = sum of max(r - level_k, 0)    g(r) <= depth,   r <= level - g(r)
/// ```
///
/// So r is all there is to decide, and who would get a fraction of a unit leaves it to the node.
pub struct Levelling;

impl Sharing for Levelling {
    /// The level r.
    type Share = i64;

    const NOTHING: i64 = i64::MIN;

    #[inline(always)]
    fn share(level: i64, depth: i64, around: &[i64]) -> (i64, i64) {
        let mut sorted = [i64::MAX; 9];
        let mut lower = 0;
        for &neighbour in around {
            if neighbour < level {
                let mut place = lower;
                while place > 0 && sorted[place - 1] > neighbour {
                    sorted[place] = sorted[place - 1];
                    place -= 1;
                }
                sorted[place] = neighbour;
                lower += 1;
            }
        }
        if lower == 0 {
            return (Self::NOTHING, 0);
        }
        let lowest = sorted[0];
        let height = level - lowest;
        // Sum of the levels of the first `count` above the lowest, and what it takes to raise them.
        let (mut count, mut sum) = (1, 0);
        while count < lower {
            let next = sorted[count] - lowest;
            let raised = count as i64 * next - sum;
            if raised > depth || next > height - raised {
                break;
            }
            sum += next;
            count += 1;
        }
        let most = divided(depth + sum, count).min(divided(height + sum, count + 1));
        (lowest + most, count as i64 * most - sum)
    }

    #[inline(always)]
    fn gift(share: i64, _: i64, receiver: i64) -> i64 {
        share.max(receiver) - receiver
    }
}

/// `value / parts` for 1 to 9 parts; divisions by constants are several times faster.
#[inline(always)]
fn divided(value: i64, parts: usize) -> i64 {
    let value = value as u64;
    let quotient = match parts {
        1 => value,
        2 => value / 2,
        3 => value / 3,
        4 => value / 4,
        5 => value / 5,
        6 => value / 6,
        7 => value / 7,
        8 => value / 8,
        _ => value / 9,
    };
    quotient as i64
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Figure 4.11 step by step: n lower neighbours, sorted; m of them raised to the next, for m
    /// from 1 to n - 1; then a common level. Returns what each neighbour gets.
    fn in_stages(level: i64, depth: i64, around: &[i64]) -> Vec<i64> {
        let mut order: Vec<usize> = (0..around.len()).filter(|&k| around[k] < level).collect();
        order.sort_by_key(|&k| around[k]);
        let mut levels = around.to_vec();
        let mut left = depth;
        for m in 1..=order.len() {
            let lowest = levels[order[0]];
            let enough = left / m as i64;
            // The common level of node and the m lowest; the node keeps what cannot be divided.
            let common = (level - depth + left + m as i64 * lowest).div_euclid(m as i64 + 1);
            let next = order.get(m).map_or(i64::MAX / 2, |&k| levels[k]);
            let rise = (next - lowest).min(enough).min(common - lowest).max(0);
            for &k in &order[..m] {
                levels[k] += rise;
            }
            left -= rise * m as i64;
            if lowest + rise < next {
                break;
            }
        }
        (0..around.len()).map(|k| levels[k] - around[k]).collect()
    }

    proptest! {
        #[test]
        fn the_level_is_that_of_the_three_stages(
            around in prop::collection::vec(-40_i64..60, 1..=8),
            (depth, bed) in (0_i64..90, -20_i64..20),
        ) {
            let (share, given) = Levelling::share(bed + depth, depth, &around);
            let gifts: Vec<i64> =
                around.iter().map(|&k| Levelling::gift(share, bed + depth, k)).collect();
            prop_assert_eq!(gifts.iter().sum::<i64>(), given);
            prop_assert_eq!(gifts, in_stages(bed + depth, depth, &around));
        }
    }

    #[test]
    fn scarce_water_goes_to_the_lowest_alone() {
        let (share, given) = Levelling::share(100, 5, &[90, 50, 80, 60]);
        assert_eq!((share, given), (55, 5));
        let gifts = [90, 50, 80, 60].map(|level| Levelling::gift(share, 100, level));
        assert_eq!(gifts, [0, 5, 0, 0]);
    }

    #[test]
    fn deep_water_comes_to_a_common_level() {
        let (share, given) = Levelling::share(100, 100, &[40, 70, 100, 130]);
        assert_eq!((share, given), (70, 30));
    }
}
