//! A text with a name, and where each of its bytes came from.

use std::ops::Range;

/// A stretch of a text, in bytes from its start; `end` is the first byte after it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Span {
    /// First byte.
    pub start: usize,
    /// First byte after the stretch.
    pub end: usize,
}

impl Span {
    /// The bytes from `start` up to `end`.
    pub fn new(start: usize, end: usize) -> Self {
        Self { start, end }
    }

    /// The part of `text` that the span covers; empty where it does not fit the text.
    pub fn of(self, text: &str) -> &str {
        text.get(self.start..self.end).unwrap_or("")
    }

    /// Number of bytes.
    pub fn len(self) -> usize {
        self.end.saturating_sub(self.start)
    }

    /// Whether the span covers no byte.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }
}

impl From<Range<usize>> for Span {
    fn from(range: Range<usize>) -> Self {
        Self::new(range.start, range.end)
    }
}

/// A line and a column of a text, both counted from one. A column is a character; a tab is
/// one character, and only a line feed ends a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line, from one.
    pub line: usize,
    /// Column in characters, from one.
    pub column: usize,
}

impl Position {
    /// The line and column of the byte `offset` of `text`; past its end, those of its end.
    pub fn of(text: &str, offset: usize) -> Self {
        let before = &text[..text.floor_char_boundary(offset)];
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        let line = 1 + before.bytes().filter(|&byte| byte == b'\n').count();
        Self { line, column: 1 + before[line_start..].chars().count() }
    }

    /// The byte of `text` at this line and column; past the end of a line or of the text, its
    /// end.
    pub fn offset(self, text: &str) -> usize {
        let line_start = match self.line {
            0 | 1 => 0,
            line => text.match_indices('\n').nth(line - 2).map_or(text.len(), |(at, _)| at + 1),
        };
        let rest = &text[line_start..];
        let line = &rest[..rest.find('\n').unwrap_or(rest.len())];
        let column = self.column.saturating_sub(1);
        line_start + line.char_indices().nth(column).map_or(line.len(), |(at, _)| at)
    }
}

/// Where a piece of a [`Source`] came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Origin {
    /// The file, from this byte on.
    File(usize),
    /// A `--set` argument: its number, and the part of it that this piece stands for.
    Argument { number: usize, part: Span },
}

/// A stretch of an edited text with one origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Piece {
    span: Span,
    origin: Origin,
}

impl Piece {
    /// Whether the piece repeats its origin byte by byte, so that a part of it can be found
    /// there. (Quotes and keys that an edit adds make a piece longer than its origin.)
    fn repeats_origin(&self) -> bool {
        match self.origin {
            Origin::File(_) => true,
            Origin::Argument { part, .. } => part.len() == self.span.len(),
        }
    }

    /// The part of the piece that lies in `range`, if any.
    fn within(&self, range: Span) -> Option<Self> {
        let span = Span::new(self.span.start.max(range.start), self.span.end.min(range.end));
        (!span.is_empty()).then(|| Self { span, origin: self.origin_of(span) })
    }

    /// Where the part `span` of this piece came from.
    fn origin_of(&self, span: Span) -> Origin {
        let skipped = span.start - self.span.start;
        match self.origin {
            Origin::File(start) => Origin::File(start + skipped),
            Origin::Argument { number, part } if self.repeats_origin() => {
                let start = part.start + skipped;
                Origin::Argument { number, part: Span::new(start, start + span.len()) }
            }
            whole => whole,
        }
    }

    /// The same piece, `by` bytes further on.
    fn moved(self, by: isize) -> Self {
        let shift = |at: usize| at.saturating_add_signed(by);
        Self { span: Span::new(shift(self.span.start), shift(self.span.end)), ..self }
    }
}

/// What a reader has to look at to see a span of a [`Source`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place<'a> {
    /// A part of the file as it is stored.
    File {
        /// Text of the file, without edits.
        text: &'a str,
        /// The part of it.
        span: Span,
    },
    /// A part of an argument of the command line.
    Argument {
        /// The argument, `path=value`.
        text: &'a str,
        /// The part of it.
        span: Span,
    },
}

/// The text of a scenario with the name of its file.
///
/// After edits by [`super::set`] it still knows which part came from the file and which from
/// an argument, so a message always points at what somebody wrote.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    name: String,
    text: String,
    file: String,
    arguments: Vec<String>,
    pieces: Vec<Piece>,
}

impl Source {
    /// The text of the file `name` (a path as it is to be shown). A byte order mark at the
    /// start is dropped.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        let text: String = text.into();
        let file = text.strip_prefix('\u{FEFF}').map_or(text.clone(), str::to_owned);
        let whole = Piece { span: Span::new(0, file.len()), origin: Origin::File(0) };
        Self {
            name: name.into(),
            text: file.clone(),
            file,
            arguments: Vec::new(),
            pieces: vec![whole],
        }
    }

    /// Name of the file, as shown in messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The text to read, with every edit made so far.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// What a reader has to look at to see `span` of [`Source::text`]. A span that starts in
    /// one origin and ends in another is cut where the first ends, except that a part of the
    /// file may have edits inside.
    pub fn place(&self, span: Span) -> Place<'_> {
        let clipped = Span::new(span.start, span.end.max(span.start));
        let first = self.piece_at(clipped.start);
        match first.origin {
            Origin::File(start) => {
                let start = start + (clipped.start - first.span.start);
                let end = self.file_end(&first, clipped, start);
                Place::File { text: &self.file, span: Span::new(start, end) }
            }
            Origin::Argument { number, part } => {
                let span = match first.repeats_origin() {
                    true => {
                        let start = part.start + (clipped.start - first.span.start);
                        Span::new(start, (start + clipped.len()).min(part.end))
                    }
                    false => part,
                };
                Place::Argument { text: &self.arguments[number], span }
            }
        }
    }

    /// The byte of the file where `span`, which starts in `first` at the byte `start` of the
    /// file, is to end.
    fn file_end(&self, first: &Piece, span: Span, start: usize) -> usize {
        let last = self.piece_at(span.end.saturating_sub(1).max(span.start));
        match last.origin {
            Origin::File(from) if last.span.start >= first.span.start => {
                from + (span.end - last.span.start)
            }
            _ => start + first.span.end.min(span.end).saturating_sub(span.start),
        }
    }

    /// The piece that holds the byte `offset`; the last one at the end of the text.
    fn piece_at(&self, offset: usize) -> Piece {
        let next = self.pieces.partition_point(|piece| piece.span.start <= offset);
        let nothing = Piece { span: Span::new(0, 0), origin: Origin::File(0) };
        self.pieces.get(next.saturating_sub(1)).copied().unwrap_or(nothing)
    }

    /// The source with `span` replaced by `parts`: texts with the part of `argument`
    /// (`path=value`) that each stands for.
    pub(super) fn replaced(&self, span: Span, argument: String, parts: &[(&str, Span)]) -> Self {
        let number = self.arguments.len();
        let mut pieces: Vec<Piece> =
            self.pieces.iter().filter_map(|p| p.within(Span::new(0, span.start))).collect();
        let mut text = self.text[..span.start].to_owned();
        for &(part_text, part) in parts.iter().filter(|(part_text, _)| !part_text.is_empty()) {
            let start = text.len();
            text.push_str(part_text);
            let origin = Origin::Argument { number, part };
            pieces.push(Piece { span: Span::new(start, text.len()), origin });
        }
        let moved_by = text.len() as isize - span.end as isize;
        text.push_str(&self.text[span.end..]);
        let after = Span::new(span.end, self.text.len());
        let rest = self.pieces.iter().filter_map(|piece| piece.within(after));
        pieces.extend(rest.map(|piece| piece.moved(moved_by)));
        let mut arguments = self.arguments.clone();
        arguments.push(argument);
        Self { name: self.name.clone(), text, file: self.file.clone(), arguments, pieces }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_characters_and_line_feeds() {
        let text = "äb\n\tc\r\n\nd";
        for (offset, line, column) in [
            (0, 1, 1),
            (2, 1, 2),
            (3, 1, 3),
            (4, 2, 1),
            (5, 2, 2),
            (8, 3, 1),
            (9, 4, 1),
            (10, 4, 2),
        ] {
            let position = Position { line, column };
            assert_eq!(Position::of(text, offset), position, "{offset}");
            assert_eq!(position.offset(text), offset, "{position:?}");
        }
        assert_eq!(Position::of(text, 1), Position { line: 1, column: 1 }, "inside a character");
        assert_eq!(Position::of(text, 99), Position { line: 4, column: 2 });
        assert_eq!(Position { line: 1, column: 99 }.offset(text), 3);
        assert_eq!(Position { line: 99, column: 1 }.offset(text), text.len());
    }

    #[test]
    fn edits_keep_the_origin_of_every_byte() {
        let source = Source::new("a.ron", "\u{FEFF}(a: 10, b: 2)");
        assert_eq!(source.text(), "(a: 10, b: 2)");
        let once = source.replaced(Span::new(4, 6), "a=777".into(), &[("777", Span::new(2, 5))]);
        assert_eq!(once.text(), "(a: 777, b: 2)");
        let file = "(a: 10, b: 2)";
        let at = |start, end| once.place(Span::new(start, end));
        assert_eq!(at(12, 13), Place::File { text: file, span: Span::new(11, 12) });
        assert_eq!(at(5, 6), Place::Argument { text: "a=777", span: Span::new(3, 4) });
        assert_eq!(at(0, 14), Place::File { text: file, span: Span::new(0, 13) });
        assert_eq!(at(14, 14), Place::File { text: file, span: Span::new(13, 13) });

        let twice = once.replaced(Span::new(5, 6), "x=(y)".into(), &[("\"y\"", Span::new(2, 5))]);
        assert_eq!(twice.text(), "(a: 7\"y\"7, b: 2)");
        let place = twice.place(Span::new(8, 9));
        assert_eq!(place, Place::Argument { text: "a=777", span: Span::new(4, 5) });
        let place = twice.place(Span::new(6, 7));
        assert_eq!(place, Place::Argument { text: "x=(y)", span: Span::new(3, 4) });
    }

    #[test]
    fn an_edit_of_the_whole_text_has_no_file_left() {
        let source = Source::new("a.ron", "1");
        let edited = source.replaced(Span::new(0, 1), "=2".into(), &[("2", Span::new(1, 2))]);
        let end = edited.place(Span::new(1, 1));
        assert_eq!(end, Place::Argument { text: "=2", span: Span::new(2, 2) });
        let nothing = edited.replaced(Span::new(0, 1), "=".into(), &[]);
        assert_eq!(nothing.text(), "");
        assert_eq!(
            nothing.place(Span::new(3, 9)),
            Place::File { text: "1", span: Span::new(3, 9) }
        );
    }
}
