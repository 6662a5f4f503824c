//! Properties of the text module that hold for any scenario and any text.

use std::collections::BTreeMap;

use proptest::prelude::*;
use ron::ser::{PrettyConfig, to_string, to_string_pretty};
use serde::{Deserialize, Serialize};

use crate::code::Code;

use super::lexer::Tokens;
use super::path::inside;
use super::{
    Diagnostic, Kind, Node, Place, Position, Source, Span, Tree, locate, ron_diagnostic, set,
};

/// A value of every form that RON can write.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Sample {
    Unit,
    Number(f64),
    Whole(i64),
    Flag(bool),
    Letter(char),
    Text(String),
    Maybe(Option<Box<Sample>>),
    Pair(Box<Sample>, Box<Sample>),
    List(Vec<Sample>),
    Table(BTreeMap<String, Sample>),
    Fields { first: Box<Sample>, second: Box<Sample> },
}

fn samples() -> impl Strategy<Value = Sample> {
    let leaf = prop_oneof![
        Just(Sample::Unit),
        any::<f64>().prop_filter("NaN equals nothing", |x| !x.is_nan()).prop_map(Sample::Number),
        any::<i64>().prop_map(Sample::Whole),
        any::<bool>().prop_map(Sample::Flag),
        any::<char>().prop_map(Sample::Letter),
        any::<String>().prop_map(Sample::Text),
    ];
    leaf.prop_recursive(4, 24, 4, |inner| {
        let boxed = || inner.clone().prop_map(Box::new);
        prop_oneof![
            proptest::option::of(boxed()).prop_map(Sample::Maybe),
            (boxed(), boxed()).prop_map(|(a, b)| Sample::Pair(a, b)),
            proptest::collection::vec(inner.clone(), 0..4).prop_map(Sample::List),
            proptest::collection::btree_map(any::<String>(), inner.clone(), 0..4)
                .prop_map(Sample::Table),
            (boxed(), boxed()).prop_map(|(first, second)| Sample::Fields { first, second }),
        ]
    })
}

/// Texts that are nearly RON.
fn nearly_ron() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        any::<char>().prop_map(String::from),
        proptest::sample::select(vec![
            "(",
            ")",
            "[",
            "]",
            "{",
            "}",
            ",",
            ":",
            "\"",
            "'",
            "\\",
            "//",
            "/*",
            "*/",
            "\n",
            "r#",
            "r\"",
            "b'",
            "..",
            "..=",
            "0x",
            "-",
            "1e",
            "#![enable(",
            "Some(",
            "a: ",
            "Dunes",
            "\u{85}",
            "é",
        ])
        .prop_map(String::from),
    ];
    proptest::collection::vec(piece, 0..60).prop_map(|pieces| pieces.concat())
}

/// The tree of a serialised sample has the sample's shape, and each span holds the text that
/// reads as that part of it.
fn check(node: &Node, text: &str, sample: &Sample) {
    let read: Sample = ron::from_str(node.span.of(text)).unwrap();
    assert_eq!(&read, sample);
    let name = node.name.as_ref().map(|name| name.name);
    let values = |node: &Node| node.entries.len();
    let inner = |index: usize| &node.entries[index].value;
    match sample {
        Sample::Unit => assert_eq!((name, node.kind), (Some("Unit"), Kind::Unit)),
        Sample::Number(_) | Sample::Whole(_) => assert_eq!(inner(0).kind, Kind::Number),
        Sample::Flag(_) => assert_eq!(inner(0).kind, Kind::Bool),
        Sample::Letter(_) => assert_eq!(inner(0).kind, Kind::Character),
        Sample::Text(_) => assert_eq!(inner(0).kind, Kind::Text),
        Sample::Maybe(None) => assert_eq!(inner(0).span.of(text), "None"),
        Sample::Maybe(Some(value)) => check(&inner(0).entries[0].value, text, value),
        Sample::Pair(first, second) => {
            check(inner(0), text, first);
            check(inner(1), text, second);
        }
        Sample::List(list) => {
            assert_eq!((inner(0).kind, values(inner(0))), (Kind::List, list.len()));
            inner(0)
                .entries
                .iter()
                .zip(list)
                .for_each(|(entry, value)| check(&entry.value, text, value));
        }
        Sample::Table(table) => {
            assert_eq!((inner(0).kind, values(inner(0))), (Kind::Map, table.len()));
            for (entry, (key, value)) in inner(0).entries.iter().zip(table) {
                let written = entry.key.as_ref().unwrap().span.of(text);
                assert_eq!(&ron::from_str::<String>(written).unwrap(), key);
                check(&entry.value, text, value);
            }
        }
        Sample::Fields { first, second } => {
            let keys: Vec<&str> =
                node.entries.iter().map(|entry| entry.key.as_ref().unwrap().name).collect();
            assert_eq!((node.kind, keys), (Kind::Struct, vec!["first", "second"]));
            check(inner(0), text, first);
            check(inner(1), text, second);
        }
    }
}

/// Paths to every value below `node`, by numbers and keys. Maps are left out, as their keys may
/// hold dots and brackets.
fn paths(node: &Node, path: &str, found: &mut Vec<(String, Span)>) {
    let node = inside(node);
    for (index, entry) in node.entries.iter().enumerate().filter(|_| node.kind != Kind::Map) {
        let below = match &entry.key {
            Some(key) => format!("{path}.{}", key.name),
            None => format!("{path}[{index}]"),
        };
        found.push((below.clone(), entry.value.span));
        paths(&entry.value, &below, found);
    }
}

proptest! {
    #[test]
    fn spans_of_serialised_values_slice_back_to_them(sample in samples()) {
        for text in [to_string(&sample).unwrap(), to_string_pretty(&sample, PrettyConfig::new()).unwrap()] {
            let tree = Tree::parse(&text);
            prop_assert!(tree.unclosed.is_empty());
            check(tree.root.as_ref().unwrap(), &text, &sample);
        }
    }

    #[test]
    fn tokens_are_in_order_and_leave_out_only_blanks_and_comments(text in nearly_ron()) {
        let mut end = 0;
        for token in Tokens::new(&text) {
            prop_assert!(token.span.start >= end && token.span.end > token.span.start);
            prop_assert!(text.is_char_boundary(token.span.start) && text.is_char_boundary(token.span.end));
            let skipped = text[end..token.span.start].trim_start();
            prop_assert!(skipped.is_empty() || skipped.starts_with(['/', '\u{200E}', '\u{200F}']), "{skipped:?}");
            end = token.span.end;
        }
    }

    #[test]
    fn no_text_panics(text in nearly_ron(), path in nearly_ron(), value in nearly_ron(), at in 0..200_usize, long in 0..99_usize) {
        let source = Source::new("x.ron", text.clone());
        let tree = Tree::parse(source.text());
        for node in tree.root.iter().flat_map(Node::walk) {
            prop_assert!(source.text().get(node.span.start..node.span.end).is_some(), "{:?}", node.span);
        }
        Diagnostic::new(Code::Notation, value.clone()).at(Span::new(at, at + long)).render(&source);
        for result in [set(&source, &path, &value), set(&source, "a", &value)] {
            match result {
                Ok(edited) => {
                    Diagnostic::new(Code::Notation, "m").at(Span::new(at, at + long)).render(&edited);
                    if let Err(error) = ron::from_str::<ron::Value>(edited.text()) {
                        ron_diagnostic(&edited, &error).render(&edited);
                    }
                }
                Err(diagnostic) => drop(diagnostic.render(&source)),
            }
        }
        if let Err(error) = ron::from_str::<Sample>(source.text()) {
            ron_diagnostic(&source, &error).render(&source);
        }
    }

    #[test]
    fn positions_and_offsets_agree(text in ".{0,20}(\n.{0,9}){0,5}", at in 0..80_usize) {
        let at = text.floor_char_boundary(at);
        prop_assert_eq!(Position::of(&text, at).offset(&text), at);
    }

    #[test]
    fn what_is_set_is_what_is_found_and_read(
        first in -1e9..1e9_f64,
        points in proptest::collection::vec((-1000..1000_i64, any::<bool>()), 1..5),
        pick in any::<proptest::sample::Index>(),
        new in any::<i64>(),
    ) {
        let sample = Sample::Fields {
            first: Box::new(Sample::Number(first)),
            second: Box::new(Sample::List(points.iter().map(|&(whole, flag)| {
                Sample::Pair(Box::new(Sample::Whole(whole)), Box::new(Sample::Flag(flag)))
            }).collect())),
        };
        let index = pick.index(points.len());
        let source = Source::new("x.ron", to_string_pretty(&sample, PrettyConfig::new()).unwrap());
        let path = format!("second.{index}.0.0");
        let edited = set(&source, &path, &new.to_string()).unwrap();
        let found = locate(&Tree::parse(edited.text()), &path).unwrap();
        prop_assert_eq!(found.of(edited.text()), new.to_string());
        let mut expected = sample;
        if let Sample::Fields { second, .. } = &mut expected
            && let Sample::List(list) = second.as_mut() {
            list[index] = Sample::Pair(Box::new(Sample::Whole(new)), Box::new(Sample::Flag(points[index].1)));
        }
        prop_assert_eq!(ron::from_str::<Sample>(edited.text()).unwrap(), expected);
    }

    #[test]
    fn every_path_finds_its_value_and_setting_it_to_itself_changes_nothing(sample in samples()) {
        let text = to_string(&sample).unwrap();
        let tree = Tree::parse(&text);
        let mut all = Vec::new();
        paths(tree.root.as_ref().unwrap(), "", &mut all);
        let source = Source::new("x.ron", text.clone());
        for (path, span) in &all {
            prop_assert_eq!(locate(&tree, path), Some(*span), "{} in {}", path, text);
            let edited = set(&source, path, span.of(&text)).unwrap();
            prop_assert_eq!(edited.text(), &text, "{}", path);
        }
    }

    #[test]
    fn after_edits_every_byte_of_the_file_still_leads_back_to_it(
        edits in proptest::collection::vec((0..4_usize, 0..1_000_000_u64), 0..6),
    ) {
        let file = "(a: 12, b: (c: 3, d: [4, 56]), // e\n f: Dunes)";
        let mut source = Source::new("x.ron", file);
        for (pick, value) in edits {
            let path = ["a", "b.d[1]", "b.new", "f.k"][pick];
            source = set(&source, path, &value.to_string()).unwrap();
        }
        for (at, letter) in source.text().char_indices() {
            let place = source.place(Span::new(at, at + 1));
            let (text, span, exact) = match place {
                Place::File { text, span } => (text, span, true),
                Place::Argument { text, span } => (text, span, letter.is_ascii_digit()),
            };
            prop_assert!(!exact || span.of(text) == letter.to_string(), "{letter} {place:?}");
        }
        prop_assert!(ron::from_str::<ron::Value>(source.text()).is_ok());
    }
}
