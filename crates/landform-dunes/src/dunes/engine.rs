//! The engine: what one tick of wind does to sand on a bed.

use landform_graph::Lattice;
use landform_sim::random::{RandomStream, unit};
use rayon::prelude::*;

use super::avalanche::{AvalancheCounts, Layers, settle};
use super::error::{DuneError, check_length};
use super::feed::Feed;
use super::plane::Plane;
use super::sweep::Changes;
use super::transport::{Band, Chances, Flight, SUB_STEPS, SubStep, survey, transport};
use super::wind::Directions;
use super::{DuneSettings, Exposure, Shelter, TransportCounts, WindLine};

/// What one tick did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TickCounts {
    /// Slabs lifted, hopped, fed and lost.
    pub transport: TransportCounts,
    /// The avalanches after each of the sub-steps.
    pub avalanches: [AvalancheCounts; SUB_STEPS as usize],
}

/// Checked settings and the memory that ticks work in. Nothing in it is state: an engine made
/// anew from the same settings goes on with the same bits.
///
/// Memory: 11 bytes a node beside bed and sand.
#[derive(Clone, Debug)]
pub struct Engine {
    lattice: Lattice,
    settings: DuneSettings,
    directions: Directions,
    slab: f64,
    chances: Chances,
    wind: RandomStream,
    feed: Feed,
    scratch: Scratch,
}

/// Memory of the engine.
#[derive(Clone, Debug, Default)]
struct Scratch {
    surface: Vec<f64>,
    sheltered: Vec<bool>,
    ground: Vec<u8>,
    bands: Vec<Band>,
    changes: Changes,
}

impl Engine {
    /// An engine for one lattice. `seed` is the run's seed.
    ///
    /// # Errors
    /// See [`DuneSettings::validate`].
    pub fn new(lattice: Lattice, settings: DuneSettings, seed: u64) -> Result<Self, DuneError> {
        settings.validate(&lattice)?;
        let nodes = lattice.node_count();
        let scratch = Scratch {
            surface: vec![0.0; nodes],
            sheltered: vec![false; nodes],
            ground: vec![0; nodes],
            ..Scratch::default()
        };
        Ok(Self {
            directions: settings.rose.directions()?,
            slab: exact_slab(settings.transport.slab_m),
            chances: Chances::new(seed),
            wind: RandomStream::new(seed, "dunes wind"),
            feed: Feed::new(&lattice, &settings.transport, seed),
            scratch,
            lattice,
            settings,
        })
    }

    /// The lattice.
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// The settings, with the slab in use now.
    pub fn settings(&self) -> &DuneSettings {
        &self.settings
    }

    /// Height in metres of the slabs that move: `slab_m` rounded down to 24 bits, so that
    /// adding and taking slabs is exact.
    pub fn slab_m(&self) -> f64 {
        self.slab
    }

    /// Changes the height of a slab, for [`super::Refinement`].
    ///
    /// # Errors
    /// [`DuneError::SlabTooHigh`], [`DuneError::Range`].
    pub fn set_slab_m(&mut self, slab_m: f64) -> Result<(), DuneError> {
        self.settings.validate_slab(&self.lattice, slab_m)?;
        self.settings.transport.slab_m = slab_m;
        self.slab = exact_slab(slab_m);
        Ok(())
    }

    /// One tick: every node is polled once, a quarter of them in each of four sub-steps with a
    /// wind of its own; after each sub-step the sand comes to rest.
    ///
    /// `bed` is the height of the hard ground and `sand` the thickness on it, metres, one
    /// value a node; `iteration` numbers the tick. Conserves sand, less what leaves and plus
    /// what enters over open borders.
    ///
    /// # Errors
    /// [`DuneError::Length`].
    pub fn tick(
        &mut self,
        bed: &[f64],
        sand: &mut [f64],
        iteration: u64,
        shelter: &mut dyn Shelter,
    ) -> Result<TickCounts, DuneError> {
        self.check_lengths(bed, sand)?;
        let mut counts = TickCounts::default();
        // Inside the pool, starting a parallel loop costs far less than from outside.
        rayon::scope(|_| {
            self.raise_surface(bed, sand);
            for number in 0..SUB_STEPS {
                let (moved, slid) = self.sub_step(bed, sand, (iteration, number), shelter);
                counts.transport.add(&moved);
                counts.avalanches[number as usize] = slid;
            }
        });
        Ok(counts)
    }

    /// Lets sand come to rest without wind.
    ///
    /// # Errors
    /// [`DuneError::Length`].
    pub fn settle(&mut self, bed: &[f64], sand: &mut [f64]) -> Result<AvalancheCounts, DuneError> {
        self.check_lengths(bed, sand)?;
        let mut counts = AvalancheCounts::default();
        rayon::scope(|_| {
            self.raise_surface(bed, sand);
            counts = self.avalanche(bed, sand);
        });
        Ok(counts)
    }

    /// The wind of a sub-step: drawn from the rose, with a phase of its own.
    pub fn wind(&self, iteration: u64, sub_step: u32) -> WindLine {
        let words = self.wind.block(iteration, sub_step as usize, 0);
        WindLine::new(self.directions.draw(unit(words[0])), unit(words[1]))
    }

    fn check_lengths(&self, bed: &[f64], sand: &[f64]) -> Result<(), DuneError> {
        let nodes = self.lattice.node_count();
        check_length("bed", bed.len(), nodes)?;
        check_length("sand", sand.len(), nodes)
    }

    fn sub_step(
        &mut self,
        bed: &[f64],
        sand: &mut [f64],
        (iteration, number): (u64, u32),
        shelter: &mut dyn Shelter,
    ) -> (TransportCounts, AvalancheCounts) {
        let wind = self.wind(iteration, number);
        let settings = &self.settings.transport;
        let Scratch { surface, sheltered, ground, bands, .. } = &mut self.scratch;
        let exposure =
            Exposure { lattice: &self.lattice, bed, sand, surface, wind: &wind, slab_m: self.slab };
        shelter.shelter(&exposure, sheltered);
        survey(sheltered, sand, self.slab, ground);
        let plane = Plane::new(&self.lattice);
        let words = self.wind.block(iteration, number as usize, 1);
        let length = settings.hop_m / self.lattice.spacing();
        let hop = wind.jump(length, [unit(words[0]), unit(words[1])]);
        let flight = Flight::new(plane, hop, settings);
        let step = SubStep {
            iteration,
            number,
            slab: self.slab,
            lift_in_shelter: settings.lift_in_shelter,
        };
        let mut layers = Layers { bed, sand, surface };
        let mut moved = transport(&step, &flight, &self.chances, ground, &mut layers, bands);
        moved.add(&self.feed.enter(&step, &wind, &flight, ground, &mut layers));
        (moved, self.avalanche(bed, sand))
    }

    fn avalanche(&mut self, bed: &[f64], sand: &mut [f64]) -> AvalancheCounts {
        let Scratch { surface, changes, .. } = &mut self.scratch;
        let mut layers = Layers { bed, sand, surface };
        settle(&self.lattice, &self.settings.avalanche, self.slab, &mut layers, changes)
    }

    fn raise_surface(&mut self, bed: &[f64], sand: &[f64]) {
        const CHUNK: usize = 1 << 14;
        let ground = bed.par_chunks(CHUNK).zip(sand.par_chunks(CHUNK));
        self.scratch.surface.par_chunks_mut(CHUNK).zip(ground).for_each(
            |(surface, (bed, sand))| {
                for ((surface, &bed), &sand) in surface.iter_mut().zip(bed).zip(sand) {
                    *surface = bed + sand;
                }
            },
        );
    }
}

/// `slab` rounded down to 24 significant bits: sums of such slabs are exact in an `f64`, so a
/// node that received ten can lose ten.
fn exact_slab(slab: f64) -> f64 {
    f64::from_bits(slab.to_bits() & !((1 << 29) - 1))
}
