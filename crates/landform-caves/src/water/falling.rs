//! Water that only falls.

use landform_graph::{Edge, Lattice};

use super::{Pores, Rule, reduce};

/// The water column carried to voxels (thesis, section 5.1 and figure 5.2): the nine neighbours below
/// are filled first, then the level among the eight beside is made equal. Water never rises.
///
/// Straight down comes first, then over edges, then over corners, as far as there is room; within such
/// a class in proportion to the room. What is left evens out how full the voxel and the emptier ones
/// beside it are. On a plane, which is a section, rows to the south are below.
#[derive(Clone, Copy, Debug, Default)]
pub struct Falling;

/// Layers that an edge goes down: 1, 0 or -1.
#[inline]
fn fall(lattice: &Lattice, step: [i8; 3]) -> i8 {
    if lattice.connectivity().is_volume() { -step[2] } else { step[1] }
}

/// Number of axes that a step moves along.
fn axes(step: [i8; 3]) -> usize {
    step.iter().filter(|along| **along != 0).count()
}

impl Rule for Falling {
    fn offer(
        &self,
        lattice: &Lattice,
        pores: &Pores<'_>,
        node: usize,
        offers: &mut Vec<(u32, u32)>,
    ) {
        let mut left = pores.contents(node);
        for moved in 1..=3 {
            let below = |edge: &Edge| fall(lattice, edge.step) > 0 && axes(edge.step) == moved;
            let first = offers.len();
            let edges = lattice.neighbours(node).filter(below);
            offers.extend(edges.map(|edge| (edge.node as u32, pores.room(edge.node))));
            reduce(&mut offers[first..], left);
            left -= offers[first..].iter().map(|offer| offer.1).sum::<u32>();
        }
        if left > 0 {
            even_out(lattice, pores, node, left, offers);
        }
    }

    fn leads(&self, lattice: &Lattice, from: usize, to: usize) -> bool {
        crate::place::height(lattice, from) > crate::place::height(lattice, to)
    }
}

/// Offers of what is `left` to the emptier voxels beside.
fn even_out(
    lattice: &Lattice,
    pores: &Pores<'_>,
    node: usize,
    left: u32,
    offers: &mut Vec<(u32, u32)>,
) {
    let share = |contents: u32, node: usize| f64::from(contents) / f64::from(pores.capacity(node));
    let here = share(left, node);
    let emptier = |edge: &Edge| {
        let level = fall(lattice, edge.step) == 0;
        level && pores.room(edge.node) > 0 && share(pores.contents(edge.node), edge.node) < here
    };
    let beside = || lattice.neighbours(node).filter(emptier).map(|edge| edge.node);
    let (mut contents, mut capacity) = (f64::from(left), f64::from(pores.capacity(node)));
    for node in beside() {
        contents += f64::from(pores.contents(node));
        capacity += f64::from(pores.capacity(node));
    }
    let even = contents / capacity;
    let first = offers.len();
    offers.extend(beside().map(|node| {
        let wanted = even * f64::from(pores.capacity(node)) - f64::from(pores.contents(node));
        (node as u32, (wanted.max(0.0) as u32).min(pores.room(node)))
    }));
    reduce(&mut offers[first..], left);
}
