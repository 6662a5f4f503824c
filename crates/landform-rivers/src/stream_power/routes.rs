//! Where the water of every node goes, and how much ground it comes from.

use landform_graph::{Connectivity, Lattice};

use super::flood::Flood;
use super::steepest::{OUTLET, PIT, steepest};
use crate::RiverError;
use crate::error::check_length;

/// A forest of rivers: every node of a plane gives its water to one of its eight neighbours, or is an
/// outlet.
///
/// That is the neighbour with the steepest descent (D8); of several, the first in the order of
/// [`Lattice::neighbours`]. Depressions are filled with lakes, and water crosses lakes and flats by the
/// fewest steps to where it leaves them. On ground without pits, as rivers leave it, no flood is needed
/// and none runs.
#[derive(Clone, Debug)]
pub struct Routes {
    flood: Flood,
    /// Receiver of each node, itself at outlets.
    receivers: Vec<u32>,
    /// Number of the step to the receiver, or [`OUTLET`].
    directions: Vec<u8>,
    /// Every node before its receiver.
    downstream: Vec<u32>,
    cells: Vec<u32>,
    /// Neighbours that give to a node and were not met yet.
    donors: Vec<u8>,
}

/// Marks nodes that were met.
const MET: u8 = u8::MAX;

impl Routes {
    /// Bytes a node.
    pub const BYTES: usize = Flood::BYTES + 14;

    /// Memory for routes over a plane.
    ///
    /// # Errors
    /// [`RiverError::Directions`] unless nodes have eight neighbours.
    pub fn new(lattice: &Lattice) -> Result<Self, RiverError> {
        if lattice.connectivity() != Connectivity::Eight {
            return Err(RiverError::Directions(lattice.connectivity()));
        }
        let count = lattice.node_count();
        Ok(Self {
            flood: Flood::new(lattice),
            receivers: vec![0; count],
            directions: vec![PIT; count],
            downstream: vec![0; count],
            cells: vec![0; count],
            donors: vec![0; count],
        })
    }

    /// Finds the routes over `heights` (metres) to `outlets`, which are in order of their indices.
    ///
    /// Cost: constant a node where there are no pits; n log n for the n nodes, mostly on divides,
    /// that a flood may spill over where there are.
    ///
    /// # Errors
    /// [`RiverError::Length`]; [`RiverError::NoOutlet`].
    pub fn find(
        &mut self,
        lattice: &Lattice,
        heights: &[f64],
        outlets: &[usize],
    ) -> Result<(), RiverError> {
        check_length("bed", heights.len(), self.directions.len())?;
        if outlets.is_empty() {
            return Err(RiverError::NoOutlet);
        }
        if steepest(lattice, heights, outlets, &mut self.directions) {
            self.flood.run(lattice, heights, outlets);
            steepest(lattice, &self.flood.levels, outlets, &mut self.directions);
            for (direction, way) in self.directions.iter_mut().zip(&self.flood.ways) {
                if *direction == PIT {
                    *direction = *way;
                }
            }
        }
        self.receive(lattice);
        self.gather();
        Ok(())
    }

    /// Receivers and numbers of donors by directions.
    fn receive(&mut self, lattice: &Lattice) {
        let offsets = Flood::offsets(lattice);
        let [width, height] = [lattice.width(), lattice.height()];
        self.donors.fill(0);
        let mut receive = |node: usize, receiver: usize| {
            self.receivers[node] = receiver as u32;
            self.donors[receiver] += u8::from(receiver != node);
        };
        for y in 0..height {
            let on_border = y == 0 || y + 1 == height;
            for x in 0..width {
                let node = y * width + x;
                let direction = self.directions[node];
                let receiver = if direction == OUTLET {
                    node
                } else if on_border || x == 0 || x + 1 == width {
                    receiver_on_border(lattice, node, direction)
                } else {
                    node.wrapping_add(offsets[usize::from(direction & 7)])
                };
                receive(node, receiver);
            }
        }
    }

    /// Goes down from every source to where another river is still to come, so that each node follows
    /// all that give to it, and adds up what they drain.
    fn gather(&mut self) {
        self.cells.fill(1);
        let mut met = 0;
        for source in 0..self.receivers.len() {
            let mut node = source;
            while self.donors[node] == 0 {
                self.donors[node] = MET;
                self.downstream[met] = node as u32;
                met += 1;
                let receiver = self.receivers[node] as usize;
                if receiver == node {
                    break;
                }
                self.cells[receiver] += self.cells[node];
                self.donors[receiver] -= 1;
                node = receiver;
            }
        }
    }

    /// The node that takes the water of a node; `None` at outlets.
    pub fn receiver(&self, node: usize) -> Option<usize> {
        self.direction(node).map(|_| self.receivers[node] as usize)
    }

    /// Number of the step to the receiver, in the order of [`Lattice::neighbours`].
    pub fn direction(&self, node: usize) -> Option<u8> {
        Some(self.directions[node]).filter(|&direction| direction != OUTLET)
    }

    /// Number of nodes whose water passes each node, itself included. Times the square of the spacing
    /// it is the drainage area.
    pub fn cells(&self) -> &[u32] {
        &self.cells
    }

    /// All nodes, each before its receiver.
    pub fn downstream(&self) -> impl DoubleEndedIterator<Item = usize> {
        self.downstream.iter().map(|&node| node as usize)
    }
}

/// The neighbour in a direction that is known to have one.
fn receiver_on_border(lattice: &Lattice, node: usize, direction: u8) -> usize {
    let mut edges = lattice.neighbours(node);
    edges.find(|edge| edge.direction == direction).map_or(node, |edge| edge.node)
}
