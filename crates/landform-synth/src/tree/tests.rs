//! Trees against their equations, and bounds against what is found.

use std::f64::consts::TAU;

use landform_graph::{Boundary, Connectivity, Lattice};
use landform_sim::random::RandomStream;
use rand::RngExt;

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

/// What a node is found to do on the square.
struct Found {
    slope: f64,
    faded_slope: f64,
    weight_slope: f64,
}

/// Compares places that are close to each other; asserts that nothing leaves its bounds.
fn explored(surface: &dyn Surface, bounds: &Bounds, what: &dyn std::fmt::Debug) -> Found {
    let step = 1e-3;
    let near: Vec<[f64; 2]> = places(3000)
        .into_iter()
        .enumerate()
        .flat_map(|(number, [x, y])| {
            let (north, east) = (0.618 * number as f64 * TAU).sin_cos();
            [[x, y], [x + step * east, y + step * north]]
        })
        .collect();
    let samples = surface.sample(&near);
    let mut found = Found { slope: 0.0, faded_slope: 0.0, weight_slope: 0.0 };
    for pair in (0..near.len()).step_by(2) {
        let rise = |values: &[f64]| (values[pair + 1] - values[pair]).abs() / step;
        let [weight, other] = [samples.weight[pair], samples.weight[pair + 1]];
        found.weight_slope = found.weight_slope.max(rise(&samples.weight));
        let [low, high] = bounds.weight;
        assert!((low - 1e-12..=high + 1e-12).contains(&weight), "{what:?} {bounds:?} {weight}");
        if weight > 0.0 && other > 0.0 {
            let slope = rise(&samples.elevation);
            found.slope = found.slope.max(slope);
            found.faded_slope = found.faded_slope.max(slope * weight.min(other).min(1.0));
            let [low, high] = bounds.elevation_m;
            let height = samples.elevation[pair];
            assert!((low - 1e-6..=high + 1e-6).contains(&height), "{what:?} {bounds:?} {height}");
        }
    }
    let slack = |bound: f64| bound * (1.0 + 1e-6) + 1e-7;
    assert!(found.slope <= slack(bounds.slope), "{} {bounds:?} {what:?}", found.slope);
    assert!(found.faded_slope <= slack(bounds.faded_slope), "{bounds:?} {what:?}");
    assert!(found.weight_slope <= slack(bounds.weight_slope), "{bounds:?} {what:?}");
    found
}

/// The bound of simple trees is no more than a few times what is found.
#[test]
fn bounds_of_simple_trees_hold_and_are_close() {
    let single = FractalNoise { octaves: 1, ..noise() };
    let hill = || disc(500.0, 500.0, 300.0, 60.0);
    let tilted = Node::Plane(Plane { tilt_deg: 10.0, uphill_deg: 30.0, ..Default::default() });
    let bell = Node::Bell(Bell { center_m: [500.0; 2], height_m: 80.0, radius_m: 150.0 });
    let scaling = SelectiveScaling { low_m: -40.0, high_m: 40.0, exponent: 2.0 };
    let warp = Warp { amplitude_m: 30.0, wavelength_m: 400.0, octaves: 1 };
    let raised = |by: VerticalMap| Node::Deform(Deform { of: Box::new(Node::Noise(single)), by });
    let cases: Vec<(&str, Node, f64)> = vec![
        ("plane", tilted.clone(), 1.0001),
        ("bell", bell.clone(), 1.01),
        ("noise", Node::Noise(single), 1.4),
        ("octaves", Node::Noise(noise()), 2.5),
        ("hill on level ground", onto(Node::Replace, level(0.0), hill()), 1.01),
        ("hill on a plane", onto(Node::Replace, tilted.clone(), hill()), 2.5),
        ("hill added", onto(Node::Add, tilted.clone(), hill()), 1.5),
        ("valley", onto(Node::Carve, level(40.0), valley()), 3.0),
        ("blend on ground", Node::Blend(vec![level(0.0), hill()]), 2.0),
        (
            "two hills on ground",
            Node::Blend(vec![level(0.0), hill(), disc(700.0, 500.0, 200.0, 40.0)]),
            4.0,
        ),
        (
            "placed",
            Node::Place(Place {
                of: Box::new(bell.clone()),
                at_m: [250.0; 2],
                turn_deg: 0.0,
                scale: 0.5,
            }),
            1.01,
        ),
        ("warped", Node::Warp(Warped { of: Box::new(bell), by: warp }), 1.6),
        ("glaciation", raised(VerticalMap::Glaciation(scaling)), 2.5),
        ("canyonism", raised(VerticalMap::Canyonism(scaling)), 2.5),
        ("terraces", raised(VerticalMap::Terraces(Terraces::default())), 1.7),
    ];
    for (name, node, factor) in cases {
        let surface = ready(&node);
        let bounds = surface.bounds(&SQUARE);
        let found = explored(&*surface, &bounds, &name);
        println!("{name}: bound {:.4}, found {:.4}", bounds.slope, found.slope);
        assert!(bounds.slope <= factor * found.slope, "{name}");
    }
}

/// All noises, shapes and cascades.
#[test]
fn bounds_of_noises_hold() {
    use Basis::{CellularDifference, CellularNearest, CellularSecond, Gradient, Simplex};
    use OctaveShape::{CrossedRidges, Plain, Ridges, SharpRidges, Turbulence};
    let cascades = [
        Cascade::Sum,
        Cascade::Multiplicative { offset: 0.9 },
        Cascade::Hybrid { offset: 0.7 },
        Cascade::Ridged { gain: 2.0 },
    ];
    for basis in [Gradient, Simplex, CellularNearest, CellularSecond, CellularDifference] {
        for shape in [Plain, Turbulence, Ridges, SharpRidges, CrossedRidges] {
            for cascade in cascades {
                for octaves in [1, 4] {
                    let noise = FractalNoise { basis, shape, cascade, octaves, ..noise() };
                    let surface = ready(&Node::Noise(noise));
                    let bounds = surface.bounds(&SQUARE);
                    let found = explored(&*surface, &bounds, &noise);
                    if octaves == 1 {
                        assert!(bounds.slope < 6.0 * found.slope, "{noise:?} {}", found.slope);
                    }
                }
            }
        }
    }
}

/// Random choices for random trees.
struct Dice {
    stream: RandomStream,
    thrown: usize,
}

impl Dice {
    fn new(seed: u64) -> Self {
        Self { stream: RandomStream::new(seed, "random tree"), thrown: 0 }
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        self.thrown += 1;
        least + (most - least) * self.stream.unit(0, self.thrown, 0)
    }

    fn place(&mut self) -> [f64; 2] {
        [self.between(0.0, SIDE), self.between(0.0, SIDE)]
    }
}

fn random_mask(dice: &mut Dice) -> Option<Mask> {
    let ring = (0..7).map(|_| dice.place()).collect();
    let edge_m = Some(dice.between(10.0, 200.0));
    let mask = Mask { of: MaskSource::Rings(vec![ring]), edge_m, ..Default::default() };
    (dice.between(0.0, 1.0) < 0.5).then_some(mask)
}

fn random_leaf(dice: &mut Dice) -> Node {
    let height_m = dice.between(-50.0, 100.0);
    match dice.between(0.0, 6.0) as usize {
        0 => Node::Noise(FractalNoise { amplitude_m: dice.between(1.0, 50.0), ..noise() }),
        1 => Node::Plane(Plane {
            height_m,
            at_m: dice.place(),
            tilt_deg: dice.between(0.0, 20.0),
            uphill_deg: dice.between(0.0, 360.0),
        }),
        2 => Node::Bell(Bell {
            center_m: dice.place(),
            height_m,
            radius_m: dice.between(20.0, 300.0),
        }),
        3 => Node::Curve(Curve {
            points_m: (0..5)
                .map(|_| {
                    let [x, y] = dice.place();
                    [x, y, dice.between(0.0, 60.0)]
                })
                .collect(),
            profile_m: vec![
                [dice.between(0.0, 10.0), 0.0],
                [dice.between(20.0, 80.0), dice.between(-30.0, 30.0)],
            ],
            reach_m: dice.between(30.0, 200.0),
        }),
        kind => Node::Disc(Disc {
            center_m: dice.place(),
            radius_m: dice.between(50.0, 500.0),
            height_m,
            noise: (kind == 4).then(noise),
        }),
    }
}

fn random_node(dice: &mut Dice, levels: usize) -> Node {
    if levels == 0 {
        return random_leaf(dice);
    }
    let of = |dice: &mut Dice| Box::new(random_node(dice, levels - 1));
    match dice.between(0.0, 9.0) as usize {
        0 | 1 => Node::Blend((0..3).map(|_| random_node(dice, levels - 1)).collect()),
        2 => Node::Weigh(Weigh {
            of: of(dice),
            weight: dice.between(0.2, 3.0),
            mask: random_mask(dice),
        }),
        3 => Node::Place(Place {
            of: of(dice),
            at_m: dice.place().map(|x| 0.3 * x),
            turn_deg: dice.between(-180.0, 180.0),
            scale: dice.between(0.5, 2.0),
        }),
        4 => Node::Warp(Warped {
            of: of(dice),
            by: Warp { amplitude_m: dice.between(0.0, 60.0), wavelength_m: 300.0, octaves: 2 },
        }),
        5 => {
            let scaling =
                SelectiveScaling { exponent: dice.between(1.0, 3.0), ..Default::default() };
            let by = match dice.between(0.0, 4.0) as usize {
                0 => VerticalMap::Through(vec![[-20.0, 0.0], [10.0, 40.0], [30.0, 20.0]]),
                1 => VerticalMap::Terraces(Terraces::default()),
                2 => VerticalMap::Glaciation(scaling),
                _ => VerticalMap::Canyonism(scaling),
            };
            Node::Deform(Deform { of: of(dice), by })
        }
        kind => {
            let kinds = [Node::Replace, Node::Add, Node::Carve, Node::Raise];
            let which = kind % 3 + dice.between(0.0, 2.0) as usize;
            let onto = Onto { ground: of(dice), by: of(dice) };
            kinds[which](onto)
        }
    }
}

#[test]
fn bounds_of_random_trees_hold() {
    let mut finite = 0;
    for seed in 0..300 {
        let node = random_node(&mut Dice::new(seed), 1 + seed as usize % 4);
        let surface = ready(&node);
        explored(&*surface, &surface.bounds(&SQUARE), &node);
        let tree = ConstructionTree { ground_m: 0.0, of: node };
        let terrain = tree.terrain(SPACING, seed).unwrap();
        let bounds = terrain.bounds_within([0.0; 2], [SIDE; 2]);
        assert!(!bounds.slope.is_nan() && !terrain.bounds().slope.is_nan());
        finite += usize::from(bounds.slope.is_finite());
        // A whole terrain has weight everywhere: any two places.
        let all = places(400);
        let heights = terrain.elevations(&all);
        for (pair, ends) in all.windows(2).enumerate() {
            let distance = (ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1]);
            let rise = (heights[pair + 1] - heights[pair]).abs();
            assert!(rise <= bounds.slope * distance + 1e-6, "{seed}");
        }
    }
    assert_eq!(finite, 300);
}

#[test]
fn what_lies_elsewhere_does_not_loosen_bounds() {
    let tree = ConstructionTree {
        ground_m: 0.0,
        of: Node::Blend(vec![level(0.0), disc(5000.0, 0.0, 10.0, 1e5)]),
    };
    let terrain = tree.terrain(SPACING, 0).unwrap();
    assert!(terrain.bounds().slope > 1e4);
    let here = terrain.bounds_within([0.0; 2], [SIDE; 2]);
    assert_eq!((here.slope, here.elevation_m), (0.0, [0.0; 2]));
}

fn refusal(node: Node) -> String {
    let tree = ConstructionTree { ground_m: 0.0, of: node };
    tree.terrain(SPACING, 0).unwrap_err().to_string()
}

#[test]
fn bad_trees_are_refused_where_they_are_bad() {
    let curve = |points_m: Vec<[f64; 3]>, profile_m: Vec<[f64; 2]>| {
        Node::Curve(Curve { points_m, profile_m, reach_m: 10.0 })
    };
    let ends = vec![[0.0; 3], [9.0, 0.0, 0.0]];
    let hidden = |node: Node| onto(Node::Carve, level(0.0), Node::Blend(vec![level(1.0), node]));
    for (node, message) in [
        (hidden(disc(0.0, 0.0, -1.0, 0.0)), "of.by[1]: ConstructionTree: radius_m is -1"),
        (hidden(disc(f64::NAN, 0.0, 1.0, 0.0)), "of.by[1]: ConstructionTree: center_m is NaN"),
        (curve(vec![], vec![]), "of: ConstructionTree: points_m: 0 points"),
        (curve(vec![[1.0; 3]], vec![]), "points_m: 1 points; a curve takes at least two"),
        (curve(vec![[1.0; 3]; 3], vec![]), "points_m: all points are at one place"),
        (curve(ends.clone(), vec![[2.0, 0.0], [2.0, 1.0]]), "profile_m: 2 follows 2"),
        (curve(ends, vec![[f64::NAN, 0.0], [2.0, 1.0]]), "profile_m: 2 follows NaN"),
        (Node::Blend(vec![]), "of: ConstructionTree: Blend([]) blends nothing"),
        (
            Node::Disc(Disc {
                noise: Some(FractalNoise { wavelength_m: 1.0, ..noise() }),
                ..Default::default()
            }),
            "of.noise: FractalNoise: wavelength_m is 1; it must be from 10",
        ),
        (
            Node::Deform(Deform {
                of: Box::new(level(0.0)),
                by: VerticalMap::Through(vec![[1.0, 1.0]]),
            }),
            "by: 1 points; there must be at least 2",
        ),
        (
            Node::Deform(Deform {
                of: Box::new(level(0.0)),
                by: VerticalMap::Glaciation(SelectiveScaling {
                    low_m: 9.0,
                    high_m: 1.0,
                    exponent: 2.0,
                }),
            }),
            "high_m is 1",
        ),
        (Node::Blend(vec![level(0.0); 10_000]), "more than 10000 nodes"),
        (curve(vec![[0.0; 3]; 100_001], vec![]), "more than 100000 points of curves and masks"),
    ] {
        let refused = refusal(node);
        assert!(refused.contains(message), "{refused}\n{message}");
    }
}

#[test]
fn deep_trees_are_refused() {
    let mut node = level(0.0);
    for _ in 0..10_000 {
        node = Node::Weigh(Weigh { of: Box::new(node), weight: 1.0, mask: None });
    }
    assert!(refusal(node).contains("more than 50 levels"));
    let mut node = level(0.0);
    for _ in 0..49 {
        node = onto(Node::Carve, node, level(1.0));
    }
    let tree = ConstructionTree { ground_m: 0.0, of: node };
    assert_eq!(tree.terrain(1.0, 0).unwrap().bounds().slope, 0.0);
}

#[test]
fn periodic_axes_and_volumes_are_refused() {
    let tree = ConstructionTree::default();
    let periodic =
        Lattice::plane([8; 2], 1.0, Connectivity::Eight, [Boundary::Open, Boundary::Periodic]);
    let refused = tree.generate(&periodic.unwrap(), 0).unwrap_err().to_string();
    assert!(refused.contains("periodic y axis"), "{refused}");
    let open = [Boundary::Open; 3];
    let volume = Lattice::volume([4; 3], 1.0, Connectivity::Voxel26, open).unwrap();
    assert!(tree.generate(&volume, 0).is_err());
}
