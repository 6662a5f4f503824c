//! Pieces and Euler characteristic of sets of voxels.

use super::VoxelSet;
use super::set::bits_of;

impl VoxelSet {
    /// Euler characteristic of the voxels as closed cubes, which hang together over faces, edges and
    /// corners: pieces less tunnels plus cavities.
    pub fn euler_characteristic(&self) -> i64 {
        let [_, height, layers] = self.size();
        let mut sum = 0;
        for layer in 1..layers + 2 {
            for row in 1..height + 2 {
                let rows = [[row, layer], [row - 1, layer], [row, layer - 1], [row - 1, layer - 1]];
                sum += cells(rows.map(|place| self.row(place)));
            }
        }
        sum
    }

    /// Number of pieces that hang together over faces, edges and corners.
    pub fn component_count(&self) -> usize {
        let mut rest = self.clone();
        let mut count = 0;
        let mut open = Vec::new();
        for voxel in self.iter() {
            if !rest.contains(voxel) {
                continue;
            }
            count += 1;
            rest.remove(voxel);
            open.push(voxel);
            while let Some(voxel) = open.pop() {
                for neighbour in neighbours(rest.around(voxel), voxel) {
                    rest.remove(neighbour);
                    open.push(neighbour);
                }
            }
        }
        count
    }
}

/// The voxels around `voxel` whose bits are set in its surroundings.
pub(super) fn neighbours(around: u32, voxel: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    let around = [u64::from(around & !super::simple::HERE)];
    let places: Vec<usize> = bits_of(&around).collect();
    places.into_iter().map(move |place| {
        let [x, y, z] = voxel;
        [x + place % 3 - 1, y + place / 3 % 3 - 1, z + place / 9 - 1]
    })
}

/// Corners less edges plus faces less cubes of a row of cubes, of those that no later row has.
///
/// The rows are the one itself, the one to its north, the one below, and the one below to the north;
/// all their cubes meet at the corners on the row's lower northern edge.
fn cells([here, north, below, aslant]: [&[u64]; 4]) -> i64 {
    let mut sum = 0;
    // Bits of the words before, for corners and edges between the last voxel of one and the next.
    let mut carry = [false; 4];
    for word in 0..here.len() {
        let mut count = |index: usize, bits: u64| -> (i64, i64) {
            // A corner stands on the western side of each voxel and of the one after it.
            let between = bits | bits << 1 | u64::from(carry[index]);
            carry[index] = bits >> 63 == 1;
            (i64::from(between.count_ones()), i64::from(bits.count_ones()))
        };
        let (corners, along_x) = count(0, here[word] | north[word] | below[word] | aslant[word]);
        let (along_y, face_z) = count(1, here[word] | below[word]);
        let (along_z, face_y) = count(2, here[word] | north[word]);
        let (face_x, cubes) = count(3, here[word]);
        sum += corners - (along_x + along_y + along_z) + (face_x + face_y + face_z) - cubes;
    }
    sum
}
