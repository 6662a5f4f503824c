//! A number as a strip: the band, a dot for every seed, and a line at the number of the source.

use std::fmt::Write;

use crate::reproduce::{Band, TargetReport};

/// Size of a strip in pixels.
const SIZE: (f64, f64) = (150.0, 16.0);

/// The strip of a number, as an element of a page; nothing where there is nothing to compare.
pub(super) fn strip(band: Band, target: &TargetReport) -> String {
    let (low, high) = bounds(band);
    let ends = [low, high].into_iter().flatten();
    let all = target.seeds.iter().copied().chain(ends).chain(target.thesis);
    let finite = all.filter(|value| value.is_finite());
    let (least, most) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), value| {
        (least.min(value), most.max(value))
    });
    if target.seeds.is_empty() || least > most || (low, high, target.thesis) == (None, None, None) {
        return String::new();
    }
    // A tenth of the range is free at both ends, so that what lies at an end is seen.
    let margin = 0.1 * (most - least).max(1e-12 * most.abs()).max(f64::MIN_POSITIVE);
    let (from, range) = (least - margin, most - least + 2.0 * margin);
    let at = |value: f64| (SIZE.0 * (value - from) / range).clamp(0.0, SIZE.0);
    let (width, height) = SIZE;
    let mut text = format!(
        "<svg class=\"strip\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\
         <line x1=\"0\" x2=\"{width}\" y1=\"8\" y2=\"8\"/>"
    );
    if low.is_some() || high.is_some() {
        let (start, end) = (low.map_or(0.0, at), high.map_or(width, at));
        let wide = (end - start).max(1.0);
        let _ = write!(text, "<rect x=\"{start:.1}\" width=\"{wide:.1}\" y=\"2\" height=\"12\"/>");
    }
    if let Some(thesis) = target.thesis.map(at) {
        let _ = write!(text, "<path d=\"M{thesis:.1} 1V15\"/>");
    }
    for seed in target.seeds.iter().copied().filter(|seed| seed.is_finite()).map(at) {
        let _ = write!(text, "<circle cx=\"{seed:.1}\" cy=\"8\" r=\"2.5\"/>");
    }
    text + "</svg>"
}

/// The ends that a band has.
fn bounds(band: Band) -> (Option<f64>, Option<f64>) {
    match band {
        Band::Printed => (None, None),
        Band::Within(low, high) => (Some(low), Some(high)),
        Band::AtLeast(low) => (Some(low), None),
        Band::AtMost(high) => (None, Some(high)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::Verdict;

    fn drawn(band: Band, thesis: Option<f64>, seeds: &[f64]) -> String {
        let target = TargetReport {
            name: String::new(),
            value: seeds.first().copied(),
            seeds: seeds.to_vec(),
            thesis,
            band: band.to_string(),
            verdict: Verdict::Printed,
            reason: String::new(),
        };
        strip(band, &target)
    }

    #[test]
    fn a_strip_has_the_band_the_seeds_and_the_source() {
        // 0 to 10 with a tenth free on both sides: 12.5 pixels a unit from 12.5.
        let text = drawn(Band::Within(2.0, 4.0), Some(10.0), &[0.0, 3.0]);
        for part in ["x=\"37.5\" width=\"25.0\"", "cx=\"12.5\"", "cx=\"50.0\"", "M137.5 1V15"] {
            assert!(text.contains(part), "{part} in {text}");
        }
        let open = drawn(Band::AtLeast(10.0), None, &[0.0, 5.0]);
        assert!(open.contains("x=\"137.5\" width=\"12.5\"") && !open.contains("<path"), "{open}");
    }

    #[test]
    fn odd_numbers_do_no_harm() {
        assert_eq!(drawn(Band::AtMost(1.0), None, &[]), "");
        assert_eq!(drawn(Band::Printed, None, &[1.0, 2.0]), "");
        for seeds in [&[f64::NAN][..], &[f64::INFINITY, 1.0], &[5.0, 5.0], &[0.0]] {
            let text = drawn(Band::AtMost(0.0), Some(0.0), seeds);
            assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        }
    }
}
