//! Random numbers on the bell curve and on the circle, by arithmetic alone: many at a time, with the
//! same bits on every machine.

/// Distance from the origin of a point whose two coordinates are independent normal numbers
/// (Box and Muller 1958), 0 to 6.8.
#[inline(always)]
pub(super) fn radius(word: u32) -> f64 {
    let share = (f64::from(word) + 0.5) * (1.0 / 4_294_967_296.0);
    (-2.0 * logarithm(share)).sqrt()
}

/// Natural logarithm of a positive normal number.
#[inline(always)]
fn logarithm(number: f64) -> f64 {
    // As 2^exponent times a fraction between the roots of 1/2 and of 2.
    const ROOT_OF_HALF: u64 = std::f64::consts::FRAC_1_SQRT_2.to_bits();
    const FRACTION: u64 = (1 << 52) - 1;
    let shifted = number.to_bits().wrapping_add(1.0_f64.to_bits() - ROOT_OF_HALF);
    let exponent = f64::from((shifted >> 52) as i32 - 1023);
    let fraction = f64::from_bits((shifted & FRACTION) + ROOT_OF_HALF);
    // ln x = 2 artanh((x - 1) / (x + 1)), at most 0.172, by its series.
    let t = (fraction - 1.0) / (fraction + 1.0);
    let z = t * t;
    let tail = 1.0 / 11.0 + z * (1.0 / 13.0 + z * (1.0 / 15.0 + z * (1.0 / 17.0)));
    let series = 1.0 / 3.0 + z * (1.0 / 5.0 + z * (1.0 / 7.0 + z * (1.0 / 9.0 + z * tail)));
    exponent * std::f64::consts::LN_2 + 2.0 * t * (1.0 + z * series)
}

/// A point on the unit circle.
#[inline(always)]
pub(super) fn circle(word: u32) -> [f64; 2] {
    // 30 bits are a place in the quarter about east, two turn it north and to the other side.
    let place = f64::from((word & 0x3FFF_FFFF) as i32) + 0.5;
    let angle = (place * (1.0 / 1_073_741_824.0) - 0.5) * std::f64::consts::FRAC_PI_2;
    let [sine, cosine] = sine_cosine(angle);
    let side = if word >> 31 == 0 { 1.0 } else { -1.0 };
    let [x, y] = if word & 1 << 30 == 0 { [cosine, sine] } else { [sine, cosine] };
    [side * x, side * y]
}

/// Sine and cosine of an angle up to 45 degrees to either side, by their series.
#[inline(always)]
fn sine_cosine(angle: f64) -> [f64; 2] {
    /// 1 / n! for n from 0 to 15.
    const INVERSE: [f64; 16] = {
        let mut all = [1.0; 16];
        let mut number = 1;
        while number < 16 {
            all[number] = all[number - 1] / number as f64;
            number += 1;
        }
        all
    };
    let z = -angle * angle;
    let [mut cosine, mut sine] = [INVERSE[14], INVERSE[15]];
    for order in (0..7).rev() {
        cosine = INVERSE[2 * order] + z * cosine;
        sine = INVERSE[2 * order + 1] + z * sine;
    }
    [angle * sine, cosine]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, TAU};

    /// Words from all over their range, both ends among them.
    fn words() -> impl Iterator<Item = u32> {
        (0..=20_000_u32).map(|n| n.wrapping_mul(214_748)).chain([1, u32::MAX - 1, u32::MAX])
    }

    #[test]
    fn series_agree_with_the_library() {
        for word in words() {
            let share = (f64::from(word) + 0.5) / 4_294_967_296.0;
            assert!((logarithm(share) - share.ln()).abs() < 1e-14 * (1.0 - share.ln()), "{share}");
            let angle = (share - 0.5) * FRAC_PI_2;
            let [sine, cosine] = sine_cosine(angle);
            let worst = (sine - angle.sin()).abs().max((cosine - angle.cos()).abs());
            assert!(worst < 2e-15, "{angle}: {worst}");
        }
        assert!(radius(0) < 6.8 && radius(u32::MAX) > 0.0);
    }

    /// Places are all around, evenly, and as far as the bell curve says: the squares of distances
    /// are twice exponential.
    #[test]
    fn draws_have_their_distributions() {
        let count = words().count() as f64;
        let mut angles: Vec<f64> = words().map(circle).map(|[x, y]| y.atan2(x) / TAU).collect();
        angles.sort_by(f64::total_cmp);
        for (rank, angle) in angles.iter().enumerate() {
            assert!((angle + 0.5 - rank as f64 / count).abs() < 1e-3, "{angle}");
        }
        let mut squares: Vec<f64> = words().map(|word| radius(word).powi(2)).collect();
        squares.sort_by(f64::total_cmp);
        for (rank, square) in squares.iter().enumerate() {
            assert!((1.0 - (-0.5 * square).exp() - rank as f64 / count).abs() < 1e-3, "{square}");
        }
    }
}
