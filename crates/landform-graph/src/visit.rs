//! The graph traits of petgraph on lattices, so that its algorithms run on them as they are.
//!
//! Nodes carry no weight; the weight of an edge is its length in metres. Every pair of
//! neighbours has two directed edges (thesis, section 3.2.3). Nothing is stored: edges are
//! computed when an algorithm asks for them.

use std::iter::Map;
use std::ops::Range;

use fixedbitset::FixedBitSet;
use petgraph::data::DataMap;
use petgraph::visit::{
    Data, EdgeCount, EdgeIndexable, EdgeRef, GetAdjacencyMatrix, GraphBase, GraphProp,
    IntoEdgeReferences, IntoEdges, IntoEdgesDirected, IntoNeighbors, IntoNeighborsDirected,
    IntoNodeIdentifiers, IntoNodeReferences, NodeCompactIndexable, NodeCount, NodeIndexable,
    Visitable,
};
use petgraph::{Directed, Direction};

use crate::{Connectivity, Edge, Lattice, Neighbours};

/// A directed edge as petgraph sees it: both ends, a number and a length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LatticeEdge {
    source: usize,
    target: usize,
    id: usize,
    length: f64,
}

impl LatticeEdge {
    /// The edge that leaves `node`, or its opposite that enters `node`. Its number is its slot.
    fn new(lattice: &Lattice, node: usize, edge: Edge, direction: Direction) -> Self {
        let (source, target, id) = match direction {
            Direction::Outgoing => (node, edge.node, lattice.slot(node, &edge)),
            Direction::Incoming => (edge.node, node, lattice.reverse_slot(&edge)),
        };
        Self { source, target, id, length: edge.distance }
    }
}

impl EdgeRef for LatticeEdge {
    type NodeId = usize;
    type EdgeId = usize;
    type Weight = f64;

    fn source(&self) -> usize {
        self.source
    }

    fn target(&self) -> usize {
        self.target
    }

    fn weight(&self) -> &f64 {
        &self.length
    }

    fn id(&self) -> usize {
        self.id
    }
}

/// The neighbours of a node by index.
pub type NeighbourNodes<'a> = Map<Neighbours<'a>, fn(Edge) -> usize>;

/// The edges that leave or enter a node.
#[derive(Clone, Debug)]
pub struct NodeEdges<'a> {
    node: usize,
    direction: Direction,
    neighbours: Neighbours<'a>,
}

impl Iterator for NodeEdges<'_> {
    type Item = LatticeEdge;

    fn next(&mut self) -> Option<LatticeEdge> {
        let edge = self.neighbours.next()?;
        Some(LatticeEdge::new(self.neighbours.lattice(), self.node, edge, self.direction))
    }
}

/// All edges of a lattice in node order.
#[derive(Clone, Debug)]
pub struct EdgeReferences<'a> {
    lattice: &'a Lattice,
    nodes: Range<usize>,
    current: Option<NodeEdges<'a>>,
}

impl Iterator for EdgeReferences<'_> {
    type Item = LatticeEdge;

    fn next(&mut self) -> Option<LatticeEdge> {
        loop {
            if let Some(edge) = self.current.as_mut().and_then(Iterator::next) {
                return Some(edge);
            }
            let node = self.nodes.next()?;
            self.current = Some(self.lattice.edges(node));
        }
    }
}

impl GraphBase for Lattice {
    type NodeId = usize;
    type EdgeId = usize;
}

impl Data for Lattice {
    type NodeWeight = ();
    type EdgeWeight = f64;
}

impl DataMap for Lattice {
    fn node_weight(&self, node: usize) -> Option<&()> {
        (node < Lattice::node_count(self)).then_some(&())
    }

    fn edge_weight(&self, edge: usize) -> Option<&f64> {
        let (source, direction) = (edge / self.directions(), edge % self.directions());
        self.node_weight(source)?;
        let step = self.edge(source, direction as u8)?.step;
        let axes_moved = step.iter().filter(|&&s| s != 0).count();
        self.edge_lengths().get(axes_moved - 1)
    }
}

impl GraphProp for Lattice {
    type EdgeType = Directed;
}

impl NodeCount for Lattice {
    fn node_count(&self) -> usize {
        Lattice::node_count(self)
    }
}

impl NodeIndexable for Lattice {
    fn node_bound(&self) -> usize {
        Lattice::node_count(self)
    }

    fn to_index(&self, node: usize) -> usize {
        node
    }

    fn from_index(&self, index: usize) -> usize {
        index
    }
}

impl NodeCompactIndexable for Lattice {}

impl EdgeIndexable for Lattice {
    fn edge_bound(&self) -> usize {
        self.slots()
    }

    fn to_index(&self, edge: usize) -> usize {
        edge
    }

    fn from_index(&self, index: usize) -> usize {
        index
    }
}

impl EdgeCount for Lattice {
    /// Number of directed edges. Cost: constant.
    fn edge_count(&self) -> usize {
        // Node (0, 0) has every step that any node has.
        self.steps_at([0; 3]).iter().map(|&step| self.edges_over(step)).sum()
    }
}

impl Lattice {
    /// Number of nodes that have an edge over `step`.
    fn edges_over(&self, step: [i8; 3]) -> usize {
        let ends: [Range<usize>; 3] = std::array::from_fn(|axis| {
            let size = self.size()[axis];
            match step[axis] {
                _ if self.is_periodic(axis) => 0..size,
                1 => 0..size - 1,
                -1 => 1..size,
                _ => 0..size,
            }
        });
        let count: usize = ends.iter().map(|range| range.len()).product();
        let diagonal = step[0] != 0 && step[1] != 0;
        if self.connectivity() != Connectivity::FourEight || !diagonal {
            return count;
        }
        // Diagonals leave even nodes only: half of the rectangle, and the odd one out if the
        // rectangle starts at an even node.
        (count + usize::from((ends[0].start + ends[1].start).is_multiple_of(2))) / 2
    }
}

impl<'a> IntoNeighbors for &'a Lattice {
    type Neighbors = NeighbourNodes<'a>;

    fn neighbors(self, node: usize) -> NeighbourNodes<'a> {
        self.neighbours(node).map(|edge| edge.node)
    }
}

impl<'a> IntoNeighborsDirected for &'a Lattice {
    type NeighborsDirected = NeighbourNodes<'a>;

    /// Every edge has its opposite, so both directions list the same nodes.
    fn neighbors_directed(self, node: usize, _: Direction) -> NeighbourNodes<'a> {
        self.neighbors(node)
    }
}

impl<'a> IntoEdgeReferences for &'a Lattice {
    type EdgeRef = LatticeEdge;
    type EdgeReferences = EdgeReferences<'a>;

    fn edge_references(self) -> EdgeReferences<'a> {
        EdgeReferences { lattice: self, nodes: self.node_identifiers(), current: None }
    }
}

impl<'a> IntoEdges for &'a Lattice {
    type Edges = NodeEdges<'a>;

    fn edges(self, node: usize) -> NodeEdges<'a> {
        self.edges_directed(node, Direction::Outgoing)
    }
}

impl<'a> IntoEdgesDirected for &'a Lattice {
    type EdgesDirected = NodeEdges<'a>;

    fn edges_directed(self, node: usize, direction: Direction) -> NodeEdges<'a> {
        NodeEdges { node, direction, neighbours: self.neighbours(node) }
    }
}

impl IntoNodeIdentifiers for &Lattice {
    type NodeIdentifiers = Range<usize>;

    fn node_identifiers(self) -> Range<usize> {
        0..Lattice::node_count(self)
    }
}

impl IntoNodeReferences for &Lattice {
    type NodeRef = (usize, ());
    type NodeReferences = Map<Range<usize>, fn(usize) -> (usize, ())>;

    fn node_references(self) -> Self::NodeReferences {
        self.node_identifiers().map(|node| (node, ()))
    }
}

impl Visitable for Lattice {
    type Map = FixedBitSet;

    fn visit_map(&self) -> FixedBitSet {
        FixedBitSet::with_capacity(Lattice::node_count(self))
    }

    fn reset_map(&self, map: &mut FixedBitSet) {
        map.clear();
        map.grow(Lattice::node_count(self));
    }
}

impl GetAdjacencyMatrix for Lattice {
    /// Nothing: adjacency is computed.
    type AdjMatrix = ();

    fn adjacency_matrix(&self) {}

    fn is_adjacent(&self, (): &(), from: usize, to: usize) -> bool {
        self.neighbours(from).any(|edge| edge.node == to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::any_lattice;
    use petgraph::algo::{connected_components, dijkstra, ford_fulkerson, kosaraju_scc};
    use petgraph::graph::{DiGraph, NodeIndex};
    use petgraph::visit::{Bfs, NodeRef};
    use proptest::prelude::*;

    /// The same lattice with every edge stored.
    fn stored(lattice: &Lattice) -> DiGraph<(), f64> {
        let mut graph = DiGraph::new();
        for _ in lattice.node_references() {
            graph.add_node(());
        }
        for edge in lattice.edge_references() {
            let [source, target] = [edge.source(), edge.target()].map(NodeIndex::new);
            graph.add_edge(source, target, *edge.weight());
        }
        graph
    }

    proptest! {
        #[test]
        fn algorithms_agree_with_those_on_a_stored_graph(lattice in any_lattice()) {
            let graph = stored(&lattice);
            prop_assert_eq!(EdgeCount::edge_count(&lattice), graph.edge_count());
            prop_assert_eq!(connected_components(&lattice), 1);
            prop_assert_eq!(kosaraju_scc(&lattice).len(), 1);
            let start = lattice.node_count() / 2;
            let far = dijkstra(&lattice, start, None, |edge| *edge.weight());
            let expected = dijkstra(&graph, NodeIndex::new(start), None, |edge| *edge.weight());
            for node in lattice.node_references() {
                let index = NodeIndex::new(node.id());
                prop_assert_eq!(far[&node.id()], expected[&index]);
            }
        }

        #[test]
        fn edge_numbers_are_unique_and_in_bounds(lattice in any_lattice()) {
            let mut ids: Vec<_> = lattice.edge_references().map(|edge| edge.id()).collect();
            prop_assert!(ids.iter().all(|&id| id < lattice.edge_bound()));
            for edge in lattice.edge_references() {
                prop_assert_eq!(lattice.edge_weight(edge.id()), Some(edge.weight()));
            }
            let count = ids.len();
            let weights = (0..lattice.edge_bound() + 30).filter_map(|id| lattice.edge_weight(id));
            prop_assert_eq!(weights.count(), count);
            ids.sort_unstable();
            ids.dedup();
            prop_assert_eq!(ids.len(), count);
        }

        #[test]
        fn entering_edges_are_the_leaving_edges_of_the_neighbours(lattice in any_lattice()) {
            for node in lattice.node_identifiers() {
                for edge in lattice.edges_directed(node, Direction::Incoming) {
                    prop_assert_eq!(edge.target(), node);
                    prop_assert!(lattice.edges(edge.source()).any(|leaving| leaving == edge));
                    prop_assert!(lattice.is_adjacent(&(), edge.source(), node));
                }
            }
        }
    }

    #[test]
    fn a_reset_map_forgets_visits() {
        let lattice = Lattice::plane([3, 2], 1.0, Connectivity::Four, [crate::Boundary::Open; 2]);
        let lattice = lattice.unwrap();
        let mut search = Bfs::new(&lattice, 0);
        while search.next(&lattice).is_some() {}
        lattice.reset_map(&mut search.discovered);
        assert_eq!(search.discovered.count_ones(..), 0);
        assert_eq!(search.discovered.len(), 6);
    }

    #[test]
    fn maximum_flow_runs_on_a_lattice() {
        // A corner of a Four lattice has two edges of 10 m: no more can leave it.
        let lattice = Lattice::plane([4, 3], 10.0, Connectivity::Four, [crate::Boundary::Open; 2]);
        let lattice = lattice.unwrap();
        assert_eq!(ford_fulkerson(&lattice, 0, 11).0, 20.0);
    }
}
