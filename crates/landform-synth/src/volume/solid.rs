//! What all nodes of a volume have in common once they are made ready.

use std::fmt::Debug;

/// A place in metres east, north and up.
pub(super) type Place3 = [f64; 3];

/// A node with its children: a function of the place that is negative inside, 0 at the surface and
/// positive outside.
pub(super) trait Solid: Debug + Send + Sync {
    /// The value at a place.
    fn value(&self, place: Place3) -> f64;

    /// Largest change of the value a metre, its Lipschitz constant: the value over it is no more
    /// than the distance to the surface.
    fn slope(&self) -> f64;
}

pub(super) fn difference(a: Place3, b: Place3) -> Place3 {
    [0, 1, 2].map(|axis| a[axis] - b[axis])
}

pub(super) fn dot(a: Place3, b: Place3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn length(a: Place3) -> f64 {
    dot(a, a).sqrt()
}
