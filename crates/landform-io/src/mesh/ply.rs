//! Stanford PLY: binary, little endian. Metadata stand in comments.

use std::io::{self, Write};
use std::path::Path;

use super::{Body, Mesh, check_all, comments, numbered};
use crate::{IfExists, IoError, Metadata, write_atomically};

/// Writes meshes as one PLY.
///
/// # Errors
/// [`IoError`]: a mesh contradicts itself, or the output cannot be written.
pub fn write(
    path: &Path,
    bodies: &[Body<'_>],
    metadata: &Metadata,
    if_exists: IfExists,
) -> Result<(), IoError> {
    check_all(bodies).map_err(|fault| fault.writing(path))?;
    let lists = Lists::of(bodies);
    write_atomically(path, if_exists, |writer| {
        write_header(bodies, lists, metadata, writer)?;
        bodies.iter().try_for_each(|body| write_vertices(body.mesh, lists, writer))?;
        for (first, body) in numbered(bodies) {
            for triangle in &body.mesh.triangles {
                writer.write_all(&[3])?;
                let vertices = triangle.map(|vertex| (first + vertex).to_le_bytes());
                writer.write_all(vertices.as_flattened())?;
            }
        }
        Ok(())
    })
}

/// Which lists the file has: those that all meshes have, and opacities if one does.
#[derive(Clone, Copy)]
struct Lists {
    normals: bool,
    picture_positions: bool,
    colours: bool,
    opacities: bool,
}

impl Lists {
    fn of(bodies: &[Body<'_>]) -> Self {
        let all = |has: fn(&Mesh) -> bool| bodies.iter().all(|body| has(body.mesh));
        Self {
            normals: all(|mesh| !mesh.normals.is_empty()),
            picture_positions: all(|mesh| !mesh.picture_positions.is_empty()),
            colours: all(|mesh| !mesh.colours.is_empty()),
            opacities: !all(|mesh| mesh.opacities.is_empty()),
        }
    }
}

fn write_header(
    bodies: &[Body<'_>],
    lists: Lists,
    metadata: &Metadata,
    writer: &mut impl Write,
) -> io::Result<()> {
    let count = |of: fn(&Mesh) -> usize| bodies.iter().map(|body| of(body.mesh)).sum::<usize>();
    let vertices = count(|mesh| mesh.positions.len());
    writeln!(writer, "ply\nformat binary_little_endian 1.0")?;
    writeln!(writer, "comment x east, y north, z up; metres")?;
    for comment in comments(metadata) {
        writeln!(writer, "comment {comment}")?;
    }
    writeln!(writer, "element vertex {vertices}")?;
    let properties: [(bool, &str, &[&str]); 5] = [
        (true, "float", &["x", "y", "z"]),
        (lists.normals, "float", &["nx", "ny", "nz"]),
        (lists.picture_positions, "float", &["s", "t"]),
        (lists.colours, "uchar", &["red", "green", "blue"]),
        (lists.opacities, "uchar", &["alpha"]),
    ];
    for (_, kind, names) in properties.iter().filter(|property| property.0) {
        for name in *names {
            writeln!(writer, "property {kind} {name}")?;
        }
    }
    // Signed indices are what every reader understands; they suffice for 2^31 vertices.
    let index = if vertices > i32::MAX as usize { "uint" } else { "int" };
    writeln!(writer, "element face {}", count(|mesh| mesh.triangles.len()))?;
    writeln!(writer, "property list uchar {index} vertex_indices\nend_header")
}

fn write_vertices(mesh: &Mesh, lists: Lists, writer: &mut impl Write) -> io::Result<()> {
    let singles = |numbers: &[f32], writer: &mut _| {
        numbers.iter().try_for_each(|number| Write::write_all(writer, &number.to_le_bytes()))
    };
    for (vertex, position) in mesh.positions.iter().enumerate() {
        singles(&position.map(|part| part as f32), writer)?;
        if lists.normals {
            singles(&mesh.normals[vertex], writer)?;
        }
        if lists.picture_positions {
            let [left, top] = mesh.picture_positions[vertex];
            singles(&[left, 1.0 - top], writer)?;
        }
        if lists.colours {
            writer.write_all(&mesh.colours[vertex])?;
        }
        if lists.opacities {
            writer.write_all(&[mesh.opacities.get(vertex).copied().unwrap_or(u8::MAX)])?;
        }
    }
    Ok(())
}
