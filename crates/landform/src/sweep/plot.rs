//! Metrics against parameters.

use std::collections::BTreeMap;
use std::path::Path;

use landform_view::plot::{Axis, Figure, Line, Marker, Panel, Point, Series, label};

use super::Results;
use super::file::PlotEntry;
use super::results::Finished;

/// Most panels of plots that nobody asked for.
const MOST_PANELS: usize = 12;
/// Most series that can be told apart.
const MOST_SERIES: usize = 7;

/// Markers in the order of series.
const MARKERS: [Marker; 4] = [Marker::Disc, Marker::Square, Marker::Triangle, Marker::Diamond];

/// Writes `plots.png` and `plots.svg`, as far as there is something to plot.
pub(super) fn write(results: &Results<'_>, folder: &Path) -> Result<bool, String> {
    let entries = match results.plan.plots.as_slice() {
        [] => usual(results),
        entries => entries.to_vec(),
    };
    let panels: Vec<Panel> = entries.iter().filter_map(|entry| panel(results, entry)).collect();
    if panels.is_empty() {
        return Ok(false);
    }
    let columns = (panels.len() as f64).sqrt().ceil() as usize;
    let figure = Figure { title: results.plan.title.clone(), panels, columns, ..Figure::default() };
    let text = [("Title", results.plan.title.as_str())];
    for file in ["plots.png", "plots.svg"] {
        figure.write(&folder.join(file), &text).map_err(|error| error.to_string())?;
    }
    Ok(true)
}

/// Every metric against the first parameter, by the second one where it has few values.
fn usual(results: &Results<'_>) -> Vec<PlotEntry> {
    let names = &results.plan.names;
    let Some(against) = names.first() else { return Vec::new() };
    let few = |column: usize| {
        let values = results.plan.runs.iter().map(|run| &run.values[column]);
        values.collect::<std::collections::BTreeSet<_>>().len() <= MOST_SERIES
    };
    let by = names.get(1).filter(|_| few(1)).cloned().unwrap_or_default();
    let entry = |metric| PlotEntry {
        metric,
        against: against.clone(),
        by: by.clone(),
        ..PlotEntry::default()
    };
    results.metric_names().into_iter().take(MOST_PANELS).map(entry).collect()
}

/// The panel of an entry; none where no run has the metric.
fn panel(results: &Results<'_>, entry: &PlotEntry) -> Option<Panel> {
    let names = &results.plan.names;
    let column = |name: &str| names.iter().position(|known| known == name);
    let against = if entry.against.is_empty() { 0 } else { column(&entry.against)? };
    let by = column(&entry.by);
    let measured: Vec<(&Finished, f64)> = (results.runs.iter())
        .filter_map(|run| Some((run, run.metric(&entry.metric).filter(|v| v.is_finite())?)))
        .collect();
    if measured.is_empty() || names.is_empty() {
        return None;
    }
    let words = words(&measured, against);
    let x_of = |run: &Finished| match &words {
        Some(words) => {
            words.iter().position(|word| *word == run.run.values[against]).map(|at| at as f64)
        }
        None => number(&run.run.values[against]),
    };
    let axis = |log: bool, name: &str| match log {
        true => Axis::log(label(name)),
        false => Axis::linear(label(name)),
    };
    let mut panel = Panel {
        x: axis(entry.log_x && words.is_none(), &names[against]),
        y: axis(entry.log_y, &entry.metric),
        ..Panel::default()
    };
    for (index, group) in groups(&measured, by).into_iter().enumerate() {
        let values: Vec<(f64, f64)> =
            group.1.iter().filter_map(|(run, y)| Some((x_of(run)?, *y))).collect();
        let name = by.map_or(String::new(), |by| format!("{} {}", names[by], short(&group.0)));
        panel.series.extend(series(&name, index, values));
    }
    panel.x.names = words.unwrap_or_default().iter().map(|word| short(word)).collect();
    Some(panel)
}

/// The runs by the value of a parameter, in the order of their first run.
fn groups<'r>(
    measured: &[(&'r Finished<'r>, f64)],
    by: Option<usize>,
) -> Vec<(String, Vec<(&'r Finished<'r>, f64)>)> {
    let mut groups: Vec<(String, Vec<_>)> = Vec::new();
    for &(run, y) in measured {
        let value = by.map_or(String::new(), |by| run.run.values[by].clone());
        match groups.iter_mut().find(|(known, _)| *known == value) {
            Some((_, group)) => group.push((run, y)),
            None => groups.push((value, vec![(run, y)])),
        }
    }
    groups
}

/// A dot for every run and, where runs share a place, their mean with its standard deviation.
fn series(name: &str, index: usize, values: Vec<(f64, f64)>) -> Vec<Series> {
    let mut places: BTreeMap<u64, (f64, Vec<f64>)> = BTreeMap::new();
    for &(x, y) in &values {
        // Floats in their order, as whole numbers.
        let bits = x.to_bits();
        let key = if bits >> 63 == 1 { !bits } else { bits | 1 << 63 };
        places.entry(key).or_insert((x, Vec::new())).1.push(y);
    }
    let replicated = places.values().any(|(_, values)| values.len() > 1);
    let marker = MARKERS[index % MARKERS.len()];
    let colour = Some(index);
    let mut all = Vec::new();
    if replicated {
        let points = values.iter().map(|&(x, y)| Point::new(x, y)).collect();
        all.push(Series { marker: Some(Marker::Dot), colour, ..Series::new("", points) });
    }
    let points: Vec<Point> = places.values().map(|(x, values)| mean(*x, values)).collect();
    // Samples are scattered: a line would only tie them together.
    let line = (replicated || points.len() <= 12).then_some(Line::Solid);
    all.push(Series { line, marker: Some(marker), colour, ..Series::new(name, points) });
    all
}

/// The mean of some values, with a bar of a standard deviation where there are several.
fn mean(x: f64, values: &[f64]) -> Point {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    let error = (values.len() > 1).then(|| {
        let deviation = (squares / (count - 1.0)).sqrt();
        [mean - deviation, mean + deviation]
    });
    Point { x, y: mean, error }
}

/// The values of a parameter that is no number, each once in the order of the runs.
fn words(measured: &[(&Finished<'_>, f64)], column: usize) -> Option<Vec<String>> {
    let values = || measured.iter().map(|(run, _)| &run.run.values[column]);
    if values().all(|value| number(value).is_some()) {
        return None;
    }
    let mut words: Vec<String> = Vec::new();
    for value in values() {
        if !words.contains(value) {
            words.push(value.clone());
        }
    }
    Some(words)
}

/// A value as a number, if it is one.
fn number(value: &str) -> Option<f64> {
    value.replace('_', "").parse().ok().filter(|number: &f64| number.is_finite())
}

/// A value of any length as a word beside an axis: `Shadow` of `Shadow(angle_deg: 15.0)`.
fn short(value: &str) -> String {
    const MOST_LETTERS: usize = 16;
    let value = value.trim_matches('"');
    let end = value.find('(').filter(|&at| at > 0).unwrap_or(value.len());
    value[..end].chars().take(MOST_LETTERS).collect()
}
