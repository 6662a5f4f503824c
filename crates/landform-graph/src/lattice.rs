//! Regular lattices: sizes, boundaries, spacing and the edges between nodes.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::Edge;

/// Which nodes of a lattice are joined by edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Connectivity {
    /// 2-D: the four nodes along the axes.
    Four,
    /// 2-D: the mesh of 4-8 subdivision (thesis, section 2.5). Nodes whose row and column
    /// add to an even number have eight neighbours, the others four.
    FourEight,
    /// 2-D: the four nodes along the axes and the four along the diagonals.
    Eight,
    /// 3-D: the six voxels that share a face.
    Voxel6,
    /// 3-D: the eighteen voxels that share a face or an edge.
    Voxel18,
    /// 3-D: the twenty-six voxels that share a face, an edge or a corner (thesis, section 2.5).
    Voxel26,
}

impl Connectivity {
    /// Whether the lattice is a volume.
    pub fn is_volume(self) -> bool {
        matches!(self, Self::Voxel6 | Self::Voxel18 | Self::Voxel26)
    }
}

/// What lies beyond the first and the last node of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Boundary {
    /// Nothing: edge nodes have fewer neighbours.
    Open,
    /// The other end of the axis.
    Periodic,
}

/// Why a lattice cannot be made.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum LatticeError {
    /// An axis has too few nodes for its boundary.
    #[error("axis {axis} has {nodes} nodes; it needs at least {least}{why}")]
    TooSmall {
        /// Name of the axis: `x`, `y` or `z`.
        axis: char,
        /// Number of nodes asked for.
        nodes: usize,
        /// Smallest number that works.
        least: usize,
        /// Explanation, empty for open axes.
        why: &'static str,
    },
    /// The 4-8 mesh cannot close on itself over an odd number of nodes.
    #[error(
        "axis {axis} is periodic with {nodes} nodes; a FourEight lattice alternates nodes \
         of degree 8 and 4, so a periodic axis needs an even number"
    )]
    OddPeriodic {
        /// Name of the axis: `x` or `y`.
        axis: char,
        /// Number of nodes asked for.
        nodes: usize,
    },
    /// The spacing is not a positive finite length.
    #[error("spacing is {0} m; it must be a positive finite number of metres")]
    Spacing(f64),
    /// A 2-D connectivity was asked for a volume or the reverse.
    #[error("{connectivity:?} does not join the nodes of a {dimensions}-D lattice")]
    Dimensions {
        /// Connectivity asked for.
        connectivity: Connectivity,
        /// Number of dimensions of the lattice.
        dimensions: usize,
    },
    /// The number of nodes does not fit the index type.
    #[error("{0:?} nodes are more than a lattice can number")]
    TooLarge([usize; 3]),
}

/// A regular grid of nodes in two or three dimensions with implicit edges.
///
/// Node `(x, y, z)` has index `x + width * (y + height * z)`: x runs east, y is the row and
/// runs **south** as in rasters and pictures, z runs up. Angles are counter-clockwise from
/// east on the map, so the direction of angle `a` is `(cos a, -sin a)` in columns and rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Lattice {
    size: [usize; 3],
    spacing: f64,
    connectivity: Connectivity,
    boundary: [Boundary; 3],
    /// Lengths in metres of edges over a face, over an edge and over a corner of a cell.
    edge_lengths: [f64; 3],
    /// The edges of an inner node, with differences of indices in place of nodes.
    stencil: Vec<Edge>,
}

impl Lattice {
    /// A 2-D lattice of `size = [columns, rows]` nodes, `spacing` metres apart.
    ///
    /// # Errors
    /// See [`LatticeError`]. Open axes need one node, periodic ones three (so that no node
    /// is its own neighbour or the same neighbour twice), an even number with `FourEight`.
    pub fn plane(
        size: [usize; 2],
        spacing: f64,
        connectivity: Connectivity,
        boundary: [Boundary; 2],
    ) -> Result<Self, LatticeError> {
        if connectivity.is_volume() {
            return Err(LatticeError::Dimensions { connectivity, dimensions: 2 });
        }
        let size = [size[0], size[1], 1];
        let boundary = [boundary[0], boundary[1], Boundary::Open];
        Self::checked(size, spacing, connectivity, boundary)
    }

    /// A 3-D lattice of `size = [columns, rows, layers]` voxels, `spacing` metres apart.
    ///
    /// # Errors
    /// See [`LatticeError`]; limits as for [`Lattice::plane`].
    pub fn volume(
        size: [usize; 3],
        spacing: f64,
        connectivity: Connectivity,
        boundary: [Boundary; 3],
    ) -> Result<Self, LatticeError> {
        if !connectivity.is_volume() {
            return Err(LatticeError::Dimensions { connectivity, dimensions: 3 });
        }
        Self::checked(size, spacing, connectivity, boundary)
    }

    fn checked(
        size: [usize; 3],
        spacing: f64,
        connectivity: Connectivity,
        boundary: [Boundary; 3],
    ) -> Result<Self, LatticeError> {
        let edge_lengths = [spacing, spacing * 2.0_f64.sqrt(), spacing * 3.0_f64.sqrt()];
        let stencil = Vec::new();
        let mut lattice = Self { size, spacing, connectivity, boundary, edge_lengths, stencil };
        lattice.check_axes()?;
        if !(spacing > 0.0 && spacing.is_finite()) {
            return Err(LatticeError::Spacing(spacing));
        }
        let [width, height, depth] = size;
        width
            .checked_mul(height)
            .and_then(|area| area.checked_mul(depth))
            .filter(|&count| count <= u32::MAX as usize)
            .ok_or(LatticeError::TooLarge(size))?;
        lattice.stencil = lattice.inner_edges();
        Ok(lattice)
    }

    /// Whether every axis has enough nodes for its boundary.
    fn check_axes(&self) -> Result<(), LatticeError> {
        for (axis, name) in ['x', 'y', 'z'].into_iter().enumerate() {
            let nodes = self.size[axis];
            let periodic = self.boundary[axis] == Boundary::Periodic;
            let (least, why) = match periodic {
                true => (3, " because it is periodic"),
                false => (1, ""),
            };
            if nodes < least {
                return Err(LatticeError::TooSmall { axis: name, nodes, least, why });
            }
            if periodic && nodes % 2 == 1 && self.connectivity == Connectivity::FourEight {
                return Err(LatticeError::OddPeriodic { axis: name, nodes });
            }
        }
        Ok(())
    }

    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        self.size.iter().product()
    }

    /// Number of columns, rows and layers.
    pub fn size(&self) -> [usize; 3] {
        self.size
    }

    /// Number of columns (x).
    pub fn width(&self) -> usize {
        self.size[0]
    }

    /// Number of rows (y).
    pub fn height(&self) -> usize {
        self.size[1]
    }

    /// Number of layers (z); one for 2-D lattices.
    pub fn depth(&self) -> usize {
        self.size[2]
    }

    /// Distance between nodes along an axis, in metres.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Which nodes are joined.
    pub fn connectivity(&self) -> Connectivity {
        self.connectivity
    }

    /// Boundary of the x, y and z axes.
    pub fn boundary(&self) -> [Boundary; 3] {
        self.boundary
    }

    /// Whether the axis (0 = x, 1 = y, 2 = z) closes on itself.
    pub fn is_periodic(&self, axis: usize) -> bool {
        self.boundary[axis] == Boundary::Periodic
    }

    /// Lengths in metres of edges that move along one, two and three axes.
    pub fn edge_lengths(&self) -> &[f64; 3] {
        &self.edge_lengths
    }

    /// Index of the node at column `x`, row `y`, layer `z`, which must lie in the lattice.
    pub fn node(&self, [x, y, z]: [usize; 3]) -> usize {
        debug_assert!(x < self.size[0] && y < self.size[1] && z < self.size[2]);
        x + self.size[0] * (y + self.size[1] * z)
    }

    /// Column, row and layer of a node.
    #[inline]
    pub fn coordinates(&self, node: usize) -> [usize; 3] {
        // Indices and sizes fit 32 bits, of which division is much faster.
        let [node, width, height] = [node, self.size[0], self.size[1]].map(|n| n as u32);
        let (row, x) = (node / width, node % width);
        [x, row % height, row / height].map(|n| n as usize)
    }

    /// The edges of an inner node, with differences of indices in place of nodes.
    #[inline]
    pub(crate) fn stencil(&self) -> &[Edge] {
        &self.stencil
    }

    /// Position in metres: x east, y north, z up; the south-west corner node of the lowest
    /// layer is the origin.
    pub fn position(&self, node: usize) -> DVec3 {
        let [x, y, z] = self.coordinates(node);
        let north = self.size[1] - 1 - y;
        DVec3::new(x as f64, north as f64, z as f64) * self.spacing
    }
}

#[cfg(test)]
mod tests {
    use super::Boundary::{Open, Periodic};
    use super::*;
    use crate::testing::any_lattice;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn coordinates_and_nodes_are_inverse(lattice in any_lattice()) {
            let mut last = None;
            for node in 0..lattice.node_count() {
                let at = lattice.coordinates(node);
                prop_assert_eq!(lattice.node(at), node);
                let reversed = [at[2], at[1], at[0]];
                prop_assert!(last.is_none_or(|last| last < reversed), "x runs fastest, then y");
                last = Some(reversed);
            }
        }

        #[test]
        fn positions_of_open_neighbours_are_as_far_as_their_edge(lattice in any_lattice()) {
            for node in 0..lattice.node_count() {
                let here = lattice.position(node);
                for edge in lattice.neighbours(node) {
                    let [x, y, z] = edge.step.map(f64::from);
                    let moved = DVec3::new(x, -y, z) * lattice.spacing();
                    prop_assert!((moved.length() - edge.distance).abs() < 1e-12 * edge.distance);
                    let straight = (lattice.position(edge.node) - here - moved).length();
                    let wraps = (0..3).any(|axis| lattice.is_periodic(axis));
                    prop_assert!(wraps || straight < 1e-9);
                }
            }
        }
    }

    #[test]
    fn impossible_lattices_are_refused_with_a_reason() {
        let plane = |size, spacing, kind, boundary| Lattice::plane(size, spacing, kind, boundary);
        let message = |made: Result<Lattice, LatticeError>| made.unwrap_err().to_string();
        let open = [Open; 2];
        let empty = message(plane([0, 4], 1.0, Connectivity::Four, open));
        assert_eq!(empty, "axis x has 0 nodes; it needs at least 1");
        let short = message(plane([4, 2], 1.0, Connectivity::Four, [Open, Periodic]));
        assert_eq!(short, "axis y has 2 nodes; it needs at least 3 because it is periodic");
        let odd = plane([5, 4], 1.0, Connectivity::FourEight, [Periodic; 2]);
        assert_eq!(odd, Err(LatticeError::OddPeriodic { axis: 'x', nodes: 5 }));
        for spacing in [0.0, -1.0, f64::INFINITY] {
            let made = plane([4, 4], spacing, Connectivity::Four, open);
            assert_eq!(made, Err(LatticeError::Spacing(spacing)));
        }
        assert!(plane([4, 4], f64::NAN, Connectivity::Four, open).is_err());
        let huge = plane([1 << 40, 1 << 40], 1.0, Connectivity::Four, open);
        assert_eq!(huge, Err(LatticeError::TooLarge([1 << 40, 1 << 40, 1])));
        let voxels = plane([4, 4], 1.0, Connectivity::Voxel6, open);
        let connectivity = Connectivity::Voxel6;
        assert_eq!(voxels, Err(LatticeError::Dimensions { connectivity, dimensions: 2 }));
        let mesh = Lattice::volume([4; 3], 1.0, Connectivity::FourEight, [Open; 3]);
        let connectivity = Connectivity::FourEight;
        assert_eq!(mesh, Err(LatticeError::Dimensions { connectivity, dimensions: 3 }));
    }
}
