//! What is compared.

use landform::prelude::RandomStream;

/// Seed of the first cells.
pub const SEED: u64 = 1;

/// A model that every framework runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// The Game of Life on a torus: 1 where a cell lives.
    Life,
    /// A fire from the west edge through a forest with eight neighbours: 0 bare or burnt, 1 a
    /// tree, 2 a tree on fire.
    Fire,
}

impl Model {
    /// The first cells, those that Landform's processes draw.
    pub fn start(self, side: usize) -> Vec<u8> {
        let (name, share) = match self {
            Self::Life => ("life", 0.3),
            Self::Fire => ("forest", 0.6),
        };
        let random = RandomStream::new(SEED, name);
        let cell = |node: usize| {
            let there = u8::from(random.unit(0, node, 0) < share);
            if self == Self::Fire && node.is_multiple_of(side) { 2 * there } else { there }
        };
        (0..side * side).map(cell).collect()
    }

    /// Landform's processes: what they are, and how a scenario writes them.
    pub fn processes(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Self::Life => &[
                ("Landform, a field", "Life(alive_share: 0.3)"),
                ("Landform, agents", "LivingCells(alive_share: 0.3)"),
            ],
            Self::Fire => &[("Landform, agents", "ForestFire(tree_share: 0.6)")],
        }
    }

    /// Whether the edges are joined.
    pub fn wraps(self) -> bool {
        self == Self::Life
    }

    /// The next state of a cell, from its own and those of its neighbours.
    pub fn next(self, cell: u8, neighbours: impl Iterator<Item = u8>) -> u8 {
        match self {
            Self::Life => match (cell, neighbours.map(usize::from).sum()) {
                (1, 2) | (_, 3) => 1,
                _ => 0,
            },
            Self::Fire => match cell {
                1 if neighbours.into_iter().any(|other| other == 2) => 2,
                1 => 1,
                _ => 0,
            },
        }
    }

    /// The neighbours of a cell, as columns and rows.
    pub fn around(self, [x, y]: [usize; 2], side: usize) -> impl Iterator<Item = [usize; 2]> {
        const STEPS: [[isize; 2]; 8] =
            [[-1, -1], [0, -1], [1, -1], [-1, 0], [1, 0], [-1, 1], [0, 1], [1, 1]];
        STEPS.into_iter().filter_map(move |[dx, dy]| {
            let [x, y] = [x as isize + dx, y as isize + dy];
            let inside = |at: isize| (0..side as isize).contains(&at);
            let wrapped = [x, y].map(|at| at.rem_euclid(side as isize) as usize);
            (self.wraps() || (inside(x) && inside(y))).then_some(wrapped)
        })
    }
}

/// What a framework needed, and what it made.
pub struct Timed {
    /// Nanoseconds of each iteration.
    pub nanoseconds: Vec<f64>,
    /// The cells at the end.
    pub cells: Vec<u8>,
}

impl Timed {
    /// Prints the median of the iterations for each cell, and its ratio to `base`; returns it.
    pub fn report(mut self, name: &str, base: Option<f64>) -> f64 {
        self.nanoseconds.sort_by(f64::total_cmp);
        let median = self.nanoseconds[self.nanoseconds.len() / 2] / self.cells.len() as f64;
        let ratio = base.map_or(1.0, |base| median / base);
        println!("{name:<34} {median:>10.2} {ratio:>10.3}x");
        median
    }
}

/// Times `step` so many times; it works on one thread.
pub fn timed(steps: usize, mut step: impl FnMut()) -> Vec<f64> {
    let time = |_| {
        let start = cpu_time::ThreadTime::now();
        step();
        start.elapsed().as_nanos() as f64
    };
    (0..steps).map(time).collect()
}
