//! The name that was probably meant.

/// Longer names than this are never matched, so that the cost stays bounded.
const LONGEST_NAME: usize = 100;

/// The candidate nearest to a misspelt `name`, if one is near enough.
///
/// Nearness is the number of letters to insert, delete, replace or swap with a neighbour
/// (Damerau-Levenshtein, in the form of optimal string alignment), not counting case; among
/// equals the one with fewer differences of case wins, then the earlier one. About a third of
/// the letters may differ. A candidate that only goes on with a unit or a qualifier after an
/// underscore (`slab_m` for `slab`) counts as one letter away.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let exact: Vec<char> = name.chars().take(LONGEST_NAME + 1).collect();
    if exact.len() > LONGEST_NAME {
        return None;
    }
    let folded = fold(name);
    let near = |candidate: &'a str| {
        let letters: Vec<char> = candidate.chars().take(LONGEST_NAME + 1).collect();
        let shorter = folded.len().min(letters.len());
        let limit = folded.len().max(letters.len()).div_ceil(3).min(shorter.saturating_sub(1));
        if letters.len() > LONGEST_NAME || shorter == 0 {
            return None;
        }
        let other = fold(candidate);
        let distance = match goes_on(&folded, &other) {
            true => 1,
            false if folded.len().abs_diff(other.len()) > limit => return None,
            false => distance(&folded, &other),
        };
        let is_near = distance <= limit || goes_on(&folded, &other);
        is_near.then(|| ((distance, self::distance(&exact, &letters)), candidate))
    };
    candidates.into_iter().filter_map(near).min_by_key(|&(cost, _)| cost).map(|(_, found)| found)
}

/// A list of names for the "expected" line of a message: `one of a, b, c`.
pub fn one_of<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.into_iter().collect();
    match names.as_slice() {
        [] => "nothing: there are no names here".to_owned(),
        [only] => (*only).to_owned(),
        several => format!("one of {}", several.join(", ")),
    }
}

/// The letters of a name without regard to case.
fn fold(name: &str) -> Vec<char> {
    name.chars().flat_map(char::to_lowercase).collect()
}

/// Whether `longer` is `name`, an underscore and more.
fn goes_on(name: &[char], longer: &[char]) -> bool {
    name.len() >= 2 && longer.starts_with(name) && longer.get(name.len()) == Some(&'_')
}

/// Optimal string alignment: insertions, deletions, replacements and swaps of neighbours that
/// turn one name into the other. Three rows of the table are enough.
fn distance(from: &[char], to: &[char]) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut previous: Vec<usize> = (0..=to.len()).collect();
    for (i, &letter) in from.iter().enumerate() {
        let mut row = vec![i + 1; to.len() + 1];
        for (j, &other) in to.iter().enumerate() {
            let replaced = previous[j] + usize::from(letter != other);
            let mut least = replaced.min(previous[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && letter == to[j - 1] && from[i - 1] == other {
                least = least.min(before[j - 1] + 1);
            }
            row[j + 1] = least;
        }
        before = std::mem::replace(&mut previous, row);
    }
    previous[to.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_the_literature() {
        // Published examples; "ca" to "abc" is 3 with optimal string alignment, 2 without.
        for (from, to, expected) in [
            ("kitten", "sitting", 3),
            ("saturday", "sunday", 3),
            ("ca", "abc", 3),
            ("teh", "the", 1),
            ("", "abc", 3),
            ("same", "same", 0),
        ] {
            let letters = |word: &str| word.chars().collect::<Vec<_>>();
            assert_eq!(distance(&letters(from), &letters(to)), expected, "{from} {to}");
            assert_eq!(distance(&letters(to), &letters(from)), expected, "{to} {from}");
        }
    }

    #[test]
    fn the_nearest_name_is_found() {
        let names = ["Dunes", "Sandpile", "Rivers", "slab_m", "slope_deg", "size", "dunes", "k"];
        for (name, expected) in [
            ("Dnes", Some("Dunes")),
            ("Duens", Some("Dunes")),
            ("DUNES", Some("Dunes")),
            ("dunes", Some("dunes")),
            ("river", Some("Rivers")),
            ("slab", Some("slab_m")),
            ("slope", Some("slope_deg")),
            ("sizes", Some("size")),
            ("K", Some("k")),
            ("m", None),
            ("", None),
            ("Glacier", None),
        ] {
            assert_eq!(nearest(name, names), expected, "{name}");
        }
        assert_eq!(nearest("x", []), None);
    }

    #[test]
    fn absurdly_long_names_cost_nothing_and_match_nothing() {
        let long = "a".repeat(10_000_000);
        assert_eq!(nearest(&long, ["a", &long]), None);
        assert_eq!(nearest("a", [long.as_str()]), None);
    }

    #[test]
    fn lists_read_well() {
        assert_eq!(one_of(["a"]), "a");
        assert_eq!(one_of(["a", "b", "c"]), "one of a, b, c");
        assert_eq!(one_of([]), "nothing: there are no names here");
    }
}
