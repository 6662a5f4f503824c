//! All runs as one table.

use super::{Results, Status};

/// The runs as comma-separated values with a header, a row a run in the order of the sweep.
pub(super) fn csv(results: &Results<'_>) -> String {
    let names = &results.plan.names;
    let metrics = results.metric_names();
    let mut header = vec!["run".to_owned(), "seed".to_owned()];
    header.extend(names.iter().map(|name| quoted(name)));
    header.extend(["status", "reason", "iterations"].map(str::to_owned));
    // A metric and a parameter of one name stay two columns.
    header.extend(metrics.iter().map(|metric| match names.contains(metric) {
        true => quoted(&format!("{metric} (measured)")),
        false => quoted(metric),
    }));
    let mut text = header.join(",") + "\n";
    for run in &results.runs {
        let (status, reason) = match &run.outcome {
            None => ("missing", ""),
            Some(own) if own.status == Status::Done => ("done", ""),
            Some(own) => ("failed", own.reason.as_str()),
        };
        let mut row = vec![run.run.number.to_string(), run.run.seed.to_string()];
        row.extend(run.run.values.iter().map(|value| quoted(value.trim_matches('"'))));
        row.extend([status.to_owned(), quoted(reason)]);
        row.push(run.iterations.map_or(String::new(), |count| count.to_string()));
        let value = |metric| run.metric(metric).map_or(String::new(), |value| format!("{value:?}"));
        row.extend(metrics.iter().map(|metric| value(metric)));
        text += &(row.join(",") + "\n");
    }
    text
}

/// A value of a table: in quotes where it holds a comma, a quote or the end of a line.
fn quoted(value: &str) -> String {
    match value.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", value.replace('"', "\"\"")),
        false => value.to_owned(),
    }
}
