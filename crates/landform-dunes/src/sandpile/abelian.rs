//! The sandpile of Bak, Tang and Wiesenfeld.

use landform_sim::random::RandomStream;
use thiserror::Error;

/// A site with this many grains topples: one to each neighbour.
const CRITICAL: u32 = 4;

/// Grains that may fall before the counters of the border are emptied, so that none overflows.
const DRAIN_AFTER: u32 = 1 << 30;

/// Largest number of sites and of grains: keeps every counter in 32 bits.
const LARGEST: u64 = 1 << 28;

/// Why a pile or a model cannot be set up.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SandpileError {
    /// There are no sites or too many of them.
    #[error("the pile has {columns} x {rows} sites; it needs at least 1 x 1 and at most 2^28")]
    Size {
        /// Number of columns asked for.
        columns: usize,
        /// Number of rows asked for.
        rows: usize,
    },
    /// The number of values does not fit the number of sites.
    #[error("there are {values} values for {sites} sites; pass one a site")]
    Length {
        /// Number of values passed.
        values: usize,
        /// Number of sites.
        sites: usize,
    },
    /// There are too many grains to count.
    #[error("the pile would hold {grains} grains; at most 2^28 can be placed at once")]
    Grains {
        /// Number of grains passed.
        grains: u64,
    },
    /// A parameter is not a number in its range.
    #[error("{parameter} is {value}; it must be {expected}")]
    Parameter {
        /// Name of the parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// What is accepted.
        expected: &'static str,
    },
    /// A model of a surface was given a volume.
    #[error("the lattice has {layers} layers; this model needs a 2-D lattice")]
    Volume {
        /// Number of layers of the lattice.
        layers: usize,
    },
}

/// What one added grain set off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Avalanche {
    /// Number of topplings.
    pub size: u64,
    /// Number of sites that toppled at least once.
    pub area: u64,
    /// Number of time steps, when all unstable sites topple once in each.
    pub duration: u64,
}

/// Where the grains of a pile came from and went to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GrainLedger {
    /// Grains at the start.
    pub initial: u64,
    /// Grains added since.
    pub added: u64,
    /// Grains on the pile.
    pub held: u64,
    /// Grains that fell off the north, east, south and west border.
    pub fallen: [u64; 4],
}

impl GrainLedger {
    /// Grains that came less those that are there or fell: 0 if none was lost.
    pub fn imbalance(&self) -> i64 {
        let gone = self.held + self.fallen.iter().sum::<u64>();
        (self.initial + self.added) as i64 - gone as i64
    }
}

/// The Abelian sandpile on a square lattice with open borders (Bak, Tang and Wiesenfeld 1987;
/// Dhar 1990).
///
/// A site with four grains or more topples: one grain goes to each neighbour, and over the
/// border where there is none. The final state and the number of topplings do not depend on
/// the order. Grains added again and again bring the pile to its critical state, in which
/// avalanches have no scale but the size of the pile.
///
/// Conserved: grains, see [`AbelianSandpile::ledger`].
#[derive(Clone, Debug)]
pub struct AbelianSandpile {
    size: [usize; 2],
    /// Sites in rows with one more site beyond every border. Those never topple: they start at
    /// [`CRITICAL`], so no grain makes them cross it, and count what falls.
    grains: Vec<u32>,
    unstable: Vec<u32>,
    next_unstable: Vec<u32>,
    /// Number of the last avalanche that toppled each site.
    last_toppled: Vec<u32>,
    avalanche: u32,
    undrained: u32,
    initial: u64,
    added: u64,
    drained: [u64; 4],
}

impl AbelianSandpile {
    /// An empty pile of `size = [columns, rows]` sites.
    ///
    /// # Errors
    /// [`SandpileError::Size`] without sites or with more than 2^28.
    pub fn new(size: [usize; 2]) -> Result<Self, SandpileError> {
        let [columns, rows] = size;
        let sites = (columns as u64).checked_mul(rows as u64).filter(|&sites| sites <= LARGEST);
        if sites.is_none_or(|sites| sites == 0) {
            return Err(SandpileError::Size { columns, rows });
        }
        let padded = (columns + 2) * (rows + 2);
        let mut pile = Self {
            size,
            grains: vec![0; padded],
            unstable: Vec::new(),
            next_unstable: Vec::new(),
            last_toppled: vec![0; padded],
            avalanche: 0,
            undrained: 0,
            initial: 0,
            added: 0,
            drained: [0; 4],
        };
        for border in pile.borders().concat() {
            pile.grains[border] = CRITICAL;
        }
        Ok(pile)
    }

    /// A pile with `grains` at its sites in node order, relaxed. The topplings that this takes
    /// are returned beside it.
    ///
    /// # Errors
    /// [`SandpileError`] if the size is refused, the number of values does not fit it, or there
    /// are more than 2^28 grains.
    pub fn with_grains(size: [usize; 2], grains: &[u32]) -> Result<(Self, u64), SandpileError> {
        let mut pile = Self::new(size)?;
        if grains.len() != size[0] * size[1] {
            let [values, sites] = [grains.len(), size[0] * size[1]];
            return Err(SandpileError::Length { values, sites });
        }
        pile.initial = grains.iter().map(|&grains| u64::from(grains)).sum();
        if pile.initial > LARGEST {
            return Err(SandpileError::Grains { grains: pile.initial });
        }
        for (row, line) in grains.chunks(size[0]).enumerate() {
            for (column, &grains) in line.iter().enumerate() {
                let site = pile.site(column, row);
                pile.grains[site] = grains;
                if grains >= CRITICAL {
                    pile.unstable.push(site as u32);
                }
            }
        }
        let topplings = pile.relax();
        pile.drain();
        Ok((pile, topplings))
    }

    /// Adds a grain at a site and lets it relax.
    ///
    /// # Panics
    /// If the pile has no such column or row.
    pub fn add(&mut self, column: usize, row: usize) -> Avalanche {
        let site = self.site(column, row);
        self.added += 1;
        self.undrained += 1;
        if self.undrained > DRAIN_AFTER {
            self.drain();
        }
        self.grains[site] += 1;
        if self.grains[site] < CRITICAL {
            return Avalanche::default();
        }
        self.unstable.push(site as u32);
        self.topple_in_steps()
    }

    /// Adds a grain at a random site; `number` counts the grains of the run.
    pub fn add_at_random(&mut self, stream: &RandomStream, number: u64) -> Avalanche {
        let [columns, rows] = self.size;
        let words = stream.block(number, 0, 0);
        let pick = |word: u32, count: usize| ((u64::from(word) * count as u64) >> 32) as usize;
        self.add(pick(words[0], columns), pick(words[1], rows))
    }

    /// Number of grains at each site, in node order.
    pub fn grains(&self) -> Vec<u32> {
        let [columns, rows] = self.size;
        let line = |row| &self.grains[self.site(0, row)..][..columns];
        (0..rows).flat_map(line).copied().collect()
    }

    /// Where the grains came from and went to.
    pub fn ledger(&self) -> GrainLedger {
        let on_border = self.borders().map(|border| self.fallen_over(&border));
        let fallen = [0, 1, 2, 3].map(|side| self.drained[side] + on_border[side]);
        let held = self.grains().iter().map(|&grains| u64::from(grains)).sum();
        GrainLedger { initial: self.initial, added: self.added, held, fallen }
    }

    /// Lets the unstable sites topple once in each time step until none is left.
    ///
    /// Toppling one after the other within a step is the same as all at once: a site that is
    /// listed for the next step has crossed the threshold after its turn in this one.
    fn topple_in_steps(&mut self) -> Avalanche {
        let stride = self.size[0] + 2;
        let mut avalanche = Avalanche::default();
        self.avalanche = self.avalanche.wrapping_add(1);
        while !self.unstable.is_empty() {
            avalanche.duration += 1;
            avalanche.size += self.unstable.len() as u64;
            for &site in &self.unstable {
                let site = site as usize;
                avalanche.area += u64::from(self.last_toppled[site] != self.avalanche);
                self.last_toppled[site] = self.avalanche;
                self.grains[site] -= CRITICAL;
                if self.grains[site] >= CRITICAL {
                    self.next_unstable.push(site as u32);
                }
                for neighbour in [site - stride, site - 1, site + 1, site + stride] {
                    self.grains[neighbour] += 1;
                    if self.grains[neighbour] == CRITICAL {
                        self.next_unstable.push(neighbour as u32);
                    }
                }
            }
            self.unstable.clear();
            std::mem::swap(&mut self.unstable, &mut self.next_unstable);
        }
        avalanche
    }

    /// Relaxes the listed sites in any order, each toppling as often as it can at once: far
    /// fewer visits than [`Self::topple_in_steps`] where grains are heaped up.
    fn relax(&mut self) -> u64 {
        let stride = self.size[0] + 2;
        let mut topplings = 0;
        while let Some(site) = self.unstable.pop() {
            let site = site as usize;
            let times = self.grains[site] / CRITICAL;
            self.grains[site] %= CRITICAL;
            topplings += u64::from(times);
            for neighbour in [site - stride, site - 1, site + 1, site + stride] {
                let before = self.grains[neighbour];
                self.grains[neighbour] = before + times;
                if before < CRITICAL && before + times >= CRITICAL {
                    self.unstable.push(neighbour as u32);
                }
            }
        }
        topplings
    }

    /// Moves what the border counted to counters that do not overflow.
    fn drain(&mut self) {
        for (side, border) in self.borders().into_iter().enumerate() {
            self.drained[side] += self.fallen_over(&border);
            for site in border {
                self.grains[site] = CRITICAL;
            }
        }
        self.undrained = 0;
    }

    fn fallen_over(&self, border: &[usize]) -> u64 {
        border.iter().map(|&site| u64::from(self.grains[site] - CRITICAL)).sum()
    }

    /// Indices of the counters beyond the north, east, south and west border.
    fn borders(&self) -> [Vec<usize>; 4] {
        let [columns, rows] = self.size;
        let stride = columns + 2;
        [
            (1..=columns).collect(),
            (1..=rows).map(|row| stride * row + columns + 1).collect(),
            (1..=columns).map(|column| stride * (rows + 1) + column).collect(),
            (1..=rows).map(|row| stride * row).collect(),
        ]
    }

    fn site(&self, column: usize, row: usize) -> usize {
        assert!(column < self.size[0] && row < self.size[1], "no site {column}, {row}");
        (row + 1) * (self.size[0] + 2) + column + 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The readable reference: one toppling at a time at the unstable site that `choose` picks.
    /// Returns the number of topplings.
    fn relax_one_by_one(
        [columns, rows]: [usize; 2],
        grains: &mut [u32],
        mut choose: impl FnMut(usize) -> usize,
    ) -> u64 {
        let mut topplings = 0;
        loop {
            let unstable: Vec<usize> = (0..grains.len()).filter(|&i| grains[i] >= 4).collect();
            if unstable.is_empty() {
                return topplings;
            }
            let site = unstable[choose(unstable.len())];
            let [x, y] = [site % columns, site / columns];
            topplings += 1;
            grains[site] -= 4;
            if x > 0 {
                grains[site - 1] += 1;
            }
            if x + 1 < columns {
                grains[site + 1] += 1;
            }
            if y > 0 {
                grains[site - columns] += 1;
            }
            if y + 1 < rows {
                grains[site + columns] += 1;
            }
        }
    }

    fn piles() -> impl Strategy<Value = ([usize; 2], Vec<u32>)> {
        (1..7_usize, 1..7_usize).prop_flat_map(|(columns, rows)| {
            let grains = prop::collection::vec(0..12_u32, columns * rows);
            (Just([columns, rows]), grains)
        })
    }

    proptest! {
        /// Heaped up, in time steps or one by one in random order: the same state after the
        /// same number of topplings, and no grain lost.
        #[test]
        fn the_order_of_toppling_does_not_matter((size, grains) in piles(), seed in any::<u64>()) {
            let mut expected = grains.clone();
            let stream = RandomStream::new(seed, "order");
            let mut turn = 0;
            let topplings = relax_one_by_one(size, &mut expected, |count| {
                turn += 1;
                stream.block(turn, 0, 0)[0] as usize % count
            });

            let (pile, heaped) = AbelianSandpile::with_grains(size, &grains).unwrap();
            prop_assert_eq!(pile.grains(), expected.clone());
            prop_assert_eq!(heaped, topplings);
            prop_assert_eq!(pile.ledger().imbalance(), 0);

            let mut grown = AbelianSandpile::new(size).unwrap();
            let mut in_steps = 0;
            for (site, &grains) in grains.iter().enumerate() {
                for _ in 0..grains {
                    in_steps += grown.add(site % size[0], site / size[0]).size;
                }
            }
            prop_assert_eq!(grown.grains(), expected);
            prop_assert_eq!(in_steps, topplings);
            prop_assert_eq!(grown.ledger().imbalance(), 0);
            prop_assert_eq!(grown.ledger().fallen, pile.ledger().fallen);
        }
    }

    /// Ten grains in the middle of a full 3 x 3 pile, by hand: the middle topples first, then
    /// the four edges, then the four corners with the middle.
    #[test]
    fn one_avalanche_is_measured_by_hand() {
        let (mut pile, none) = AbelianSandpile::with_grains([3, 3], &[3; 9]).unwrap();
        assert_eq!(none, 0);
        let avalanche = pile.add(1, 1);
        assert_eq!(avalanche, Avalanche { size: 10, area: 9, duration: 3 });
        assert_eq!(pile.grains(), [1, 3, 1, 3, 0, 3, 1, 3, 1]);
        assert_eq!(pile.ledger().fallen, [3; 4]);
    }

    #[test]
    fn the_ledger_tells_the_borders_apart() {
        let mut pile = AbelianSandpile::new([3, 1]).unwrap();
        for _ in 0..4 {
            pile.add(2, 0);
        }
        let fallen = pile.ledger().fallen;
        assert_eq!(fallen, [1, 1, 1, 0], "north, east, south, west");
        pile.drain();
        assert_eq!(pile.ledger().fallen, fallen);
        assert_eq!(pile.ledger().imbalance(), 0);
    }

    #[test]
    fn impossible_piles_are_refused() {
        assert!(matches!(AbelianSandpile::new([0, 3]), Err(SandpileError::Size { .. })));
        assert!(AbelianSandpile::new([usize::MAX, 2]).is_err());
        assert!(AbelianSandpile::with_grains([2, 2], &[1; 3]).is_err());
        let refused = AbelianSandpile::with_grains([1, 2], &[u32::MAX, 1]).unwrap_err();
        assert_eq!(refused, SandpileError::Grains { grains: 1 << 32 });
    }
}
