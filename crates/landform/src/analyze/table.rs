//! The numbers of an analysis as lines of text.

use landform_analysis::hydrology::{Drainage, PowerLaw};
use landform_analysis::{Dimension, Hypsometry};
use serde::Serialize;

use super::{
    CaveNumbers, Heights, LineNumbers, RasterNumbers, Shore, SlopeQuantiles, Spectral,
    SpectralNumbers,
};

/// The lines of a raster.
pub(super) fn raster(numbers: &RasterNumbers) -> String {
    let mut text = heading(numbers);
    let mut line = |name: &str, words: Option<String>| {
        text += &format!("  {name:<12} {}\n", words.unwrap_or_else(|| "-".to_owned()));
    };
    line("heights", numbers.heights.as_ref().map(heights));
    line("hypsometry", numbers.hypsometry.as_ref().map(hypsometry));
    line("spectrum", numbers.spectrum.as_ref().map(|found| spectrum(&found.prepared)));
    if let Some(Spectral { preparation, untreated, .. }) = &numbers.spectrum {
        line("", Some(format!("({preparation})")));
        line("  untreated", Some(spectrum(untreated)));
    }
    line(
        "surface",
        numbers.dimension.variogram.as_ref().map(|found| dimension(found, "variogram")),
    );
    line("shore", numbers.dimension.shore.as_ref().map(shore));
    line("slope", numbers.slope_deg.as_ref().map(slope));
    line(
        "depressions",
        numbers.depressions.as_ref().map(|found| {
            format!(
                "{} with {:.2} % of the area, {} m³, deepest {} m",
                found.count,
                found.area_percent,
                short(found.volume),
                short(found.deepest)
            )
        }),
    );
    line("drainage", numbers.drainage.as_ref().map(laws));
    line("", numbers.drainage.as_ref().map(network));
    for note in &numbers.notes {
        line("note", Some(note.clone()));
    }
    text
}

/// The lines of a line file.
pub(super) fn lines(numbers: &LineNumbers) -> String {
    let LineNumbers { lines, closed, points, .. } = numbers;
    let measured = if numbers.geographic { "degrees, measured on the sphere" } else { "metres" };
    let kind = match (lines, closed) {
        (1, 1) => "a closed line".to_owned(),
        (1, _) => "an open line".to_owned(),
        (count, closed) => format!("{count} lines, {closed} of them closed,"),
    };
    let mut text = format!("{}: {kind} of {points} points in {measured}\n", numbers.file);
    let mut line = |name: &str, words: Option<String>| {
        text += &format!("  {name:<12} {}\n", words.unwrap_or_else(|| "-".to_owned()));
    };
    line("length", Some(format!("{} km", short(numbers.length_m / 1000.0))));
    line("divider", numbers.divider.as_ref().map(|found| dimension(found, "dividers")));
    line("box", numbers.boxes.as_ref().map(|found| dimension(found, "boxes")));
    for note in &numbers.notes {
        line("note", Some(note.clone()));
    }
    text
}

/// The lines of a cave.
pub(super) fn cave(numbers: &CaveNumbers) -> String {
    let shape = &numbers.shape;
    let mut text = format!(
        "{}: {}, {} stations, {} legs, {} m\n",
        numbers.file,
        numbers.kind,
        numbers.stations,
        numbers.legs,
        short(shape.length_m)
    );
    let mut line = |name: &str, words: String| text += &format!("  {name:<24} {words}\n");
    let parts = format!(
        "{}, {} loops in {} parts",
        shape.branches, shape.cyclomatic_number, shape.components
    );
    line("branches", parts);
    for beside in &numbers.observed {
        let [least, most] = beside.range.map(short);
        let value = beside.value.map_or_else(|| "-".to_owned(), short);
        let verdict = match beside.within {
            Some(true) => ", within",
            Some(false) => ", outside",
            None => "",
        };
        line(
            &beside.name.replace('_', " "),
            format!("{value} ({least} to {most} in 31 caves{verdict})"),
        );
    }
    if let Some(indices) = &numbers.indices {
        let totals = indices.totals;
        line(
            "volume",
            format!("{} m³ over {} m of height", short(totals.volume_m3), short(totals.height_m)),
        );
        line(
            "area",
            format!("{} m², on the map {} m²", short(totals.area_m2), short(totals.plan_area_m2)),
        );
        line("cave field", format!("{} m²", short(totals.field_m2)));
        line("network density", format!("{} m/m²", short(indices.network_density)));
        line("areal coverage", format!("{} %", short(indices.areal_coverage_percent)));
        line("porosity", format!("{} %", short(indices.porosity_percent)));
        line("length to width", short(indices.length_to_width));
        line("width", format!("{} m", short(indices.width_m)));
    }
    text
}

fn heading(numbers: &RasterNumbers) -> String {
    let [columns, rows] = numbers.size;
    let [width, height] = numbers.cell_m;
    let cells = match (width - height).abs() < 1e-4 * width {
        true => format!("{} m", short(width)),
        false => format!("{} x {} m", short(width), short(height)),
    };
    let gaps = match numbers.no_data_percent {
        0.0 => "no gaps".to_owned(),
        share => format!("{share:.2} % without data"),
    };
    format!(
        "{}: {columns} x {rows} cells of {cells}, {} x {} km, {gaps}\n",
        numbers.file,
        short(columns as f64 * width / 1000.0),
        short(rows as f64 * height / 1000.0),
    )
}

fn heights(found: &Heights) -> String {
    format!(
        "{} to {} m, mean {}, standard deviation {}",
        short(found.lowest_m),
        short(found.highest_m),
        short(found.mean_m),
        short(found.deviation_m)
    )
}

fn hypsometry(found: &Hypsometry) -> String {
    format!(
        "integral {:.3}, {}; a/d {:.3}, z {:.3}, misfit {:.3}; {}",
        found.integral,
        words(&found.stage),
        found.a_over_d,
        found.z,
        found.misfit,
        words(&found.form)
    )
}

fn spectrum(found: &SpectralNumbers) -> String {
    let mut parts = Vec::new();
    if let (Some(beta), Some(error)) = (found.beta, found.beta_error) {
        let [least, most] = found.beta_range_m.unwrap_or_default();
        parts.push(format!(
            "beta {beta:.3} ± {error:.3} (waves of {} to {} m)",
            short(least),
            short(most)
        ));
    }
    if let (Some(rms), Some(r2)) = (found.rms, found.r2) {
        parts.push(format!("RMS {rms:.3}, R² {r2:.3}"));
    }
    if parts.is_empty() { "-".to_owned() } else { parts.join("; ") }
}

/// A dimension with its method and range.
fn dimension(found: &Dimension, method: &str) -> String {
    let [least, most] = found.range_m;
    format!(
        "D {:.3} ± {:.3} by {method}, {} to {} m",
        found.dimension,
        found.error,
        short(least),
        short(most)
    )
}

fn shore(found: &Shore) -> String {
    format!("{} (line at {} m)", dimension(&found.dimension, "perimeter"), short(found.level_m))
}

fn slope(found: &SlopeQuantiles) -> String {
    format!(
        "median {:.1}°, mean {:.1}°; 5, 25, 75, 95 %: {:.1}, {:.1}, {:.1}, {:.1}°; steepest {:.1}°",
        found.median, found.mean, found.p5, found.p25, found.p75, found.p95, found.steepest
    )
}

fn laws(found: &Drainage) -> String {
    let law = |name: &str, law: Option<PowerLaw>| match law {
        Some(law) => format!("{name} {:.3} ± {:.3}", law.exponent, law.error),
        None => format!("{name} -"),
    };
    [
        law("exceedance", found.exceedance),
        law("Hack", found.hack),
        law("concavity", found.slope_area.map(|law| law.concavity)),
    ]
    .join(", ")
}

fn network(found: &Drainage) -> String {
    let horton = found.horton.as_ref().map_or(String::new(), |horton| {
        format!(
            ", Horton's ratios {:.1} (number), {:.1} (length), {:.1} (area)",
            horton.bifurcation, horton.length, horton.area
        )
    });
    format!(
        "largest basin {} km², channels {} km/km² from {} cells{horton}",
        short(found.largest_basin_m2 / 1e6),
        short(found.density * 1000.0),
        found.channel_cells
    )
}

/// The name of a variant, as it stands in JSON, in words.
pub(super) fn words(variant: &impl Serialize) -> String {
    let name = serde_json::to_value(variant).unwrap_or_default();
    name.as_str().unwrap_or_default().replace('_', " ")
}

/// A number with about four digits, or as a power of ten.
pub(super) fn short(value: f64) -> String {
    let size = value.abs();
    let decimals = match size {
        _ if size == 0.0 || size.fract() == 0.0 && size < 1e6 => 0,
        1e3..1e6 => 0,
        1e2..1e3 => 1,
        1e1..1e2 => 2,
        1.0..1e1 => 3,
        1e-3..1.0 => 4,
        _ => {
            let text = format!("{value:.3e}");
            let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
            return format!("{}e{power}", plain(digits));
        }
    };
    plain(&format!("{value:.decimals$}")).to_owned()
}

/// A number without the zeros at the end of its decimals.
fn plain(digits: &str) -> &str {
    match digits.contains('.') {
        true => digits.trim_end_matches('0').trim_end_matches('.'),
        false => digits,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (30.0, "30"),
            (-6134.0, "-6134"),
            (35.91, "35.91"),
            (1105.23, "1105"),
            (0.01234, "0.0123"),
            (12_345_678.0, "1.235e7"),
            (1e-9, "1e-9"),
            (0.1, "0.1"),
            (66.5, "66.5"),
            (-1200.4, "-1200"),
        ] {
            assert_eq!(short(value), text);
        }
    }
}
