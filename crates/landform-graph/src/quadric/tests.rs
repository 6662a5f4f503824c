use super::*;
use crate::testing::any_field;
use crate::{Boundary, Connectivity};
use proptest::prelude::*;

const CONNECTIVITIES: [Connectivity; 6] = [
    Connectivity::Four,
    Connectivity::FourEight,
    Connectivity::Eight,
    Connectivity::Voxel6,
    Connectivity::Voxel18,
    Connectivity::Voxel26,
];

fn open_lattice(connectivity: Connectivity, size: [usize; 3], spacing: f64) -> Lattice {
    let open = Boundary::Open;
    match connectivity.is_volume() {
        true => Lattice::volume(size, spacing, connectivity, [open; 3]).unwrap(),
        false => Lattice::plane([size[0], size[1]], spacing, connectivity, [open; 2]).unwrap(),
    }
}

fn sample(lattice: &Lattice, function: impl Fn(DVec3) -> f64) -> Vec<f64> {
    (0..lattice.node_count()).map(|node| function(lattice.position(node))).collect()
}

fn is_cross(connectivity: Connectivity) -> bool {
    matches!(connectivity, Connectivity::Four | Connectivity::Voxel6)
}

proptest! {
    /// Any quadric is found again at every node, those of open borders included.
    #[test]
    fn quadrics_are_fitted_exactly(c in prop::array::uniform10(-2.0..2.0_f64)) {
        for connectivity in CONNECTIVITIES {
            let lattice = open_lattice(connectivity, [5, 4, 3], 0.5);
            let flat = if connectivity.is_volume() { 1.0 } else { 0.0 };
            let linear = DVec3::new(c[1], c[2], c[3] * flat);
            let hessian = DMat3::from_cols_array(&[
                c[4], c[7], c[8] * flat,
                c[7], c[5], c[9] * flat,
                c[8] * flat, c[9] * flat, c[6] * flat,
            ]);
            let value = |r: DVec3| c[0] + linear.dot(r) + 0.5 * r.dot(hessian * r);
            let field = sample(&lattice, value);
            for node in 0..lattice.node_count() {
                let at = lattice.position(node);
                let fit = Quadric::fit(&lattice, &field, node);
                let diagonal = |m: DMat3| DVec3::new(m.x_axis.x, m.y_axis.y, m.z_axis.z);
                prop_assert!((fit.value - value(at)).abs() < 1e-11);
                prop_assert!((fit.gradient - linear - hessian * at).length() < 1e-11);
                prop_assert!((diagonal(fit.hessian) - diagonal(hessian)).length() < 1e-10);
                let trace = diagonal(hessian).element_sum();
                prop_assert!((fit.laplacian() - trace).abs() < 1e-10);
                let mixed = is_cross(connectivity) || fit.hessian.abs_diff_eq(hessian, 1e-10);
                prop_assert!(mixed, "{:?} against {:?}", fit.hessian, hessian);
            }
        }
    }

    /// The window's quadric has the least squared error of all: moving any coefficient of
    /// the basis makes it worse or leaves it.
    #[test]
    fn fit_solves_the_normal_equations(field in prop::collection::vec(-1.0..1.0_f64, 9)) {
        let lattice = open_lattice(Connectivity::Eight, [3, 3, 1], 2.0);
        let fit = Quadric::fit(&lattice, &field, 4);
        let centre = lattice.position(4);
        let basis = |r: DVec3| [1.0, r.x, r.y, r.x * r.x, r.y * r.y, r.x * r.y];
        let mut residual_moments = [0.0; 6];
        for (node, value) in field.iter().enumerate() {
            let r = lattice.position(node) - centre;
            let modelled = fit.value + fit.gradient.dot(r) + 0.5 * r.dot(fit.hessian * r);
            for (moment, function) in residual_moments.iter_mut().zip(basis(r)) {
                *moment += (value - modelled) * function;
            }
        }
        prop_assert!(residual_moments.iter().all(|moment| moment.abs() < 1e-12));
    }

    #[test]
    fn row_kernels_give_the_bits_of_the_node_fit((lattice, field) in any_field()) {
        let count = lattice.node_count();
        let (mut east, mut north, mut laplacian) =
            (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
        gradient_field(&lattice, &field, &mut east, &mut north);
        laplacian_field(&lattice, &field, &mut laplacian);
        for node in 0..count {
            let fit = Quadric::fit(&lattice, &field, node);
            prop_assert_eq!((east[node], north[node]), (fit.gradient.x, fit.gradient.y));
            prop_assert_eq!(laplacian[node], fit.laplacian());
        }
    }

    #[test]
    fn steepest_descent_is_the_steepest_of_all_edges((lattice, height) in any_field()) {
        for node in 0..lattice.node_count() {
            let slope = |edge: &Edge| (height[node] - height[edge.node]) / edge.distance;
            let most = lattice.neighbours(node).map(|edge| slope(&edge)).fold(0.0, f64::max);
            match steepest_descent(&lattice, &height, node) {
                Some((edge, found)) => prop_assert!(found == most && found == slope(&edge)),
                None => prop_assert_eq!(most, 0.0),
            }
        }
    }
}

/// Largest errors of gradient and Laplacian of a smooth field, inside and at open borders.
fn errors(connectivity: Connectivity, nodes: usize) -> [f64; 4] {
    let spacing = 1.0 / (nodes - 1) as f64;
    let lattice = open_lattice(connectivity, [nodes, nodes, 1], spacing);
    let field = sample(&lattice, |r| (2.0 * r.x).sin() * (1.5 * r.y).exp());
    let mut worst = [0.0_f64; 4];
    for node in 0..lattice.node_count() {
        let r = lattice.position(node);
        let (sine, cosine, growth) = ((2.0 * r.x).sin(), (2.0 * r.x).cos(), (1.5 * r.y).exp());
        let gradient = DVec3::new(2.0 * cosine * growth, 1.5 * sine * growth, 0.0);
        let fit = Quadric::fit(&lattice, &field, node);
        let place = if lattice.is_interior(lattice.coordinates(node)) { 0 } else { 2 };
        worst[place] = worst[place].max((fit.gradient - gradient).length());
        let laplacian = (2.25 - 4.0) * sine * growth;
        worst[place + 1] = worst[place + 1].max((fit.laplacian() - laplacian).abs());
    }
    worst
}

#[test]
fn order_of_convergence_is_as_stated() {
    for connectivity in [Connectivity::Four, Connectivity::Eight] {
        let (coarse, fine) = (errors(connectivity, 33), errors(connectivity, 65));
        let order: [f64; 4] = std::array::from_fn(|index| (coarse[index] / fine[index]).log2());
        let stated = [2.0, 2.0, 2.0, 1.0];
        for (found, stated) in order.into_iter().zip(stated) {
            assert!((found - stated).abs() < 0.2, "{connectivity:?}: {order:?}");
        }
    }
}

#[test]
fn gradient_wraps_on_periodic_axes() {
    let lattice =
        Lattice::plane([8, 8], 1.0, Connectivity::Eight, [Boundary::Periodic; 2]).unwrap();
    let wave: Vec<f64> =
        (0..64).map(|node| (std::f64::consts::TAU * (node % 8) as f64 / 8.0).sin()).collect();
    let first = Quadric::fit(&lattice, &wave, 0).gradient.x;
    assert!((first - (std::f64::consts::TAU / 8.0).sin()).abs() < 1e-12);
}
