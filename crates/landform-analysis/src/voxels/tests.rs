//! Thinning of tubes, slabs and rough caves.

use super::*;

/// A tube of a given width and height along one axis.
fn beam(wide: [usize; 2], long: usize, axis: usize) -> VoxelSet {
    let mut size = [0; 3];
    size[axis] = long;
    size[(axis + 1) % 3] = wide[0];
    size[(axis + 2) % 3] = wide[1];
    VoxelSet::new(size, |_| true)
}

/// Random blobs: rough walls, tunnels, cavities.
pub(super) fn cave(size: [usize; 3], seed: u64) -> VoxelSet {
    let noise = |x: usize, y: usize, z: usize| {
        let mut hash = (x as u64) << 42 ^ (y as u64) << 21 ^ z as u64 ^ seed.wrapping_mul(0x9E37);
        for _ in 0..3 {
            hash = (hash ^ hash >> 29).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        }
        (hash >> 11) as f64 / (1_u64 << 53) as f64
    };
    // Means of 3 x 3 x 3: blobs of a few voxels.
    VoxelSet::new(size, |[x, y, z]| {
        let mean = (0..27).map(|place| noise(x + place % 3, y + place / 3 % 3, z + place / 9));
        mean.sum::<f64>() / 27.0 > 0.52
    })
}

#[test]
fn euler_characteristics_of_known_shapes() {
    let ball = VoxelSet::new([3, 3, 3], |_| true);
    let hollow = VoxelSet::new([3, 3, 3], |voxel| voxel != [1, 1, 1]);
    let ring = VoxelSet::new([3, 3, 1], |[x, y, _]| (x, y) != (1, 1));
    let corner = VoxelSet::new([2, 2, 2], |[x, y, z]| x == y && y == z);
    let apart = VoxelSet::new([70, 1, 1], |[x, _, _]| x % 2 == 0);
    let found = [&ball, &hollow, &ring, &corner, &apart].map(VoxelSet::euler_characteristic);
    assert_eq!(found, [1, 2, 0, 1, 35]);
    let pieces = [&ball, &hollow, &ring, &corner, &apart].map(VoxelSet::component_count);
    assert_eq!(pieces, [1, 1, 1, 1, 35]);
}

#[test]
fn lines_keep_topology_and_are_thin() {
    for seed in 0..4 {
        let set = cave([40, 36, 30], seed);
        assert!(set.len() > 5000, "{}", set.len());
        let sheet = plan_sheet(&set);
        let lines = [Turns::Sides, Turns::ExposedSides].into_iter().flat_map(|turns| {
            [Rule::Listed, Rule::Supported].map(|rule| centreline(&set, turns, rule))
        });
        for thin in lines.chain([sheet]) {
            assert_eq!(thin.euler_characteristic(), set.euler_characteristic());
            assert_eq!(thin.component_count(), set.component_count());
            assert!(thin.iter().all(|voxel| set.contains(voxel)));
            assert!(thin.len() * 3 < set.len() * 2, "{} of {}", thin.len(), set.len());
        }
    }
}

#[test]
fn tubes_of_any_width_become_lines_of_their_length() {
    for turns in [Turns::Sides, Turns::ExposedSides] {
        for axis in 0..3 {
            for wide in [[2, 2], [3, 3], [4, 4], [6, 6], [2, 5], [3, 2]] {
                let line = centreline(&beam(wide, 40, axis), turns, Rule::Supported);
                assert!((32..=40).contains(&line.len()), "{wide:?} {axis}: {}", line.len());
                let across: std::collections::BTreeSet<[usize; 2]> = line
                    .iter()
                    .map(|voxel| [voxel[(axis + 1) % 3], voxel[(axis + 2) % 3]])
                    .collect();
                assert!(across.len() <= 3, "{wide:?} {axis} {turns:?}: not straight, {across:?}");
            }
        }
    }
}

/// What the rule of support is for.
#[test]
fn the_listing_loses_tubes_of_even_width() {
    // Along rows, node order keeps the last layer by chance.
    let line = |wide| centreline(&beam([wide; 2], 40, 1), Turns::Sides, Rule::Listed).len();
    assert!(line(3) >= 36);
    assert!(line(2) <= 4 && line(4) <= 4, "{} {}", line(2), line(4));
}

#[test]
fn sheets_have_the_extent_of_slabs() {
    for thick in [1, 2, 5, 6] {
        let sheet = plan_sheet(&VoxelSet::new([20, 20, thick], |_| true));
        assert_eq!(sheet.len(), 400, "{thick}");
    }
}
