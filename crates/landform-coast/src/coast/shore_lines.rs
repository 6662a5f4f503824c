//! The shore as lines: the sides of land nodes that face the sea, one after another.

use super::Shore;
use super::compass::SIDES;
use super::marks::Marks;
use super::sides::{Side, begins, next_side, parts_of, side_of};
use super::stretch::{MOST_SIDES, NOWHERE, Stretch, place_of, stretch_of};

/// All lines of a shore, traced with land on the left, in short stretches.
///
/// When land falls, the stretches with sides of the nodes around it are taken away, and what is
/// missing is traced anew: on from the stretches that are left, from borders, and along lines
/// that are new as a whole. The other stretches stay as they are.
///
/// Cost: constant a side of the stretches where something changes. Memory: about 25 bytes a side.
#[derive(Clone, Debug, Default)]
pub(super) struct ShoreLines {
    stretches: Vec<Stretch>,
    /// Stretches that were taken away, to be used again.
    free: Vec<u32>,
    /// Stretches to be taken away.
    cut: Vec<u32>,
    /// Nodes with sides that may have no place.
    loose: Vec<u32>,
    /// The sides of a run that is traced, and the columns and rows of their nodes in the order of
    /// the run.
    run: Vec<(Side, [i32; 2])>,
}

/// What a traced run begins or ends with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    /// An open border.
    Border,
    /// Another stretch, and what its places have to be moved by to be places of the run.
    Stretch(u32, [i32; 2]),
    /// The run itself, which has moved by so much when it comes back.
    Itself([i32; 2]),
}

impl ShoreLines {
    /// A stretch.
    #[inline]
    pub(super) fn stretch(&self, stretch: u32) -> &Stretch {
        &self.stretches[stretch as usize]
    }

    /// What lies around a land node changes, or the node is new on the coast.
    pub(super) fn loosen(&mut self, node: usize) {
        self.loose.push(node as u32);
    }

    /// The stretches of these places do not hold any more.
    pub(super) fn cut(&mut self, places: [u32; 4]) {
        for place in places.into_iter().filter(|&place| place != NOWHERE) {
            let (number, _) = stretch_of(place);
            let stretch = &mut self.stretches[number as usize];
            if !std::mem::replace(&mut stretch.is_cut, true) {
                self.cut.push(number);
            }
        }
    }

    /// Makes the lines follow the shore, whose nodes are `marks` among others.
    pub(super) fn refresh(&mut self, shore: &Shore, marks: &mut Marks) {
        for index in 0..self.loose.len() {
            if let Some(slot) = marks.slot(self.loose[index] as usize) {
                self.cut(marks.places[slot]);
            }
        }
        for end in self.take_away(marks) {
            self.trace_on(shore, marks, end);
        }
        let loose = std::mem::take(&mut self.loose);
        let open = [0, 1].iter().any(|&axis| !shore.lattice().is_periodic(axis));
        if open {
            // Lines that end at borders are traced from their beginnings.
            loose.iter().for_each(|&node| self.trace_from(shore, marks, node as usize, begins));
        }
        loose.iter().for_each(|&node| self.trace_from(shore, marks, node as usize, |_, _, _| true));
        self.loose = loose;
        self.loose.clear();
    }

    /// Takes the stretches away that are cut, and gives those whose ends are open then.
    fn take_away(&mut self, marks: &mut Marks) -> Vec<u32> {
        let mut ends = Vec::new();
        for number in std::mem::take(&mut self.cut) {
            let Self { stretches, loose, .. } = self;
            let stretch = &stretches[number as usize];
            for &side in stretch.sides() {
                let (node, direction) = parts_of(side);
                if let Some(slot) = marks.slot(node) {
                    marks.places[slot][direction] = NOWHERE;
                    loose.push(node as u32);
                }
            }
            let [previous, next] = [stretch.previous, stretch.next];
            if let Some(before) = stretches.get_mut(previous as usize)
                && !before.is_cut
            {
                before.next = NOWHERE;
                ends.push(previous);
            }
            if let Some(next) = stretches.get_mut(next as usize) {
                next.previous = NOWHERE;
            }
            self.free.push(number);
        }
        ends
    }

    /// Traces on from the last side of a stretch.
    fn trace_on(&mut self, shore: &Shore, marks: &mut Marks, number: u32) {
        let stretch = self.stretch(number);
        let (last, at) = (stretch.sides[stretch.count - 1], stretch.at[stretch.count - 1]);
        let end = self.trace(shore, marks, last, at);
        self.lay(shore, marks, End::Stretch(number, [0; 2]), end);
    }

    /// Traces the lines from those sides of a node without a place that may begin one.
    fn trace_from(
        &mut self,
        shore: &Shore,
        marks: &mut Marks,
        node: usize,
        may_begin: impl Fn(&Shore, usize, usize) -> bool,
    ) {
        let Some(slot) = marks.slot(node) else { return };
        let exposed = shore.around(node) & SIDES;
        for direction in (0..4).filter(|direction| exposed >> direction & 1 == 1) {
            if marks.places[slot][direction] != NOWHERE || !may_begin(shore, node, direction) {
                continue;
            }
            let side = side_of(node, direction);
            let at = shore.place(node).map(|along| along as i32);
            self.run.push((side, at));
            match self.trace(shore, marks, side, at) {
                End::Itself(winding) => {
                    self.lay(shore, marks, End::Itself(winding), End::Itself(winding));
                }
                end => self.lay(shore, marks, End::Border, end),
            }
        }
    }

    /// Adds the sides that follow `side` to the run, up to one that has a place, to the first side
    /// of the run or to a border.
    fn trace(&mut self, shore: &Shore, marks: &Marks, mut side: Side, mut at: [i32; 2]) -> End {
        let first = self.run.first().copied();
        let mut here = shore.place(parts_of(side).0);
        while let Some((next, step, there)) = next_side(shore, side, here) {
            at = [0, 1].map(|axis| at[axis] + step[axis] as i32);
            if let Some((_, begun)) = first.filter(|&(first, _)| first == next) {
                return End::Itself([0, 1].map(|axis| at[axis] - begun[axis]));
            }
            let (node, direction) = parts_of(next);
            let place = marks.slot(node).map_or(NOWHERE, |slot| marks.places[slot][direction]);
            if place != NOWHERE {
                return self.meet(stretch_of(place).0, at);
            }
            self.run.push((next, at));
            (side, here) = (next, there);
        }
        End::Border
    }

    /// The end of a run at the first side of a stretch, which lies at `at` as the run has it.
    fn meet(&self, number: u32, at: [i32; 2]) -> End {
        let first = self.stretch(number).at[0];
        End::Stretch(number, [0, 1].map(|axis| at[axis] - first[axis]))
    }

    /// Lays the run between its ends in stretches of about the same length.
    fn lay(&mut self, shore: &Shore, marks: &mut Marks, start: End, end: End) {
        let end = self.absorb(start, end);
        let mut run = std::mem::take(&mut self.run);
        let (mut last, mut shift) = match start {
            End::Stretch(number, shift) => (number, shift),
            _ => (NOWHERE, [0; 2]),
        };
        let mut first = NOWHERE;
        let count = run.len().div_ceil(MOST_SIDES);
        for part in 0..count {
            let sides = &run[part * run.len() / count..(part + 1) * run.len() / count];
            let (number, moved) = self.put(shore, marks, sides);
            let by = [0, 1].map(|axis| moved[axis] - shift[axis]);
            if last != NOWHERE {
                self.link(last, number, by);
            }
            first = if part == 0 { number } else { first };
            (last, shift) = (number, moved);
        }
        match end {
            End::Border => {}
            End::Stretch(number, moved) => {
                self.link(last, number, [0, 1].map(|axis| moved[axis] - shift[axis]));
            }
            // A run that comes back began on the map where its first stretch does.
            End::Itself(winding) => {
                self.link(last, first, [0, 1].map(|axis| winding[axis] - shift[axis]));
            }
        }
        run.clear();
        self.run = run;
    }

    /// Adds the stretch to a short run that it meets, so that stretches do not become ever
    /// shorter; gives the end of the longer run.
    fn absorb(&mut self, start: End, end: End) -> End {
        let End::Stretch(number, moved) = end else { return end };
        let stretch = &self.stretches[number as usize];
        let is_start = matches!(start, End::Stretch(start, _) if start == number);
        // One without a successor may have lost it, and waits for being traced on from.
        let is_short = (1..MOST_SIDES / 2).contains(&self.run.len());
        if is_start || stretch.next == NOWHERE || !is_short {
            return end;
        }
        let move_by = |at: [i32; 2], by: [i32; 2]| [0, 1].map(|axis| at[axis] + by[axis]);
        let sides = stretch.sides().iter().zip(&stretch.at);
        self.run.extend(sides.map(|(&side, &at)| (side, move_by(at, moved))));
        self.free.push(number);
        let next = stretch.next;
        let end = End::Stretch(next, move_by(moved, stretch.shift));
        self.stretches[next as usize].previous = NOWHERE;
        end
    }

    /// Stores sides as a stretch and gives its number and what its places have to be moved by to
    /// be places of the run.
    fn put(
        &mut self,
        shore: &Shore,
        marks: &mut Marks,
        sides: &[(Side, [i32; 2])],
    ) -> (u32, [i32; 2]) {
        let on_map = shore.place(parts_of(sides[0].0).0);
        let moved = [0, 1].map(|axis| sides[0].1[axis] - on_map[axis] as i32);
        let stretch = Stretch::new(sides.iter().map(|&(side, at)| {
            let (node, direction) = parts_of(side);
            let at = [0, 1].map(|axis| at[axis] - moved[axis]);
            (side, at, shore.side_lengths(node, shore.place(node))[direction])
        }));
        let number = match self.free.pop() {
            Some(number) => {
                self.stretches[number as usize] = stretch;
                number
            }
            None => {
                self.stretches.push(stretch);
                self.stretches.len() as u32 - 1
            }
        };
        for (index, &(side, _)) in sides.iter().enumerate() {
            let (node, direction) = parts_of(side);
            if let Some(slot) = marks.slot(node) {
                marks.places[slot][direction] = place_of(number, index);
            }
        }
        (number, moved)
    }

    /// Lets a stretch follow another.
    fn link(&mut self, from: u32, to: u32, shift: [i32; 2]) {
        let stretch = &mut self.stretches[from as usize];
        (stretch.next, stretch.shift) = (to, shift);
        self.stretches[to as usize].previous = from;
    }
}

#[cfg(test)]
mod tests;
