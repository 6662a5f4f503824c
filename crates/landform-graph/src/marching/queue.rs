//! The nodes of a narrow band, earliest first.

/// Children of an entry of the heap: four lie in one or two cache lines.
const CHILDREN: usize = 4;

/// A queue by time, ties by node. A node whose time falls is pushed again; whoever pops
/// recognises and skips the entry that is out of date.
#[derive(Clone, Debug, Default)]
pub(super) struct TimeQueue {
    /// Times as integers of the same order, with nodes; no child comes before its parent.
    heap: Vec<(i64, u32)>,
}

/// An integer for a time that is a number: greater for later times. Its own inverse on bits.
#[inline]
fn in_order(bits: i64) -> i64 {
    // Of negative floats, greater bits mean lower numbers.
    bits ^ (((bits >> 63) as u64) >> 1) as i64
}

impl TimeQueue {
    pub fn clear(&mut self) {
        self.heap.clear();
    }

    /// Adds a node, whose index fits 32 bits as in every lattice.
    #[inline]
    pub fn push(&mut self, time: f64, node: usize) {
        // Adding 0 makes one zero of two.
        let entry = (in_order((time + 0.0).to_bits() as i64), node as u32);
        let mut hole = self.heap.len();
        self.heap.push(entry);
        while hole > 0 {
            let parent = (hole - 1) / CHILDREN;
            if self.heap[parent] <= entry {
                break;
            }
            self.heap[hole] = self.heap[parent];
            hole = parent;
        }
        self.heap[hole] = entry;
    }

    /// Takes the earliest node.
    #[inline]
    pub fn pop(&mut self) -> Option<(f64, usize)> {
        let last = self.heap.pop()?;
        let (key, node) = self.heap.first().copied().unwrap_or(last);
        self.sink(last);
        Some((f64::from_bits(in_order(key) as u64), node as usize))
    }

    /// Takes all nodes in no particular order, some perhaps more than once.
    pub fn drain(&mut self) -> impl Iterator<Item = usize> + '_ {
        self.heap.drain(..).map(|(_, node)| node as usize)
    }

    /// Puts an entry in place of the first.
    fn sink(&mut self, entry: (i64, u32)) {
        let mut hole = 0;
        loop {
            let first = hole * CHILDREN + 1;
            let end = self.heap.len().min(first + CHILDREN);
            let Some(least) = (first..end).min_by_key(|&child| self.heap[child]) else { break };
            if self.heap[least] >= entry {
                break;
            }
            self.heap[hole] = self.heap[least];
            hole = least;
        }
        if let Some(place) = self.heap.get_mut(hole) {
            *place = entry;
        }
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
