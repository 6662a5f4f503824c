//! Every kind of error with the place it points at, and ron's words as they are relied on.

use ron::extensions::Extensions;
use serde::Deserialize;
use serde::de::{self, Deserializer};

use super::super::edit::set;
use super::*;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "only the errors of reading it matter")]
struct Plan {
    rate: f64,
    #[serde(default)]
    count: u32,
    #[serde(default)]
    domain: Domain,
    #[serde(default)]
    shape: Option<Shape>,
    #[serde(default)]
    list: Vec<u32>,
    #[serde(default)]
    path: String,
    #[serde(default)]
    pair: (u32, u32),
    #[serde(default)]
    open: bool,
    #[serde(default)]
    letter: char,
    #[serde(default)]
    positive: Positive,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "only the errors of reading it matter")]
struct Domain {
    spacing: u32,
    #[serde(default)]
    size: f64,
}

#[derive(Debug, Deserialize)]
#[allow(dead_code, reason = "only the errors of reading it matter")]
enum Shape {
    Flat,
    Round { radius: u32 },
    Wide(u32),
}

/// A number with a reader of its own, which refuses with a diagnostic.
#[derive(Debug, Default)]
struct Positive;

impl<'de> Deserialize<'de> for Positive {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let refused = |x: f64| {
            let message = Diagnostic::new(Code::OutOfRange, format!("{x} is too small"))
                .expected("more than 0");
            de::Error::custom(message.help("take 1"))
        };
        f64::deserialize(deserializer)
            .and_then(|x| if x > 0.0 { Ok(Self) } else { Err(refused(x)) })
    }
}

fn error_of(text: &str) -> SpannedError {
    let options = ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
    options.from_str::<Plan>(text).unwrap_err()
}

/// Text, message, the part pointed at, and what was expected.
const CASES: [(&str, &str, &str, &str); 50] = [
    ("(rate: 1, size: 2)", "unknown field \"size\" in Plan", "size", "one of rate, count, domain"),
    (
        "(rate: 1, domain: Domain(spacing: 1, w: 1))",
        "unknown field \"w\" in Domain",
        "w",
        "one of spacing, size",
    ),
    ("(count: 1)", "Plan lacks the field \"rate\"", "(", "rate: ..."),
    (
        "(rate: 1, domain: (size: 2))",
        "domain lacks the field \"spacing\"",
        "domain",
        "spacing: ...",
    ),
    (
        "(rate: 1, domain: Domain(size: 2))",
        "Domain lacks the field \"spacing\"",
        "Domain",
        "spacing: ...",
    ),
    ("(rate: 1, shape: Round())", "Round lacks the field \"radius\"", "Round", "radius: ..."),
    (
        "(rate: 1, shape: Round( /* ) */ ))",
        "Round lacks the field \"radius\"",
        "Round",
        "radius: ...",
    ),
    ("(rate: 1, rate: 2)", "the field \"rate\" is given twice", "rate", ""),
    (
        "(rate: 1, shape: Flta)",
        "unknown name \"Flta\" in Shape",
        "Flta",
        "one of Flat, Round, Wide",
    ),
    (
        "(rate: 1,\n domain: Domian(spacing: 2))",
        "unknown name \"Domian\"",
        "Domian",
        "Domain, or parentheses",
    ),
    ("(rate: \"ä\")", "rate cannot be \"ä\"", "\"ä\"", "a number"),
    ("(rate: /* x */ yes)", "rate cannot be yes", "yes", "a number"),
    ("(rate: , count: 2)", "rate is missing", "", "a number"),
    ("(rate: ", "rate is missing", "", "a number"),
    ("(rate: 1, count: -3)", "count cannot be -3", "-3", "a whole number that fits"),
    (
        "(rate: 1, count: 99999999999)",
        "count cannot be 99999999999",
        "99999999999",
        "a whole number that fits",
    ),
    ("(rate: 1, count: 3.5)", "count cannot be 3.5", "3.5", "a whole number"),
    ("(rate: 1, count: _3)", "count cannot be _3", "_3", "a number"),
    ("(rate: 1, open: yes)", "open cannot be yes", "yes", "true or false"),
    ("(rate: 1, path: foo)", "path cannot be foo", "foo", "a string"),
    ("(rate: 1, path: 5)", "path cannot be 5", "5", "a string"),
    ("(rate: 1, letter: 5)", "letter cannot be 5", "5", "a character"),
    ("(rate: 1, list: 3)", "list cannot be 3", "3", "a list"),
    ("(rate: 1, list: [1, x , 3])", "a value in list cannot be x", "x", "a whole number"),
    ("(rate: 1, domain: 5)", "domain cannot be 5", "5", "the fields of Domain in parentheses"),
    ("(rate: 1, shape: Wide)", "shape cannot be Wide", "Wide", "values in parentheses"),
    ("(rate: 1, shape: Wide(x))", "a value in shape cannot be x", "x", "a whole number"),
    ("(rate: 1, pair: (1,))", "pair: found one element", "(1,)", "a tuple of size 2"),
    ("(rate: 1, pair: (1, 2, 3))", "unexpected 3", "3", "`)`"),
    ("(rate: 1, pair: [1, 2])", "pair cannot be [1, 2]", "[1, 2]", "values in parentheses"),
    ("(rate: 1 count: 2)", "unexpected count", "count", "a comma"),
    ("(rate: 1; count: 2)", "unexpected ;", ";", "a comma"),
    ("(rate 1)", "unexpected 1", "1", "a colon"),
    ("(\"rate\": 1)", "the value cannot be \"rate\"", "\"rate\"", "a name"),
    ("(the-rate: 1)", "this is not the name of a field", "the", "letters, digits"),
    ("(rate: 1) x", "there is more text after the end", "x", ""),
    ("(rate: 1))", "there is more text after the end", ")", ""),
    ("", "the value is missing", "", "the fields of Plan"),
    ("{rate: 1}", "the value cannot be {rate: 1}", "{rate: 1}", "the fields of Plan"),
    (
        "(rate: 1",
        "the parenthesis that begins here is never closed",
        "(",
        "`)` before the end of the text",
    ),
    (
        "(rate: 1,",
        "the parenthesis that begins here is never closed",
        "(",
        "`)` before the end of the text",
    ),
    (
        "(",
        "the parenthesis that begins here is never closed",
        "(",
        "`)` before the end of the text",
    ),
    (
        "(rate: 1, list: [1, 2",
        "the square bracket that begins here",
        "[",
        "`]` before the end of the text",
    ),
    (
        "(rate: 1, list: [1,\n 2)",
        "the square bracket that begins here",
        "[",
        "`]` before the `)` in line 2",
    ),
    (
        "(rate: 1, path: \"x)",
        "the string that begins here",
        "\"x)",
        "a closing quote before the end of the text",
    ),
    ("(rate: 1, path: r#\"x\")", "the string that begins here", "r#\"x\")", "a closing quote"),
    (
        "(rate: 1 /* x )",
        "the comment that begins here",
        "/* x )",
        "`*/` before the end of the text",
    ),
    ("(rate: 1, path: \"a\\q\")", "unknown escape character", "a\\q", ""),
    ("#![enable(none)] (rate: 1)", "no RON extension named `none`", "none", ""),
    ("(rate: 1, positive: -2, count: 1)", "-2 is too small", "-2", "more than 0"),
];

#[test]
fn every_error_says_what_is_wrong_where_and_what_was_expected() {
    for (text, message, part, expected) in CASES {
        let source = Source::new("x.ron", text);
        let found = ron_diagnostic(&source, &error_of(text));
        assert!(found.message.starts_with(message), "{text}: {found}");
        assert_eq!(found.span.unwrap().of(text), part, "{text}: {found}");
        let found_expected = found.expected.clone().unwrap_or_default();
        assert!(found_expected.starts_with(expected), "{text}: {found}");
        assert_eq!(found_expected.is_empty(), expected.is_empty(), "{text}: {found}");
    }
}

#[test]
fn errors_that_went_through_an_erased_reader_read_the_same() {
    for (text, ..) in CASES {
        let source = Source::new("x.ron", text);
        let error = error_of(text);
        let erased = SpannedError { code: Error::Message(error.code.to_string()), ..error.clone() };
        assert_eq!(ron_diagnostic(&source, &erased), ron_diagnostic(&source, &error), "{text}");
    }
}

#[test]
fn near_names_are_suggested_and_own_readers_keep_their_help() {
    for (text, help) in [
        ("(rate: 1, shape: Flta)", "did you mean \"Flat\"?"),
        ("(rate: 1, cuont: 3)", "did you mean \"count\"?"),
        ("(rate: 1, domain: Domian(spacing: 2))", "did you mean \"Domain\"?"),
        ("(rate: 1, positive: -2, count: 1)", "take 1"),
    ] {
        let found = ron_diagnostic(&Source::new("x.ron", text), &error_of(text));
        assert_eq!(found.help.as_deref(), Some(help), "{text}");
    }
}

#[test]
fn errors_in_set_values_show_the_argument_and_others_the_line_of_the_file() {
    let source = Source::new("x.ron", "(\n  rate: 1,\n  count: x,\n)");
    let first = set(&source, "rate", "fast").unwrap();
    let rate = "error[L0105]: rate cannot be fast\n --> --set rate=fast\n |\n | rate=fast\n |      ^^^^\n  \
                expected: a number\n";
    assert_eq!(ron_diagnostic(&first, &error_of(first.text())).render(&first), rate);
    let second = set(&source, "rate", "100.25").unwrap();
    let shown = ron_diagnostic(&second, &error_of(second.text())).render(&second);
    assert!(shown.contains(" --> x.ron:3:10\n") && shown.contains("3 |   count: x,"), "{shown}");
    let third = set(&source, "count", "1").and_then(|source| set(&source, "cuont", "1")).unwrap();
    let shown = ron_diagnostic(&third, &error_of(third.text())).render(&third);
    assert!(shown.contains(" --> --set cuont=1\n") && shown.contains("\"count\"?"), "{shown}");
}

#[test]
fn serdes_own_words_are_understood_too() {
    let text = "(a: Dunes(slb: 1))";
    let source = Source::new("x.ron", text);
    let position = |col| ron::error::Position { line: 1, col };
    let diagnostic = |words: &str, start, end| {
        let span = ron::error::Span { start: position(start), end: position(end) };
        ron_diagnostic(&source, &SpannedError { code: Error::Message(words.into()), span })
    };
    let unknown = diagnostic("unknown field `slb`, expected `slab` or `repose`", 11, 14);
    assert_eq!(unknown.message, "unknown field \"slb\" in Dunes");
    assert_eq!(unknown.expected.as_deref(), Some("one of slab, repose"));
    let missing = diagnostic("missing field `repose`", 17, 17);
    assert_eq!(missing.message, "Dunes lacks the field \"repose\"");
    assert_eq!(missing.span.unwrap().of(text), "Dunes");
}

#[test]
fn deep_nesting_is_refused_with_a_message() {
    #[derive(Debug, Deserialize)]
    #[allow(dead_code, reason = "only the errors of reading it matter")]
    struct Nest(Vec<Nest>);
    let text = "([".repeat(500);
    let error = ron::from_str::<Nest>(&text).unwrap_err();
    let found = ron_diagnostic(&Source::new("x.ron", text), &error);
    assert_eq!(found.message, "brackets are nested too deep");
}

/// The tables hold what ron says: a new version with other words fails here.
#[test]
fn the_words_are_those_of_ron() {
    let words = |errors: &[Error]| errors.iter().map(message_of).collect::<Vec<_>>();
    let theirs = |table: &[(&'static str, &str)]| table.iter().map(|row| row.0).collect::<Vec<_>>();
    let values = [
        Error::ExpectedFloat,
        Error::ExpectedInteger,
        Error::ExpectedBoolean,
        Error::ExpectedString,
        Error::ExpectedChar,
        Error::ExpectedByteString,
        Error::ExpectedOption,
        Error::ExpectedUnit,
        Error::ExpectedArray,
        Error::ExpectedMap,
        Error::ExpectedStructLike,
        Error::ExpectedIdentifier,
        Error::UnderscoreAtBeginning,
        Error::IntegerOutOfBounds,
    ];
    assert_eq!(words(&values), theirs(&VALUES));
    let marks = [
        Error::ExpectedComma,
        Error::ExpectedMapColon,
        Error::ExpectedArrayEnd,
        Error::ExpectedStructLikeEnd,
        Error::ExpectedMapEnd,
        Error::ExpectedStringEnd,
        Error::UnclosedBlockComment,
        Error::Eof,
    ];
    assert_eq!(words(&marks), theirs(&MARKS));
}
