//! Voxels of caves: thinning to centrelines, and surfaces.
//!
//! The cave is synthetic: twelve winding passages with rough walls through a block of 64x64x64
//! (128x128x128) voxels, of which they fill about a tenth. All times are a voxel of the block.
//!
//! - `thinning`: the centreline by the default rule and by that of the thesis, against reading the
//!   field into a set of voxels; pieces and Euler characteristic are those of the cave;
//! - `surface`: the closed manifold, against the faces of voxels each with corners of its own; its
//!   Euler characteristic is twice that of the cave and its contacts over corners.

mod measure;

use std::f64::consts::TAU;
use std::hint::black_box;

use landform::analysis::voxels::{Rule, Surface, Turns, VoxelSet, centreline, surface};
use landform::sim::random::RandomStream;
use measure::{Effort, pairs, table};

fn main() {
    table("Voxels", |effort| {
        let sides: &[usize] = match effort {
            Effort::Quick => &[64],
            Effort::Normal => &[64, 128],
            Effort::Full => &[64, 128, 256],
        };
        for &side in sides {
            let porosity = rough_cave(side);
            thinning(effort, side, &porosity);
            meshing(effort, side, &porosity);
        }
    });
}

/// Porosity of a block with twelve passages, whose walls are rough by one voxel in three.
fn rough_cave(side: usize) -> Vec<f64> {
    let random = RandomStream::new(1, "rough cave");
    let mut porosity = vec![0.1; side.pow(3)];
    for passage in 0..12 {
        let draw = |index: u32| random.unit(0, passage, index);
        let axis = passage % 3;
        let radius = (0.03 + 0.04 * draw(0)) * side as f64 + 1.0;
        for along in 0..side {
            let share = along as f64 / side as f64;
            let swing = |index: u32| {
                let phase = draw(index) + share * (1.0 + 2.0 * draw(index + 1));
                (0.3 + 0.4 * draw(index + 2) + 0.15 * (TAU * phase).sin()) * side as f64
            };
            let middle = [swing(1), swing(4)];
            let reach = (radius + 2.0) as isize;
            for aside in (-reach..=reach).flat_map(|u| (-reach..=reach).map(move |v| [u, v])) {
                let at = [0, 1].map(|axis| middle[axis].round() as isize + aside[axis]);
                if at.iter().any(|at| !(0..side as isize).contains(at)) {
                    continue;
                }
                let mut voxel = [along; 3];
                voxel[(axis + 1) % 3] = at[0] as usize;
                voxel[(axis + 2) % 3] = at[1] as usize;
                let node = voxel[0] + side * (voxel[1] + side * voxel[2]);
                let from_middle = (aside[0] as f64).hypot(aside[1] as f64);
                if from_middle + 1.2 * random.unit(1, node, 0) < radius {
                    porosity[node] = 0.5;
                }
            }
        }
    }
    porosity
}

fn cave_of(side: usize, porosity: &[f64]) -> VoxelSet {
    VoxelSet::at_least([side; 3], black_box(porosity), 0.35)
}

fn thinning(effort: Effort, side: usize, porosity: &[f64]) {
    let cave = cave_of(side, porosity);
    let topology = |set: &VoxelSet| (set.component_count(), set.euler_characteristic());
    let (pieces, euler) = topology(&cave);
    let voxels = cave.len();
    println!("{side}^3: {voxels} voxels in {pieces} pieces, Euler characteristic {euler}");
    let rules = [("thinning", Rule::Supported), ("thinning by listing A.5", Rule::Listed)];
    for (name, rule) in rules {
        let line = || centreline(black_box(&cave), Turns::Sides, rule);
        assert_eq!(topology(&line()), (pieces, euler), "the line has the topology of the cave");
        let thin = || {
            black_box(line());
            porosity.len()
        };
        let read = || {
            black_box(cave_of(side, porosity));
            porosity.len()
        };
        let pair = pairs(effort.rounds(9), thin, read);
        pair.print(&format!("{name}, {side}^3, a voxel"), "reading the field", "40 ns");
    }
}

fn meshing(effort: Effort, side: usize, porosity: &[f64]) {
    let cave = cave_of(side, porosity);
    let mesh = || {
        black_box(surface(black_box(&cave)));
        porosity.len()
    };
    let faces = || {
        black_box(separate_faces(black_box(&cave)));
        porosity.len()
    };
    let pair = pairs(effort.rounds(9), mesh, faces);
    let mesh = surface(&cave);
    // A closed surface has three edges for two triangles.
    let euler = mesh.positions.len() as i64 - mesh.triangles.len() as i64 / 2;
    let expected = 2 * (cave.euler_characteristic() + cave.corner_contacts() as i64);
    assert_eq!(euler, expected, "the surface has the topology of the cave");
    pair.print(&format!("surface, {side}^3, a voxel"), "faces, each by itself", "25 ns");
}

/// The walls of voxels, each with four vertices of its own: no surface, but something to draw.
fn separate_faces(cave: &VoxelSet) -> Surface {
    let mut mesh = Surface::default();
    for voxel in cave.iter() {
        let at = voxel.map(|at| at as isize);
        for (axis, way) in (0..3).flat_map(|axis| [(axis, -1), (axis, 1)]) {
            let mut beside = at;
            beside[axis] += way;
            if cave.holds(beside) {
                continue;
            }
            let first = mesh.positions.len() as u32;
            for [across, up] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
                let mut corner = voxel.map(|at| at as f64);
                corner[axis] += if way > 0 { 1.0 } else { 0.0 };
                corner[(axis + 1) % 3] += across;
                corner[(axis + 2) % 3] += up;
                mesh.positions.push(corner);
            }
            mesh.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t: [u32; 3]| t.map(|v| v + first)));
        }
    }
    mesh
}
