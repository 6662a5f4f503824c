//! How the walls around a corner of the voxel grid hang together.
//!
//! Eight voxels meet at a corner; number x + 2 y + 4 z, each 0 or 1, is one. Walls are the faces
//! between a filled voxel and an empty one. Of the walls at an edge that starts at the corner there
//! are none, two, or four; four belong in pairs to the two empty voxels, which touch over the edge
//! only. Walls that hang together over edges form a fan around the corner, and each fan gets a vertex
//! of its own, so that no vertex of the mesh joins two fans.

use std::sync::LazyLock;

/// What there is at a corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Number of fans.
    pub fans: u8,
    /// Fan of each face: face 4 a + b + 2 c has its normal along axis a, and lies on the far side of
    /// the corner along axis a + 1 if b is 1 and along a + 2 if c is 1.
    pub fan_of: [u8; 12],
    /// Bits of the edges whose four walls all belong to one fan: edge a + 3 runs along axis a onwards
    /// from the corner, edge a runs back.
    pub pinched: u8,
}

impl Corner {
    /// What there is at a corner around which the voxels of these bits are filled.
    pub fn of(filled: u8) -> &'static Self {
        static CORNERS: LazyLock<Vec<Corner>> =
            LazyLock::new(|| (0..=u8::MAX).map(Corner::new).collect());
        &CORNERS[usize::from(filled)]
    }

    fn new(filled: u8) -> Self {
        const NONE: u8 = u8::MAX;
        let mut fan_of: [u8; 12] = std::array::from_fn(|face| {
            let [near, far] = sides(face);
            let is_wall = (filled >> near ^ filled >> far) & 1 == 1;
            if is_wall { face as u8 } else { NONE }
        });
        // Walls that hang together take the lowest number among them.
        let links: Vec<[usize; 2]> = (0..6).flat_map(|edge| pairs(filled, edge)).collect();
        for _ in 0..12 {
            for &[first, second] in &links {
                let lowest = fan_of[first].min(fan_of[second]);
                (fan_of[first], fan_of[second]) = (lowest, lowest);
            }
        }
        let mut pinched = 0;
        for edge in 0..6 {
            if let [[first, _], [second, _]] = pairs(filled, edge)[..] {
                pinched |= u8::from(fan_of[first] == fan_of[second]) << edge;
            }
        }
        let mut numbers: Vec<u8> = fan_of.iter().copied().filter(|&fan| fan != NONE).collect();
        numbers.sort_unstable();
        numbers.dedup();
        let number = |fan: u8| numbers.iter().position(|&other| other == fan).unwrap_or(0) as u8;
        Self { fans: numbers.len() as u8, fan_of: fan_of.map(number), pinched }
    }
}

/// The voxels on both sides of a face.
fn sides(face: usize) -> [usize; 2] {
    let (axis, beside) = (face / 4, face % 4);
    let near = (beside & 1) << ((axis + 1) % 3) | (beside >> 1) << ((axis + 2) % 3);
    [near, near | 1 << axis]
}

/// The walls at an edge that hang together, two and two.
fn pairs(filled: u8, edge: usize) -> Vec<[usize; 2]> {
    let (axis, onwards) = (edge % 3, edge / 3);
    // The four voxels around the edge one after the other, and the faces between them.
    let [across, up] = [(axis + 1) % 3, (axis + 2) % 3];
    let around = [[0, 0], [1, 0], [1, 1], [0, 1]];
    let voxel = |[a, b]: [usize; 2]| onwards << axis | a << across | b << up;
    let is_empty = |turn: usize| filled >> voxel(around[turn % 4]) & 1 == 0;
    let face = |turn: usize| {
        let [from, to] = [voxel(around[turn % 4]), voxel(around[(turn + 1) % 4])];
        (0..12).find(|&face| sides(face) == [from.min(to), from.max(to)]).unwrap_or(0)
    };
    let walls: Vec<usize> = (0..4).filter(|&turn| is_empty(turn) != is_empty(turn + 1)).collect();
    match walls[..] {
        [first, second] => vec![[face(first), face(second)]],
        // The faces before and after each empty voxel.
        [_, _, _, _] => {
            let empty = (0..4).filter(|&turn| is_empty(turn));
            empty.map(|turn| [face(turn + 3), face(turn)]).collect()
        }
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_corners() {
        // A single voxel, filled or empty, has three walls in one fan.
        for filled in [1, !1] {
            assert_eq!((Corner::of(filled).fans, Corner::of(filled).pinched), (1, 0));
        }
        // Two that touch over the corner only.
        assert_eq!(Corner::of(0b1000_0001).fans, 2);
        assert_eq!(Corner::of(!0b1000_0001).fans, 2);
        // Two empty ones that touch over an edge are walled apart; two filled ones are joined.
        let edge = 0b0000_1001;
        assert_eq!((Corner::of(!edge).fans, Corner::of(!edge).pinched), (2, 0));
        assert_eq!((Corner::of(edge).fans, Corner::of(edge).pinched), (1, 1 << 2));
        assert_eq!(Corner::of(0).fans + Corner::of(255).fans, 0);
    }

    /// Every fan is a closed chain: as many edges as walls.
    #[test]
    fn fans_close_on_themselves() {
        for filled in 0..=255 {
            let links: Vec<[usize; 2]> = (0..6).flat_map(|edge| pairs(filled, edge)).collect();
            for face in 0..12 {
                let count = links.iter().flatten().filter(|&&other| other == face).count();
                let [near, far] = sides(face);
                let is_wall = (filled >> near ^ filled >> far) & 1 == 1;
                assert_eq!(count, if is_wall { 2 } else { 0 }, "{filled:#b} {face}");
            }
        }
    }
}
