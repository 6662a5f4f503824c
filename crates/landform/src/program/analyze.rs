//! `landform analyze`: measures of rasters and lines.

use serde_json::{Value, json};

use super::arguments::AnalyzeArguments;
use super::{Failure, Outcome, memory, talk};
use crate::analyze::{Settings, analyze};

/// Analyses every file of the arguments; one that is wrong does not stop the others.
pub(super) fn run(arguments: &AnalyzeArguments) -> Outcome {
    let memory_bytes = memory::limit(arguments.memory_limit_gib).map_err(Failure::Refused)?;
    let settings = Settings { rulers: None, spacing_m: arguments.spacing_m, memory_bytes };
    let (mut objects, mut wrong) = (Vec::new(), Vec::new());
    for path in &arguments.files {
        match analyze(path, &settings) {
            Ok(analysis) if arguments.json => objects.push(analysis.json()),
            Ok(analysis) => talk::say(&analysis.table())?,
            Err(error) => {
                let file = path.display().to_string();
                objects.push(json!({ "file": file, "error": error.to_string() }));
                wrong.push(error.to_string());
            }
        }
    }
    if arguments.json {
        print(objects, wrong.is_empty())?;
    }
    match wrong.is_empty() {
        true => Ok(()),
        false => Err(Failure::Refused(wrong.join("\nerror: "))),
    }
}

/// Prints one file's object as it is, and several in an array.
fn print(mut objects: Vec<Value>, good: bool) -> Outcome {
    let value = match objects.len() {
        1 if good => objects.remove(0),
        1 => return Ok(()),
        _ => Value::Array(objects),
    };
    talk::say(&(serde_json::to_string_pretty(&value).unwrap_or_default() + "\n"))
}
