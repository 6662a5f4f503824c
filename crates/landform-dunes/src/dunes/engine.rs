//! The engine: what one tick of wind does to sand on a bed.

use landform_graph::Lattice;
use landform_sim::random::{RandomStream, unit};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::avalanche::{AvalancheCounts, Bands, Layers, settle};
use super::error::{DuneError, check_length};
use super::feed::Feed;
use super::plane::Plane;
use super::shadow::range;
use super::transport::{Band, Chances, Flight, SUB_STEPS, SubStep, survey, transport};
use super::wind::Directions;
use super::{DuneSettings, Exposure, Shelter, TransportCounts, WindLine};

/// What one tick did.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
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
    avalanches: Bands,
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
            let mut relief = self.raise_surface(bed, sand);
            for number in 0..SUB_STEPS {
                let moved = self.sub_step(bed, sand, relief, (iteration, number), shelter);
                relief = self.raise_surface(bed, sand);
                let slid = self.avalanche(bed, sand);
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
        relief_m: f64,
        (iteration, number): (u64, u32),
        shelter: &mut dyn Shelter,
    ) -> TransportCounts {
        let wind = self.wind(iteration, number);
        let settings = &self.settings.transport;
        let Scratch { surface, sheltered, ground, bands, .. } = &mut self.scratch;
        let exposure = Exposure {
            lattice: &self.lattice,
            bed,
            sand,
            surface,
            relief_m,
            wind: &wind,
            slab_m: self.slab,
        };
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
        let mut moved = transport(&step, &flight, &self.chances, ground, sand, bands);
        moved.add(&self.feed.enter(&step, &wind, &flight, ground, sand));
        moved
    }

    fn avalanche(&mut self, bed: &[f64], sand: &mut [f64]) -> AvalancheCounts {
        let Scratch { surface, avalanches, .. } = &mut self.scratch;
        let mut layers = Layers { bed, sand, surface };
        settle(&self.lattice, &self.settings.avalanche, self.slab, &mut layers, avalanches)
    }

    /// Works out the surface and gives its relief in metres. Avalanches only lower the relief,
    /// so it bounds that of the next sub-step too.
    fn raise_surface(&mut self, bed: &[f64], sand: &[f64]) -> f64 {
        const CHUNK: usize = 1 << 14;
        let none = || (f64::INFINITY, f64::NEG_INFINITY);
        let ground = bed.par_chunks(CHUNK).zip(sand.par_chunks(CHUNK));
        let chunks = self.scratch.surface.par_chunks_mut(CHUNK).zip(ground);
        let ranges = chunks.map(|(surface, (bed, sand))| {
            for ((surface, &bed), &sand) in surface.iter_mut().zip(bed).zip(sand) {
                *surface = bed + sand;
            }
            range(surface)
        });
        let (low, high) = ranges.reduce(none, |a, b| (a.0.min(b.0), a.1.max(b.1)));
        high - low
    }
}

/// `slab` rounded down to 24 significant bits: sums of such slabs are exact in an `f64`, so a
/// node that received ten can lose ten.
fn exact_slab(slab: f64) -> f64 {
    f64::from_bits(slab.to_bits() & !((1 << 29) - 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dunes::{Rose, Shadow, ShadowSettings, TransportSettings, Unsheltered, Wind};
    use landform_graph::{Boundary, Connectivity};

    fn lattice(size: [usize; 2], boundary: Boundary) -> Lattice {
        Lattice::plane(size, 10.0, Connectivity::FourEight, [boundary; 2]).unwrap()
    }

    fn noise(lattice: &Lattice, mean: f64) -> Vec<f64> {
        let random = RandomStream::new(1, "noise");
        (0..lattice.node_count()).map(|n| 2.0 * mean * unit(random.block(0, n, 0)[0])).collect()
    }

    fn shadow() -> Shadow {
        Shadow::new(ShadowSettings::default()).unwrap()
    }

    /// Ticks `from..to` on `threads`, with a new engine.
    fn run(lattice: &Lattice, sand: &mut [f64], ticks: std::ops::Range<u64>, threads: usize) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut engine = Engine::new(lattice.clone(), DuneSettings::default(), 4).unwrap();
        let bed: Vec<f64> = (0..sand.len()).map(|node| (node % 17) as f64).collect();
        pool.install(|| {
            for tick in ticks {
                engine.tick(&bed, sand, tick, &mut shadow()).unwrap();
            }
        });
    }

    #[test]
    fn same_bits_on_any_threads_and_after_a_restart() {
        let lattice = lattice([300, 200], Boundary::Periodic);
        let start = noise(&lattice, 12.0);
        let results = [1, 2, 8].map(|threads| {
            let mut sand = start.clone();
            run(&lattice, &mut sand, 0..3, threads);
            run(&lattice, &mut sand, 3..6, threads);
            sand
        });
        let mut unbroken = start;
        run(&lattice, &mut unbroken, 0..6, 2);
        for sand in &results {
            assert!(sand.iter().zip(&unbroken).all(|(a, b)| a.to_bits() == b.to_bits()));
        }
    }

    #[test]
    fn every_tick_conserves_sand_and_leaves_it_at_rest() {
        let lattice = lattice([128, 64], Boundary::Periodic);
        let mut engine = Engine::new(lattice.clone(), DuneSettings::default(), 4).unwrap();
        let mut sand = noise(&lattice, 12.0);
        let bed = vec![0.0; sand.len()];
        for tick in 0..20 {
            let before: f64 = sand.iter().sum();
            let counts = engine.tick(&bed, &mut sand, tick, &mut shadow()).unwrap();
            let after: f64 = sand.iter().sum();
            assert!((after / before - 1.0).abs() < 1e-12, "tick {tick}: {before} to {after} m");
            assert!(counts.transport.lifts > 0);
            for (node, edge) in
                (0..sand.len()).flat_map(|node| lattice.neighbours(node).map(move |e| (node, e)))
            {
                let slope = (sand[node] - sand[edge.node]) / edge.distance;
                assert!(slope.atan().to_degrees() <= 33.0 + 1e-9 || sand[node] <= 0.0);
            }
            assert!(sand.iter().all(|&sand| sand >= 0.0));
        }
    }

    /// Sand that leaves is counted by border, and with what enters the ledger closes.
    #[test]
    fn the_ledger_of_open_borders_closes() {
        let lattice = lattice([60, 50], Boundary::Open);
        let transport =
            TransportSettings { feed_slabs_per_tick: 12.5, slab_m: 1.0, ..Default::default() };
        let rose = Rose { winds: vec![Wind { towards_deg: 20.0, ..Wind::default() }] };
        let settings = DuneSettings { transport, rose, ..DuneSettings::default() };
        let mut engine = Engine::new(lattice.clone(), settings, 4).unwrap();
        let mut sand: Vec<f64> = noise(&lattice, 4.0).iter().map(|sand| sand.floor()).collect();
        let before: f64 = sand.iter().sum();
        let bed = vec![0.0; sand.len()];
        let mut total = TransportCounts::default();
        for tick in 0..40 {
            let counts = engine.tick(&bed, &mut sand, tick, &mut shadow()).unwrap();
            total.add(&counts.transport);
        }
        let [west, east, north, south] = total.left;
        assert_eq!(total.fed, 500);
        assert!(east > 0 && north > 0 && west + south == 0, "{total:?}");
        let after: f64 = sand.iter().sum();
        assert_eq!(after, before + 500.0 - (east + north) as f64);
    }

    #[test]
    fn slabs_of_awkward_height_leave_no_crumbs() {
        let lattice = lattice([40, 40], Boundary::Periodic);
        let transport = TransportSettings { slab_m: 0.1, ..Default::default() };
        let settings = DuneSettings { transport, ..DuneSettings::default() };
        let mut engine = Engine::new(lattice.clone(), settings, 4).unwrap();
        let mut sand: Vec<f64> = (0..1600).map(|node| f64::from(node % 8) * 0.1).collect();
        let bed = vec![0.0; sand.len()];
        for tick in 0..50 {
            engine.tick(&bed, &mut sand, tick, &mut Unsheltered).unwrap();
        }
        let slab = engine.slab_m();
        assert!((1.0 - slab / 0.1).abs() < 1.2e-7);
        // What cannot be lifted is far less than a slab everywhere.
        assert!(sand.iter().all(|sand| sand % slab < 1e-5), "crumbs are left");
    }

    #[test]
    fn bad_settings_and_fields_are_refused() {
        let lattice = lattice([8, 8], Boundary::Periodic);
        let refused = |change: fn(&mut DuneSettings)| {
            let mut settings = DuneSettings::default();
            change(&mut settings);
            Engine::new(lattice.clone(), settings, 0).unwrap_err()
        };
        let ranges: [fn(&mut DuneSettings); 8] = [
            |settings| settings.transport.slab_m = -1.0,
            |settings| settings.transport.hop_m = f64::NAN,
            |settings| settings.transport.deposit_on_sand = 0.0,
            |settings| settings.transport.deposit_on_bare = 1.1,
            |settings| settings.transport.most_hops = 0,
            |settings| settings.transport.feed_slabs_per_tick = -1.0,
            |settings| settings.avalanche.repose_deg = 90.0,
            |settings| settings.avalanche.repose_deg = 0.0,
        ];
        for change in ranges {
            assert!(matches!(refused(change), DuneError::Range { .. }));
        }
        let high = refused(|settings| settings.transport.slab_m = 7.0);
        assert!(matches!(high, DuneError::SlabTooHigh { .. }), "{high}");
        let closed = refused(|settings| settings.transport.feed_slabs_per_tick = 1.0);
        assert_eq!(closed, DuneError::NoInlet(1.0));
        let volume = Lattice::volume([4; 3], 1.0, Connectivity::Voxel6, [Boundary::Open; 3]);
        let error = Engine::new(volume.unwrap(), DuneSettings::default(), 0).unwrap_err();
        assert_eq!(error, DuneError::Volume(Connectivity::Voxel6));
        let mut engine = Engine::new(lattice, DuneSettings::default(), 0).unwrap();
        let error = engine.tick(&[0.0; 64], &mut [0.0; 63], 0, &mut Unsheltered).unwrap_err();
        assert_eq!(error, DuneError::Length { name: "sand", found: 63, expected: 64 });
        assert!(engine.set_slab_m(f64::INFINITY).is_err());
    }
}
