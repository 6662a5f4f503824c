//! Where values on directed edges lie: a slot for every node and direction.
//!
//! Edges are computed and never stored, but what flows over them has to be kept somewhere
//! (thesis, section 3.2.3). A slice of values on edges holds [`Lattice::directions`] values a
//! node, first those of node 0: the value on the edge that leaves `node` in `direction` is
//! number `node * directions + direction`. A direction is the same step at every node, so
//! `values.chunks_exact(directions)` gives the outgoing edges of one node after another, and
//! the value on the reverse of an edge is at [`Lattice::reverse_slot`].
//!
//! Slots of edges that do not exist (over open borders, along diagonals at the nodes of degree
//! four of a 4-8 mesh) are there and unused.
//!
//! ```
//! use landform_graph::{Boundary, Connectivity, Lattice};
//! let lattice = Lattice::plane([3, 1], 1.0, Connectivity::Four, [Boundary::Open; 2])?;
//! let mut flow = vec![0.0; lattice.slots()];
//! // 2 flow from node 0 to the east.
//! for edge in lattice.neighbours(0) {
//!     flow[lattice.slot(0, &edge)] = 2.0;
//! }
//! // What arrives at node 1: the flow on the reverse of each edge that leaves it.
//! let inflow: f64 = lattice.neighbours(1).map(|edge| flow[lattice.reverse_slot(&edge)]).sum();
//! assert_eq!(inflow, 2.0);
//! # Ok::<(), landform_graph::LatticeError>(())
//! ```

use crate::{Edge, Lattice};

impl Lattice {
    /// Number of directions in which edges leave nodes: the greatest degree of a node.
    pub fn directions(&self) -> usize {
        self.stencil().len()
    }

    /// Number of slots for values on directed edges: nodes times directions.
    pub fn slots(&self) -> usize {
        self.node_count() * self.directions()
    }

    /// Slot of `edge`, which leaves `node`.
    #[inline]
    pub fn slot(&self, node: usize, edge: &Edge) -> usize {
        node * self.directions() + usize::from(edge.direction)
    }

    /// Slot of the reverse of `edge`: of the edge from `edge.node` back to where it came from.
    #[inline]
    pub fn reverse_slot(&self, edge: &Edge) -> usize {
        edge.node * self.directions() + usize::from(self.opposite(edge.direction))
    }

    /// The direction that leads back.
    #[inline]
    pub fn opposite(&self, direction: u8) -> u8 {
        match (self.connectivity().is_volume(), direction) {
            // East, north, west, south; then north-east and on, counter-clockwise.
            (false, axis @ 0..4) => (axis + 2) % 4,
            (false, diagonal) => 4 + (diagonal + 2) % 4,
            // Faces, edges and corners, each class in the order of z, y and x.
            (true, face @ 0..6) => 5 - face,
            (true, edge @ 6..18) => 23 - edge,
            (true, corner) => 43_u8.wrapping_sub(corner),
        }
    }

    /// The edge that leaves `node` in `direction`; `None` when there is no such edge.
    pub fn edge(&self, node: usize, direction: u8) -> Option<Edge> {
        let origin = self.coordinates(node);
        let step = *self.steps_at(origin).get(usize::from(direction))?;
        let node = self.offset(origin, step.map(isize::from))?;
        Some(Edge { node, step, direction, distance: self.step_length(step) })
    }
}

#[cfg(test)]
mod tests {
    use crate::testing::any_lattice;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn slots_are_distinct_and_reverses_lead_back(lattice in any_lattice()) {
            let mut taken = vec![false; lattice.slots()];
            for node in 0..lattice.node_count() {
                for edge in lattice.neighbours(node) {
                    prop_assert_eq!(lattice.edge(node, edge.direction), Some(edge));
                    let slot = lattice.slot(node, &edge);
                    prop_assert!(!std::mem::replace(&mut taken[slot], true));
                    let back = lattice.edge(edge.node, lattice.opposite(edge.direction));
                    let back = back.expect("every edge has its reverse");
                    prop_assert_eq!((back.node, back.step), (node, edge.step.map(|s| -s)));
                    prop_assert_eq!(lattice.reverse_slot(&edge), lattice.slot(edge.node, &back));
                    prop_assert_eq!(lattice.reverse_slot(&back), slot);
                }
            }
        }

        #[test]
        fn directions_without_an_edge_are_told(lattice in any_lattice(), node in 0..1000_usize) {
            let node = node % lattice.node_count();
            let edges = (0..=u8::MAX).filter_map(|direction| lattice.edge(node, direction));
            prop_assert!(edges.eq(lattice.neighbours(node)));
        }
    }
}
