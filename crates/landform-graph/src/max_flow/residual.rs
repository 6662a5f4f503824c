//! What flows over edges, and what more may flow.

use std::cell::Cell;

use super::{FlowError, MOST_CAPACITY};
use crate::{Edge, Lattice};

/// The flow on its way to the maximum. What edges may carry is computed whenever it is asked for;
/// only flow is stored, and memory of the parts of the lattice without any is never touched.
pub(super) struct Residual<'a, K> {
    lattice: &'a Lattice,
    capacity: K,
    /// Flow on directed edges by slot.
    flow: Vec<i32>,
    /// Whether anything ever flowed over an edge of a node: of other nodes no flow is read.
    carries: Vec<bool>,
    /// The first edge found that carries too much.
    refused: Cell<Option<FlowError>>,
}

impl<'a, K: Fn(usize, &Edge) -> u32> Residual<'a, K> {
    /// Nothing flows yet.
    pub(super) fn new(lattice: &'a Lattice, capacity: K) -> Self {
        let (flow, carries) = (vec![0; lattice.slots()], vec![false; lattice.node_count()]);
        Self { lattice, capacity, flow, carries, refused: Cell::new(None) }
    }

    /// What more may flow from `from` over an edge.
    #[inline]
    pub(super) fn left(&self, from: usize, edge: &Edge) -> u32 {
        let capacity = (self.capacity)(from, edge);
        if capacity > MOST_CAPACITY {
            let error = FlowError::Capacity { from, to: edge.node, capacity };
            self.refused.set(self.refused.take().or(Some(error)));
            return 0;
        }
        let flow = if self.carries[from] { self.flow[self.lattice.slot(from, edge)] } else { 0 };
        // At most both capacities together, which fit 32 bits without a sign.
        capacity.wrapping_sub(flow as u32)
    }

    /// Lets no more than is left flow from `from` over an edge.
    pub(super) fn add(&mut self, from: usize, edge: &Edge, amount: u32) {
        self.carries[from] = true;
        self.carries[edge.node] = true;
        let (there, back) = (self.lattice.slot(from, edge), self.lattice.reverse_slot(edge));
        self.flow[there] = self.flow[there].wrapping_add_unsigned(amount);
        self.flow[back] = self.flow[back].wrapping_sub_unsigned(amount);
    }

    /// Checks the capacities that were asked for.
    pub(super) fn check(&self) -> Result<(), FlowError> {
        self.refused.take().map_or(Ok(()), Err)
    }

    /// Flow on directed edges by slot.
    pub(super) fn into_flow(self) -> Vec<i32> {
        self.flow
    }
}
