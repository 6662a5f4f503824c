//! The header of an array file: a Python dictionary in ASCII.

use crate::{Fault, Place};

pub(crate) const MAGIC: &[u8; 6] = b"\x93NUMPY";

/// What a header says.
#[derive(Debug, PartialEq)]
pub(crate) struct Header {
    /// Type character and number of bytes: `f8`, `i2`, `b1`.
    pub kind: String,
    pub big_endian: bool,
    pub fortran_order: bool,
    pub shape: Vec<u64>,
}

/// Magic, version and dictionary, padded to a multiple of 64 bytes. `descr` is the type of the
/// numbers with their order of bytes: `<f8`.
pub(crate) fn bytes(shape: &[usize], descr: &str) -> Vec<u8> {
    let sizes: Vec<String> = shape.iter().map(|size| format!("{size},")).collect();
    let mut text =
        format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({}), }}", sizes.join(" "));
    let unpadded = MAGIC.len() + 4 + text.len() + 1;
    text.extend(std::iter::repeat_n(' ', unpadded.next_multiple_of(64) - unpadded));
    text.push('\n');
    let mut bytes = MAGIC.to_vec();
    bytes.extend([1, 0]);
    bytes.extend((text.len() as u16).to_le_bytes());
    bytes.extend(text.as_bytes());
    bytes
}

/// Parses the dictionary of an array with at least one number.
pub(super) fn parse(text: &str) -> Result<Header, Fault> {
    let header = parse_any(text)?;
    match header.shape.contains(&0) {
        true => Err(bad_shape()),
        false => Ok(header),
    }
}

fn fault(problem: String, expected: &str) -> Fault {
    let advice = "save the array again with numpy.save";
    Fault::new(problem, expected, advice).at(Place::Byte(10))
}

fn bad_shape() -> Fault {
    fault("the shape cannot be read".into(), "a tuple of sizes, each at least 1")
}

/// Parses the dictionary of any array.
pub(crate) fn parse_any(text: &str) -> Result<Header, Fault> {
    let entry = |key: &str| {
        let quoted = [format!("'{key}'"), format!("\"{key}\"")];
        let found = quoted.iter().find_map(|name| Some((text.find(name.as_str())?, name.len())));
        let (start, length) = found.ok_or_else(|| {
            fault(format!("the header has no '{key}'"), "'descr', 'fortran_order' and 'shape'")
        })?;
        Ok(text[start + length..].trim_start_matches([' ', ':']))
    };
    let descr = entry("descr")?;
    let name = descr.get(1..).and_then(|rest| rest.split(['\'', '"']).next()).unwrap_or("");
    let (order, kind) = name.split_at_checked(1).unwrap_or(("", ""));
    let big_endian = order == ">";
    const KINDS: [&str; 11] = ["f4", "f8", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "b1"];
    if !["<", ">", "|", "="].contains(&order) || !KINDS.contains(&kind) {
        let problem = format!("the numbers are of type {}", name.escape_debug());
        return Err(fault(problem, "a plain real type: f4 f8 i1 i2 i4 i8 u1 u2 u4 u8 b1"));
    }
    let order = entry("fortran_order")?;
    let fortran_order = match (order.starts_with("True"), order.starts_with("False")) {
        (true, _) => true,
        (_, true) => false,
        _ => return Err(fault("fortran_order is neither".into(), "True or False")),
    };
    let shape = entry("shape")?.strip_prefix('(').and_then(|rest| rest.split(')').next());
    let shape = shape.and_then(sizes).ok_or_else(bad_shape)?;
    Ok(Header { kind: kind.into(), big_endian, fortran_order, shape })
}

fn sizes(text: &str) -> Option<Vec<u64>> {
    let items = text.split(',').map(str::trim).filter(|item| !item.is_empty());
    items.map(|item| item.trim_end_matches('L').parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_is_read_back_and_aligned() {
        for sizes in [vec![3], vec![20, 30], vec![1, 2, 3]] {
            let bytes = bytes(&sizes, "<i2");
            assert_eq!(bytes.len() % 64, 0);
            let header = parse(std::str::from_utf8(&bytes[10..]).unwrap()).unwrap();
            assert_eq!(header.kind, "i2");
            assert!(!header.big_endian && !header.fortran_order);
            assert_eq!(header.shape, sizes.iter().map(|&size| size as u64).collect::<Vec<_>>());
        }
    }

    #[test]
    fn wrong_headers_are_explained() {
        let message = |text: &str| parse(text).unwrap_err().to_string();
        let no_shape = message("{'descr': '<f8', 'fortran_order': False}");
        assert!(no_shape.contains("no 'shape'"), "{no_shape}");
        let complex = message("{'descr': '<c16', 'fortran_order': False, 'shape': (2, 2)}");
        assert!(complex.contains("<c16") && complex.contains("plain real type"), "{complex}");
        for shape in ["(2, 0)", "(-2, 3)", "(two, 3)", "2, 3"] {
            let text = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}}}");
            assert!(message(&text).contains("shape cannot be read"), "{shape}");
        }
    }
}
