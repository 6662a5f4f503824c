//! Which coast nodes are weaker than the sea, without a look at those where nothing has changed.

use landform_graph::Lattice;

use super::arcs::Arcs;
use super::disc_sums::DiscSums;
use super::marks::Marks;
use super::regions::Rule;
use super::sea::Sea;
use super::weakest::Weakest;
use super::{Perimeter, Shore};

/// How the perimeter at a place is found, and which nodes it may leave too weak.
#[derive(Clone, Debug)]
pub(super) enum Watch {
    /// The force is the same everywhere under one rule: the weakest nodes under each.
    Whole(Vec<Weakest>),
    /// The shore within the radius of each node, beside the least with which it stands.
    Near(Box<DiscSums>),
    /// The shore itself, and where it has changed.
    Contiguous(Box<Arcs>),
}

impl Watch {
    /// For a kind of perimeter on a lattice.
    pub(super) fn new(lattice: &Lattice, perimeter: Perimeter, sea: &Sea) -> Self {
        let spacing = lattice.spacing();
        match perimeter {
            Perimeter::Whole => Self::Whole(shelves(sea)),
            Perimeter::Near { radius_m } => {
                Self::Near(Box::new(DiscSums::new(lattice, radius_m / spacing)))
            }
            Perimeter::Contiguous { radius_m } => {
                Self::Contiguous(Box::new(Arcs::new(lattice, radius_m / spacing)))
            }
        }
    }

    /// The strength of a coast node has changed.
    pub(super) fn strength(&mut self, sea: &Sea, shore: &Shore, marks: &mut Marks, node: usize) {
        let Some(slot) = marks.slot(node) else { return };
        let strength = marks.strengths[slot];
        match self {
            Self::Whole(weakest) => weakest[sea.rules.number(node)].note(node, strength),
            Self::Near(sums) => {
                let limit = sea.least_perimeter(node, strength);
                let before = std::mem::replace(&mut marks.limits[slot], limit);
                sums.move_limit(node, limit - before);
            }
            Self::Contiguous(arcs) => {
                arcs.strength(shore.place(node), sea.can_fell(node, strength))
            }
        }
    }

    /// The force has changed at every place.
    pub(super) fn pressure(&mut self, sea: &Sea, shore: &Shore, marks: &mut Marks) {
        if let Self::Whole(weakest) = self {
            *weakest = shelves(sea);
        }
        for slot in 0..marks.nodes.len() {
            self.strength(sea, shore, marks, marks.nodes[slot] as usize);
        }
        if let Self::Contiguous(arcs) = self {
            arcs.change_all();
        }
        self.refresh(shore, marks);
    }

    /// Something around a node has changed, and the length of its shore by an amount in parts.
    #[inline]
    pub(super) fn touched(&mut self, node: usize, at: [usize; 2], change: i32) {
        match self {
            Self::Near(sums) if change != 0 => sums.add(at, change),
            Self::Contiguous(arcs) => arcs.touch(node),
            _ => {}
        }
    }

    /// A node has left the coast, where it had a limit and its sides had places; its shore has
    /// changed by an amount in parts.
    #[inline]
    pub(super) fn fallen(
        &mut self,
        node: usize,
        at: [usize; 2],
        change: i32,
        limit: i32,
        places: [u32; 4],
    ) {
        match self {
            Self::Whole(_) => {}
            Self::Near(sums) => {
                sums.add(at, change);
                sums.move_limit(node, -limit);
            }
            Self::Contiguous(arcs) => arcs.fall(at, places),
        }
    }

    /// Brings perimeters up to date.
    pub(super) fn refresh(&mut self, shore: &Shore, marks: &mut Marks) {
        match self {
            Self::Whole(_) => {}
            Self::Near(sums) => sums.refresh(),
            Self::Contiguous(arcs) => arcs.refresh(shore, marks),
        }
    }

    /// The perimeter of a coast node, as a multiple of its measure: `initial`, the whole shore at
    /// the beginning in parts, or a straight coast across the disc.
    #[inline]
    pub(super) fn perimeter(
        &self,
        sea: &Sea,
        shore: &Shore,
        marks: &Marks,
        node: usize,
        initial: u64,
    ) -> f64 {
        match self {
            Self::Whole(_) => shore.total() as f64 / initial as f64,
            Self::Near(sums) => {
                let limit = marks.slot(node).map_or(0, |slot| marks.limits[slot]);
                sea.local((i64::from(sums.margin(node)) + i64::from(limit)) as u64)
            }
            Self::Contiguous(arcs) => sea.local(arcs.length(shore, marks, node)),
        }
    }

    /// Names the coast nodes that are weaker than the sea, some of them twice.
    pub(super) fn take_weak(
        &mut self,
        sea: &Sea,
        shore: &Shore,
        marks: &Marks,
        initial: u64,
        weak: &mut Vec<u32>,
    ) {
        match self {
            Self::Whole(weakest) => {
                let perimeter = shore.total() as f64 / initial as f64;
                for (weakest, rule) in weakest.iter_mut().zip(sea.rules.all()) {
                    weakest.take_below(sea.pressure * rule.force_at(perimeter), marks, weak);
                }
            }
            Self::Near(sums) => sums.take_below(weak),
            Self::Contiguous(arcs) => {
                let mut concerned = Vec::new();
                arcs.take_concerned(|node| concerned.push(node));
                weak.extend(concerned.into_iter().filter_map(|node| {
                    let strength = marks.strengths[marks.slot(node)?];
                    let perimeter = sea.local(arcs.length(shore, marks, node));
                    (strength < sea.force(node, perimeter)).then_some(node as u32)
                }));
            }
        }
    }
}

/// Empty shelves for the force of each rule.
fn shelves(sea: &Sea) -> Vec<Weakest> {
    let most = |rule: &Rule| sea.pressure * rule.force;
    sea.rules.all().iter().map(|rule| Weakest::new(most(rule))).collect()
}
