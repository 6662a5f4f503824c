//! Thinning of voxels to a line or a sheet in their middle (thesis, section A.4; Palágyi et al. 2001).
//!
//! Simple points are taken away from the outside, in turns, until no more go: pieces, tunnels and
//! cavities stay as they are. Voxels of one turn are found first and tested once more as they go, in
//! node order, so the result is the same at any time.
//!
//! The listing of the thesis loses tubes that are an even number of voxels wide: when two layers are
//! left, the turn of one side finds both open to it, and takes the tube from its end, voxel by voxel.
//! With [`Rule::Supported`] a side only takes a voxel that has another one behind it, so that the
//! last layer stays; afterwards, turns by the listing clean up what is left at corners.

use rayon::prelude::*;

use super::VoxelSet;
use super::set::bits_of;
use super::simple::{HERE, is_simple};

/// Bits of the neighbours above, below, to the east, west, north and south, in the order of the
/// listing, each with the opposite one.
const SIDES: [[u32; 2]; 6] = [
    [1 << 22, 1 << 4],
    [1 << 4, 1 << 22],
    [1 << 14, 1 << 12],
    [1 << 12, 1 << 14],
    [1 << 10, 1 << 16],
    [1 << 16, 1 << 10],
];

/// In which turns voxels go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Turns {
    /// Voxels open to one side, side by side: up, down, east, west, north, south (thesis, listing A.5).
    #[default]
    Sides,
    /// Voxels with many open sides before those with few (thesis, figure A.4 c).
    ExposedSides,
}

/// What must lie behind a voxel that goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rule {
    /// Anything (thesis, listing A.5).
    Listed,
    /// A filled voxel opposite to an open side, so that tubes of even width stay.
    #[default]
    Supported,
}

/// Thins a set to lines through its middle: what is left has the pieces, tunnels and cavities of the
/// set, and ends of lines stay.
pub fn centreline(set: &VoxelSet, turns: Turns, rule: Rule) -> VoxelSet {
    let mut thin = set.clone();
    if rule == Rule::Supported {
        while turn_of_all(&mut thin, turns, Rule::Supported) {}
    }
    while turn_of_all(&mut thin, turns, Rule::Listed) {}
    thin
}

/// Thins a set from above and from below to a sheet one voxel thick (thesis, section 5.4.2). Voxels
/// go while another one lies behind them, so that the sheet has the extent of the set.
pub fn plan_sheet(set: &VoxelSet) -> VoxelSet {
    let mut thin = set.clone();
    let mut progress = true;
    while progress {
        progress = false;
        for sides in SIDES[..2].chunks(1) {
            progress |= turn(&mut thin, |_, around| {
                gives_way(around, sides, Rule::Supported) && is_simple(around)
            });
        }
    }
    thin
}

/// A turn of every side, or of every least number of open sides; whether any voxel went.
fn turn_of_all(set: &mut VoxelSet, turns: Turns, rule: Rule) -> bool {
    let is_end = |around: u32| (around & !HERE).count_ones() == 1;
    let may_go = |around: u32| !is_end(around) && is_simple(around);
    let mut progress = false;
    match turns {
        Turns::Sides => {
            for sides in SIDES.chunks(1) {
                progress |= turn(set, |_, around| gives_way(around, sides, rule) && may_go(around));
            }
        }
        Turns::ExposedSides => {
            for least in (1..=5).rev() {
                progress |= turn(set, |before, around| {
                    // A side that opens during the turn must wait, or tubes go from their ends.
                    let open = SIDES.iter().filter(|[side, _]| before & side == 0);
                    let sides: Vec<[u32; 2]> = open.copied().collect();
                    sides.len() >= least && gives_way(around, &sides, rule) && may_go(around)
                });
            }
        }
    }
    progress
}

/// Whether one of some sides is open, and what the rule wants lies behind.
fn gives_way(around: u32, sides: &[[u32; 2]], rule: Rule) -> bool {
    let supported = |opposite: u32| rule == Rule::Listed || around & opposite != 0;
    sides.iter().any(|&[side, opposite]| around & side == 0 && supported(opposite))
}

/// Finds the voxels that pass a test, and takes them away one after the other if they pass it still;
/// whether any went. The test gets the surroundings before the turn and those of the moment.
fn turn(set: &mut VoxelSet, test: impl Fn(u32, u32) -> bool + Sync) -> bool {
    let candidates = surface(set, |around| test(around, around));
    let mut progress = false;
    for (voxel, before) in candidates {
        if test(before, set.around(voxel)) {
            set.remove(voxel);
            progress = true;
        }
    }
    progress
}

/// Voxels with an open side whose surroundings pass a test, in node order, with these surroundings.
fn surface(set: &VoxelSet, test: impl Fn(u32) -> bool + Sync) -> Vec<([usize; 3], u32)> {
    let [_, height, layers] = set.size();
    let of_layer = |layer: usize| {
        let mut found = Vec::new();
        let mut open = Vec::new();
        for row in 0..height {
            open_bits(set, [row + 1, layer + 1], &mut open);
            for column in bits_of(&open) {
                let voxel = [column - 1, row, layer];
                let around = set.around(voxel);
                if test(around) {
                    found.push((voxel, around));
                }
            }
        }
        found
    };
    (0..layers).into_par_iter().flat_map_iter(of_layer).collect()
}

/// Bits of the voxels of a framed row that have an empty one at a face.
fn open_bits(set: &VoxelSet, [row, layer]: [usize; 2], open: &mut Vec<u64>) {
    let beside = [[row - 1, layer], [row + 1, layer], [row, layer - 1], [row, layer + 1]];
    let beside = beside.map(|place| set.row(place));
    let here = set.row([row, layer]);
    open.clear();
    open.extend((0..here.len()).map(|word| {
        let bits = here[word];
        let before = if word > 0 { here[word - 1] >> 63 } else { 0 };
        let after = here.get(word + 1).map_or(0, |next| next << 63);
        let walled = (bits << 1 | before) & (bits >> 1 | after);
        bits & !beside.iter().fold(walled, |walled, row| walled & row[word])
    }));
}
