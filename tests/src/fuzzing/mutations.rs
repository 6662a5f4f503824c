//! Damage to good inputs, the same at every run of the tests.

use landform::sim::random::RandomStream;

/// Random numbers of one case.
struct Dice {
    stream: RandomStream,
    case: u64,
    rolled: u32,
}

impl Dice {
    /// A number below `sides`; zero when there are none.
    fn roll(&mut self, sides: usize) -> usize {
        self.rolled += 1;
        self.stream.block(self.case, 0, self.rolled)[0] as usize % sides.max(1)
    }
}

/// `seed` with damage at one to four places: bytes changed, removed, repeated or cut off at the
/// end, other digits in numbers, and `words` put in or over others. The same `case` gives the
/// same damage.
pub fn mutated(seed: &[u8], words: &[String], case: u64) -> Vec<u8> {
    let mut dice = Dice { stream: RandomStream::new(1950, "damage"), case, rolled: 0 };
    let mut bytes = seed.to_vec();
    for _ in 0..=dice.roll(4).min(dice.roll(4)) {
        // Headers and directories are where damage hurts.
        let range = if dice.roll(2) == 0 { bytes.len().min(400) } else { bytes.len() };
        let at = dice.roll(range);
        let some = at..(at + 1 + dice.roll(40)).min(bytes.len());
        match dice.roll(10) {
            0 => drop(bytes.splice(at..(at + 1).min(bytes.len()), [dice.roll(256) as u8])),
            1 => drop(bytes.splice(at..(at + 1).min(bytes.len()), [0x20 + dice.roll(95) as u8])),
            2 => drop(bytes.drain(some)),
            3 => drop(bytes.splice(at..at, bytes[some].to_vec())),
            4 if dice.roll(4) == 0 => bytes.truncate(at),
            4 | 5 => change_digit(&mut bytes[at..], &mut dice),
            6 | 7 => drop(bytes.splice(at..at, word(words, &mut dice))),
            _ => {
                let word = word(words, &mut dice);
                bytes.splice(at..(at + word.len()).min(bytes.len()), word);
            }
        }
    }
    bytes
}

/// Changes the next digit of a text.
fn change_digit(bytes: &mut [u8], dice: &mut Dice) {
    if let Some(digit) = bytes.iter_mut().find(|byte| byte.is_ascii_digit()) {
        *digit = b'0' + dice.roll(10) as u8;
    }
}

fn word(words: &[String], dice: &mut Dice) -> Vec<u8> {
    let choice = dice.roll(words.len());
    words.get(choice).map(|word| word.as_bytes().to_vec()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_is_the_same_damage_and_cases_differ() {
        let words = ["NaN".to_owned()];
        let damage = |case| mutated(b"a text that is good", &words, case);
        assert_eq!(damage(7), damage(7));
        let different = (0..200).filter(|&case| damage(case) != b"a text that is good").count();
        assert!(different > 150, "{different} of 200 are damaged");
        assert!((0..200).all(|case| mutated(b"", &[], case).len() < 10), "nothing is damaged too");
    }
}
