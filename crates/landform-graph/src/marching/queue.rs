//! The nodes of a narrow band, earliest first.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A queue by time, ties by node. A node whose time falls is pushed again; whoever pops
/// recognises and skips the entry that is out of date.
#[derive(Clone, Debug, Default)]
pub(super) struct TimeQueue {
    /// Times as integers of the same order, which compare faster, with nodes.
    heap: BinaryHeap<Reverse<(i64, u32)>>,
}

/// An integer for a time that is a number: greater for later times. Its own inverse on bits.
#[inline]
fn in_order(bits: i64) -> i64 {
    // Of negative floats, greater bits mean lower numbers.
    bits ^ (((bits >> 63) as u64) >> 1) as i64
}

impl TimeQueue {
    /// Adds a node, whose index fits 32 bits as in every lattice.
    #[inline]
    pub fn push(&mut self, time: f64, node: usize) {
        // Adding 0 makes one zero of two.
        self.heap.push(Reverse((in_order((time + 0.0).to_bits() as i64), node as u32)));
    }

    /// Takes the earliest node.
    #[inline]
    pub fn pop(&mut self) -> Option<(f64, usize)> {
        let Reverse((key, node)) = self.heap.pop()?;
        Some((f64::from_bits(in_order(key) as u64), node as usize))
    }

    /// Takes all nodes in no particular order, some perhaps more than once.
    pub fn drain(&mut self) -> impl Iterator<Item = usize> + '_ {
        self.heap.drain().map(|Reverse((_, node))| node as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn nodes_leave_by_time_then_by_number(
            mut due in prop::collection::vec((-2..3_i32, 0..50_usize), 0..100),
        ) {
            let mut queue = TimeQueue::default();
            for &(time, node) in &due {
                queue.push(f64::from(time) * -1e-3, node);
            }
            due.sort_by_key(|&(time, node)| (-time, node));
            for (time, node) in due {
                prop_assert_eq!(queue.pop(), Some((f64::from(time) * -1e-3, node)));
            }
            prop_assert_eq!(queue.pop(), None);
        }
    }
}
