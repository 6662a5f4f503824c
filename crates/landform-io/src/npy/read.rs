//! Arrays from NumPy's files.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use super::header::{self, Header, MAGIC};
use crate::{Fault, IoError, Place, ReadLimits};

/// An array of any number of axes, in C order: the last axis varies fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Size along each axis.
    pub shape: Vec<usize>,
    /// The numbers.
    pub values: Vec<f64>,
}

/// Reads an array of real numbers as f64.
///
/// # Errors
/// [`IoError`]: no such file, another format, a type that is not real, more cells than the
/// limit, fewer bytes than the shape demands, or whole numbers beyond 2^53.
pub fn read_array(path: &Path, limits: &ReadLimits) -> Result<Array, IoError> {
    let system = |error| IoError::system(path, "read", error);
    let file = File::open(path).map_err(system)?;
    let length = file.metadata().map_err(system)?.len();
    let mut reader = BufReader::with_capacity(1 << 16, file);
    let (header, start) = read_header(&mut reader).map_err(|fault| fault.reading(path))?;
    let cells = limits.cells(path, &header.shape)?;
    let size = usize::from(header.kind.as_bytes()[1] - b'0');
    let available = length.saturating_sub(start);
    let demanded = cells as u64 * size as u64;
    if available < demanded {
        let problem = format!("{available} bytes of numbers follow the header");
        let expected = format!("{demanded} bytes for the shape {:?}", header.shape);
        let fault = Fault::new(problem, expected, "the file is cut off: fetch or save it again");
        return Err(fault.at(Place::Byte(length)).reading(path));
    }
    let mut values = Vec::with_capacity(cells);
    let mut bytes = vec![0; size * BLOCK.min(cells)];
    while values.len() < cells {
        let count = BLOCK.min(cells - values.len());
        let block = &mut bytes[..size * count];
        reader.read_exact(block).map_err(system)?;
        decode(block, &header, &mut values).map_err(|fault| fault.reading(path))?;
    }
    // Sizes fit usize because their product does.
    let shape: Vec<usize> = header.shape.iter().map(|&size| size as usize).collect();
    if header.fortran_order {
        values = to_c_order(&values, &shape);
    }
    Ok(Array { shape, values })
}

/// The sizes along the axes of an array, without its numbers.
///
/// # Errors
/// [`IoError`]: no such file, or another format.
pub fn read_shape(path: &Path) -> Result<Vec<u64>, IoError> {
    let file = File::open(path).map_err(|error| IoError::system(path, "read", error))?;
    let header = read_header(&mut BufReader::new(file)).map_err(|fault| fault.reading(path))?;
    Ok(header.0.shape)
}

/// Numbers converted at a time.
const BLOCK: usize = 1 << 13;

/// The header and the number of bytes before the numbers.
fn read_header(reader: &mut impl Read) -> Result<(Header, u64), Fault> {
    let foreign = |_| {
        let problem = "this is not an array file of NumPy, or it is cut off";
        Fault::new(problem, "\\x93NUMPY and a header", "save it with numpy.save").at(Place::Byte(0))
    };
    let mut start = [0; 8];
    reader.read_exact(&mut start).map_err(foreign)?;
    let version = start[6];
    if !start.starts_with(MAGIC) || !(1..=3).contains(&version) {
        return Err(foreign(std::io::ErrorKind::InvalidData.into()));
    }
    let mut length = [0; 4];
    let width = if version == 1 { 2 } else { 4 };
    reader.read_exact(&mut length[..width]).map_err(foreign)?;
    let length = u32::from_le_bytes(length);
    const LONGEST: u32 = 1 << 16;
    if length > LONGEST {
        let problem = format!("the header claims {length} bytes");
        let expected = format!("at most {LONGEST}");
        let advice = "save plain numbers, without named fields";
        return Err(Fault::new(problem, expected, advice).at(Place::Byte(8)));
    }
    let mut text = vec![0; length as usize];
    reader.read_exact(&mut text).map_err(foreign)?;
    let header = header::parse(&String::from_utf8_lossy(&text))?;
    Ok((header, 8 + width as u64 + u64::from(length)))
}

fn decode(bytes: &[u8], header: &Header, values: &mut Vec<f64>) -> Result<(), Fault> {
    macro_rules! numbers {
        ($type:ty) => {{
            let (numbers, _) = bytes.as_chunks();
            let number = match header.big_endian {
                true => <$type>::from_be_bytes,
                false => <$type>::from_le_bytes,
            };
            numbers.iter().map(move |&bytes| number(bytes))
        }};
    }
    match header.kind.as_str() {
        "f8" => values.extend(numbers!(f64)),
        "f4" => values.extend(numbers!(f32).map(f64::from)),
        "i4" => values.extend(numbers!(i32).map(f64::from)),
        "u4" => values.extend(numbers!(u32).map(f64::from)),
        "i2" => values.extend(numbers!(i16).map(f64::from)),
        "u2" => values.extend(numbers!(u16).map(f64::from)),
        "i1" => values.extend(numbers!(i8).map(f64::from)),
        "i8" => return exact(numbers!(i64).map(i128::from), values),
        "u8" => return exact(numbers!(u64).map(i128::from), values),
        _ => values.extend(bytes.iter().map(|&byte| f64::from(byte))),
    }
    Ok(())
}

/// Whole numbers of eight bytes, as long as f64 holds them exactly.
fn exact(numbers: impl Iterator<Item = i128>, values: &mut Vec<f64>) -> Result<(), Fault> {
    for number in numbers {
        if number.abs() > 1 << 53 {
            let problem = format!("cell {}: {number} cannot be held exactly", values.len());
            let advice = "save the array as floating point";
            return Err(Fault::new(problem, "magnitudes up to 2^53", advice));
        }
        values.push(number as f64);
    }
    Ok(())
}

/// The same array with the last axis fastest instead of the first.
fn to_c_order(values: &[f64], shape: &[usize]) -> Vec<f64> {
    let strides: Vec<usize> = shape
        .iter()
        .scan(1, |stride, &size| {
            let own = *stride;
            *stride *= size;
            Some(own)
        })
        .collect();
    let source = |mut cell: usize| {
        let axes = shape.iter().zip(&strides).rev();
        axes.fold(0, |index, (&size, &stride)| {
            let along = cell % size;
            cell /= size;
            index + along * stride
        })
    };
    (0..values.len()).map(|cell| values[source(cell)]).collect()
}
