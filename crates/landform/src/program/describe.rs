//! `landform describe`: everything about one name.

use landform_sim::code::Code;
use landform_sim::parameters::ParameterDescription;
use landform_sim::registry::{Kind, Registry};
use landform_sim::text::nearest;

use super::{Failure, Outcome, talk};

/// Prints a name's kind, description and parameters, or its JSON schema.
pub(super) fn describe(name: &str, json: bool, registry: &Registry) -> Outcome {
    let found = page("process", name, json, &registry.processes)
        .or_else(|| page("initial condition", name, json, &registry.initial))
        .or_else(|| page("domain", name, json, &registry.domains))
        .or_else(|| page("metric", name, json, &registry.metrics))
        .or_else(|| page("output", name, json, &registry.outputs));
    match found {
        Some(text) => talk::say(&text),
        None => Err(Failure::refused(Code::UnknownSubject, unknown(name, registry))),
    }
}

fn unknown(name: &str, registry: &Registry) -> String {
    let mut names = registry.processes.names();
    names.extend(registry.initial.names());
    names.extend(registry.domains.names());
    names.extend(registry.metrics.names());
    names.extend(registry.outputs.names());
    match nearest(name, names.iter().copied()) {
        Some(guess) => format!("nothing is called `{name}`; did you mean {guess:?}?"),
        None => format!("nothing is called `{name}`; `landform list` shows what there is"),
    }
}

fn page<T: ?Sized>(kind: &str, name: &str, json: bool, entries: &Kind<T>) -> Option<String> {
    let entry = entries.get(name)?;
    if json {
        return Some(serde_json::to_string_pretty(&entry.schema()).unwrap_or_default() + "\n");
    }
    let mut text = format!("{name} ({kind})\n\n{}\n", entry.description());
    let parameters = entry.parameters();
    if !parameters.is_empty() {
        text += "\nParameters\n";
    }
    for parameter in &parameters {
        text += &paragraph(parameter);
    }
    Some(text)
}

fn paragraph(parameter: &ParameterDescription) -> String {
    let mut facts = vec![parameter.kind.clone()];
    if !parameter.unit.is_empty() {
        facts.push(format!("in {}", parameter.unit));
    }
    facts.extend(Some(parameter.range.clone()).filter(|range| !range.is_empty()));
    facts.push(match parameter.default.as_str() {
        "" => "required".to_owned(),
        default => format!("default {default}"),
    });
    let mut text =
        format!("  {}: {}\n      {}\n", parameter.name, facts.join(", "), parameter.description);
    if !parameter.source.is_empty() {
        text += &format!("      source: {}\n", parameter.source);
    }
    text
}
