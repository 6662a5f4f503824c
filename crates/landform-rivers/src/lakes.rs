//! Lakes: depressions that hold water.

use landform_analysis::grid::{Grid, GridError};
use landform_analysis::hydrology::fill_depressions;
use landform_graph::{BreadthFirst, Edge, Lattice, Reach};

/// The nodes of each lake: the connected patches of at least `least_nodes` nodes of depressions of
/// the bed that hold more than `least_depth_m` of water. A depression is what a flood that drains
/// over the borders of the domain would fill. `bed` and `water` are metres, a node each.
///
/// # Errors
/// [`GridError`] if the fields do not fit the lattice.
pub fn lakes(
    lattice: &Lattice,
    (bed, water): (&[f64], &[f64]),
    least_depth_m: f64,
    least_nodes: u32,
) -> Result<Vec<Vec<usize>>, GridError> {
    let grid = Grid::new([lattice.width(), lattice.height()], [lattice.spacing(); 2])?;
    let filled = fill_depressions(&grid, bed)?;
    let stands = |node: usize| water[node] > least_depth_m && filled[node] > bed[node];
    let mut lakes = patches(lattice, stands);
    lakes.retain(|lake| lake.len() >= least_nodes as usize);
    Ok(lakes)
}

/// The connected patches of the nodes that are `inside`.
fn patches(lattice: &Lattice, inside: impl Fn(usize) -> bool) -> Vec<Vec<usize>> {
    let mut seen = vec![false; lattice.node_count()];
    let mut search = BreadthFirst::new();
    let mut patches = Vec::new();
    for node in (0..lattice.node_count()).filter(|&node| inside(node)) {
        if !seen[node] {
            let within = |_, edge: &Edge| inside(edge.node);
            let visits = search.collect(lattice, &[node], Reach::UNLIMITED, within);
            visits.iter().for_each(|visit| seen[visit.node] = true);
            patches.push(visits.iter().map(|visit| visit.node).collect());
        }
    }
    patches
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    #[test]
    fn patches_hang_together_over_diagonals_with_eight_neighbours_only() {
        let inside = [true, false, false, false, true, false, false, false, false];
        let found = |connectivity| {
            let lattice = Lattice::plane([3, 3], 1.0, connectivity, [Boundary::Open; 2]).unwrap();
            patches(&lattice, |node| inside[node])
        };
        assert_eq!(found(Connectivity::Eight), [vec![0, 4]]);
        assert_eq!(found(Connectivity::Four), [vec![0], vec![4]]);
    }

    #[test]
    fn lakes_are_depressions_with_water() {
        let open = [Boundary::Open; 2];
        let lattice = Lattice::plane([5, 5], 1.0, Connectivity::Eight, open).unwrap();
        let bed: Vec<f64> = (0..25).map(|node| if node == 12 { 0.0 } else { 2.0 }).collect();
        // Water on the rim is no lake.
        let found = |depth: f64, nodes| lakes(&lattice, (&bed, &[depth; 25]), 0.1, nodes).unwrap();
        assert_eq!((found(0.5, 1), found(0.05, 1)), (vec![vec![12]], vec![]));
        assert!(found(0.5, 2).is_empty());
    }
}
