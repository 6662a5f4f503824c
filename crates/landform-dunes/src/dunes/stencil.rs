//! The edges of a node along which sand can slide, and how much of it does.

use landform_graph::{Connectivity, Lattice};

use super::avalanche::Layers;

/// Slope above repose (in the tangent) that counts as rounding.
pub(super) const TOLERANCE: f64 = 1e-11;

/// Columns and rows to the neighbours of a node: east, north, west, south, then the diagonals.
pub(super) const STEPS: [[isize; 2]; 8] =
    [[1, 0], [0, -1], [-1, 0], [0, 1], [1, -1], [-1, -1], [-1, 1], [1, 1]];

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

    /// Lets sand slide down a step of `step` metres from node `upper` to node `lower`, which
    /// must be above the trigger; gives the thickness that slid.
    #[inline]
    pub fn slide(&self, layers: &mut Layers<'_>, upper: usize, lower: usize, step: f64) -> f64 {
        let excess = step - self.stable;
        let wanted = match excess <= 2.0 * self.slab {
            true => self.slab,
            false => (excess / (2.0 * self.slab)).ceil() * self.slab,
        };
        let amount = wanted.min(layers.sand[upper]);
        for (node, change) in [(upper, -amount), (lower, amount)] {
            layers.sand[node] += change;
            layers.surface[node] = layers.bed[node] + layers.sand[node];
        }
        amount
    }
}

/// The edges of the nodes of a lattice with at most `N` neighbours, 4 or 8: `STEPS[..N]`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stencil<const N: usize> {
    /// Rules of straight and diagonal edges.
    rules: [SlideRule; 2],
    /// One over the length of the edges, per metre.
    per_length: [f64; N],
    /// Tangent of the slope above which sand slides.
    steepest: f64,
    /// Whether only nodes whose column and row add to an even number have diagonals.
    pub alternate: bool,
}

impl<const N: usize> Stencil<N> {
    /// The edges of a lattice where sand rests at slopes of `repose` (tangent).
    pub fn new(lattice: &Lattice, repose: f64, slab: f64) -> Self {
        let [straight, diagonal] = [[1, 0, 0], [1, 1, 0]].map(|step| lattice.step_length(step));
        let lengths: [f64; N] = std::array::from_fn(|k| if k < 4 { straight } else { diagonal });
        Self {
            rules: [straight, diagonal].map(|length| SlideRule::new(repose, length, slab)),
            per_length: lengths.map(|length| 1.0 / length),
            steepest: repose + TOLERANCE,
            alternate: lattice.connectivity() == Connectivity::FourEight,
        }
    }

    /// The rule of edges in direction `k` of [`STEPS`].
    #[inline]
    pub fn rule(&self, k: usize) -> &SlideRule {
        &self.rules[k / 4]
    }

    /// The direction of the steepest of `falls` (metres down to each neighbour), if sand
    /// slides there. Where several are equally steep, the first from direction `turn` on.
    #[inline]
    pub fn steepest(&self, falls: &[f64; N], turn: usize) -> Option<usize> {
        let slopes: [f64; N] = std::array::from_fn(|k| falls[k] * self.per_length[k]);
        let steepest = slopes.iter().fold(self.steepest, |a, &b| if b > a { b } else { a });
        if steepest <= self.steepest {
            return None;
        }
        let is_steepest = |k: usize| u32::from(slopes[k] == steepest) << k;
        let all = (0..N).fold(0, |all, k| all | is_steepest(k));
        let turned = all >> turn | all << (N - turn);
        Some((turned.trailing_zeros() as usize + turn) % N)
    }

    /// Whether sand slides along any edge, up or down.
    #[inline]
    pub fn is_steep(&self, falls: &[f64; N]) -> bool {
        let is_steep = |k: usize| (falls[k] * self.per_length[k]).abs() > self.steepest;
        (0..N).fold(false, |any, k| any | is_steep(k))
    }

    /// Whether sand slides down to a neighbour, and a bit for each that it slides down from.
    pub fn steep(&self, falls: &[f64; N]) -> (bool, u32) {
        let slope = |k: usize| falls[k] * self.per_length[k];
        let down = (0..N).any(|k| slope(k) > self.steepest);
        let up = |k: usize| u32::from(-slope(k) > self.steepest) << k;
        (down, (0..N).fold(0, |all, k| all | up(k)))
    }
}

/// The direction that a node looks at first among equally steep ones. It varies from node to
/// node, so that no direction is preferred.
#[inline]
pub(super) fn first_look(column: usize, row: usize) -> usize {
    let mixed = (column as u32).wrapping_mul(0x9E37_79B1) ^ (row as u32).wrapping_mul(0x85EB_CA77);
    (mixed.wrapping_mul(0xC2B2_AE3D) >> 29) as usize
}
