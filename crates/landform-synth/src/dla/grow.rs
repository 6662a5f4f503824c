//! Growth of an aggregate, particle by particle.

use landform_sim::random::{NodeRandom, RandomStream};
use rand::RngExt;

use super::cells::{Cells, Gap};
use super::walk::{direction, return_to_floor, return_to_sphere};

/// Longest step of a walker near the aggregate, in particle diameters.
const STEP: f64 = 1.0;

/// Distance of the launch from the outermost particle.
const MARGIN: f64 = 2.0;

/// Share of the way to a contact that a walker goes which does not stick.
const SHORT: f64 = 1.0 - 1e-9;

/// What an aggregate grows from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Origin {
    /// A particle at the origin.
    Point,
    /// The floor: the line (2-D) or plane (3-D) where the last coordinate is 0. The other axes
    /// close after this length, in particle diameters; at least 16.
    Floor(f64),
}

/// When an aggregate is done, and how it grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// What it grows from.
    pub origin: Origin,
    /// Most particles.
    pub particles: usize,
    /// Farthest that a particle may be from the origin, or above the floor, in diameters. The
    /// aggregate is done when one is.
    pub reach: f64,
    /// Probability that a walker sticks where it touches; else it walks on. In (0, 1].
    pub sticking: f64,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// A grown aggregate.
#[derive(Clone, Debug, PartialEq)]
pub struct Aggregated<const D: usize> {
    /// Centres of the particles in the order of their arrival, in diameters.
    pub places: Vec<[f64; D]>,
    /// The particle that each sticks to; none for the first of a tree.
    pub parents: Vec<Option<u32>>,
}

/// Diffusion-limited aggregation without a lattice, in 2-D or 3-D (Witten and Sander 1981):
/// walkers come from infinity one by one and stick where they touch.
///
/// Far from the aggregate a walker jumps to the edge of the largest disc or ball that is known
/// to be empty; from outside of the launch circle it returns to it by the Poisson kernel, so
/// that neither radius nor killing bends the law. Nearer than two diameters it goes steps of one
/// diameter. Walker `n` draws its random numbers from (seed, n) alone.
///
/// Cost: about constant a particle. Memory: about 40 bytes a particle, and 4 bytes for four
/// square diameters (eight cubic ones) of the block around the aggregate.
pub fn aggregate<const D: usize>(growth: &Growth) -> Aggregated<D> {
    let mut cluster = Cluster::<D>::new(growth);
    let random = RandomStream::new(growth.seed, "aggregation");
    while cluster.cells.places.len() < growth.particles && cluster.extent < growth.reach {
        let walker = cluster.cells.places.len();
        let (place, parent) = cluster.walk(&mut random.at(0, walker));
        cluster.stick(place, parent);
    }
    Aggregated { places: cluster.cells.places, parents: cluster.parents }
}

struct Cluster<const D: usize> {
    origin: Origin,
    sticking: f64,
    cells: Cells<D>,
    parents: Vec<Option<u32>>,
    /// Largest distance of a particle from the origin, or above the floor.
    extent: f64,
    /// Half the side, or the height, of the block of cells.
    room: f64,
}

impl<const D: usize> Cluster<D> {
    fn new(growth: &Growth) -> Self {
        let room = 32.0;
        let cells = Self::cells(growth.origin, room);
        let (origin, sticking) = (growth.origin, growth.sticking);
        let mut cluster = Self { origin, sticking, cells, parents: Vec::new(), extent: 0.0, room };
        if origin == Origin::Point {
            cluster.stick([0.0; D], None);
        }
        cluster
    }

    fn cells(origin: Origin, room: f64) -> Cells<D> {
        match origin {
            Origin::Point => Cells::new([-room; D], [room; D], [false; D], Cells::<D>::open_side()),
            Origin::Floor(length) => {
                let mut periodic = [true; D];
                periodic[D - 1] = false;
                let [mut low, mut high] = [[0.0; D], [length; D]];
                (low[D - 1], high[D - 1]) = (-8.0, room);
                Cells::new(low, high, periodic, Cells::<D>::closing_side(length))
            }
        }
    }

    /// Adds a particle; larger cells are made when the aggregate comes near the edge of its own.
    fn stick(&mut self, place: [f64; D], parent: Option<u32>) {
        self.extent = self.extent.max(self.outwards(place));
        if self.extent + MARGIN + 2.0 * STEP > self.room {
            self.room *= 2.0;
            let mut larger = Self::cells(self.origin, self.room);
            for &place in &self.cells.places {
                larger.add(place);
            }
            self.cells = larger;
        }
        if self.cells.add(place) {
            self.parents.push(parent);
        }
    }

    /// Distance from the origin, or height above the floor.
    fn outwards(&self, place: [f64; D]) -> f64 {
        match self.origin {
            Origin::Point => place.iter().map(|x| x * x).sum::<f64>().sqrt(),
            Origin::Floor(_) => place[D - 1],
        }
    }

    /// Where a new walker begins: evenly spread over the launch circle, or above the floor.
    fn launch(&self, random: &mut NodeRandom) -> [f64; D] {
        let launch = self.extent + MARGIN;
        match self.origin {
            Origin::Point => direction(random).map(|x| x * launch),
            Origin::Floor(length) => {
                let mut place = [0.0; D].map(|_: f64| length * random.random::<f64>());
                place[D - 1] = launch;
                place
            }
        }
    }

    /// Walks until the walker sticks: where, and to what.
    fn walk(&self, random: &mut NodeRandom) -> ([f64; D], Option<u32>) {
        let mut place = self.launch(random);
        let mut level = 0;
        loop {
            let outwards = self.outwards(place);
            let launch = self.extent + MARGIN;
            if outwards > launch * (1.0 + 1e-12) {
                place = match self.origin {
                    Origin::Point => return_to_sphere(place, launch, random)
                        .unwrap_or_else(|| self.launch(random)),
                    Origin::Floor(_) => return_to_floor(place, outwards - launch, random),
                };
                self.close(&mut place);
            }
            let free = self.free_way(place, &mut level);
            let step = direction::<D>(random);
            if free >= STEP {
                place = along(place, step, free);
                self.close(&mut place);
                continue;
            }
            let (way, touched) = self.first_contact(place, step);
            if let Some(parent) = touched {
                if self.sticking >= 1.0 || random.random::<f64>() < self.sticking {
                    return (self.settled(along(place, step, way), parent), parent);
                }
                place = along(place, step, way * SHORT);
            } else {
                place = along(place, step, way);
            }
            self.close(&mut place);
        }
    }

    /// Radius of an empty disc or ball around a walker: it touches nothing within.
    fn free_way(&self, place: [f64; D], level: &mut usize) -> f64 {
        let free = match self.cells.gap(place, level) {
            Some(Gap::Free(way) | Gap::Near(way)) => way - 1.0,
            // Outside of the cells there is nothing but the way back.
            None => STEP,
        };
        match self.origin {
            Origin::Point => free,
            Origin::Floor(_) => free.min(place[D - 1]),
        }
    }

    /// The way of a step, at most [`STEP`], and what it ends at: a particle, or the floor.
    fn first_contact(&self, place: [f64; D], step: [f64; D]) -> (f64, Option<Option<u32>>) {
        let touched = self.cells.contact(place, step, STEP);
        let (way, particle) =
            touched.map_or((STEP, None), |(way, particle)| (way, Some(Some(particle))));
        let floor = match self.origin {
            Origin::Floor(_) if step[D - 1] < 0.0 => (place[D - 1] / -step[D - 1]).max(0.0),
            _ => f64::INFINITY,
        };
        if floor <= way && floor <= STEP { (floor, Some(None)) } else { (way, particle) }
    }

    /// Brings a place back into the length of the axes that close.
    fn close(&self, place: &mut [f64; D]) {
        if let Origin::Floor(length) = self.origin {
            place[..D - 1].iter_mut().for_each(|x| *x = x.rem_euclid(length));
        }
    }

    /// Where a walker settles that sticks at a place: on the floor if it touches no particle.
    fn settled(&self, mut place: [f64; D], parent: Option<u32>) -> [f64; D] {
        self.close(&mut place);
        if parent.is_none() {
            place[D - 1] = 0.0;
        }
        place
    }
}

fn along<const D: usize>(place: [f64; D], step: [f64; D], way: f64) -> [f64; D] {
    std::array::from_fn(|axis| place[axis] + way * step[axis])
}
