//! Wavefront OBJ: text, every digit kept; colours follow the coordinates, as most programs
//! read them. Metadata stand in comments.

use std::io::{self, Write};
use std::path::Path;

use super::{Mesh, comments};
use crate::{IfExists, IoError, Metadata, write_atomically};

/// Writes a mesh as OBJ.
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
        writeln!(writer, "# x east, y north, z up; metres")?;
        for comment in comments(metadata) {
            writeln!(writer, "# {comment}")?;
        }
        write_vertices(mesh, writer)?;
        write_faces(mesh, writer)
    })
}

fn write_vertices(mesh: &Mesh, writer: &mut impl Write) -> io::Result<()> {
    for (vertex, [x, y, z]) in mesh.positions.iter().enumerate() {
        write!(writer, "v {x} {y} {z}")?;
        if let Some(colour) = mesh.colours.get(vertex) {
            let [red, green, blue] = colour.map(|part| f32::from(part) / 255.0);
            write!(writer, " {red:.4} {green:.4} {blue:.4}")?;
        }
        writeln!(writer)?;
    }
    for [left, top] in &mesh.picture_positions {
        writeln!(writer, "vt {left} {}", 1.0 - top)?;
    }
    for [x, y, z] in &mesh.normals {
        writeln!(writer, "vn {x} {y} {z}")?;
    }
    Ok(())
}

fn write_faces(mesh: &Mesh, writer: &mut impl Write) -> io::Result<()> {
    for triangle in &mesh.triangles {
        write!(writer, "f")?;
        for vertex in triangle.map(|vertex| u64::from(vertex) + 1) {
            match (mesh.picture_positions.is_empty(), mesh.normals.is_empty()) {
                (true, true) => write!(writer, " {vertex}")?,
                (false, true) => write!(writer, " {vertex}/{vertex}")?,
                (true, false) => write!(writer, " {vertex}//{vertex}")?,
                (false, false) => write!(writer, " {vertex}/{vertex}/{vertex}")?,
            }
        }
        writeln!(writer)?;
    }
    Ok(())
}
