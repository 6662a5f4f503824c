//! Trees of sound, broken and hostile texts.

use super::*;

/// The tree in short: kinds, names, keys and the text of the leaves.
fn short(node: &Node, text: &str) -> String {
    let name = node.name.as_ref().map_or("", |name| name.name);
    let entries = node.entries.iter().map(|entry| {
        let key = entry.key.as_ref().map_or(String::new(), |key| format!("{}=", key.name));
        key + &short(&entry.value, text)
    });
    let entries = entries.collect::<Vec<_>>().join(" ");
    match node.kind {
        Kind::Struct => format!("{name}<{entries}>"),
        Kind::Tuple => format!("{name}({entries})"),
        Kind::List => format!("[{entries}]"),
        Kind::Map => format!("{{{entries}}}"),
        kind => format!("{kind:?}:{}", node.span.of(text)),
    }
}

#[test]
fn every_form_of_value_is_found() {
    for (text, expected) in [
        ("5", "Number:5"),
        ("#![enable(implicit_some)]\n#![type = \"]\"] Open", "Unit:Open"),
        ("Scenario(a: 1, b: \"x, y\")", "Scenario<a=Number:1 b=Text:\"x, y\">"),
        ("(a: (), b: [], c: {},)", "<a=() b=[] c={}>"),
        ("[Dunes(slab_m: 5.0), Lift, ]", "[Dunes<slab_m=Number:5.0> Unit:Lift]"),
        (
            "{\"k\": 1, 2: Some('c'), r#a-b: true}",
            "{k=Number:1 2=Some(Character:'c') a-b=Bool:true}",
        ),
        ("(0..5, -inf, ..=3)", "(Range:0..5 Number:-inf Range:..=3)"),
        ("(r#type: r#\"(\"#, /* ( */ x: 'y', // (\n)", "<type=Text:r#\"(\"# x=Character:'y'>"),
        ("Some((a: 1))", "Some(<a=Number:1>)"),
    ] {
        let tree = Tree::parse(text);
        assert_eq!(short(tree.root.as_ref().unwrap(), text), expected);
        assert!(tree.unclosed.is_empty(), "{text}");
    }
}

#[test]
fn broken_texts_still_give_a_tree() {
    for (text, expected, unclosed) in [
        ("(a: [1, 2)", "<a=[Number:1 Number:2]>", vec!["["]),
        ("(a: (b: 1, c: 2", "<a=<b=Number:1 c=Number:2>>", vec!["(", "("]),
        ("(a: , b: 2)", "<a=Unknown: b=Number:2>", vec![]),
        ("(a 1 b: 2)", "<Unit:a Number:1 b=Number:2>", vec![]),
        ("(a: 1]}, b: 2)", "<a=Number:1 b=Number:2>", vec![]),
        ("(a: \"x, b: 2)", "<a=Text:\"x, b: 2)>", vec!["(", "\"x, b: 2)"]),
        ("(a: 1 /* b: 2)", "<a=Number:1 Unknown:/* b: 2)>", vec!["(", "/* b: 2)"]),
        ("(a: @ %, :::)", "<a=Unknown:@ Unknown:%>", vec![]),
    ] {
        let tree = Tree::parse(text);
        assert_eq!(short(tree.root.as_ref().unwrap(), text), expected);
        let found: Vec<&str> = tree.unclosed.iter().map(|span| span.of(text)).collect();
        assert_eq!(found, unclosed, "{text}");
    }
    for text in ["", " // x", "#![enable("] {
        assert_eq!(Tree::parse(text).root, None, "{text}");
    }
}

#[test]
fn deep_nesting_is_skipped_not_followed() {
    let deep = 1_000_000;
    let text = format!("[{}{} , 7]", "[".repeat(deep), "]".repeat(deep));
    let tree = Tree::parse(&text);
    let root = tree.root.as_ref().unwrap();
    assert_eq!(root.span, Span::new(0, text.len()));
    assert_eq!(short(&root.entries[1].value, &text), "Number:7");
    assert_eq!(root.walk().count(), DEEPEST + 2);
    let open = "(a:".repeat(deep);
    assert!(Tree::parse(&open).root.is_some());
}

#[test]
fn the_innermost_value_at_a_place_is_found() {
    let text = "(a: [10, Dunes(k: 2)], b: 3)";
    let tree = Tree::parse(text);
    for (offset, expected) in
        [(5, "10"), (7, "10"), (10, "Dunes(k: 2)"), (18, "2"), (2, text), (28, text)]
    {
        assert_eq!(tree.at(offset).unwrap().span.of(text), expected, "{offset}");
    }
    assert_eq!(tree.at(99), None);
}

#[test]
fn a_flood_of_values_is_cut() {
    let text = format!("(a: [{}], b: 2)", "1,".repeat(2 * MOST_VALUES));
    let tree = Tree::parse(&text);
    let root = tree.root.as_ref().unwrap();
    assert_eq!(root.walk().count(), MOST_VALUES + 1);
    assert_eq!(root.span, Span::new(0, text.len()));
}
