//! The nearest branch to a point, found through cells.

use super::Branching;

/// Cells along the longest side of the block around all branches and the lattice.
const CELLS: f64 = 128.0;

/// What is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Near {
    /// Distance to the surface of the branch in metres; negative inside.
    pub distance_m: f64,
    /// The node at the outer end of the piece.
    pub node: usize,
    /// Share of the piece from its inner end.
    pub along: f64,
}

/// The pieces of branches sorted into cells.
pub(super) struct Nearest<'a> {
    branching: &'a Branching,
    low: [f64; 3],
    side: f64,
    counts: [usize; 3],
    /// Where the pieces of each cell begin in the list.
    starts: Vec<u32>,
    pieces: Vec<u32>,
    thickest: f64,
}

impl<'a> Nearest<'a> {
    /// Sorts the pieces for points between two corners; `least` is the smallest side of a cell.
    pub fn new(branching: &'a Branching, corners: [[f64; 3]; 2], least: f64) -> Self {
        let [mut low, mut high] = corners;
        for position in &branching.positions {
            low = [0, 1, 2].map(|axis| low[axis].min(position[axis]));
            high = [0, 1, 2].map(|axis| high[axis].max(position[axis]));
        }
        let extent = [0, 1, 2].map(|axis| high[axis] - low[axis]);
        let longest = (0..branching.len()).map(|node| branching.piece_m(node)).fold(0.0, f64::max);
        let side = (extent.into_iter().fold(0.0, f64::max) / CELLS).max(least).max(longest / 8.0);
        let counts = extent.map(|extent| (extent / side) as usize + 1);
        let thickest = branching.radii.iter().copied().fold(0.0, f64::max);
        let (starts, pieces) = (Vec::new(), Vec::new());
        let mut nearest = Self { branching, low, side, counts, starts, pieces, thickest };
        nearest.sort();
        nearest
    }

    fn cell(&self, point: [f64; 3]) -> [usize; 3] {
        [0, 1, 2].map(|axis| {
            (((point[axis] - self.low[axis]) / self.side) as usize).min(self.counts[axis] - 1)
        })
    }

    fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        x + self.counts[0] * (y + self.counts[1] * z)
    }

    /// Ends of the piece that ends at a node: of the inner one, and of the outer one.
    fn ends(&self, node: usize) -> [usize; 2] {
        [self.branching.parents[node].map_or(node, |parent| parent as usize), node]
    }

    /// Numbers of the cells that a piece may touch.
    fn touched(&self, node: usize) -> impl Iterator<Item = usize> + '_ {
        let [a, b] = self.ends(node).map(|end| self.cell(self.branching.positions[end]));
        let range = move |axis: usize| a[axis].min(b[axis])..=a[axis].max(b[axis]);
        range(2).flat_map(move |z| {
            range(1).flat_map(move |y| range(0).map(move |x| self.number([x, y, z])))
        })
    }

    fn sort(&mut self) {
        let mut counts = vec![0_u32; self.counts.iter().product::<usize>() + 1];
        for node in 0..self.branching.len() {
            self.touched(node).for_each(|cell| counts[cell + 1] += 1);
        }
        for cell in 1..counts.len() {
            counts[cell] += counts[cell - 1];
        }
        let mut pieces = vec![0; counts.last().map_or(0, |&count| count as usize)];
        let mut next = counts.clone();
        for node in 0..self.branching.len() {
            for cell in self.touched(node) {
                pieces[next[cell] as usize] = node as u32;
                next[cell] += 1;
            }
        }
        (self.starts, self.pieces) = (counts, pieces);
    }

    /// What is nearest to a point among the branches whose surface is within `reach` metres. Of
    /// pieces that are equally near the first one counts.
    pub fn find(&self, point: [f64; 3], reach: f64) -> Option<Near> {
        let home = self.cell(point);
        let mut best: Option<Near> = None;
        let rings = *self.counts.iter().max().unwrap_or(&1);
        for ring in 0..=rings {
            self.each_cell(home, ring, |cell| {
                let range = self.starts[cell] as usize..self.starts[cell + 1] as usize;
                for &node in &self.pieces[range] {
                    let near = self.measure(point, node as usize);
                    let rank = |near: &Near| (near.distance_m, near.node);
                    if near.distance_m <= reach && best.is_none_or(|best| rank(&near) < rank(&best))
                    {
                        best = Some(near);
                    }
                }
            });
            let rest_m = ring as f64 * self.side - self.thickest;
            if rest_m > reach || best.is_some_and(|best| best.distance_m < rest_m) {
                break;
            }
        }
        best
    }

    /// Calls `visit` with the cells that are `ring` cells away.
    fn each_cell(&self, home: [usize; 3], ring: usize, mut visit: impl FnMut(usize)) {
        let range = |axis: usize| {
            home[axis].saturating_sub(ring)..=(home[axis] + ring).min(self.counts[axis] - 1)
        };
        for z in range(2) {
            for y in range(1) {
                let shell = z.abs_diff(home[2]) == ring || y.abs_diff(home[1]) == ring;
                if shell {
                    range(0).for_each(|x| visit(self.number([x, y, z])));
                    continue;
                }
                let ends = [home[0].checked_sub(ring), home[0].checked_add(ring)];
                for x in ends.into_iter().flatten().filter(|&x| x < self.counts[0]) {
                    visit(self.number([x, y, z]));
                }
            }
        }
    }

    /// Distance to a piece, a cone with round ends.
    fn measure(&self, point: [f64; 3], node: usize) -> Near {
        let [inner, outer] = self.ends(node);
        let [a, b] = [inner, outer].map(|end| self.branching.positions[end]);
        let piece = [0, 1, 2].map(|axis| b[axis] - a[axis]);
        let from = [0, 1, 2].map(|axis| point[axis] - a[axis]);
        let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let length = dot(piece, piece);
        let along = if length > 0.0 { (dot(from, piece) / length).clamp(0.0, 1.0) } else { 1.0 };
        let foot = [0, 1, 2].map(|axis| a[axis] + along * piece[axis]);
        let [thick, thin] = [inner, outer].map(|end| self.branching.radii[end]);
        let radius = thick + along * (thin - thick);
        Near { distance_m: super::distance(point, foot) - radius, node, along }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_sim::random::RandomStream;

    /// Cells find what looking at every piece finds.
    #[test]
    fn cells_find_the_nearest_piece() {
        let random = RandomStream::new(5, "nearest");
        let place =
            |n: usize| [0, 1, 2].map(|axis| 80.0 * random.unit(0, n, axis)).map(|x| x - 10.0);
        let mut branching = Branching::default();
        for node in 0..120_usize {
            let parent = (node % 7 != 0).then(|| node as u32 - 1);
            let step = place(node).map(|x| x * 0.1);
            let at = parent.map_or(place(node), |parent| {
                let from = branching.positions[parent as usize];
                [0, 1, 2].map(|axis| from[axis] + step[axis] - 3.0)
            });
            branching.add(at, parent, 0.5 + random.unit(1, node, 0));
        }
        let nearest = Nearest::new(&branching, [[-20.0; 3], [90.0; 3]], 2.0);
        for query in 0..400 {
            let point = place(1000 + query);
            let all = (0..branching.len()).map(|node| nearest.measure(point, node));
            let expected = all.min_by(|a, b| {
                (a.distance_m, a.node).partial_cmp(&(b.distance_m, b.node)).unwrap()
            });
            assert_eq!(nearest.find(point, f64::INFINITY), expected);
            let close = expected.filter(|near| near.distance_m <= 3.0);
            assert_eq!(nearest.find(point, 3.0), close);
        }
    }
}
