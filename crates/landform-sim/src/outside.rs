//! Nodes outside the map: where the raster that a domain came from has no data.

use std::collections::VecDeque;
use std::sync::Arc;

use bevy_ecs::resource::Resource;
use landform_graph::Lattice;

/// The nodes that do not belong to the map, which ends where they begin.
///
/// A lattice is a rectangle, a map need not be. Nodes outside hold the height of the nearest node
/// of the map, so that slopes across its edge are level as they are across a border. Processes that
/// know of them treat the edge as an open border; outputs write no data there.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct Outside {
    pairs: Arc<[(usize, usize)]>,
    edge: Arc<[usize]>,
}

impl Outside {
    /// The nodes of `lattice` for which `is_outside`, a value a node, is true. Where all are, or
    /// none, no node is outside.
    ///
    /// # Panics
    /// If `is_outside` is not as long as the lattice.
    pub fn new(lattice: &Lattice, is_outside: &[bool]) -> Self {
        assert_eq!(is_outside.len(), lattice.node_count(), "one value a node");
        let on_edge = |&node: &usize| {
            !is_outside[node] && lattice.neighbours(node).any(|next| is_outside[next.node])
        };
        let edge: Vec<usize> = (0..is_outside.len()).filter(on_edge).collect();
        let mut nearest = vec![None; is_outside.len()];
        edge.iter().for_each(|&node| nearest[node] = Some(node));
        let mut reached = VecDeque::from(edge.clone());
        while let Some(node) = reached.pop_front() {
            for next in lattice.neighbours(node) {
                if is_outside[next.node] && nearest[next.node].is_none() {
                    nearest[next.node] = nearest[node];
                    reached.push_back(next.node);
                }
            }
        }
        let pair = |node: usize| Some((node, nearest[node].filter(|_| is_outside[node])?));
        Self { pairs: (0..is_outside.len()).filter_map(pair).collect(), edge: edge.into() }
    }

    /// Whether all nodes belong to the map.
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    /// The nodes outside, in order, each with the node of the map that is the fewest steps away, the first of equals.
    pub fn pairs(&self) -> &[(usize, usize)] {
        &self.pairs
    }

    /// The nodes outside, in order.
    pub fn nodes(&self) -> impl Iterator<Item = usize> + Clone + '_ {
        self.pairs.iter().map(|&(node, _)| node)
    }

    /// The nodes of the map with a neighbour outside, in order.
    pub fn edge(&self) -> &[usize] {
        &self.edge
    }

    /// Gives nodes outside the value of the nearest node of the map; `values` has one a node.
    pub fn extend(&self, values: &mut [f64]) {
        self.pairs.iter().for_each(|&(node, nearest)| values[node] = values[nearest]);
    }

    /// Sets the values of nodes outside to NaN, which outputs write as no data; `values` has one a
    /// node.
    pub fn blank(&self, values: &mut [f64]) {
        self.nodes().for_each(|node| values[node] = f64::NAN);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    #[test]
    fn nodes_outside_take_the_value_of_the_nearest_node_of_the_map() {
        let open = [Boundary::Open; 2];
        let lattice = Lattice::plane([5, 2], 1.0, Connectivity::Four, open).unwrap();
        // The map is the second column and the upper node of the fifth.
        let is_outside: Vec<bool> =
            "x.xx. x.xxx".split(' ').flat_map(str::chars).map(|c| c == 'x').collect();
        let outside = Outside::new(&lattice, &is_outside);
        assert_eq!(outside.edge(), [1, 4, 6]);
        assert_eq!(outside.pairs(), [(0, 1), (2, 1), (3, 4), (5, 6), (7, 6), (8, 4), (9, 4)]);
        let mut values = vec![0.0, 1.0, 0.0, 0.0, 4.0, 0.0, 6.0, 0.0, 0.0, 0.0];
        outside.extend(&mut values);
        assert_eq!(values, [1.0, 1.0, 1.0, 4.0, 4.0, 6.0, 6.0, 6.0, 4.0, 4.0]);
        outside.blank(&mut values);
        assert_eq!(values.iter().filter(|value| value.is_nan()).count(), outside.nodes().count());
        for whole in [false, true] {
            let outside = Outside::new(&lattice, &[whole; 10]);
            assert!(outside.is_empty() && outside.edge().is_empty());
        }
    }
}
