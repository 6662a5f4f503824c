//! Points drawn from ranges.

use landform_sim::random::RandomStream;

use super::file::Range;

/// Bits of a number that is drawn: those that a float between one and two keeps.
const BITS: u32 = 53;

/// A random number in [0, 1), for a sample of a parameter of a block.
pub(super) fn random(seed: u64, block: usize, sample: usize, parameter: usize) -> f64 {
    let stream = RandomStream::new(seed, "sweep: samples");
    fraction(stream.block(block as u64, sample, parameter as u32))
}

/// Numbers in [0, 1), one for each sample and one in each of as many equal parts, in random order.
pub(super) fn stratified(seed: u64, block: usize, samples: usize, parameter: usize) -> Vec<f64> {
    let order = RandomStream::new(seed, "sweep: order of strata");
    let mut strata: Vec<usize> = (0..samples).collect();
    for last in (1..samples).rev() {
        let pick = fraction(order.block(block as u64, last, parameter as u32));
        strata.swap(last, (pick * (last + 1) as f64) as usize);
    }
    let within = |(sample, stratum): (usize, &usize)| {
        (*stratum as f64 + random(seed, block, sample, parameter)) / samples as f64
    };
    strata.iter().enumerate().map(within).collect()
}

/// A seed, at most 2^53 so that every program that reads the table reads it whole.
pub(super) fn seed(of: u64, point: usize, replicate: u32, attempt: u64) -> u64 {
    bits(RandomStream::new(of, "sweep: seeds").block(attempt, point, replicate))
}

fn bits([low, high, ..]: [u32; 4]) -> u64 {
    (u64::from(low) | u64::from(high) << 32) >> (u64::BITS - BITS)
}

fn fraction(words: [u32; 4]) -> f64 {
    bits(words) as f64 / (1_u64 << BITS) as f64
}

impl Range {
    /// What is wrong with the range.
    pub fn problem(self) -> Option<&'static str> {
        let good = match self {
            Self::Uniform(low, high) => low.is_finite() && high.is_finite() && low < high,
            Self::LogUniform(low, high) => low > 0.0 && high.is_finite() && low < high,
            Self::Integer(low, high) => low <= high,
        };
        let expected = match self {
            Self::Uniform(..) => "two finite numbers, the smaller first",
            Self::LogUniform(..) => "two positive finite numbers, the smaller first",
            Self::Integer(..) => "two whole numbers, the smaller first",
        };
        (!good).then_some(expected)
    }

    /// The value at a share of the range in [0, 1), as RON.
    pub fn at(self, share: f64) -> String {
        match self {
            Self::Uniform(low, high) => format!("{:?}", low + share * (high - low)),
            Self::LogUniform(low, high) => {
                format!("{:?}", low * (share * (high / low).ln()).exp())
            }
            Self::Integer(low, high) => {
                let count = high.abs_diff(low) as f64 + 1.0;
                let above = (share * count) as u64;
                low.saturating_add_unsigned(above.min(high.abs_diff(low))).to_string()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_stratum_is_hit_once_whatever_the_seed() {
        for (seed, samples) in [(0, 1), (1, 2), (7, 10), (u64::MAX, 137)] {
            for parameter in 0..3 {
                let values = stratified(seed, 2, samples, parameter);
                let mut strata: Vec<usize> =
                    values.iter().map(|value| (value * samples as f64) as usize).collect();
                strata.sort_unstable();
                assert_eq!(strata, (0..samples).collect::<Vec<_>>());
            }
        }
        assert_ne!(stratified(1, 0, 50, 0), stratified(1, 0, 50, 1));
    }

    #[test]
    fn ranges_are_filled_evenly() {
        let values = |range: Range| -> Vec<f64> {
            (0..4000).map(|sample| range.at(random(5, 0, sample, 0)).parse().unwrap()).collect()
        };
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let uniform = values(Range::Uniform(2.0, 4.0));
        assert!(uniform.iter().all(|value| (2.0..4.0).contains(value)));
        // Standard errors: 2 / sqrt(12 n), 1 / sqrt(12 n) decades, sqrt(2 / n).
        assert!((mean(&uniform) - 3.0).abs() < 0.03);
        let logs: Vec<f64> =
            values(Range::LogUniform(1.0, 100.0)).iter().map(|value| value.log10()).collect();
        assert!(
            logs.iter().all(|log| (0.0..2.0).contains(log)) && (mean(&logs) - 1.0).abs() < 0.03
        );
        let whole = values(Range::Integer(-2, 2));
        for expected in -2..=2 {
            let count = whole.iter().filter(|&&value| value == f64::from(expected)).count();
            assert!((700..900).contains(&count), "{expected}: {count}");
        }
    }

    #[test]
    fn impossible_ranges_are_told() {
        for range in [
            Range::Uniform(1.0, 1.0),
            Range::Uniform(0.0, f64::NAN),
            Range::LogUniform(0.0, 1.0),
            Range::LogUniform(1.0, f64::INFINITY),
            Range::Integer(2, 1),
        ] {
            assert!(range.problem().is_some(), "{range:?}");
        }
        assert_eq!(Range::Integer(i64::MIN, i64::MAX).at(0.0), i64::MIN.to_string());
        assert!(Range::Integer(3, 3).problem().is_none());
    }
}
