//! Weakening around events.

use landform_graph::Lattice;

use super::Wear;

/// How much of an event's weakening reaches the nodes around it: all at its own node, and in
/// proportion to the distance less and less up to the radius (thesis, section 4.2.3).
#[derive(Clone, Debug)]
pub(super) struct WeakeningDisc {
    steps: Vec<([isize; 2], f64)>,
}

impl WeakeningDisc {
    /// The disc of a wear; empty without one.
    pub(super) fn new(lattice: &Lattice, wear: Option<&Wear>) -> Self {
        let radius = wear.map_or(0.0, |wear| wear.radius_m / lattice.spacing());
        let reach = radius.ceil() as isize;
        // On a short periodic axis a node is met once, by its nearest image.
        let range = |axis: usize| {
            let nodes = lattice.size()[axis] as isize;
            match lattice.is_periodic(axis) {
                true => -reach.min((nodes - 1) / 2)..=reach.min(nodes / 2),
                false => -reach..=reach,
            }
        };
        let steps = range(1).flat_map(|south| range(0).map(move |east| [east, south]));
        let falloff = |step: [isize; 2]| {
            let distance = (step[0] as f64).hypot(step[1] as f64);
            (step, 1.0 - distance / radius)
        };
        Self { steps: steps.map(falloff).filter(|&(_, falloff)| falloff > 0.0).collect() }
    }

    /// Whether nothing is weakened.
    pub(super) fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// Names the nodes around `at` and the share of the weakening that reaches them.
    pub(super) fn each(
        &self,
        lattice: &Lattice,
        at: [usize; 2],
        mut visit: impl FnMut(usize, f64),
    ) {
        for &([east, south], falloff) in &self.steps {
            if let Some(node) = lattice.offset([at[0], at[1], 0], [east, south, 0]) {
                visit(node, falloff);
            }
        }
    }
}
