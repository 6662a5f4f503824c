//! Avalanches: sand steeper than repose slides until none is left.
//!
//! Along an edge of length `l` the stable step is `T = l tan(repose)`. A node that stands more
//! than that above a neighbour sends sand down its steepest edge (Werner 1995): over a step of
//! `D`, `ceil((D - T) / 2 slab)` slabs, or all its sand when there is less. With slabs no higher
//! than `T` the step never turns round, every slide lowers the potential energy of the sand, and
//! so the slides end.
//!
//! Bands of rows come to rest by themselves, one slide after the other, each avalanche followed
//! to its end. Then bands that lie across the borders of the first do, and one across the
//! periodic border, until nothing is left to slide from band to band. Bands do not depend on the
//! number of threads, so neither do the bits. The first time a band looks at every edge; later
//! only between two rows of which one changed in another band.
//! [`reference::settle`](super::reference::settle) looks at every edge of every node instead, and gives the same bits.
//!
//! Conserves sand to rounding; exactly where thickness is a multiple of the slab. After it no
//! edge is steeper than repose (to 1e-11 in the tangent) unless its upper node is bare.

use landform_graph::{Connectivity, Lattice};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::AvalancheSettings;
use super::band::{Band, Place, Rows, Slid};
use super::plane::Plane;
use super::stencil::Stencil;

/// Rows of a band. Enough that few avalanches leave it, few enough for many threads.
pub(super) const BAND: usize = 32;

/// What the avalanches of one pass did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AvalancheCounts {
    /// Sweeps over the bands of the lattice.
    pub sweeps: u32,
    /// Slides over single edges.
    pub slides: u64,
    /// Sum of the thickness that slid over single edges, metres; times the area of a node it
    /// is a volume.
    pub moved_m: f64,
    /// Whether the sand came to rest within the allowed number of sweeps.
    pub settled: bool,
}

/// The fields that slides change together. Rows may be a part of the lattice.
pub(super) struct Layers<'a> {
    /// Height of the bed, metres.
    pub bed: &'a [f64],
    /// Thickness of sand, metres.
    pub sand: &'a mut [f64],
    /// Bed plus sand, metres; kept so.
    pub surface: &'a mut [f64],
}

/// What bands work with and report: scratch of a pass of avalanches.
#[derive(Clone, Debug, Default)]
pub(super) struct Bands {
    bands: Vec<(Vec<Place>, Slid)>,
    /// Whether sand may be too steep between each row and the next.
    due: Vec<bool>,
}

/// Lets all sand that is too steep slide, and reports what slid.
///
/// `layers` hold the whole lattice. See the module for the scheme and what it guarantees.
pub(super) fn settle(
    lattice: &Lattice,
    settings: &AvalancheSettings,
    slab: f64,
    layers: &mut Layers<'_>,
    bands: &mut Bands,
) -> AvalancheCounts {
    match lattice.connectivity() {
        Connectivity::FourEight | Connectivity::Eight => {
            let stencil = Stencil::<8>::new(lattice, settings.repose(), slab);
            Pass::new(lattice, &stencil, settings, bands).run(layers)
        }
        _ => {
            let stencil = Stencil::<4>::new(lattice, settings.repose(), slab);
            Pass::new(lattice, &stencil, settings, bands).run(layers)
        }
    }
}

/// A pass of avalanches over a lattice.
struct Pass<'a, const N: usize> {
    plane: Plane,
    stencil: &'a Stencil<N>,
    most_sweeps: u32,
    bands: &'a mut Bands,
    counts: AvalancheCounts,
    /// Whether a band gave up.
    gave_up: bool,
}

impl<'a, const N: usize> Pass<'a, N> {
    fn new(
        lattice: &Lattice,
        stencil: &'a Stencil<N>,
        settings: &AvalancheSettings,
        bands: &'a mut Bands,
    ) -> Self {
        let plane = Plane::new(lattice);
        bands.due.clear();
        bands.due.resize(plane.height, true);
        bands.due[plane.height - 1] = plane.wraps_rows && plane.height > 1;
        let most_sweeps = settings.most_sweeps;
        let counts = AvalancheCounts::default();
        Self { plane, stencil, most_sweeps, bands, counts, gave_up: false }
    }

    fn run(mut self, layers: &mut Layers<'_>) -> AvalancheCounts {
        while !self.counts.settled && !self.gave_up && self.counts.sweeps < self.most_sweeps {
            self.settle_bands(layers, 0);
            self.settle_bands(layers, BAND / 2);
            self.settle_closing(layers);
            self.counts.sweeps += 1;
            self.counts.settled = !self.gave_up && !self.bands.due.contains(&true);
        }
        self.counts
    }

    /// Lets bands come to rest, the first of which begins with row `first`.
    fn settle_bands(&mut self, layers: &mut Layers<'_>, first: usize) {
        let Plane { width, height, .. } = self.plane;
        if first >= height {
            return;
        }
        let is_first = self.counts.sweeps == 0 && first == 0;
        let (plane, stencil) = (&self.plane, self.stencil);
        let Bands { bands, due } = &mut *self.bands;
        let due = &*due;
        let most_slides = u64::from(self.most_sweeps).saturating_mul((BAND * width) as u64);
        bands.resize_with((height - first).div_ceil(BAND), Default::default);
        let layers = layers.sand[first * width..]
            .par_chunks_mut(BAND * width)
            .zip(layers.surface[first * width..].par_chunks_mut(BAND * width))
            .zip(layers.bed[first * width..].par_chunks(BAND * width));
        layers.zip(bands.par_iter_mut()).enumerate().for_each(
            |(number, (((sand, surface), bed), (unstable, slid)))| {
                let first = first + number * BAND;
                let rows = Rows { first, count: sand.len() / width, offset: 0 };
                *slid = Slid::default();
                if !is_first && !due[first..first + rows.count - 1].contains(&true) {
                    return;
                }
                let layers = Layers { bed, sand, surface };
                let mut band = Band { plane, stencil, rows, layers, unstable, slid, most_slides };
                band.settle(is_first, |row| due[first + row]);
            },
        );
        for number in 0..self.bands.bands.len() {
            let first = first + number * BAND;
            let count = BAND.min(height - first);
            let slid = self.bands.bands[number].1;
            self.count(&slid, Rows { first, count, offset: 0 }, most_slides);
        }
    }

    /// Lets the band across the periodic border between the last row and the first come to
    /// rest.
    fn settle_closing(&mut self, layers: &mut Layers<'_>) {
        let Plane { width, height, .. } = self.plane;
        if !self.bands.due[height - 1] {
            return;
        }
        let count = BAND.min(height);
        let first = height - count / 2;
        let rows = Rows { first, count, offset: first };
        let most_slides = u64::from(self.most_sweeps).saturating_mul((BAND * width) as u64);
        let Bands { bands, due } = &mut *self.bands;
        let mut slid = Slid::default();
        let mut band = Band {
            plane: &self.plane,
            stencil: self.stencil,
            rows,
            layers: Layers {
                bed: layers.bed,
                sand: &mut *layers.sand,
                surface: &mut *layers.surface,
            },
            unstable: &mut bands[0].0,
            slid: &mut slid,
            most_slides,
        };
        band.settle(false, |row| due[(first + row) % height]);
        self.count(&slid, rows, most_slides);
    }

    /// Adds what slid in a band, and notes that nothing can be too steep any more between its
    /// rows, but between its ends and the rows beyond where the ends changed.
    fn count(&mut self, slid: &Slid, rows: Rows, most_slides: u64) {
        let Plane { height, wraps_rows, .. } = self.plane;
        self.counts.moved_m += slid.amount;
        self.counts.slides += slid.slides;
        self.gave_up |= slid.slides >= most_slides;
        let due = &mut self.bands.due;
        for row in rows.first..rows.first + rows.count - 1 {
            due[row % height] = false;
        }
        let before = (rows.first + height - 1) % height;
        let last = (rows.first + rows.count - 1) % height;
        for (end, gap) in [(0, before), (1, last)] {
            due[gap] |= slid.ends[end] && height > 1 && (wraps_rows || gap + 1 < height);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dunes::reference;
    use landform_graph::Boundary;
    use landform_sim::random::{RandomStream, unit};

    const PLANES: [Connectivity; 3] =
        [Connectivity::Four, Connectivity::FourEight, Connectivity::Eight];

    /// Sand far too steep on a bed with cliffs; a third of the nodes are bare.
    fn rough(lattice: &Lattice, seed: u64) -> (Vec<f64>, Vec<f64>) {
        let random = RandomStream::new(seed, "rough");
        (0..lattice.node_count())
            .map(|node| {
                let [bed, cliff, sand, bare] = random.block(0, node, 0).map(unit);
                let bed = 3.0 * bed + if cliff < 0.1 { 40.0 } else { 0.0 };
                (bed, if bare < 0.3 { 0.0 } else { 30.0 * sand })
            })
            .unzip()
    }

    fn run(lattice: &Lattice, slab: f64, bed: &[f64], sand: &mut [f64]) -> AvalancheCounts {
        let mut surface: Vec<f64> = bed.iter().zip(&*sand).map(|(bed, sand)| bed + sand).collect();
        let mut layers = Layers { bed, sand, surface: &mut surface };
        let settings = AvalancheSettings::default();
        settle(lattice, &settings, slab, &mut layers, &mut Bands::default())
    }

    /// Panics at an edge steeper than repose whose upper node holds sand.
    fn assert_at_rest(lattice: &Lattice, bed: &[f64], sand: &[f64]) {
        for node in 0..sand.len() {
            for edge in lattice.neighbours(node).filter(|_| sand[node] > 0.0) {
                let fall = bed[node] + sand[node] - bed[edge.node] - sand[edge.node];
                let degrees = (fall / edge.distance).atan().to_degrees();
                assert!(degrees <= 33.0 + 1e-9, "{degrees} degrees from node {node} to {edge:?}");
            }
        }
    }

    fn bits(values: &[f64]) -> Vec<u64> {
        values.iter().map(|value| value.to_bits()).collect()
    }

    #[test]
    fn bands_give_the_bits_of_looking_at_every_edge() {
        let boundaries = [Boundary::Open, Boundary::Periodic];
        for connectivity in PLANES {
            for size in
                [[1, 9], [9, 1], [7, 5], [64, 6], [65, 7], [130, 31], [12, 128], [6, 34], [70, 70]]
            {
                for boundary in boundaries.iter().flat_map(|&x| boundaries.map(|y| [x, y])) {
                    let Ok(lattice) = Lattice::plane(size, 10.0, connectivity, boundary) else {
                        continue;
                    };
                    let (bed, start) = rough(&lattice, 3);
                    let [mut fast, mut plain] = [start.clone(), start];
                    let counts = run(&lattice, 0.25, &bed, &mut fast);
                    let settings = AvalancheSettings::default();
                    reference::settle(&lattice, &settings, 0.25, &bed, &mut plain);
                    assert!(counts.settled, "{lattice:?}");
                    assert_eq!(bits(&fast), bits(&plain), "{lattice:?}");
                }
            }
        }
    }

    #[test]
    fn sand_comes_to_rest_and_none_is_lost() {
        for connectivity in PLANES {
            let boundary = [Boundary::Periodic; 2];
            let lattice = Lattice::plane([90, 70], 10.0, connectivity, boundary).unwrap();
            let (bed, mut sand) = rough(&lattice, 8);
            let before: f64 = sand.iter().sum();
            let counts = run(&lattice, 5.0, &bed, &mut sand);
            assert!(counts.settled && counts.slides > 0 && counts.moved_m > 0.0);
            assert_at_rest(&lattice, &bed, &sand);
            assert!(sand.iter().all(|&sand| sand >= 0.0));
            let after: f64 = sand.iter().sum();
            assert!((after / before - 1.0).abs() < 1e-12, "{before} m became {after} m");
        }
    }

    #[test]
    fn any_number_of_threads_gives_the_same_bits() {
        let boundary = [Boundary::Periodic; 2];
        let size = [300, 250];
        let lattice = Lattice::plane(size, 10.0, Connectivity::FourEight, boundary).unwrap();
        let (bed, start) = rough(&lattice, 1);
        let results = [1, 2, 8].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut sand = start.clone();
            let counts = pool.install(|| run(&lattice, 1.0, &bed, &mut sand));
            (bits(&sand), counts.moved_m.to_bits(), counts.slides)
        });
        assert!(results.iter().all(|result| *result == results[0]));
        let mut plain = start;
        reference::settle(&lattice, &AvalancheSettings::default(), 1.0, &bed, &mut plain);
        assert_eq!(results[0].0, bits(&plain));
    }

    /// With slabs exactly as high as the stable step nothing may slide back and forth.
    #[test]
    fn the_highest_slab_allowed_still_settles() {
        let boundary = [Boundary::Periodic; 2];
        let lattice = Lattice::plane([60, 60], 10.0, Connectivity::Eight, boundary).unwrap();
        let slab = AvalancheSettings::default().repose() * 10.0;
        let (bed, mut sand) = rough(&lattice, 2);
        assert!(run(&lattice, slab, &bed, &mut sand).settled);
        assert_at_rest(&lattice, &bed, &sand);
    }
}
