//! Avalanches: sand steeper than repose slides until none is left.
//!
//! Along an edge of length `l` the stable step is `T = l tan(repose)`. A higher step of `D`
//! sends `ceil((D - T) / 2 slab)` slabs down, or all the sand of the upper node when there is
//! less. With slabs no higher than `T` the step never turns round, every slide lowers the
//! potential energy of the sand, and so the slides end.
//!
//! Edges are visited in families of edges that share no node (even and odd ones of each
//! direction): what one does cannot matter to another, so the family is swept on any number of
//! threads with the same bits. Families are swept in turn until a whole round moves nothing.
//! The first round looks at every edge; later ones only at edges of nodes that slid since the
//! family last looked, found in bit sets of one word per tile of 64 nodes.
//! `settle_by_sweeping` in the module `reference` visits every edge every time and gives the same bits.
//!
//! Conserves sand to rounding; exactly where thickness is a multiple of the slab. After it no
//! edge is steeper than repose (to 1e-11 in the tangent) unless its upper node is bare.

use landform_graph::{Connectivity, Lattice};
use serde::{Deserialize, Serialize};

use super::AvalancheSettings;
use super::plane::Plane;
use super::sweep::{Changes, Sweep};

/// Slope above repose (in the tangent) that counts as rounding.
const TOLERANCE: f64 = 1e-11;

/// What the avalanches of one pass did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AvalancheCounts {
    /// Rounds over all edges, the last one quiet.
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

/// Stable step and slab of one kind of edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct SlideRule {
    /// Highest stable step in metres.
    stable: f64,
    /// Step above which sand slides, a rounding error higher.
    trigger: f64,
    /// Height of a slab in metres.
    slab: f64,
}

impl SlideRule {
    /// The rule of edges `length` metres long.
    pub fn new(repose: f64, length: f64, slab: f64) -> Self {
        let stable = repose * length;
        Self { stable, trigger: stable + TOLERANCE * length, slab }
    }

    /// Difference in height above which sand slides, metres.
    pub fn trigger(&self) -> f64 {
        self.trigger
    }

    /// Lets sand slide between two nodes; gives the thickness that slid.
    #[inline]
    pub fn slide(&self, layers: &mut Layers<'_>, first: usize, second: usize) -> f64 {
        let step = layers.surface[first] - layers.surface[second];
        if step.abs() <= self.trigger {
            return 0.0;
        }
        let (upper, lower) = if step > 0.0 { (first, second) } else { (second, first) };
        let excess = step.abs() - self.stable;
        let wanted = match excess <= 2.0 * self.slab {
            true => self.slab,
            false => (excess / (2.0 * self.slab)).ceil() * self.slab,
        };
        let amount = wanted.min(layers.sand[upper]);
        if amount <= 0.0 {
            return 0.0;
        }
        for (node, change) in [(upper, -amount), (lower, amount)] {
            layers.sand[node] += change;
            layers.surface[node] = layers.bed[node] + layers.sand[node];
        }
        amount
    }
}

/// Which edges of a direction belong to a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// Those that start in even columns (along rows) or even rows.
    Even,
    /// Those that start in odd columns or odd rows.
    Odd,
    /// Those that close a periodic axis: from the last column or row to the first.
    Closing,
}

/// Edges of one direction that share no node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Family {
    /// Columns from the first to the second node of an edge: -1, 0 or 1.
    pub columns: isize,
    /// Rows from the first to the second node: 0 or 1.
    pub rows: usize,
    /// Which edges of the direction.
    pub part: Part,
    /// Whether only nodes whose column and row add to an even number have such edges.
    pub even_nodes: bool,
    /// When sand slides.
    pub rule: SlideRule,
}

impl Family {
    /// Whether two families have edges in the same rows, or pairs of rows. They can be swept
    /// row by row together: what one row or pair does cannot matter to another.
    fn shares_rows(&self, other: &Self) -> bool {
        self.rows == other.rows && (self.rows == 0 || self.part == other.part)
    }
}

/// All edges of a lattice, as families in the order in which they are swept: along rows, then
/// between even rows and the next, odd rows and the next, and over a periodic border.
pub(super) fn families(lattice: &Lattice, repose: f64, slab: f64) -> Vec<Family> {
    let between: &[isize] = match lattice.connectivity() {
        Connectivity::FourEight | Connectivity::Eight => &[0, 1, -1],
        _ => &[0],
    };
    let mut families = Vec::new();
    for (rows, steps) in [(0, &[1][..]), (1, between)] {
        for part in [Part::Even, Part::Odd, Part::Closing] {
            for &columns in
                steps.iter().filter(|_| part != Part::Closing || lattice.is_periodic(rows))
            {
                let length = lattice.step_length([columns as i8, rows as i8, 0]);
                let diagonal = columns != 0 && rows != 0;
                families.push(Family {
                    columns,
                    rows,
                    part,
                    even_nodes: diagonal && lattice.connectivity() == Connectivity::FourEight,
                    rule: SlideRule::new(repose, length, slab),
                });
            }
        }
    }
    families
}

/// Lets all sand that is too steep slide, and reports what slid.
///
/// `layers` hold the whole lattice. See the module for the scheme and what it guarantees.
pub(super) fn settle(
    lattice: &Lattice,
    settings: &AvalancheSettings,
    slab: f64,
    layers: &mut Layers<'_>,
    changes: &mut Changes,
) -> AvalancheCounts {
    let plane = Plane::new(lattice);
    let all = families(lattice, settings.repose(), slab);
    let families = all.len() as u32;
    let mut now = changes.start(&plane, all.len());
    let mut counts = AvalancheCounts::default();
    while !counts.settled && counts.sweeps < settings.most_sweeps {
        let before = counts.slides;
        let round = counts.sweeps;
        changes.start_round(round, now, families);
        for group in all.chunk_by(Family::shares_rows) {
            let sweep = Sweep { plane: &plane, group, round, now, families };
            let slid = sweep.run(layers, changes);
            counts.moved_m += slid.amount;
            counts.slides += slid.slides;
            now += group.len() as u32;
        }
        counts.sweeps += 1;
        counts.settled = counts.slides == before;
    }
    counts
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
        settle(lattice, &settings, slab, &mut layers, &mut Changes::default())
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
    fn following_changes_gives_the_bits_of_sweeping_everything() {
        let boundaries = [Boundary::Open, Boundary::Periodic];
        for connectivity in PLANES {
            for size in [[1, 9], [9, 1], [7, 5], [64, 6], [65, 7], [130, 31], [12, 128]] {
                for boundary in boundaries.iter().flat_map(|&x| boundaries.map(|y| [x, y])) {
                    let Ok(lattice) = Lattice::plane(size, 10.0, connectivity, boundary) else {
                        continue;
                    };
                    let (bed, start) = rough(&lattice, 3);
                    let [mut fast, mut plain] = [start.clone(), start];
                    let counts = run(&lattice, 0.25, &bed, &mut fast);
                    let settings = AvalancheSettings::default();
                    let rounds = reference::settle(&lattice, &settings, 0.25, &bed, &mut plain);
                    assert_eq!(bits(&fast), bits(&plain), "{lattice:?}");
                    assert_eq!(counts.sweeps, rounds);
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
