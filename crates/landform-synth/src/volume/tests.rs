//! Volumes against what is known of them.

use landform_graph::{Boundary, Connectivity};
use landform_sim::random::RandomStream;

use super::*;
use crate::{FractalNoise, Plane};

const SIDE: f64 = 40.0;

fn ready(of: VolumeNode) -> Volume {
    ImplicitVolume { of, ..Default::default() }.volume(Path::new(""), 1.0, 5).unwrap()
}

fn ball(center_m: [f64; 3], radius_m: f64) -> VolumeNode {
    VolumeNode::Ball(Ball { center_m, radius_m, rough: None })
}

fn block(size: [usize; 3], spacing: f64) -> Lattice {
    Lattice::volume(size, spacing, Connectivity::Voxel26, [Boundary::Open; 3]).unwrap()
}

/// Random numbers for random solids and places.
struct Dice {
    stream: RandomStream,
    thrown: usize,
}

impl Dice {
    fn new(seed: u64) -> Self {
        Self { stream: RandomStream::new(seed, "random solid"), thrown: 0 }
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        self.thrown += 1;
        least + (most - least) * self.stream.unit(0, self.thrown, 0)
    }

    fn place(&mut self) -> [f64; 3] {
        [0; 3].map(|_| self.between(0.0, SIDE))
    }

    fn roughness(&mut self) -> Roughness {
        Roughness {
            amplitude_m: self.between(0.0, 3.0),
            wavelength_m: self.between(4.0, 20.0),
            octaves: 1 + self.between(0.0, 3.0) as u32,
        }
    }

    fn leaf(&mut self) -> VolumeNode {
        match self.between(0.0, 5.0) as usize {
            0 => VolumeNode::Tube(Tube {
                points_m: (0..4)
                    .map(|_| {
                        let [x, y, z] = self.place();
                        [x, y, z, self.between(0.0, 8.0)]
                    })
                    .collect(),
            }),
            1 => VolumeNode::Block(Block { center_m: self.place(), sides_m: self.place() }),
            2 => VolumeNode::Ground(Node::Noise(FractalNoise {
                amplitude_m: self.between(0.0, 10.0),
                wavelength_m: 15.0,
                octaves: 2,
                ..Default::default()
            })),
            kind => {
                let rough = (kind == 3).then(|| self.roughness());
                VolumeNode::Ball(Ball {
                    center_m: self.place(),
                    radius_m: self.between(1.0, 15.0),
                    rough,
                })
            }
        }
    }

    fn solid(&mut self, levels: usize) -> VolumeNode {
        if levels == 0 {
            return self.leaf();
        }
        let width_m = self.between(-3.0, 6.0).max(0.0);
        let of = |dice: &mut Self| Box::new(dice.solid(levels - 1));
        match self.between(0.0, 6.0) as usize {
            0 => VolumeNode::Union(Blended { of: (0..3).map(|_| *of(self)).collect(), width_m }),
            1 => VolumeNode::Intersection(Blended {
                of: (0..2).map(|_| *of(self)).collect(),
                width_m,
            }),
            2 => VolumeNode::Difference(Cut { of: of(self), by: of(self), width_m }),
            3 => VolumeNode::Instances(Instances {
                at: (0..3)
                    .map(|_| Instance {
                        at_m: self.place(),
                        turn_deg: self.between(-180.0, 180.0),
                        scale: self.between(0.3, 3.0),
                    })
                    .collect(),
                of: of(self),
            }),
            4 => VolumeNode::Warp(Noised { of: of(self), by: self.roughness() }),
            _ => VolumeNode::Rough(Noised { of: of(self), by: self.roughness() }),
        }
    }
}

/// Any two places, near each other and far apart.
#[test]
fn bounds_of_random_volumes_hold() {
    for seed in 0..200 {
        let mut dice = Dice::new(seed);
        let node = dice.solid(seed as usize % 4);
        let volume = ready(node.clone());
        assert!(volume.slope().is_finite(), "{node:?}");
        for _ in 0..300 {
            let from = dice.place();
            let reach = 10.0_f64.powf(dice.between(-4.0, 1.5));
            let to = from.map(|x| x + dice.between(-reach, reach));
            let distance = (0..3).map(|axis| (to[axis] - from[axis]).powi(2)).sum::<f64>().sqrt();
            let change = (volume.value(to) - volume.value(from)).abs();
            assert!(change <= volume.slope() * distance + 1e-9, "{change} {distance} {node:?}");
        }
    }
}

/// The bound of simple solids is what is found; that of noise is at most five times as much.
#[test]
fn bounds_are_close() {
    let tube = Tube { points_m: vec![[5.0, 5.0, 5.0, 1.0], [35.0, 20.0, 25.0, 12.0]] };
    let rough = Roughness { amplitude_m: 1.0, wavelength_m: 8.0, octaves: 1 };
    let flat = VolumeNode::Ground(Node::Plane(Plane { tilt_deg: 30.0, ..Default::default() }));
    for (node, factor) in [
        (ball([20.0; 3], 7.0), 1.0001),
        (VolumeNode::Tube(tube), 1.001),
        (VolumeNode::Block(Block { center_m: [20.0; 3], sides_m: [10.0; 3] }), 1.0001),
        (flat, 1.0001),
        (VolumeNode::Rough(Noised { of: Box::new(ball([20.0; 3], 7.0)), by: rough }), 2.0),
        (VolumeNode::Warp(Noised { of: Box::new(ball([20.0; 3], 7.0)), by: rough }), 3.0),
    ] {
        let volume = ready(node.clone());
        let mut dice = Dice::new(1);
        let mut found = 0.0_f64;
        for _ in 0..4000 {
            let place = dice.place();
            let gradient = [0, 1, 2].map(|axis| {
                let step = |by: f64| {
                    let mut moved = place;
                    moved[axis] += by;
                    volume.value(moved)
                };
                (step(1e-5) - step(-1e-5)) / 2e-5
            });
            found = found.max(solid::length(gradient));
        }
        println!("bound {:.3}, found {found:.3}: {node:?}", volume.slope());
        assert!(volume.slope() <= factor * found, "{found} {} {node:?}", volume.slope());
    }
}

/// Sums over voxels are volumes.
#[test]
fn voxels_hold_the_volumes_of_known_solids() {
    let lattice = block([41, 41, 41], 1.0);
    let sum = |of: VolumeNode| {
        let volume = ImplicitVolume { of, ..Default::default() };
        volume.generate(&lattice, 1).unwrap().into_iter().sum::<f64>()
    };
    let pi = std::f64::consts::PI;
    let sphere = 4.0 / 3.0 * pi * 12.0_f64.powi(3);
    let tube = Tube { points_m: vec![[10.0, 20.0, 20.0, 6.0], [30.0, 20.0, 20.0, 6.0]] };
    let cavern = Cut {
        of: Box::new(VolumeNode::Block(Block { center_m: [20.0; 3], sides_m: [30.0; 3] })),
        by: Box::new(ball([20.0; 3], 12.0)),
        width_m: 0.0,
    };
    let lens = Blended {
        of: vec![ball([14.0, 20.0, 20.0], 12.0), ball([26.0, 20.0, 20.0], 12.0)],
        width_m: 0.0,
    };
    // Two caps of height 6.
    let overlap = 2.0 * pi * 36.0 * (36.0 - 6.0) / 3.0;
    for (node, exact) in [
        (ball([20.0; 3], 12.0), sphere),
        (VolumeNode::Tube(tube), 4.0 / 3.0 * pi * 216.0 + pi * 36.0 * 20.0),
        (VolumeNode::Difference(cavern), 27_000.0 - sphere),
        (VolumeNode::Intersection(lens.clone()), overlap),
        (VolumeNode::Union(lens), 2.0 * sphere - overlap),
    ] {
        let found = sum(node.clone());
        assert!((found / exact - 1.0).abs() < 0.01, "{found} {exact} {node:?}");
    }
}

#[test]
fn seams_round_and_instances_repeat() {
    let pair = vec![ball([10.0, 20.0, 20.0], 6.0), ball([30.0, 20.0, 20.0], 6.0)];
    let union = |width_m| ready(VolumeNode::Union(Blended { of: pair.clone(), width_m }));
    let middle = [20.0, 20.0, 20.0];
    assert_eq!([union(0.0).value(middle), union(8.0).value(middle)], [4.0, 2.0]);
    let turned = Instance { at_m: [20.0, 0.0, 0.0], turn_deg: 90.0, scale: 2.0 };
    let of = Box::new(ball([5.0, 0.0, 1.0], 1.0));
    let copies = ready(VolumeNode::Instances(Instances { of, at: vec![turned] }));
    // The ball's 5 m to the east become 10 m to the north.
    assert!((copies.value([20.0, 10.0, 2.0]) + 2.0).abs() < 1e-12);
    assert!(copies.value([20.0, 14.0, 2.0]) > 1.9);
}

/// A rough ball has no holes and no floating parts: each ray leaves it once.
#[test]
fn rough_balls_are_whole() {
    let rough = Some(Roughness { amplitude_m: 2.5, wavelength_m: 5.0, octaves: 3 });
    let volume = ready(VolumeNode::Ball(Ball { center_m: [0.0; 3], radius_m: 12.0, rough }));
    let mut dice = Dice::new(2);
    let mut radii = [f64::INFINITY, 0.0_f64];
    for _ in 0..200 {
        let ray = dice.place().map(|x| x - 0.5 * SIDE);
        let ray = ray.map(|x| x / solid::length(ray));
        let values = (1..300).map(|step| volume.value(ray.map(|x| x * 0.1 * f64::from(step))));
        let signs: Vec<bool> = values.map(|value| value > 0.0).collect();
        let changes = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
        assert_eq!((changes, signs[0]), (1, false));
        let radius = signs.iter().position(|&outside| outside).unwrap() as f64 * 0.1;
        radii = [radii[0].min(radius), radii[1].max(radius)];
    }
    assert!(radii[0] < 11.0 && radii[1] > 13.0, "{radii:?}");
}

#[test]
fn bad_volumes_are_refused_where_they_are_bad() {
    let refusal = |of: VolumeNode| {
        let volume = ImplicitVolume { of, ..Default::default() };
        volume.generate(&block([4, 4, 4], 1.0), 0).unwrap_err().to_string()
    };
    let within = |node: VolumeNode| {
        VolumeNode::Union(Blended { of: vec![ball([0.0; 3], 1.0), node], width_m: 1.0 })
    };
    let noised = |by: Roughness| Noised { of: Box::new(ball([0.0; 3], 1.0)), by };
    let none = Roughness { wavelength_m: 0.0, ..Default::default() };
    let mut deep = ball([0.0; 3], 1.0);
    for _ in 0..60 {
        deep = VolumeNode::Union(Blended { of: vec![deep], width_m: 0.0 });
    }
    for (node, message) in [
        (within(ball([0.0; 3], -1.0)), "of.of[1]: ImplicitVolume: radius_m is -1"),
        (within(ball([f64::NAN, 0.0, 0.0], 1.0)), "center_m is NaN"),
        (within(VolumeNode::Warp(noised(none))), "of.of[1].by: ImplicitVolume: wavelength_m is 0"),
        (
            VolumeNode::Tube(Tube { points_m: vec![[0.0; 4]] }),
            "1 points; a tube takes at least two",
        ),
        (VolumeNode::Tube(Tube { points_m: vec![[0.0; 4]; 10_001] }), "more than 10000 nodes"),
        (VolumeNode::Union(Blended { of: vec![], width_m: 0.0 }), "nothing to put together"),
        (deep, "more than 50 levels"),
    ] {
        let refused = refusal(node);
        assert!(refused.contains(message), "{refused}\n{message}");
    }
}
