//! Stanford PLY: binary, little endian. Metadata stand in comments.

use std::io::{self, Write};
use std::path::Path;

use super::{Mesh, comments};
use crate::{IfExists, IoError, Metadata, write_atomically};

/// Writes a mesh as PLY.
///
/// # Errors
/// [`IoError`]: the mesh contradicts itself, or the output cannot be written.
pub fn write(
    path: &Path,
    mesh: &Mesh,
    metadata: &Metadata,
    if_exists: IfExists,
) -> Result<(), IoError> {
    mesh.check().map_err(|fault| fault.writing(path))?;
    write_atomically(path, if_exists, |writer| {
        write_header(mesh, metadata, writer)?;
        write_vertices(mesh, writer)?;
        for triangle in &mesh.triangles {
            writer.write_all(&[3])?;
            triangle.iter().try_for_each(|vertex| writer.write_all(&vertex.to_le_bytes()))?;
        }
        Ok(())
    })
}

fn write_header(mesh: &Mesh, metadata: &Metadata, writer: &mut impl Write) -> io::Result<()> {
    writeln!(writer, "ply\nformat binary_little_endian 1.0")?;
    writeln!(writer, "comment x east, y north, z up; metres")?;
    for comment in comments(metadata) {
        writeln!(writer, "comment {comment}")?;
    }
    writeln!(writer, "element vertex {}", mesh.positions.len())?;
    let properties: [(bool, &str, &[&str]); 4] = [
        (true, "float", &["x", "y", "z"]),
        (!mesh.normals.is_empty(), "float", &["nx", "ny", "nz"]),
        (!mesh.picture_positions.is_empty(), "float", &["s", "t"]),
        (!mesh.colours.is_empty(), "uchar", &["red", "green", "blue"]),
    ];
    for (_, kind, names) in properties.iter().filter(|property| property.0) {
        for name in *names {
            writeln!(writer, "property {kind} {name}")?;
        }
    }
    // Signed indices are what every reader understands; they suffice for 2^31 vertices.
    let index = if mesh.positions.len() > i32::MAX as usize { "uint" } else { "int" };
    writeln!(writer, "element face {}", mesh.triangles.len())?;
    writeln!(writer, "property list uchar {index} vertex_indices\nend_header")
}

fn write_vertices(mesh: &Mesh, writer: &mut impl Write) -> io::Result<()> {
    let singles = |numbers: &[f32], writer: &mut _| {
        numbers.iter().try_for_each(|number| Write::write_all(writer, &number.to_le_bytes()))
    };
    for (vertex, position) in mesh.positions.iter().enumerate() {
        singles(&position.map(|part| part as f32), writer)?;
        if let Some(normal) = mesh.normals.get(vertex) {
            singles(normal, writer)?;
        }
        if let Some([left, top]) = mesh.picture_positions.get(vertex) {
            singles(&[*left, 1.0 - top], writer)?;
        }
        if let Some(colour) = mesh.colours.get(vertex) {
            writer.write_all(colour)?;
        }
    }
    Ok(())
}
