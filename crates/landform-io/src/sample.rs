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

    /// Least and greatest number of a whole-number type; `None` for floating point.
    pub fn integer_range(self) -> Option<[f64; 2]> {
        match self {
            Self::F64 | Self::F32 => None,
            Self::I16 => Some([f64::from(i16::MIN), f64::from(i16::MAX)]),
            Self::I32 => Some([f64::from(i32::MIN), f64::from(i32::MAX)]),
            Self::U8 => Some([0.0, 255.0]),
        }
    }

    /// Writes `values`, little endian; whole-number types round to the nearest.
    pub(crate) fn write(self, values: &[f64], writer: &mut impl Write) -> io::Result<()> {
        let mut bytes = Vec::with_capacity(self.size() * values.len().min(BLOCK));
        for block in values.chunks(BLOCK) {
            bytes.clear();
            match self {
                Self::F64 => block.iter().for_each(|v| bytes.extend(v.to_le_bytes())),
                Self::F32 => block.iter().for_each(|v| bytes.extend((*v as f32).to_le_bytes())),
                Self::I16 => {
                    block.iter().for_each(|v| bytes.extend((v.round() as i16).to_le_bytes()));
                }
                Self::I32 => {
                    block.iter().for_each(|v| bytes.extend((v.round() as i32).to_le_bytes()));
                }
                Self::U8 => bytes.extend(block.iter().map(|v| v.round() as u8)),
            }
            writer.write_all(&bytes)?;
        }
        Ok(())
    }
}

/// Numbers converted at a time.
const BLOCK: usize = 1 << 13;
