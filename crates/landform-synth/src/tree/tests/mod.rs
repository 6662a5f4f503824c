//! Trees against their equations.

mod bounds;
mod refused;

use std::f64::consts::TAU;

use landform_graph::{Boundary, Connectivity, Lattice};
use landform_sim::random::RandomStream;
use rand::RngExt;

use bounds::{Dice, explored, random_node};
use refused::refusal;

use super::build::Builder;
use super::region::Region;
use super::surface::Surface;
use super::*;
use crate::{Basis, Cascade, FractalNoise, Mask, MaskSource, OctaveShape, Warp};

/// Side of the square on which trees are looked at, and the spacing of their noise.
const SIDE: f64 = 1000.0;
const SPACING: f64 = 10.0;
const SQUARE: Region = Region { low: [0.0; 2], high: [SIDE; 2] };

fn ready(node: &Node) -> Box<dyn Surface> {
    Builder::new(Frame::open(SPACING), Path::new(""), 5).build(node, "of", 1).unwrap()
}

fn at(surface: &dyn Surface, point: [f64; 2]) -> [f64; 2] {
    let samples = surface.sample(&[point]);
    [samples.elevation[0], samples.weight[0]]
}

fn disc(x: f64, y: f64, radius_m: f64, height_m: f64) -> Node {
    Node::Disc(Disc { center_m: [x, y], radius_m, height_m, noise: None })
}

fn level(height_m: f64) -> Node {
    Node::Plane(Plane { height_m, ..Default::default() })
}

fn noise() -> FractalNoise {
    FractalNoise { wavelength_m: 300.0, amplitude_m: 40.0, octaves: 3, ..Default::default() }
}

fn onto(kind: fn(Onto) -> Node, ground: Node, by: Node) -> Node {
    kind(Onto { ground: Box::new(ground), by: Box::new(by) })
}

fn valley() -> Node {
    Node::Curve(Curve {
        points_m: vec![[100.0, 200.0, 20.0], [500.0, 500.0, 10.0], [900.0, 450.0, 0.0]],
        profile_m: vec![[10.0, 0.0], [80.0, 20.0]],
        reach_m: 150.0,
    })
}

/// Some places on the square.
fn places(count: usize) -> Vec<[f64; 2]> {
    let stream = RandomStream::new(3, "places");
    (0..count)
        .map(|number| {
            let mut random = stream.at(0, number);
            [random.random_range(0.0..SIDE), random.random_range(0.0..SIDE)]
        })
        .collect()
}

#[test]
fn operators_have_their_equations() {
    let [a, b] = [disc(400.0, 500.0, 300.0, 80.0), disc(600.0, 450.0, 260.0, 30.0)];
    let fade = |point: [f64; 2], center: [f64; 2], radius: f64| {
        let distance = (point[0] - center[0]).hypot(point[1] - center[1]) / radius;
        if distance < 1.0 { (1.0 - distance.powi(2)).powi(3) } else { 0.0 }
    };
    let mut met = 0;
    for point in places(400) {
        let [wa, wb] = [fade(point, [400.0, 500.0], 300.0), fade(point, [600.0, 450.0], 260.0)];
        met += usize::from(wa > 0.0 && wb > 0.0);
        let mean = (80.0 * wa + 30.0 * wb) / (wa + wb);
        let cases = [
            (Node::Blend(vec![a.clone(), b.clone()]), [mean, wa + wb]),
            (onto(Node::Replace, a.clone(), b.clone()), [80.0 * (1.0 - wb) + 30.0 * wb, wa]),
            (onto(Node::Add, a.clone(), b.clone()), [80.0 + 30.0 * wb, wa]),
            (onto(Node::Carve, a.clone(), b.clone()), [80.0 - 50.0 * wb, wa]),
            (onto(Node::Raise, a.clone(), b.clone()), [80.0, wa]),
            (onto(Node::Raise, b.clone(), a.clone()), [30.0 + 50.0 * wa, wb]),
            (onto(Node::Carve, b.clone(), a.clone()), [30.0, wb]),
        ];
        for (node, expected) in cases {
            let found = at(&*ready(&node), point);
            assert!((found[1] - expected[1]).abs() < 1e-12, "{node:?} {point:?}");
            let same = (found[0] - expected[0]).abs() < 1e-9;
            assert!(same || expected[1] == 0.0, "{node:?} {point:?} {found:?} {expected:?}");
        }
        let tree = ConstructionTree { ground_m: 5.0, of: a.clone() };
        let expected = 5.0 + wa * 75.0;
        assert!((tree.terrain(SPACING, 5).unwrap().elevation(point) - expected).abs() < 1e-12);
    }
    assert!(met > 20);
}

/// `h(p) = c_z + t(p) - t(c)`: the centre has its height whatever the noise.
#[test]
fn discs_keep_the_height_of_their_centre() {
    let detailed = Disc { noise: Some(noise()), center_m: [430.0, 520.0], ..Default::default() };
    let surface = ready(&Node::Disc(detailed));
    assert_eq!(at(&*surface, [430.0, 520.0]), [50.0, 1.0]);
    let [height, weight] = at(&*surface, [530.0, 520.0]);
    assert!((height - 50.0).abs() > 0.1 && (weight - 0.421875).abs() < 1e-12);
}

/// A river along a squig falls from end to end, and its bed is where the curve is.
#[test]
fn squigs_fall_evenly() {
    let squig = Squig {
        from_m: [100.0, 300.0, 60.0],
        to_m: [900.0, 500.0, 20.0],
        profile_m: vec![[0.0, 0.0], [40.0, 10.0]],
        reach_m: 60.0,
        ..Default::default()
    };
    let surface = ready(&Node::Squig(squig.clone()));
    for (place, height) in [(squig.from_m, 60.0), (squig.to_m, 20.0)] {
        let found = at(&*surface, [place[0], place[1]]);
        assert!((found[0] - height).abs() < 1e-6 && (found[1] - 1.0).abs() < 1e-9, "{found:?}");
    }
    explored(&*surface, &surface.bounds(&SQUARE), &squig);
    let bad = Node::Squig(Squig { shortcut: 0.2, ..squig });
    assert!(refusal(bad).contains("shortcut is 0.2"));
}

#[test]
fn placed_nodes_are_moved_turned_and_scaled() {
    let of = Box::new(disc(100.0, 0.0, 50.0, 30.0));
    let placed = Place { of, at_m: [300.0, 400.0], turn_deg: 90.0, scale: 2.0 };
    let surface = ready(&Node::Place(placed));
    let [_, weight] = at(&*surface, [300.0, 600.0]);
    assert!((weight - 1.0).abs() < 1e-12);
    // The rim is 100 m from there now.
    assert!(at(&*surface, [300.0, 699.0])[1] > 0.0);
    assert_eq!(at(&*surface, [300.0, 701.0])[1], 0.0);
    let support = surface.support();
    let corners = [support.low[0], support.low[1], support.high[0], support.high[1]];
    for (found, expected) in corners.into_iter().zip([200.0, 500.0, 400.0, 700.0]) {
        assert!((found - expected).abs() < 1e-9, "{support:?}");
    }
}

#[test]
fn vertical_maps_are_what_they_say() {
    let map = |by: VerticalMap, height: f64| {
        by.check().unwrap();
        at(&*ready(&Node::Deform(Deform { of: Box::new(level(height)), by })), [0.0; 2])[0]
    };
    let scaling = SelectiveScaling { low_m: 100.0, high_m: 300.0, exponent: 2.0 };
    for (height, glacial, canyon) in [
        (100.0, 100.0, 100.0),
        (150.0, 112.5, 187.5),
        (200.0, 150.0, 250.0),
        (300.0, 300.0, 300.0),
        (50.0, 100.0, 0.0),
        (350.0, 400.0, 300.0),
    ] {
        assert!((map(VerticalMap::Glaciation(scaling), height) - glacial).abs() < 1e-9);
        assert!((map(VerticalMap::Canyonism(scaling), height) - canyon).abs() < 1e-9);
    }
    let terraces = Terraces { step_m: 10.0, tread_m: 3.0, riser: 0.5 };
    for (height, expected) in [(3.0, 3.0), (8.0, 3.0), (10.5, 8.0), (12.9, 12.8), (-4.5, -7.0)] {
        let found = map(VerticalMap::Terraces(terraces), height);
        assert!((found - expected).abs() < 1e-9, "{height}: {found}");
    }
    let through = vec![[0.0, 5.0], [10.0, 25.0], [20.0, 15.0]];
    for (height, expected) in [(-1.0, 4.0), (0.0, 5.0), (5.0, 15.0), (15.0, 20.0), (22.0, 17.0)] {
        assert_eq!(map(VerticalMap::Through(through.clone()), height), expected);
    }
}

#[test]
fn rows_have_the_bits_of_single_points() {
    let lattice = Lattice::plane([40, 30], 25.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
    let tree = ConstructionTree { ground_m: 3.0, of: random_node(&mut Dice::new(77), 3) };
    let heights = tree.generate(&lattice, 9).unwrap();
    let terrain = tree.terrain(25.0, 9).unwrap();
    for (node, height) in heights.into_iter().enumerate() {
        let position = lattice.position(node);
        let single = terrain.elevation([position.x, position.y]);
        assert_eq!(height.to_bits(), single.to_bits(), "{node}");
    }
}
