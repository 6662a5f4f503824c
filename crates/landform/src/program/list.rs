//! `landform list`: what scenarios may name.

use landform_sim::registry::{Kind, Registry};

use super::arguments::KindName;
use super::{Outcome, talk};

/// Prints the names of one kind or of all, with the first sentence of each.
pub(super) fn list(kind: Option<KindName>, registry: &Registry) -> Outcome {
    let shows = |name| kind.is_none_or(|kind| kind == name);
    let mut text = String::new();
    if shows(KindName::Domains) {
        text += &section("domains", &registry.domains);
    }
    if shows(KindName::Initial) {
        text += &section("initial conditions", &registry.initial);
    }
    if shows(KindName::Processes) {
        text += &section("processes", &registry.processes);
    }
    if shows(KindName::Metrics) {
        text += &section("metrics", &registry.metrics);
    }
    if shows(KindName::Outputs) {
        text += &section("outputs", &registry.outputs);
    }
    talk::say(&text)
}

fn section<T: ?Sized>(title: &str, kind: &Kind<T>) -> String {
    let width = kind.names().iter().map(|name| name.len()).max().unwrap_or(0);
    let mut text = format!("{title}\n");
    for entry in kind.iter() {
        let description = entry.description().replace('\n', " ");
        let first = description.split_inclusive(". ").next().unwrap_or_default().trim_end();
        text += &format!("  {:width$}  {first}\n", entry.name);
    }
    text
}
