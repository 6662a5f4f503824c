//! `landform explain`: what the number of a message means.

use landform_sim::code::Code;

use super::{Failure, Outcome, talk};
use crate::explain::{page, title};

/// Prints the page of a code, or all codes with their titles.
pub(super) fn explain(name: Option<&str>) -> Outcome {
    match name {
        None => talk::say(&Code::ALL.map(line).concat()),
        Some(name) => match Code::named(name) {
            Some(code) => talk::say(&plain(page(code))),
            None => Err(Failure::refused(Code::UnknownSubject, unknown(name))),
        },
    }
}

/// The page for a terminal: blocks are set in, and their fences go.
fn plain(page: &str) -> String {
    let mut inside = false;
    let mut text = String::new();
    for line in page.lines() {
        if line.starts_with("```") {
            inside = !inside;
        } else {
            text += if inside { "    " } else { "" };
            text += line.strip_prefix("# ").unwrap_or(line);
            text.push('\n');
        }
    }
    text
}

fn line(code: Code) -> String {
    format!("{code}  {}\n", title(code))
}

/// The refusal of a code that there is not, with those of its group.
fn unknown(name: &str) -> String {
    let number = name.trim_start_matches(['L', 'l']).parse::<u16>().ok();
    let group = number.map(|number| number / 100);
    let near = Code::ALL.iter().filter(|code| Some(code.number() / 100) == group);
    let near: Vec<String> = near.map(Code::to_string).collect();
    match near.is_empty() {
        true => format!("no message has the code `{name}`; `landform explain` lists all"),
        false => format!(
            "no message has the code `{name}`; near it are {}; `landform explain` lists all",
            near.join(", ")
        ),
    }
}
