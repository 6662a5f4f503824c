use super::*;
use crate::testing::any_field;
use crate::{Boundary, Connectivity};
use proptest::prelude::*;

fn square(nodes: usize, side: f64, connectivity: Connectivity) -> Lattice {
    let spacing = side / (nodes - 1) as f64;
    Lattice::plane([nodes, nodes], spacing, connectivity, [Boundary::Open; 2]).unwrap()
}

/// Largest and mean error of the distance from a disc of radius 0.25 around the middle of a
/// square of side 2, whose nodes start at their exact distances.
fn disc_errors(nodes: usize, order: Order) -> [f64; 2] {
    let lattice = square(nodes, 2.0, Connectivity::Eight);
    let middle = lattice.position(lattice.node([nodes / 2, nodes / 2, 0]));
    let exact: Vec<_> =
        (0..lattice.node_count()).map(|node| lattice.position(node).distance(middle)).collect();
    let starts: Vec<_> =
        exact.iter().copied().enumerate().filter(|&(_, distance)| distance <= 0.25).collect();
    let options = MarchOptions { order, ..Default::default() };
    let mut marching = FastMarching::new();
    let found = marching.solve(&lattice, Speed::Uniform(1.0), &starts, options).unwrap();
    let errors = || exact.iter().zip(found.time).map(|(exact, found)| (exact - found).abs());
    [errors().fold(0.0, f64::max), errors().sum::<f64>() / exact.len() as f64]
}

#[test]
fn distance_from_a_disc_converges_at_the_stated_order() {
    for (order, least) in [(Order::First, 0.9), (Order::Second, 1.8)] {
        let (coarse, fine) = (disc_errors(101, order), disc_errors(201, order));
        let rate = (coarse[1] / fine[1]).log2();
        assert!(rate > least && rate < 2.5, "{order:?}: {coarse:?} {fine:?} order {rate}");
    }
}

/// The error of distance from a single node: below 0.6 spacings times the logarithm of the
/// distance in spacings, and never negative.
#[test]
fn distance_from_a_node_has_the_error_of_first_order() {
    let lattice = square(101, 100.0, Connectivity::Four);
    let middle = lattice.node([50, 50, 0]);
    let mut marching = FastMarching::new();
    let found = marching.distance(&lattice, &[middle], MarchOptions::default()).unwrap();
    for (node, time) in found.time.iter().enumerate() {
        let exact = lattice.position(node).distance(lattice.position(middle));
        let error = time - exact;
        assert!(error > -1e-9 && error <= 0.6 * (1.0 + exact).ln() + 1e-9, "{exact} {error}");
    }
}

/// The nearest of the wanted nodes over rough ground is the one of least time of a whole march,
/// and a search that ended early leaves nothing behind.
#[test]
fn a_search_ends_at_the_earliest_node_that_is_wanted() {
    let lattice = square(30, 29.0, Connectivity::Eight);
    let speeds: Vec<f64> = (0..900).map(|node| 1.0 + f64::from(node * 37 % 11)).collect();
    let speed = Speed::Field(&speeds);
    let (starts, options) = ([(465, 0.0), (31, 2.0)], MarchOptions::default());
    let all = FastMarching::new().solve(&lattice, speed, &starts, options).unwrap().time.to_vec();
    let mut marching = FastMarching::new();
    for kind in 50..60 {
        let wanted = |node: usize| node % 61 == kind;
        let found = marching.search(&lattice, speed, &starts, options, |node, time| {
            if wanted(node) { ControlFlow::Break((time, node)) } else { ControlFlow::Continue(()) }
        });
        let times = all.iter().enumerate().filter(|&(node, _)| wanted(node));
        let nearest = times.map(|(node, &time)| (time, node)).min_by(|a, b| a.0.total_cmp(&b.0));
        assert_eq!(found, Ok(nearest));
    }
    assert_eq!(marching.solve(&lattice, speed, &starts, options).unwrap().time, all);
}

#[test]
fn diagonal_edges_change_nothing() {
    let times = [Connectivity::Four, Connectivity::FourEight, Connectivity::Eight].map(|kind| {
        let lattice = square(20, 19.0, kind);
        let mut marching = FastMarching::new();
        marching.distance(&lattice, &[45], MarchOptions::default()).unwrap().time.to_vec()
    });
    assert_eq!(times[0], times[1]);
    assert_eq!(times[0], times[2]);
}

/// A front goes round a wall: along the wall's end the path is two straight lines.
#[test]
fn obstacles_are_gone_around() {
    let lattice = square(101, 100.0, Connectivity::Four);
    let mut speed = vec![1.0; lattice.node_count()];
    for y in 20..=100 {
        speed[lattice.node([50, y, 0])] = 0.0;
    }
    let [from, to] = [[20, 60, 0], [80, 60, 0]].map(|at| lattice.node(at));
    let mut marching = FastMarching::new();
    let options = MarchOptions { order: Order::Second, ..Default::default() };
    let found = marching.solve(&lattice, Speed::Field(&speed), &[(from, 0.0)], options).unwrap();
    // The node beyond the wall's end, (50, 19), is the nearest that the front may pass.
    let exact = 2.0 * 30.0_f64.hypot(41.0);
    let error = found.time[to] / exact - 1.0;
    assert!(error > -0.001 && error < 0.015, "{error}");
    assert!(found.time[lattice.node([50, 60, 0])].is_infinite());
}

#[test]
fn speed_divides_time_and_limit_ends_the_march() {
    let lattice = square(41, 40.0, Connectivity::Four);
    let mut marching = FastMarching::new();
    let all = marching.distance(&lattice, &[820], MarchOptions::default()).unwrap();
    let half = |&time: &f64| if time / 2.0 <= 5.0 { time / 2.0 } else { f64::INFINITY };
    let expected: Vec<_> = all.time.iter().map(half).collect();
    let reached = expected.iter().filter(|time| time.is_finite()).count();
    let limit = MarchOptions { limit: 5.0, ..Default::default() };
    let found = marching.solve(&lattice, Speed::Uniform(2.0), &[(820, 0.0)], limit).unwrap();
    assert_eq!(found.time, expected);
    assert_eq!(found.order.len(), reached);
}

#[test]
fn times_wrap_on_periodic_axes() {
    let lattice =
        Lattice::plane([10, 3], 1.0, Connectivity::Four, [Boundary::Periodic; 2]).unwrap();
    let mut marching = FastMarching::new();
    let found = marching.distance(&lattice, &[0], MarchOptions::default()).unwrap();
    assert_eq!(found.time[..10], [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 4.0, 3.0, 2.0, 1.0]);
}

#[test]
fn what_has_no_meaning_is_refused() {
    let lattice = square(3, 2.0, Connectivity::Four);
    let mut marching = FastMarching::new();
    let mut solve = |speed: &[f64], start| {
        marching
            .solve(&lattice, Speed::Field(speed), &[start], MarchOptions::default())
            .map(|found| found.order.len())
    };
    assert_eq!(solve(&[1.0; 9], (9, 0.0)), Err(MarchError::Start { node: 9, nodes: 9 }));
    let time = f64::INFINITY;
    assert_eq!(solve(&[1.0; 9], (0, time)), Err(MarchError::StartTime { node: 0, time }));
    let short = MarchError::Length { field: "speed", expected: 9, found: 2 };
    assert_eq!(solve(&[1.0; 2], (0, 0.0)), Err(short));
    let mut speeds = [1.0; 9];
    speeds[4] = -1.0;
    assert_eq!(solve(&speeds, (0, 0.0)), Err(MarchError::Speed { node: 4, speed: -1.0 }));
    assert_eq!(solve(&[0.0; 9], (0, 0.0)), Ok(1));
    // A refused march leaves nothing behind in the memory.
    assert_eq!(solve(&[1.0; 9], (0, 0.0)), Ok(9));
}

/// The first-order scheme by sweeps over all nodes until nothing changes: no queue, no order.
fn by_sweeps(lattice: &Lattice, speeds: &[f64], starts: &[(usize, f64)]) -> Vec<f64> {
    let mut time = vec![f64::INFINITY; lattice.node_count()];
    for &(node, start) in starts {
        time[node] = time[node].min(start);
    }
    loop {
        let before = time.clone();
        for node in (0..time.len()).filter(|&node| speeds[node] > 0.0) {
            let at = lattice.coordinates(node);
            let upwind = [0, 1, 2].map(|axis| {
                let beside = [-1, 1].map(|way| {
                    let mut step = [0; 3];
                    step[axis] = way;
                    lattice.offset(at, step).map_or(f64::INFINITY, |node| time[node])
                });
                Upwind::first(beside[0].min(beside[1]))
            });
            time[node] = time[node].min(arrival(upwind, lattice.spacing() / speeds[node]));
        }
        if time == before {
            return time;
        }
    }
}

proptest! {
    #[test]
    fn marching_agrees_with_sweeps(
        (lattice, draws) in any_field(), first in 0..1000_usize, second in 0..1000_usize,
        delay in -1.0..1.0_f64,
    ) {
        let speeds: Vec<_> =
            draws.iter().map(|&draw| if draw < 0.2 { 0.0 } else { draw }).collect();
        let starts = [(first, 0.0), (second, delay)].map(|(n, t)| (n % lattice.node_count(), t));
        let mut marching = FastMarching::new();
        for _ in 0..2 {
            let found = marching
                .solve(&lattice, Speed::Field(&speeds), &starts, MarchOptions::default())
                .unwrap();
            let expected = by_sweeps(&lattice, &speeds, &starts);
            for (found, expected) in found.time.iter().zip(&expected) {
                let close = (found - expected).abs() <= 1e-9 * expected.abs().max(1.0);
                prop_assert!(found == expected || close, "{found} against {expected}");
            }
            let times: Vec<_> = found.order.iter().map(|&node| found.time[node as usize]).collect();
            prop_assert!(times.is_sorted());
            prop_assert_eq!(times.len(), expected.iter().filter(|t| t.is_finite()).count());
        }
    }
}

#[test]
fn memory_serves_lattices_of_any_size() {
    let mut marching = FastMarching::new();
    for nodes in [30, 5, 12, 40] {
        let lattice = square(nodes, 1.0, Connectivity::Four);
        let limit = MarchOptions { limit: 0.5, ..Default::default() };
        let expected = FastMarching::new().distance(&lattice, &[1], limit).unwrap().time.to_vec();
        assert_eq!(marching.distance(&lattice, &[1], limit).unwrap().time, expected);
    }
}
