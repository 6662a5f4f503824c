//! A message that points at the text it is about.

use std::fmt;

use serde::Serialize;

use crate::code::Code;

use super::source::{Place, Position, Source, Span};

/// Most characters of a line that a message shows.
const WIDEST_LINE: usize = 100;
/// Characters kept before the first caret when a longer line is cut.
const LEAD: usize = 30;
/// Longest message, in characters; what is written in a file can be of any length.
const LONGEST_PART: usize = 2000;

/// Why a scenario is refused: what is wrong, where, what was expected and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Its number.
    pub code: Code,
    /// What is wrong, in a phrase without a full stop.
    pub message: String,
    /// Where, in bytes of [`Source::text`].
    pub span: Option<Span>,
    /// What would have been right: a type, a range, a list of names.
    pub expected: Option<String>,
    /// What to do.
    pub help: Option<String>,
}

/// A message for other programs: editors, say.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Located {
    /// Number of the message.
    pub code: Code,
    /// Name of the file.
    pub file: String,
    /// Line and column where it begins, both from one; none where the place is not in the file.
    pub start: Option<[usize; 2]>,
    /// Line and column of the first character after it.
    pub end: Option<[usize; 2]>,
    /// What is wrong.
    pub message: String,
    /// What would have been right.
    pub expected: Option<String>,
    /// What to do.
    pub help: Option<String>,
}

impl Diagnostic {
    /// The message with its place in lines and columns.
    pub fn located(&self, source: &Source) -> Located {
        let ends = match self.span.map(|span| source.place(span)) {
            Some(Place::File { text, span }) => Some([span.start, span.end].map(|offset| {
                let Position { line, column } = Position::of(text, offset);
                [line, column]
            })),
            _ => None,
        };
        Located {
            code: self.code,
            file: source.name().to_owned(),
            start: ends.map(|[start, _]| start),
            end: ends.map(|[_, end]| end),
            message: self.message.clone(),
            expected: self.expected.clone(),
            help: self.help.clone(),
        }
    }

    /// A message without a position.
    pub fn new(code: Code, message: impl Into<String>) -> Self {
        Self { code, message: message.into(), span: None, expected: None, help: None }
    }

    /// The message at a place in the text.
    pub fn at(self, span: Span) -> Self {
        Self { span: Some(span), ..self }
    }

    /// The message with what would have been right.
    pub fn expected(self, expected: impl Into<String>) -> Self {
        Self { expected: Some(expected.into()), ..self }
    }

    /// The message with what to do.
    pub fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// The message with `did you mean "..."?` where a near name was found.
    pub fn did_you_mean(self, name: Option<&str>) -> Self {
        match name {
            Some(name) => self.help(format!("did you mean {name:?}?")),
            None => self,
        }
    }

    /// The message as plain text, with the line it is about and carets below it. Lines end
    /// with a line feed. Control characters are shown as `?`, so no file can play tricks on
    /// a terminal.
    pub fn render(&self, source: &Source) -> String {
        let mut text = format!("error[{}]: {}\n", self.code, printable(&self.message));
        match self.span.map(|span| source.place(span)) {
            None => text.push_str(&format!(" --> {}\n", printable(source.name()))),
            Some(Place::File { text: file, span }) => {
                let Position { line, column } = Position::of(file, span.start);
                let name = printable(source.name());
                text.push_str(&format!(" --> {name}:{line}:{column}\n"));
                text.push_str(&excerpt(file, span, &line.to_string()));
            }
            Some(Place::Argument { text: argument, span }) => {
                text.push_str(&format!(" --> --set {}\n", cut(argument)));
                text.push_str(&excerpt(argument, span, ""));
            }
        }
        for (label, part) in [("expected", &self.expected), ("help", &self.help)] {
            if let Some(part) = part {
                text.push_str(&format!("  {label}: {}\n", printable(part)));
            }
        }
        text
    }
}

impl fmt::Display for Diagnostic {
    /// The message on one line, without the text it is about.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&printable(&self.message))?;
        for (label, part) in [("expected", &self.expected), ("help", &self.help)] {
            if let Some(part) = part {
                write!(formatter, "; {label}: {}", printable(part))?;
            }
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostic {}

/// Several messages in the order of their places in the text, those without a place first,
/// with an empty line between them.
pub fn render_all(diagnostics: &[Diagnostic], source: &Source) -> String {
    let mut ordered: Vec<&Diagnostic> = diagnostics.iter().collect();
    ordered.sort_by_key(|diagnostic| diagnostic.span.map(|span| span.start));
    let texts: Vec<String> = ordered.iter().map(|diagnostic| diagnostic.render(source)).collect();
    texts.join("\n")
}

/// The line where `span` starts, with its number in the margin and carets below the part of
/// the span that lies on it.
fn excerpt(text: &str, span: Span, number: &str) -> String {
    let start = text.floor_char_boundary(span.start);
    let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
    let rest = &text[line_start..];
    let line = &rest[..rest.find('\n').unwrap_or(rest.len())];
    let line = line.strip_suffix('\r').unwrap_or(line);
    let start = (start - line_start).min(line.len());
    let end =
        text.floor_char_boundary(span.end).saturating_sub(line_start).clamp(start, line.len());
    let before = line[..start].chars().count();
    let marked = line[start..end].chars().count();
    let (shown, before, carets) = window(line, before, marked);
    let margin = " ".repeat(number.len());
    format!(
        "{margin} |\n{number} | {shown}\n{margin} | {}{}\n",
        " ".repeat(before),
        "^".repeat(carets)
    )
}

/// The part of a long line that a message shows, the characters before the first caret in it,
/// and the number of carets (at least one).
fn window(line: &str, before: usize, marked: usize) -> (String, usize, usize) {
    let length = line.chars().count();
    let fits = length <= WIDEST_LINE;
    let skipped = if fits { 0 } else { before.saturating_sub(LEAD).min(length - WIDEST_LINE) };
    let middle: String = line.chars().skip(skipped).take(WIDEST_LINE).collect();
    let lead = if skipped > 0 { "..." } else { "" };
    let tail = if skipped + WIDEST_LINE < length { "..." } else { "" };
    let carets = marked.min((WIDEST_LINE + skipped).saturating_sub(before)).max(1);
    (format!("{lead}{}{tail}", printable(&middle)), before - skipped + lead.len(), carets)
}

/// An argument of the command line, shortened to what a message shows.
fn cut(argument: &str) -> String {
    window(argument, 0, 1).0
}

/// The text with its control characters replaced, one for one (a tab becomes a space), and an
/// absurdly long one cut.
fn printable(text: &str) -> String {
    let shown = text.chars().take(LONGEST_PART).map(|letter| match letter {
        '\t' | '\n' => ' ',
        letter if letter.is_control() || is_direction_mark(letter) => '?',
        letter => letter,
    });
    let mut shown: String = shown.collect();
    if text.chars().nth(LONGEST_PART).is_some() {
        shown.push_str("...");
    }
    shown
}

/// Whether the character changes the direction in which its neighbours are shown.
fn is_direction_mark(letter: char) -> bool {
    matches!(letter, '\u{200E}' | '\u{200F}' | '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(text: &str) -> Source {
        Source::new("scenarios/x.ron", text)
    }

    #[test]
    fn a_message_shows_its_line_and_points_at_it() {
        let source =
            source("(\n  stages: [(\n    processes: [\n\t\tDnes(slab_m: 5.0),\r\n    ])]\n)");
        let start = source.text().find("Dnes").unwrap();
        let diagnostic = Diagnostic::new(Code::UnknownName, "unknown process \"Dnes\"")
            .at(Span::new(start, start + 4))
            .expected("one of Dunes, Sandpile")
            .did_you_mean(Some("Dunes"));
        let expected = r#"error[L0102]: unknown process "Dnes"
 --> scenarios/x.ron:4:3
  |
4 |   Dnes(slab_m: 5.0),
  |   ^^^^
  expected: one of Dunes, Sandpile
  help: did you mean "Dunes"?
"#;
        assert_eq!(diagnostic.render(&source), expected);
        let line = "unknown process \"Dnes\"; expected: one of Dunes, Sandpile; \
                    help: did you mean \"Dunes\"?";
        assert_eq!(diagnostic.to_string(), line);
    }

    #[test]
    fn a_message_without_a_place_names_the_file() {
        let text = Diagnostic::new(Code::Notation, "empty").render(&source(""));
        assert_eq!(text, "error[L0101]: empty\n --> scenarios/x.ron\n");
    }

    #[test]
    fn places_at_the_end_and_beyond_are_shown() {
        for (text, span, line, carets) in [
            ("ab", Span::new(2, 2), "1 | ab", "  |   ^"),
            ("ab\n", Span::new(3, 3), "2 | ", "  | ^"),
            ("ab", Span::new(70, 90), "1 | ab", "  |   ^"),
            ("a\nb", Span::new(0, 3), "1 | a", "  | ^"),
            ("äöü", Span::new(1, 3), "1 | äöü", "  | ^"),
            ("", Span::new(0, 0), "1 | ", "  | ^"),
        ] {
            let shown = Diagnostic::new(Code::Notation, "m").at(span).render(&source(text));
            let lines: Vec<&str> = shown.lines().collect();
            assert_eq!((lines[3], lines[4]), (line, carets), "{text:?} {span:?}");
        }
    }

    #[test]
    fn long_lines_are_cut_around_the_span() {
        let text = format!("{}BAD{}", "x".repeat(100_000), "y".repeat(100_000));
        let shown = Diagnostic::new(Code::Notation, "m")
            .at(Span::new(100_000, 100_003))
            .render(&source(&text));
        let lines: Vec<&str> = shown.lines().collect();
        assert!(lines[1].ends_with(":1:100001"), "{}", lines[1]);
        let at = lines[3].find("BAD").unwrap();
        assert_eq!(lines[4].find('^'), Some(at));
        assert_eq!(lines[4].trim_end().len(), at + 3);
        assert!(lines[3].len() < 120 && lines[3].ends_with("y..."), "{}", lines[3]);
        let whole = Diagnostic::new(Code::Notation, "m")
            .at(Span::new(0, text.len()))
            .render(&source(&text));
        assert!(whole.lines().all(|line| line.len() < 120), "{whole}");
    }

    #[test]
    fn several_messages_come_in_the_order_of_the_text() {
        let at = |start| {
            Diagnostic::new(Code::Notation, format!("at {start}")).at(Span::new(start, start + 1))
        };
        let all = [at(2), Diagnostic::new(Code::Notation, "none"), at(0)];
        let shown = render_all(&all, &source("abc"));
        let messages: Vec<&str> = shown.lines().filter(|line| line.starts_with("error")).collect();
        assert_eq!(messages, ["error[L0101]: none", "error[L0101]: at 0", "error[L0101]: at 2"]);
        assert!(shown.contains("\n\nerror[L0101]: at 0"), "{shown}");
    }

    #[test]
    fn control_characters_do_not_reach_the_terminal() {
        let shown = Diagnostic::new(Code::Notation, "m\u{1b}[2J")
            .at(Span::new(3, 4))
            .render(&source("\u{1b}\0\u{202E}z"));
        assert!(!shown.contains(['\u{1b}', '\0', '\u{202E}']), "{shown:?}");
        assert!(shown.contains("1 | ???z"), "{shown:?}");
    }
}
