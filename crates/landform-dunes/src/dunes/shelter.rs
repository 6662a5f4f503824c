//! Shelter from the wind: the question that transport asks, and nothing about the answer.

use landform_graph::Lattice;

use super::WindLine;

/// What a shelter is worked out from: the state before the slabs of a sub-step move.
#[derive(Clone, Copy, Debug)]
pub struct Exposure<'a> {
    /// The lattice.
    pub lattice: &'a Lattice,
    /// Height of the hard bed at each node, metres.
    pub bed: &'a [f64],
    /// Thickness of sand at each node, metres.
    pub sand: &'a [f64],
    /// Height of the surface, bed plus sand, at each node, metres.
    pub surface: &'a [f64],
    /// At least the difference between the highest and the lowest surface, metres.
    pub relief_m: f64,
    /// The wind that blows now.
    pub wind: &'a WindLine,
    /// Height of a slab, metres.
    pub slab_m: f64,
}

/// A principle that decides which nodes the wind cannot reach. Slabs are not lifted there, and
/// slabs that land there stay.
pub trait Shelter: Send {
    /// Sets `sheltered` for every node (in node order, one value a node).
    ///
    /// Called before every sub-step, so four times a tick, with the state of that moment.
    /// The answer must depend on `exposure` alone and not on threads.
    fn shelter(&mut self, exposure: &Exposure<'_>, sheltered: &mut [bool]);
}

/// No shelter anywhere: transport alone.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unsheltered;

impl Shelter for Unsheltered {
    fn shelter(&mut self, _: &Exposure<'_>, sheltered: &mut [bool]) {
        sheltered.fill(false);
    }
}
