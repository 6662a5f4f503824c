//! The tokens of RON and where they stand, for any text at all.
//!
//! This follows the grammar in ron's documentation where a text is valid and goes on sensibly
//! where it is not; every byte is looked at a bounded number of times.

use super::source::Span;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Symbol {
    /// An opening bracket: `(`, `[` or `{`.
    Open(char),
    /// A closing bracket: `)`, `]` or `}`.
    Close(char),
    /// `,`
    Comma,
    /// `:`
    Colon,
    /// A name, plain or raw (`r#a-b`).
    Name,
    /// A number or a byte literal.
    Number,
    /// `..` or `..=`
    Range,
    /// A string or byte string; whether its end was found.
    Text { closed: bool },
    /// A character in single quotes.
    Character,
    /// A block comment that has no end.
    UnclosedComment,
    /// A character that belongs to no token.
    Other(char),
}

/// A token and its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token {
    pub symbol: Symbol,
    pub span: Span,
}

/// The tokens of a text in order.
pub(super) struct Tokens<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Tokens<'a> {
    pub fn new(text: &'a str) -> Self {
        Self { text, at: 0 }
    }
}

impl Iterator for Tokens<'_> {
    type Item = Token;

    fn next(&mut self) -> Option<Token> {
        let rest = &self.text[self.at..];
        let blank = blank_length(rest);
        let start = self.at + blank;
        let (symbol, length) = token(&rest[blank..])?;
        self.at = start + length;
        Some(Token { symbol, span: Span::new(start, self.at) })
    }
}

/// The kind and length of the token at the start of `rest`.
fn token(rest: &str) -> Option<(Symbol, usize)> {
    let first = rest.chars().next()?;
    let one = |symbol| Some((symbol, first.len_utf8()));
    match first {
        '(' | '[' | '{' => one(Symbol::Open(first)),
        ')' | ']' | '}' => one(Symbol::Close(first)),
        ',' => one(Symbol::Comma),
        ':' => one(Symbol::Colon),
        '/' if rest.starts_with("/*") => Some((Symbol::UnclosedComment, rest.len())),
        '.' if rest.starts_with("..") => {
            Some((Symbol::Range, if rest.starts_with("..=") { 3 } else { 2 }))
        }
        '0'..='9' | '+' | '-' | '.' => Some((Symbol::Number, number_length(rest))),
        '\'' => match character_length(rest) {
            Some(length) => Some((Symbol::Character, length)),
            None => one(Symbol::Other(first)),
        },
        _ => text(rest).or_else(|| byte(rest)).or_else(|| name(rest)).or(one(Symbol::Other(first))),
    }
}

/// Length of the white space and comments at the start of `rest`. A block comment without an
/// end is left to be a token.
fn blank_length(rest: &str) -> usize {
    let mut at = 0;
    loop {
        let here = &rest[at..];
        let length = match here.chars().next() {
            Some(letter) if is_blank(letter) => letter.len_utf8(),
            Some('/') if here.starts_with("//") => here.find('\n').unwrap_or(here.len()),
            Some('/') if here.starts_with("/*") => match block_comment_length(here) {
                Some(length) => length,
                None => return at,
            },
            _ => return at,
        };
        at += length;
    }
}

/// Length of a nested block comment, if it has an end.
fn block_comment_length(rest: &str) -> Option<usize> {
    let mut depth = 0_usize;
    let mut at = 0;
    while let Some(found) = rest[at..].find(['/', '*']) {
        at += found;
        let step = match &rest.as_bytes()[at..] {
            [b'/', b'*', ..] => {
                depth += 1;
                2
            }
            [b'*', b'/', ..] => {
                depth -= 1;
                2
            }
            _ => 1,
        };
        at += step;
        if depth == 0 {
            return Some(at);
        }
    }
    None
}

/// White space as RON's grammar lists it.
fn is_blank(letter: char) -> bool {
    matches!(letter, ' ' | '\t' | '\n' | '\r' | '\x0B' | '\x0C')
        || matches!(letter, '\u{85}' | '\u{200E}' | '\u{200F}' | '\u{2028}' | '\u{2029}')
}

/// Length of a number with its suffix; stops before a range's dots.
fn number_length(rest: &str) -> usize {
    let digits = rest.strip_prefix(['+', '-']).unwrap_or(rest);
    let is_based = ["0x", "0b", "0o"].iter().any(|base| digits.starts_with(base));
    let mut previous = ' ';
    for (at, letter) in rest.char_indices() {
        let goes_on = match letter {
            '+' | '-' => at == 0 || (!is_based && matches!(previous, 'e' | 'E')),
            '.' => !rest[at..].starts_with(".."),
            letter => is_name_letter(letter),
        };
        if !goes_on {
            return at;
        }
        previous = letter;
    }
    rest.len()
}

/// Length of a character in single quotes.
fn character_length(rest: &str) -> Option<usize> {
    /// Longest escape: `\u{10FFFF}`.
    const LONGEST_ESCAPE: usize = 10;
    let inner = &rest[1..];
    let first = inner.chars().next()?;
    let content = match first {
        '\\' => {
            let escaped = inner.chars().nth(1)?.len_utf8();
            let closing = inner[1 + escaped..].find('\'')?;
            (closing < LONGEST_ESCAPE).then_some(1 + escaped + closing)?
        }
        letter => letter.len_utf8(),
    };
    inner[content..].starts_with('\'').then_some(content + 2)
}

/// A byte literal, `b'x'`.
fn byte(rest: &str) -> Option<(Symbol, usize)> {
    let length = character_length(rest.strip_prefix('b').filter(|r| r.starts_with('\''))?)?;
    Some((Symbol::Number, length + 1))
}

/// A string or byte string, plain or raw.
fn text(rest: &str) -> Option<(Symbol, usize)> {
    let unprefixed = rest.strip_prefix('b').unwrap_or(rest);
    let prefix = rest.len() - unprefixed.len();
    let (opening, closing) = match unprefixed.strip_prefix('r') {
        Some(raw) => {
            let hashes = raw.len() - raw.trim_start_matches('#').len();
            raw[hashes..].starts_with('"').then_some(())?;
            let opening = 1 + hashes + 1;
            let ending = format!("\"{}", &raw[..hashes]);
            let found = unprefixed[opening..].find(&ending).map(|at| opening + at + ending.len());
            (opening, found)
        }
        None => {
            unprefixed.starts_with('"').then_some(())?;
            (1, plain_text_end(unprefixed))
        }
    };
    debug_assert!(closing.is_none_or(|end| end > opening));
    let symbol = Symbol::Text { closed: closing.is_some() };
    Some((symbol, prefix + closing.unwrap_or(unprefixed.len())))
}

/// First byte after the string that starts `rest` with its quote.
fn plain_text_end(rest: &str) -> Option<usize> {
    let mut escaped = false;
    for (at, byte) in rest.bytes().enumerate().skip(1) {
        match byte {
            b'"' if !escaped => return Some(at + 1),
            b'\\' => escaped = !escaped,
            _ => escaped = false,
        }
    }
    None
}

/// A name, plain or raw.
fn name(rest: &str) -> Option<(Symbol, usize)> {
    if let Some(raw) = rest.strip_prefix("r#") {
        let is_raw = |letter: char| is_name_letter(letter) || matches!(letter, '.' | '+' | '-');
        let length = raw.find(|letter| !is_raw(letter)).unwrap_or(raw.len());
        if length > 0 {
            return Some((Symbol::Name, 2 + length));
        }
    }
    let length = rest.find(|letter| !is_name_letter(letter)).unwrap_or(rest.len());
    (length > 0).then_some((Symbol::Name, length))
}

/// Whether the letter can be part of a name: a little more generous than Unicode's rule for
/// identifiers, as `ron` itself refuses what is not one.
fn is_name_letter(letter: char) -> bool {
    letter == '_' || letter.is_alphanumeric() || (!letter.is_ascii() && !is_blank(letter))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> Vec<&str> {
        Tokens::new(text).map(|token| token.span.of(text)).collect()
    }

    #[test]
    fn every_form_of_literal_is_one_token() {
        for literal in [
            "0",
            "-1",
            "+2",
            "1_000",
            "0xFFu8",
            "-0x1e",
            "0b1010",
            "0o17",
            "1.5",
            ".5",
            "5.",
            "1e-5",
            "1.0E+3f64",
            "-inf",
            "inf",
            "NaN",
            "-NaNf32",
            "b'x'",
            "b'\\''",
            "true",
            "None",
            "\"\"",
            "\"a\\\"b\\\\\"",
            "\"a\nb\"",
            "r\"\\\"",
            "r#\"a\"b\"#",
            "r##\"\"#\"##",
            "b\"x\\\"\"",
            "br#\"\"\"#",
            "'a'",
            "'\\''",
            "'\\\\'",
            "'\\u{10FFFF}'",
            "'ä'",
            "'''",
            "r#a-b.c",
            "_x1",
            "größe",
            "r#type",
            "..",
            "..=",
            "r",
            "b",
            "br",
        ] {
            assert_eq!(tokens(literal), [literal]);
            assert_eq!(tokens(&format!(" [{literal}] ")), ["[", literal, "]"]);
        }
    }

    #[test]
    fn comments_and_blanks_are_skipped() {
        let text = "/* a /* b */ c */ x // y\n :/**/1\u{85}\u{2028},//";
        assert_eq!(tokens(text), ["x", ":", "1", ","]);
        assert_eq!(tokens("\"/*\" // \"\n'/'"), ["\"/*\"", "'/'"]);
    }

    #[test]
    fn ranges_end_numbers() {
        assert_eq!(tokens("0..5"), ["0", "..", "5"]);
        assert_eq!(tokens("1.5..=2e-3"), ["1.5", "..=", "2e-3"]);
        assert_eq!(tokens("0x1e-5"), ["0x1e", "-5"]);
    }

    #[test]
    fn what_has_no_end_goes_to_the_end_of_the_text() {
        assert_eq!(tokens("a \"b c"), ["a", "\"b c"]);
        assert_eq!(tokens("a /* b /* */ c"), ["a", "/* b /* */ c"]);
        assert_eq!(tokens("r#\"a\" b"), ["r#\"a\" b"]);
        assert_eq!(tokens("'ab'"), ["'", "ab", "'"]);
    }
}
