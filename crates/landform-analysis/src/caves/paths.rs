//! Parts, shortest paths and betweenness of small graphs.

/// The connected parts of a graph given by neighbours, each in order of its nodes.
pub(super) fn components(neighbours: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let mut seen = vec![false; neighbours.len()];
    let mut parts = Vec::new();
    for start in 0..neighbours.len() {
        if std::mem::replace(&mut seen[start], true) {
            continue;
        }
        let (mut part, mut open) = (vec![start], vec![start]);
        while let Some(node) = open.pop() {
            for &next in &neighbours[node] {
                if !std::mem::replace(&mut seen[next], true) {
                    part.push(next);
                    open.push(next);
                }
            }
        }
        part.sort_unstable();
        parts.push(part);
    }
    parts
}

/// Sum of the numbers of steps from each node to all others it is joined with, and the betweenness
/// of each node: over all pairs of others, the share of shortest paths that pass it (Brandes 2001).
pub(super) fn steps_and_betweenness(neighbours: &[Vec<usize>]) -> (Vec<u64>, Vec<f64>) {
    let count = neighbours.len();
    let (mut sums, mut betweenness) = (vec![0; count], vec![0.0; count]);
    let mut steps = vec![u64::MAX; count];
    let mut paths = vec![0.0; count];
    let mut share = vec![0.0; count];
    let mut order = Vec::with_capacity(count);
    for start in 0..count {
        order.clear();
        order.push(start);
        (steps[start], paths[start]) = (0, 1.0);
        let mut next = 0;
        while next < order.len() {
            let node = order[next];
            next += 1;
            sums[start] += steps[node];
            for &neighbour in &neighbours[node] {
                if steps[neighbour] == u64::MAX {
                    steps[neighbour] = steps[node] + 1;
                    order.push(neighbour);
                }
                if steps[neighbour] == steps[node] + 1 {
                    paths[neighbour] += paths[node];
                }
            }
        }
        for &node in order.iter().rev() {
            for &neighbour in &neighbours[node] {
                if steps[neighbour] == steps[node] + 1 {
                    share[node] += paths[node] / paths[neighbour] * (1.0 + share[neighbour]);
                }
            }
            if node != start {
                betweenness[node] += share[node];
            }
        }
        for &node in &order {
            (steps[node], paths[node], share[node]) = (u64::MAX, 0.0, 0.0);
        }
    }
    // Every pair was seen from both ends.
    betweenness.iter_mut().for_each(|value| *value /= 2.0);
    (sums, betweenness)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_and_a_ring() {
        let path = vec![vec![1], vec![0, 2], vec![1, 3], vec![2]];
        let (sums, betweenness) = steps_and_betweenness(&path);
        assert_eq!(sums, [6, 4, 4, 6]);
        assert_eq!(betweenness, [0.0, 2.0, 2.0, 0.0]);
        let ring = vec![vec![1, 3], vec![0, 2], vec![1, 3], vec![0, 2]];
        assert_eq!(steps_and_betweenness(&ring).1, [0.5; 4]);
        let two = vec![vec![2], vec![], vec![0]];
        assert_eq!(components(&two), [vec![0, 2], vec![1]]);
    }
}
