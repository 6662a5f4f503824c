//! Triangle meshes for renderers and printers: OBJ, PLY, GLB and STL.
//!
//! A [`Mesh`] has x east, y north and z up, in metres. OBJ, PLY and STL keep that; GLB turns
//! it to y up, as glTF demands. A file may hold several, ground and water say: a [`Body`] each.

pub mod glb;
mod height;
pub mod obj;
pub mod ply;
pub mod stl;

use std::path::Path;

use crate::files::{extension, unknown};
use crate::{Fault, IfExists, IoError, Metadata};

pub use height::height_mesh;

/// Vertices and the triangles that join them.
///
/// The lists besides positions and triangles are empty, or have one entry for each vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// x (east), y (north), z (up) in metres. GLB, PLY and STL store singles, so keep
    /// coordinates local.
    pub positions: Vec<[f64; 3]>,
    /// Unit normals.
    pub normals: Vec<[f32; 3]>,
    /// Red, green and blue as in pictures (sRGB).
    pub colours: Vec<[u8; 3]>,
    /// How much of what lies behind is hidden: 0 is clear, 255 opaque. Opaque where empty. GLB and
    /// PLY keep it.
    pub opacities: Vec<u8>,
    /// Position in a picture to be draped over: from the left and from the top, in 0..=1.
    pub picture_positions: Vec<[f32; 2]>,
    /// Three vertices each, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Sets the normals to the mean of the triangles around each vertex, weighted by area.
    /// A vertex without triangles gets one that points up.
    #[must_use]
    pub fn with_normals(mut self) -> Self {
        let mut sums = vec![[0.0; 3]; self.positions.len()];
        for triangle in &self.triangles {
            let normal = area_normal(triangle.map(|vertex| self.positions[vertex as usize]));
            for vertex in triangle {
                let sum = &mut sums[*vertex as usize];
                *sum = [0, 1, 2].map(|axis| sum[axis] + normal[axis]);
            }
        }
        self.normals = sums.into_iter().map(unit).collect();
        self
    }

    /// Checks that the lists fit each other, before anything is written.
    fn check(&self) -> Result<(), Fault> {
        let count = self.positions.len();
        if self.triangles.is_empty() {
            let advice = "check that the field has neighbouring cells with data";
            return Err(Fault::new("the mesh has no triangle", "at least one", advice));
        }
        if u32::try_from(count).is_err() {
            let advice = "write a part, or a coarser mesh";
            return Err(Fault::new(format!("{count} vertices"), "fewer than 2^32", advice));
        }
        for (name, length) in [
            ("normals", self.normals.len()),
            ("colours", self.colours.len()),
            ("opacities", self.opacities.len()),
            ("picture positions", self.picture_positions.len()),
        ] {
            if length != 0 && length != count {
                let problem = format!("{length} {name} for {count} vertices");
                return Err(Fault::new(problem, "none, or one each", "make them agree"));
            }
        }
        let outside = |triangle: &&[u32; 3]| triangle.iter().any(|&v| v as usize >= count);
        if let Some(triangle) = self.triangles.iter().find(outside) {
            let problem = format!("a triangle joins the vertices {triangle:?} of {count}");
            return Err(Fault::new(problem, "vertices of the mesh", "correct the triangles"));
        }
        // Most formats store singles.
        let wild = |position: &[f64; 3]| !position.iter().all(|&v| (v as f32).is_finite());
        if let Some(vertex) = self.positions.iter().position(wild) {
            let problem = format!("vertex {vertex} lies at {:?}", self.positions[vertex]);
            return Err(Fault::new(problem, "finite coordinates", "correct the field"));
        }
        Ok(())
    }
}

/// A mesh and its name in a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body<'m> {
    /// Name in GLB and OBJ.
    pub name: &'m str,
    /// The mesh.
    pub mesh: &'m Mesh,
}

/// Checks the meshes of a file; their vertices are numbered one after another.
fn check_all(bodies: &[Body<'_>]) -> Result<(), Fault> {
    bodies.iter().try_for_each(|body| body.mesh.check())?;
    let count: usize = bodies.iter().map(|body| body.mesh.positions.len()).sum();
    match (bodies.is_empty(), u32::try_from(count)) {
        (true, _) => Err(Fault::new("no mesh at all", "at least one", "name a mesh")),
        (_, Err(_)) => {
            let advice = "write a part, or coarser meshes";
            Err(Fault::new(format!("{count} vertices"), "fewer than 2^32", advice))
        }
        _ => Ok(()),
    }
}

/// Meshes with the number of their first vertex among those of all.
fn numbered<'b>(bodies: &'b [Body<'b>]) -> impl Iterator<Item = (u32, &'b Body<'b>)> {
    bodies.iter().scan(0, |next, body| {
        let first = *next;
        *next += body.mesh.positions.len() as u32;
        Some((first, body))
    })
}

/// Normal of a triangle, as long as twice its area.
fn area_normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let [u, v] = [b, c].map(|corner| [0, 1, 2].map(|axis| corner[axis] - a[axis]));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

fn unit(vector: [f64; 3]) -> [f32; 3] {
    let length = vector.iter().map(|part| part * part).sum::<f64>().sqrt();
    match length > 0.0 && length.is_finite() {
        true => vector.map(|part| (part / length) as f32),
        false => [0.0, 0.0, 1.0],
    }
}

/// Writes a mesh, as the ground, in the format that the extension names: see [`write_meshes`].
///
/// # Errors
/// As [`write_meshes`].
pub fn write_mesh(
    path: impl AsRef<Path>,
    mesh: &Mesh,
    metadata: &Metadata,
    if_exists: IfExists,
) -> Result<(), IoError> {
    write_meshes(path, &[Body { name: "ground", mesh }], metadata, if_exists)
}

/// Writes meshes in the format that the extension names: `.obj`, `.ply`, `.glb` or `.stl`. GLB and
/// OBJ keep them apart by their names, PLY and STL make one of them.
///
/// # Errors
/// [`IoError`]: an unknown extension, a mesh that contradicts itself, or an output that is
/// there already or cannot be written.
pub fn write_meshes(
    path: impl AsRef<Path>,
    bodies: &[Body<'_>],
    metadata: &Metadata,
    if_exists: IfExists,
) -> Result<(), IoError> {
    let path = path.as_ref();
    match extension(path).as_str() {
        "obj" => obj::write(path, bodies, metadata, if_exists),
        "ply" => ply::write(path, bodies, metadata, if_exists),
        "glb" => glb::write(path, bodies, metadata, if_exists),
        "stl" => stl::write(path, bodies, metadata, if_exists),
        other => Err(unknown(path, other, ".obj, .ply, .glb, .stl")),
    }
}

/// Metadata as lines of text without line breaks.
fn comments(metadata: &Metadata) -> impl Iterator<Item = String> {
    let entries = metadata.entries().into_iter();
    entries.map(|(name, text)| format!("{name}: {text}").replace(['\n', '\r'], " "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh() -> Mesh {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        Mesh { positions, triangles: vec![[0, 1, 2]], ..Mesh::default() }
    }

    #[test]
    fn contradictions_are_named() {
        let message = |change: fn(&mut Mesh)| {
            let mut mesh = mesh();
            change(&mut mesh);
            mesh.check().unwrap_err().to_string()
        };
        assert!(message(|mesh| mesh.triangles.clear()).contains("no triangle"));
        assert!(message(|mesh| mesh.triangles[0][1] = 3).contains("[0, 3, 2] of 3"));
        assert!(message(|mesh| mesh.positions[1][2] = f64::NAN).contains("vertex 1"));
        assert!(message(|mesh| mesh.colours.push([0; 3])).contains("1 colours for 3 vertices"));
        assert_eq!(mesh().check(), Ok(()));
    }

    #[test]
    fn normals_point_out_of_counter_clockwise_triangles() {
        assert_eq!(mesh().with_normals().normals, [[0.0, 0.0, 1.0]; 3]);
    }
}
