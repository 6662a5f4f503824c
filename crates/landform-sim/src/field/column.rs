//! What a field is: its name, its unit and the component that holds its value at a node.

use bevy_ecs::component::Component;
use bytemuck::TransparentWrapper;
use rayon::prelude::*;

use crate::checkpoint::Element;

/// A type of number that a field may hold at a node.
pub trait Number: Element + Default {
    /// The number as a double, for pictures, files and metrics.
    fn to_f64(self) -> f64;

    /// The number nearest to a double, saturating at the ends of the type's range.
    fn from_f64(value: f64) -> Self;

    /// Whether none of the numbers is infinite or NaN.
    fn all_finite(values: &[Self]) -> bool;
}

macro_rules! floats {
    ($($type:ty),*) => {$(
        impl Number for $type {
            fn to_f64(self) -> f64 {
                self as f64
            }
            fn from_f64(value: f64) -> Self {
                value as $type
            }
            fn all_finite(values: &[Self]) -> bool {
                // Blocks without an early exit are read at the speed of memory.
                let spoilt = |block: &[$type]| {
                    block.iter().fold(false, |bad, value| bad | !value.is_finite())
                };
                !values.par_chunks(BLOCK).any(spoilt)
            }
        }
    )*};
}

macro_rules! integers {
    ($($type:ty),*) => {$(
        impl Number for $type {
            fn to_f64(self) -> f64 {
                self as f64
            }
            fn from_f64(value: f64) -> Self {
                value.round() as $type
            }
            fn all_finite(_: &[Self]) -> bool {
                true
            }
        }
    )*};
}

/// Numbers that one thread looks at in a go.
const BLOCK: usize = 1 << 14;

floats!(f64, f32);
integers!(u8, i32, u32);

/// A field: a number at every node of the lattice, known by a name.
///
/// Implement it for an empty marker type; nothing needs to be derived.
pub trait NodeField: Send + Sync + 'static {
    /// Type of the number at a node.
    type Value: Number;
    /// Name in scenarios, reports and files, in lower case.
    const NAME: &'static str;
    /// Unit of the values, `"1"` when they have none.
    const UNIT: &'static str;
    /// What the value means, in a few words.
    const MEANING: &'static str;
    /// The least value that a run may start with; a thickness is at least zero.
    const LEAST: f64 = f64::NEG_INFINITY;
}

/// The component that holds the value of field `F` at a node.
#[derive(Component, TransparentWrapper)]
#[repr(transparent)]
pub struct Column<F: NodeField>(F::Value);

impl<F: NodeField> Default for Column<F> {
    fn default() -> Self {
        Self(F::Value::default())
    }
}
