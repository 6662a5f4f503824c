//! A box seen from inside.

use glam::DVec3;

use super::draw::Scene;
use super::mesh::Mesh;
use super::*;
use crate::light::{decode, quantise};

/// The box from -2, -3, 0 to 2, 3, 4 with its triangles outwards.
fn room() -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let corner = |number: usize| {
        [[-2.0, 2.0][number & 1], [-3.0, 3.0][number >> 1 & 1], [0.0, 4.0][number >> 2]]
    };
    let sides: [[u32; 4]; 6] =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    // Each side has corners, and so normals, of its own.
    let positions = sides.iter().flatten().map(|&number| corner(number as usize)).collect();
    let triangles =
        (0..6).flat_map(|side| [[0, 1, 2], [0, 2, 3]].map(|of| of.map(|at: u32| 4 * side + at)));
    (positions, triangles.collect())
}

/// Plain colours, and a lamp at the camera in the middle of the box.
fn plain() -> InteriorOptions {
    InteriorOptions {
        size: [9, 9],
        supersampling: 1,
        roughness_m: 0.0,
        lamp: Lamp {
            offset_m: [0.0; 3],
            reach_m: 4.0,
            strength: 1.0,
            radius_m: 0.0,
            thrown_back: 0.0,
        },
        rock: Rock { variety: 0.0, relief: 0.0, ..Rock::default() },
        ..InteriorOptions::new([0.0, 0.0, 2.0])
    }
}

fn middle(options: &InteriorOptions) -> [u8; 3] {
    let (positions, triangles) = room();
    render(&positions, &triangles, options).unwrap().pixel(4, 4)
}

/// The northern wall is 3 m away, floor and ceiling 2 m: half the light at 4 m.
#[test]
fn a_box_shows_its_sides_in_the_light_of_the_lamp() {
    let rock = Rock::default();
    for (pitch_deg, colour, distance) in
        [(0.0, rock.wall, 3.0), (90.0, rock.floor, 2.0), (-90.0, rock.ceiling, 2.0_f64)]
    {
        let light = (1.0 / (1.0 + (distance / 4.0).powi(2))) as f32;
        let expected = quantise(colour.map(|channel| decode(channel) * light), 4, 4);
        assert_eq!(middle(&InteriorOptions { pitch_deg, ..plain() }), expected, "{pitch_deg}");
    }
}

/// Straight down through 1.5 m of water, which mirrors the ceiling 0.0201 of the light.
#[test]
fn water_dims_what_is_below_it() {
    let pool =
        Pool { level_m: 1.5, absorption_per_m: [0.9, 0.3, 0.1], colour: [0; 3], ripple: 0.0 };
    let down = InteriorOptions { pitch_deg: 90.0, pool: Some(pool), ..plain() };
    let (positions, triangles) = room();
    let mesh = Mesh::new(&positions, &triangles, 0.0);
    let scene = Scene::new(&mesh, &down);
    let found = scene.colour(-DVec3::Z, 0);
    let share = (0.33_f64 / 2.33).powi(2);
    for channel in 0..3 {
        let [floor, ceiling] =
            [down.rock.floor, down.rock.ceiling].map(|of| f64::from(decode(of[channel])));
        let lit = 1.0 / 1.25;
        let below = floor * lit * (-down.pool.unwrap().absorption_per_m[channel] * 1.5).exp();
        let expected = (1.0 - share) * below + share * ceiling * lit;
        assert!((f64::from(found[channel]) - expected).abs() < 1e-6, "{found:?} {expected}");
    }
    let dry = InteriorOptions { pool: Some(Pool { level_m: -1.0, ..pool }), ..down.clone() };
    assert_eq!(middle(&dry), middle(&InteriorOptions { pool: None, ..down }), "below the floor");
}

/// A lamp at the right does not reach what a pillar hides from it.
#[test]
fn walls_cast_shadows_and_corners_are_darker() {
    let (mut positions, mut triangles) = room();
    let first = positions.len() as u32;
    // A board across, north of the camera, that the ray straight ahead just misses.
    positions.extend([[0.1, 1.0, 0.0], [0.1, 1.0, 4.0], [1.0, 1.0, 4.0], [1.0, 1.0, 0.0]]);
    triangles.extend([[0, 1, 2], [0, 2, 3]].map(|of| of.map(|at| first + at)));
    let lamp = Lamp { offset_m: [1.0, 0.0, 0.0], ..plain().lamp };
    let options = InteriorOptions { lamp, ..plain() };
    let hidden = render(&positions, &triangles, &options).unwrap().pixel(4, 4);
    assert!(hidden.iter().all(|&channel| channel <= 1), "{hidden:?}");
    assert!(middle(&options)[0] > 90, "without the board it is lit");
    let glow = Lamp { strength: 1.0, thrown_back: 1.0, ..plain().lamp };
    let glowing = InteriorOptions { lamp: glow, corner_m: 3.0, ..plain() };
    let picture = render(&positions, &triangles, &glowing).unwrap();
    assert!(picture.pixel(4, 4)[0] > picture.pixel(0, 4)[0]);
}

#[test]
fn threads_change_nothing_and_bad_options_are_refused() {
    let (positions, triangles) = room();
    let options = InteriorOptions {
        size: [40, 30],
        pitch_deg: 20.0,
        pool: Some(Pool {
            level_m: 0.7,
            absorption_per_m: [0.5, 0.2, 0.1],
            colour: [20, 60, 60],
            ripple: 0.1,
        }),
        ..InteriorOptions::new([0.3, -1.0, 2.2])
    };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| render(&positions, &triangles, &options).unwrap())
    };
    assert!(on(1) == on(2) && on(1) == on(8));
    let nothing = render(&[], &[], &options).unwrap();
    assert!(nothing.rgb.iter().all(|pixel| pixel.iter().all(|&channel| channel <= 1)));
    for wrong in [
        InteriorOptions { size: [0, 3], ..plain() },
        InteriorOptions { eye_m: [f64::NAN, 0.0, 0.0], ..plain() },
        InteriorOptions { lamp: Lamp { reach_m: 0.0, ..Lamp::default() }, ..plain() },
        InteriorOptions { rock: Rock { bed_m: 0.0, ..Rock::default() }, ..plain() },
        InteriorOptions { field_of_view_deg: 180.0, ..plain() },
    ] {
        assert!(render(&positions, &triangles, &wrong).is_err(), "{wrong:?}");
    }
    assert!(render(&positions, &[[0, 1, 24]], &plain()).is_err());
}
