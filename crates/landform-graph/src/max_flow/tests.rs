//! Maximum flows against Edmonds and Karp, and against what every flow keeps.

use super::reference::maximum_flow_value;
use super::*;
use crate::testing::any_field;
use crate::{Boundary, Connectivity};
use proptest::prelude::*;

/// What leaves a node less what comes in.
fn surplus(lattice: &Lattice, flow: &MaximumFlow, node: usize) -> i64 {
    lattice.neighbours(node).map(|edge| i64::from(flow.flow[lattice.slot(node, &edge)])).sum()
}

/// Checks that a flow keeps to capacities and starts and ends at terminals only.
fn check(
    lattice: &Lattice,
    flow: &MaximumFlow,
    capacity: impl Fn(usize, &Edge) -> u32,
    sources: &[Terminal],
    sinks: &[Terminal],
) {
    for node in 0..lattice.node_count() {
        for edge in lattice.neighbours(node) {
            let there = flow.flow[lattice.slot(node, &edge)];
            let back = flow.flow[lattice.reverse_slot(&edge)];
            assert_eq!(there, -back);
            assert!(i64::from(there) <= i64::from(capacity(node, &edge)));
        }
        let surplus = surplus(lattice, flow, node);
        if let Some(source) = sources.iter().find(|source| source.node == node) {
            assert!((0..=source.most as i64).contains(&surplus));
        } else if let Some(sink) = sinks.iter().position(|sink| sink.node == node) {
            assert_eq!(surplus, -(flow.taken[sink] as i64));
            assert!(flow.taken[sink] <= sinks[sink].most);
        } else {
            assert_eq!(surplus, 0);
        }
    }
    assert_eq!(flow.value, flow.taken.iter().sum());
}

proptest! {
    #[test]
    fn flows_are_maxima_that_keep_what_flows(
        (lattice, rock) in any_field(),
        ends in prop::collection::vec((0..1000_usize, 0..60_u64), 2..9),
        sources in 1..4_usize,
        one_way in any::<bool>(),
    ) {
        let mut terminals: Vec<Terminal> = Vec::new();
        for (node, most) in ends {
            let node = node % lattice.node_count();
            if terminals.iter().all(|known| known.node != node) {
                terminals.push(Terminal { node, most });
            }
        }
        let (sources, sinks) = terminals.split_at(sources.min(terminals.len()));
        // Walls among the rock, and edges that lead one way only.
        let capacity = |from: usize, edge: &Edge| match rock[from].min(rock[edge.node]) {
            wall if wall < 0.1 => 0,
            _ if one_way && edge.node < from => 0,
            porosity => (porosity * 20.0) as u32,
        };
        let value = maximum_flow_value(&lattice, capacity, sources, sinks);
        let edges = maximum_flow(&lattice, capacity, |_, _| 1.0, sources, sinks).unwrap();
        check(&lattice, &edges, capacity, sources, sinks);
        prop_assert_eq!(edges.value, value);
        // The ways depend on costs, the value does not.
        let cost = |from: usize, edge: &Edge| edge.distance / (0.01 + rock[from] + rock[edge.node]);
        let cheap = maximum_flow(&lattice, capacity, cost, sources, sinks).unwrap();
        check(&lattice, &cheap, capacity, sources, sinks);
        prop_assert_eq!(cheap.value, value);
        // As many sinks take something as units can be brought to at once.
        let units: Vec<Terminal> =
            sinks.iter().map(|sink| Terminal { most: sink.most.min(1), ..*sink }).collect();
        let most_served = maximum_flow_value(&lattice, capacity, sources, &units);
        let served = cheap.taken.iter().filter(|taken| **taken > 0).count();
        prop_assert_eq!(served as u64, most_served);
    }
}

/// More nodes than 16 bits number, and a cut that is known: the narrowest cross-section.
#[test]
fn the_flow_through_a_block_is_that_of_its_narrowest_section() {
    let lattice =
        Lattice::volume([70, 40, 30], 1.0, Connectivity::Voxel6, [Boundary::Open; 3]).unwrap();
    let narrow = |node: usize| if lattice.coordinates(node)[0] == 33 { 2 } else { 5 };
    let capacity = |from: usize, edge: &Edge| narrow(from).min(narrow(edge.node));
    let face = |x: usize| -> Vec<Terminal> {
        let nodes = (0..lattice.node_count()).filter(|&node| lattice.coordinates(node)[0] == x);
        nodes.map(|node| Terminal { node, most: 1000 }).collect()
    };
    let flow = maximum_flow(&lattice, capacity, |_, _| 1.0, &face(0), &face(69)).unwrap();
    assert_eq!(flow.value, 2 * 40 * 30);
    check(&lattice, &flow, capacity, &face(0), &face(69));
}

#[test]
fn what_has_no_meaning_is_refused() {
    let lattice = Lattice::plane([3, 1], 1.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
    let at = |node| Terminal { node, most: 1 };
    let solve = |capacity: u32, sources: &[Terminal], sinks: &[Terminal]| {
        maximum_flow(&lattice, |_, _| capacity, |_, _| 1.0, sources, sinks).map(|flow| flow.value)
    };
    assert_eq!(solve(MOST_CAPACITY, &[at(0)], &[at(2)]), Ok(1));
    assert_eq!(solve(1, &[], &[at(2)]), Ok(0));
    assert_eq!(solve(1, &[at(3)], &[at(2)]), Err(FlowError::Node { node: 3, nodes: 3 }));
    assert_eq!(solve(1, &[at(1)], &[at(1)]), Err(FlowError::Twice { node: 1 }));
    let refused = solve(MOST_CAPACITY + 1, &[at(0)], &[at(2)]);
    assert_eq!(refused, Err(FlowError::Capacity { from: 0, to: 1, capacity: MOST_CAPACITY + 1 }));
    for cost in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let solved = maximum_flow(&lattice, |_, _| 1, |_, _| cost, &[at(0)], &[at(2)]);
        assert!(matches!(solved, Err(FlowError::Cost { from: 0, to: 1, .. })));
    }
}

/// The way to the farther sink leads through the nearer one, which could take all.
#[test]
fn every_sink_gets_a_unit_first() {
    let lattice = Lattice::plane([4, 1], 1.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
    let at = |node| Terminal { node, most: 10 };
    let flow = maximum_flow(&lattice, |_, _| 10, |_, _| 1.0, &[at(0)], &[at(2), at(3)]).unwrap();
    assert_eq!((flow.value, flow.taken.as_slice()), (10, &[9, 1][..]));
}

/// Of two ways of the same number of edges flow takes the cheaper.
#[test]
fn flow_keeps_to_cheap_ways() {
    let lattice = Lattice::plane([3, 3], 1.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
    let at = |node| Terminal { node, most: 1 };
    let dear = 1;
    let cost = |_: usize, edge: &Edge| if edge.node == dear { 9.0 } else { 1.0 };
    let flow = maximum_flow(&lattice, |_, _| 1, cost, &[at(0)], &[at(4)]).unwrap();
    let through =
        |node| lattice.neighbours(node).any(|edge| flow.flow[lattice.slot(node, &edge)] != 0);
    assert!(!through(dear) && through(3));
}
