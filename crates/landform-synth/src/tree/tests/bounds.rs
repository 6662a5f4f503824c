//! Bounds of trees against what is found on them.

use super::*;

/// What a node is found to do on the square.
pub(super) struct Found {
    slope: f64,
    faded_slope: f64,
    weight_slope: f64,
}

/// Compares places that are close to each other; asserts that nothing leaves its bounds.
pub(super) fn explored(
    surface: &dyn Surface,
    bounds: &Bounds,
    what: &dyn std::fmt::Debug,
) -> Found {
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
        (
            "funnel",
            Node::RadialRamp(RadialRamp { center_m: [300.0, 600.0], ..Default::default() }),
            1.0001,
        ),
        ("cone", Node::RadialRamp(RadialRamp { tilt_deg: -40.0, ..Default::default() }), 1.0001),
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
pub(super) struct Dice {
    stream: RandomStream,
    thrown: usize,
}

impl Dice {
    pub(super) fn new(seed: u64) -> Self {
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

pub(super) fn random_node(dice: &mut Dice, levels: usize) -> Node {
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
