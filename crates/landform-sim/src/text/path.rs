//! Paths that name a value of a scenario: `stages[0].processes.Dunes.slab_m`.

use super::source::Span;
use super::tree::{Entry, Kind, Node, Tree};

/// Why a part of a path names nothing, or not one thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Miss {
    /// There is no such entry.
    Absent,
    /// Several elements of a list have this name.
    Several(usize),
}

/// The parts of a path: `stages[0].processes` and `stages.0.processes` are the same.
pub(super) fn parts(path: &str) -> impl Iterator<Item = &str> {
    path.split(['.', '[', ']']).map(str::trim).filter(|part| !part.is_empty())
}

/// Where the value that `path` names stands.
///
/// The parts of a path are names of fields or keys, numbers of elements (from zero, as
/// `stages[0]` or `stages.0`), or names of elements that have one (`processes.Dunes`); where
/// several have the same name, the first is meant. The single value in the parentheses of a
/// name, as in `Some((a: 1))`, needs no part of its own. An empty path is the whole text.
pub fn locate(tree: &Tree, path: &str) -> Option<Span> {
    let mut node = tree.root.as_ref()?;
    for part in parts(path) {
        node = &matching(node, part).next()?.value;
    }
    Some(node.span)
}

/// Where the key of the value that `path` names stands; see [`locate`]. The name of an element
/// is its key.
pub fn locate_key(tree: &Tree, path: &str) -> Option<Span> {
    let mut node = tree.root.as_ref()?;
    let mut key = None;
    for part in parts(path) {
        let entry = matching(node, part).next()?;
        node = &entry.value;
        key = entry.key.as_ref().or(node.name.as_ref()).map(|key| key.span);
    }
    key
}

/// The entry of `node` that a part of a path names.
pub(super) fn step<'t, 'a>(node: &'t Node<'a>, part: &str) -> Result<&'t Entry<'a>, Miss> {
    let mut entries = matching(node, part);
    let first = entries.next().ok_or(Miss::Absent)?;
    match entries.count() {
        0 => Ok(first),
        more => Err(Miss::Several(more + 1)),
    }
}

/// The node that the parts of a path are looked up in: inside `Some(...)` and its like.
pub(super) fn inside<'t, 'a>(mut node: &'t Node<'a>) -> &'t Node<'a> {
    while node.name.is_some() && node.kind == Kind::Tuple && node.entries.len() == 1 {
        let inner = &node.entries[0].value;
        if !matches!(inner.kind, Kind::Struct | Kind::Tuple | Kind::List | Kind::Map) {
            break;
        }
        node = inner;
    }
    node
}

/// The names that can follow `node` in a path.
pub(super) fn names<'a>(node: &Node<'a>) -> Vec<&'a str> {
    let name =
        |entry: &Entry<'a>| entry.key.as_ref().or(entry.value.name.as_ref()).map(|key| key.name);
    inside(node).entries.iter().filter_map(name).collect()
}

/// The entries of `node` that a part of a path fits: by number in lists and tuples, by key, or
/// by the name of the value where there is no key.
fn matching<'t, 'a>(node: &'t Node<'a>, part: &str) -> impl Iterator<Item = &'t Entry<'a>> {
    let number = part.parse::<usize>().ok();
    inside(node).entries.iter().enumerate().filter_map(move |(index, entry)| {
        let fits = match (&entry.key, &entry.value.name) {
            (Some(key), _) => key.name == part,
            (None, name) => {
                number == Some(index) || name.as_ref().is_some_and(|name| name.name == part)
            }
        };
        fits.then_some(entry)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "Scenario(domain: (size: (40, 50)), \
        stages: [(processes: [Lift, Dunes(slab_m: 5.0), Dunes(slab_m: 6.0)])], \
        start: Some((path: \"x\")), steps: Some(7), table: {\"a\": 1, 2: 3})";

    #[test]
    fn paths_name_values() {
        let tree = Tree::parse(TEXT);
        for (path, expected) in [
            ("", Some(TEXT)),
            ("domain.size", Some("(40, 50)")),
            ("domain.size[1]", Some("50")),
            ("domain.size.0", Some("40")),
            ("stages[0].processes[2].slab_m", Some("6.0")),
            ("stages.0.processes.Dunes.slab_m", Some("5.0")),
            ("stages.0.processes.Lift", Some("Lift")),
            ("start.path", Some("\"x\"")),
            ("steps", Some("Some(7)")),
            ("steps.0", Some("7")),
            ("table.a", Some("1")),
            ("table.2", Some("3")),
            ("domain.sizes", None),
            ("stages[1]", None),
            ("domain.size.0.x", None),
        ] {
            let found = locate(&tree, path).map(|span| span.of(TEXT));
            assert_eq!(found, expected, "{path}");
        }
        assert_eq!(locate(&Tree::parse(""), ""), None);
    }

    #[test]
    fn paths_name_keys() {
        let tree = Tree::parse(TEXT);
        for (path, expected) in [
            ("domain.size", Some("size")),
            ("table.a", Some("\"a\"")),
            ("stages[0].processes.Dunes", Some("Dunes")),
            ("stages[0].processes[1]", Some("Dunes")),
            ("stages[0]", None),
            ("domain.sizes", None),
            ("", None),
        ] {
            let found = locate_key(&tree, path).map(|span| span.of(TEXT));
            assert_eq!(found, expected, "{path}");
        }
    }

    #[test]
    fn a_name_that_several_elements_share_is_told() {
        let tree = Tree::parse(TEXT);
        let stage = &step(tree.root.as_ref().unwrap(), "stages").unwrap().value.entries[0].value;
        let processes = &step(stage, "processes").unwrap().value;
        assert_eq!(step(processes, "Dunes"), Err(Miss::Several(2)));
        assert_eq!(step(processes, "Sandpile"), Err(Miss::Absent));
        assert_eq!(names(processes), ["Lift", "Dunes", "Dunes"]);
    }
}
