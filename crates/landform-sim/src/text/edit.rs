//! Edits of a scenario from the command line: `--set path=value`.

use ron::value::RawValue;

use crate::code::Code;

use super::diagnostic::Diagnostic;
use super::nearest::{nearest, one_of};
use super::path::{Miss, inside, names, parts, step};
use super::ron_error::message_of;
use super::source::{Source, Span};
use super::tree::{Kind, Node, Tree};

/// The source with the value that `path` names (see [`super::locate`]) replaced by `value`.
///
/// A field that is absent is added to the struct that would hold it, so that the reader of
/// the scenario takes it or refuses its name. A value that replaces a string needs no quotes,
/// nor does one that is not RON (`--set domain.path=../x.asc`); `None` and `Some(...)` are
/// never quoted. Edits compose: call this again with the result.
///
/// # Errors
/// The parent of the value does not exist, or the path names several values, or the value is
/// broken RON. The message names what is there; its place is the parent in `source`.
pub fn set(source: &Source, path: &str, value: &str) -> Result<Source, Diagnostic> {
    let edit = Edit { source, path, value: value.trim() };
    edit.made().map_err(|diagnostic| Diagnostic {
        message: format!("--set {path}={value}: {}", diagnostic.message),
        ..diagnostic
    })
}

/// One `--set` with the text that it changes.
struct Edit<'s> {
    source: &'s Source,
    path: &'s str,
    value: &'s str,
}

impl Edit<'_> {
    /// Walks to the parent of the value, then replaces the value or adds it.
    fn made(&self) -> Result<Source, Diagnostic> {
        let tree = Tree::parse(self.source.text());
        let parts: Vec<&str> = parts(self.path).collect();
        let (Some(&last), Some(root)) = (parts.last(), &tree.root) else {
            return Err(Diagnostic::new(Code::Edit, "there is nothing to set")
                .expected("path=value, such as stages[0].processes.Dunes.slab_m=5.0"));
        };
        let mut parent = root;
        let mut walked = String::new();
        for part in &parts[..parts.len() - 1] {
            let entry = step(parent, part).map_err(|miss| refusal(parent, &walked, part, miss))?;
            parent = &entry.value;
            walked = [walked.as_str(), part].join(if walked.is_empty() { "" } else { "." });
        }
        match step(parent, last) {
            Ok(entry) => self.replaced(&entry.value),
            Err(Miss::Absent) => match Slot::of(inside(parent), last) {
                Some(slot) => self.inserted(&slot),
                None => Err(refusal(parent, &walked, last, Miss::Absent)),
            },
            Err(miss) => Err(refusal(parent, &walked, last, miss)),
        }
    }

    /// The source with another value in place of `old`.
    fn replaced(&self, old: &Node) -> Result<Source, Diagnostic> {
        let value = written(self.value, old.kind == Kind::Text)
            .map_err(|diagnostic| diagnostic.at(old.span))?;
        Ok(self.source.replaced(old.span, self.argument(), &[(&value, self.value_span())]))
    }

    /// The source with the value as a new field.
    fn inserted(&self, slot: &Slot) -> Result<Source, Diagnostic> {
        let place = Span::new(slot.at, slot.at);
        let value = written(self.value, false).map_err(|diagnostic| diagnostic.at(place))?;
        let path = Span::new(0, self.path.len());
        let parts =
            [(slot.before.as_str(), path), (value.as_str(), self.value_span()), (slot.after, path)];
        Ok(self.source.replaced(place, self.argument(), &parts))
    }

    /// The edit as it stands on the command line.
    fn argument(&self) -> String {
        format!("{}={}", self.path, self.value)
    }

    /// The value in [`Edit::argument`].
    fn value_span(&self) -> Span {
        let start = self.path.len() + 1;
        Span::new(start, start + self.value.len())
    }
}

/// Where a new field goes, and what has to be written around its value.
struct Slot {
    at: usize,
    before: String,
    after: &'static str,
}

impl Slot {
    /// The place for `key` in a struct, a map, empty parentheses or a name without any.
    fn of(parent: &Node, key: &str) -> Option<Self> {
        let field = is_field_name(key);
        let key = match parent.kind {
            Kind::Struct if field => key.to_owned(),
            Kind::Tuple if field && parent.entries.is_empty() => key.to_owned(),
            Kind::Unit if field && !is_none(parent) => {
                return Some(Self { at: parent.span.end, before: format!("({key}: "), after: ")" });
            }
            Kind::Map => map_key(parent, key),
            _ => return None,
        };
        let (at, comma) = match parent.entries.last() {
            Some(last) => (last.value.span.end, ", "),
            None => (parent.open?.end, ""),
        };
        Some(Self { at, before: format!("{comma}{key}: "), after: "" })
    }
}

/// Whether the value is the option `None`, which can hold no field.
fn is_none(node: &Node) -> bool {
    node.name.as_ref().is_some_and(|name| name.name == "None")
}

/// Whether a part of a path can be a field of a struct as it stands.
fn is_field_name(part: &str) -> bool {
    part.starts_with(|first: char| first == '_' || first.is_alphabetic())
        && part.chars().all(|letter| letter == '_' || letter.is_alphanumeric())
}

/// A new key of a map, in quotes unless the others have none.
fn map_key(map: &Node, key: &str) -> String {
    let bare = map
        .entries
        .first()
        .and_then(|entry| entry.key.as_ref())
        .is_some_and(|first| first.name.len() == first.span.len());
    if bare { key.to_owned() } else { quoted(key) }
}

/// The value as RON: quoted where it replaces a string or is not RON. Text that begins like a
/// string or a bracket and does not end like one is refused instead.
fn written(value: &str, replaces_string: bool) -> Result<String, Diagnostic> {
    let error = RawValue::from_ron(value).err();
    let is_string = Tree::parse(value).root.is_some_and(|root| root.kind == Kind::Text);
    let is_option = value == "None" || value.starts_with("Some(");
    match error {
        None if is_string || is_option || !replaces_string => Ok(value.to_owned()),
        _ if value.is_empty() && !replaces_string => {
            Err(Diagnostic::new(Code::Edit, "there is no value after the equals sign")
                .expected("a value"))
        }
        Some(error) if value.starts_with('"') || (is_bracketed(value) && !replaces_string) => {
            Err(Diagnostic::new(
                Code::Edit,
                format!("the value is not RON: {}", message_of(&error.code)),
            )
            .expected("one value, such as 5.0, \"text\", (40, 50) or Dunes(slab_m: 5.0)"))
        }
        _ => Ok(quoted(value)),
    }
}

/// Whether the text begins like a struct, list or map, so that a slip in it should be reported
/// rather than turned into a string.
fn is_bracketed(value: &str) -> bool {
    value.starts_with(['(', '[', '{'])
}

/// The text as a RON string.
fn quoted(text: &str) -> String {
    let mut literal = String::from('"');
    for letter in text.chars() {
        match letter {
            '"' | '\\' => literal.extend(['\\', letter]),
            letter if letter.is_control() => literal.extend(letter.escape_unicode()),
            letter => literal.push(letter),
        }
    }
    literal.push('"');
    literal
}

/// Why `part` cannot be followed from `parent`, which the path calls `walked`.
fn refusal(parent: &Node, walked: &str, part: &str, miss: Miss) -> Diagnostic {
    let place = if walked.is_empty() { "the scenario" } else { walked };
    let inner = inside(parent);
    if let Miss::Several(count) = miss {
        return Diagnostic::new(Code::Edit, format!("{place} has {count} elements named {part:?}"))
            .at(parent.span)
            .help(format!("name one by its number, such as {walked}[0], counted from zero"));
    }
    let names = names(parent);
    let expected = match (inner.kind, inner.entries.len()) {
        (Kind::List | Kind::Tuple, 0) => "an element, but there is none".to_owned(),
        (Kind::List | Kind::Tuple, count) => {
            let named = if names.is_empty() {
                String::new()
            } else {
                format!(", or {}", one_of(names.iter().copied()))
            };
            format!("a number from 0 to {}{named}", count - 1)
        }
        (Kind::Struct | Kind::Map, _) => one_of(names.iter().copied()),
        _ => format!("nothing after {walked:?}, which is a single value"),
    };
    Diagnostic::new(Code::Edit, format!("{place} has no {part:?}"))
        .at(parent.span)
        .expected(expected)
        .did_you_mean(nearest(part, names))
}

#[cfg(test)]
mod tests {
    use super::super::source::Place;
    use super::*;

    const TEXT: &str = "(domain: (path: \"a.asc\", size: (40, 50)), // size\n \
        stages: [(processes: [Lift, Dunes(slab_m: 5.0,), Noise()])], table: {\"a\": 1}, end: None)";

    fn edited(path: &str, value: &str) -> Result<String, Diagnostic> {
        set(&Source::new("x.ron", TEXT), path, value).map(|source| source.text().to_owned())
    }

    #[test]
    fn values_are_replaced_and_added() {
        for (path, value, old, new) in [
            ("domain.size[1]", " 60 ", "50)", "60)"),
            ("domain.path", "../x.asc", "a.asc", "../x.asc"),
            ("domain.path", "5", "a.asc", "5"),
            ("domain.path", "(b \"c\\", "a.asc", "(b \\\"c\\\\"),
            ("domain.path", "\"d\"", "a.asc", "d"),
            ("domain.path", "", "a.asc", ""),
            ("domain.path", "None", "\"a.asc\"", "None"),
            ("domain.size", "a b", "(40, 50)", "\"a b\""),
            ("stages.0.processes.Dunes.slab_m", "1e-3", "5.0", "1e-3"),
            ("stages[0].processes[1]", "Lift", "Dunes(slab_m: 5.0,)", "Lift"),
            ("stages[0].processes.Dunes.slope_deg", "3", "5.0,", "5.0, slope_deg: 3,"),
            ("stages[0].processes.Lift.rate", "3", "Lift", "Lift(rate: 3)"),
            ("stages[0].processes.Noise.seed", "3", "Noise()", "Noise(seed: 3)"),
            ("table.b", "2", "1}", "1, \"b\": 2}"),
            ("end", "Some(3)", "None", "Some(3)"),
            ("title", "../x", "end: None)", "end: None, title: \"../x\")"),
        ] {
            let expected = TEXT.replace(old, new);
            assert_eq!(edited(path, value), Ok(expected), "{path}={value}");
        }
    }

    #[test]
    fn what_cannot_be_set_is_refused_with_what_is_there() {
        for (path, value, message, expected, help) in [
            (
                "domian.size",
                "1",
                "the scenario has no \"domian\"",
                "one of domain, stages, table, end",
                "did you mean \"domain\"?",
            ),
            ("stages[1].x", "1", "stages has no \"1\"", "a number from 0 to 0", ""),
            (
                "stages.0.processes.Dnes.k",
                "1",
                "stages.0.processes has no \"Dnes\"",
                "a number from 0 to 2, or one of Lift, Dunes, Noise",
                "did you mean \"Dunes\"?",
            ),
            ("domain.size[2]", "1", "domain.size has no \"2\"", "a number from 0 to 1", ""),
            (
                "domain.path.x",
                "1",
                "domain.path has no \"x\"",
                "nothing after \"domain.path\", which is a single value",
                "",
            ),
            (
                "end.x",
                "1",
                "end has no \"x\"",
                "nothing after \"end\", which is a single value",
                "",
            ),
            ("domain.3", "1", "domain has no \"3\"", "one of path, size", ""),
            ("domain.size", "(3,", "the value is not RON", "one value, such as", ""),
            ("domain.path", "\"x", "the value is not RON", "one value, such as", ""),
            ("domain.size", "", "there is no value after the equals sign", "a value", ""),
            ("", "1", "there is nothing to set", "path=value", ""),
        ] {
            let refused = edited(path, value).unwrap_err();
            let start = format!("--set {path}={value}: {message}");
            assert!(refused.message.starts_with(&start), "{refused}");
            assert!(refused.expected.unwrap().starts_with(expected), "{path}");
            assert_eq!(refused.help.unwrap_or_default(), help, "{path}");
        }
    }

    #[test]
    fn a_name_of_several_elements_is_refused() {
        let source = Source::new("x.ron", "(p: [A(k: 1), A(k: 2)])");
        let refused = set(&source, "p.A.k", "3").unwrap_err();
        assert_eq!(refused.message, "--set p.A.k=3: p has 2 elements named \"A\"");
        assert_eq!(
            refused.help.as_deref(),
            Some("name one by its number, such as p[0], counted from zero")
        );
        let edited = set(&source, "p[1].k", "3").unwrap();
        assert_eq!(edited.text(), "(p: [A(k: 1), A(k: 3)])");
    }

    #[test]
    fn messages_about_set_values_show_the_argument() {
        let source = Source::new("x.ron", "(a: 1,\n b: 2)");
        let once = set(&source, "a", "(k: 12345)").unwrap();
        let twice = set(&once, "a.k", "77").unwrap();
        let thrice = set(&twice, "c", "x/y").unwrap();
        assert_eq!(thrice.text(), "(a: (k: 77),\n b: 2, c: \"x/y\")");
        let shown = |part: &str| {
            let start = thrice.text().find(part).unwrap();
            Diagnostic::new(Code::Edit, "m")
                .at(Span::new(start, start + part.len()))
                .render(&thrice)
        };
        assert_eq!(shown("77"), "error[L0106]: m\n --> --set a.k=77\n |\n | a.k=77\n |     ^^\n");
        assert_eq!(
            shown("k:"),
            "error[L0106]: m\n --> --set a=(k: 12345)\n |\n | a=(k: 12345)\n |    ^^\n"
        );
        assert_eq!(shown("\"x/y\""), "error[L0106]: m\n --> --set c=x/y\n |\n | c=x/y\n |   ^^^\n");
        assert_eq!(shown("c"), "error[L0106]: m\n --> --set c=x/y\n |\n | c=x/y\n | ^\n");
        assert_eq!(shown("b: 2"), "error[L0106]: m\n --> x.ron:2:2\n  |\n2 |  b: 2)\n  |  ^^^^\n");
        let end = thrice.text().len() - 1;
        let place = thrice.place(Span::new(end, end));
        assert!(matches!(place, Place::File { span, .. } if span.start == 12), "{place:?}");
    }
}
