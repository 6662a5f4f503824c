//! Sand that enters over open borders.

use landform_graph::Lattice;
use landform_sim::random::{RandomStream, unit};

use super::plane::Plane;
use super::transport::{Flight, Landing, Luck, SUB_STEPS, SubStep};
use super::{TransportCounts, TransportSettings, WindLine};

/// A supply of slabs from upwind.
///
/// Each slab starts its flight from a random node of a strip along the border that the wind blows in over, as
/// wide as the first hop, so that it first lands on a node that a slab from
/// outside could reach. Where two borders lie upwind, they share the slabs as
/// the wind crosses them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Feed {
    plane: Plane,
    slabs_per_tick: f64,
    place: RandomStream,
    land: RandomStream,
}

impl Feed {
    /// The supply of a lattice.
    pub fn new(lattice: &Lattice, settings: &TransportSettings, seed: u64) -> Self {
        Self {
            plane: Plane::new(lattice),
            slabs_per_tick: settings.feed_slabs_per_tick,
            place: RandomStream::new(seed, "dunes feed place"),
            land: RandomStream::new(seed, "dunes feed land"),
        }
    }

    /// Slabs of a sub-step: their running total follows the rate.
    fn slabs(&self, step: &SubStep) -> u64 {
        let passed = step.iteration as f64 * f64::from(SUB_STEPS) + f64::from(step.number);
        let rate = self.slabs_per_tick / f64::from(SUB_STEPS);
        ((passed + 1.0) * rate).floor() as u64 - (passed * rate).floor() as u64
    }

    /// Share of the slabs that enter over the western or eastern border, `None` when no
    /// upwind border is open.
    fn share_of_sides(&self, wind: &WindLine) -> Option<f64> {
        let open = |wraps: bool| if wraps { 0.0 } else { 1.0 };
        let across = |component: f64| if component.abs() < 1e-12 { 0.0 } else { component.abs() };
        let Plane { width, height, wraps_columns, wraps_rows } = self.plane;
        let sides = open(wraps_columns) * across(wind.angle().cos()) * height as f64;
        let ends = open(wraps_rows) * across(wind.angle().sin()) * width as f64;
        (sides + ends > 0.0).then(|| sides / (sides + ends))
    }

    /// Lets the slabs of a sub-step enter, fly and come down.
    pub fn enter(
        &self,
        step: &SubStep,
        wind: &WindLine,
        flight: &Flight,
        ground: &[u8],
        sand: &mut [f64],
    ) -> TransportCounts {
        let mut counts = TransportCounts::default();
        let (slabs, Some(sides)) = (self.slabs(step), self.share_of_sides(wind)) else {
            return counts;
        };
        counts.fed = slabs;
        for slab in 0..slabs {
            let number = (slab * u64::from(SUB_STEPS)) as usize + step.number as usize;
            let words = self.place.block(step.iteration, number, 0);
            let start = self.start(sides, wind, flight.reach(), words.map(unit));
            let luck = Luck::new(self.land, step.iteration, number);
            match flight.enter(start, ground, &luck, &mut counts) {
                Landing::Node(node) => sand[node] += step.slab,
                Landing::Left(border) => counts.left[border] += 1,
            }
        }
        counts
    }

    /// Column and row where a slab first comes down.
    fn start(
        &self,
        sides: f64,
        wind: &WindLine,
        [columns, rows]: [usize; 2],
        chances: [f64; 4],
    ) -> [usize; 2] {
        let Plane { width, height, .. } = self.plane;
        let pick = |chance: f64, count: usize| (chance * count as f64) as usize;
        let from_start = |place: usize, size: usize, forward: bool| {
            if forward { place } else { size - 1 - place }
        };
        if chances[0] < sides {
            let depth = pick(chances[1], columns.clamp(1, width));
            [from_start(depth, width, wind.angle().cos() > 0.0), pick(chances[2], height)]
        } else {
            let depth = pick(chances[1], rows.clamp(1, height));
            [pick(chances[2], width), from_start(depth, height, wind.angle().sin() < 0.0)]
        }
    }
}
