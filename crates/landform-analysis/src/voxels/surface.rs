//! The surface of a set of voxels as a mesh (thesis, section A.3).
//!
//! Faces between a filled and an empty voxel are quadrangles. Filled voxels hang together over edges,
//! so two empty ones that touch over an edge are walled each for itself; filled voxels that touch over
//! a corner only are apart. The thesis repairs vertices and edges that are no part of a surface after
//! it has merged them; here every corner of the grid makes as many vertices as walls hang together
//! around it ([`Corner`]), and there is nothing to repair but edges that two pairs of walls share with
//! both ends: these get a vertex in their middle, one for each pair.

use std::collections::BTreeMap;

use super::VoxelSet;
use super::fans::Corner;

/// A closed surface of triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Positions in voxels: x east, y north from the southern side, z up; voxel `[0, 0, 0]` of a block
    /// with n rows fills x from 0 to 1, y from n − 1 to n, z from 0 to 1.
    pub positions: Vec<[f64; 3]>,
    /// Three vertices each, counter-clockwise seen from the empty side.
    pub triangles: Vec<[u32; 3]>,
}

/// A surface of quadrangles on the way to one of triangles.
#[derive(Clone, Debug, Default)]
pub(super) struct Quads {
    pub positions: Vec<[f64; 3]>,
    /// Vertices counter-clockwise seen from the empty side.
    pub faces: Vec<[u32; 4]>,
    /// For each edge of each face, which begins at the vertex of the same number, what tells it from
    /// other edges between the same vertices: 0, or 1 more than the number of the empty voxel.
    pub pinched: Vec<[u32; 4]>,
}

/// The surface of a set with voxels as they are: a closed manifold, whose vertices lie on corners and
/// on some middles of edges.
///
/// The Euler characteristic of the set is half that of the surface, less the number of
/// [contacts over a corner](VoxelSet::corner_contacts).
pub fn surface(set: &VoxelSet) -> Surface {
    let quads = quads(set);
    let Quads { mut positions, faces, pinched } = quads;
    let mut triangles = Vec::with_capacity(2 * faces.len());
    let mut middles = BTreeMap::new();
    for (face, pinched) in faces.iter().zip(&pinched) {
        if pinched.iter().all(|&pinch| pinch == 0) {
            let [a, b, c, d] = *face;
            triangles.extend([[a, b, c], [a, c, d]]);
            continue;
        }
        let mut outline = Vec::with_capacity(8);
        for (index, (&from, &pinch)) in face.iter().zip(pinched).enumerate() {
            outline.push(from);
            if pinch > 0 {
                let to = face[(index + 1) % 4];
                let middle = middles.entry([from.min(to), from.max(to), pinch]);
                outline.push(*middle.or_insert_with(|| append_mean(&mut positions, &[from, to])));
            }
        }
        let heart = append_mean(&mut positions, face);
        for (index, &from) in outline.iter().enumerate() {
            triangles.push([heart, from, outline[(index + 1) % outline.len()]]);
        }
    }
    Surface { positions, triangles }
}

impl VoxelSet {
    /// Number of corners of the grid at which two voxels of the set touch, and nothing else does.
    pub fn corner_contacts(&self) -> usize {
        const OPPOSITE: [u8; 4] = [0b1000_0001, 0b0100_0010, 0b0010_0100, 0b0001_1000];
        let mut contacts = 0;
        for layer in 0..=self.size()[2] {
            each_corner(self, layer, |_, around| {
                contacts += usize::from(OPPOSITE.contains(&around));
            });
        }
        contacts
    }
}

/// Position of a new vertex in the middle of others.
fn append_mean(positions: &mut Vec<[f64; 3]>, of: &[u32]) -> u32 {
    let sum = |axis: usize| of.iter().map(|&vertex| positions[vertex as usize][axis]).sum::<f64>();
    let mean = [0, 1, 2].map(|axis| sum(axis) / of.len() as f64);
    positions.push(mean);
    positions.len() as u32 - 1
}

/// The faces between filled and empty voxels.
pub(super) fn quads(set: &VoxelSet) -> Quads {
    let [width, height, layers] = set.size();
    let mut weaver = Weaver {
        stride: width + 1,
        height,
        frame: [width + 2, height + 2],
        corners: std::array::from_fn(|_| vec![(0, 0); (width + 1) * (height + 1)]),
        quads: Quads::default(),
    };
    let mut bits = Vec::new();
    for layer in 0..=layers {
        weaver.begin(set, layer);
        for row in 1..=height {
            let [here, below] = [[row, layer + 1], [row, layer]].map(|place| set.row(place));
            weaver.walls(2, [row, layer + 1], below, here);
            if layer == 0 {
                continue;
            }
            // The voxels below this layer of corners: their walls to the west and to the north.
            let [here, north] = [[row, layer], [row - 1, layer]].map(|place| set.row(place));
            weaver.walls(1, [row, layer], north, here);
            shift(here, &mut bits);
            weaver.walls(0, [row, layer], &bits, here);
        }
        if layer > 0 {
            let [frame, last] = [[height + 1, layer], [height, layer]].map(|place| set.row(place));
            weaver.walls(1, [height + 1, layer], last, frame);
        }
    }
    weaver.quads
}

/// The bits of a row, each where the next voxel stands.
fn shift(row: &[u64], shifted: &mut Vec<u64>) {
    shifted.clear();
    let before = |word: usize| if word > 0 { row[word - 1] >> 63 } else { 0 };
    shifted.extend((0..row.len()).map(|word| row[word] << 1 | before(word)));
}

/// Makes faces, layer by layer of corners.
struct Weaver {
    /// Corners of a row.
    stride: usize,
    height: usize,
    /// Voxels of a row and rows of a layer, with the frame.
    frame: [usize; 2],
    /// First vertex of a corner and the voxels around it, for layers of even and of odd number.
    corners: [Vec<(u32, u8)>; 2],
    quads: Quads,
}

impl Weaver {
    /// Makes the vertices of a layer of corners.
    fn begin(&mut self, set: &VoxelSet, layer: usize) {
        let Self { stride, height, quads: Quads { positions, .. }, .. } = self;
        let corners = &mut self.corners[layer % 2];
        corners.fill((0, 0));
        each_corner(set, layer, |[column, row], around| {
            corners[column + *stride * row] = (positions.len() as u32, around);
            let position = [column as f64, (*height - row) as f64, layer as f64];
            let fans = usize::from(Corner::of(around).fans);
            positions.extend(std::iter::repeat_n(position, fans));
        });
    }

    /// Adds the walls across an axis between the voxels of a framed row and those before them.
    fn walls(&mut self, axis: usize, [row, layer]: [usize; 2], before: &[u64], here: &[u64]) {
        for word in 0..here.len() {
            let mut walls = before[word] ^ here[word];
            while walls != 0 {
                let bit = walls.trailing_zeros() as usize;
                walls &= walls - 1;
                let near_is_filled = before[word] >> bit & 1 == 1;
                self.wall(axis, [word * 64 + bit, row, layer], near_is_filled);
            }
        }
    }

    /// Adds the wall between a framed voxel and the one before it along an axis.
    fn wall(&mut self, axis: usize, far: [usize; 3], near_is_filled: bool) {
        let [across, up] = [(axis + 1) % 3, (axis + 2) % 3];
        let [mut face, mut pinched] = [[0; 4]; 2];
        let mut met = [Corner::of(0); 4];
        for (index, [s, t]) in [[0, 0], [1, 0], [1, 1], [0, 1]].into_iter().enumerate() {
            let mut corner = far.map(|at| at - 1);
            corner[across] = far[across] + s - 1;
            corner[up] = far[up] + t - 1;
            let (first, around) = self.corners[corner[2] % 2][corner[0] + self.stride * corner[1]];
            met[index] = Corner::of(around);
            let fan = met[index].fan_of[4 * axis + (1 - s) + 2 * (1 - t)];
            face[index] = first + u32::from(fan);
        }
        let mut empty = far;
        empty[axis] -= usize::from(!near_is_filled);
        let number = empty[0] + self.frame[0] * (empty[1] + self.frame[1] * empty[2]);
        // Edges by the corners where they begin and end, along the axis.
        let edges = [(0, 1, across), (1, 2, up), (3, 2, across), (0, 3, up)];
        for (index, (from, to, along)) in edges.into_iter().enumerate() {
            let pinch = met[from].pinched >> (along + 3) & met[to].pinched >> along & 1;
            pinched[index] = if pinch == 1 { number as u32 + 1 } else { 0 };
        }
        // Rows run south: what is counter-clockwise by numbers is clockwise on the map.
        if near_is_filled {
            face = [face[0], face[3], face[2], face[1]];
            pinched.reverse();
        }
        self.quads.faces.push(face);
        self.quads.pinched.push(pinched);
    }
}

/// Calls `visit` for every corner of a layer of corners around which voxels are filled and others
/// empty, with its column and row and the bits of the voxels around it.
fn each_corner(set: &VoxelSet, layer: usize, mut visit: impl FnMut([usize; 2], u8)) {
    for row in 0..=set.size()[1] {
        let places = [[row, layer], [row + 1, layer], [row, layer + 1], [row + 1, layer + 1]];
        let rows = places.map(|place| set.row(place));
        for word in 0..rows[0].len() {
            // Bits of the voxels before corners, and of those after them.
            let here = rows.map(|row| row[word]);
            let next = rows.map(|row| row.get(word + 1).map_or(0, |bits| bits << 63));
            let after = [0, 1, 2, 3].map(|row| here[row] >> 1 | next[row]);
            let any = here.iter().chain(&after).fold(0, |any, bits| any | bits);
            let all = here.iter().chain(&after).fold(u64::MAX, |all, bits| all & bits);
            let mut mixed = any & !all;
            while mixed != 0 {
                let bit = mixed.trailing_zeros() as usize;
                mixed &= mixed - 1;
                let around = (0..4).fold(0, |around, row| {
                    let two = here[row] >> bit & 1 | (after[row] >> bit & 1) << 1;
                    around | (two as u8) << (2 * row)
                });
                visit([word * 64 + bit, row], around);
            }
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::voxels::tests::cave;

    /// Asserts that every edge has two triangles that run along it in opposite directions, and that
    /// the triangles of every vertex make one ring; returns the Euler characteristic.
    pub(in crate::voxels) fn checked(surface: &Surface) -> i64 {
        let mut half_edges = BTreeMap::new();
        for (number, triangle) in surface.triangles.iter().enumerate() {
            for turn in 0..3 {
                let edge = [triangle[turn], triangle[(turn + 1) % 3]];
                assert_ne!(edge[0], edge[1]);
                assert!(half_edges.insert(edge, number).is_none(), "an edge runs twice one way");
            }
        }
        let mut degrees = vec![0; surface.positions.len()];
        for &[from, to] in half_edges.keys() {
            assert!(half_edges.contains_key(&[to, from]), "an edge is open");
            degrees[from as usize] += 1;
        }
        let mut started = vec![false; degrees.len()];
        for triangle in &surface.triangles {
            for turn in 0..3 {
                let (vertex, start) = (triangle[turn], triangle[(turn + 1) % 3]);
                if std::mem::replace(&mut started[vertex as usize], true) {
                    continue;
                }
                let (mut ring, mut to) = (0, start);
                loop {
                    let other = surface.triangles[half_edges[&[to, vertex]]];
                    let place = other.iter().position(|&v| v == vertex).unwrap();
                    (ring, to) = (ring + 1, other[(place + 1) % 3]);
                    if to == start {
                        break;
                    }
                }
                assert_eq!(ring, degrees[vertex as usize], "a vertex has two rings");
            }
        }
        assert!(started.iter().all(|&started| started), "a vertex without triangles");
        let [vertices, edges, faces] =
            [degrees.len(), half_edges.len() / 2, surface.triangles.len()];
        vertices as i64 - edges as i64 + faces as i64
    }

    /// Volume inside, in voxels, by the divergence theorem.
    pub(in crate::voxels) fn volume(surface: &Surface) -> f64 {
        let at = |vertex: u32| surface.positions[vertex as usize];
        let cone = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(at);
            (a[0] * (b[1] * c[2] - b[2] * c[1])
                + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0]))
                / 6.0
        };
        surface.triangles.iter().map(cone).sum()
    }

    #[test]
    fn surfaces_are_closed_manifolds_with_the_topology_and_volume_of_the_set() {
        for seed in 0..4 {
            let set = cave([40, 33, 70 - 40], seed);
            let surface = surface(&set);
            let characteristic = checked(&surface);
            assert!(set.corner_contacts() > 0, "the case is in the test");
            let contacts = set.corner_contacts() as i64;
            assert_eq!(set.euler_characteristic(), characteristic / 2 - contacts);
            assert!((volume(&surface) - set.len() as f64).abs() < 1e-6);
        }
    }

    #[test]
    fn edges_that_two_pairs_share_get_two_middles() {
        // Two filled voxels over an edge: a ring of eight walls would share the edge with both ends.
        let set = VoxelSet::new([2, 2, 1], |[x, y, _]| x == y);
        let surface = surface(&set);
        assert_eq!(checked(&surface), 2, "one ball, joined over the edge");
        assert_eq!(surface.positions.len(), 14 + 2 + 4, "corners, middles, hearts of four walls");
    }

    #[test]
    fn a_voxel_lies_where_its_row_lies_north_of_the_last() {
        let set = VoxelSet::new([3, 4, 2], |voxel| voxel == [2, 0, 1]);
        let surface = surface(&set);
        let bounds = [0, 1, 2].map(|axis| {
            let along = surface.positions.iter().map(|position| position[axis]);
            [along.clone().fold(f64::MAX, f64::min), along.fold(f64::MIN, f64::max)]
        });
        assert_eq!(bounds, [[2.0, 3.0], [3.0, 4.0], [1.0, 2.0]]);
        assert_eq!((volume(&surface), surface.triangles.len()), (1.0, 12));
    }
}
