//! What noise has to know of the ground that it covers.

use landform_graph::Lattice;

/// The finest detail that shows, and where the ground closes on itself.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    /// Distance of nodes in metres: shorter waves are left out.
    pub spacing: f64,
    /// Length in metres after which an axis repeats; none where it is open.
    pub period: [Option<f64>; 2],
}

impl Frame {
    /// The frame of a lattice.
    pub fn of(lattice: &Lattice) -> Self {
        let period = [0, 1].map(|axis| {
            let extent = lattice.size()[axis] as f64 * lattice.spacing();
            lattice.is_periodic(axis).then_some(extent)
        });
        Self { spacing: lattice.spacing(), period }
    }

    /// Ground without borders.
    pub fn open(spacing: f64) -> Self {
        Self { spacing, period: [None; 2] }
    }
}
