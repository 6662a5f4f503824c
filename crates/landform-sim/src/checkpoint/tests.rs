//! Checkpoints in memory.

use std::borrow::Cow;

use proptest::prelude::*;
use serde::{Deserialize, Serialize};

use super::*;

/// As much as a state may consist of.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
enum Mood {
    Calm,
    Angry { at: u32, by: f32 },
    Away(Option<(i64, f64)>),
}

proptest! {
    /// Values come back with every bit, whatever their type.
    #[test]
    fn values_keep_every_bit(
        single in any::<f32>(), double in any::<f64>(), whole: u64, number: i64, text: String,
    ) {
        prop_assume!(!single.is_nan() && !double.is_nan());
        let moods = vec![
            Mood::Calm,
            Mood::Angry { at: whole as u32, by: single },
            Mood::Away(Some((number, double))),
            Mood::Away(None),
        ];
        let value = (moods, whole, text, single, double, ());
        let mut checkpoint = Checkpoint::default();
        checkpoint.saver("a").value("value", &value);
        prop_assert_eq!(checkpoint.check(), Ok(()));
        let found: (Vec<Mood>, u64, String, f32, f64, ()) =
            checkpoint.loader("a").value("value").unwrap();
        prop_assert_eq!(found.3.to_bits(), single.to_bits());
        prop_assert_eq!(found.4.to_bits(), double.to_bits());
        prop_assert_eq!(found, value);
    }

    #[test]
    fn arrays_pass_through_bytes(values: Vec<u64>) {
        let arrays = [
            Array::U64(Cow::Borrowed(&values)),
            Array::F64(values.iter().map(|&bits| f64::from_bits(bits)).collect()),
            Array::F32(values.iter().map(|&bits| f32::from_bits(bits as u32)).collect()),
            Array::U32(values.iter().map(|&value| value as u32).collect()),
            Array::I32(values.iter().map(|&value| value as i32).collect()),
            Array::U8(values.iter().map(|&value| value as u8).collect()),
        ];
        for array in arrays {
            let again = Array::from_bytes(array.kind(), array.bytes()).unwrap();
            prop_assert_eq!(again.bytes(), array.bytes());
            prop_assert_eq!((again.kind(), again.len()), (array.kind(), values.len()));
        }
    }
}

#[test]
fn what_is_missing_or_does_not_fit_is_named() {
    let numbers = [1.0, 2.0];
    let mut checkpoint = Checkpoint::default();
    checkpoint.saver("state").below("snow").array("depth", &numbers);
    checkpoint.saver("state").value("snowman", "made of snow");
    let from = checkpoint.loader("state").below("snow");
    assert_eq!(from.array_of("depth", 2), Ok(&numbers[..]));
    let message = |damage: Damage| damage.to_string();
    let length = message(from.array_of::<f64>("depth", 3).unwrap_err());
    assert!(length.contains("`state/snow/depth`") && length.contains("2 numbers instead of 3"));
    let kind = message(from.array::<u8>("depth").unwrap_err());
    assert!(kind.contains("type f8 instead of u1"), "{kind}");
    assert!(message(from.array::<u8>("age").unwrap_err()).contains("no `state/snow/age`"));
    let value = message(checkpoint.loader("state").value::<u32>("snowman").unwrap_err());
    assert!(value.contains("`state/snowman.ron`"), "{value}");
    assert!(!from.is_empty());
    assert!(checkpoint.loader("state").below("sno").is_empty(), "a part of a name is none");
    assert_eq!(Array::from_bytes("f8", &[0; 9]), None);
    assert_eq!(Array::from_bytes("c16", &[0; 16]), None);
}

/// RON has no way to write this, which shows before the checkpoint is put away.
#[test]
fn a_value_that_cannot_be_written_is_reported() {
    struct Unwritable;
    impl Serialize for Unwritable {
        fn serialize<S: serde::Serializer>(&self, _: S) -> Result<S::Ok, S::Error> {
            Err(serde::ser::Error::custom("no words for it"))
        }
    }
    let mut checkpoint = Checkpoint::default();
    checkpoint.saver("state").value("thing", &Unwritable);
    let message = checkpoint.check().unwrap_err().to_string();
    assert!(message.contains("state/thing") && message.contains("no words"), "{message}");
}
