//! Strahler's orders of streams and Horton's ratios.

use serde::Serialize;

use super::FlowDirections;
use crate::line::Line;

/// Horton's laws (1945) by Strahler's orders: how number, length and area of streams change from
/// one order to the next.
///
/// A stream is a chain of channel cells of one order. The ratios come from straight lines through
/// the logarithms of number, mean length and mean area by order, without the highest order, whose
/// streams the edge of the terrain cuts. Natural basins have a bifurcation ratio of 3 to 5, a
/// length ratio of 1.5 to 3.5 and an area ratio of 3 to 6, but so has noise: judge a network by
/// Hack's law, exceedance and concavity too.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Horton {
    /// Number of streams of each order, from order 1.
    pub streams: Vec<usize>,
    /// Bifurcation ratio: streams of an order to those of the next.
    pub bifurcation: f64,
    /// Mean length of streams of an order to that of the one before.
    pub length: f64,
    /// Mean contributing area of streams of an order, at their lower end, to that of the one
    /// before.
    pub area: f64,
}

impl Horton {
    /// Measures the ratios; `None` if fewer than three orders lie below the highest.
    ///
    /// `orders` are those of [`stream_orders`], `cells` the contributing cells.
    pub fn new(directions: &FlowDirections, orders: &[u8], cells: &[u32]) -> Option<Self> {
        let highest = orders.iter().copied().max()?;
        let mut sums = vec![Sums::default(); usize::from(highest)];
        let steps = directions.grid().step_lengths();
        for (cell, &order) in orders.iter().enumerate().filter(|(_, order)| **order > 0) {
            let sum = &mut sums[usize::from(order) - 1];
            if let Some(direction) = directions.direction(cell) {
                sum.length += steps[usize::from(direction)];
            }
            if directions.receiver(cell).is_none_or(|next| orders[next] != order) {
                sum.streams += 1;
                sum.area += f64::from(cells[cell]);
            }
        }
        let ratio = |value: fn(&Sums) -> f64| {
            let below = sums.split_last()?.1.iter().enumerate();
            let points: Vec<[f64; 2]> =
                below.map(|(order, sums)| [order as f64, value(sums).ln()]).collect();
            Some(Line::through(&points)?.slope.exp()).filter(|ratio| ratio.is_finite())
        };
        Some(Self {
            bifurcation: ratio(|sums| sums.streams as f64)?.recip(),
            length: ratio(|sums| sums.length / sums.streams as f64)?,
            area: ratio(|sums| sums.area / sums.streams as f64)?,
            streams: sums.iter().map(|sums| sums.streams).collect(),
        })
    }
}

/// Sums over the streams of one order.
#[derive(Clone, Debug, Default)]
struct Sums {
    streams: usize,
    length: f64,
    area: f64,
}

/// Strahler's order (1957) of every cell: 0 for cells with fewer than `channel_cells`
/// contributing ones; 1 where a channel begins; where streams of the same order meet, one more;
/// else the highest of those that meet.
pub fn stream_orders(directions: &FlowDirections, cells: &[u32], channel_cells: u32) -> Vec<u8> {
    let mut orders = vec![0_u8; cells.len()];
    // Whether two streams of the highest order met so far come together.
    let mut rises = vec![false; cells.len()];
    directions.visit_downstream(|cell, _, receiver| {
        if cells[cell] < channel_cells.max(1) {
            return;
        }
        let order = (orders[cell] + u8::from(rises[cell])).max(1);
        orders[cell] = order;
        if let Some(next) = receiver {
            rises[next] = orders[next] == order || (rises[next] && orders[next] > order);
            orders[next] = orders[next].max(order);
        }
    });
    orders
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Grid;

    /// A fishbone: four streams come down the diagonals to a trunk that flows south.
    ///
    /// ```text
    /// a . . . b      a and b meet at X: order 2
    /// . \ . / .
    /// c . X . d      c and d join below X: stays 2, and meet each other there
    /// . \ | / .
    /// . . Y . .
    /// ```
    fn fishbone() -> FlowDirections {
        let grid = Grid::new([5, 5], [1.0; 2]).unwrap();
        let steps = [
            (0, 7),
            (6, 7),
            (4, 6),
            (8, 6),
            (12, 3),
            (17, 3),
            (22, 3),
            (10, 7),
            (14, 6),
            (16, 0),
            (18, 2),
        ];
        let steps = |cell| steps.iter().find(|step| step.0 == cell).map_or(8, |step| step.1);
        FlowDirections::from_steps(&grid, steps)
    }

    #[test]
    fn orders_rise_where_equals_meet() {
        let directions = fishbone();
        let cells = directions.contributing_cells();
        assert_eq!(cells[12], 5);
        assert_eq!(cells[17], 10);
        let orders = stream_orders(&directions, &cells, 1);
        assert_eq!([orders[0], orders[6], orders[12], orders[17], orders[22]], [1, 1, 2, 2, 2]);
        let long = stream_orders(&directions, &cells, 2);
        assert_eq!([long[0], long[6], long[12]], [0, 1, 2]);
        assert_eq!(Horton::new(&directions, &orders, &cells), None);
    }

    /// Streams of orders 1 to 4 side by side, 27, 9, 3 and 1 of them, as single chains.
    #[test]
    fn ratios_are_those_of_a_made_up_table() {
        let grid = Grid::new([12, 40], [1.0; 2]).unwrap();
        let directions = FlowDirections::from_steps(&grid, |_| 0);
        let mut orders = vec![0_u8; 480];
        let mut cells = vec![0_u32; 480];
        for row in 0..40 {
            let order = [0, 27, 36, 39, 40].iter().position(|&end| row < end).unwrap();
            for column in 10 - (1 << (order - 1))..10 {
                orders[column + 12 * row] = order as u8;
                cells[column + 12 * row] = 5_u32.pow(order as u32);
            }
        }
        let horton = Horton::new(&directions, &orders, &cells).unwrap();
        assert_eq!(horton.streams, [27, 9, 3, 1]);
        assert!((horton.bifurcation - 3.0).abs() < 1e-12, "{horton:?}");
        assert!((horton.length - 2.0).abs() < 1e-12, "{horton:?}");
        assert!((horton.area - 5.0).abs() < 1e-12, "{horton:?}");
    }
}
