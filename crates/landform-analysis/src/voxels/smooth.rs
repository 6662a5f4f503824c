//! Smooth surfaces of voxels by 4-8 subdivision (thesis, sections 2.1.5 and A.3; Velho and Zorin
//! 2001).
//!
//! A step puts a vertex in the middle of every face and moves the others half-way to the mean of
//! their neighbours over edges; the new faces have two old and two new vertices each, one face for
//! every edge. Walls that two pairs share with both ends come apart at the first step, so the surface
//! is a closed manifold with the topology of the blocks.

use super::VoxelSet;
use super::surface::{Quads, Surface, quads};

/// The surface of a set after some steps of 4-8 subdivision; each doubles the number of faces.
///
/// One step rounds corners, three leave no trace of the blocks; with none it is
/// [`surface`](super::surface()).
pub fn smooth_surface(set: &VoxelSet, steps: usize) -> Surface {
    if steps == 0 {
        return super::surface(set);
    }
    let mut mesh = quads(set);
    for _ in 0..steps {
        mesh = subdivided(&mesh);
    }
    // Along new vertices: old ones may be the ends of two edges.
    let triangles = mesh.faces.iter().flat_map(|&[a, b, c, d]| [[a, b, d], [b, c, d]]).collect();
    Surface { positions: mesh.positions, triangles }
}

/// One step of subdivision.
fn subdivided(mesh: &Quads) -> Quads {
    let edges = edges(mesh);
    let old = mesh.positions.len();
    // Twice the mean of neighbours over edges, and their number.
    let mut sums = vec![[0.0; 4]; old];
    for edge in &edges {
        for [at, other] in [edge.ends, [edge.ends[1], edge.ends[0]]] {
            let sum = &mut sums[at as usize];
            let other = mesh.positions[other as usize];
            *sum = [sum[0] + other[0], sum[1] + other[1], sum[2] + other[2], sum[3] + 1.0];
        }
    }
    let moved =
        mesh.positions.iter().zip(&sums).map(|(position, sum)| {
            [0, 1, 2].map(|axis| (position[axis] + sum[axis] / sum[3]) / 2.0)
        });
    let middles = mesh.faces.iter().map(|face| {
        let corners = face.map(|vertex| mesh.positions[vertex as usize]);
        [0, 1, 2].map(|axis| corners.iter().map(|corner| corner[axis]).sum::<f64>() / 4.0)
    });
    let positions = moved.chain(middles).collect();
    let middle = |face: usize| (old + face) as u32;
    let faces: Vec<[u32; 4]> = edges
        .iter()
        .map(|edge| [edge.ends[0], middle(edge.right), edge.ends[1], middle(edge.left)])
        .collect();
    let pinched = vec![[0; 4]; faces.len()];
    Quads { positions, faces, pinched }
}

/// An edge with the face that runs along it and the one that runs against it.
struct Edge {
    ends: [u32; 2],
    left: usize,
    right: usize,
}

/// The edges of a closed mesh, in order of their ends.
fn edges(mesh: &Quads) -> Vec<Edge> {
    let mut halves = Vec::with_capacity(4 * mesh.faces.len());
    for (number, (face, pinched)) in mesh.faces.iter().zip(&mesh.pinched).enumerate() {
        for turn in 0..4 {
            let [from, to] = [face[turn], face[(turn + 1) % 4]];
            halves.push((from.min(to), from.max(to), pinched[turn], from > to, number));
        }
    }
    halves.sort_unstable();
    let pairs = halves.chunks_exact(2);
    pairs
        .map(|pair| Edge { ends: [pair[0].0, pair[0].1], left: pair[0].4, right: pair[1].4 })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::voxels::surface::tests::{checked, volume};
    use crate::voxels::tests::cave;

    #[test]
    fn smooth_surfaces_are_closed_manifolds_with_the_topology_of_the_set() {
        for seed in 0..2 {
            let set = cave([24, 20, 22], seed);
            for steps in 1..4 {
                let surface = smooth_surface(&set, steps);
                let contacts = set.corner_contacts() as i64;
                assert_eq!(checked(&surface) / 2 - contacts, set.euler_characteristic());
            }
        }
    }

    #[test]
    fn a_ball_becomes_round() {
        let inside = |[x, y, z]: [usize; 3]| {
            [x, y, z].iter().map(|&at| (at as f64 - 9.5).powi(2)).sum::<f64>() < 81.0
        };
        let set = VoxelSet::new([20; 3], inside);
        let surface = smooth_surface(&set, 3);
        let radius =
            |position: &[f64; 3]| position.iter().map(|at| (at - 10.0).powi(2)).sum::<f64>().sqrt();
        let radii: Vec<f64> = surface.positions.iter().map(radius).collect();
        let [low, high] = [
            radii.iter().copied().fold(f64::MAX, f64::min),
            radii.iter().copied().fold(0.0, f64::max),
        ];
        assert!(high - low < 1.0, "{low} to {high}");
        let share = volume(&surface) / set.len() as f64;
        assert!((0.95..1.0).contains(&share), "{share}");
    }
}
