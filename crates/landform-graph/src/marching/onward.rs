//! Directions that lead on from where a front came from.

use crate::{Connectivity, Lattice};

/// The direction of a node that a front did not come to over an edge.
pub(super) const FROM_NOWHERE: u8 = u8::MAX;

/// For every direction, those that lead to nodes which are no neighbours of the node before.
///
/// A front that came from S to N need not look at what is a neighbour of both: where edges around N cost
/// their length times one rate, and no edge between its neighbours costs more, the way over N is the
/// longer by the inequality of triangles, and what S could do it has done. Of 26 neighbours 9, 15 or 19
/// remain for a front that came over a face, an edge or a corner.
#[derive(Clone, Debug, Default)]
pub(super) struct Onward {
    after: Vec<Vec<u8>>,
}

impl Onward {
    /// The directions of a lattice; none where nodes have different ones.
    pub(super) fn of(lattice: &Lattice) -> Self {
        if lattice.connectivity() == Connectivity::FourEight {
            return Self::default();
        }
        let steps: Vec<[i8; 3]> = lattice.stencil().iter().map(|edge| edge.step).collect();
        let sum = |a: [i8; 3], b: [i8; 3]| [0, 1, 2].map(|axis| a[axis] + b[axis]);
        let leads_on = |came: [i8; 3], step: [i8; 3]| {
            let from_before = sum(came, step);
            from_before != [0; 3] && !steps.contains(&from_before)
        };
        let after = |&came: &[i8; 3]| -> Vec<u8> {
            let directions = 0..steps.len() as u8;
            directions.filter(|&direction| leads_on(came, steps[usize::from(direction)])).collect()
        };
        Self { after: steps.iter().map(after).collect() }
    }

    /// Directions worth a look after a front came in a direction; `None` for all.
    #[inline]
    pub(super) fn after(&self, came: u8) -> Option<&[u8]> {
        self.after.get(usize::from(came)).map(Vec::as_slice)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Boundary::Open;

    #[test]
    fn fronts_look_ahead_only() {
        let counts = |lattice: Lattice| -> Vec<usize> {
            let onward = Onward::of(&lattice);
            (0..=26).filter_map(|came| onward.after(came)).map(<[u8]>::len).collect()
        };
        let volume = |kind| Lattice::volume([4; 3], 1.0, kind, [Open; 3]).unwrap();
        let expected = [vec![9; 6], vec![15; 12], vec![19; 8]].concat();
        assert_eq!(counts(volume(Connectivity::Voxel26)), expected);
        // Without diagonals all but the way back lead on.
        assert_eq!(counts(volume(Connectivity::Voxel6)), [5; 6]);
        let plane = |kind| Lattice::plane([4; 2], 1.0, kind, [Open; 2]).unwrap();
        assert_eq!(counts(plane(Connectivity::Eight)), [3, 3, 3, 3, 5, 5, 5, 5]);
        assert!(counts(plane(Connectivity::FourEight)).is_empty());
    }
}
