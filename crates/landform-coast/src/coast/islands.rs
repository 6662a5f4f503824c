//! Islands: the pieces of land that the sea divides, and their shores.

use landform_graph::{BreadthFirst, Connectivity, Lattice, Reach};

use super::Shore;

/// A piece of land that the sea divides from all others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Island {
    /// Its nodes, the first one in node order first.
    pub nodes: Vec<u32>,
    /// Its shore in parts of a spacing ([`super::PARTS`]), lakes included.
    pub shore: u64,
}

/// The islands of `land`, in node order of their first nodes. Land is joined where the sea
/// cannot pass: over corners too where the sea has four neighbours, over sides only where it has
/// eight, and over the edges of the 4-8 mesh, which leave no corner undecided.
pub fn islands(lattice: &Lattice, land: &[u8]) -> Vec<Island> {
    let joined = match lattice.connectivity() {
        Connectivity::Four => Connectivity::Eight,
        Connectivity::Eight => Connectivity::Four,
        other => other,
    };
    let size = [lattice.width(), lattice.height()];
    let boundary = [lattice.boundary()[0], lattice.boundary()[1]];
    let Ok(joined) = Lattice::plane(size, lattice.spacing(), joined, boundary) else {
        return Vec::new();
    };
    let shore = Shore::new(lattice, land);
    let mut search = BreadthFirst::new();
    let mut seen = vec![false; land.len()];
    let mut islands = Vec::new();
    for first in 0..land.len() {
        if land[first] == 0 || seen[first] {
            continue;
        }
        let on_land = |_: usize, edge: &landform_graph::Edge| land[edge.node] > 0;
        let visits = search.collect(&joined, &[first], Reach::UNLIMITED, on_land);
        let mut nodes: Vec<u32> = visits.iter().map(|visit| visit.node as u32).collect();
        nodes.sort_unstable();
        nodes.iter().for_each(|&node| seen[node as usize] = true);
        let length = nodes.iter().map(|&node| u64::from(shore.length(node as usize))).sum();
        islands.push(Island { nodes, shore: length });
    }
    islands
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coast::testing::{any_land, any_lattice};
    use landform_graph::Boundary;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn islands_share_out_all_land_and_all_shore(lattice in any_lattice(), seed in 0_u64..200) {
            let land = any_land(&lattice, seed);
            let islands = islands(&lattice, &land);
            let nodes: usize = islands.iter().map(|island| island.nodes.len()).sum();
            prop_assert_eq!(nodes, land.iter().filter(|&&land| land > 0).count());
            let shore: u64 = islands.iter().map(|island| island.shore).sum();
            prop_assert_eq!(shore, Shore::new(&lattice, &land).total());
        }
    }

    #[test]
    fn corners_join_land_where_the_sea_cannot_pass() {
        let mut land = [0; 16];
        (land[5], land[10]) = (1, 1);
        for (connectivity, count) in
            [(Connectivity::Four, 1), (Connectivity::FourEight, 1), (Connectivity::Eight, 2)]
        {
            let lattice = Lattice::plane([4, 4], 1.0, connectivity, [Boundary::Open; 2]).unwrap();
            assert_eq!(islands(&lattice, &land).len(), count, "{connectivity:?}");
        }
    }
}
