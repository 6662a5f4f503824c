//! Particles in cells, and which blocks of cells are empty.

/// Side of the smallest cells, in particle diameters.
const SIDE: f64 = 2.0;

/// Levels of ever larger cells, each twice as wide as those of the one before.
const MOST_LEVELS: usize = 24;

/// End of a list of particles.
const NONE: u32 = u32::MAX;

/// The particles of an aggregate, found by place. All lengths are particle diameters.
///
/// Level `l` has cells of side `2 * 2^l`, each with a bit that says whether a particle lies in
/// the block of `3^D` cells around it. A walker in a cell whose bit is clear is a side or more
/// away from all particles (after the hierarchy of Ossadnik 1991).
#[derive(Clone, Debug)]
pub(super) struct Cells<const D: usize> {
    side: f64,
    /// Corner of the block of cells.
    low: [f64; D],
    /// Cells along each axis.
    counts: [usize; D],
    /// The axes that close on themselves.
    periodic: [bool; D],
    levels: Vec<Vec<u64>>,
    /// First particle of every cell, and the one after each particle.
    heads: Vec<u32>,
    next: Vec<u32>,
    /// The particles.
    pub places: Vec<[f64; D]>,
}

/// How far a walker is from what is there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Gap {
    /// No particle's centre is nearer than this.
    Free(f64),
    /// Particles may be near: the nearest one's centre is this far, or farther if more.
    Near(f64),
}

impl<const D: usize> Cells<D> {
    /// Cells from one corner to at least another. A periodic axis is `high - low` long, 8
    /// or more.
    pub fn new(low: [f64; D], high: [f64; D], periodic: [bool; D], side: f64) -> Self {
        let counts: [usize; D] =
            std::array::from_fn(|axis| ((high[axis] - low[axis]) / side).round().max(4.0) as usize);
        let mut levels = Vec::new();
        for level in 0..MOST_LEVELS {
            let cells = counts.map(|count| count.div_ceil(1 << level));
            // Fewer than four cells around a periodic axis would meet themselves.
            let closes = |axis: usize| {
                !periodic[axis] || (counts[axis].is_multiple_of(1 << level) && cells[axis] >= 4)
            };
            if level > 0 && (!(0..D).all(closes) || cells.iter().all(|&cells| cells < 4)) {
                break;
            }
            levels.push(vec![0; cells.iter().product::<usize>().div_ceil(64)]);
        }
        let heads = vec![NONE; counts.iter().product()];
        Self { side, low, counts, periodic, levels, heads, next: Vec::new(), places: Vec::new() }
    }

    /// A side for cells of an axis that closes after `length`: a power of two of them.
    pub fn closing_side(length: f64) -> f64 {
        let mut cells = 4.0;
        while length / (cells * 2.0) >= SIDE {
            cells *= 2.0;
        }
        length / cells
    }

    /// The side where no axis closes.
    pub const fn open_side() -> f64 {
        SIDE
    }

    /// Cell of a place; none outside.
    fn cell(&self, place: [f64; D]) -> Option<[usize; D]> {
        let mut cell = [0; D];
        for axis in 0..D {
            let at = ((place[axis] - self.low[axis]) / self.side).floor();
            let count = self.counts[axis] as f64;
            let at = if self.periodic[axis] { at.rem_euclid(count) } else { at };
            if !(at >= 0.0 && at < count) {
                return None;
            }
            cell[axis] = at as usize;
        }
        Some(cell)
    }

    fn number(counts: [usize; D], cell: [usize; D]) -> usize {
        (0..D).rev().fold(0, |number, axis| number * counts[axis] + cell[axis])
    }

    fn counts_at(&self, level: usize) -> [usize; D] {
        self.counts.map(|count| count.div_ceil(1 << level))
    }

    /// Calls `visit` with the numbers of the cells of the block around one.
    #[inline]
    fn block(&self, level: usize, cell: [usize; D], mut visit: impl FnMut(usize)) {
        let counts = self.counts_at(level);
        'cells: for code in 0..3_usize.pow(D as u32) {
            let (mut code, mut around) = (code, [0; D]);
            for axis in 0..D {
                let moved = (cell[axis] + code % 3).wrapping_sub(1);
                code /= 3;
                around[axis] = match (moved < counts[axis], self.periodic[axis]) {
                    (true, _) => moved,
                    (false, true) if moved == counts[axis] => 0,
                    (false, true) => counts[axis] - 1,
                    (false, false) => continue 'cells,
                };
            }
            visit(Self::number(counts, around));
        }
    }

    /// Adds a particle; false if it lies outside of the cells.
    pub fn add(&mut self, place: [f64; D]) -> bool {
        let Some(cell) = self.cell(place) else { return false };
        let home = Self::number(self.counts, cell);
        self.next.push(std::mem::replace(&mut self.heads[home], self.places.len() as u32));
        self.places.push(place);
        for level in 0..self.levels.len() {
            let mut bits = std::mem::take(&mut self.levels[level]);
            let mut new = false;
            self.block(level, cell.map(|at| at >> level), |number| {
                let bit = 1 << (number % 64);
                new |= bits[number / 64] & bit == 0;
                bits[number / 64] |= bit;
            });
            self.levels[level] = bits;
            // A block that was full of bits is full of them on all higher levels too.
            if !new {
                break;
            }
        }
        true
    }

    /// How far a walker may go. `level` is where the search begins: the level that answered
    /// last, which it changes. None outside of the cells.
    pub fn gap(&self, place: [f64; D], level: &mut usize) -> Option<Gap> {
        let cell = self.cell(place)?;
        let is_near = |level: usize| {
            let number = Self::number(self.counts_at(level), cell.map(|at| at >> level));
            self.levels[level][number / 64] >> (number % 64) & 1 == 1
        };
        let mut at = (*level).min(self.levels.len() - 1);
        if is_near(at) {
            while at > 0 && is_near(at - 1) {
                at -= 1;
            }
            if at == 0 {
                *level = 0;
                let beyond = self.block_edge(place, cell, 0);
                let nearest = self.nearest(place, cell);
                return Some(Gap::Near(nearest.min(beyond)));
            }
            at -= 1;
        } else {
            while at + 1 < self.levels.len() && !is_near(at + 1) {
                at += 1;
            }
        }
        *level = at;
        Some(Gap::Free(self.block_edge(place, cell, at)))
    }

    /// Distance to the edge of the block around the cell of a place.
    fn block_edge(&self, place: [f64; D], cell: [usize; D], level: usize) -> f64 {
        let side = self.side * (1_u32 << level) as f64;
        let mut least = f64::INFINITY;
        for axis in 0..D {
            let from = place[axis] - self.low[axis];
            let length = self.side * self.counts[axis] as f64;
            let from = if self.periodic[axis] { from.rem_euclid(length) } else { from };
            let within = from - (cell[axis] >> level) as f64 * side;
            least = least.min(within.min(side - within).max(0.0));
        }
        side + least
    }

    /// Distance to the nearest particle of the block around a cell.
    fn nearest(&self, place: [f64; D], cell: [usize; D]) -> f64 {
        let mut least = f64::INFINITY;
        self.block(0, cell, |number| {
            let mut particle = self.heads[number];
            while particle != NONE {
                let apart = self.apart(place, self.places[particle as usize]);
                least = least.min(apart.iter().map(|x| x * x).sum());
                particle = self.next[particle as usize];
            }
        });
        least.sqrt()
    }

    /// The way from one place to another, the short way round periodic axes.
    #[inline]
    fn apart(&self, from: [f64; D], to: [f64; D]) -> [f64; D] {
        std::array::from_fn(|axis| {
            let way = to[axis] - from[axis];
            if !self.periodic[axis] {
                return way;
            }
            let length = self.side * self.counts[axis] as f64;
            way - length * (way / length).round()
        })
    }

    /// The first particle that a walker touches on a step of `length` 2 or less in a direction,
    /// and after what way.
    pub fn contact(&self, place: [f64; D], step: [f64; D], length: f64) -> Option<(f64, u32)> {
        let cell = self.cell(place)?;
        let mut first: Option<(f64, u32)> = None;
        self.block(0, cell, |number| {
            let mut particle = self.heads[number];
            while particle != NONE {
                let apart = self.apart(place, self.places[particle as usize]);
                if let Some(way) = touch(apart, step).filter(|&way| way <= length)
                    && first.is_none_or(|(least, _)| way < least)
                {
                    first = Some((way, particle));
                }
                particle = self.next[particle as usize];
            }
        });
        first
    }
}

/// Way in a direction after which a point is 1 away from the end of `apart`; none if it never
/// comes nearer, 0 if it is nearer already and comes nearer still.
#[inline]
fn touch<const D: usize>(apart: [f64; D], direction: [f64; D]) -> Option<f64> {
    let towards: f64 = (0..D).map(|axis| apart[axis] * direction[axis]).sum();
    let squared: f64 = apart.iter().map(|x| x * x).sum();
    let under = towards * towards - squared + 1.0;
    (towards > 0.0 && under > 0.0).then(|| (towards - under.sqrt()).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_sim::random::RandomStream;

    fn scattered<const D: usize>(count: usize, scale: f64) -> Vec<[f64; D]> {
        let random = RandomStream::new(3, "scattered");
        let unit = |n: usize, axis: usize| random.unit(0, n, axis as u32);
        (0..count).map(|n| std::array::from_fn(|axis| scale * (unit(n, axis) - 0.5))).collect()
    }

    /// No particle is nearer than a gap says; the nearest is found where it is near.
    fn gaps_hold<const D: usize>(periodic: [bool; D]) {
        let side = 128.0;
        let mut cells = Cells::<D>::new([-side / 2.0; D], [side / 2.0; D], periodic, SIDE);
        let particles = scattered::<D>(60, 40.0);
        assert!(particles.iter().all(|&place| cells.add(place)));
        let mut level = 0;
        for place in scattered::<D>(2000, side) {
            let squared = |to: &[f64; D]| cells.apart(place, *to).iter().map(|x| x * x).sum();
            let nearest = particles.iter().map(squared).fold(f64::INFINITY, f64::min).sqrt();
            match cells.gap(place, &mut level).expect("inside") {
                Gap::Free(free) => assert!(free <= nearest && free >= SIDE, "{free} {nearest}"),
                Gap::Near(near) => assert!(near == nearest || (near < nearest && near >= SIDE)),
            }
        }
        assert_eq!(cells.gap([1e6; D], &mut level).is_none(), !periodic[D - 1]);
    }

    #[test]
    fn gaps_hold_in_all_dimensions() {
        gaps_hold([false; 2]);
        gaps_hold([true, false]);
        gaps_hold([false; 3]);
        gaps_hold([true, true, false]);
    }

    #[test]
    fn contacts_are_one_diameter_away() {
        let mut cells = Cells::<2>::new([-8.0; 2], [8.0; 2], [false; 2], SIDE);
        assert!(cells.add([0.0, 0.0]) && cells.add([3.0, 0.0]));
        let (way, particle) = cells.contact([1.9, 0.0], [-1.0, 0.0], 1.0).expect("a contact");
        assert!((way - 0.9).abs() < 1e-12);
        assert_eq!(particle, 0);
        assert_eq!(cells.contact([2.1, 0.0], [-1.0, 0.0], 1.0), None);
        assert_eq!(cells.contact([1.5, 0.0], [0.0, 1.0], 1.0), None);
    }
}
