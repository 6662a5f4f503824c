//! The nodes of the coast and what is known of each.

use super::stretch::NOWHERE;

/// The slot of a node that does not belong to the coast.
const NO_SLOT: u32 = u32::MAX;

/// The coast nodes, in an order that depends on history, their strengths and limits.
///
/// Memory: 4 bytes a node, 40 more a coast node.
#[derive(Clone, Debug)]
pub(super) struct Marks {
    pub(super) nodes: Vec<u32>,
    pub(super) strengths: Vec<f64>,
    /// Resistance of each node when it joined the coast.
    pub(super) resistances: Vec<f64>,
    /// Least perimeter in parts that each node withstands, where that is known; else zero.
    pub(super) limits: Vec<i32>,
    /// Places of each node's sides in the lines of the shore, where those are traced.
    pub(super) places: Vec<[u32; 4]>,
    /// Place of each node among the nodes of the coast.
    slots: Vec<u32>,
}

impl Marks {
    /// No coast among `nodes` nodes.
    pub(super) fn new(nodes: usize) -> Self {
        Self {
            nodes: Vec::new(),
            strengths: Vec::new(),
            resistances: Vec::new(),
            limits: Vec::new(),
            places: Vec::new(),
            slots: vec![NO_SLOT; nodes],
        }
    }

    /// Whether a node belongs to the coast.
    #[inline]
    pub(super) fn contains(&self, node: usize) -> bool {
        self.slots[node] != NO_SLOT
    }

    /// Place of a coast node among the nodes of the coast.
    #[inline]
    pub(super) fn slot(&self, node: usize) -> Option<usize> {
        let slot = self.slots[node];
        (slot != NO_SLOT).then_some(slot as usize)
    }

    /// Sets the strength of a node, which joins the coast when it was not there: `true` then.
    pub(super) fn set(&mut self, node: usize, resistance: f64, strength: f64) -> bool {
        if let Some(slot) = self.slot(node) {
            self.strengths[slot] = strength;
            return false;
        }
        self.slots[node] = self.nodes.len() as u32;
        self.nodes.push(node as u32);
        self.strengths.push(strength);
        self.resistances.push(resistance);
        self.limits.push(0);
        self.places.push([NOWHERE; 4]);
        true
    }

    /// Takes a node away from the coast and gives its limit and the places of its sides.
    pub(super) fn remove(&mut self, node: usize) -> (i32, [u32; 4]) {
        let slot = std::mem::replace(&mut self.slots[node], NO_SLOT) as usize;
        self.nodes.swap_remove(slot);
        self.strengths.swap_remove(slot);
        self.resistances.swap_remove(slot);
        if let Some(&moved) = self.nodes.get(slot) {
            self.slots[moved as usize] = slot as u32;
        }
        (self.limits.swap_remove(slot), self.places.swap_remove(slot))
    }
}
