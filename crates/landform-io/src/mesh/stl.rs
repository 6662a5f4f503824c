//! Binary STL: bare triangles for printers, without unit or colour. The header has room for 80
//! letters of metadata.

use std::io::Write;
use std::path::Path;

use super::{Mesh, area_normal, comments, unit};
use crate::{Fault, IfExists, IoError, Metadata, write_atomically};

/// Writes the triangles of a mesh as STL.
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
    let count = u32::try_from(mesh.triangles.len()).map_err(|_| {
        let problem = format!("{} triangles", mesh.triangles.len());
        Fault::new(problem, "fewer than 2^32", "write a part").writing(path)
    })?;
    // A header that starts with "solid" would be taken for text.
    let comments: Vec<String> = comments(metadata).collect();
    let mut header = format!("metres; {}", comments.join("; ")).into_bytes();
    header.resize(80, 0);
    write_atomically(path, if_exists, |writer| {
        writer.write_all(&header)?;
        writer.write_all(&count.to_le_bytes())?;
        for triangle in &mesh.triangles {
            let corners = triangle.map(|vertex| mesh.positions[vertex as usize]);
            let normal = unit(area_normal(corners));
            let corners = corners.as_flattened().iter().map(|&part| part as f32);
            for number in normal.into_iter().chain(corners) {
                writer.write_all(&number.to_le_bytes())?;
            }
            writer.write_all(&[0; 2])?;
        }
        Ok(())
    })
}
