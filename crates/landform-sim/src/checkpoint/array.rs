//! Arrays of plain numbers, as a checkpoint holds them.

use std::borrow::Cow;

use super::Damage;

/// Numbers of one type: borrowed from the run while a checkpoint is written, owned when it was
/// read.
#[derive(Clone, Debug, PartialEq)]
pub enum Array<'a> {
    /// Bytes.
    U8(Cow<'a, [u8]>),
    /// Whole numbers of 32 bits.
    I32(Cow<'a, [i32]>),
    /// Whole numbers of 32 bits, not negative.
    U32(Cow<'a, [u32]>),
    /// Whole numbers of 64 bits, not negative.
    U64(Cow<'a, [u64]>),
    /// Single precision.
    F32(Cow<'a, [f32]>),
    /// Double precision.
    F64(Cow<'a, [f64]>),
}

/// A type of number that a checkpoint holds arrays of.
pub trait Element: Copy + Send + Sync + 'static {
    /// Puts numbers into an array.
    fn array<'a>(values: Cow<'a, [Self]>) -> Array<'a>;

    /// The numbers of an array of this type, and `None` for another type.
    fn numbers<'a>(array: &'a Array<'_>) -> Option<&'a [Self]>;

    /// Name of the type as NumPy has it: `f8` for doubles.
    const KIND: &'static str;
}

macro_rules! elements {
    ($($type:ty, $variant:ident, $kind:literal;)*) => {
        $(impl Element for $type {
            const KIND: &'static str = $kind;

            fn array<'a>(values: Cow<'a, [Self]>) -> Array<'a> {
                Array::$variant(values)
            }

            fn numbers<'a>(array: &'a Array<'_>) -> Option<&'a [Self]> {
                match array {
                    Array::$variant(values) => Some(values),
                    _ => None,
                }
            }
        })*

        impl Array<'_> {
            /// Name of the type as NumPy has it: `f8` for doubles.
            pub fn kind(&self) -> &'static str {
                match self {
                    $(Self::$variant(_) => $kind,)*
                }
            }

            /// How many numbers there are.
            pub fn len(&self) -> usize {
                match self {
                    $(Self::$variant(values) => values.len(),)*
                }
            }

            /// The same array with a copy of its numbers, unless it owns them already.
            pub fn into_owned(self) -> Array<'static> {
                match self {
                    $(Self::$variant(values) => Array::$variant(values.into_owned().into()),)*
                }
            }

            /// The numbers as they lie in memory.
            pub fn bytes(&self) -> &[u8] {
                match self {
                    $(Self::$variant(values) => bytemuck::cast_slice(values),)*
                }
            }

            /// The array of type `kind` whose numbers lie in memory as `bytes`; `None` for an
            /// unknown type or a number that is cut off.
            pub fn from_bytes(kind: &str, bytes: &[u8]) -> Option<Array<'static>> {
                match kind {
                    $($kind if bytes.len().is_multiple_of(size_of::<$type>()) => {
                        let mut values = vec![<$type>::default(); bytes.len() / size_of::<$type>()];
                        bytemuck::cast_slice_mut(&mut values).copy_from_slice(bytes);
                        Some(Array::$variant(Cow::Owned(values)))
                    })*
                    _ => None,
                }
            }
        }
    };
}

elements! {
    u8, U8, "u1";
    i32, I32, "i4";
    u32, U32, "u4";
    u64, U64, "u8";
    f32, F32, "f4";
    f64, F64, "f8";
}

impl Array<'_> {
    /// Whether there is no number.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The numbers, when they are of type `T`.
    ///
    /// # Errors
    /// [`Damage::Kind`]; `name` is that of the array.
    pub fn numbers<T: Element>(&self, name: &str) -> Result<&[T], Damage> {
        T::numbers(self).ok_or_else(|| Damage::Kind {
            name: name.to_owned(),
            found: self.kind(),
            expected: T::KIND,
        })
    }
}
