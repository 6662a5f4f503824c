//! The edges of a lattice, computed from the coordinates of a node.

use crate::{Connectivity, Lattice};

/// A directed edge from a node to one of its neighbours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Index of the neighbour.
    pub node: usize,
    /// Steps along x (east), y (south: one row on) and z (up) that lead to it.
    pub step: [i8; 3],
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
    origin: [usize; 3],
    steps: std::slice::Iter<'static, [i8; 3]>,
}

impl Iterator for Neighbours<'_> {
    type Item = Edge;

    fn next(&mut self) -> Option<Edge> {
        for &step in self.steps.by_ref() {
            if let Some(node) = self.lattice.offset(self.origin, step.map(isize::from)) {
                let distance = self.lattice.step_length(step);
                return Some(Edge { node, step, distance });
            }
        }
        None
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (0, self.steps.size_hint().1)
    }
}

impl Lattice {
    /// The edges that leave `node`: over axes (faces) first, then over diagonals.
    ///
    /// The order is the same at every node and on every run. Cost: constant a neighbour.
    pub fn neighbours(&self, node: usize) -> Neighbours<'_> {
        let origin = self.coordinates(node);
        Neighbours { lattice: self, origin, steps: self.steps_at(origin).iter() }
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

    /// Length in metres of an edge over `step`.
    pub fn step_length(&self, step: [i8; 3]) -> f64 {
        match squared_length(step) {
            1 => self.spacing(),
            squared => self.spacing() * f64::from(squared).sqrt(),
        }
    }
}
