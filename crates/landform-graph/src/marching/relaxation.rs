//! Listing 5.2 with a cost an edge: the greatest field below limits, at full speed.

use super::onward::{FROM_NOWHERE, Onward};
use super::{MarchError, check_length};
use crate::{Edge, Lattice};

/// Buckets that are kept at a time; later values wait together.
const BUCKETS: usize = 64;

/// Lowers a field until no value exceeds that of a neighbour by more than the cost of the
/// edge between them (thesis, listing 5.2: pressure that rises by at most a slope a metre).
///
/// What it computes: the greatest field `p` with `p <= p0` and `p(N) <= p(S) + cost(S, N)` for
/// every edge that leads out of a node reached from the starts. There is one such field, and
/// floating-point addition is monotone, so the result is the same, bit for bit, in whatever
/// order nodes are visited; [`super::Front`] with the update of listing 5.2 gives it too.
///
/// Scheme: nodes wait in buckets of values (Dial 1969; delta-stepping, Meyer and Sanders
/// 2003). The nodes of the lowest bucket are relaxed together, in node order, which visits
/// memory nearly in sequence and needs no heap.
///
/// Cost: that of the nodes whose values fall, each visited little more than once where costs
/// vary by a few times; nothing else is touched, so that a local change costs what it
/// reaches, and nothing is allocated once the memory fits the front. Where some costs are
/// thousands of times smaller than `width`, nodes of one bucket are visited several times, at
/// no change of the result.
///
/// Limits: costs must not depend on the values that are relaxed, and when a cost rises the
/// values that rested on it do not: reset them before relaxing again from around them.
#[derive(Clone, Debug)]
pub struct Relaxation {
    buckets: Vec<Vec<u32>>,
    /// Nodes whose values lie beyond the buckets.
    far: Vec<u32>,
    /// Nodes of the bucket that is being relaxed.
    frontier: Vec<u32>,
    /// Value at which bucket 0 begins.
    base: f64,
    /// Reciprocal of the range of values in a bucket.
    per_width: f64,
    /// Direction in which each node was lowered last, where that matters.
    came: Vec<u8>,
}

impl Default for Relaxation {
    fn default() -> Self {
        Self {
            buckets: vec![Vec::new(); BUCKETS],
            far: Vec::new(),
            frontier: Vec::new(),
            base: 0.0,
            per_width: 1.0,
            came: Vec::new(),
        }
    }
}

impl Relaxation {
    /// Memory for relaxations; it grows with the width of the front.
    pub fn new() -> Self {
        Self::default()
    }

    /// Relaxes `values` (one a node) outwards from `starts`, the nodes that were lowered.
    /// Returns the number of times that a node was relaxed.
    ///
    /// `cost(from, edge)` is the most by which the value at `edge.node` may exceed that at
    /// `from`: 0 or more, infinite for an edge that sets no limit. `width` is the range of
    /// values in a bucket: any gives the same result, about twice a typical cost is fast.
    /// Values that are infinite limit nothing; those that are not numbers are left alone.
    ///
    /// # Errors
    /// [`MarchError::Length`], [`MarchError::Start`], [`MarchError::Width`] and, for a start
    /// whose value is not a number or minus infinity, [`MarchError::Value`] leave `values` as
    /// they were. [`MarchError::Cost`] (a negative cost, or one that is not a number) leaves
    /// them partly relaxed.
    pub fn relax(
        &mut self,
        lattice: &Lattice,
        values: &mut [f64],
        starts: &[usize],
        width: f64,
        cost: impl Fn(usize, &Edge) -> f64,
    ) -> Result<usize, MarchError> {
        self.begin(lattice, values, starts, width)?;
        self.run(values, width, |this, values, from| {
            let value = values[from];
            lattice
                .neighbours(from)
                .try_for_each(|edge| this.lower(values, (from, value), &edge, &cost).map(drop))
        })
    }

    /// As [`Relaxation::relax`], with the same result, where many edges are alike: `is_even(node)` says
    /// that all edges of a node cost their length times one rate, and that no edge between two of its
    /// neighbours costs more than its length times that rate. From such a node only nodes that lie
    /// farther on are looked at, about half. `width` must be of the size of a few edges: it tells up to
    /// which values an edge is safe from rounding.
    ///
    /// Takes a byte a node in addition.
    ///
    /// # Errors
    /// As [`Relaxation::relax`].
    pub fn relax_even(
        &mut self,
        lattice: &Lattice,
        values: &mut [f64],
        starts: &[usize],
        width: f64,
        cost: impl Fn(usize, &Edge) -> f64,
        is_even: impl Fn(usize) -> bool,
    ) -> Result<usize, MarchError> {
        self.begin(lattice, values, starts, width)?;
        self.came.resize(lattice.node_count(), FROM_NOWHERE);
        starts.iter().for_each(|&node| self.came[node] = FROM_NOWHERE);
        let onward = Onward::of(lattice);
        // Beyond this the rounding of sums is no longer small beside an edge.
        let limit = width * 1e10;
        self.run(values, width, |this, values, from| {
            let value = values[from];
            let directions = onward.after(this.came[from]).filter(|_| {
                let is_inside = lattice.is_interior(lattice.coordinates(from));
                value.abs() < limit && is_inside && is_even(from)
            });
            let mut lower = |edge: Edge| -> Result<(), MarchError> {
                if this.lower(values, (from, value), &edge, &cost)? {
                    this.came[edge.node] = edge.direction;
                }
                Ok(())
            };
            match directions {
                Some(directions) => directions.iter().try_for_each(|&direction| {
                    let edge = lattice.stencil()[usize::from(direction)];
                    lower(Edge { node: from.wrapping_add(edge.node), ..edge })
                }),
                None => lattice.neighbours(from).try_for_each(lower),
            }
        })
    }

    /// Relaxes nodes, bucket after bucket; returns how often that was.
    fn run(
        &mut self,
        values: &mut [f64],
        width: f64,
        relax: impl Fn(&mut Self, &mut [f64], usize) -> Result<(), MarchError>,
    ) -> Result<usize, MarchError> {
        let mut relaxed = 0;
        while self.rebase(values, width) {
            for bucket in 0..BUCKETS {
                while self.take_frontier(bucket) {
                    let frontier = std::mem::take(&mut self.frontier);
                    for &node in &frontier {
                        let from = node as usize;
                        // A node whose value has fallen further was relaxed with a lower bucket.
                        if self.bucket_of(values[from]) == Some(bucket) {
                            relaxed += 1;
                            relax(self, values, from)?;
                        }
                    }
                    self.frontier = frontier;
                }
            }
        }
        Ok(relaxed)
    }

    fn begin(
        &mut self,
        lattice: &Lattice,
        values: &[f64],
        starts: &[usize],
        width: f64,
    ) -> Result<(), MarchError> {
        check_length(lattice, "value", values.len())?;
        if !(width > 0.0 && width.is_finite()) {
            return Err(MarchError::Width(width));
        }
        let nodes = lattice.node_count();
        for &node in starts {
            let &value = values.get(node).ok_or(MarchError::Start { node, nodes })?;
            if value.is_nan() || value == f64::NEG_INFINITY {
                return Err(MarchError::Value { field: "value", node, value });
            }
        }
        self.buckets.iter_mut().for_each(Vec::clear);
        self.base = f64::NEG_INFINITY;
        self.far.clear();
        let finite = starts.iter().filter(|&&node| values[node].is_finite());
        self.far.extend(finite.map(|&node| node as u32));
        Ok(())
    }

    /// Bucket of a value, `None` beyond the last.
    #[inline]
    fn bucket_of(&self, value: f64) -> Option<usize> {
        let bucket = ((value - self.base) * self.per_width) as usize;
        (bucket < BUCKETS).then_some(bucket)
    }

    /// Moves the buckets up to the lowest value that waits; false if none does.
    fn rebase(&mut self, values: &[f64], least_width: f64) -> bool {
        // No bucket is being relaxed, so the memory of the frontier is free.
        let mut waiting = std::mem::take(&mut self.frontier);
        waiting.clear();
        std::mem::swap(&mut waiting, &mut self.far);
        // A value that has fallen into the old buckets was relaxed with them.
        waiting.retain(|&node| self.bucket_of(values[node as usize]).is_none());
        let due = || waiting.iter().map(|&node| values[node as usize]);
        let lowest = due().fold(f64::INFINITY, f64::min);
        let highest = due().fold(f64::NEG_INFINITY, f64::max);
        self.base = lowest;
        self.per_width = least_width.max((highest - lowest) / (BUCKETS * BUCKETS) as f64).recip();
        for &node in &waiting {
            self.put(node, values[node as usize]);
        }
        let found = !waiting.is_empty();
        self.frontier = waiting;
        found
    }

    #[inline]
    fn put(&mut self, node: u32, value: f64) {
        match self.bucket_of(value) {
            Some(bucket) => self.buckets[bucket].push(node),
            None => self.far.push(node),
        }
    }

    /// Empties a bucket into the frontier, in node order; false if the bucket was empty.
    fn take_frontier(&mut self, bucket: usize) -> bool {
        let mut frontier = std::mem::take(&mut self.frontier);
        frontier.clear();
        // Copied and not swapped, so that every bucket keeps the memory that it needs.
        frontier.append(&mut self.buckets[bucket]);
        let found = !frontier.is_empty();
        frontier.sort_unstable();
        frontier.dedup();
        self.frontier = frontier;
        found
    }

    /// Lowers the value at the end of an edge to what the edge allows; whether it was higher.
    #[inline]
    fn lower(
        &mut self,
        values: &mut [f64],
        (from, value): (usize, f64),
        edge: &Edge,
        cost: &impl Fn(usize, &Edge) -> f64,
    ) -> Result<bool, MarchError> {
        let cost = cost(from, edge);
        if cost.is_nan() || cost < 0.0 {
            return Err(MarchError::Cost { from, to: edge.node, cost });
        }
        let through = value + cost;
        let is_lower = through < values[edge.node];
        if is_lower {
            values[edge.node] = through;
            self.put(edge.node as u32, through);
        }
        Ok(is_lower)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Front;
    use super::*;
    use crate::testing::any_field;
    use crate::{Boundary, Connectivity};
    use proptest::prelude::*;

    /// The fixed point by sweeps over all edges until nothing changes.
    fn by_sweeps(lattice: &Lattice, values: &mut [f64], cost: impl Fn(usize, &Edge) -> f64) {
        loop {
            let mut changed = false;
            for node in 0..lattice.node_count() {
                for edge in lattice.neighbours(node) {
                    let through = values[node] + cost(node, &edge);
                    changed |= through < values[edge.node];
                    values[edge.node] = values[edge.node].min(through);
                }
            }
            if !changed {
                return;
            }
        }
    }

    proptest! {
        /// Buckets of any width, the front of listing 5.2 and plain sweeps give the same bits.
        #[test]
        fn all_schedules_give_the_same_bits(
            (lattice, rock) in any_field(), scale in 0.0..30.0_f64, power in -9..3_i32,
        ) {
            let cost = |from: usize, edge: &Edge| {
                // Channels and walls among the rock.
                let slope = match rock[from] {
                    hard if hard > 0.9 => f64::INFINITY,
                    soft if soft < 0.3 => 0.001,
                    rock => rock,
                };
                slope * edge.distance
            };
            let before: Vec<_> = rock.iter().map(|rock| rock * scale).collect();
            let starts: Vec<_> = (0..lattice.node_count()).collect();
            let mut expected = before.clone();
            by_sweeps(&lattice, &mut expected, cost);

            let mut relaxed = before.clone();
            let mut relaxation = Relaxation::new();
            let width = 10.0_f64.powi(power);
            let count = relaxation.relax(&lattice, &mut relaxed, &starts, width, cost);
            prop_assert!(count.is_ok());
            prop_assert_eq!(&relaxed, &expected);

            let mut pressure = before;
            let starts: Vec<_> = starts.into_iter().map(|node| (node, 0.0)).collect();
            let marched = Front::new().march(&lattice, &starts, |from, edge| {
                let new_pressure = pressure[from] + cost(from, edge);
                (new_pressure < pressure[edge.node]).then(|| {
                    pressure[edge.node] = new_pressure;
                    0.0
                })
            });
            prop_assert!(marched.is_ok());
            prop_assert_eq!(&pressure, &expected);
        }
    }

    proptest! {
        /// Looking ahead only lowers the same values the same number of times.
        #[test]
        fn even_edges_give_the_same_bits((lattice, rock) in any_field(), scale in 0.0..30.0_f64) {
            let channel = |node: usize| rock[node] < 0.3;
            let cost = |from: usize, edge: &Edge| {
                let rate = if channel(from) && channel(edge.node) { 0.001 } else { 0.5 };
                edge.distance * rate
            };
            let before: Vec<_> = rock.iter().map(|rock| rock * scale).collect();
            let starts: Vec<_> = (0..lattice.node_count()).step_by(3).collect();
            let [mut even, mut expected] = [before.clone(), before];
            let mut relaxation = Relaxation::new();
            let is_even = |node: usize| !channel(node);
            let looked =
                relaxation.relax_even(&lattice, &mut even, &starts, 1.0, cost, is_even);
            prop_assert_eq!(looked, relaxation.relax(&lattice, &mut expected, &starts, 1.0, cost));
            prop_assert_eq!(even, expected);
        }
    }

    #[test]
    fn what_has_no_meaning_is_refused() {
        let lattice = Lattice::plane([3, 1], 1.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
        let mut relaxation = Relaxation::new();
        let mut relax = |start: usize, first: f64, width: f64, cost: f64| {
            let mut values = [first, 5.0, 5.0];
            relaxation.relax(&lattice, &mut values, &[start], width, |_, _| cost).map(|_| values)
        };
        assert_eq!(relax(0, 0.0, 1.0, 2.0), Ok([0.0, 2.0, 4.0]));
        assert_eq!(relax(0, f64::INFINITY, 1.0, 2.0), Ok([f64::INFINITY, 5.0, 5.0]));
        assert_eq!(relax(3, 0.0, 1.0, 2.0), Err(MarchError::Start { node: 3, nodes: 3 }));
        assert_eq!(relax(0, 0.0, 0.0, 2.0), Err(MarchError::Width(0.0)));
        assert_eq!(relax(0, 0.0, 1.0, -1.0), Err(MarchError::Cost { from: 0, to: 1, cost: -1.0 }));
        assert!(matches!(relax(0, f64::NAN, 1.0, 2.0), Err(MarchError::Value { node: 0, .. })));
        // A refused relaxation leaves nothing behind in the memory.
        assert_eq!(relax(0, 0.0, 1.0, 2.0), Ok([0.0, 2.0, 4.0]));
    }
}
