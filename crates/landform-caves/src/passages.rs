//! Passages: voxels so porous that they are counted as empty, and how they hang together.

use landform_graph::Lattice;

use crate::sparse::Sparse;

/// The connected systems of passages. They only grow; each is known by its first voxel, so that its
/// name does not hang on the order in which it grew.
///
/// Takes an eighth and a quarter of a byte a voxel, and 4 bytes where there are passages.
#[derive(Clone, Debug)]
pub struct Passages {
    /// A bit a voxel.
    open: Vec<u64>,
    /// For voxels of passages, one of the same system with a lower or the same number.
    parent: Sparse<u32>,
    voxels: usize,
}

impl Passages {
    /// The passages of rock: voxels of at least the porosity `passage`.
    pub fn new(lattice: &Lattice, porosity: &[f64], passage: f64) -> Self {
        let count = lattice.node_count();
        let open = vec![0; count.div_ceil(64)];
        let mut passages = Self { open, parent: Sparse::new(count), voxels: 0 };
        for node in (0..count).filter(|&node| porosity[node] >= passage) {
            passages.open(lattice, node);
        }
        passages
    }

    /// Number of voxels in passages.
    pub fn voxels(&self) -> usize {
        self.voxels
    }

    /// Whether a voxel is part of a passage.
    #[inline]
    pub fn contains(&self, node: usize) -> bool {
        self.open[node / 64] >> (node % 64) & 1 == 1
    }

    /// Adds a voxel and joins the systems beside it.
    pub fn open(&mut self, lattice: &Lattice, node: usize) {
        if self.contains(node) {
            return;
        }
        self.open[node / 64] |= 1 << (node % 64);
        *self.parent.get_mut(node) = node as u32;
        self.voxels += 1;
        for edge in lattice.neighbours(node) {
            if self.contains(edge.node) {
                let (one, other) = (self.first(node), self.first(edge.node));
                *self.parent.get_mut(one.max(other)) = one.min(other) as u32;
            }
        }
    }

    /// The first voxel of the system that a voxel belongs to; `None` in rock.
    pub fn system(&mut self, node: usize) -> Option<usize> {
        self.contains(node).then(|| self.first(node))
    }

    fn first(&mut self, mut node: usize) -> usize {
        loop {
            let above = self.parent.get(node) as usize;
            if above == node {
                return node;
            }
            let next = self.parent.get(above);
            *self.parent.get_mut(node) = next;
            node = next as usize;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, BreadthFirst, Connectivity, Reach};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn systems_are_those_that_a_search_finds(
            open in prop::collection::vec(any::<prop::sample::Index>(), 1..120),
        ) {
            let lattice =
                Lattice::volume([7, 6, 5], 1.0, Connectivity::Voxel26, [Boundary::Open; 3]).unwrap();
            let mut porosity = vec![0.1; 210];
            let mut grown = Passages::new(&lattice, &porosity, 0.35);
            for index in open {
                let node = index.index(210);
                porosity[node] = 0.4;
                grown.open(&lattice, node);
            }
            let mut afresh = Passages::new(&lattice, &porosity, 0.35);
            let mut search = BreadthFirst::new();
            for node in 0..210 {
                let filter = |_: usize, edge: &landform_graph::Edge| porosity[edge.node] >= 0.35;
                let reached = search.collect(&lattice, &[node], Reach::UNLIMITED, filter);
                let first = reached.iter().map(|visit| visit.node).min();
                let expected = first.filter(|_| porosity[node] >= 0.35);
                prop_assert_eq!(grown.system(node), expected);
                prop_assert_eq!(afresh.system(node), expected);
            }
            prop_assert_eq!(grown.voxels(), porosity.iter().filter(|p| **p >= 0.35).count());
        }
    }
}
