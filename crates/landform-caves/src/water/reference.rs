//! Listing 5.3 with real numbers and whole fields, all voxels at the same moment.

use landform_graph::Lattice;

use super::{FILM, UNIT};

/// Contents after a sweep, and what each voxel received.
pub(super) fn sweep(
    lattice: &Lattice,
    pressure: &[f64],
    capacity: &[f64],
    contents: &[f64],
) -> (Vec<f64>, Vec<f64>) {
    let count = lattice.node_count();
    let mut offers = vec![Vec::new(); count];
    let mut asked = vec![0.0; count];
    let film = f64::from(FILM) / UNIT;
    for site in (0..count).filter(|&site| contents[site] > film) {
        let participates = |neighbour: usize| {
            capacity[neighbour] > contents[neighbour] && pressure[neighbour] < pressure[site]
        };
        let neighbours: Vec<usize> = lattice
            .neighbours(site)
            .map(|edge| edge.node)
            .filter(|&node| participates(node))
            .collect();
        let differences: f64 = neighbours.iter().map(|&node| pressure[site] - pressure[node]).sum();
        let update = |node: usize| {
            (pressure[site] - pressure[node]) / differences * (capacity[node] - contents[node])
        };
        let all: f64 = neighbours.iter().map(|&node| update(node)).sum();
        let part = if all > contents[site] { contents[site] / all } else { 1.0 };
        for node in neighbours {
            offers[site].push((node, update(node) * part));
            asked[node] += update(node) * part;
        }
    }
    let (mut after, mut received) = (contents.to_vec(), vec![0.0; count]);
    for (site, offers) in offers.iter().enumerate() {
        for &(node, offer) in offers {
            let room = capacity[node] - contents[node];
            let taken = if asked[node] > room { offer * room / asked[node] } else { offer };
            after[site] -= taken;
            after[node] += taken;
            received[node] += taken;
        }
    }
    (after, received)
}
