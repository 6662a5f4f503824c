//! Breadth-first search with a radius and a filter on edges (thesis, section 3.2.3).

use std::ops::ControlFlow;

use crate::{Edge, Lattice};

/// How far a search goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Greatest straight distance in metres from the source, measured along the path's
    /// displacement, so that it stays right across periodic borders.
    pub metres: f64,
    /// Greatest number of edges from the source.
    pub edges: u32,
}

impl Reach {
    /// As far as the filter allows.
    pub const UNLIMITED: Self = Self { metres: f64::INFINITY, edges: u32::MAX };

    /// At most `metres` from the source in a straight line, over any number of edges.
    pub fn metres(metres: f64) -> Self {
        Self { metres, ..Self::UNLIMITED }
    }

    /// At most `edges` edges from the source.
    pub fn edges(edges: u32) -> Self {
        Self { edges, ..Self::UNLIMITED }
    }

    fn contains(self, visit: &Visit, lattice: &Lattice) -> bool {
        visit.edges <= self.edges
            && (self.metres == f64::INFINITY || visit.distance(lattice) <= self.metres)
    }
}

/// A node found by a search, and how it was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Visit {
    /// Index of the node.
    pub node: usize,
    /// The source from which it was reached first.
    pub source: usize,
    /// Number of edges from the source.
    pub edges: u32,
    /// Columns, rows and layers from the source along the path taken, not wrapped.
    pub moved: [i32; 3],
}

impl Visit {
    fn start(source: usize) -> Self {
        Self { node: source, source, edges: 0, moved: [0; 3] }
    }

    /// The visit of the node at the end of `edge`.
    fn across(&self, edge: &Edge) -> Self {
        let moved = std::array::from_fn(|axis| self.moved[axis] + i32::from(edge.step[axis]));
        Self { node: edge.node, source: self.source, edges: self.edges + 1, moved }
    }

    /// Straight distance in metres from the source.
    pub fn distance(&self, lattice: &Lattice) -> f64 {
        let squared: f64 = self.moved.iter().map(|&steps| f64::from(steps).powi(2)).sum();
        squared.sqrt() * lattice.spacing()
    }
}

/// Breadth-first searches that share their memory.
///
/// A search costs what it visits: marks are stamped with the number of the search, never
/// cleared, so that every agent on a lattice of a million nodes may search a small radius.
/// Nothing is allocated once the memory fits the lattice.
///
/// Limits: the radius is that of the path's displacement, so on a lattice that closes on
/// itself a node is judged by the way on which it was first met. With a filter, a node within
/// the radius is found only over paths that stay within it.
///
/// ```
/// use landform_graph::{Boundary, BreadthFirst, Connectivity, Lattice, Reach};
/// let lattice = Lattice::plane([9, 9], 1.0, Connectivity::Four, [Boundary::Open; 2])?;
/// let height: Vec<f64> = (0..81).map(|node| (node % 9) as f64).collect();
/// let mut search = BreadthFirst::new();
/// // Every node uphill of the middle within 2 m.
/// let uphill = |from: usize, to: &landform_graph::Edge| height[to.node] >= height[from];
/// let found = search.collect(&lattice, &[40], Reach::metres(2.0), uphill);
/// assert_eq!(found.len(), 9);
/// # Ok::<(), landform_graph::LatticeError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct BreadthFirst {
    stamp: u32,
    stamps: Vec<u32>,
    queue: Vec<Visit>,
}

impl BreadthFirst {
    /// Memory for searches; it grows to one mark a node at the first search.
    pub fn new() -> Self {
        Self::default()
    }

    /// Visits the nodes within `reach` of `sources` that `passes` lets the search enter.
    ///
    /// Order: the sources first, in the order given, then breadth first, ties in neighbour
    /// order. `passes(from, edge)` says whether the search may follow `edge` from node
    /// `from`; it is asked only for edges to nodes that are within reach and not yet visited.
    /// `visit` may end the search with [`ControlFlow::Break`], whose value is returned.
    /// A node belongs to the source that reaches it first, and reach counts from that source.
    ///
    /// # Panics
    /// If a source does not lie in the lattice.
    pub fn search<B>(
        &mut self,
        lattice: &Lattice,
        sources: &[usize],
        reach: Reach,
        mut passes: impl FnMut(usize, &Edge) -> bool,
        mut visit: impl FnMut(&Visit) -> ControlFlow<B>,
    ) -> Option<B> {
        self.begin(lattice.node_count());
        for &source in sources {
            if self.mark(source) {
                self.queue.push(Visit::start(source));
            }
        }
        let mut next = 0;
        while let Some(&current) = self.queue.get(next) {
            next += 1;
            if let ControlFlow::Break(found) = visit(&current) {
                return Some(found);
            }
            for edge in lattice.neighbours(current.node) {
                let found = current.across(&edge);
                let open = !self.is_marked(edge.node) && reach.contains(&found, lattice);
                if open && passes(current.node, &edge) {
                    self.mark(edge.node);
                    self.queue.push(found);
                }
            }
        }
        None
    }

    /// All visits of a [`BreadthFirst::search`] in order, sources included.
    ///
    /// # Panics
    /// If a source does not lie in the lattice.
    pub fn collect(
        &mut self,
        lattice: &Lattice,
        sources: &[usize],
        reach: Reach,
        passes: impl FnMut(usize, &Edge) -> bool,
    ) -> &[Visit] {
        self.search(lattice, sources, reach, passes, |_| ControlFlow::<()>::Continue(()));
        &self.queue
    }

    /// The first node that is `wanted` in the order of [`BreadthFirst::search`]: the one over
    /// the fewest edges, of several such the first in neighbour order. The search ends there.
    ///
    /// ```
    /// use landform_graph::{Boundary, BreadthFirst, Connectivity, Lattice, Reach};
    /// let lattice = Lattice::plane([9, 9], 1.0, Connectivity::Four, [Boundary::Open; 2])?;
    /// let height: Vec<f64> = (0..81).map(|node| (node % 9) as f64).collect();
    /// let tree = |node: usize| node % 3 == 0;
    /// // The nearest tree above 5 m.
    /// let found = BreadthFirst::new().find(
    ///     &lattice,
    ///     &[40],
    ///     Reach::metres(4.0),
    ///     |_, _| true,
    ///     |visit| tree(visit.node) && height[visit.node] > 5.0,
    /// );
    /// assert_eq!(found.map(|visit| (visit.node, visit.edges)), Some((42, 2)));
    /// # Ok::<(), landform_graph::LatticeError>(())
    /// ```
    ///
    /// # Panics
    /// If a source does not lie in the lattice.
    pub fn find(
        &mut self,
        lattice: &Lattice,
        sources: &[usize],
        reach: Reach,
        passes: impl FnMut(usize, &Edge) -> bool,
        mut wanted: impl FnMut(&Visit) -> bool,
    ) -> Option<Visit> {
        self.search(lattice, sources, reach, passes, |visit| match wanted(visit) {
            true => ControlFlow::Break(*visit),
            false => ControlFlow::Continue(()),
        })
    }

    /// Forgets the last search.
    fn begin(&mut self, nodes: usize) {
        self.queue.clear();
        self.stamps.resize(nodes, 0);
        self.stamp = self.stamp.wrapping_add(1);
        if self.stamp == 0 {
            self.stamps.fill(0);
            self.stamp = 1;
        }
    }

    fn is_marked(&self, node: usize) -> bool {
        self.stamps[node] == self.stamp
    }

    /// Marks a node; false if it was marked already.
    fn mark(&mut self, node: usize) -> bool {
        std::mem::replace(&mut self.stamps[node], self.stamp) != self.stamp
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{any_field, any_lattice};
    use crate::{Boundary, Connectivity};
    use petgraph::visit::{Bfs, EdgeFiltered, EdgeRef};
    use proptest::prelude::*;

    fn nodes(visits: &[Visit]) -> Vec<usize> {
        visits.iter().map(|visit| visit.node).collect()
    }

    /// Number of edges from the nearest source by repeated relaxation over all edges.
    fn edges_by_relaxation(lattice: &Lattice, sources: &[usize]) -> Vec<u32> {
        let mut edges = vec![u32::MAX; lattice.node_count()];
        for &source in sources {
            edges[source] = 0;
        }
        loop {
            let before = edges.clone();
            for node in 0..lattice.node_count() {
                for edge in lattice.neighbours(node) {
                    edges[node] = edges[node].min(edges[edge.node].saturating_add(1));
                }
            }
            if edges == before {
                return edges;
            }
        }
    }

    proptest! {
        #[test]
        fn visits_are_those_of_petgraph_in_the_same_order(
            (lattice, height) in any_field(), start in 0..1000_usize,
        ) {
            let start = start % lattice.node_count();
            let uphill = EdgeFiltered::from_fn(&lattice, |edge| {
                height[edge.target()] > height[edge.source()]
            });
            let mut expected = Vec::new();
            let mut search = Bfs::new(&uphill, start);
            while let Some(node) = search.next(&uphill) {
                expected.push(node);
            }
            let mut search = BreadthFirst::new();
            let passes = |from: usize, edge: &Edge| height[edge.node] > height[from];
            let found = search.collect(&lattice, &[start], Reach::UNLIMITED, passes);
            prop_assert_eq!(nodes(found), expected);
        }

        #[test]
        fn many_sources_reach_as_many_edges_as_brute_force(
            lattice in any_lattice(), sources in prop::collection::vec(0..1000_usize, 1..4),
            limit in 0..6_u32,
        ) {
            let sources: Vec<_> = sources.iter().map(|s| s % lattice.node_count()).collect();
            let expected = edges_by_relaxation(&lattice, &sources);
            let mut search = BreadthFirst::new();
            let mut found = vec![u32::MAX; lattice.node_count()];
            for visit in search.collect(&lattice, &sources, Reach::edges(limit), |_, _| true) {
                found[visit.node] = visit.edges;
            }
            for (found, expected) in found.into_iter().zip(expected) {
                prop_assert_eq!(found, if expected <= limit { expected } else { u32::MAX });
            }
        }

        /// Without a filter a disc of an open lattice is all nodes within the radius.
        #[test]
        fn radius_is_the_straight_distance(radius in 0.0..9.0_f64, start in 0..143_usize) {
            for connectivity in [Connectivity::Four, Connectivity::FourEight, Connectivity::Eight] {
                let lattice =
                    Lattice::plane([13, 11], 1.5, connectivity, [Boundary::Open; 2]).unwrap();
                let mut search = BreadthFirst::new();
                let disc = search.collect(&lattice, &[start], Reach::metres(radius), |_, _| true);
                let mut found = nodes(disc);
                found.sort_unstable();
                let centre = lattice.position(start);
                let expected: Vec<_> = (0..lattice.node_count())
                    .filter(|&node| lattice.position(node).distance(centre) <= radius)
                    .collect();
                prop_assert_eq!(found, expected);
            }
        }
    }

    #[test]
    fn radius_crosses_periodic_borders() {
        let lattice = Lattice::plane([10, 10], 1.0, Connectivity::Four, [Boundary::Periodic; 2]);
        let lattice = lattice.unwrap();
        let mut search = BreadthFirst::new();
        assert_eq!(search.collect(&lattice, &[0], Reach::metres(2.0), |_, _| true).len(), 13);
    }

    #[test]
    fn a_search_ends_when_told_and_the_next_starts_afresh() {
        let lattice = Lattice::plane([8, 8], 1.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
        let mut search = BreadthFirst::new();
        let mut visited = 0;
        let found = search.search(
            &lattice,
            &[0],
            Reach::UNLIMITED,
            |_, _| true,
            |visit| {
                visited += 1;
                match visit.edges {
                    2 => ControlFlow::Break(visit.node),
                    _ => ControlFlow::Continue(()),
                }
            },
        );
        assert_eq!((found, visited), (Some(2), 4));
        assert_eq!(search.collect(&lattice, &[63], Reach::UNLIMITED, |_, _| true).len(), 64);
    }

    #[test]
    fn marks_survive_the_wrap_of_the_stamp() {
        let lattice = Lattice::plane([3, 3], 1.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
        let mut search = BreadthFirst { stamp: u32::MAX - 1, ..BreadthFirst::new() };
        for _ in 0..3 {
            assert_eq!(search.collect(&lattice, &[4], Reach::UNLIMITED, |_, _| true).len(), 9);
        }
    }
}
