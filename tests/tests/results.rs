//! The page of results names every figure and every number that is compared, with its band.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use landform::reproduce::{Entry, all};
use landform::sim::simulation::Limits;
use landform_tests::repository;

#[test]
fn the_page_of_results_has_every_number() {
    let page = fs::read_to_string(repository().join("docs/src/results.md")).expect("a page");
    let thesis = repository().join("scenarios/thesis");
    let registry = Arc::new(landform::registry());
    let entries = all(&thesis, None).expect("target files");
    assert!(entries.len() > 40, "{} target files", entries.len());
    let mut lost = Vec::new();
    for path in entries {
        let entry = Entry::read(&path, &thesis, None, &registry, Limits::default());
        let entry = entry.unwrap_or_else(|why| panic!("{}: {why}", path.display()));
        lost.extend(
            missing(&page, &entry).into_iter().map(|what| format!("{}: {what}", entry.name)),
        );
    }
    let lost = lost.join("\n");
    assert!(lost.is_empty(), "not in docs/src/results.md; see docs/results.sh:\n{lost}");
}

/// What the page does not have of a figure.
fn missing(page: &str, entry: &Entry) -> Vec<String> {
    let heading =
        format!("\n### {}: {}\n\n`{}`\n", entry.figure.id, entry.figure.title, entry.name);
    let Some((_, rest)) = page.split_once(&heading) else { return vec![heading] };
    let section = rest.split("\n### ").next().unwrap_or_default();
    let targets = entry.figure.targets.iter();
    let lines = targets.map(|target| {
        let thesis = target.thesis.map_or("-".to_owned(), |value| value.to_string());
        (
            format!("| {} | {thesis} |", target.name.replace('|', "\\|")),
            format!("| {} |", target.band),
        )
    });
    let is_there = |(start, band): &(String, String)| {
        section.lines().any(|line| line.starts_with(start.as_str()) && line.contains(band.as_str()))
    };
    lines
        .filter(|line| !is_there(line))
        .map(|(start, band)| format!("{start} ... {band}"))
        .collect()
}

#[test]
fn what_is_missing_is_found() {
    let thesis = repository().join("scenarios/thesis");
    let registry = Arc::new(landform::registry());
    let path = Path::new("fig_4_8.targets.ron");
    let entry = Entry::read(&thesis.join(path), &thesis, None, &registry, Limits::default());
    let entry = entry.expect("a target file");
    assert_eq!(missing("", &entry).len(), 1);
    let heading = format!("\n### {}: {}\n\n`fig_4_8`\n", entry.figure.id, entry.figure.title);
    assert_eq!(missing(&heading, &entry).len(), entry.figure.targets.len());
}
