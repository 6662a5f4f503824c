//! Binary glTF 2.0 (Khronos): y up, z south, metres, a node for each mesh. Metadata are the extras of
//! the asset; colours are turned to linear light, as the standard demands, and a mesh with opacities
//! blends with what lies behind it.

use std::io::{self, Write};
use std::path::Path;

use serde_json::{Map, Value, json};

use super::{Body, Mesh, check_all};
use crate::{Fault, IfExists, IoError, Metadata, write_atomically};

/// Kinds of numbers, as the standard numbers them.
const SHORT: u32 = 5123;
const INT: u32 = 5125;
const SINGLE: u32 = 5126;

/// Writes the numbers of a list.
type Fill<'a> = Box<dyn Fn(&mut dyn Write) -> io::Result<()> + 'a>;

/// One list of numbers in the binary chunk.
struct Part<'a> {
    /// Attribute of the vertices; `None` for the triangles.
    attribute: Option<&'static str>,
    accessor: Value,
    bytes: u64,
    write: Fill<'a>,
}

/// Writes meshes as GLB.
///
/// # Errors
/// [`IoError`]: a mesh contradicts itself, they need more than 4 GiB, or the output cannot be
/// written.
pub fn write(
    path: &Path,
    bodies: &[Body<'_>],
    metadata: &Metadata,
    if_exists: IfExists,
) -> Result<(), IoError> {
    check_all(bodies).map_err(|fault| fault.writing(path))?;
    let parts: Vec<Vec<Part<'_>>> = bodies.iter().map(|body| parts(body.mesh)).collect();
    let binary: u64 = parts.iter().flatten().map(|part| part.bytes).sum();
    let mut text = document(bodies, &parts, binary, metadata).to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let length = 12 + 8 + text.len() as u64 + 8 + binary;
    let length = u32::try_from(length).map_err(|_| {
        let problem = format!("the file would have {length} bytes");
        let advice = "write a part, a coarser mesh, or a PLY file";
        Fault::new(problem, "fewer than 4 GiB", advice).writing(path)
    })?;
    write_atomically(path, if_exists, |writer| {
        writer.write_all(b"glTF")?;
        writer.write_all(&2_u32.to_le_bytes())?;
        writer.write_all(&length.to_le_bytes())?;
        writer.write_all(&(text.len() as u32).to_le_bytes())?;
        writer.write_all(b"JSON")?;
        writer.write_all(&text)?;
        writer.write_all(&(binary as u32).to_le_bytes())?;
        writer.write_all(b"BIN\0")?;
        parts.iter().flatten().try_for_each(|part| (part.write)(writer))
    })
}

/// East, north, up as the standard's east, up, south.
fn turned<T: std::ops::Neg<Output = T>>([east, north, up]: [T; 3]) -> [T; 3] {
    [east, up, -north]
}

fn single_position(position: &[f64; 3]) -> [f32; 3] {
    turned(position.map(|part| part as f32))
}

/// Each list of the mesh that is there. All entries are multiples of four bytes, so no list
/// needs padding.
fn parts(mesh: &Mesh) -> Vec<Part<'_>> {
    let mut parts = vec![positions(mesh)];
    if !mesh.normals.is_empty() {
        let normals = mesh.normals.iter().map(|&normal| turned(normal));
        parts.push(singles("NORMAL", "VEC3", normals));
    }
    if !mesh.picture_positions.is_empty() {
        parts.push(singles("TEXCOORD_0", "VEC2", mesh.picture_positions.iter().copied()));
    }
    if !mesh.colours.is_empty() {
        parts.push(colours(mesh));
    }
    parts.push(Part {
        attribute: None,
        accessor: accessor(INT, "SCALAR", 3 * mesh.triangles.len()),
        bytes: 12 * mesh.triangles.len() as u64,
        write: Box::new(|writer| {
            let mut vertices = mesh.triangles.as_flattened().iter();
            vertices.try_for_each(|vertex| writer.write_all(&vertex.to_le_bytes()))
        }),
    });
    parts
}

fn accessor(component: u32, kind: &str, count: usize) -> Value {
    json!({ "componentType": component, "type": kind, "count": count })
}

fn singles<'a, const N: usize>(
    attribute: &'static str,
    kind: &str,
    rows: impl ExactSizeIterator<Item = [f32; N]> + Clone + 'a,
) -> Part<'a> {
    Part {
        attribute: Some(attribute),
        accessor: accessor(SINGLE, kind, rows.len()),
        bytes: (4 * N * rows.len()) as u64,
        write: Box::new(move |writer| {
            let mut numbers = rows.clone().flatten();
            numbers.try_for_each(|number| writer.write_all(&number.to_le_bytes()))
        }),
    }
}

/// Positions, with their bounds as the standard demands.
fn positions(mesh: &Mesh) -> Part<'_> {
    let rows = mesh.positions.iter().map(single_position);
    let bounds = |best: fn(f32, f32) -> f32, start: f32| {
        let all = rows.clone();
        all.fold([start; 3], |bound, row| [0, 1, 2].map(|axis| best(bound[axis], row[axis])))
    };
    let least = bounds(f32::min, f32::INFINITY);
    let most = bounds(f32::max, f32::NEG_INFINITY);
    let mut part = singles("POSITION", "VEC3", rows);
    part.accessor["min"] = json!(least);
    part.accessor["max"] = json!(most);
    part
}

/// Colours in linear light with 16 bits, and opacities.
fn colours(mesh: &Mesh) -> Part<'_> {
    let mut accessor = accessor(SHORT, "VEC4", mesh.colours.len());
    accessor["normalized"] = json!(true);
    let table: Vec<[u8; 2]> = (0..=255).map(|part| linear(part).to_le_bytes()).collect();
    Part {
        attribute: Some("COLOR_0"),
        accessor,
        bytes: 8 * mesh.colours.len() as u64,
        write: Box::new(move |writer| {
            mesh.colours.iter().enumerate().try_for_each(|(vertex, colour)| {
                let [red, green, blue] = colour.map(|part| table[usize::from(part)]);
                let alpha = [mesh.opacities.get(vertex).copied().unwrap_or(u8::MAX); 2];
                writer.write_all([red, green, blue, alpha].as_flattened())
            })
        }),
    }
}

/// The curve of sRGB (IEC 61966-2-1), undone.
fn linear(part: u8) -> u16 {
    let value = f64::from(part) / 255.0;
    let light = match value <= 0.04045 {
        true => value / 12.92,
        false => ((value + 0.055) / 1.055).powf(2.4),
    };
    (light * 65535.0).round() as u16
}

/// The JSON chunk.
fn document(
    bodies: &[Body<'_>],
    parts: &[Vec<Part<'_>>],
    binary: u64,
    metadata: &Metadata,
) -> Value {
    let [mut views, mut accessors, mut meshes, mut nodes] = [const { Vec::new() }; 4];
    let mut start = 0;
    for (number, (body, parts)) in bodies.iter().zip(parts).enumerate() {
        let mut attributes = Map::new();
        for part in parts {
            let target = if part.attribute.is_some() { 34962 } else { 34963 };
            let mut accessor = part.accessor.clone();
            accessor["bufferView"] = json!(views.len());
            if let Some(name) = part.attribute {
                attributes.insert(name.into(), json!(accessors.len()));
            }
            accessors.push(accessor);
            views.push(json!({
                "buffer": 0, "byteOffset": start, "byteLength": part.bytes, "target": target
            }));
            start += part.bytes;
        }
        let indices = accessors.len() - 1;
        let primitive = json!({ "attributes": attributes, "indices": indices, "material": number });
        meshes.push(json!({ "name": body.name, "primitives": [primitive] }));
        nodes.push(json!({ "name": body.name, "mesh": number }));
    }
    let extras: Map<String, Value> =
        metadata.entries().into_iter().map(|(name, text)| (name, text.into())).collect();
    json!({
        "asset": { "version": "2.0", "generator": "Landform", "extras": extras },
        "scene": 0,
        "scenes": [{ "nodes": (0..bodies.len()).collect::<Vec<_>>() }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": bodies.iter().map(material).collect::<Vec<_>>(),
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{ "byteLength": binary }],
    })
}

/// Rough and opaque, or smooth and translucent as water is.
fn material(body: &Body<'_>) -> Value {
    let surface = |roughness: f64| json!({ "metallicFactor": 0.0, "roughnessFactor": roughness });
    match body.mesh.opacities.is_empty() {
        true => {
            json!({ "name": body.name, "pbrMetallicRoughness": surface(1.0), "doubleSided": true })
        }
        false => json!({
            "name": body.name, "pbrMetallicRoughness": surface(0.2), "doubleSided": true,
            "alphaMode": "BLEND"
        }),
    }
}
