//! Stream networks as lines between their junctions.

use std::collections::VecDeque;

use super::FlowDirections;

/// A link of a stream network: a stream from its head, or from a junction, down to the next
/// junction or to where it leaves the terrain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StreamLink {
    /// Its cells from the head down. The cell of the junction where it ends is the last one; it
    /// is the first one of the link below too.
    pub cells: Vec<usize>,
    /// Strahler's order.
    pub order: u8,
    /// Number of the link that it flows into; none where it leaves.
    pub next: Option<usize>,
}

impl StreamLink {
    /// The cells of its own, without that of the junction where it ends.
    pub fn own_cells(&self) -> &[usize] {
        &self.cells[..self.cells.len() - usize::from(self.next.is_some())]
    }

    /// Length in metres from the middle of its first cell to that of its last one.
    pub fn length_m(&self, directions: &FlowDirections) -> f64 {
        let steps = directions.grid().step_lengths();
        let step =
            |cell: &usize| directions.direction(*cell).map_or(0.0, |d| steps[usize::from(d)]);
        self.cells[..self.cells.len() - 1].iter().map(step).sum()
    }
}

/// The links of the network whose cells have an order above 0 ([`super::stream_orders`]), by
/// their first cells.
pub fn stream_links(directions: &FlowDirections, orders: &[u8]) -> Vec<StreamLink> {
    let below = |cell: usize| directions.receiver(cell).filter(|&next| orders[next] > 0);
    let mut inflows = vec![0_u8; orders.len()];
    let channel = |cell: &usize| orders[*cell] > 0;
    (0..orders.len()).filter(channel).filter_map(below).for_each(|next| inflows[next] += 1);
    let begins = |cell: usize| orders[cell] > 0 && inflows[cell] != 1;
    let firsts: Vec<usize> = (0..orders.len()).filter(|&cell| begins(cell)).collect();
    let link = |&first: &usize| {
        let mut cells = vec![first];
        let mut next = below(first);
        while let Some(cell) = next {
            cells.push(cell);
            next = if begins(cell) { None } else { below(cell) };
        }
        let last = cells[cells.len() - 1];
        let joined = (cells.len() > 1).then(|| firsts.binary_search(&last).ok()).flatten();
        StreamLink { order: orders[first], cells, next: joined }
    };
    firsts.iter().map(link).collect()
}

/// Number of wet cells of each link: those of its channel, and those nearest to them over wet
/// cells. With the length of the link they give the width of its river.
pub fn wet_cells(
    directions: &FlowDirections,
    links: &[StreamLink],
    wet: impl Fn(usize) -> bool,
) -> Vec<usize> {
    let mut owner = vec![None; directions.grid().cell_count()];
    let mut counts = vec![0; links.len()];
    let mut front = VecDeque::new();
    for (number, link) in links.iter().enumerate() {
        for &cell in link.own_cells() {
            owner[cell] = Some(number);
            counts[number] += 1;
            front.push_back((cell, number));
        }
    }
    while let Some((cell, number)) = front.pop_front() {
        for (_, near) in directions.grid().neighbours(cell) {
            if owner[near].is_none() && wet(near) {
                owner[near] = Some(number);
                counts[number] += 1;
                front.push_back((near, number));
            }
        }
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Grid;
    use crate::hydrology::testing::terrains;
    use crate::hydrology::{fill_depressions, stream_orders};

    /// Two valleys that join in the middle and leave in the south.
    fn fork() -> (FlowDirections, Vec<u8>) {
        let grid = Grid::new([9, 9], [10.0; 2]).unwrap();
        let height = |cell: usize| {
            let [column, row] = grid.position(cell).map(|index| index as f64);
            let axis = if row < 4.0 { 4.0 - row } else { 0.0 };
            let side = ((column - 4.0).abs() - axis).abs();
            5.0 * side + 8.0 - row
        };
        let heights: Vec<f64> = (0..81).map(height).collect();
        let directions = FlowDirections::steepest(&grid, &heights).unwrap();
        let orders = stream_orders(&directions, &directions.contributing_cells(), 5);
        (directions, orders)
    }

    #[test]
    fn two_streams_meet_and_go_on_as_one() {
        let (directions, orders) = fork();
        let links = stream_links(&directions, &orders);
        assert_eq!(links.len(), 3, "{links:?}");
        let trunk = links.iter().position(|link| link.next.is_none()).unwrap();
        assert_eq!(links[trunk].order, 2);
        assert_eq!(links[trunk].cells.last(), Some(&76), "the middle of the southern row");
        for link in links.iter().filter(|link| link.next.is_some()) {
            assert_eq!((link.order, link.next), (1, Some(trunk)));
            assert_eq!(link.cells.last(), links[trunk].cells.first());
        }
        let length = links[trunk].length_m(&directions);
        assert!((length - 10.0 * (links[trunk].cells.len() - 1) as f64).abs() < 1e-9);
        // The trunk is three cells wide, its tributaries one.
        let wet = |cell: usize| cell / 9 > 5 && (3..6).contains(&(cell % 9));
        let counts = wet_cells(&directions, &links, wet);
        assert_eq!(counts[trunk], links[trunk].cells.len() + 2 * 3);
        let own: usize = links.iter().map(|link| link.own_cells().len()).sum();
        assert_eq!(counts.iter().sum::<usize>(), own + 6);
    }

    /// Every channel cell lies on one link, links follow receivers, and orders do not fall.
    #[test]
    fn networks_of_rough_terrain_are_whole() {
        for (grid, heights) in terrains() {
            let filled = fill_depressions(&grid, &heights).unwrap();
            let directions = FlowDirections::over_filled(&grid, &filled).unwrap();
            let orders = stream_orders(&directions, &directions.contributing_cells(), 8);
            let links = stream_links(&directions, &orders);
            let mut own: Vec<usize> =
                links.iter().flat_map(|link| link.own_cells().to_vec()).collect();
            own.sort_unstable();
            let channels: Vec<usize> = (0..orders.len()).filter(|&cell| orders[cell] > 0).collect();
            assert_eq!(own, channels);
            for link in &links {
                assert!(link.own_cells().iter().all(|&cell| orders[cell] == link.order));
                for pair in link.cells.windows(2) {
                    assert_eq!(directions.receiver(pair[0]), Some(pair[1]));
                }
                assert!(link.next.is_none_or(|next| links[next].order >= link.order));
            }
        }
    }
}
