//! Tests of all algorithms: the reference, conservation, rest, symmetry, threads.

use landform_graph::{Boundary, Connectivity, Lattice};
use landform_sim::random::RandomStream;
use landform_sim::sums::sum;
use proptest::prelude::*;

use super::reference::{PlainColumns, pipes, sweep};
use super::sharing::{Levelling, UniformAverage, WeightedAverage};
use super::units::units;
use super::{Algorithm, Columns, PipeSettings, Place, Side, Sweeper, border_nodes};
use crate::RiverError;

const ALGORITHMS: [Algorithm; 4] = [
    Algorithm::Specialised,
    Algorithm::UniformAverage,
    Algorithm::WeightedAverage,
    Algorithm::Hydrostatic(PipeSettings { step_s: 0.2, cross_section: 0.1, persistence: 0.9 }),
];

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

/// Rough ground on a slope, and ponds on part of it.
fn ground(lattice: &Lattice, seed: u64) -> (Vec<f64>, Vec<f64>) {
    let random = RandomStream::new(seed, "ground");
    let nodes = 0..lattice.node_count();
    let slope = 2.0 * random.unit(0, 0, 2);
    let bed = nodes.clone().map(|node| {
        slope * lattice.coordinates(node)[1] as f64 + 6.0 * random.unit(0, node, 0) - 9.0
    });
    let water = nodes.map(|node| (8.0 * random.unit(0, node, 1) - 5.0).max(0.0));
    (bed.collect(), water.collect())
}

/// Water, received water and flows after some iterations of some sweeps.
fn run(
    lattice: &Lattice,
    algorithm: Algorithm,
    (bed, water): (&[f64], &[f64]),
    iterations: usize,
) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let mut columns = Columns::new(lattice).unwrap();
    let mut sweeper = Sweeper::new(lattice, algorithm).unwrap();
    let (mut water, mut received) = (water.to_vec(), vec![0.0; bed.len()]);
    let mut flows = vec![0.0; lattice.slots()];
    for _ in 0..iterations {
        columns.begin(bed, &water).unwrap();
        for _ in 0..5 {
            sweeper.sweep(&mut columns, &mut flows).unwrap();
        }
        columns.finish(&mut water, &mut received);
    }
    (water, received, flows)
}

proptest! {
    #[test]
    fn sweeps_are_those_of_the_reference(lattice in any_plane(), seed in any::<u64>()) {
        let (bed, water) = ground(&lattice, seed);
        for algorithm in ALGORITHMS {
            let (found, received, flows) = run(&lattice, algorithm, (&bed, &water), 1);
            let in_units = |values: &[f64]| values.iter().map(|&v| units(v)).collect::<Vec<_>>();
            let ground = in_units(&bed);
            let level = ground.iter().zip(&water).map(|(bed, &depth)| bed + units(depth)).collect();
            let mut plain =
                PlainColumns { received: vec![0; ground.len()], level, bed: ground };
            let mut plain_flows = vec![0.0; lattice.slots()];
            for _ in 0..5 {
                match algorithm {
                    Algorithm::Specialised => sweep::<Levelling>(&lattice, &mut plain),
                    Algorithm::UniformAverage => sweep::<UniformAverage>(&lattice, &mut plain),
                    Algorithm::WeightedAverage => sweep::<WeightedAverage>(&lattice, &mut plain),
                    Algorithm::Hydrostatic(settings) => {
                        pipes(&lattice, settings, &mut plain, &mut plain_flows);
                    }
                }
            }
            let depths: Vec<i64> =
                plain.level.iter().zip(&plain.bed).map(|(level, bed)| level - bed).collect();
            prop_assert_eq!(in_units(&found), depths, "{:?}", algorithm);
            prop_assert_eq!(in_units(&received), plain.received, "{:?}", algorithm);
            prop_assert_eq!(flows, plain_flows, "{:?}", algorithm);
        }
    }

    #[test]
    fn water_is_neither_lost_nor_negative(lattice in any_plane(), seed in any::<u64>()) {
        let (bed, water) = ground(&lattice, seed);
        for algorithm in ALGORITHMS {
            let (found, ..) = run(&lattice, algorithm, (&bed, &water), 3);
            prop_assert!(found.iter().all(|&depth| depth >= 0.0));
            let exactly = |depths: &[f64]| depths.iter().map(|&d| i128::from(units(d))).sum::<i128>();
            prop_assert_eq!(exactly(&found), exactly(&water), "{:?}", algorithm);
        }
    }

    /// No level rises above the highest or falls below the lowest wet or dry one.
    #[test]
    fn levels_stay_within_those_before(lattice in any_plane(), seed in any::<u64>()) {
        let (bed, water) = ground(&lattice, seed);
        for algorithm in &ALGORITHMS[..3] {
            let (found, ..) = run(&lattice, *algorithm, (&bed, &water), 1);
            let levels = |water: &[f64]| -> Vec<f64> {
                bed.iter().zip(water).map(|(bed, depth)| bed + depth).collect()
            };
            let highest = |levels: &[f64]| levels.iter().copied().fold(f64::MIN, f64::max);
            prop_assert!(highest(&levels(&found)) <= highest(&levels(&water)) + 1e-9);
        }
    }

    #[test]
    fn a_lake_at_rest_keeps_its_bits(lattice in any_plane(), seed in any::<u64>()) {
        let (bed, _) = ground(&lattice, seed);
        let level = RandomStream::new(seed, "level").unit(0, 0, 0) * 10.0 - 6.0;
        let water: Vec<f64> = bed.iter().map(|bed| (level - bed).max(0.0)).collect();
        for algorithm in ALGORITHMS {
            let (found, received, _) = run(&lattice, algorithm, (&bed, &water), 2);
            if let Algorithm::Hydrostatic(_) = algorithm {
                // Heights that are no whole units differ by one, which sets off flows.
                let change = found.iter().zip(&water).map(|(a, b)| (a - b).abs());
                prop_assert!(change.fold(0.0, f64::max) <= 4.0 * super::UNIT_M);
            } else {
                prop_assert_eq!(&found, &water, "{:?}", algorithm);
                prop_assert!(received.iter().all(|&amount| amount == 0.0));
            }
        }
    }

    /// Ground turned or mirrored keeps water turned or mirrored, bit for bit: no sweep has a
    /// direction.
    #[test]
    fn sweeps_have_no_direction(half in 2_usize..10, seed in any::<u64>()) {
        let side = 2 * half + 1;
        let open = [Boundary::Open; 2];
        for connectivity in [Connectivity::Eight, Connectivity::Four, Connectivity::FourEight] {
            let lattice = Lattice::plane([side; 2], 10.0, connectivity, open).unwrap();
            let (bed, water) = ground(&lattice, seed);
            let mirror = |values: &[f64]| -> Vec<f64> {
                values.chunks(side).flat_map(|row| row.iter().rev().copied()).collect()
            };
            let transpose = |values: &[f64]| -> Vec<f64> {
                (0..side * side).map(|node| values[node % side * side + node / side]).collect()
            };
            for algorithm in &ALGORITHMS[..3] {
                let (found, received, _) = run(&lattice, *algorithm, (&bed, &water), 2);
                for turn in [&mirror as &dyn Fn(&[f64]) -> Vec<f64>, &transpose] {
                    let turned = (turn(&bed), turn(&water));
                    let other = run(&lattice, *algorithm, (&turned.0, &turned.1), 2);
                    prop_assert_eq!(&other.0, &turn(&found), "{:?}", algorithm);
                    prop_assert_eq!(&other.1, &turn(&received), "{:?}", algorithm);
                }
            }
        }
    }
}

/// A bowl that is filled comes to rest at the level that its volume demands.
#[test]
fn water_in_a_bowl_finds_its_level() {
    let lattice = Lattice::plane([24, 20], 10.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
    let bed: Vec<f64> = (0..lattice.node_count())
        .map(|node| {
            let [x, y, _] = lattice.coordinates(node).map(|c| c as f64);
            0.05 * ((x - 12.0).powi(2) + (y - 9.0).powi(2)) + 0.3 * (x * 1.7).sin()
        })
        .collect();
    let mut water = vec![0.0; bed.len()];
    water[lattice.node([3, 4, 0])] = 300.0;
    // The level at which the bowl holds 300 m of depth, by bisection.
    let (mut low, mut high) = (-1.0, 100.0);
    for _ in 0..80 {
        let level = 0.5 * (low + high);
        let held: f64 = bed.iter().map(|bed| (level - bed).max(0.0)).sum();
        if held < 300.0 { low = level } else { high = level }
    }
    for algorithm in ALGORITHMS {
        let (found, received, _) = run(&lattice, algorithm, (&bed, &water), 800);
        let tolerance = if let Algorithm::Hydrostatic(_) = algorithm { 1e-6 } else { 1e-7 };
        for (depth, bed) in found.iter().zip(&bed) {
            let expected = (low - bed).max(0.0);
            assert!((depth - expected).abs() < tolerance, "{algorithm:?}: {depth} {expected}");
        }
        assert!(received.iter().all(|&amount| amount < tolerance), "{algorithm:?}");
    }
}

/// On a plane that closes on itself across the slope every row passes on what the rows above got: flow grows by the rain of a row.
#[test]
fn flow_on_a_plane_is_the_rain_of_the_rows_above() {
    let lattice =
        Lattice::plane([7, 12], 10.0, Connectivity::Eight, [Boundary::Periodic, Boundary::Open])
            .unwrap();
    let bed: Vec<f64> = (0..84).map(|node| f64::from(100 - 5 * (node / 7))).collect();
    let outlet = border_nodes(&lattice, Side::South);
    for algorithm in &ALGORITHMS[..3] {
        let mut columns = Columns::new(&lattice).unwrap();
        let mut sweeper = Sweeper::new(&lattice, *algorithm).unwrap();
        let (mut water, mut flow) = (vec![0.0; 84], vec![0.0; 84]);
        let (mut fallen, mut left) = (0.0, 0.0);
        for _ in 0..400 {
            columns.begin(&bed, &water).unwrap();
            fallen += columns.rain(1.0 / 256.0, None).unwrap();
            sweeper.sweep(&mut columns, &mut []).unwrap();
            left += columns.drain(&outlet);
            assert_eq!(columns.finish(&mut water, &mut flow), 0.0);
        }
        assert_eq!(fallen - left, sum(&water), "what fell and did not leave is there");
        for row in 0..12 {
            let total: f64 = flow[7 * row..][..7].iter().sum();
            let expected = 7.0 / 256.0 * row as f64;
            assert!((total - expected).abs() < 1e-7, "{algorithm:?}, row {row}: {total}");
        }
    }
}

#[test]
fn threads_do_not_change_the_bits() {
    let size = [70, 90];
    let lattice = Lattice::plane(size, 10.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
    let (bed, water) = ground(&lattice, 3);
    for algorithm in ALGORITHMS {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| run(&lattice, algorithm, (&bed, &water), 4))
        };
        let one = with(1);
        assert_eq!(one, with(2), "{algorithm:?}");
        assert_eq!(one, with(8), "{algorithm:?}");
    }
}

#[test]
fn losses_take_the_last_film_and_are_told() {
    let lattice = Lattice::plane([4, 4], 10.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
    let mut columns = Columns::new(&lattice).unwrap();
    let (mut water, mut flow) = (vec![0.0; 16], vec![0.0; 16]);
    water[5] = 2.0;
    columns.begin(&[0.0; 16], &water).unwrap();
    assert_eq!(columns.lose(0.25), 0.5);
    columns.finish(&mut water, &mut flow);
    assert_eq!(water[5], 1.5);
    for _ in 0..200 {
        columns.begin(&[0.0; 16], &water).unwrap();
        columns.lose(0.25);
        columns.finish(&mut water, &mut flow);
    }
    assert_eq!(water, [0.0; 16]);
}

#[test]
fn bad_fields_and_lattices_are_refused() {
    let open = [Boundary::Open; 2];
    let lattice = Lattice::plane([4, 4], 10.0, Connectivity::Eight, open).unwrap();
    let mut columns = Columns::new(&lattice).unwrap();
    let begin = |columns: &mut Columns, bed: f64, water: f64| {
        let (mut beds, mut waters) = ([1.0; 16], [0.5; 16]);
        (beds[7], waters[7]) = (bed, water);
        columns.begin(&beds, &waters)
    };
    for (bed, water) in [(f64::NAN, 0.0), (1e9, 0.0), (0.0, -1e-9), (0.0, f64::INFINITY)] {
        let error = begin(&mut columns, bed, water);
        assert!(matches!(error, Err(RiverError::Value { node: 7, .. })), "{error:?}");
    }
    assert_eq!(begin(&mut columns, 0.0, 0.0), Ok(()));
    let rain = columns.rain(0.1, Some(&[-0.1; 16]));
    assert!(matches!(rain, Err(RiverError::Value { name: "rain", .. })));
    let short = columns.begin(&[0.0; 3], &[0.0; 16]);
    assert_eq!(short, Err(RiverError::Length { name: "bed", found: 3, expected: 16 }));
    let volume = Lattice::volume([3; 3], 1.0, Connectivity::Voxel6, [Boundary::Open; 3]).unwrap();
    assert!(matches!(Columns::new(&volume), Err(RiverError::Volume(_))));
    let long = Algorithm::Hydrostatic(PipeSettings { step_s: 5.0, ..PipeSettings::default() });
    assert!(matches!(Sweeper::new(&lattice, long), Err(RiverError::Unstable { .. })));
    let mut pipes = Sweeper::new(&lattice, ALGORITHMS[3]).unwrap();
    assert!(matches!(pipes.sweep(&mut columns, &mut []), Err(RiverError::Length { .. })));
}

#[test]
fn places_are_discs_on_the_map() {
    let open = [Boundary::Open; 2];
    let lattice = Lattice::plane([5, 4], 10.0, Connectivity::Eight, open).unwrap();
    let nodes = |center, radius_m| Place { center, radius_m }.nodes(&lattice);
    assert_eq!(nodes([0.0, 0.0], 0.0), Ok(vec![15]));
    assert_eq!(nodes([0.52, 0.95], 1.0), Ok(vec![2]));
    assert_eq!(nodes([0.5, 1.0 / 3.0], 10.1), Ok(vec![7, 11, 12, 13, 17]));
    assert!(matches!(nodes([1.1, 0.0], 0.0), Err(RiverError::Outside { .. })));
    assert!(matches!(nodes([0.0, f64::NAN], 0.0), Err(RiverError::Outside { .. })));
    assert_eq!(border_nodes(&lattice, Side::East), [4, 9, 14, 19]);
}
