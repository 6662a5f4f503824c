//! Binary STL: bare triangles for printers, without unit or colour. The header has room for 80
//! letters of metadata.

use std::io::Write;
use std::path::Path;

use super::{Body, area_normal, check_all, comments, unit};
use crate::{Fault, IfExists, IoError, Metadata, write_atomically};

/// Writes the triangles of meshes as STL.
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
    let total: usize = bodies.iter().map(|body| body.mesh.triangles.len()).sum();
    let count = u32::try_from(total).map_err(|_| {
        let problem = format!("{total} triangles");
        Fault::new(problem, "fewer than 2^32", "write a part").writing(path)
    })?;
    // A header that starts with "solid" would be taken for text.
    let comments: Vec<String> = comments(metadata).collect();
    let mut header = format!("metres; {}", comments.join("; ")).into_bytes();
    header.resize(80, 0);
    write_atomically(path, if_exists, |writer| {
        writer.write_all(&header)?;
        writer.write_all(&count.to_le_bytes())?;
        let triangles = bodies.iter().flat_map(|Body { mesh, .. }| {
            let corners = |vertex: u32| mesh.positions[vertex as usize];
            mesh.triangles.iter().map(move |triangle| triangle.map(corners))
        });
        for corners in triangles {
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
