//! Tributary capture: streams that come to flow into another river.

use std::collections::BTreeMap;

use landform_analysis::grid::{Grid, GridError};
use landform_analysis::hydrology::{FlowDirections, fill_depressions};
use serde::{Deserialize, Serialize};

/// A stream that was captured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Capture {
    /// Iteration of the survey that found it.
    pub iteration: u64,
    /// Lowest node of the captured stream.
    pub node: u32,
    /// Nodes that drain through that node.
    pub area_nodes: u32,
    /// Number of the river that lost it.
    pub from: u32,
    /// Number of the river that took it.
    pub to: u32,
}

/// What surveys of a river network found: which river every channel node belongs to, and the
/// captures so far.
///
/// A river is everything that drains through one mouth, over depressions filled to their brims.
/// From one survey to the next a river keeps its number when it has more channel nodes of that
/// river than any other has, so a mouth may wander. Channel nodes whose river is another one than
/// before, and was there before, were captured; those that hang together downstream are one
/// capture.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct CaptureRecord {
    /// Channel nodes of the latest survey with the numbers of their rivers, in node order.
    owned: Vec<(u32, u32)>,
    /// Rivers that ever were.
    rivers: u32,
    /// Captures in the order they were found.
    pub captures: Vec<Capture>,
}

impl CaptureRecord {
    /// Rivers of the latest survey.
    pub fn present_rivers(&self) -> usize {
        let mut numbers: Vec<u32> = self.owned.iter().map(|owned| owned.1).collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers.len()
    }

    /// Surveys the network of a bed in metres, a node a cell: channels are the nodes through which
    /// at least `channel_nodes` drain.
    ///
    /// # Errors
    /// [`GridError`] if the bed does not fill the grid.
    pub fn survey(
        &mut self,
        grid: &Grid,
        bed: &[f64],
        channel_nodes: u32,
        iteration: u64,
    ) -> Result<(), GridError> {
        let filled = fill_depressions(grid, bed)?;
        let directions = FlowDirections::over_filled(grid, &filled)?;
        let area = directions.contributing_cells();
        let channel = |node: usize| area[node] >= channel_nodes.max(1);
        let mut mouths: Vec<u32> = (0..bed.len() as u32).collect();
        // From the mouths up, every node has the mouth of its receiver.
        let mut order = Vec::with_capacity(bed.len());
        directions.visit_downstream(|node, _, receiver| order.push((node, receiver)));
        for &(node, receiver) in order.iter().rev() {
            mouths[node] = receiver.map_or(node as u32, |next| mouths[next]);
        }
        let mut before = vec![0; bed.len()];
        self.owned.iter().for_each(|&(node, river)| before[node as usize] = river);
        let channels: Vec<usize> = (0..bed.len()).filter(|&node| channel(node)).collect();
        let names = self.names(&channels, &mouths, &before);
        let river = |node: usize| names.get(&mouths[node]).copied().unwrap_or_default();
        let first = self.owned.is_empty();
        let known = |river: u32| self.owned.iter().any(|owned| owned.1 == river);
        let taken = |node: usize| before[node] > 0 && channel(node) && river(node) != before[node];
        let lowest = |node: &usize| {
            let below = directions.receiver(*node).filter(|&next| taken(next));
            taken(*node) && below.is_none_or(|next| before[next] != before[*node])
        };
        let captures = channels.iter().copied().filter(lowest).map(|node| Capture {
            iteration,
            node: node as u32,
            area_nodes: area[node],
            from: before[node],
            to: river(node),
        });
        let captures: Vec<Capture> = captures.filter(|capture| known(capture.to)).collect();
        if !first {
            self.captures.extend(captures);
        }
        self.rivers = self.rivers.max(names.values().copied().max().unwrap_or_default());
        self.owned = channels.iter().map(|&node| (node as u32, river(node))).collect();
        Ok(())
    }

    /// The number of the river of each mouth: that of the river before with which it shares most
    /// channel nodes, the largest shares first, or a new one.
    fn names(&self, channels: &[usize], mouths: &[u32], before: &[u32]) -> BTreeMap<u32, u32> {
        let mut shared: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        for &node in channels {
            *shared.entry((mouths[node], before[node])).or_default() += 1;
        }
        let mut by_share: Vec<_> = shared.iter().filter(|((_, river), _)| *river > 0).collect();
        by_share.sort_by_key(|&(&pair, &nodes)| (std::cmp::Reverse(nodes), pair));
        let (mut names, mut given) = (BTreeMap::new(), BTreeMap::new());
        for (&(mouth, river), _) in by_share {
            if !names.contains_key(&mouth) && !given.contains_key(&river) {
                names.insert(mouth, river);
                given.insert(river, mouth);
            }
        }
        let mut next = self.rivers;
        for &(mouth, _) in shared.keys() {
            names.entry(mouth).or_insert_with(|| {
                next += 1;
                next
            });
        }
        names
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two valleys that fall to the south, along columns 4 and 16; the western one's upper part
    /// may be turned to the east through a gap.
    fn bed(turned: bool, moved: usize) -> Vec<f64> {
        let height = |x: usize, y: usize| {
            let west = 4 + if y > 20 { moved } else { 0 };
            let axis = x.abs_diff(west).min(x.abs_diff(16)) as f64;
            let slope = 0.5 * (30 - y) as f64;
            match turned && y == 10 && (4..=16).contains(&x) {
                true => slope - 1.0 - 0.05 * (x - 4) as f64,
                false => slope + 2.0 * axis + if turned && y == 11 && x == 4 { 6.0 } else { 0.0 },
            }
        };
        (0..21 * 30).map(|node| height(node % 21, node / 21)).collect()
    }

    #[test]
    fn a_stream_that_turns_to_another_river_is_captured_once() {
        let grid = Grid::new([21, 30], [10.0; 2]).unwrap();
        let mut record = CaptureRecord::default();
        record.survey(&grid, &bed(false, 0), 40, 0).unwrap();
        assert_eq!((record.present_rivers(), record.captures.len()), (2, 0));
        // A mouth that wanders is no capture.
        record.survey(&grid, &bed(false, 1), 40, 10).unwrap();
        record.survey(&grid, &bed(false, 0), 40, 20).unwrap();
        assert_eq!((record.present_rivers(), record.captures.len()), (2, 0));
        record.survey(&grid, &bed(true, 0), 40, 30).unwrap();
        assert_eq!(record.captures.len(), 1, "{:?}", record.captures);
        let capture = record.captures[0];
        assert_eq!((capture.iteration, capture.node), (30, 4 + 21 * 10));
        assert_ne!(capture.from, capture.to);
        assert!((80..140).contains(&capture.area_nodes), "{capture:?}");
        record.survey(&grid, &bed(true, 0), 40, 40).unwrap();
        assert_eq!(record.captures.len(), 1);
    }

    #[test]
    fn rivers_that_grow_anew_capture_nothing() {
        let grid = Grid::new([21, 30], [10.0; 2]).unwrap();
        let mut record = CaptureRecord::default();
        record.survey(&grid, &bed(false, 0), 10_000, 0).unwrap();
        assert_eq!(record.present_rivers(), 0);
        record.survey(&grid, &bed(true, 0), 40, 10).unwrap();
        assert!(record.captures.is_empty());
    }
}
