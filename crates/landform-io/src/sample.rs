//! Types of stored numbers.

use std::io::{self, Write};

/// How a number is stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SampleType {
    /// IEEE 754 double: keeps every bit of a field.
    #[default]
    F64,
    /// IEEE 754 single: about seven digits.
    F32,
    /// Whole numbers from -32768 to 32767.
    I16,
    /// Whole numbers from -2147483648 to 2147483647.
    I32,
    /// Whole numbers from 0 to 255.
    U8,
}

impl SampleType {
    /// Bytes of a number.
    pub fn size(self) -> usize {
        match self {
            Self::F64 => 8,
            Self::F32 | Self::I32 => 4,
            Self::I16 => 2,
            Self::U8 => 1,
        }
    }

    /// Name in NumPy's notation, little endian.
    pub fn name(self) -> &'static str {
        match self {
            Self::F64 => "<f8",
            Self::F32 => "<f4",
            Self::I16 => "<i2",
            Self::I32 => "<i4",
            Self::U8 => "|u1",
        }
    }

    /// Least and greatest number that can be stored.
    pub fn range(self) -> [f64; 2] {
        match self {
            Self::F64 => [-f64::MAX, f64::MAX],
            Self::F32 => [f64::from(f32::MIN), f64::from(f32::MAX)],
            Self::I16 => [f64::from(i16::MIN), f64::from(i16::MAX)],
            Self::I32 => [f64::from(i32::MIN), f64::from(i32::MAX)],
            Self::U8 => [0.0, 255.0],
        }
    }

    /// The storable number nearest to a value within the range.
    pub(crate) fn nearest(self, value: f64) -> f64 {
        match self {
            Self::F64 => value,
            Self::F32 => f64::from(value as f32),
            Self::I16 | Self::I32 | Self::U8 => value.round(),
        }
    }

    /// Numbers that may mark missing cells, the best first.
    pub(crate) fn marks(self) -> &'static [f64] {
        match self {
            Self::F64 | Self::F32 => &[f64::NAN],
            Self::I16 => &[-32768.0, -9999.0, 32767.0],
            Self::I32 => &[-2147483648.0, -9999.0, 2147483647.0],
            Self::U8 => &[255.0, 0.0],
        }
    }

    /// Writes numbers that [`nearest`](Self::nearest) has made storable, little endian.
    pub(crate) fn write(self, values: &[f64], writer: &mut impl Write) -> io::Result<()> {
        let mut bytes = Vec::with_capacity(self.size() * values.len().min(BLOCK));
        for block in values.chunks(BLOCK) {
            bytes.clear();
            match self {
                Self::F64 => block.iter().for_each(|v| bytes.extend(v.to_le_bytes())),
                Self::F32 => block.iter().for_each(|v| bytes.extend((*v as f32).to_le_bytes())),
                Self::I16 => {
                    block.iter().for_each(|v| bytes.extend((*v as i16).to_le_bytes()));
                }
                Self::I32 => {
                    block.iter().for_each(|v| bytes.extend((*v as i32).to_le_bytes()));
                }
                Self::U8 => bytes.extend(block.iter().map(|v| *v as u8)),
            }
            writer.write_all(&bytes)?;
        }
        Ok(())
    }
}

/// Numbers converted at a time.
const BLOCK: usize = 1 << 13;
