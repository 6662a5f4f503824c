//! Tests of flow maps and of the equation: definitions, analytic values, limits, symmetry.

use std::f64::consts::TAU;

use landform_graph::{Boundary, BreadthFirst, Connectivity, Lattice, Quadric, Reach};
use landform_sim::random::RandomStream;
use proptest::prelude::*;

use super::equation::rise;
use super::{
    Change, Diffusion, HydraulicErosion, additional_flow, compact_laplacian, erode, flow_map,
    relative_flow,
};
use crate::RiverError;
use crate::water::Side;

/// Any small plane.
fn any_plane() -> impl Strategy<Value = Lattice> {
    use Connectivity::{Eight, Four, FourEight};
    let connectivity = prop_oneof![Just(FourEight), Just(Four), Just(Eight)];
    let boundary = || prop_oneof![Just(Boundary::Open), Just(Boundary::Periodic)];
    let size = || (2_usize..9).prop_map(|half| 2 * half);
    (size(), size(), connectivity, boundary(), boundary()).prop_map(|(width, height, c, x, y)| {
        Lattice::plane([width, height], 10.0, c, [x, y]).unwrap()
    })
}

fn torus(side: usize) -> Lattice {
    Lattice::plane([side; 2], 10.0, Connectivity::Eight, [Boundary::Periodic; 2]).unwrap()
}

/// Rough ground, and flows of which few are large.
fn ground(lattice: &Lattice, seed: u64) -> (Vec<f64>, Vec<f64>) {
    let random = RandomStream::new(seed, "ground");
    let nodes = 0..lattice.node_count();
    let bed = nodes.clone().map(|node| 12.0 * random.unit(0, node, 0)).collect();
    let flow = nodes.map(|node| random.unit(0, node, 1).powi(6)).collect();
    (bed, flow)
}

/// Equation 4.4 node by node, from quadric fits and neighbours of the lattice.
fn by_definition(
    lattice: &Lattice,
    settings: &HydraulicErosion,
    f: &[f64],
    bed: &[f64],
    dt: f64,
) -> Vec<f64> {
    let beside = |node: usize, step: [isize; 2]| {
        let origin = lattice.coordinates(node);
        let clamped = std::array::from_fn(|axis| {
            let leaves = |step: isize| {
                let mut along = [0; 3];
                along[axis] = step;
                lattice.offset(origin, along).is_none()
            };
            let step = if axis < 2 { step[axis] } else { 0 };
            if leaves(step) { 0 } else { step }
        });
        lattice.offset(origin, clamped).map(|other| bed[other]).unwrap()
    };
    let steps = [[1, 0], [0, -1], [-1, 0], [0, 1], [1, -1], [-1, -1], [-1, 1], [1, 1]];
    let height = |node: usize| {
        let around = steps.map(|step| beside(node, step));
        let laplacian = compact_laplacian(bed[node], &around) / lattice.spacing().powi(2);
        let gradient = Quadric::fit(lattice, bed, node).gradient;
        let slope = (gradient.x * gradient.x + gradient.y * gradient.y).sqrt();
        let neighbours = lattice.neighbours(node).map(|edge| bed[edge.node]);
        let lowest = neighbours.fold(f64::INFINITY, f64::min);
        bed[node] + rise(settings, f[node], dt, [bed[node], lowest, slope, laplacian])
    };
    (0..bed.len()).map(height).collect()
}

proptest! {
    #[test]
    fn a_step_is_the_equation_at_every_node(lattice in any_plane(), seed in any::<u64>()) {
        let (bed, f) = ground(&lattice, seed);
        for diffusion in [Diffusion::InChannels, Diffusion::Everywhere] {
            // Two steps an iteration where the flow is 1.
            let settings = HydraulicErosion {
                diffusion, diffusion_m2: 30.0, uplift_m: 0.2, ..Default::default()
            };
            let most = f.iter().copied().fold(0.0, f64::max);
            let steps = settings.steps(&lattice, most);
            let mut eroded = bed.clone();
            erode(&lattice, &settings, &f, &mut eroded, &[]).unwrap();
            let mut expected = bed.clone();
            for _ in 0..steps as usize {
                expected = by_definition(&lattice, &settings, &f, &expected, 1.0 / steps);
            }
            prop_assert_eq!(eroded, expected);
        }
    }

    #[test]
    fn what_changed_is_booked(lattice in any_plane(), seed in any::<u64>()) {
        let (bed, f) = ground(&lattice, seed);
        let settings = HydraulicErosion { uplift_m: 0.3, ..Default::default() };
        let mut eroded = bed.clone();
        let Change { eroded_m, deposited_m, uplifted_m } =
            erode(&lattice, &settings, &f, &mut eroded, &[0, 3]).unwrap();
        prop_assert_eq!((eroded[0], eroded[3]), (bed[0], bed[3]));
        prop_assert!(eroded_m > 0.0 && deposited_m >= 0.0);
        prop_assert!((uplifted_m - 0.3 * (bed.len() - 2) as f64).abs() < 1e-9);
        let change: f64 = eroded.iter().zip(&bed).map(|(after, before)| after - before).sum();
        prop_assert!((change - (uplifted_m + deposited_m - eroded_m)).abs() < 1e-9);
    }

    /// Without diffusion and fixed erosion, water only ever lowers ground, and never below the
    /// lowest neighbour.
    #[test]
    fn incision_stops_at_the_lowest_neighbour(lattice in any_plane(), seed in any::<u64>()) {
        let (bed, f) = ground(&lattice, seed);
        let settings = HydraulicErosion {
            diffusion_m2: 0.0, bed_erosion_m: 0.0, incision_m: 1e4, ..Default::default()
        };
        let mut eroded = bed.clone();
        erode(&lattice, &settings, &f, &mut eroded, &[]).unwrap();
        for (node, after) in eroded.iter().enumerate() {
            let neighbours = lattice.neighbours(node).map(|edge| bed[edge.node]);
            let lowest = neighbours.fold(f64::INFINITY, f64::min);
            prop_assert!(*after <= bed[node] && *after >= lowest.min(bed[node]) - 1e-12);
        }
    }

    /// The definition: every higher node within reach, by a breadth-first search.
    #[test]
    fn rivers_add_flow_to_all_higher_nodes_in_reach(lattice in any_plane(), seed in any::<u64>()) {
        let (bed, flow) = ground(&lattice, seed);
        let lattice = Lattice::plane(
            [lattice.width(), lattice.height()],
            10.0,
            Connectivity::Eight,
            [Boundary::Open; 2],
        ).unwrap();
        let added = additional_flow(&lattice, &bed, &flow, 0.3, 35.0);
        let mut expected = vec![0.0; bed.len()];
        let mut search = BreadthFirst::new();
        for river in 0..bed.len() {
            let reach = Reach::metres(flow[river] * 35.0);
            for visit in search.collect(&lattice, &[river], reach, |_, _| true) {
                if bed[visit.node] > bed[river] {
                    expected[visit.node] += 0.3 * flow[river];
                }
            }
        }
        for (found, expected) in added.iter().zip(&expected) {
            prop_assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
    }
}

/// A wave keeps its shape and shrinks: exp(-k^2 D t) for fine steps, and by the symbol of the
/// nine-point formula for the chequerboard, the wave that a fitted quadric amplifies.
#[test]
fn diffusion_damps_every_wave_by_its_symbol() {
    let lattice = torus(16);
    let settings = HydraulicErosion {
        diffusion: Diffusion::Everywhere,
        diffusion_m2: 10.0,
        ..Default::default()
    };
    for (x_waves, y_waves) in [(1, 0), (1, 1), (3, 2), (8, 0), (8, 8)] {
        let phase = |node: usize| {
            let [x, y, _] = lattice.coordinates(node);
            TAU * (x_waves * x + y_waves * y) as f64 / 16.0
        };
        let bed: Vec<f64> = (0..256).map(|node| phase(node).cos()).collect();
        let mut after = bed.clone();
        erode(&lattice, &settings, &[0.0; 256], &mut after, &[]).unwrap();
        let [a, b] = [x_waves, y_waves].map(|waves: usize| (TAU * waves as f64 / 16.0).cos());
        let symbol = (8.0 * (a + b) + 4.0 * a * b - 20.0) / 6.0;
        let damping = 1.0 + 10.0 / 100.0 * symbol;
        assert!(damping.abs() < 1.0);
        for (before, after) in bed.iter().zip(&after) {
            // Where a step ends at the lowest neighbour the wave cannot fall further.
            assert!((after - before * damping).abs() < 1e-12, "{x_waves} {y_waves}");
        }
    }
    let wave = TAU / 160.0;
    let symbol = (8.0 * ((wave * 10.0).cos() + 1.0) + 4.0 * (wave * 10.0).cos() - 20.0) / 6.0;
    assert!((symbol / -(wave * 10.0).powi(2) - 1.0).abs() < 0.02, "second order for long waves");
}

/// On a plane of slope s where all flow is f, the bed falls by f (w_d s + w_0) everywhere.
#[test]
fn a_plane_under_even_flow_falls_evenly() {
    let lattice =
        Lattice::plane([6, 9], 10.0, Connectivity::Eight, [Boundary::Periodic, Boundary::Open])
            .unwrap();
    let bed: Vec<f64> = (0..54).map(|node| -2.0 * (node / 6) as f64).collect();
    let settings = HydraulicErosion::default();
    let mut after = bed.clone();
    erode(&lattice, &settings, &[0.25; 54], &mut after, &[]).unwrap();
    for node in 6..48 {
        let expected = 0.25 * (3.0 * 0.2 + 1.5);
        assert!((bed[node] - after[node] - expected).abs() < 1e-12);
    }
}

#[test]
fn flow_is_weighed_as_equation_4_5_says() {
    let lattice = torus(4);
    let mut received = [0.0; 16];
    (received[5], received[6]) = (4.0, 1.0);
    assert_eq!(relative_flow(&received)[6], 0.25);
    assert_eq!(relative_flow(&[0.0; 16]), [0.0; 16]);
    let mut bed = [0.0; 16];
    (bed[6], bed[9]) = (3.0, 2.0);
    let settings = HydraulicErosion {
        avalanche_weight: 2.0,
        avalanche_fraction: 0.5,
        avalanche_radius_m: 10.0,
        ..Default::default()
    };
    let f = flow_map(&lattice, &settings, &bed, &received);
    assert_eq!((f[5], f[6], f[9], f[0]), (2.0_f64.sqrt(), 1.5_f64.sqrt(), 1.0, 0.0));
    // More than 1 in all is scaled to 1.
    let (near, many) = ([0.0, 5.0, 0.0, 5.0], [1.0, 0.0, 1.0, 0.0]);
    let bed: Vec<f64> = (0..16).map(|node| near[node % 4]).collect();
    let received: Vec<f64> = (0..16).map(|node| many[node % 4]).collect();
    let settings = HydraulicErosion { flow_exponent: 1.0, avalanche_radius_m: 15.0, ..settings };
    let f = flow_map(&lattice, &settings, &bed, &received);
    assert!(f.iter().all(|&f| f == 2.0), "{f:?}");
}

/// Mirrored ground erodes to mirrored ground, bit for bit.
#[test]
fn erosion_has_no_direction() {
    let open = [Boundary::Open; 2];
    let lattice = Lattice::plane([11, 8], 10.0, Connectivity::Eight, open).unwrap();
    let (bed, flow) = ground(&lattice, 5);
    let mirror = |values: &[f64]| -> Vec<f64> {
        values.chunks(11).flat_map(|row| row.iter().rev().copied()).collect()
    };
    let eroded = |bed: &[f64], flow: &[f64]| {
        let settings = HydraulicErosion { avalanche_weight: 0.0, ..Default::default() };
        let f = flow_map(&lattice, &settings, bed, flow);
        let mut bed = bed.to_vec();
        erode(&lattice, &settings, &f, &mut bed, &[]).unwrap();
        bed
    };
    assert_eq!(eroded(&mirror(&bed), &mirror(&flow)), mirror(&eroded(&bed, &flow)));
}

#[test]
fn settings_that_do_not_suit_the_lattice_are_refused() {
    let lattice = torus(4);
    let stiff = HydraulicErosion { diffusion_m2: 1e5, ..Default::default() };
    assert!(matches!(stiff.check(&lattice), Err(RiverError::Stiff { .. })));
    let no_border = HydraulicErosion { base_level: vec![Side::South], ..Default::default() };
    let error = no_border.check(&lattice);
    assert_eq!(error, Err(RiverError::NoBorder { border: "south border" }));
    let short = erode(&lattice, &HydraulicErosion::default(), &[0.0; 16], &mut [0.0; 9], &[]);
    assert_eq!(short, Err(RiverError::Length { name: "bed", found: 9, expected: 16 }));
}

/// A beach: land falls into a sea, whose floor keeps its form, and is not worn below it.
#[test]
fn land_is_not_worn_below_the_sea_nor_its_floor_at_all() {
    let open = [Boundary::Open; 2];
    let lattice = Lattice::plane([24, 16], 10.0, Connectivity::Eight, open).unwrap();
    let bed: Vec<f64> = (0..384).map(|node| (node % 24) as f64 - 7.5).collect();
    let settings = HydraulicErosion {
        sea_level_m: Some(0.0),
        incision_m: 30.0,
        bed_erosion_m: 30.0,
        ..Default::default()
    };
    let mut eroded = bed.clone();
    for _ in 0..20 {
        let change = erode(&lattice, &settings, &[1.0; 384], &mut eroded, &[]).unwrap();
        let lost: f64 = change.eroded_m - change.deposited_m;
        assert!(lost >= 0.0);
    }
    for (after, before) in eroded.iter().zip(&bed) {
        match *before < 0.0 {
            true => assert_eq!(after, before),
            false => assert!((0.0..=*before).contains(after), "{before} became {after}"),
        }
    }
    assert!(eroded[23] < 1.0, "all land is low");
}
