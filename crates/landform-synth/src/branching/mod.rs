//! Branching lines: what dendrites, aggregates and L-systems are made of.

mod nearest;
mod paint;
mod tubes;
mod width;

pub use paint::Shown;
pub use tubes::{TubeMesh, tubes};
pub use width::BranchWidth;

pub(crate) use paint::paint;

/// A forest of branches: nodes in space, each joined to its parent by a straight piece.
///
/// A parent stands before its children, so a walk through the nodes in their order meets every
/// tree from its root outwards.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Branching {
    /// Nodes: x east, y north, z up, in metres from the south-western node of the lowest layer.
    pub positions: Vec<[f64; 3]>,
    /// The node that each is joined to; none for the root of a tree.
    pub parents: Vec<Option<u32>>,
    /// Radius of the branch at each node, in metres.
    pub radii: Vec<f64>,
}

impl Branching {
    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there is no node.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Adds a node and returns its number.
    pub(crate) fn add(&mut self, position: [f64; 3], parent: Option<u32>, radius: f64) -> u32 {
        self.positions.push(position);
        self.parents.push(parent);
        self.radii.push(radius);
        (self.positions.len() - 1) as u32
    }

    /// Length of the piece between a node and its parent; 0 for roots.
    pub fn piece_m(&self, node: usize) -> f64 {
        self.parents[node]
            .map_or(0.0, |parent| distance(self.positions[node], self.positions[parent as usize]))
    }

    /// Length of the branches between every node and the root of its tree, in metres.
    pub fn root_lengths(&self) -> Vec<f64> {
        let mut lengths = vec![0.0; self.len()];
        for node in 0..self.len() {
            if let Some(parent) = self.parents[node] {
                lengths[node] = lengths[parent as usize] + self.piece_m(node);
            }
        }
        lengths
    }

    /// Number of the tree that every node belongs to, from 0 in the order of the roots.
    pub fn trees(&self) -> Vec<u32> {
        let mut trees = Vec::with_capacity(self.len());
        let mut roots = 0;
        for parent in &self.parents {
            trees.push(parent.map_or(roots, |parent| trees[parent as usize]));
            roots += u32::from(parent.is_none());
        }
        trees
    }

    /// Number of tips beyond every node; 1 for a tip itself.
    pub fn tips_beyond(&self) -> Vec<u32> {
        let mut tips = vec![0_u32; self.len()];
        for node in (0..self.len()).rev() {
            tips[node] = tips[node].max(1);
            if let Some(parent) = self.parents[node] {
                tips[parent as usize] += tips[node];
            }
        }
        tips
    }

    /// The child that carries on the branch of each node: the one with most tips beyond it, and
    /// of those with equally many the one that reaches farthest. None for tips.
    pub fn main_children(&self) -> Vec<Option<u32>> {
        let tips = self.tips_beyond();
        let mut reach = vec![0.0_f64; self.len()];
        for node in (0..self.len()).rev() {
            if let Some(parent) = self.parents[node] {
                let parent = parent as usize;
                reach[parent] = reach[parent].max(reach[node] + self.piece_m(node));
            }
        }
        let mut main: Vec<Option<u32>> = vec![None; self.len()];
        for node in 0..self.len() {
            let Some(parent) = self.parents[node] else { continue };
            let best = &mut main[parent as usize];
            let rank = |child: usize| (tips[child], reach[child] + self.piece_m(child));
            if best.is_none_or(|best| rank(node) > rank(best as usize)) {
                *best = Some(node as u32);
            }
        }
        main
    }

    /// The branches: lists of nodes from where a branch leaves another, or from a root, to its
    /// tip. Together they hold every piece once. The branch of a root comes before those that
    /// leave it.
    pub fn branches(&self) -> Vec<Vec<u32>> {
        let main = self.main_children();
        let carries_on = |node: usize| {
            self.parents[node].is_some_and(|parent| main[parent as usize] == Some(node as u32))
        };
        let mut branches = Vec::new();
        for node in (0..self.len()).filter(|&node| !carries_on(node)) {
            let from = self.parents[node].into_iter().chain([node as u32]);
            let mut branch: Vec<u32> = from.collect();
            let mut at = node;
            while let Some(next) = main[at] {
                branch.push(next);
                at = next as usize;
            }
            branches.push(branch);
        }
        branches
    }

    /// Strahler's order of every node: 1 at tips, one more where two branches of the same and
    /// greatest order meet.
    pub fn orders(&self) -> Vec<u32> {
        // Greatest order of the children so far, and whether two of them have it.
        let mut best = vec![(0_u32, false); self.len()];
        let mut orders = vec![1; self.len()];
        for node in (0..self.len()).rev() {
            let (greatest, twice) = best[node];
            orders[node] = (greatest + u32::from(twice)).max(1);
            if let Some(parent) = self.parents[node] {
                let best = &mut best[parent as usize];
                *best = match orders[node].cmp(&best.0) {
                    std::cmp::Ordering::Greater => (orders[node], false),
                    std::cmp::Ordering::Equal => (best.0, true),
                    std::cmp::Ordering::Less => *best,
                };
            }
        }
        orders
    }

    /// Smooths the courses, `passes` times: every node that has a parent and a child goes half way to
    /// the middle between its parent and the child that carries its branch on. Roots and tips stay.
    pub fn smooth(&mut self, passes: u32) {
        let main = self.main_children();
        for _ in 0..passes {
            let old = self.positions.clone();
            for (node, position) in self.positions.iter_mut().enumerate() {
                let (Some(parent), Some(child)) = (self.parents[node], main[node]) else {
                    continue;
                };
                let [before, after] = [old[parent as usize], old[child as usize]];
                *position = [0, 1, 2]
                    .map(|axis| (before[axis] + 2.0 * old[node][axis] + after[axis]) / 4.0);
            }
        }
    }

    /// Length by distance of the branches between a node and its root: 1 for straight ones. The
    /// mean over all tips that are not roots, 0 if there is none.
    pub fn tortuosity(&self) -> f64 {
        let (lengths, tips) = (self.root_lengths(), self.tips_beyond());
        let main = self.main_children();
        let mut roots: Vec<u32> = Vec::with_capacity(self.len());
        for (node, parent) in self.parents.iter().enumerate() {
            roots.push(parent.map_or(node as u32, |parent| roots[parent as usize]));
        }
        let (mut sum, mut count) = (0.0, 0);
        for node in 0..self.len() {
            let straight = distance(self.positions[node], self.positions[roots[node] as usize]);
            if tips[node] == 1 && main[node].is_none() && straight > 0.0 {
                sum += lengths[node] / straight;
                count += 1;
            }
        }
        if count == 0 { 0.0 } else { sum / f64::from(count) }
    }
}

/// Distance of two points.
pub(crate) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    (x * x + y * y + z * z).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A stem of four nodes with a twig at the second, and a root apart.
    fn shrub() -> Branching {
        let mut shrub = Branching::default();
        let root = shrub.add([0.0; 3], None, 1.0);
        let stem = shrub.add([0.0, 0.0, 1.0], Some(root), 1.0);
        let twig = shrub.add([1.0, 0.0, 1.0], Some(stem), 1.0);
        let next = shrub.add([0.0, 0.0, 2.0], Some(stem), 1.0);
        shrub.add([0.0, 0.0, 3.0], Some(next), 1.0);
        shrub.add([1.0, 1.0, 1.0], Some(twig), 1.0);
        shrub.add([9.0; 3], None, 1.0);
        shrub
    }

    #[test]
    fn branches_hold_every_piece_once() {
        let shrub = shrub();
        // Both reach two metres beyond the stem; the twig came first.
        assert_eq!(shrub.branches(), [vec![0, 1, 2, 5], vec![1, 3, 4], vec![6]]);
        assert_eq!(shrub.trees(), [0, 0, 0, 0, 0, 0, 1]);
        assert_eq!(shrub.tips_beyond(), [2, 2, 1, 1, 1, 1, 1]);
        assert_eq!(shrub.orders(), [2, 2, 1, 1, 1, 1, 1]);
        assert_eq!(shrub.root_lengths(), [0.0, 1.0, 2.0, 2.0, 3.0, 3.0, 0.0]);
    }

    #[test]
    fn smoothing_keeps_roots_tips_and_straight_lines() {
        let mut shrub = shrub();
        let before = shrub.clone();
        shrub.smooth(3);
        for node in [0, 4, 5, 6] {
            assert_eq!(shrub.positions[node], before.positions[node]);
        }
        assert!(shrub.tortuosity() < before.tortuosity());
        assert!(shrub.tortuosity() >= 1.0);
    }
}
