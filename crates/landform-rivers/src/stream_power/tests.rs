//! Tests of the kernels against their definitions and against what is known exactly.

use landform_analysis::grid::Grid;
use landform_analysis::hydrology::{FlowDirections, fill_depressions};
use landform_graph::{Boundary, Connectivity, Lattice};
use landform_sim::random::RandomStream;
use landform_synth::{Generator, SpectralFbm};

use super::{Creep, Evolution, Routes, StreamPowerErosion, reference};
use crate::RiverError;
use crate::water::Side;

const OPEN: [Boundary; 2] = [Boundary::Open; 2];
const BELT: [Boundary; 2] = [Boundary::Periodic, Boundary::Open];

fn plane(size: [usize; 2], boundary: [Boundary; 2]) -> Lattice {
    Lattice::plane(size, 10.0, Connectivity::Eight, boundary).unwrap()
}

/// Rough ground in `steps` steps of height, few of which make flats.
fn rough(lattice: &Lattice, seed: u64, steps: f64) -> Vec<f64> {
    let stream = RandomStream::new(seed, "rough");
    let height = |node: usize| {
        let [x, y, _] = lattice.coordinates(node).map(|at| at as f64);
        ((x / 5.0).sin() + (y / 7.0 + seed as f64).cos() + stream.unit(0, node, 0)) * steps
    };
    (0..lattice.node_count()).map(|node| height(node).round() / steps + 0.0).collect()
}

/// A plane, its base level, and outlets of it.
struct Plane {
    lattice: Lattice,
    base_level: Option<Vec<Side>>,
    outlets: Vec<usize>,
}

/// Planes drained by all borders, a line by its end, a plane by one side, a belt by one, a torus by some
/// nodes.
fn planes() -> Vec<Plane> {
    let sided = |lattice: Lattice, base_level: Option<Vec<Side>>| {
        let settings = StreamPowerErosion { base_level: base_level.clone(), ..Default::default() };
        let outlets = settings.base_level_nodes(&lattice);
        Plane { lattice, base_level, outlets }
    };
    let torus = plane([14, 15], [Boundary::Periodic; 2]);
    vec![
        sided(plane([23, 17], OPEN), None),
        sided(plane([1, 30], OPEN), Some(vec![Side::North])),
        sided(plane([16, 21], OPEN), Some(vec![Side::East])),
        sided(plane([12, 19], BELT), Some(vec![Side::South])),
        Plane { lattice: torus, base_level: None, outlets: vec![0, 77, 140] },
    ]
}

#[test]
fn routes_are_those_of_the_definition() {
    for Plane { lattice, outlets, .. } in planes() {
        for (seed, steps) in [(1, 1e9), (2, 1e9), (3, 8.0), (4, 2.0), (5, 0.5)] {
            let heights = rough(&lattice, seed, steps);
            let mut routes = Routes::new(&lattice).unwrap();
            routes.find(&lattice, &heights, &outlets).unwrap();
            let levels = reference::levels(&lattice, &heights, &outlets);
            let flats = reference::steps_over_flats(&lattice, &levels, &outlets);
            let mut passed = vec![0; heights.len()];
            let mut place = vec![0; heights.len()];
            routes.downstream().enumerate().for_each(|(at, node)| place[node] = at);
            for node in 0..heights.len() {
                let Some(receiver) = routes.receiver(node) else {
                    assert!(outlets.contains(&node));
                    passed[node] += 1;
                    continue;
                };
                match reference::steepest(&lattice, &levels, node) {
                    Some(direction) => assert_eq!(routes.direction(node), Some(direction)),
                    None => {
                        assert_eq!(levels[receiver], levels[node]);
                        assert_eq!(flats[receiver] + 1, flats[node]);
                    }
                }
                let edge = lattice.neighbours(node).find(|edge| edge.node == receiver).unwrap();
                assert_eq!(routes.direction(node), Some(edge.direction));
                assert!(place[node] < place[receiver]);
                let mut below = Some(node);
                while let Some(node) = below {
                    passed[node] += 1;
                    below = routes.receiver(node);
                }
            }
            assert_eq!(routes.cells(), passed);
        }
    }
}

/// The kernels of analysis know open borders only; there both agree but for ties on flats.
#[test]
fn routes_are_those_of_analysis_where_all_borders_are_open() {
    let lattice = plane([61, 47], OPEN);
    let grid = Grid::new([61, 47], [10.0; 2]).unwrap();
    let outlets = StreamPowerErosion::default().base_level_nodes(&lattice);
    let heights = rough(&lattice, 9, 1e9);
    let filled = fill_depressions(&grid, &heights).unwrap();
    let directions = FlowDirections::steepest(&grid, &filled).unwrap();
    let mut routes = Routes::new(&lattice).unwrap();
    routes.find(&lattice, &heights, &outlets).unwrap();
    let mut inner = 0;
    for node in (0..heights.len()).filter(|&node| !grid.is_edge(node)) {
        if let Some(direction) = directions.direction(node) {
            assert_eq!(routes.direction(node), Some(direction));
            inner += 1;
        }
    }
    assert!(inner > 1000);
}

/// One step of incision against the definition, node by node: the equation of each node given the level
/// that its receiver has at the end.
#[test]
fn incision_solves_the_equation_of_every_node() {
    for Plane { lattice, base_level, .. } in planes() {
        for slope_exponent in [0.5, 1.0, 1.7, 3.0] {
            for step_yr in [1e2, 1e6] {
                let settings = StreamPowerErosion {
                    slope_exponent,
                    step_yr,
                    area_exponent: 0.4,
                    erodibility_m_per_yr: 1e-4,
                    diffusivity_m2_per_yr: 0.0,
                    sea_level_m: Some(12.0),
                    base_level: base_level.clone(),
                    ..Default::default()
                };
                let before: Vec<f64> =
                    rough(&lattice, 5, 1e9).iter().map(|height| 20.0 * height).collect();
                check_step(&lattice, &settings, &before);
            }
        }
    }
}

fn check_step(lattice: &Lattice, settings: &StreamPowerErosion, before: &[f64]) {
    let mut evolution = Evolution::new(lattice, settings).unwrap();
    let mut bed = before.to_vec();
    let uplift: Vec<f64> = (0..bed.len()).map(|node| 1e-4 * (node % 7) as f64).collect();
    let evolved = evolution.step(&mut bed, &uplift).unwrap();
    let routes = evolution.routes();
    let sea_m = settings.sea_level_m.unwrap_or(f64::NEG_INFINITY);
    let mut surface = vec![0.0; bed.len()];
    let mut sums = [0.0; 2];
    for node in routes.downstream().rev() {
        let Some(receiver) = routes.receiver(node) else {
            surface[node] = before[node].max(sea_m);
            assert_eq!(bed[node], before[node], "outlets keep their height");
            continue;
        };
        let rise = (settings.uplift_m_per_yr + uplift[node]) * settings.step_yr;
        let height = before[node] + rise - surface[receiver];
        let edge = lattice.neighbours(node).find(|edge| edge.node == receiver).unwrap();
        let area_m2 = f64::from(routes.cells()[node]) * 100.0;
        let remains = match height > 0.0 {
            true => reference::remains(settings, [height, area_m2, edge.distance]),
            false => height,
        };
        let expected = surface[receiver] + remains;
        let scale = 1e-10 * (rise.abs() + before[node].abs() + 1.0);
        assert!((bed[node] - expected).abs() < scale, "{node}: {} {expected}", bed[node]);
        surface[node] = bed[node].max(surface[receiver]);
        assert!((evolution.lost_m()[node] - (height - remains)).abs() < scale);
        sums[0] += rise;
        sums[1] += height - remains;
    }
    assert!((evolved.uplifted_m - sums[0]).abs() <= 1e-9 * sums[0].abs());
    assert!((evolved.incised_m - sums[1]).abs() <= 1e-9 * sums[1].abs());
}

#[test]
fn creep_is_that_of_the_definition_and_loses_nothing() {
    for Plane { lattice, outlets: fixed, .. } in planes() {
        let before = rough(&lattice, 6, 1e9);
        let mut expected = before.clone();
        for _ in 0..3 {
            expected = reference::creep(&lattice, &expected, &fixed, 0.17);
        }
        let mut found = before.clone();
        let mut gained = vec![0.0; fixed.len()];
        Creep::new(&lattice).unwrap().run(&mut found, &fixed, [3.0, 0.17], &mut gained);
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-13, "{found} {expected}");
        }
        let sum = |values: &[f64]| values.iter().sum::<f64>();
        assert!((sum(&before) - sum(&found) - sum(&gained)).abs() < 1e-11);
    }
}

/// Waves of k radians a node along an axis, where the formula is the three-point one, decay by
/// 1 - share (2 - 2 cos k) a step.
#[test]
fn creep_damps_a_wave_as_it_must() {
    let lattice = plane([32, 5], [Boundary::Periodic; 2]);
    let k = std::f64::consts::TAU / 8.0;
    let wave: Vec<f64> = (0..160).map(|node| (k * f64::from(node % 32)).cos()).collect();
    let mut after = wave.clone();
    Creep::new(&lattice).unwrap().run(&mut after, &[], [1.0, 0.2], &mut []);
    let factor = 1.0 - 0.2 * (2.0 - 2.0 * k.cos());
    for (after, before) in after.iter().zip(&wave) {
        assert!((after - factor * before).abs() < 1e-14);
    }
}

/// Creep alone: a parabola, z = U/(2D) x (L - x), but for a part of the metre that rises in a step.
#[test]
fn a_hillslope_at_rest_is_a_parabola() {
    let lattice = plane([7, 21], BELT);
    let settings = StreamPowerErosion {
        erodibility_m_per_yr: 0.0,
        uplift_m_per_yr: 1e-4,
        ..Default::default()
    };
    let mut evolution = Evolution::new(&lattice, &settings).unwrap();
    let mut bed = vec![0.0; lattice.node_count()];
    for _ in 0..500 {
        evolution.step(&mut bed, &[]).unwrap();
    }
    for (node, height) in bed.iter().enumerate() {
        let [x, rest] = [node / 7, 20 - node / 7].map(|nodes| 10.0 * nodes as f64);
        let expected = 1e-4 / (2.0 * 0.01) * x * rest;
        assert!((height - expected).abs() < 0.25, "{node}: {height} {expected}");
    }
}

/// A lake fills its hollow and spills: its floor only rises, and its outlet is cut with the water of all
/// that drains to the lake.
#[test]
fn a_lake_spills_over_the_lowest_point_of_its_rim() {
    let lattice = plane([9, 9], OPEN);
    let height = |node: usize| {
        let [x, y, _] = lattice.coordinates(node).map(|at| at as f64 - 4.0);
        match x.abs().max(y.abs()) {
            ring if ring < 2.0 => 1.0,
            ring if ring < 3.0 => 10.0,
            ring => 4.0 - ring,
        }
    };
    let mut bed: Vec<f64> = (0..81).map(height).collect();
    let gap = lattice.node([2, 4, 0]);
    bed[gap] = 6.0;
    let before = bed.clone();
    let settings = StreamPowerErosion {
        uplift_m_per_yr: 0.0,
        diffusivity_m2_per_yr: 0.0,
        ..Default::default()
    };
    let mut evolution = Evolution::new(&lattice, &settings).unwrap();
    evolution.step(&mut bed, &[]).unwrap();
    let floor = lattice.node([4, 4, 0]);
    assert_eq!(bed[floor], before[floor]);
    assert!(evolution.routes().cells()[gap] >= 10, "{:?}", evolution.routes().cells());
    assert!(bed[gap] < before[gap] && bed[gap] > before[floor]);
    for _ in 0..2000 {
        evolution.step(&mut bed, &[]).unwrap();
    }
    assert!(bed[floor] < 0.1, "the lake has drained: {}", bed[floor]);
}

#[test]
fn what_changed_is_booked() {
    for Plane { lattice, base_level, .. } in planes() {
        let settings = StreamPowerErosion {
            sea_level_m: Some(0.1),
            base_level,
            diffusivity_m2_per_yr: 0.05,
            ..Default::default()
        };
        let mut bed = rough(&lattice, 8, 1e9);
        let before = bed.clone();
        let mut evolution = Evolution::new(&lattice, &settings).unwrap();
        let evolved = evolution.step(&mut bed, &[]).unwrap();
        let change: f64 = bed.iter().zip(&before).map(|(after, before)| after - before).sum();
        let booked = evolved.uplifted_m - evolved.incised_m - evolved.crept_m;
        assert!((change - booked).abs() < 1e-9 * evolved.uplifted_m, "{change} {evolved:?}");
        let kept = before.iter().zip(&bed).filter(|(before, _)| **before < 0.1);
        assert!(kept.clone().count() > 0 && kept.clone().all(|(before, after)| before == after));
        assert!(evolved.crept_m != 0.0 && evolved.incised_m > 0.0);
    }
}

/// Nodes without data keep their height, and water leaves there.
#[test]
fn kept_nodes_are_base_level() {
    let lattice = plane([9, 9], OPEN);
    let settings = StreamPowerErosion { base_level: Some(vec![Side::North]), ..Default::default() };
    let mut evolution = Evolution::new(&lattice, &settings).unwrap();
    let hole = lattice.node([4, 6, 0]);
    evolution.keep([hole, 3]);
    let mut bed = vec![1.0; 81];
    bed[hole] = 0.5;
    (0..50).for_each(|_| _ = evolution.step(&mut bed, &[]).unwrap());
    assert_eq!((bed[hole], bed[3]), (0.5, 1.0));
    assert!(evolution.routes().receiver(hole).is_none());
    assert!(evolution.routes().cells()[hole] > 20);
}

/// Terrain, routes and losses do not depend on the number of threads.
#[test]
fn threads_do_not_change_the_bits() {
    let lattice = plane([130, 97], BELT);
    let fbm = SpectralFbm { amplitude_m: 100.0, ..Default::default() };
    let start = fbm.generate(&lattice, 3).unwrap();
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut bed = start.clone();
            let settings = StreamPowerErosion::default();
            let mut evolution = Evolution::new(&lattice, &settings).unwrap();
            let last = (0..5).map(|_| evolution.step(&mut bed, &[]).unwrap()).last();
            (bed, last, evolution.lost_m().to_vec())
        })
    };
    let one = run(1);
    assert_eq!(one, run(2));
    assert_eq!(one, run(8));
}

#[test]
fn what_does_not_suit_is_refused() {
    let lattice = plane([9, 9], BELT);
    let check = |settings: StreamPowerErosion| settings.check(&lattice);
    let long = StreamPowerErosion { step_yr: 1e9, ..Default::default() };
    assert!(matches!(check(long), Err(RiverError::LongStep { .. })));
    let west = StreamPowerErosion { base_level: Some(vec![Side::West]), ..Default::default() };
    assert_eq!(check(west), Err(RiverError::NoBorder { border: "west border" }));
    let none = StreamPowerErosion { base_level: Some(Vec::new()), ..Default::default() };
    assert_eq!(check(none.clone()), Err(RiverError::NoOutlet));
    let four = Lattice::plane([9, 9], 10.0, Connectivity::Four, OPEN).unwrap();
    let error = StreamPowerErosion::default().check(&four);
    assert_eq!(error, Err(RiverError::Directions(Connectivity::Four)));
    // A sea that is nowhere.
    let dry = StreamPowerErosion { sea_level_m: Some(-10.0), ..none };
    let mut evolution = Evolution::new(&lattice, &dry).unwrap();
    assert_eq!(evolution.step(&mut [0.0; 81], &[]), Err(RiverError::NoOutlet));
    let mut broken = [0.0; 81];
    broken[7] = f64::NAN;
    assert!(matches!(evolution.step(&mut broken, &[]), Err(RiverError::Value { node: 7, .. })));
    assert!(matches!(evolution.step(&mut [0.0; 9], &[]), Err(RiverError::Length { .. })));
}
