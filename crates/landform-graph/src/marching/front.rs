//! Any update from neighbour to neighbour, in the order of a front.

use std::ops::ControlFlow;

use super::queue::TimeQueue;
use super::{MarchError, check_start};
use crate::{Edge, Lattice};

/// The iteration scheme of fast marching for an update of the caller's own (thesis, appendix
/// A.5 with listings 5.1 and 5.2), with memory that is used again.
///
/// The node with the smallest time is taken, and the update is asked about each of its edges:
/// it may change what the caller keeps for the neighbour, and says when the neighbour, now
/// changed, is due. Listing 5.1 gives the new distance as that time, listing 5.2 gives 0.
///
/// A march costs what it visits, whatever the size of the lattice, and allocates nothing once
/// the memory fits the lattice and the front.
///
/// ```
/// use landform_graph::marching::Front;
/// use landform_graph::{Boundary, Connectivity, Edge, Lattice};
/// // Listing 5.2: pressure rises by at most 2 a metre from where it was lowered.
/// let lattice = Lattice::plane([5, 1], 1.0, Connectivity::Four, [Boundary::Open; 2])?;
/// let mut pressure = [0.0, 9.0, 9.0, 9.0, 3.0];
/// let mut front = Front::new();
/// front.march(&lattice, &[(0, 0.0)], |from, edge: &Edge| {
///     let new_pressure = pressure[from] + 2.0 * edge.distance;
///     (new_pressure < pressure[edge.node]).then(|| {
///         pressure[edge.node] = new_pressure;
///         0.0
///     })
/// })?;
/// assert_eq!(pressure, [0.0, 2.0, 4.0, 6.0, 3.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Front {
    /// When each node is due; infinite for nodes that are not.
    due: Vec<f64>,
    queue: TimeQueue,
}

impl Front {
    /// Memory for fronts; it grows to 8 bytes a node and the narrow band.
    pub fn new() -> Self {
        Self::default()
    }

    /// Marches from `starts`, pairs of a node and the time at which it is due. Returns the
    /// number of times that a node was taken.
    ///
    /// `update(from, edge)` returns when the neighbour `edge.node` is due if it changed it,
    /// else `None`. A node that is due already keeps the earlier of its times; a node that
    /// was taken before is taken again. Nodes due at the same time are taken in node order.
    ///
    /// The march ends when no node is due. It is for `update` to see to that: a value that it
    /// lowers must not fall for ever, as it would round a loop of negative slopes.
    ///
    /// # Errors
    /// [`MarchError::Start`] and [`MarchError::StartTime`]; the latter also for a time from
    /// `update` that is not finite.
    pub fn march(
        &mut self,
        lattice: &Lattice,
        starts: &[(usize, f64)],
        update: impl FnMut(usize, &Edge) -> Option<f64>,
    ) -> Result<usize, MarchError> {
        let mut taken = 0;
        self.search(lattice, starts, update, |_, _| {
            taken += 1;
            ControlFlow::<()>::Continue(())
        })?;
        Ok(taken)
    }

    /// As [`Front::march`], and `visit(node, time)` is told of every node that is taken, before
    /// its edges: it may end the march with [`ControlFlow::Break`], whose value is returned.
    ///
    /// # Errors
    /// As [`Front::march`].
    pub fn search<B>(
        &mut self,
        lattice: &Lattice,
        starts: &[(usize, f64)],
        mut update: impl FnMut(usize, &Edge) -> Option<f64>,
        mut visit: impl FnMut(usize, f64) -> ControlFlow<B>,
    ) -> Result<Option<B>, MarchError> {
        self.begin(lattice.node_count());
        for &(node, time) in starts {
            check_start(lattice, node, time)?;
            self.offer(node, time);
        }
        while let Some((time, node)) = self.queue.pop() {
            if time != self.due[node] {
                continue;
            }
            self.due[node] = f64::INFINITY;
            if let ControlFlow::Break(found) = visit(node, time) {
                return Ok(Some(found));
            }
            for edge in lattice.neighbours(node) {
                if let Some(time) = update(node, &edge) {
                    check_start(lattice, edge.node, time)?;
                    self.offer(edge.node, time);
                }
            }
        }
        Ok(None)
    }

    /// Forgets a march that was ended before its time: only nodes of the queue are due.
    fn begin(&mut self, nodes: usize) {
        for node in self.queue.drain() {
            self.due[node] = f64::INFINITY;
        }
        self.due.resize(nodes, f64::INFINITY);
    }

    #[inline]
    fn offer(&mut self, node: usize, time: f64) {
        if time < self.due[node] {
            self.due[node] = time;
            self.queue.push(time, node);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::any_lattice;
    use crate::{Boundary, Connectivity};
    use petgraph::algo::dijkstra;
    use proptest::prelude::*;

    /// Distance over edges from `start`, by the front.
    fn path_lengths(lattice: &Lattice, start: usize) -> Vec<f64> {
        path_lengths_by(&mut Front::new(), lattice, start)
    }

    fn path_lengths_by(front: &mut Front, lattice: &Lattice, start: usize) -> Vec<f64> {
        let mut length = vec![f64::INFINITY; lattice.node_count()];
        length[start] = 0.0;
        let taken = front.march(lattice, &[(start, 0.0)], |from, edge| {
            let through = length[from] + edge.distance;
            (through < length[edge.node]).then(|| {
                length[edge.node] = through;
                through
            })
        });
        // Times never fall on the way, so no node is taken twice.
        assert_eq!(taken, Ok(lattice.node_count()));
        length
    }

    proptest! {
        #[test]
        fn a_front_of_lengths_is_the_search_of_dijkstra(
            lattice in any_lattice(), start in 0..1000_usize,
        ) {
            let start = start % lattice.node_count();
            let expected = dijkstra(&lattice, start, None, |edge| {
                *petgraph::visit::EdgeRef::weight(&edge)
            });
            for (node, length) in path_lengths(&lattice, start).into_iter().enumerate() {
                prop_assert_eq!(length, expected[&node]);
            }
        }
    }

    /// Listing 5.1: zones of sources weighted by pressure, against brute force.
    #[test]
    fn zones_go_to_the_source_with_the_least_weighted_distance() {
        let lattice =
            Lattice::plane([41, 31], 1.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
        let sources = [(lattice.node([12, 15, 0]), 1.0), (lattice.node([30, 15, 0]), 2.0)];
        let max_pressure = 2.0;
        let weighted = |node: usize, (source, pressure): (usize, f64)| {
            max_pressure / pressure * lattice.position(node).distance(lattice.position(source))
        };
        let mut nearest = vec![usize::MAX; lattice.node_count()];
        let mut distance = vec![f64::INFINITY; lattice.node_count()];
        for (index, (source, _)) in sources.into_iter().enumerate() {
            nearest[source] = index;
            distance[source] = 0.0;
        }
        let starts = sources.map(|(source, _)| (source, 0.0));
        let marched = Front::new().march(&lattice, &starts, |from, edge| {
            let new_distance = weighted(edge.node, sources[nearest[from]]);
            (new_distance < distance[edge.node]).then(|| {
                distance[edge.node] = new_distance;
                nearest[edge.node] = nearest[from];
                new_distance
            })
        });
        assert!(marched.is_ok());
        for (node, distance) in distance.into_iter().enumerate() {
            let least = sources.map(|source| weighted(node, source));
            assert_eq!(distance, least[0].min(least[1]), "node {node}");
        }
    }

    /// A march that ends early, or with an error, leaves nothing behind for the next.
    #[test]
    fn a_march_ends_when_told_and_the_next_starts_afresh() {
        let lattice = Lattice::plane([9, 9], 1.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
        let mut front = Front::new();
        let mut reached = [false; 81];
        let mut spread = |_: usize, edge: &Edge| {
            let first = !std::mem::replace(&mut reached[edge.node], true);
            first.then_some(edge.node as f64)
        };
        let stop = |node, time| match node {
            12 => ControlFlow::Break(time),
            _ => ControlFlow::Continue(()),
        };
        assert_eq!(
            front.search(&lattice, &[(0, 0.0), (40, 3.0)], &mut spread, stop),
            Ok(Some(12.0))
        );
        assert!(front.march(&lattice, &[(1, 0.0)], |_, _| Some(f64::NAN)).is_err());
        assert_eq!(path_lengths_by(&mut front, &lattice, 4), path_lengths(&lattice, 4));
    }

    #[test]
    fn starts_and_times_without_meaning_are_refused() {
        let lattice = Lattice::plane([3, 2], 1.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
        let mut front = Front::new();
        let outside = front.march(&lattice, &[(6, 0.0)], |_, _| None);
        assert_eq!(outside, Err(MarchError::Start { node: 6, nodes: 6 }));
        let nan = front.march(&lattice, &[(0, 0.0)], |_, _| Some(f64::NAN));
        assert!(matches!(nan, Err(MarchError::StartTime { node: 1, .. })));
    }
}
