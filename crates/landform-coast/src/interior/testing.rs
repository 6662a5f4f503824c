//! Level sets for tests.

use landform_graph::{Boundary, Connectivity, Lattice};

use landform_sim::random::RandomStream;

use super::{FrontFields, LevelSets};

/// Level sets of a cone: rings at equal distances.
pub(super) struct Cone {
    pub lattice: Lattice,
    band: Vec<u32>,
    on_level: Vec<u8>,
}

impl Cone {
    /// A square of `side` nodes 1 m apart, with level set 0 outside the inscribed circle and rings
    /// `distance` nodes apart within it; the innermost ring holds a summit.
    pub fn new(side: usize, distance: u32) -> Self {
        let lattice =
            Lattice::plane([side, side], 1.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
        let centre = (side / 2) as f64;
        let depth = |node: usize| {
            let place = lattice.position(node);
            let [x, y] = [place.x, place.y.abs()].map(|coordinate| coordinate - centre);
            (centre - x.hypot(y)).max(0.0)
        };
        let rings: Vec<u32> = (0..side * side).map(|node| depth(node) as u32 / distance).collect();
        // The outermost nodes of each ring lie on its level set.
        let outermost =
            |node: usize| lattice.neighbours(node).any(|edge| rings[edge.node] < rings[node]);
        let on_level =
            (0..side * side).map(|node| u8::from(rings[node] == 0 || outermost(node))).collect();
        Self { band: rings, on_level, lattice }
    }

    pub fn levels(&self) -> LevelSets<'_> {
        LevelSets { band: &self.band, on_level: &self.on_level, interval_m: 10.0 }
    }
}

/// The fields of fronts on random rock, with discs of sea.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Terrain {
    pub land: Vec<u8>,
    resistance: Vec<f64>,
    pub band: Vec<u32>,
    pub on_level: Vec<u8>,
}

impl Terrain {
    /// Up to three discs of sea, each of up to three spacings.
    pub fn new(lattice: &Lattice, seed: u64) -> Self {
        let random = RandomStream::new(seed, "terrain");
        let nodes = lattice.node_count();
        let middles = 1 + (3.0 * random.unit(0, 0, 0)) as u64;
        let discs: Vec<_> = (1..=middles)
            .map(|disc| {
                let node = (nodes as f64 * random.unit(disc, 0, 0)) as usize;
                (lattice.position(node), 3.0 * lattice.spacing() * random.unit(disc, 1, 0))
            })
            .collect();
        let is_sea = |node: usize| {
            let place = lattice.position(node);
            discs.iter().any(|(middle, radius)| middle.distance(place) <= *radius)
        };
        Self {
            land: (0..nodes).map(|node| u8::from(!is_sea(node))).collect(),
            resistance: (0..nodes).map(|node| random.unit(9, node, 0)).collect(),
            band: vec![7; nodes],
            on_level: vec![7; nodes],
        }
    }

    pub fn fields(&mut self) -> FrontFields<'_> {
        let Self { land, resistance, band, on_level } = self;
        FrontFields { land, resistance, band, on_level }
    }
}

/// Level sets that a front leaves which advances at random.
pub(super) fn random_levels(size: [usize; 2], seed: u64) -> (Lattice, Vec<u32>, Vec<u8>) {
    let lattice = Lattice::plane(size, 1.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
    let nodes = lattice.node_count();
    let (mut band, mut on_level) = (vec![0; nodes], vec![0; nodes]);
    let mut eroded: Vec<bool> = (0..nodes).map(|node| node % size[0] == 0).collect();
    on_level[..].iter_mut().zip(&eroded).for_each(|(on, eroded)| *on = u8::from(*eroded));
    let mut state = seed;
    for level in 0.. {
        for round in 0..5 {
            let coast: Vec<usize> = (0..nodes)
                .filter(|&node| {
                    !eroded[node] && lattice.neighbours(node).any(|edge| eroded[edge.node])
                })
                .collect();
            if coast.is_empty() {
                return (lattice, band, on_level);
            }
            for node in coast {
                state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
                let marked = round == 4;
                if marked || state >> 63 == 1 {
                    eroded[node] = true;
                    band[node] = level + u32::from(marked);
                    on_level[node] = u8::from(marked);
                }
            }
        }
    }
    unreachable!("every round of marking erodes the coast")
}
