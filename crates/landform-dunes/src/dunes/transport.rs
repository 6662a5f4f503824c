//! Transport: the wind lifts slabs, and they hop downwind until they stay (Werner 1995).
//!
//! In a sub-step every polled node that lies in the wind and holds a slab loses one. The slab
//! hops over the same distance until it lands where it stays: surely in shelter, with
//! probability `deposit_on_sand` or `deposit_on_bare` in the wind. All slabs of a sub-step see the ground as
//! it was before, so they fly in any order on any number of threads; where they landed is then
//! added in node order. A quarter of the nodes acts at a time, which is close enough to
//! polling one by one (tested against the module `reference`).
//!
//! With no shelter the number of hops is geometric with mean 1/p, and the flux is the length of a hop over
//! p slabs a poll (Nield and Baas 2008).

use landform_sim::random::RandomStream;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::TransportSettings;
use super::plane::Plane;

/// Sub-steps of a tick: each polls the nodes whose random number is its own.
pub const SUB_STEPS: u32 = 4;

/// Rows that one task lifts slabs from.
const BAND: usize = 16;

/// Bit of a node's ground that says it holds at least a slab of sand.
const SAND: u8 = 1;

/// Bit of a node's ground that says it is sheltered.
const SHELTERED: u8 = 2;

/// What transport did in a tick or a sub-step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct TransportCounts {
    /// Slabs that the wind lifted.
    pub lifts: u64,
    /// Hops of all slabs together.
    pub hops: u64,
    /// Slabs that had to stay because they had hopped too often.
    pub tired: u64,
    /// Slabs that entered over open borders.
    pub fed: u64,
    /// Slabs that left over the west, east, north and south border.
    pub left: [u64; 4],
}

impl TransportCounts {
    /// Adds the counts of another sub-step.
    pub fn add(&mut self, other: &Self) {
        self.lifts += other.lifts;
        self.hops += other.hops;
        self.tired += other.tired;
        self.fed += other.fed;
        for (left, more) in self.left.iter_mut().zip(other.left) {
            *left += more;
        }
    }
}

/// The random decisions of transport.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chances {
    /// Which sub-step polls a node.
    poll: RandomStream,
    /// Whether a slab stays where it lands.
    pub land: RandomStream,
}

impl Chances {
    /// The decisions of a run's seed.
    pub fn new(seed: u64) -> Self {
        Self {
            poll: RandomStream::new(seed, "dunes poll"),
            land: RandomStream::new(seed, "dunes land"),
        }
    }

    /// Sub-steps in which 64 nodes of a row are polled, two bits each.
    #[inline]
    pub fn polls(&self, iteration: u64, block: usize) -> [u32; 4] {
        self.poll.block(iteration, block, 0)
    }
}

/// How slabs fly in one sub-step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flight {
    plane: Plane,
    /// Columns and rows of a hop.
    hop: [isize; 2],
    /// Random words below this stay: on bare ground, on sand, and twice in shelter.
    stays: [u64; 4],
    most_hops: u32,
}

/// Where a flight ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Landing {
    /// On a node.
    Node(usize),
    /// Beyond a border: west, east, north or south.
    Left(usize),
}

impl Flight {
    /// Flights by `hop` under these settings.
    pub fn new(plane: Plane, hop: [isize; 2], settings: &TransportSettings) -> Self {
        let below = |chance: f64| (chance * 4_294_967_296.0) as u64;
        let [bare, sand] = [below(settings.deposit_on_bare), below(settings.deposit_on_sand)];
        let always = 1 << 32;
        Self { plane, hop, stays: [bare, sand, always, always], most_hops: settings.most_hops }
    }

    /// Columns and rows that a hop crosses.
    pub fn reach(&self) -> [usize; 2] {
        self.hop.map(isize::unsigned_abs)
    }

    /// Lets a slab from outside come down on `place`, where it stays or hops on.
    pub fn enter(
        &self,
        place: [usize; 2],
        ground: &[u8],
        luck: &Luck,
        counts: &mut TransportCounts,
    ) -> Landing {
        let node = place[0] + self.plane.width * place[1];
        // The last block of words: no flight hops that often.
        let word = luck.block(u32::MAX)[0];
        if u64::from(word) < self.stays[usize::from(ground[node])] {
            return Landing::Node(node);
        }
        self.fly(place, ground, luck, counts)
    }

    /// The node or border that a hop leads to.
    #[inline]
    fn hop(&self, [column, row]: [usize; 2]) -> Result<[usize; 2], usize> {
        let [columns, rows] = self.hop;
        let column = self.plane.column(column, columns).ok_or(usize::from(columns > 0))?;
        let row = self.plane.row(row, rows).ok_or(2 + usize::from(rows > 0))?;
        Ok([column, row])
    }

    /// Flies a slab from `place`.
    #[inline]
    pub fn fly(
        &self,
        mut place: [usize; 2],
        ground: &[u8],
        luck: &Luck,
        counts: &mut TransportCounts,
    ) -> Landing {
        let mut words = luck.words;
        for hop in 0..self.most_hops {
            counts.hops += 1;
            place = match self.hop(place) {
                Ok(place) => place,
                Err(border) => return Landing::Left(border),
            };
            if hop % 4 == 0 && hop > 0 {
                words = luck.block(hop / 4);
            }
            let landed = place[0] + self.plane.width * place[1];
            let stays = self.stays[usize::from(ground[landed])];
            if u64::from(words[hop as usize % 4]) < stays {
                return Landing::Node(landed);
            }
        }
        counts.tired += 1;
        Landing::Node(place[0] + self.plane.width * place[1])
    }
}

/// The random words that decide how often a slab hops.
#[derive(Clone, Copy, Debug)]
pub(super) struct Luck {
    stream: RandomStream,
    iteration: u64,
    /// Node that the slab comes from, or another number of its own.
    slab: usize,
    /// The first words, which are enough for most slabs.
    words: [u32; 4],
}

impl Luck {
    /// The words of a slab at an iteration.
    #[inline]
    pub fn new(stream: RandomStream, iteration: u64, slab: usize) -> Self {
        Self { stream, iteration, slab, words: stream.block(iteration, slab, 0) }
    }

    /// Further words.
    fn block(&self, index: u32) -> [u32; 4] {
        self.stream.block(self.iteration, self.slab, index)
    }
}

/// Where the slabs of one band start and land: scratch.
#[derive(Clone, Debug, Default)]
pub(super) struct Band {
    /// Slabs that leave a row.
    lifted: Vec<Luck>,
    landings: Vec<u32>,
    counts: TransportCounts,
}

/// The sub-step that is under way.
#[derive(Clone, Copy, Debug)]
pub(super) struct SubStep {
    /// Tick that it belongs to.
    pub iteration: u64,
    /// Number within the tick.
    pub number: u32,
    /// Height of a slab in metres.
    pub slab: f64,
    /// Whether slabs are lifted from sheltered nodes too.
    pub lift_in_shelter: bool,
}

/// Says of every node what a slab meets that lands there: [`SAND`] and [`SHELTERED`] or not.
pub(super) fn survey(sheltered: &[bool], sand: &[f64], slab: f64, ground: &mut [u8]) {
    const CHUNK: usize = 1 << 14;
    let states = sheltered.par_chunks(CHUNK).zip(sand.par_chunks(CHUNK));
    ground.par_chunks_mut(CHUNK).zip(states).for_each(|(ground, (sheltered, sand))| {
        for ((ground, &sheltered), &sand) in ground.iter_mut().zip(sheltered).zip(sand) {
            *ground = (SAND * u8::from(sand >= slab)) | (SHELTERED * u8::from(sheltered));
        }
    });
}

/// Lifts and flies the slabs of a sub-step, and puts them down.
pub(super) fn transport(
    step: &SubStep,
    flight: &Flight,
    chances: &Chances,
    ground: &[u8],
    sand: &mut [f64],
    bands: &mut Vec<Band>,
) -> TransportCounts {
    let Plane { width, height, .. } = flight.plane;
    bands.resize_with(height.div_ceil(BAND), Band::default);
    sand.par_chunks_mut(BAND * width).zip(&mut *bands).enumerate().for_each(
        |(number, (sand, band))| {
            lift(step, flight, chances, ground, number * BAND, sand, band);
        },
    );
    let mut counts = TransportCounts::default();
    for band in bands {
        counts.add(&band.counts);
        for &node in &band.landings {
            sand[node as usize] += step.slab;
        }
    }
    counts
}

/// Lifts and flies the slabs of the rows from `first` on.
fn lift(
    step: &SubStep,
    flight: &Flight,
    chances: &Chances,
    ground: &[u8],
    first: usize,
    sand: &mut [f64],
    band: &mut Band,
) {
    let width = flight.plane.width;
    let blocks = width.div_ceil(64);
    band.landings.clear();
    band.counts = TransportCounts::default();
    let sheltered_sand = if step.lift_in_shelter { SAND | SHELTERED } else { SAND };
    for (row, sand) in (first..).zip(sand.chunks_exact_mut(width)) {
        band.lifted.clear();
        for block in 0..blocks {
            let words = chances.polls(step.iteration, row * blocks + block);
            for (part, word) in words.into_iter().enumerate() {
                let mut polled = matches(word, step.number);
                while polled != 0 {
                    let column = block * 64 + part * 16 + polled.trailing_zeros() as usize / 2;
                    polled &= polled - 1;
                    if column >= width {
                        break;
                    }
                    let node = row * width + column;
                    if ground[node] == SAND || ground[node] == sheltered_sand {
                        sand[column] -= step.slab;
                        band.lifted.push(Luck::new(chances.land, step.iteration, node));
                    }
                }
            }
        }
        fly_all(flight, ground, row, band);
    }
}

/// Flies the slabs that were lifted from a row. Their random words are there already, so that
/// the processor does not have to wait for them before it can know how often a slab hops.
fn fly_all(flight: &Flight, ground: &[u8], row: usize, band: &mut Band) {
    let Band { lifted, landings, counts } = band;
    counts.lifts += lifted.len() as u64;
    for luck in &*lifted {
        let place = [luck.slab - row * flight.plane.width, row];
        match flight.fly(place, ground, luck, counts) {
            Landing::Node(node) => landings.push(node as u32),
            Landing::Left(border) => counts.left[border] += 1,
        }
    }
}

/// The even bits of `word` whose pair of bits equals `number`.
#[inline]
pub(super) fn matches(word: u32, number: u32) -> u32 {
    let differs = word ^ (number * 0x5555_5555);
    !(differs | differs >> 1) & 0x5555_5555
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity, Lattice};

    fn plane(boundary: Boundary) -> Plane {
        let size = [100, 40];
        Plane::new(&Lattice::plane(size, 1.0, Connectivity::Four, [boundary; 2]).unwrap())
    }

    const STEP: SubStep = SubStep { iteration: 7, number: 2, slab: 1.0, lift_in_shelter: false };

    /// Visits every node, one after the other, and counts landings: lifts and changes.
    fn transport_by_polling(flight: &Flight, chances: &Chances, ground: &[u8]) -> (u64, Vec<i32>) {
        let Plane { width, .. } = flight.plane;
        let mut change = vec![0; ground.len()];
        let mut counts = TransportCounts::default();
        for node in 0..ground.len() {
            let [column, row] = [node % width, node / width];
            let words = chances.polls(STEP.iteration, row * width.div_ceil(64) + column / 64);
            let pair = words[column % 64 / 16] >> (2 * (column % 16)) & 3;
            if pair != STEP.number || ground[node] != SAND {
                continue;
            }
            counts.lifts += 1;
            change[node] -= 1;
            let luck = Luck::new(chances.land, STEP.iteration, node);
            if let Landing::Node(landed) = flight.fly([column, row], ground, &luck, &mut counts) {
                change[landed] += 1;
            }
        }
        (counts.lifts, change)
    }

    #[test]
    fn bands_and_bits_give_what_polling_node_by_node_gives() {
        for boundary in [Boundary::Open, Boundary::Periodic] {
            let plane = plane(boundary);
            let ground: Vec<u8> = (0..4000).map(|node| (node * 7919 % 13 % 4) as u8).collect();
            let flight = Flight::new(plane, [-7, 3], &TransportSettings::default());
            let chances = Chances::new(9);
            let mut sand = vec![5.0; 4000];
            let counts = transport(&STEP, &flight, &chances, &ground, &mut sand, &mut Vec::new());
            let (lifts, change) = transport_by_polling(&flight, &chances, &ground);
            assert!(lifts > 100 && counts.lifts == lifts);
            let expected: Vec<f64> = change.iter().map(|&change| 5.0 + f64::from(change)).collect();
            assert_eq!(sand, expected);
            let lost: u64 = counts.left.iter().sum();
            assert_eq!(lost == 0, boundary == Boundary::Periodic);
            assert_eq!(sand.iter().sum::<f64>(), 20_000.0 - lost as f64);
        }
    }

    #[test]
    fn four_sub_steps_poll_every_node_once() {
        for word in [0, u32::MAX, 0x1234_5678, 0x9E37_79B9] {
            let polls: Vec<u32> = (0..4).map(|number| matches(word, number)).collect();
            assert_eq!(polls.iter().fold(0, |all, poll| all | poll), 0x5555_5555);
            assert_eq!(polls.iter().map(|poll| poll.count_ones()).sum::<u32>(), 16);
        }
    }

    /// Hops are geometric with mean 1/p, so a poll moves slabs by hop length over p.
    #[test]
    fn hops_per_lift_follow_the_probability_of_staying() {
        let plane = plane(Boundary::Periodic);
        let settings = TransportSettings::default();
        let flight = Flight::new(plane, [5, 0], &settings);
        for (ground, chance) in [(SAND, settings.deposit_on_sand), (0, settings.deposit_on_bare)] {
            let ground = vec![ground; 4000];
            let stream = RandomStream::new(3, "hops");
            let mut counts = TransportCounts::default();
            for slab in 0..200_000 {
                flight.fly([3, 3], &ground, &Luck::new(stream, 0, slab), &mut counts);
            }
            let mean = counts.hops as f64 / 200_000.0;
            // Four standard errors of a geometric mean.
            let error = 4.0 * (1.0 - chance).sqrt() / chance / 200_000_f64.sqrt();
            assert!((mean - 1.0 / chance).abs() < error, "{mean} hops, expected {}", 1.0 / chance);
        }
    }

    #[test]
    fn slabs_stay_in_shelter_and_when_they_hopped_too_often() {
        let plane = plane(Boundary::Periodic);
        let settings =
            TransportSettings { deposit_on_bare: 1e-12, most_hops: 9, ..Default::default() };
        let flight = Flight::new(plane, [5, 0], &settings);
        let luck = Luck::new(RandomStream::new(3, "hops"), 0, 0);
        let mut counts = TransportCounts::default();
        let sheltered = vec![SHELTERED; 4000];
        assert_eq!(flight.fly([3, 3], &sheltered, &luck, &mut counts), Landing::Node(308));
        assert_eq!((counts.hops, counts.tired), (1, 0));
        assert_eq!(flight.fly([3, 3], &vec![0; 4000], &luck, &mut counts), Landing::Node(348));
        assert_eq!((counts.hops, counts.tired), (10, 1));
    }
}
