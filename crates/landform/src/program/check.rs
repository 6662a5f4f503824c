//! `landform check`: reads scenarios and sweeps, and builds their domains without running them.

use std::path::Path;
use std::sync::Arc;

use landform_sim::code::Code;
use landform_sim::registry::Registry;
use landform_sim::simulation::Limits;
use landform_sim::text::Located;

use super::arguments::CheckArguments;
use super::{Failure, Outcome, memory, refused, run, talk};
use crate::sweep;

/// What is wrong with a file: for people and for programs.
struct Wrong {
    text: String,
    located: Vec<Located>,
}

/// Checks every scenario and reports all that are wrong.
pub(super) fn check(arguments: &CheckArguments, registry: &Arc<Registry>) -> Outcome {
    let memory_bytes = memory::limit(None).map_err(refused(Code::Arguments))?;
    let limits = Limits { memory_bytes };
    let (mut messages, mut located) = (Vec::new(), Vec::new());
    for path in &arguments.scenarios {
        let checked = match path.to_string_lossy().ends_with(sweep::ENDING) {
            true => check_sweep(path, registry, limits),
            false => check_scenario(path, &arguments.set, registry, limits),
        };
        match checked {
            Ok(good) if !arguments.json => talk::say(&format!("{}: {good}\n", path.display()))?,
            Ok(_) => {}
            Err(wrong) => {
                messages.push(wrong.text);
                located.extend(wrong.located);
            }
        }
    }
    if arguments.json {
        let text = serde_json::to_string_pretty(&located).unwrap_or_default();
        talk::say(&(text + "\n"))?;
    }
    match messages.is_empty() {
        true => Ok(()),
        false => Err(Failure::Refused(messages.join("\n"))),
    }
}

fn check_scenario(
    path: &Path,
    edits: &[String],
    registry: &Arc<Registry>,
    limits: Limits,
) -> Result<String, Wrong> {
    let source = run::open(path, edits).map_err(|failure| whole(path, &failure))?;
    let checked = source.diagnose(registry).and_then(|scenario| {
        let checked = scenario.check(source.folder(), limits);
        checked.map_err(|problem| vec![source.diagnostic(&problem)])
    });
    checked.map(|_| "good".to_owned()).map_err(|diagnostics| {
        let located: Vec<Located> = diagnostics.iter().map(|each| source.located(each)).collect();
        let texts = diagnostics.iter().map(|each| source.show(each)).collect::<Vec<_>>();
        Wrong { text: texts.join("\n"), located }
    })
}

/// Checks a sweep with all its runs.
fn check_sweep(path: &Path, registry: &Arc<Registry>, limits: Limits) -> Result<String, Wrong> {
    let prepared = sweep::prepare(path, registry, limits)
        .map_err(refused(Code::UnreadableScenario))
        .map_err(|failure| whole(path, &failure))?;
    Ok(format!("good, {} runs", prepared.plan.runs.len()))
}

/// A message about a file as a whole.
fn whole(path: &Path, failure: &Failure) -> Wrong {
    let text = failure.message().to_owned();
    let parts = text.strip_prefix("error[").and_then(|rest| rest.split_once("]: "));
    let (code, message) = parts.unwrap_or(("", &text));
    let located = Located {
        code: Code::named(code).unwrap_or_default(),
        file: path.display().to_string(),
        message: message.to_owned(),
        ..Located::default()
    };
    Wrong { text, located: vec![located] }
}
