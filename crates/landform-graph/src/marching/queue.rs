//! The nodes of a narrow band, earliest first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A node and when it is due; ordered so that the earliest, then the lowest, is greatest.
#[derive(Clone, Copy, Debug)]
struct Due {
    time: f64,
    node: u32,
}

impl Ord for Due {
    fn cmp(&self, other: &Self) -> Ordering {
        other.time.total_cmp(&self.time).then(other.node.cmp(&self.node))
    }
}

impl PartialOrd for Due {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Due {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Due {}

/// A queue by time, ties by node. A node whose time falls is pushed again; whoever pops
/// recognises and skips the entry that is out of date.
#[derive(Clone, Debug, Default)]
pub(super) struct TimeQueue {
    heap: BinaryHeap<Due>,
}

impl TimeQueue {
    pub fn clear(&mut self) {
        self.heap.clear();
    }

    /// Adds a node, whose index fits 32 bits as in every lattice.
    #[inline]
    pub fn push(&mut self, time: f64, node: usize) {
        self.heap.push(Due { time, node: node as u32 });
    }

    /// Takes the earliest node.
    #[inline]
    pub fn pop(&mut self) -> Option<(f64, usize)> {
        self.heap.pop().map(|due| (due.time, due.node as usize))
    }

    /// Takes all nodes in no particular order.
    pub fn drain(&mut self) -> impl Iterator<Item = usize> + '_ {
        self.heap.drain().map(|due| due.node as usize)
    }
}
