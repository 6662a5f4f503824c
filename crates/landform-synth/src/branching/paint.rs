//! Branching lines as fields.

use landform_graph::Lattice;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Branching;
use super::nearest::{Near, Nearest};

/// What a field shows of branching lines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Shown {
    /// 1 in branches, 0 beyond, with an edge one spacing wide.
    #[default]
    Inside,
    /// Distance to the nearest branch in metres, 0 inside.
    Distance,
    /// Length in metres between the nearest place of a branch and the root of its tree, along
    /// the branches.
    Upstream,
    /// How late the branch came, in a branch: near 0 for the first node, 1 for the last; 0
    /// beyond branches.
    Age,
    /// Number of the tree, from 1, in a branch; 0 beyond branches.
    Tree,
}

/// One value a node of the lattice.
pub(crate) fn paint(branching: &Branching, lattice: &Lattice, shown: Shown) -> Vec<f64> {
    if branching.is_empty() {
        return vec![0.0; lattice.node_count()];
    }
    let spacing = lattice.spacing();
    let top = lattice.size().map(|nodes| (nodes - 1) as f64 * spacing);
    let nearest = Nearest::new(branching, [[0.0; 3], top], 2.0 * spacing);
    let upstream = if shown == Shown::Upstream { branching.root_lengths() } else { Vec::new() };
    let trees = if shown == Shown::Tree { branching.trees() } else { Vec::new() };
    let reach = match shown {
        Shown::Distance | Shown::Upstream => f64::INFINITY,
        Shown::Inside | Shown::Age | Shown::Tree => 0.5 * spacing,
    };
    let value = |near: Near| match shown {
        Shown::Inside => (0.5 - near.distance_m / spacing).clamp(0.0, 1.0),
        Shown::Distance => near.distance_m.max(0.0),
        Shown::Upstream => upstream[near.node] - (1.0 - near.along) * branching.piece_m(near.node),
        Shown::Age => (near.node + 1) as f64 / branching.len() as f64,
        Shown::Tree => f64::from(trees[near.node] + 1),
    };
    let at = |node| nearest.find(lattice.position(node).to_array(), reach).map_or(0.0, value);
    (0..lattice.node_count()).into_par_iter().map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    #[test]
    fn a_straight_branch_is_where_it_belongs() {
        let mut branching = Branching::default();
        let root = branching.add([20.0, 50.0, 0.0], None, 10.0);
        branching.add([80.0, 50.0, 0.0], Some(root), 10.0);
        let lattice =
            Lattice::plane([101, 101], 1.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
        let at = |field: &[f64], x: usize, north: usize| field[x + 101 * (100 - north)];
        let inside = paint(&branching, &lattice, Shown::Inside);
        assert_eq!(
            [at(&inside, 50, 50), at(&inside, 50, 60), at(&inside, 50, 62)],
            [1.0, 0.5, 0.0]
        );
        // A rectangle and two half discs.
        let area: f64 = inside.iter().sum();
        let expected = 60.0 * 20.0 + std::f64::consts::PI * 100.0;
        assert!((area / expected - 1.0).abs() < 2e-3, "{area} {expected}");
        let distance = paint(&branching, &lattice, Shown::Distance);
        assert_eq!([at(&distance, 50, 55), at(&distance, 50, 90)], [0.0, 30.0]);
        assert_eq!(at(&distance, 90 + 3, 50), 3.0);
        let upstream = paint(&branching, &lattice, Shown::Upstream);
        assert_eq!([at(&upstream, 0, 0), at(&upstream, 50, 99)], [0.0, 30.0]);
        assert!((at(&upstream, 99, 40) - 60.0).abs() < 1e-12);
        let age = paint(&branching, &lattice, Shown::Age);
        assert_eq!([at(&age, 60, 50), at(&age, 60, 70)], [1.0, 0.0]);
        assert_eq!(at(&paint(&branching, &lattice, Shown::Tree), 60, 50), 1.0);
    }
}
