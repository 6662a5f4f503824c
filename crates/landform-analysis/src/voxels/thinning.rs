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
    let mut peel = Peel::new(set);
    if rule == Rule::Supported {
        peel.thin_to_lines(turns, Rule::Supported);
    }
    peel.thin_to_lines(turns, Rule::Listed);
    peel.set
}

/// Thins a set from above and from below to a sheet one voxel thick (thesis, section 5.4.2). Voxels
/// go while another one lies behind them, so that the sheet has the extent of the set.
pub fn plan_sheet(set: &VoxelSet) -> VoxelSet {
    let mut peel = Peel::new(set);
    peel.until_nothing_goes(2, |peel, side| peel.turn_of_side(side, Rule::Supported, is_simple));
    peel.set
}

/// Whether a voxel may go without a change of topology, and is no end of a line.
fn may_go(around: u32) -> bool {
    let is_end = (around & !HERE).count_ones() == 1;
    !is_end && is_simple(around)
}

/// Whether one of some sides is open, and what the rule wants lies behind.
fn gives_way(around: u32, sides: &[[u32; 2]], rule: Rule) -> bool {
    let supported = |opposite: u32| rule == Rule::Listed || around & opposite != 0;
    sides.iter().any(|&[side, opposite]| around & side == 0 && supported(opposite))
}

/// A set that loses voxels turn by turn.
///
/// A round is so many kinds of turns. A voxel that stayed in a turn stays in the next one of that kind
/// too unless voxels around it have gone, so rows around which nothing went for a round are passed
/// over; of the others, whole words of voxels are found open to a side at a time.
struct Peel {
    set: VoxelSet,
    /// Number of the last turn in which each framed row lost a voxel.
    last_loss: Vec<u32>,
    /// Number of the present turn, from 1.
    turn: u32,
    /// First turn whose losses matter: those before are a round ago.
    since: u32,
}

impl Peel {
    fn new(set: &VoxelSet) -> Self {
        let [_, height, layers] = set.size();
        let last_loss = vec![0; (height + 2) * (layers + 2)];
        Self { set: set.clone(), last_loss, turn: 0, since: 0 }
    }

    /// Takes rounds of so many `kinds` of turns until nothing goes; `turn` tells whether anything went.
    fn until_nothing_goes(&mut self, kinds: u32, turn: impl Fn(&mut Self, usize) -> bool) {
        let first = self.turn;
        let mut progress = true;
        while progress {
            progress = false;
            for kind in 0..kinds {
                self.turn += 1;
                // The first round looks at everything.
                let is_first_round = self.turn <= first + kinds;
                self.since = if is_first_round { 0 } else { self.turn - kinds };
                progress |= turn(self, kind as usize);
            }
        }
    }

    /// Takes turns of every side, or of every least number of open sides.
    fn thin_to_lines(&mut self, turns: Turns, rule: Rule) {
        match turns {
            Turns::Sides => {
                self.until_nothing_goes(6, |peel, side| peel.turn_of_side(side, rule, may_go));
            }
            Turns::ExposedSides => {
                self.until_nothing_goes(5, |peel, kind| peel.turn_of_exposed(5 - kind, rule));
            }
        }
    }

    /// Takes voxels away that are open to a side.
    fn turn_of_side(&mut self, side: usize, rule: Rule, test: impl Fn(u32) -> bool + Sync) -> bool {
        self.take(
            |set, place, bits| open_to(set, place, side, rule, bits),
            |_, around| gives_way(around, &SIDES[side..=side], rule) && test(around),
        )
    }

    /// Takes voxels away that have at least so many open sides.
    fn turn_of_exposed(&mut self, least: usize, rule: Rule) -> bool {
        self.take(open_bits, |before, around| {
            // A side that opens during the turn must wait, or tubes go from their ends.
            let open = SIDES.iter().filter(|[side, _]| before & side == 0);
            let sides: Vec<[u32; 2]> = open.copied().collect();
            sides.len() >= least && gives_way(around, &sides, rule) && may_go(around)
        })
    }

    /// Finds the voxels that pass a test, and takes them away one after the other if they pass it
    /// still; whether any went. `find` gives the bits of a framed row to look at. The test gets the
    /// surroundings before the turn and those of the moment.
    fn take(
        &mut self,
        find: impl Fn(&VoxelSet, [usize; 2], &mut Vec<u64>) + Sync,
        test: impl Fn(u32, u32) -> bool + Sync,
    ) -> bool {
        let candidates = self.candidates(find, |around| test(around, around));
        let mut progress = false;
        for (voxel, before) in candidates {
            if test(before, self.set.around(voxel)) {
                self.set.remove(voxel);
                let row = self.row_number([voxel[1] + 1, voxel[2] + 1]);
                self.last_loss[row] = self.turn;
                progress = true;
            }
        }
        progress
    }

    /// Voxels whose surroundings pass a test, in node order, with these surroundings.
    fn candidates(
        &self,
        find: impl Fn(&VoxelSet, [usize; 2], &mut Vec<u64>) + Sync,
        test: impl Fn(u32) -> bool + Sync,
    ) -> Vec<([usize; 3], u32)> {
        let [_, height, layers] = self.set.size();
        let of_layer = |layer: usize| {
            let mut found = Vec::new();
            let mut bits = Vec::new();
            for row in (0..height).filter(|row| self.has_changed([row + 1, layer + 1])) {
                find(&self.set, [row + 1, layer + 1], &mut bits);
                for column in bits_of(&bits) {
                    let voxel = [column - 1, row, layer];
                    let around = self.set.around(voxel);
                    if test(around) {
                        found.push((voxel, around));
                    }
                }
            }
            found
        };
        (0..layers).into_par_iter().flat_map_iter(of_layer).collect()
    }

    /// Whether a framed row or one beside it has lost a voxel within a round.
    fn has_changed(&self, [row, layer]: [usize; 2]) -> bool {
        (layer - 1..=layer + 1).any(|layer| {
            let first = self.row_number([row - 1, layer]);
            self.last_loss[first..first + 3].iter().any(|&turn| turn >= self.since)
        })
    }

    fn row_number(&self, [row, layer]: [usize; 2]) -> usize {
        row + (self.set.size()[1] + 2) * layer
    }
}

/// Bits of the voxels of a framed row that are open to a side, with what the rule wants behind them.
fn open_to(set: &VoxelSet, place: [usize; 2], side: usize, rule: Rule, bits: &mut Vec<u64>) {
    let here = set.row(place);
    bits.clear();
    bits.extend((0..here.len()).map(|word| {
        let open = here[word] & !beside(set, place, side, word);
        match rule {
            Rule::Listed => open,
            // Sides stand in pairs of opposite ones.
            Rule::Supported => open & beside(set, place, side ^ 1, word),
        }
    }));
}

/// Of the voxels beside those of a framed row, on a side, the ones beside a word.
#[inline]
fn beside(set: &VoxelSet, [row, layer]: [usize; 2], side: usize, word: usize) -> u64 {
    match side {
        0 => set.row([row, layer + 1])[word],
        1 => set.row([row, layer - 1])[word],
        4 => set.row([row - 1, layer])[word],
        5 => set.row([row + 1, layer])[word],
        2 => {
            let here = set.row([row, layer]);
            here[word] >> 1 | here.get(word + 1).map_or(0, |next| next << 63)
        }
        _ => {
            let here = set.row([row, layer]);
            here[word] << 1 | if word > 0 { here[word - 1] >> 63 } else { 0 }
        }
    }
}

/// Bits of the voxels of a framed row that have an empty one at a face.
fn open_bits(set: &VoxelSet, place: [usize; 2], bits: &mut Vec<u64>) {
    let here = set.row(place);
    bits.clear();
    bits.extend((0..here.len()).map(|word| {
        let walled = (0..6).fold(u64::MAX, |walled, side| walled & beside(set, place, side, word));
        here[word] & !walled
    }));
}

#[cfg(test)]
mod tests {
    use super::super::tests::cave;
    use super::*;

    /// Lines as they are defined: every turn looks at every voxel.
    fn lines_by_definition(set: &VoxelSet, turns: Turns, rule: Rule) -> VoxelSet {
        let mut thin = set.clone();
        let rules = if rule == Rule::Supported { vec![rule, Rule::Listed] } else { vec![rule] };
        for rule in rules {
            let mut left = usize::MAX;
            while thin.len() < left {
                left = thin.len();
                let kinds = if turns == Turns::Sides { 6 } else { 5 };
                for (kind, &sides) in SIDES.iter().enumerate().take(kinds) {
                    let goes = |before: u32, around: u32| {
                        let sides: Vec<[u32; 2]> = match turns {
                            Turns::Sides => vec![sides],
                            Turns::ExposedSides => {
                                SIDES.into_iter().filter(|[side, _]| before & side == 0).collect()
                            }
                        };
                        let enough = turns == Turns::Sides || sides.len() >= 5 - kind;
                        enough && gives_way(around, &sides, rule) && may_go(around)
                    };
                    let surroundings = thin.iter().map(|voxel| (voxel, thin.around(voxel)));
                    let found: Vec<_> =
                        surroundings.filter(|&(_, around)| goes(around, around)).collect();
                    for (voxel, before) in found {
                        if goes(before, thin.around(voxel)) {
                            thin.remove(voxel);
                        }
                    }
                }
            }
        }
        thin
    }

    #[test]
    fn lines_are_those_of_the_definition() {
        for seed in 0..3 {
            // Rows of more than a word.
            let set = cave([75, 20, 16], seed);
            for turns in [Turns::Sides, Turns::ExposedSides] {
                for rule in [Rule::Listed, Rule::Supported] {
                    let expected = lines_by_definition(&set, turns, rule);
                    assert!(expected == centreline(&set, turns, rule), "{seed} {turns:?} {rule:?}");
                }
            }
        }
    }
}
