//! Where the numbers of an axis stand, and how they are written.

use super::axis::{Scale, Span};

/// A mark of an axis; without text a small one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub value: f64,
    pub text: Option<String>,
}

/// The ticks of an axis with at most about `most` numbers.
pub(super) fn ticks(span: &Span, most: usize) -> Vec<Tick> {
    let most = most.max(2) as f64;
    match span.scale {
        Scale::Linear => linear(span.low, span.high, most),
        Scale::Log if span.high - span.low < 1.0 => few_decades(span, most),
        Scale::Log => decades(span, most),
        Scale::SignedLog => both_sides(span),
    }
}

/// The ticks of an axis of names.
pub(super) fn named(names: &[String]) -> Vec<Tick> {
    let tick =
        |(index, name): (usize, &String)| Tick { value: index as f64, text: Some(name.clone()) };
    names.iter().enumerate().map(tick).collect()
}

/// Steps of 1, 2 or 5 times a power of ten.
fn linear(low: f64, high: f64, most: f64) -> Vec<Tick> {
    let rough = (high - low) / most;
    let power = 10.0_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power);
    let step = step.into_iter().find(|&step| step >= 0.999 * rough).unwrap_or(rough);
    if !(step.is_finite() && step > 0.0) {
        return Vec::new();
    }
    let (first, last) = ((low / step).ceil(), (high / step).floor());
    // A range so narrow that neighbouring numbers cannot be told apart has no ticks.
    let count = (last - first + 1.0).clamp(0.0, 100.0) as usize;
    let values: Vec<f64> = (0..count).map(|index| (first + index as f64) * step).collect();
    let largest = values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let tick = |value: f64| Tick { value, text: Some(number(value, step, largest)) };
    values.into_iter().map(tick).collect()
}

/// Less than a decade: as on a linear axis, between the values.
fn few_decades(span: &Span, most: f64) -> Vec<Tick> {
    linear(10.0_f64.powf(span.low), 10.0_f64.powf(span.high), most)
}

/// Powers of ten, small ticks between them, and 2 and 5 with numbers where there is room.
fn decades(span: &Span, most: f64) -> Vec<Tick> {
    let (first, last) = (span.low.floor() as i32, span.high.floor() as i32);
    let count = span.high - span.low;
    let every = (count / most).ceil().max(1.0) as i32;
    let mut ticks = Vec::new();
    for power in first..=last {
        for digit in 1..10 {
            let value = f64::from(digit) * 10.0_f64.powi(power);
            let share = span.share(value);
            let numbered = match digit {
                1 => power.rem_euclid(every) == 0,
                2 | 5 => 3.0 * count <= most,
                _ => false,
            };
            // Where decades are skipped, small ticks would be a grey band.
            let shown = digit == 1 || every == 1;
            if shown && (-1e-9..=1.0 + 1e-9).contains(&share) {
                let text = numbered.then(|| power_text(digit, power));
                ticks.push(Tick { value, text });
            }
        }
    }
    ticks
}

/// 0 and the powers of ten on both sides of it, the small ones without their numbers.
fn both_sides(span: &Span) -> Vec<Tick> {
    let largest = span.low.abs().max(span.high.abs());
    let powers = (0..=largest.min(300.0) as i32).map(|power| (power, 10.0_f64.powi(power)));
    let text = |power: i32| (power > 0 || largest < 2.0).then(|| power_text(1, power));
    let mut ticks = vec![Tick { value: 0.0, text: Some("0".to_owned()) }];
    for (power, value) in powers {
        let negative = text(power).map(|text| format!("\u{2212}{text}"));
        ticks.push(Tick { value: -value, text: negative });
        ticks.push(Tick { value, text: text(power) });
    }
    ticks
}

/// A digit times a power of ten: as a plain number where that is short.
fn power_text(digit: i32, power: i32) -> String {
    match (digit, power) {
        (_, -3..=3) => {
            let decimals = (-power).max(0) as usize;
            format!("{:.decimals$}", f64::from(digit) * 10.0_f64.powi(power))
        }
        (1, _) => format!("10{}", raised(power)),
        _ => format!("{digit}·10{}", raised(power)),
    }
}

/// A number of an axis whose numbers lie `step` apart and are at most `largest`.
fn number(value: f64, step: f64, largest: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let step_power = step.log10().floor() as i32;
    if !(1e-3..1e5).contains(&largest) {
        let power = largest.log10().floor() as i32;
        let decimals = (power - step_power).max(0) as usize;
        return format!("{:.decimals$}·10{}", value / 10.0_f64.powi(power), raised(power))
            .replace('-', "\u{2212}");
    }
    let decimals = (-step_power).max(0) as usize;
    format!("{value:.decimals$}").replace('-', "\u{2212}")
}

/// An exponent in raised figures.
fn raised(power: i32) -> String {
    let figure = |letter: char| match letter {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => digit.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(digit),
    };
    power.to_string().chars().map(figure).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(scale: Scale, low: f64, high: f64) -> Vec<String> {
        let ticks = ticks(&Span { scale, low, high }, 6);
        ticks.into_iter().filter_map(|tick| tick.text).collect()
    }

    #[test]
    fn linear_ticks_are_round_numbers() {
        assert_eq!(texts(Scale::Linear, 0.0, 10.0), ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(texts(Scale::Linear, -0.31, 0.22), ["−0.3", "−0.2", "−0.1", "0", "0.1", "0.2"]);
        assert_eq!(texts(Scale::Linear, 0.0, 2.1e-5)[1], "0.5·10⁻⁵");
        assert_eq!(texts(Scale::Linear, 0.0, 4e6)[1], "1·10⁶");
    }

    #[test]
    fn logarithmic_ticks_are_powers_of_ten() {
        assert_eq!(texts(Scale::Log, -1.0, 3.0), ["0.1", "1", "10", "100", "1000"]);
        assert_eq!(texts(Scale::Log, 0.0, 2.0), ["1", "2", "5", "10", "20", "50", "100"]);
        assert_eq!(texts(Scale::Log, -12.0, 0.0).len(), 7);
        assert_eq!(texts(Scale::Log, -6.0, -4.0)[0], "10⁻⁶");
        let small = ticks(&Span { scale: Scale::Log, low: 0.0, high: 4.0 }, 6);
        assert_eq!(small.iter().filter(|tick| tick.text.is_none()).count(), 4 * 8);
        assert_eq!(texts(Scale::Log, 2.0_f64.log10(), 4.0_f64.log10())[0], "2.0");
    }

    #[test]
    fn signed_logarithms_have_the_same_ticks_on_both_sides() {
        let reach = 513.0_f64.log10();
        assert_eq!(texts(Scale::SignedLog, -reach, reach), ["0", "−10", "10", "−100", "100"]);
        assert_eq!(texts(Scale::SignedLog, -0.8, 0.8), ["0", "−1", "1"]);
    }

    #[test]
    fn absurd_ranges_have_few_ticks() {
        for (low, high) in [(1e300, 1.1e300), (1.0, 1.0 + 4e-16), (-1e-300, 1e-300)] {
            assert!(texts(Scale::Linear, low, high).len() <= 100, "{low} {high}");
        }
        assert!(texts(Scale::Log, -300.0, 300.0).len() <= 8);
    }
}
