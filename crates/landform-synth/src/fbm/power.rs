//! One power of many numbers.

/// Parts into which the numbers from 1 to 2 are divided.
const PARTS: usize = 256;

/// Powers with one exponent, to 15 digits: 2^k for whole k and the middle of each part come from
/// tables, the rest is a series.
#[derive(Debug)]
pub(super) struct Power {
    /// Powers of 2^-64 to 2^63.
    of_two: [f64; 128],
    /// Powers of the middles of the parts.
    of_middle: [f64; PARTS],
    /// Coefficients of (1 + d)^exponent.
    series: [f64; 6],
}

impl Power {
    /// For an exponent between -2 and 2.
    pub fn new(exponent: f64) -> Self {
        let middle = |part: usize| 1.0 + (part as f64 + 0.5) / PARTS as f64;
        let mut series = [1.0; 6];
        for order in 1..6 {
            let below = order as f64 - 1.0;
            series[order] = series[order - 1] * (exponent - below) / (below + 1.0);
        }
        Self {
            of_two: std::array::from_fn(|k| ((k as f64 - 64.0) * exponent).exp2()),
            of_middle: std::array::from_fn(|part| middle(part).powf(exponent)),
            series,
        }
    }

    /// The power of a number between 2^-64 and 2^64.
    #[inline(always)]
    pub fn of(&self, number: f64) -> f64 {
        const PART: u64 = 1 << 44;
        let bits = number.to_bits();
        let part = (bits / PART) as usize % PARTS;
        // 1.0 has 1023 there, which goes to the middle of the table.
        let exponent = ((bits >> 52) as usize + 65) % 128;
        let middle = f64::from_bits((bits & !(PART - 1)) + PART / 2);
        // At most 1 / 512, so the first term left out is below the last digit.
        let d = (number - middle) / middle;
        let [c0, c1, c2, c3, c4, c5] = self.series;
        let rest = c0 + d * (c1 + d * (c2 + d * (c3 + d * (c4 + d * c5))));
        self.of_two[exponent] * (self.of_middle[part] * rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_agree_with_the_library() {
        for exponent in [-1.0, -0.9, -0.5, 0.0, 2.0] {
            let power = Power::new(exponent);
            for step in 0..20_000 {
                let number = (-40.0 + f64::from(step) * 0.004).exp();
                let ratio = power.of(number) / number.powf(exponent);
                assert!((ratio - 1.0).abs() < 4e-15, "{number}^{exponent}: {ratio}");
            }
        }
    }
}
