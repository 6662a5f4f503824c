//! The function against its definition, and what the definition promises.

use std::path::Path;

use landform_graph::{Boundary, Connectivity, Lattice};
use landform_sim::random::RandomStream;
use rand::RngExt;

use super::cell::{Cell, Keys};
use super::forest::Forest;
use super::growth::arrival;
use super::piece::{Joint, Piece};
use super::window::Window;
use super::*;
use crate::FractalNoise;

const SPACING: f64 = 10.0;

fn noise() -> Node {
    Node::Noise(FractalNoise {
        amplitude_m: 300.0,
        wavelength_m: 2000.0,
        octaves: 2,
        ..Default::default()
    })
}

/// Patterns of all kinds, and terrains.
fn patterns() -> Vec<Dendry> {
    let level = Node::Plane(crate::Plane::default());
    let terrain = DendryTerrain { relief_m: Some([-300.0, 300.0]), ..Default::default() };
    vec![
        Dendry { levels: 1, ..Default::default() },
        Dendry { control: noise(), levels: 4, epsilon: 0.0, ..Default::default() },
        Dendry { control: level.clone(), levels: 5, epsilon: 0.5, ..Default::default() },
        Dendry { levels: 6, cell_m: 400.0, displacement: vec![0.2, 0.1], ..Default::default() },
        Dendry { control: noise(), smooth: false, from_nodes: [-31, 17], ..Default::default() },
        Dendry { control: noise(), shows: DendryView::Terrain(terrain), ..Default::default() },
        Dendry {
            control: level,
            levels: 1,
            displacement: vec![0.0],
            shows: DendryView::Terrain(DendryTerrain { slope_power: 0.0, ..terrain }),
            ..Default::default()
        },
    ]
}

fn function(dendry: &Dendry) -> DendryFunction {
    dendry.function(Path::new(""), SPACING, 7).unwrap()
}

fn plane(size: [usize; 2]) -> Lattice {
    Lattice::plane(size, SPACING, Connectivity::Eight, [Boundary::Open; 2]).unwrap()
}

#[test]
fn grids_have_the_bits_of_the_definition() {
    for dendry in patterns() {
        let function = function(&dendry);
        let [width, height] = [90, 70];
        let values = function.values(dendry.from_nodes, [width, height]);
        let stream = RandomStream::new(1, "nodes");
        let count = if dendry.shows == DendryView::Distance { 60 } else { 12 };
        for number in 0..count {
            let mut random = stream.at(0, number);
            let [column, row] = [random.random_range(0..width), random.random_range(0..height)];
            let [x, y] = [column as i64, (height - 1 - row) as i64];
            let node = [x + dendry.from_nodes[0], y + dendry.from_nodes[1]];
            let defined = function.value(node);
            assert_eq!(values[column + width * row].to_bits(), defined.to_bits(), "{dendry:?}");
        }
    }
}

#[test]
fn tiles_are_the_same_region_of_the_whole() {
    for dendry in patterns() {
        // More finest cells than a tree is grown for at a time, for the finest patterns.
        let whole = dendry.generate(&plane([260, 240]), 3).unwrap();
        for ([west, south], [width, height]) in
            [([0, 0], [50, 40]), ([97, 63], [61, 83]), ([259, 239], [1, 1])]
        {
            let from_nodes =
                [dendry.from_nodes[0] + west as i64, dendry.from_nodes[1] + south as i64];
            let tile = Dendry { from_nodes, ..dendry.clone() };
            let tile = tile.generate(&plane([width, height]), 3).unwrap();
            for (row, line) in tile.chunks(width).enumerate() {
                let start = west + 260 * (240 - south - height + row);
                assert_eq!(line, &whole[start..start + width], "{dendry:?}");
            }
        }
    }
}

#[test]
fn threads_do_not_matter_and_seeds_do() {
    let dendry = &patterns()[5];
    let on = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| dendry.generate(&plane([120, 100]), seed).unwrap())
    };
    assert_eq!(on(1, 1), on(4, 1));
    assert_ne!(on(1, 1), on(1, 2));
}

/// Key points lie in their cells, away from the sides; those of coarser levels are kept.
#[test]
fn key_points_are_jittered_and_kept() {
    for epsilon in [0.0, 0.25, 0.5] {
        let keys = Keys::new(5, epsilon);
        for level in 0..6 {
            let window = Window { level, low: [-9, -4], high: [12, 8] };
            let mut new = 0;
            for cell in window.cells() {
                let key = keys.of(cell);
                assert!(cell.holds(key.point));
                new += usize::from(key.new);
                let place =
                    [0, 1].map(|axis| key.point[axis] / cell.width() - cell.at[axis] as f64);
                let inside = |share: f64| (epsilon - 1e-9..=1.0 - epsilon + 1e-9).contains(&share);
                assert!(!key.new || place.into_iter().all(inside), "{place:?}");
                let finer = Cell::holding(5, key.point);
                assert_eq!(keys.of(finer).point, key.point);
            }
            // Every fourth cell keeps that of the cell it is a part of.
            let share = new as f64 / window.cells().count() as f64;
            assert!(level == 0 || (share - 0.75).abs() < 0.06, "{share}");
        }
    }
}

/// Ground that falls to the west, and key points in the middle of their cells: branches lead to
/// the west, and no place of a cell is farther from its key point than its corners.
#[test]
fn distances_are_those_to_the_tree() {
    let falling = crate::Plane { tilt_deg: 10.0, uphill_deg: 0.0, ..Default::default() };
    let dendry = Dendry {
        control: Node::Plane(falling),
        levels: 1,
        epsilon: 0.5,
        displacement: vec![0.0],
        cell_m: 100.0,
        smooth: false,
        ..Default::default()
    };
    let function = dendry.function(Path::new(""), 1.0, 7).unwrap();
    let values = function.values([0, 0], [400, 400]);
    assert!(values.iter().all(|&value| value <= 50.0 * 2.0_f64.sqrt() + 1e-9));
    let key_points = [[150, 150], [250, 50], [350, 350]];
    assert!(key_points.into_iter().all(|node| function.value(node) < 1e-9));
    // Halfway to the west each branch is 0, 50 or 100 m to the south or north, and half of that here.
    for [x, y] in key_points {
        let halfway = [-50, 0, 50].map(|aside| function.value([x - 50, y + aside]));
        assert!(halfway.iter().filter(|&&distance| distance < 1e-9).count() >= 1, "{halfway:?}");
    }
}

/// Distances change by no more than what lies between two places; were a near piece not looked for,
/// there would be steps on the sides of cells.
#[test]
fn distances_have_no_steps() {
    let side = 600;
    for displacement in [0.0, 0.08, 0.2] {
        for epsilon in [0.0, 0.25] {
            let dendry = Dendry {
                control: noise(),
                levels: 4,
                epsilon,
                displacement: vec![displacement],
                cell_m: 100.0,
                ..Default::default()
            };
            let function = dendry.function(Path::new(""), 1.0, 5).unwrap();
            let values = function.values([0, 0], [side; 2]);
            let steps = |(a, b): (&f64, &f64)| (a - b).abs() > 1.0 + 1e-9;
            let east = values.chunks(side).flat_map(|row| row.iter().zip(&row[1..]));
            let north = values.iter().zip(&values[side..]);
            assert!(!east.chain(north).any(steps), "{displacement} {epsilon}");
        }
    }
}

/// All pieces of the tree near some cells.
fn pieces(dendry: &Dendry) -> Vec<Piece> {
    let function = function(dendry);
    let window = Window { level: dendry.levels - 1, low: [0; 2], high: [15; 2] };
    let forest = Forest::grow(&function.growth, window);
    window.cells().flat_map(|cell| forest.near(cell).copied().collect::<Vec<_>>()).collect()
}

#[test]
fn rivers_go_down_at_flints_slope_at_least() {
    let terrain =
        DendryTerrain { relief_m: Some([-300.0, 300.0]), least_slope: 0.2, ..Default::default() };
    let dendry =
        Dendry { control: noise(), shows: DendryView::Terrain(terrain), ..Default::default() };
    let rivers = pieces(&dendry);
    assert!(rivers.iter().all(|river| river.rise <= 0.0));
    // Slopes of levels 2, 1 and 0 by Flint's law with magnitudes 1, 3 and 9; level 0 follows the
    // control function alone.
    let function = function(&dendry);
    for (level, magnitude) in [(2, 1.0), (1, 3.0)] {
        let least = 0.2 * (2.0 * magnitude - 1.0_f64).powf(-0.6);
        let cell = Cell { level, at: [3, 5] };
        let joint =
            Joint { point: cell.place([0.9, 0.9]), height: 50.0, onward: [1.0, 0.0], slope: 0.01 };
        let low = function.growth.tributary(cell, cell.place([0.1, 0.2]), -1000.0, &joint);
        let high = function.growth.tributary(cell, cell.place([0.1, 0.2]), 1000.0, &joint);
        let length = 0.8_f64.hypot(0.7) * cell.width() * dendry.cell_m;
        assert!((low[0].height - (50.0 + least * length)).abs() < 1e-9);
        assert_eq!(high[0].height, 1000.0);
        for branch in [low, high] {
            let last = branch[branch.len() - 1];
            assert!((last.height_at(1.0) - 50.0).abs() < 1e-9);
        }
    }
}

/// Howard's angle: a steep tributary meets a gentle river at a right angle, one that is as steep
/// flows along; from either side it flows towards the other one.
#[test]
fn tributaries_join_at_howards_angle() {
    for (slopes, angle_deg) in [([0.0, 0.1], 90.0_f64), ([0.1, 0.1], 0.0), ([0.05, 0.1], 60.0)] {
        for side in [-1.0, 1.0] {
            let [river, tributary] = slopes;
            let joint = Joint { point: [3.0, 4.0], height: 0.0, onward: [2.0, 0.0], slope: river };
            let [east, north] = arrival([2.9, 4.0 + 0.1 * side], &joint, tributary);
            let found = (-side * north).atan2(east).to_degrees();
            assert!((found - angle_deg).abs() < 1e-9, "{found} {angle_deg}");
        }
    }
}

/// Terrain keeps what a coarse control function says.
#[test]
fn terrain_keeps_the_shape_of_its_control_function() {
    let terrain = DendryTerrain {
        relief_m: Some([-300.0, 300.0]),
        steepest_deg: 15.0,
        least_slope: 0.05,
        ..Default::default()
    };
    let dendry = Dendry {
        control: noise(),
        levels: 2,
        cell_m: 160.0,
        shows: DendryView::Terrain(terrain),
        ..Default::default()
    };
    let lattice = plane([160, 160]);
    let heights = dendry.generate(&lattice, 7).unwrap();
    let points: Vec<[f64; 2]> = (0..160 * 160)
        .map(|node| [node % 160, 159 - node / 160].map(|n| 10.0 * n as f64))
        .collect();
    let control = function(&dendry).growth.control.elevations(&points);
    let mean = |values: &[f64], cell: usize| {
        let start = cell % 10 * 16 + cell / 10 * 16 * 160;
        let rows = (0..16).flat_map(|row| &values[start + row * 160..][..16]);
        rows.sum::<f64>() / 256.0
    };
    let pairs: Vec<[f64; 2]> =
        (0..100).map(|cell| [mean(&control, cell), mean(&heights, cell)]).collect();
    let relief = pairs.iter().map(|pair| pair[0]).fold(f64::NEG_INFINITY, f64::max)
        - pairs.iter().map(|pair| pair[0]).fold(f64::INFINITY, f64::min);
    let worst = pairs.iter().map(|[coarse, fine]| (fine - coarse).abs()).fold(0.0, f64::max);
    assert!(worst < 0.05 * relief, "{worst} {relief}");
}

#[test]
fn bad_parameters_are_refused() {
    let lattice = plane([16, 16]);
    let terrain = |terrain: DendryTerrain| Dendry {
        shows: DendryView::Terrain(terrain),
        ..Default::default()
    };
    let steep = DendryTerrain { steepest_deg: 89.0, ..Default::default() };
    let disc = Node::Disc(crate::Disc { radius_m: -1.0, ..Default::default() });
    for (dendry, message) in [
        (Dendry { levels: 0, ..Default::default() }, "levels is 0; it must be from 1 to 6"),
        (Dendry { levels: 7, ..Default::default() }, "levels is 7"),
        (Dendry { cell_m: 39.0, ..Default::default() }, "cell_m is 39; it must be from 40"),
        (
            Dendry { cell_m: 150.0, ..terrain(DendryTerrain::default()) },
            "cell_m is 150; it must be from 160",
        ),
        (Dendry { epsilon: 0.6, ..Default::default() }, "epsilon is 0.6"),
        (Dendry { displacement: vec![], ..Default::default() }, "displacement: 0 numbers"),
        (Dendry { displacement: vec![f64::NAN], ..Default::default() }, "displacement is NaN"),
        (Dendry { from_nodes: [i64::MAX, 0], ..Default::default() }, "from_nodes is 9"),
        (terrain(steep), "shows.steepest_deg is 89"),
        (
            Dendry { control: disc, ..Default::default() },
            "control: ConstructionTree: radius_m is -1",
        ),
    ] {
        let refused = dendry.generate(&lattice, 0).unwrap_err().to_string();
        assert!(refused.contains(message), "{refused}\n{message}");
    }
    let torus = Lattice::plane([16, 16], SPACING, Connectivity::Eight, [Boundary::Periodic; 2]);
    assert!(Dendry::default().generate(&torus.unwrap(), 0).is_err());
    let unknown = terrain(DendryTerrain::default()).function(Path::new(""), SPACING, 0);
    assert!(unknown.unwrap_err().to_string().contains("shows.relief_m"));
}
