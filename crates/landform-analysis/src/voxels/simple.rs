//! Simple points: voxels that can be taken away without a change of topology.
//!
//! A voxel and its 26 neighbours are 27 bits: number x + 3 y + 9 z, each 0 to 2; the voxel itself
//! has number 13. Filled voxels hang together over faces, edges and corners, empty ones over faces
//! (thesis, section A.4).

/// The voxel itself.
pub(super) const HERE: u32 = 1 << 13;

/// All 27.
const CUBE: u32 = (1 << 27) - 1;

/// The six that share a face.
const FACES: u32 = 1 << 4 | 1 << 10 | 1 << 12 | 1 << 14 | 1 << 16 | 1 << 22;

/// The eight that share but a corner.
const CORNERS: u32 = 1 | 1 << 2 | 1 << 6 | 1 << 8 | 1 << 18 | 1 << 20 | 1 << 24 | 1 << 26;

/// Those with x = 0, and with x = 2.
const WEST: u32 = 0o111_111_111;
const EAST: u32 = WEST << 2;

/// Those with y = 0, and with y = 2.
const NORTH: u32 = 0o007_007_007;
const SOUTH: u32 = NORTH << 6;

/// Whether the voxel in the middle of filled ones is simple: conditions 1 to 4 of Saha and Chaudhuri
/// (thesis, theorem A.4.2).
#[inline]
pub(super) fn is_simple(around: u32) -> bool {
    let filled = around & !HERE;
    let open_faces = !around & FACES;
    if filled == 0 || open_faces == 0 {
        return false;
    }
    let lowest = filled & filled.wrapping_neg();
    let empty = !around & CUBE & !CORNERS & !HERE;
    let first = open_faces & open_faces.wrapping_neg();
    flooded(first, empty, over_faces) & open_faces == open_faces
        && flooded(lowest, filled, over_corners) == filled
}

/// What of `room` hangs together with `seed`.
#[inline(always)]
fn flooded(seed: u32, room: u32, spread: impl Fn(u32) -> u32) -> u32 {
    let mut flood = seed;
    loop {
        let wider = spread(flood) & room;
        if wider == flood {
            return flood;
        }
        flood = wider;
    }
}

/// The bits and their neighbours along x.
#[inline(always)]
fn along_x(bits: u32) -> u32 {
    bits | (bits & !EAST) << 1 | (bits & !WEST) >> 1
}

/// The bits and their neighbours along y.
#[inline(always)]
fn along_y(bits: u32) -> u32 {
    bits | (bits & !SOUTH) << 3 | (bits & !NORTH) >> 3
}

/// The bits and their neighbours along z.
#[inline(always)]
fn along_z(bits: u32) -> u32 {
    bits | bits << 9 | bits >> 9
}

#[inline(always)]
fn over_faces(bits: u32) -> u32 {
    along_x(bits) | along_y(bits) | along_z(bits)
}

#[inline(always)]
fn over_corners(bits: u32) -> u32 {
    along_z(along_y(along_x(bits)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn place(bit: usize) -> [isize; 3] {
        [bit % 3, bit / 3 % 3, bit / 9].map(|at| at as isize)
    }

    /// Number of pieces that the bits of a set fall into.
    fn pieces(set: u32, most: isize) -> Vec<u32> {
        let joined = |a: usize, b: usize| {
            let steps = [0, 1, 2].map(|axis| (place(a)[axis] - place(b)[axis]).abs());
            steps.iter().all(|&step| step < 2) && steps.iter().sum::<isize>() <= most
        };
        let mut rest: Vec<usize> = (0..27).filter(|bit| set >> bit & 1 == 1).collect();
        let mut found = Vec::new();
        while let Some(first) = rest.pop() {
            let (mut piece, mut open) = (1 << first, vec![first]);
            while let Some(bit) = open.pop() {
                let (near, far) = rest.iter().partition(|&&other| joined(bit, other));
                rest = far;
                let near: Vec<usize> = near;
                near.iter().for_each(|bit| piece |= 1 << bit);
                open.extend(near);
            }
            found.push(piece);
        }
        found
    }

    /// Euler characteristic of the 27 voxels as closed cubes, by counting the cells.
    fn euler(set: u32) -> i64 {
        let mut cells = std::collections::BTreeSet::new();
        for bit in (0..27).filter(|bit| set >> bit & 1 == 1) {
            let [x, y, z] = place(bit).map(|at| 2 * at + 1);
            for cell in 0..27 {
                let [dx, dy, dz] = place(cell).map(|at| at - 1);
                cells.insert([x + dx, y + dy, z + dz]);
            }
        }
        // A cell has as many dimensions as odd coordinates.
        cells
            .iter()
            .map(|cell| 1 - 2 * (cell.iter().filter(|&at| at % 2 == 1).count() as i64 % 2))
            .sum()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn the_conditions_are_those_of_the_theorem(random in any::<u32>(), more in any::<u32>(), fill in any::<bool>()) {
            // Sparse and dense surroundings in turn.
            let around = if fill { random | more } else { random & more } & CUBE | HERE;
            let filled = around & !HERE;
            let touching = pieces(!around & CUBE & !CORNERS & !HERE, 1);
            let background = touching.iter().filter(|piece| *piece & FACES != 0).count();
            let expected = pieces(filled, 3).len() == 1 && background == 1;
            prop_assert_eq!(is_simple(around), expected);
            if expected {
                prop_assert_eq!(euler(around), euler(filled), "topology kept");
            }
        }
    }
}
