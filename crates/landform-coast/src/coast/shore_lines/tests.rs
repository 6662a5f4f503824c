//! Lines that are kept up to date hold the shore, side by side.

use super::*;
use crate::coast::compass::beside;
use crate::coast::testing::{any_land, any_lattice};
use landform_graph::{Boundary, Connectivity, Lattice};
use landform_sim::random::RandomStream;
use proptest::prelude::*;

/// A coast whose lines are kept up to date.
struct Traced {
    shore: Shore,
    marks: Marks,
    lines: ShoreLines,
}

impl Traced {
    fn new(lattice: &Lattice, land: &[u8]) -> Self {
        let mut traced = Self {
            shore: Shore::new(lattice, land),
            marks: Marks::new(land.len()),
            lines: ShoreLines::default(),
        };
        (0..land.len()).filter(|&node| land[node] > 0).for_each(|node| traced.touch(node));
        traced.lines.refresh(&traced.shore, &mut traced.marks);
        traced
    }

    fn touch(&mut self, node: usize) {
        if self.shore.around(node) != 0 {
            self.marks.set(node, 1.0, 1.0);
            self.lines.loosen(node);
        }
    }

    /// Lets nodes of the coast fall.
    fn fell(&mut self, land: &mut [u8], nodes: &[usize]) {
        let mut touched = Vec::new();
        for &node in nodes {
            land[node] = 0;
            self.lines.cut(self.marks.remove(node).1);
            self.shore.drown(node);
        }
        for &node in nodes {
            self.shore.surround(node, |other| touched.push(other));
        }
        for node in touched {
            self.shore.measure(node, self.shore.place(node));
            self.touch(node);
        }
        self.lines.refresh(&self.shore, &mut self.marks);
    }

    /// The stretches that hold the shore.
    fn stretches(&self) -> impl Iterator<Item = (u32, &Stretch)> {
        let all = 0..self.lines.stretches.len() as u32;
        let in_use = all.filter(|number| !self.lines.free.contains(number));
        in_use.map(|number| (number, self.lines.stretch(number)))
    }

    /// Checks that stretches hold every side once, in the order of the shore.
    fn check(&self, land: &[u8]) -> Result<(), TestCaseError> {
        let mut seen = vec![0; 4 * land.len()];
        for (number, stretch) in self.stretches() {
            prop_assert!(!stretch.is_cut && stretch.count > 0);
            for (index, &side) in stretch.sides().iter().enumerate() {
                seen[side as usize] += 1;
                self.check_side(number, stretch, index)?;
            }
        }
        for (side, &seen) in seen.iter().enumerate() {
            let (node, direction) = parts_of(side as Side);
            let at = self.shore.place(node);
            let sea = beside(self.shore.lattice(), at, direction).is_some_and(|n| land[n] == 0);
            prop_assert_eq!(seen, u32::from(land[node] > 0 && sea));
        }
        Ok(())
    }

    fn check_side(
        &self,
        number: u32,
        stretch: &Stretch,
        index: usize,
    ) -> Result<(), TestCaseError> {
        let (node, direction) = parts_of(stretch.sides[index]);
        let slot = self.marks.slot(node).expect("a mark");
        prop_assert_eq!(self.marks.places[slot][direction], place_of(number, index));
        let here = self.shore.place(node);
        let lengths = self.shore.side_lengths(node, here);
        prop_assert_eq!(stretch.length(index, index + 1), u64::from(lengths[direction]));
        let at = stretch.at[index];
        prop_assert!(
            (0..2).all(|axis| (stretch.low[axis]..=stretch.high[axis]).contains(&at[axis]))
        );
        let next = next_side(&self.shore, stretch.sides[index], here);
        let (following, shift, place) = match index + 1 < stretch.count {
            true => (stretch, [0; 2], index + 1),
            false if stretch.next == NOWHERE => {
                prop_assert!(next.is_none());
                return Ok(());
            }
            false => (self.lines.stretch(stretch.next), stretch.shift, 0),
        };
        if place == 0 {
            prop_assert_eq!(following.previous, number);
            let first = self.shore.place(parts_of(following.sides[0]).0);
            prop_assert_eq!(following.at[0], first.map(|along| along as i32));
        }
        let (side, step, _) = next.expect("a side");
        prop_assert_eq!(following.sides[place], side);
        for axis in 0..2 {
            let there = following.at[place][axis] + shift[axis];
            prop_assert_eq!(there - at[axis], step[axis] as i32);
        }
        Ok(())
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn lines_follow_the_shore(
        lattice in any_lattice(),
        seed in 0_u64..500,
        share in 1_usize..20,
    ) {
        let mut land = any_land(&lattice, seed);
        let mut traced = Traced::new(&lattice, &land);
        traced.check(&land)?;
        let random = RandomStream::new(seed, "fall");
        for turn in 0..8 {
            let mut nodes = traced.marks.nodes.clone();
            nodes.sort_unstable();
            let falls = |node: usize| random.block(turn, node, 0)[0] as usize % 20 < share;
            let nodes: Vec<usize> = nodes.iter().map(|&node| node as usize).collect();
            let nodes: Vec<usize> = nodes.into_iter().filter(|&node| falls(node)).collect();
            traced.fell(&mut land, &nodes);
            traced.check(&land)?;
        }
    }
}

/// What is traced again and again stays in stretches that are worth their name.
#[test]
fn stretches_do_not_become_ever_shorter() {
    let boundary = [Boundary::Periodic, Boundary::Open];
    let lattice = Lattice::plane([200, 100], 1.0, Connectivity::Four, boundary).unwrap();
    let mut land: Vec<u8> = (0..20_000).map(|node| u8::from(node >= 600)).collect();
    let mut traced = Traced::new(&lattice, &land);
    let random = RandomStream::new(1, "fall");
    for turn in 0..2000 {
        let nodes = &traced.marks.nodes;
        let node = nodes[random.block(turn, 0, 0)[0] as usize % nodes.len()] as usize;
        traced.fell(&mut land, &[node]);
    }
    traced.check(&land).unwrap();
    let count = traced.stretches().count();
    let lines = traced.stretches().filter(|(number, stretch)| stretch.next == *number).count();
    let sides: usize = traced.stretches().map(|(_, stretch)| stretch.count).sum();
    // Islands are short lines of their own.
    assert!(sides > 12 * (count - lines), "{sides} sides, {count} stretches, {lines} islands");
}

#[test]
fn corners_that_touch_follow_the_edges_of_the_lattice() {
    // Land at (1, 1) and (2, 2), whose columns and rows add to even numbers.
    let mut land = [0; 16];
    (land[5], land[10]) = (1, 1);
    let mut other = [0; 16];
    (other[6], other[9]) = (1, 1);
    for (connectivity, even, odd) in
        [(Connectivity::Four, 1, 1), (Connectivity::FourEight, 1, 2), (Connectivity::Eight, 2, 2)]
    {
        let lattice = Lattice::plane([4, 4], 1.0, connectivity, [Boundary::Open; 2]).unwrap();
        // Lines this short are one stretch each.
        let lines = |land: &[u8]| Traced::new(&lattice, land).stretches().count();
        assert_eq!([lines(&land), lines(&other)], [even, odd], "{connectivity:?}");
    }
}
