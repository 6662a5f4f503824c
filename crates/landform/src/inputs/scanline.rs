//! Which nodes lie within rings.

use landform_graph::Lattice;
use rayon::prelude::*;

/// 1 at the nodes within an odd number of rings, 0 at others. Rings are in metres east and north
/// of the south-western corner of the lattice, half a spacing beyond its first node, and close
/// by themselves.
///
/// Each row of nodes is cut with all edges at once, so that a shore of many points costs no more
/// than its points and the nodes.
pub(super) fn within_rings(lattice: &Lattice, rings: &[Vec<[f64; 2]>]) -> Vec<f64> {
    let [width, height] = [lattice.width(), lattice.height()];
    let place = |node: usize| (node as f64 + 0.5) * lattice.spacing();
    let mut cuts = vec![Vec::new(); height];
    for [from, to] in rings.iter().flat_map(|ring| edges(ring)) {
        let [south, north] = if from[1] < to[1] { [from, to] } else { [to, from] };
        // Rows whose nodes lie between the ends; a corner belongs to the edge above it.
        let first = (south[1] / lattice.spacing() - 0.5).ceil().max(0.0) as usize;
        for (step, cuts) in cuts.iter_mut().enumerate().skip(first) {
            if place(step) >= north[1] {
                break;
            }
            let share = (place(step) - south[1]) / (north[1] - south[1]);
            cuts.push(south[0] + share * (north[0] - south[0]));
        }
    }
    let mut land = vec![0.0; width * height];
    land.par_chunks_mut(width).zip(cuts.par_iter_mut().rev()).for_each(|(row, cuts)| {
        cuts.sort_by(f64::total_cmp);
        for pair in cuts.chunks_exact(2) {
            let [first, end] = [pair[0], pair[1]]
                .map(|east| (east / lattice.spacing() - 0.5).ceil().clamp(0.0, width as f64));
            row[first as usize..end as usize].fill(1.0);
        }
    });
    land
}

/// The edges of a closed ring.
fn edges(ring: &[[f64; 2]]) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&from, &to)| [from, to])
}

#[cfg(test)]
mod tests {
    use landform_graph::{Boundary, Connectivity};
    use landform_synth::{Generator, Mask, MaskSource};

    use super::*;

    /// The mask of the construction trees looks at every edge from every node.
    #[test]
    fn rows_agree_with_single_places() {
        for seed in 0..20_u32 {
            let unit = |draw: u32| {
                f64::from((seed * 977 + draw).wrapping_mul(2_654_435_761) >> 8) / 16_777_216.0
            };
            let corner = |ring: u32, step: u32| {
                [0, 1].map(|axis| 620.0 * unit(100 * ring + 2 * step + axis) - 50.0)
            };
            let ring = |ring: u32| (0..3 + 4 * ring).map(|step| corner(ring, step)).collect();
            let rings: Vec<Vec<[f64; 2]>> = (0..3).map(ring).collect();
            let boundary = [Boundary::Open; 2];
            let lattice = Lattice::plane([53, 41], 11.0, Connectivity::Four, boundary).unwrap();
            let rows = within_rings(&lattice, &rings);
            let mask = Mask {
                of: MaskSource::Rings(rings),
                at_m: [-5.5; 2],
                edge_m: Some(1e-3),
                ..Mask::default()
            };
            let places = mask.generate(&lattice, 0).unwrap();
            let agree = rows.iter().zip(&places).all(|(row, place)| (row - place).abs() < 0.5);
            assert!(agree, "seed {seed}");
            assert!(rows.contains(&1.0) && rows.contains(&0.0));
        }
    }
}
