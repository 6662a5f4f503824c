//! Letters become strings, all at once.

use std::borrow::Cow;

use landform_sim::random::{RandomStream, unit};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::NAME;
use crate::SynthError;
use crate::error::Checks;

/// Most letters of a string.
const MOST_LETTERS: usize = 10_000_000;

/// Most rules.
const MOST_RULES: usize = 64;

/// What a letter becomes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rule {
    /// The letter.
    pub letter: char,
    /// What it becomes.
    pub becomes: String,
    /// How often this rule is taken, in comparison with the others of its letter.
    #[serde(default = "one")]
    #[schemars(range(min = 0.0, max = 1e6))]
    pub weight: f64,
}

const fn one() -> f64 {
    1.0
}

/// Replaces every letter of `axiom` by what its rule says, `derivations` times. Letters with several
/// rules take one by their weights; the letter at a place of a derivation draws from (seed,
/// derivation, place).
///
/// # Errors
/// [`SynthError::TooLarge`] if a string would have more than 10 million letters, which is found out
/// before it is made, or there are more than 64 rules; [`SynthError::OutOfRange`] for weights.
pub fn rewrite(
    axiom: &str,
    rules: &[Rule],
    derivations: u32,
    seed: u64,
) -> Result<String, SynthError> {
    if rules.len() > MOST_RULES {
        return Err(SynthError::TooLarge { generator: NAME, what: "rules", most: MOST_RULES });
    }
    for rule in rules {
        Checks(NAME).range("weight", rule.weight, 0.0..=1e6)?;
    }
    let random = RandomStream::new(seed, "rules");
    let mut letters = Cow::Borrowed(axiom);
    for derivation in 0..derivations {
        let chosen = |place: usize, letter: char| {
            choose(rules, letter, || unit(random.block(u64::from(derivation), place, 0)[0]))
        };
        // Counted first, so that nothing is made that is too long.
        let lengths = letters.chars().enumerate().map(|(place, letter)| {
            chosen(place, letter).map_or(letter.len_utf8(), |rule| rule.becomes.len())
        });
        let length = lengths.fold(0_usize, usize::saturating_add);
        if length > MOST_LETTERS {
            let what = "letters";
            return Err(SynthError::TooLarge { generator: NAME, what, most: MOST_LETTERS });
        }
        let mut next = String::with_capacity(length);
        for (place, letter) in letters.chars().enumerate() {
            match chosen(place, letter) {
                Some(rule) => next.push_str(&rule.becomes),
                None => next.push(letter),
            }
        }
        if next == *letters {
            break;
        }
        letters = Cow::Owned(next);
    }
    Ok(letters.into_owned())
}

/// The rule that a letter takes: a number from 0 to 1 chooses among several.
fn choose(rules: &[Rule], letter: char, chance: impl Fn() -> f64) -> Option<&Rule> {
    let mut own = rules.iter().filter(|rule| rule.letter == letter);
    let first = own.next()?;
    if own.next().is_none() {
        return Some(first);
    }
    let own = || rules.iter().filter(|rule| rule.letter == letter && rule.weight > 0.0);
    let mut left = chance() * own().map(|rule| rule.weight).sum::<f64>();
    for rule in own() {
        left -= rule.weight;
        if left < 0.0 {
            return Some(rule);
        }
    }
    own().next_back().or(Some(first))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rule(letter: char, becomes: &str, weight: f64) -> Rule {
        Rule { letter, becomes: becomes.to_owned(), weight }
    }

    /// Lindenmayer's algae: strings as long as Fibonacci's numbers.
    #[test]
    fn algae_grow_as_fibonacci_counts() {
        let rules = [rule('A', "AB", 1.0), rule('B', "A", 1.0)];
        let lengths: Vec<usize> =
            (0..8).map(|steps| rewrite("A", &rules, steps, 0).unwrap().len()).collect();
        assert_eq!(lengths, [1, 2, 3, 5, 8, 13, 21, 34]);
        assert_eq!(rewrite("A", &rules, 4, 0).unwrap(), "ABAABABA");
    }

    #[test]
    fn weights_are_the_shares_of_the_rules() {
        let rules = [rule('A', "B", 3.0), rule('A', "C", 1.0), rule('A', "D", 0.0)];
        let axiom = "A".repeat(20_000);
        let grown = rewrite(&axiom, &rules, 1, 6).unwrap();
        let share = grown.matches('B').count() as f64 / 20_000.0;
        assert!((share - 0.75).abs() < 0.015, "{share}");
        assert!(!grown.contains('D') && !grown.contains('A'));
        assert_eq!(grown, rewrite(&axiom, &rules, 1, 6).unwrap());
        assert_ne!(grown, rewrite(&axiom, &rules, 1, 7).unwrap());
    }

    #[test]
    fn strings_that_would_fill_memory_are_refused_before_they_are_made() {
        let rules = [rule('A', &"A".repeat(1000), 1.0)];
        assert!(rewrite("A", &rules, 2, 0).is_ok());
        let refused = rewrite("A", &rules, 64, 0);
        assert!(matches!(refused, Err(SynthError::TooLarge { .. })));
        // A string that no rule changes any more ends at once.
        assert_eq!(rewrite("B", &rules, u32::MAX, 0).unwrap(), "B");
    }
}
