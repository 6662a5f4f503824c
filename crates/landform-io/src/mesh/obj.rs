//! Wavefront OBJ: text, every digit kept; colours follow the coordinates, as most programs
//! read them. Metadata stand in comments.

use std::io::{self, Write};
use std::path::Path;

use super::{Body, Mesh, check_all, comments, numbered};
use crate::{IfExists, IoError, Metadata, write_atomically};

/// Writes meshes as OBJ, an object each.
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
    write_atomically(path, if_exists, |writer| {
        writeln!(writer, "# x east, y north, z up; metres")?;
        for comment in comments(metadata) {
            writeln!(writer, "# {comment}")?;
        }
        // Lists that only some meshes have would be numbered otherwise than vertices.
        let all = |has: fn(&Mesh) -> bool| bodies.iter().all(|body| has(body.mesh));
        let lists = Lists {
            picture_positions: all(|mesh| !mesh.picture_positions.is_empty()),
            normals: all(|mesh| !mesh.normals.is_empty()),
        };
        numbered(bodies).try_for_each(|(first, Body { name, mesh })| {
            writeln!(writer, "o {name}")?;
            write_vertices(mesh, lists, writer)?;
            write_faces(mesh, first, lists, writer)
        })
    })
}

/// Which lists all meshes of the file have.
#[derive(Clone, Copy)]
struct Lists {
    picture_positions: bool,
    normals: bool,
}

fn write_vertices(mesh: &Mesh, lists: Lists, writer: &mut impl Write) -> io::Result<()> {
    for (vertex, [x, y, z]) in mesh.positions.iter().enumerate() {
        write!(writer, "v {x} {y} {z}")?;
        if let Some(colour) = mesh.colours.get(vertex) {
            let [red, green, blue] = colour.map(|part| f32::from(part) / 255.0);
            write!(writer, " {red:.4} {green:.4} {blue:.4}")?;
        }
        writeln!(writer)?;
    }
    for [left, top] in mesh.picture_positions.iter().filter(|_| lists.picture_positions) {
        writeln!(writer, "vt {left} {}", 1.0 - top)?;
    }
    for [x, y, z] in mesh.normals.iter().filter(|_| lists.normals) {
        writeln!(writer, "vn {x} {y} {z}")?;
    }
    Ok(())
}

fn write_faces(mesh: &Mesh, first: u32, lists: Lists, writer: &mut impl Write) -> io::Result<()> {
    for triangle in &mesh.triangles {
        write!(writer, "f")?;
        for vertex in triangle.map(|vertex| u64::from(first) + u64::from(vertex) + 1) {
            match (lists.picture_positions, lists.normals) {
                (false, false) => write!(writer, " {vertex}")?,
                (true, false) => write!(writer, " {vertex}/{vertex}")?,
                (false, true) => write!(writer, " {vertex}//{vertex}")?,
                (true, true) => write!(writer, " {vertex}/{vertex}/{vertex}")?,
            }
        }
        writeln!(writer)?;
    }
    Ok(())
}
