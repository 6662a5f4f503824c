//! The header of a file, byte for byte.

use std::io::{self, Write};

use super::layout::{Attribute, Layout, Variable};
use crate::Fault;

const FORMAT: &[u8; 4] = b"CDF\x02";
const DIMENSIONS: u32 = 0x0A;
const VARIABLES: u32 = 0x0B;
const ATTRIBUTES: u32 = 0x0C;

/// Type codes of values.
const TEXT: u32 = 2;
const INTEGER: u32 = 4;
const DOUBLE: u32 = 6;

/// A header and the places of what follows it.
#[derive(Debug)]
pub(super) struct Header {
    /// The bytes with a count of zero records.
    pub bytes: Vec<u8>,
    /// Where the records start.
    pub start: u64,
    /// Bytes of a record.
    pub record_bytes: u64,
    /// Number of fields.
    pub fields: usize,
    /// Nodes of a field.
    pub nodes: usize,
}

/// A variable with its dimensions, type, bytes (in a record, if it is recorded) and place.
struct Placed<'a> {
    variable: &'a Variable,
    dimensions: Vec<u32>,
    kind: u32,
    bytes: u64,
    begin: u64,
}

impl Header {
    /// The header of a layout.
    pub fn new(layout: &Layout) -> Result<Self, Fault> {
        layout.check_names()?;
        let nodes = layout.nodes()?;
        let mut placed = placed(layout, nodes);
        // The places are as long as they are, whatever they say: a first draft tells where the
        // header ends.
        let mut begin = encode(layout, &placed).len() as u64;
        let fixed = layout.axes.len() + usize::from(layout.system.is_some());
        let mut start = begin;
        for (index, variable) in placed.iter_mut().enumerate() {
            variable.begin = begin;
            begin += variable.bytes;
            if index < fixed {
                start = begin;
            }
        }
        let bytes = encode(layout, &placed);
        let fields = layout.fields.len();
        Ok(Self { bytes, start, record_bytes: begin - start, fields, nodes })
    }
}

/// The variables in the order of the file, not yet at their places.
fn placed(layout: &Layout, nodes: usize) -> Vec<Placed<'_>> {
    let axes = layout.axes.len() as u32;
    let axis = layout.axes.iter().zip(1..).map(|(axis, dimension)| {
        (&axis.variable, vec![dimension], DOUBLE, 8 * axis.values.len() as u64)
    });
    let system = layout.system.iter().map(|system| (system, Vec::new(), INTEGER, 4));
    let record = [(&layout.record, vec![0], DOUBLE, 8)];
    let field =
        layout.fields.iter().map(|field| (field, (0..=axes).collect(), DOUBLE, 8 * nodes as u64));
    let all = axis.chain(system).chain(record).chain(field);
    all.map(|(variable, dimensions, kind, bytes)| Placed {
        variable,
        dimensions,
        kind,
        bytes,
        begin: 0,
    })
    .collect()
}

fn encode(layout: &Layout, placed: &[Placed<'_>]) -> Vec<u8> {
    let mut out = FORMAT.to_vec();
    word(&mut out, 0);
    list(&mut out, DIMENSIONS, 1 + layout.axes.len());
    // A dimension of size zero is the one that grows.
    name(&mut out, &layout.record.name);
    word(&mut out, 0);
    for axis in &layout.axes {
        name(&mut out, &axis.variable.name);
        word(&mut out, axis.values.len() as u32);
    }
    attributes(&mut out, &layout.whole);
    list(&mut out, VARIABLES, placed.len());
    for each in placed {
        name(&mut out, &each.variable.name);
        word(&mut out, each.dimensions.len() as u32);
        each.dimensions.iter().for_each(|&dimension| word(&mut out, dimension));
        attributes(&mut out, each.variable);
        word(&mut out, each.kind);
        word(&mut out, each.bytes as u32);
        out.extend(each.begin.to_be_bytes());
    }
    out
}

fn attributes(out: &mut Vec<u8>, variable: &Variable) {
    list(out, ATTRIBUTES, variable.attributes.len());
    for (key, value) in &variable.attributes {
        name(out, key);
        match value {
            Attribute::Text(text) => {
                word(out, TEXT);
                name(out, text);
            }
            Attribute::Number(number) => {
                word(out, DOUBLE);
                word(out, 1);
                out.extend(number.to_be_bytes());
            }
        }
    }
}

/// The start of a list; an empty one has no tag.
fn list(out: &mut Vec<u8>, tag: u32, count: usize) {
    word(out, if count == 0 { 0 } else { tag });
    word(out, count as u32);
}

/// A text with its length, filled up to whole words.
fn name(out: &mut Vec<u8>, text: &str) {
    word(out, text.len() as u32);
    out.extend(text.as_bytes());
    out.resize(out.len().next_multiple_of(4), 0);
}

fn word(out: &mut Vec<u8>, value: u32) {
    out.extend(value.to_be_bytes());
}

/// Writes what stands between the header and the records.
pub(super) fn write_coordinates(layout: &Layout, out: &mut impl Write) -> io::Result<()> {
    for value in layout.axes.iter().flat_map(|axis| &axis.values) {
        out.write_all(&value.to_be_bytes())?;
    }
    // The variable of the coordinate system has attributes and no value that matters.
    match layout.system {
        Some(_) => out.write_all(&0_u32.to_be_bytes()),
        None => Ok(()),
    }
}
