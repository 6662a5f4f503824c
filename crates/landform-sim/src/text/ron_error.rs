//! What `ron` refuses, as messages with a place.
//!
//! Errors inside the parameters of a registered type reach `ron` as text (they pass through an
//! erased reader), others as values of an enum. Both read the same, so the text is what is
//! looked at; a test holds every form that is used here to the words of `ron`.

use ron::error::{Error, SpannedError};

use crate::code::Code;

use super::diagnostic::Diagnostic;
use super::lexer::{Symbol, Token, Tokens};
use super::nearest::{nearest, one_of};
use super::source::{Position, Source, Span};
use super::tree::{Entry, Kind, Node, Tree};

/// Values that were expected, in ron's words and ours.
const VALUES: [(&str, &str); 14] = [
    ("expected float", "a number"),
    ("expected integer", "a whole number"),
    ("expected boolean", "true or false"),
    ("expected string", "a string in double quotes"),
    ("expected char", "a character in single quotes"),
    ("expected byte string", "a byte string"),
    ("expected option", "None or Some(...)"),
    ("expected unit", "()"),
    ("expected opening `[`", "a list in square brackets"),
    ("expected opening `{`", "a map in curly brackets"),
    ("expected opening `(`", "values in parentheses"),
    ("expected identifier", "a name"),
    ("unexpected leading underscore in a number", "a number"),
    ("integer is out of bounds", "a whole number that fits the range (not negative, if it counts)"),
];

/// Marks between values that were expected, in ron's words and ours.
const MARKS: [(&str, &str); 8] = [
    ("expected comma", "a comma or the closing bracket"),
    ("expected colon", "a colon after the name of a field"),
    ("expected closing `]`", "`]`"),
    ("expected closing `)`", "`)`"),
    ("expected closing `}`", "`}`"),
    ("expected end of string", "a closing quote"),
    ("unclosed block comment", "the end of the comment, `*/`"),
    ("unexpected end of RON", "more text"),
];

/// The message for an error of `ron` about [`Source::text`], with a place.
///
/// Unknown names come with the nearest one; a missing field names its struct and points at
/// it; a wrong value is shown with what was expected; a bracket, string or comment without an
/// end is pointed at where it begins. The error of a reader of its own (`Error::custom`) that
/// was written by [`Diagnostic`]'s `Display` gets its parts back.
pub fn ron_diagnostic(source: &Source, error: &SpannedError) -> Diagnostic {
    let text = source.text();
    let byte = |at: ron::error::Position| Position { line: at.line, column: at.col }.offset(text);
    let (start, at) = (byte(error.span.start), byte(error.span.end));
    let refused = Refused {
        tree: Tree::parse(text),
        words: message_of(&error.code),
        span: Span::new(start.min(at), at),
    };
    refused.diagnostic()
}

/// The words for an error without a place, from ron or from whoever reads with it. Those of
/// ron begin with a small letter here.
pub(super) fn message_of(code: &Error) -> String {
    let words = code.to_string();
    let mut letters = words.chars();
    let first = letters.next().into_iter().flat_map(char::to_lowercase);
    first.chain(letters).collect()
}

#[cfg(test)]
mod tests;

/// An error with what is needed to explain it.
struct Refused<'a> {
    tree: Tree<'a>,
    /// The message of ron or of a reader, its first letter small.
    words: String,
    /// From the last token that was read to where reading stopped.
    span: Span,
}

impl Refused<'_> {
    fn diagnostic(&self) -> Diagnostic {
        let words = self.words.as_str();
        let starts = |beginnings: &[&str]| beginnings.iter().any(|start| words.starts_with(start));
        let meant = |table: &[(&str, &'static str)]| {
            table.iter().find(|(theirs, _)| *theirs == words).map(|&(_, ours)| ours)
        };
        if starts(&["unexpected missing field", "missing field"]) {
            self.missing_field()
        } else if starts(&["unexpected field", "unknown field"]) {
            self.unknown_name("field")
        } else if starts(&["unexpected variant", "unexpected enum variant", "unknown variant"]) {
            self.unknown_name("name")
        } else if starts(&["unexpected duplicate field", "duplicate field"]) {
            let field = quoted_names(words).next().unwrap_or_default();
            Diagnostic::new(Code::RepeatedField, format!("the field {field:?} is given twice"))
                .at(self.span)
        } else if let Some(ours) = meant(&MARKS) {
            self.wrong_mark(ours)
        } else if let Some(ours) = meant(&VALUES) {
            self.wrong_value(ours)
        } else {
            self.other()
        }
    }

    /// Errors whose words hold a name or a value, and those that are passed on.
    fn other(&self) -> Diagnostic {
        let words = self.words.as_str();
        let found = words.strip_prefix("expected ").and_then(|rest| rest.split_once(" but found "));
        if let Some((expected, found)) = found {
            return match expected.strip_prefix("struct ") {
                Some(name) if found.starts_with('`') => self.other_struct(name, found),
                _ => self.found_instead(expected, found.strip_suffix(" instead").unwrap_or(found)),
            };
        }
        if let Some(name) = words.strip_prefix("expected opening `(` for struct ") {
            let name = quoted_names(name).next().unwrap_or_default();
            return self.wrong_value(&format!("the fields of {name} in parentheses"));
        }
        let token = self.token().map_or(self.span, |token| token.span);
        match words {
            "non-whitespace trailing characters" => {
                Diagnostic::new(Code::Notation, "there is more text after the end of the scenario")
                    .at(token)
                    .help(
                        "look for a closing bracket too many, or parentheses missing around it all",
                    )
            }
            _ if words.starts_with("exceeded recursion limit") => {
                Diagnostic::new(Code::Notation, "brackets are nested too deep")
                    .at(token)
                    .expected("at most 128 levels")
            }
            _ if words.starts_with("found invalid std identifier") => {
                Diagnostic::new(Code::Notation, "this is not the name of a field")
                    .at(token)
                    .expected("letters, digits and underscores")
            }
            _ => self.in_its_own_words(),
        }
    }

    /// A struct written with another name than its own.
    fn other_struct(&self, expected: &str, found: &str) -> Diagnostic {
        let (expected, found) = (quoted_names(expected).next(), quoted_names(found).next());
        let (expected, found) = (expected.unwrap_or_default(), found.unwrap_or_default());
        Diagnostic::new(Code::UnknownName, format!("unknown name {found:?}"))
            .at(self.span)
            .expected(format!("{expected}, or parentheses without a name"))
            .did_you_mean(nearest(found, [expected]))
    }

    /// A value of the wrong length or of a kind that its reader refused.
    fn found_instead(&self, expected: &str, found: &str) -> Diagnostic {
        let (label, span) = match self.closed_here() {
            Some((entry, node)) => (label_of(entry, node), node.span),
            None => (Some(self.label()), self.place()),
        };
        let label = label.unwrap_or_else(|| "the value".to_owned());
        Diagnostic::new(Code::WrongType, format!("{label}: found {found}"))
            .at(span)
            .expected(expected)
    }

    /// The error as it was written, taken apart again if it was a diagnostic.
    fn in_its_own_words(&self) -> Diagnostic {
        let (rest, help) = cut_off(&self.words, "; help: ");
        let (message, expected) = cut_off(rest, "; expected: ");
        let span = match self.closed_here() {
            Some((_, node)) => node.span,
            None if self.span.is_empty() => self.place(),
            None => self.span,
        };
        // A reader of names writes so; its code does not pass through the text.
        let code = match message.starts_with("unknown ") {
            true => Code::UnknownName,
            false => Code::WrongType,
        };
        Diagnostic { code, message: message.to_owned(), span: Some(span), expected, help }
    }

    /// A field or variant that the type does not have; the names it has are in the error.
    fn unknown_name(&self, what: &str) -> Diagnostic {
        let (head, tail) = self.words.split_once(", ").unwrap_or((&self.words, ""));
        let mut heads = quoted_names(head);
        let found = heads.next().unwrap_or_default();
        let owner = heads.next().or_else(|| self.owner_name());
        let owner = owner.map_or(String::new(), |owner| format!(" in {owner}"));
        let known: Vec<&str> = quoted_names(tail).collect();
        Diagnostic::new(Code::UnknownName, format!("unknown {what} {found:?}{owner}"))
            .at(self.span)
            .did_you_mean(nearest(found, known.iter().copied()))
            .expected(one_of(known))
    }

    /// Name of the struct around the place of the error.
    fn owner_name(&self) -> Option<&str> {
        let place = self.tree.at(self.span.start)?;
        place.name.as_ref().filter(|_| place.open.is_some()).map(|name| name.name)
    }

    /// A field without a default that is not written. The error stands at the end of the struct,
    /// which may be pages further down, so the name of the struct is pointed at instead.
    fn missing_field(&self) -> Diagnostic {
        let mut names = quoted_names(&self.words);
        let field = names.next().unwrap_or_default();
        let owner = self.closed_here();
        let (label, span) = match owner {
            Some((entry, node)) => {
                let key = entry.and_then(|entry| entry.key.as_ref());
                let span = node.name.as_ref().or(key).map(|key| key.span).or(node.open);
                (label_of(entry, node), span)
            }
            None => (None, None),
        };
        let label = label.or(names.next().map(str::to_owned));
        let label = label.unwrap_or_else(|| "the value".to_owned());
        Diagnostic::new(Code::MissingField, format!("{label} lacks the field {field:?}"))
            .at(span.unwrap_or(self.span))
            .expected(format!("{field}: ..."))
            .help(format!("add {field} between the parentheses of {label}"))
    }

    /// The value in brackets whose end is the place of the error, with its entry.
    fn closed_here(&self) -> Option<(Option<&Entry<'_>>, &Node<'_>)> {
        let at = self.span.end;
        let closes = |close: Span| close.start == at || close.end == at;
        self.entries().find(|(_, node)| node.close.is_some_and(closes))
    }

    /// A value of another type than the field's, shown as it is written.
    fn wrong_value(&self, expected: &str) -> Diagnostic {
        let span = self.place();
        let label = self.label();
        let message = match span.of(self.tree.text) {
            "" => format!("{label} is missing"),
            found => format!("{label} cannot be {}", first_letters(found)),
        };
        Diagnostic::new(Code::WrongType, message).at(span).expected(expected)
    }

    /// Something else where a comma, a colon or a closing bracket should be. Most often something
    /// before it has no end; else a number went on after what was read of it (`3.5` as `3`).
    fn wrong_mark(&self, expected: &str) -> Diagnostic {
        let token = self.token();
        let at_end = token.is_none_or(|token| {
            matches!(token.symbol, Symbol::Close(_) | Symbol::UnclosedComment)
                || token.symbol == Symbol::Text { closed: false }
        });
        let is_open = |span: &&Span| span.start <= self.span.end;
        let unclosed = self.tree.unclosed.iter().rfind(is_open).filter(|_| at_end);
        if let Some(&span) = unclosed {
            return self.unclosed(span);
        }
        match token {
            Some(token) if token.span.start < self.span.end && token.symbol == Symbol::Number => {
                self.wrong_value("a whole number")
            }
            Some(token) => {
                let found = first_letters(token.span.of(self.tree.text));
                Diagnostic::new(Code::Notation, format!("unexpected {found}"))
                    .at(token.span)
                    .expected(expected)
            }
            None => Diagnostic::new(Code::Notation, "the text ends too early")
                .at(self.span)
                .expected(expected),
        }
    }

    /// A bracket, string or comment without an end, at the place where it begins.
    fn unclosed(&self, span: Span) -> Diagnostic {
        let opening = span.of(self.tree.text);
        let (what, end) = match opening.chars().next() {
            Some('(') => ("parenthesis", "`)`"),
            Some('[') => ("square bracket", "`]`"),
            Some('{') => ("curly bracket", "`}`"),
            Some('/') => ("comment", "`*/`"),
            _ => ("string", "a closing quote"),
        };
        let position = Position::of(self.tree.text, self.span.end);
        let limit = match self.token() {
            Some(token) if matches!(token.symbol, Symbol::Close(_)) => {
                format!("the `{}` in line {}", token.span.of(self.tree.text), position.line)
            }
            _ => "the end of the text".to_owned(),
        };
        Diagnostic::new(Code::Notation, format!("the {what} that begins here is never closed"))
            .at(span)
            .expected(format!("{end} before {limit}"))
    }

    /// The token at the place of the error, or the first one after it.
    fn token(&self) -> Option<Token> {
        Tokens::new(self.tree.text).find(|token| token.span.end > self.span.end)
    }

    /// The value at the place of the error: the whole of a small one, the start of others.
    fn place(&self) -> Span {
        let at = self.span.end;
        let starts =
            self.entries().map(|(_, node)| node).filter(|node| node.span.start == at).last();
        match starts.or_else(|| self.tree.at(at)) {
            Some(node) if node.span.start == at || node.open.is_none() => node.span,
            _ => self
                .token()
                .filter(|token| token.span.start == at)
                .map_or(self.span, |token| token.span),
        }
    }

    /// What the value at the place of the error belongs to, for the start of a message.
    fn label(&self) -> String {
        let holds =
            |node: &Node| node.span.start <= self.span.end && self.span.end <= node.span.end;
        let key = |entry: &Entry| entry.key.as_ref().map(|key| key.name.to_owned());
        let around = self.entries().filter(|(_, node)| holds(node));
        let named = around.filter_map(|(entry, node)| Some((key(entry?)?, node))).last();
        match named {
            Some((key, node))
                if matches!(node.kind, Kind::List | Kind::Tuple | Kind::Map)
                    && node.span.start != self.span.end =>
            {
                format!("a value in {key}")
            }
            Some((key, _)) => key,
            None => "the value".to_owned(),
        }
    }

    /// Every value with the entry that it belongs to, parents before children.
    fn entries(&self) -> impl Iterator<Item = (Option<&Entry<'_>>, &Node<'_>)> {
        let root = self.tree.root.as_ref();
        let below = root.into_iter().flat_map(Node::walk).flat_map(|node| &node.entries);
        root.map(|root| (None, root))
            .into_iter()
            .chain(below.map(|entry| (Some(entry), &entry.value)))
    }
}

/// What a value is called in a message: its own name or that of its field.
fn label_of(entry: Option<&Entry>, node: &Node) -> Option<String> {
    let key = entry.and_then(|entry| entry.key.as_ref());
    node.name.as_ref().or(key).map(|key| key.name.to_owned())
}

/// The names between backticks.
fn quoted_names(words: &str) -> impl Iterator<Item = &str> {
    words.split('`').skip(1).step_by(2).map(|name| name.strip_prefix("r#").unwrap_or(name))
}

/// The text before the last `mark`, and what follows it.
fn cut_off<'a>(words: &'a str, mark: &str) -> (&'a str, Option<String>) {
    match words.rsplit_once(mark) {
        Some((before, after)) => (before, Some(after.to_owned())),
        None => (words, None),
    }
}

/// The beginning of a piece of RON, for a message.
fn first_letters(text: &str) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}
