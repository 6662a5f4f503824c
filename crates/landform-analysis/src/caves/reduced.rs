//! The reduced graph of a network: ends and junctions, and branches between them.

use super::CaveNetwork;

/// The graph of ends and junctions (Collon et al. 2017), by neighbours.
///
/// Loops keep two stations in between, and branches that share both ends one, where they have any, so
/// that the graph has no loops and no double edges and its topology is kept.
pub(super) fn reduced(network: &CaveNetwork) -> Vec<Vec<usize>> {
    let branches = network.branches();
    let ends = |stations: &[usize]| {
        let (first, last) = (stations[0], stations[stations.len() - 1]);
        [first.min(last), first.max(last)]
    };
    let mut all: Vec<[usize; 2]> = branches.iter().map(|branch| ends(&branch.stations)).collect();
    all.sort_unstable();
    let shared = |of: &[usize]| {
        let first = all.partition_point(|other| *other < ends(of));
        all.get(first + 1) == Some(&ends(of))
    };
    let mut edges: Vec<[usize; 2]> = Vec::new();
    for branch in &branches {
        let stations = &branch.stations;
        let last = stations.len() - 1;
        let mut cuts = vec![0];
        if stations[0] == stations[last] {
            // Three parts, or as many as there are legs.
            let part = stations.len() / 3;
            cuts.extend([part, 2 * part].into_iter().filter(|&cut| cut > 0 && cut < last));
        } else if shared(stations) && last > 1 {
            cuts.push(stations.len() / 2);
        }
        cuts.push(last);
        edges.extend(cuts.windows(2).map(|cut| [stations[cut[0]], stations[cut[1]]]));
    }
    neighbours_of(&edges)
}

/// Neighbours by node of the graph with these edges, of any numbers, counted anew in their order.
fn neighbours_of(edges: &[[usize; 2]]) -> Vec<Vec<usize>> {
    let mut names: Vec<usize> = edges.iter().flatten().copied().collect();
    names.sort_unstable();
    names.dedup();
    let number = |name: usize| names.partition_point(|&other| other < name);
    let mut neighbours = vec![Vec::new(); names.len()];
    for [from, to] in edges.iter().map(|edge| edge.map(number)).filter(|[from, to]| from != to) {
        neighbours[from].push(to);
        neighbours[to].push(from);
    }
    for list in &mut neighbours {
        list.sort_unstable();
        list.dedup();
    }
    neighbours
}
