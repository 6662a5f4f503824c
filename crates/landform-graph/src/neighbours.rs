//! The edges of a lattice, computed from the coordinates of a node.

use crate::{Connectivity, Lattice};

/// A directed edge from a node to one of its neighbours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Index of the neighbour.
    pub node: usize,
    /// Steps along x (east), y (south: one row on) and z (up) that lead to it.
    pub step: [i8; 3],
    /// Number of that step in the order of [`Lattice::neighbours`]: the same at every node.
    pub direction: u8,
    /// Length of the edge in metres.
    pub distance: f64,
}

/// Steps to the neighbours of a 2-D node: the axes first, then the diagonals.
const PLANE_STEPS: [[i8; 3]; 8] =
    [[1, 0, 0], [0, -1, 0], [-1, 0, 0], [0, 1, 0], [1, -1, 0], [-1, -1, 0], [-1, 1, 0], [1, 1, 0]];

/// Steps to the neighbours of a voxel: those over faces, then edges, then corners.
const VOLUME_STEPS: [[i8; 3]; 26] = volume_steps();

const fn volume_steps() -> [[i8; 3]; 26] {
    let mut steps = [[0; 3]; 26];
    let mut count = 0;
    let mut axes_moved = 1;
    while axes_moved <= 3 {
        let mut code: i8 = 0;
        while code < 27 {
            let step = [code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1];
            if squared_length(step) == axes_moved {
                steps[count] = step;
                count += 1;
            }
            code += 1;
        }
        axes_moved += 1;
    }
    steps
}

/// Squared length of a step in node spacings.
const fn squared_length(step: [i8; 3]) -> i32 {
    let [x, y, z] = [step[0] as i32, step[1] as i32, step[2] as i32];
    x * x + y * y + z * z
}

/// The edges that leave a node, in a fixed order: see [`Lattice::neighbours`].
#[derive(Clone, Debug)]
pub struct Neighbours<'a> {
    lattice: &'a Lattice,
    node: usize,
    origin: [usize; 3],
    /// No step leads over a border, so indices need neither wrapping nor checking.
    interior: bool,
    stencil: std::slice::Iter<'a, Edge>,
}

impl<'a> Neighbours<'a> {
    pub(crate) fn lattice(&self) -> &'a Lattice {
        self.lattice
    }
}

impl Iterator for Neighbours<'_> {
    type Item = Edge;

    #[inline]
    fn next(&mut self) -> Option<Edge> {
        if self.interior {
            let edge = self.stencil.next()?;
            return Some(Edge { node: self.node.wrapping_add(edge.node), ..*edge });
        }
        loop {
            let edge = self.stencil.next()?;
            if let Some(node) = self.lattice.offset(self.origin, edge.step.map(isize::from)) {
                return Some(Edge { node, ..*edge });
            }
        }
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let most = self.stencil.len();
        (if self.interior { most } else { 0 }, Some(most))
    }
}

impl Lattice {
    /// The edges that leave `node`: over axes (faces) first, then over diagonals.
    ///
    /// The order is the same at every node and on every run. Cost: constant a neighbour.
    #[inline]
    pub fn neighbours(&self, node: usize) -> Neighbours<'_> {
        let origin = self.coordinates(node);
        let interior = self.is_interior(origin);
        let stencil = match self.connectivity() {
            Connectivity::FourEight => &self.stencil()[..self.steps_at(origin).len()],
            _ => self.stencil(),
        };
        Neighbours { lattice: self, node, origin, interior, stencil: stencil.iter() }
    }

    /// The edges of an inner node, with differences of indices in place of nodes.
    pub(crate) fn inner_edges(&self) -> Vec<Edge> {
        let [width, height, _] = self.size().map(|size| size as isize);
        // Node (0, 0) has every step that any node has.
        let edge = |(direction, &step): (usize, &[i8; 3])| {
            let [x, y, z] = step.map(isize::from);
            let offset = x + width * (y + height * z);
            let (node, direction) = (offset as usize, direction as u8);
            Edge { node, step, direction, distance: self.step_length(step) }
        };
        self.steps_at([0; 3]).iter().enumerate().map(edge).collect()
    }

    /// Whether no edge that leaves `origin` reaches over a border, be it open or periodic.
    #[inline]
    pub fn is_interior(&self, origin: [usize; 3]) -> bool {
        let inside = |axis: usize| origin[axis] > 0 && origin[axis] + 1 < self.size()[axis];
        inside(0) && inside(1) && (inside(2) || !self.connectivity().is_volume())
    }

    /// The steps that a node at `origin` may take, whether or not they leave the lattice.
    pub fn steps_at(&self, origin: [usize; 3]) -> &'static [[i8; 3]] {
        match self.connectivity() {
            Connectivity::Four => &PLANE_STEPS[..4],
            Connectivity::FourEight if (origin[0] + origin[1]) % 2 == 1 => &PLANE_STEPS[..4],
            Connectivity::FourEight | Connectivity::Eight => &PLANE_STEPS,
            Connectivity::Voxel6 => &VOLUME_STEPS[..6],
            Connectivity::Voxel18 => &VOLUME_STEPS[..18],
            Connectivity::Voxel26 => &VOLUME_STEPS,
        }
    }

    /// Node reached from `origin` by `step` columns, rows and layers: wrapped on periodic
    /// axes, `None` where an open axis ends. The step may be longer than the lattice.
    pub fn offset(&self, origin: [usize; 3], step: [isize; 3]) -> Option<usize> {
        let mut target = [0; 3];
        for axis in 0..3 {
            let size = self.size()[axis] as isize;
            let moved = origin[axis] as isize + step[axis];
            target[axis] = match moved {
                inside if (0..size).contains(&inside) => inside as usize,
                outside if self.is_periodic(axis) => outside.rem_euclid(size) as usize,
                _ => return None,
            };
        }
        Some(self.node(target))
    }

    /// Length in metres of an edge over `step`, which moves by at most one node an axis.
    #[inline]
    pub fn step_length(&self, step: [i8; 3]) -> f64 {
        // A step of no length never occurs among edges; the mask keeps the index in range.
        self.edge_lengths()[(squared_length(step) - 1) as usize % 3]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Boundary::{self, Open, Periodic};
    use crate::testing::any_lattice;
    use proptest::prelude::*;

    /// Edges by definition: every other node, its displacement folded on periodic axes.
    fn edges_by_definition(lattice: &Lattice, node: usize) -> Vec<(usize, f64)> {
        let from = lattice.coordinates(node);
        let is_edge = |steps: [isize; 3]| {
            let axes = steps.iter().filter(|&&s| s != 0).count();
            let near = steps.iter().all(|s| s.abs() <= 1);
            near && match lattice.connectivity() {
                Connectivity::Four | Connectivity::Voxel6 => axes == 1,
                Connectivity::FourEight => {
                    axes == 1 || axes == 2 && (from[0] + from[1]).is_multiple_of(2)
                }
                Connectivity::Eight | Connectivity::Voxel18 => axes == 1 || axes == 2,
                Connectivity::Voxel26 => axes >= 1,
            }
        };
        let displacement = |other: usize| {
            let to = lattice.coordinates(other);
            std::array::from_fn(|axis| {
                let direct = to[axis] as isize - from[axis] as isize;
                let size = lattice.size()[axis] as isize;
                match lattice.is_periodic(axis) {
                    true if direct > size / 2 => direct - size,
                    true if direct < -(size / 2) => direct + size,
                    _ => direct,
                }
            })
        };
        let length = |steps: [isize; 3]| {
            lattice.spacing() * (steps.iter().map(|s| s * s).sum::<isize>() as f64).sqrt()
        };
        (0..lattice.node_count())
            .map(|other| (other, displacement(other)))
            .filter(|&(_, steps)| is_edge(steps))
            .map(|(other, steps)| (other, length(steps)))
            .collect()
    }

    proptest! {
        #[test]
        fn neighbours_are_those_of_the_definition(lattice in any_lattice()) {
            for node in 0..lattice.node_count() {
                let mut found: Vec<_> =
                    lattice.neighbours(node).map(|edge| (edge.node, edge.distance)).collect();
                found.sort_by_key(|edge| edge.0);
                prop_assert_eq!(found, edges_by_definition(&lattice, node));
            }
        }

        #[test]
        fn every_edge_has_its_opposite(lattice in any_lattice()) {
            for node in 0..lattice.node_count() {
                for edge in lattice.neighbours(node) {
                    let back = lattice.neighbours(edge.node).find(|back| back.node == node);
                    prop_assert_eq!(back.map(|back| back.step), Some(edge.step.map(|s| -s)));
                }
            }
        }
    }

    #[test]
    fn four_eight_alternates_degrees_eight_and_four() {
        let torus = Lattice::plane([6, 4], 1.0, Connectivity::FourEight, [Periodic; 2]).unwrap();
        for node in 0..torus.node_count() {
            let [x, y, _] = torus.coordinates(node);
            let degree = torus.neighbours(node).count();
            assert_eq!(degree, if (x + y) % 2 == 0 { 8 } else { 4 }, "node {node}");
        }
    }

    #[test]
    fn degrees_inside_are_those_of_the_name() {
        let degree = |connectivity: Connectivity, boundary: Boundary| {
            let lattice = match connectivity.is_volume() {
                true => Lattice::volume([5, 4, 3], 2.0, connectivity, [boundary; 3]).unwrap(),
                false => Lattice::plane([5, 4], 2.0, connectivity, [boundary; 2]).unwrap(),
            };
            let [x, y, z] = lattice.size().map(|size| size / 2);
            lattice.neighbours(lattice.node([x, y, z])).count()
        };
        for boundary in [Open, Periodic] {
            assert_eq!(degree(Connectivity::Four, boundary), 4);
            assert_eq!(degree(Connectivity::Eight, boundary), 8);
            assert_eq!(degree(Connectivity::Voxel6, boundary), 6);
            assert_eq!(degree(Connectivity::Voxel18, boundary), 18);
            assert_eq!(degree(Connectivity::Voxel26, boundary), 26);
        }
    }
}
