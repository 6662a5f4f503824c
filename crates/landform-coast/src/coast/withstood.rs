//! How much shore a node needs to withstand the sea.

/// The least whole number for which `falls` does not hold, between 0 and `i32::MAX`, found from a
/// guess.
///
/// `falls` must not hold for any number above one for which it does not hold: force sinks with
/// the perimeter. It is asked, not solved: what comes out agrees with it to the last bit.
pub(super) fn least_withstood(falls: impl Fn(i32) -> bool, guess: f64) -> i32 {
    if !falls(0) {
        return 0;
    }
    // What is no number becomes zero.
    let guess = guess.clamp(0.0, f64::from(i32::MAX)) as i32;
    let (mut low, mut high) = (0, i32::MAX);
    let mut step = 1;
    if falls(guess) {
        low = guess;
        while let Some(next) = low.checked_add(step) {
            if !falls(next) {
                high = next;
                break;
            }
            (low, step) = (next, step.saturating_mul(2));
        }
    } else {
        high = guess;
        while high - step > 0 {
            if falls(high - step) {
                low = high - step;
                break;
            }
            (high, step) = (high - step, step.saturating_mul(2));
        }
    }
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if falls(middle) { low = middle } else { high = middle }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::least_withstood;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_border_is_found_from_any_guess(
            border in prop_oneof![0_i32..100, 0..=i32::MAX],
            away in prop_oneof![-100.0_f64..100.0, -1e10..1e10, Just(f64::NAN)],
        ) {
            let guess = f64::from(border) + away;
            prop_assert_eq!(least_withstood(|parts| parts < border, guess), border);
        }
    }
}
