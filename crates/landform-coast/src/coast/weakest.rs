//! The weakest nodes of a coast first.

use super::marks::Marks;

/// Shelves between no strength and the greatest force.
const SHELVES: usize = 1024;

/// Coast nodes on shelves by their strength, so that those below a force are found without a look
/// at most others.
///
/// Every change of a strength is noted; what was noted of a node before stays on its shelf until
/// that is looked through, and is passed over then.
///
/// Cost: constant a change; a look through one shelf, and through those below it, a search.
#[derive(Clone, Debug)]
pub(super) struct Weakest {
    /// The greatest force, which no node beyond is below.
    most: f64,
    shelves: Vec<Vec<u32>>,
}

impl Weakest {
    /// No nodes; `most` is the greatest force to come.
    pub(super) fn new(most: f64) -> Self {
        Self { most, shelves: vec![Vec::new(); SHELVES] }
    }

    /// Notes the strength of a node.
    pub(super) fn note(&mut self, node: usize, strength: f64) {
        // What is no number is below no force.
        if strength < self.most {
            let shelf = self.shelf(strength);
            self.shelves[shelf].push(node as u32);
        }
    }

    /// The shelf of a strength or force up to the greatest force: never lower for a greater one.
    fn shelf(&self, strength: f64) -> usize {
        ((strength / self.most * SHELVES as f64) as usize).min(SHELVES - 1)
    }

    /// Moves the coast nodes that are weaker than `force` to `weak`, some of them twice.
    pub(super) fn take_below(&mut self, force: f64, marks: &Marks, weak: &mut Vec<u32>) {
        let strength = |node: u32| marks.slot(node as usize).map(|slot| marks.strengths[slot]);
        let is_weak = |node: &u32| strength(*node).is_some_and(|strength| strength < force);
        let last = self.shelf(force);
        for shelf in &mut self.shelves[..last] {
            weak.extend(shelf.drain(..).filter(is_weak));
        }
        let mut shelf = std::mem::take(&mut self.shelves[last]);
        weak.extend(shelf.iter().copied().filter(is_weak));
        let stays = |&strength: &f64| strength >= force && self.shelf(strength) == last;
        shelf.retain(|&node| strength(node).is_some_and(|strength| stays(&strength)));
        self.shelves[last] = shelf;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_nodes_below_a_force_are_found(
            changes in proptest::collection::vec((0_usize..20, 0_u8..60), 1..80),
            forces in proptest::collection::vec(0_u8..50, 1..10),
        ) {
            let mut marks = Marks::new(20);
            let mut weakest = Weakest::new(0.5);
            for (turn, changes) in changes.chunks(10).enumerate() {
                for &(node, strength) in changes {
                    // A coast may hold what is no number; it stands.
                    let strength = if strength == 7 { f64::NAN } else { f64::from(strength) };
                    // Many of these share a shelf.
                    let strength = 0.3 + 1e-5 * strength;
                    marks.set(node, 1.0, strength);
                    weakest.note(node, strength);
                }
                let force = 0.3 + 1e-5 * f64::from(forces[turn % forces.len()]);
                let mut weak = Vec::new();
                weakest.take_below(force, &marks, &mut weak);
                weak.sort_unstable();
                weak.dedup();
                let all = (0..20).filter(|&node| {
                    marks.slot(node).is_some_and(|slot| marks.strengths[slot] < force)
                });
                prop_assert_eq!(&weak, &all.map(|node| node as u32).collect::<Vec<_>>());
                weak.iter().for_each(|&node| { marks.remove(node as usize); });
            }
        }
    }
}
