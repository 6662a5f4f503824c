//! Which states of the Abelian sandpile come back.

/// Whether a stable state of `size = [columns, rows]` sites recurs once the sandpile is
/// critical, by Dhar's burning test.
///
/// Fire enters from all borders; a site burns when it holds at least as many grains as it has
/// neighbours that do not burn yet. The state recurs if everything burns. The number of such
/// states is the number of spanning trees of the lattice with its border as one more site
/// (Dhar 1990, Majumdar and Dhar 1992). Cost: constant a site.
///
/// `grains` holds one number a site in node order; a slice of another length does not recur.
pub fn is_recurrent([width, height]: [usize; 2], grains: &[u32]) -> bool {
    if grains.len() != width * height {
        return false;
    }
    let neighbours = |site: usize| {
        let [x, y] = [site % width, site / width];
        let along_row = [(x > 0).then(|| site - 1), (x + 1 < width).then(|| site + 1)];
        let along_column = [(y > 0).then(|| site - width), (y + 1 < height).then(|| site + width)];
        along_row.into_iter().chain(along_column).flatten()
    };
    let mut unburnt_neighbours: Vec<u32> =
        (0..grains.len()).map(|site| neighbours(site).count() as u32).collect();
    let mut burnt = vec![false; grains.len()];
    let mut burning: Vec<usize> = Vec::new();
    for site in 0..grains.len() {
        if grains[site] >= unburnt_neighbours[site] {
            burnt[site] = true;
            burning.push(site);
        }
    }
    while let Some(site) = burning.pop() {
        for neighbour in neighbours(site) {
            unburnt_neighbours[neighbour] -= 1;
            if !burnt[neighbour] && grains[neighbour] >= unburnt_neighbours[neighbour] {
                burnt[neighbour] = true;
                burning.push(neighbour);
            }
        }
    }
    burnt.iter().all(|&burnt| burnt)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count_recurrent(side: usize) -> usize {
        let sites = side * side;
        (0..4_u32.pow(sites as u32))
            .filter(|state| {
                let grains: Vec<u32> = (0..sites).map(|site| state >> (2 * site) & 3).collect();
                is_recurrent([side, side], &grains)
            })
            .count()
    }

    /// Determinants of the Laplacian with open borders (Dhar 1990).
    #[test]
    fn recurrent_states_are_as_many_as_spanning_trees() {
        assert_eq!(count_recurrent(1), 4);
        assert_eq!(count_recurrent(2), 192);
        assert_eq!(count_recurrent(3), 100_352);
    }

    #[test]
    fn the_wrong_number_of_sites_does_not_recur() {
        assert!(!is_recurrent([2, 2], &[3; 3]));
    }
}
