//! The surface of a field of heights.

use super::Mesh;
use crate::{Fault, Raster};

/// Missing cells have no vertex.
const NONE: u32 = u32::MAX;

/// The surface of a raster of heights, a vertex at each cell that has data, `spacing_m` metres
/// apart; the south-west node is at x = y = 0, as in `landform_graph::Lattice::position`.
///
/// The triangles are those of the 4-8 mesh (thesis, section 2.5): diagonals alternate, so that
/// nodes whose row and column add to an even number join eight edges. The mesh has normals and
/// picture positions; colours are for the caller to add, in the order of
/// `raster.values` without the missing cells.
///
/// # Errors
/// [`Fault`]: sizes that contradict each other, an infinite height, a spacing that is no
/// positive length, or no four neighbouring cells with three heights.
pub fn height_mesh(raster: &Raster, spacing_m: f64) -> Result<Mesh, Fault> {
    raster.check_size()?;
    if !(spacing_m > 0.0 && spacing_m.is_finite()) {
        let problem = format!("the spacing is {spacing_m} m");
        return Err(Fault::new(problem, "a positive finite length", "correct the spacing"));
    }
    if raster.values.len() >= NONE as usize {
        let problem = format!("{} cells", raster.values.len());
        return Err(Fault::new(problem, "fewer than 2^32", "cut out or resample a part"));
    }
    let mut mesh = Mesh::default();
    let vertices = place_vertices(raster, spacing_m, &mut mesh);
    for row in 1..raster.height {
        for column in 1..raster.width {
            let south_east = column + row * raster.width;
            let north_east = south_east - raster.width;
            let [nw, ne, sw, se] =
                [north_east - 1, north_east, south_east - 1, south_east].map(|cell| vertices[cell]);
            let pair = match (row + column) % 2 {
                0 => [[nw, sw, se], [nw, se, ne]],
                _ => [[nw, sw, ne], [sw, se, ne]],
            };
            mesh.triangles.extend(pair.iter().filter(|triangle| !triangle.contains(&NONE)));
        }
    }
    mesh.check()?;
    Ok(mesh.with_normals())
}

/// Adds a vertex for each cell with data; the result numbers them by cell.
fn place_vertices(raster: &Raster, spacing_m: f64, mesh: &mut Mesh) -> Vec<u32> {
    let [across, down] = raster.size().map(|size| size.saturating_sub(1).max(1) as f32);
    let vertex = |(cell, &height): (usize, &f64)| {
        if height.is_nan() {
            return NONE;
        }
        let [column, row] = [cell % raster.width, cell / raster.width];
        let north = (raster.height - 1 - row) as f64 * spacing_m;
        mesh.positions.push([column as f64 * spacing_m, north, height]);
        mesh.picture_positions.push([column as f32 / across, row as f32 / down]);
        (mesh.positions.len() - 1) as u32
    };
    raster.values.iter().enumerate().map(vertex).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn raster(width: usize, height: usize, value: impl Fn(usize, usize) -> f64) -> Raster {
        let values = (0..width * height).map(|cell| value(cell % width, cell / width)).collect();
        Raster::local(width, height, 1.0, values)
    }

    #[test]
    fn even_nodes_join_eight_edges_and_odd_ones_four() {
        let mesh = height_mesh(&raster(5, 5, |_, _| 0.0), 1.0).unwrap();
        let around = |node: u32| mesh.triangles.iter().filter(|t| t.contains(&node)).count();
        for row in 1..4 {
            for column in 1..4 {
                let expected = if (row + column) % 2 == 0 { 8 } else { 4 };
                assert_eq!(around((column + 5 * row) as u32), expected, "{column} {row}");
            }
        }
    }

    /// The plane z = 2 x - y has the normal (-2, 1, 1) / sqrt(6), whatever the triangles.
    #[test]
    fn a_tilted_plane_has_its_normal_and_area() {
        let plane = raster(4, 3, |column, row| 2.0 * column as f64 - (2 - row) as f64);
        let mesh = height_mesh(&plane, 1.0).unwrap();
        let root = 6.0_f32.sqrt();
        for normal in &mesh.normals {
            for (part, expected) in normal.iter().zip([-2.0 / root, 1.0 / root, 1.0 / root]) {
                assert!((part - expected).abs() < 1e-6, "{normal:?}");
            }
        }
        let corner = |triangle: &[u32; 3]| triangle.map(|vertex| mesh.positions[vertex as usize]);
        let doubled: f64 =
            mesh.triangles.iter().map(|t| super::super::area_normal(corner(t))[2]).sum();
        assert_eq!(doubled, 2.0 * 3.0 * 2.0, "area on the map");
    }

    #[test]
    fn missing_cells_are_holes() {
        let hole = raster(4, 4, |column, row| if (column, row) == (1, 1) { f64::NAN } else { 0.0 });
        let mesh = height_mesh(&hole, 1.0).unwrap();
        assert_eq!(mesh.positions.len(), 15);
        assert_eq!(mesh.triangles.len(), 18 - 8);
        assert_eq!(mesh.positions[0], [0.0, 3.0, 0.0]);
        let message = height_mesh(&raster(3, 1, |_, _| 0.0), 1.0).unwrap_err().to_string();
        assert!(message.contains("no triangle"), "{message}");
    }
}
