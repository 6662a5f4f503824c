//! Who gets how much of a node's water: three rules with one face.
//!
//! A rule looks at the levels around a node and says what each lower neighbour is to get. What it
//! decides fits one number, the *share*, from which giver and receiver work out the same gift.

mod average;
mod levelling;

pub use average::{UniformAverage, WeightedAverage};
pub use levelling::Levelling;

/// A rule that shares the water of a node among its lower neighbours.
pub trait Sharing: Sync {
    /// What a node decides.
    type Share: Copy + Send + Sync;

    /// The decision to keep everything.
    const NOTHING: Self::Share;

    /// Decides for a node with this `level` and `depth` of water, both in units, among neighbours
    /// with the levels `around`; also returns the sum of the gifts, at most `depth`.
    fn share(level: i64, depth: i64, around: &[i64]) -> (Self::Share, i64);

    /// What a neighbour at level `receiver` gets from a node at level `giver` that decided so.
    fn gift(share: Self::Share, giver: i64, receiver: i64) -> i64;
}
