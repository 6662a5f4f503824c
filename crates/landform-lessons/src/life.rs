//! A field and a kernel: the Game of Life (Gardner 1970, "Mathematical Games", Scientific
//! American 223).

use bevy_ecs::system::Local;
use landform_sim::prelude::*;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Cells of the Game of Life.
pub struct Alive;

impl NodeField for Alive {
    type Value = u8;
    const NAME: &'static str = "alive";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "1 where a cell lives, 0 elsewhere";
    const LEAST: f64 = 0.0;
}

/// The Game of Life on a field, as a lesson: every node counts its eight neighbours.
///
/// A living cell lives on with two or three living neighbours; a cell is born among exactly
/// three. Nothing is conserved. `LivingCells` is the same model with agents.
#[derive(Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Life {
    /// Share of the cells that live at the beginning, drawn at random; 0 leaves the field
    /// `alive` as the initial conditions made it.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub alive_share: f64,
}

impl Default for Life {
    fn default() -> Self {
        Self { alive_share: 0.3 }
    }
}

impl Process for Life {
    const NAME: &'static str = "Life";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Alive>().scratch(1);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        needs_eight(lattice)
    }
}

/// Refuses lattices on which the Game of Life would be another game.
pub(crate) fn needs_eight(lattice: &Lattice) -> Result<(), Problem> {
    if lattice.connectivity() == Connectivity::Eight {
        return Ok(());
    }
    let message = format!("the domain's nodes are joined by {:?}", lattice.connectivity());
    Err(Problem::new("", message, "eight neighbours a node")
        .help("set `connectivity: Eight` in the domain"))
}

impl Plugin for Life {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Begin, sow).add_systems(Iterate, live);
    }
}

/// Makes the first generation.
fn sow(settings: Res<Settings<Life>>, clock: Res<Clock>, mut alive: FieldMut<Alive>) {
    let random = RandomStream::new(clock.seed, "life");
    let lives = |node| u8::from(random.unit(0, node, 0) < settings.alive_share);
    for (node, cell) in alive.values_mut().iter_mut().enumerate() {
        *cell = if settings.alive_share > 0.0 { lives(node) } else { u8::from(*cell > 0) };
    }
}

/// One generation.
fn live(space: Res<Space>, mut alive: FieldMut<Alive>, mut work: Local<Vec<u8>>) {
    generation(&space, alive.values_mut(), &mut work);
}

/// The rule: `all` counts the living cells of the block of nine, `alive` is the middle one.
/// Without branches, so that the compiler can treat many cells at once.
#[inline]
fn lives_on(all: u8, alive: u8) -> u8 {
    u8::from(all == 3) | (u8::from(all == 4) & alive)
}

/// Advances `cells` (0 or 1, one a node) by a generation, as the rule reads.
pub fn generation_reference(lattice: &Lattice, cells: &mut [u8]) {
    let before = cells.to_vec();
    for (node, cell) in cells.iter_mut().enumerate() {
        let neighbours: u8 = lattice.neighbours(node).map(|edge| before[edge.node]).sum();
        *cell = lives_on(neighbours + before[node], before[node]);
    }
}

/// Rows that one thread treats in a go.
const BAND: usize = 64;

/// As [`generation_reference`] at the speed of memory: in place, by windows of three rows.
///
/// `lattice` is a plane with eight neighbours; `work` is memory to use again. Bands of rows
/// first copy the rows beside them, which other threads change.
pub fn generation(lattice: &Lattice, cells: &mut [u8], work: &mut Vec<u8>) {
    let (width, height) = (lattice.width(), lattice.height());
    work.clear();
    work.resize(height.div_ceil(BAND) * 4 * width + 2 * height.div_ceil(BAND), 0);
    let mut bands: Vec<_> = work.chunks_exact_mut(4 * width + 2).collect();
    let row_at = |row: isize| match row.rem_euclid(height as isize) {
        inside if inside == row || lattice.is_periodic(1) => Some(inside as usize * width),
        _ => None,
    };
    for (band, work) in bands.iter_mut().enumerate() {
        let first = (band * BAND) as isize;
        let last = (first + BAND as isize).min(height as isize) - 1;
        for (beside, copy) in [first - 1, last + 1].into_iter().zip(work.chunks_mut(width)) {
            if let Some(start) = row_at(beside) {
                copy.copy_from_slice(&cells[start..][..width]);
            }
        }
    }
    let wraps = lattice.is_periodic(0);
    let work = bands.into_par_iter();
    cells.par_chunks_mut(BAND * width).zip(work).for_each(|(cells, work)| {
        let (above, work) = work.split_at_mut(width);
        let (below, work) = work.split_at_mut(width);
        let (old, sums) = work.split_at_mut(width);
        advance(cells, [above, below, old], sums, wraps);
    });
}

/// Advances a band of rows. `memory` holds the row above, the row below and room for one;
/// `sums` has room for two more than a row.
fn advance(cells: &mut [u8], memory: [&mut [u8]; 3], sums: &mut [u8], wraps: bool) {
    let [mut above, below, mut old] = memory;
    let width = above.len();
    let rows = cells.len() / width;
    for row in 0..rows {
        let (here, rest) = cells[row * width..].split_at_mut(width);
        let next = if row + 1 < rows { &rest[..width] } else { &*below };
        old.copy_from_slice(here);
        let columns = above.iter().zip(&*old).zip(next);
        for (sum, ((above, here), below)) in sums[1..].iter_mut().zip(columns) {
            *sum = above + here + below;
        }
        sums[0] = if wraps { sums[width] } else { 0 };
        sums[width + 1] = if wraps { sums[1] } else { 0 };
        for (cell, block) in here.iter_mut().zip(sums.windows(3)) {
            *cell = lives_on(block[0] + block[1] + block[2], *cell);
        }
        std::mem::swap(&mut above, &mut old);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn plane(width: usize, height: usize, boundary: Boundary) -> Lattice {
        Lattice::plane([width, height], 1.0, Connectivity::Eight, [boundary; 2]).expect("a plane")
    }

    proptest! {
        #[test]
        fn fast_and_readable_kernels_agree(
            (width, height) in (3..40_usize, 3..150_usize), periodic: bool, seed: u64,
        ) {
            let boundary = if periodic { Boundary::Periodic } else { Boundary::Open };
            let lattice = plane(width, height, boundary);
            let random = RandomStream::new(seed, "test");
            let mut cells: Vec<u8> = (0..lattice.node_count())
                .map(|node| u8::from(random.unit(0, node, 0) < 0.4))
                .collect();
            let (mut expected, mut work) = (cells.clone(), Vec::new());
            for _ in 0..3 {
                generation(&lattice, &mut cells, &mut work);
                generation_reference(&lattice, &mut expected);
                prop_assert_eq!(&cells, &expected);
            }
        }
    }

    /// A glider comes back to its shape one node further along both axes after four generations.
    #[test]
    fn a_glider_glides() {
        let lattice = plane(9, 9, Boundary::Periodic);
        let at = |shift: usize| {
            let mut cells = vec![0; 81];
            for [x, y] in [[1, 0], [2, 1], [0, 2], [1, 2], [2, 2]] {
                cells[lattice.node([(x + shift) % 9, (y + shift) % 9, 0])] = 1;
            }
            cells
        };
        let (mut cells, mut work) = (at(0), Vec::new());
        for _ in 0..4 * 9 {
            generation(&lattice, &mut cells, &mut work);
        }
        assert_eq!(cells, at(9));
        (0..4).for_each(|_| generation(&lattice, &mut cells, &mut work));
        assert_eq!(cells, at(1));
    }
}
