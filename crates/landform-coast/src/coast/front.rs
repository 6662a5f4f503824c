//! The front that the sea leaves in rock which hardens inland: gradient percolation.

use landform_graph::{BreadthFirst, Lattice, Reach};

use super::islands::islands;
use super::shore::{Shore, spacings};

/// The shore of the mainland of a map with the sea in the south, lengths in spacings.
///
/// Where the share of weak rock sinks evenly inland, the sea stops near the percolation threshold. The
/// front has a width, a shore and an accessible shore that grow as 1 / gradient to the powers 4/7, 3/7
/// and 4/21 (Sapoval, Rosso and Gouyet 1985; Grossman and Aharony 1987).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Front {
    /// Mean distance of the shore from the southernmost row.
    pub reach: f64,
    /// Standard deviation of that distance.
    pub width: f64,
    /// Length of the shore.
    pub shore: f64,
    /// Length of the shore that the sea still reaches when it stays a node away from land: fjords with
    /// gates of two nodes or less do not count.
    pub accessible_shore: f64,
}

impl Front {
    /// The front of the largest piece of land, the northern one of equal pieces; `None` without a shore.
    ///
    /// # Panics
    /// If `land` is not as long as the lattice has nodes.
    pub fn new(lattice: &Lattice, land: &[u8]) -> Option<Self> {
        let mainland = mainland(lattice, land)?;
        let shore = Shore::new(lattice, &mainland);
        let total = shore.total() as f64;
        let last = lattice.height() - 1;
        let moment = |of: &dyn Fn(f64) -> f64| {
            let part = |node: usize| {
                f64::from(shore.length(node)) * of((last - node / lattice.width()) as f64)
            };
            (0..land.len()).map(part).sum::<f64>() / total
        };
        let reach = moment(&|distance| distance);
        (total > 0.0).then(|| Self {
            reach,
            width: moment(&|distance| (distance - reach).powi(2)).sqrt(),
            shore: spacings(shore.total()),
            accessible_shore: accessible(lattice, &mainland),
        })
    }
}

/// Land without its islands.
fn mainland(lattice: &Lattice, land: &[u8]) -> Option<Vec<u8>> {
    let islands = islands(lattice, land);
    let largest = islands.iter().rev().max_by_key(|island| island.nodes.len())?;
    let mut mainland = vec![0; land.len()];
    largest.nodes.iter().for_each(|&node| mainland[node as usize] = 1);
    Some(mainland)
}

/// Length of the border of the sea that stays one node away from land and is joined to the south.
fn accessible(lattice: &Lattice, mainland: &[u8]) -> f64 {
    let clear = |node: usize| {
        let at = lattice.coordinates(node);
        (-1..=1).all(|south| {
            (-1..=1).all(|east| {
                lattice.offset(at, [east, south, 0]).is_none_or(|other| mainland[other] == 0)
            })
        })
    };
    let is_side = |length: f64| length <= lattice.spacing();
    let south = lattice.node_count() - lattice.width()..lattice.node_count();
    let start: Vec<usize> = south.filter(|&node| clear(node)).collect();
    let mut search = BreadthFirst::new();
    let sea = search.collect(lattice, &start, Reach::UNLIMITED, |_, edge| {
        is_side(edge.distance) && clear(edge.node)
    });
    let mut land = vec![1; mainland.len()];
    sea.iter().for_each(|visit| land[visit.node] = 0);
    spacings(Shore::new(lattice, &land).total())
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    /// Rows of `#` for land and `.` for sea, periodic from west to east.
    fn front(rows: &[&str]) -> Option<Front> {
        let boundary = [Boundary::Periodic, Boundary::Open];
        let size = [rows[0].len(), rows.len()];
        let lattice = Lattice::plane(size, 1.0, Connectivity::Four, boundary).unwrap();
        let land: Vec<u8> = rows.concat().bytes().map(|byte| u8::from(byte == b'#')).collect();
        Front::new(&lattice, &land)
    }

    #[test]
    fn a_straight_front_has_no_width() {
        let rows = ["########", "########", "########", "........", "...##...", "........"];
        let straight = front(&rows).unwrap();
        assert_eq!((straight.reach, straight.width, straight.shore), (3.0, 0.0, 8.0));
        assert_eq!(front(&["....", "...."]), None);
    }

    /// A fjord behind a gate of one node belongs to the shore, not to what is accessible.
    #[test]
    fn narrow_gates_are_shut() {
        let open = ["##########", "##########", "##########", "..........", ".........."];
        let fjord = ["##########", "###....###", "####.#####", "..........", ".........."];
        let [open, fjord] = [open, fjord].map(|rows| front(&rows).unwrap());
        assert!(fjord.shore > open.shore + 5.0);
        assert!(fjord.reach > open.reach && fjord.width > 0.5);
        assert_eq!(fjord.accessible_shore, open.accessible_shore);
    }
}
