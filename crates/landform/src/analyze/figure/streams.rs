//! Streams as lines, for a map.

use landform_analysis::hydrology::FlowDirections;

/// Streams from their heads down: columns and rows of cells.
#[derive(Clone, Debug, Default)]
pub(in crate::analyze) struct Streams {
    /// Streams with a small share of the terrain above them.
    pub brooks: Vec<Vec<[f64; 2]>>,
    /// Those with a large one.
    pub rivers: Vec<Vec<[f64; 2]>>,
}

/// Contributing cells that a stream has at least, however small the terrain.
const FEWEST_CELLS: f64 = 20.0;

impl Streams {
    /// Share of the terrain that drains into a brook, and into a river, at least.
    pub const SHARES: [f64; 2] = [0.001, 0.02];

    /// The streams of a terrain; those of cells below `sea_m` are left out.
    pub fn new(
        directions: &FlowDirections,
        contributing_cells: &[u32],
        heights: &[f64],
        sea_m: Option<f64>,
    ) -> Self {
        let with_data = contributing_cells.iter().filter(|cells| **cells > 0).count() as f64;
        let [brook, river] = Self::SHARES.map(|share| (share * with_data).max(FEWEST_CELLS));
        let dry = |cell: usize| sea_m.is_none_or(|sea| heights[cell] >= sea);
        let has = |least: f64| {
            move |cell: usize| f64::from(contributing_cells[cell]) >= least && dry(cell)
        };
        let in_brook = |cell| has(brook)(cell) && !has(river)(cell);
        Self {
            brooks: lines(directions, contributing_cells.len(), in_brook),
            rivers: lines(directions, contributing_cells.len(), has(river)),
        }
    }
}

/// Lines along the cells `inside`, each from a cell that none of them flows into to where it meets
/// an earlier line; the first cell beyond is its last point.
fn lines(
    directions: &FlowDirections,
    cells: usize,
    inside: impl Fn(usize) -> bool,
) -> Vec<Vec<[f64; 2]>> {
    let mut fed = vec![false; cells];
    for cell in (0..cells).filter(|&cell| inside(cell)) {
        if let Some(next) = directions.receiver(cell) {
            fed[next] = true;
        }
    }
    let place = |cell: usize| directions.grid().position(cell).map(|index| index as f64);
    let mut drawn = vec![false; cells];
    let mut lines = Vec::new();
    for head in (0..cells).filter(|&cell| inside(cell) && !fed[cell]) {
        let mut line = vec![place(head)];
        let mut cell = head;
        while inside(cell) && !std::mem::replace(&mut drawn[cell], true) {
            let Some(next) = directions.receiver(cell) else { break };
            line.push(place(next));
            cell = next;
        }
        if line.len() > 1 {
            lines.push(line);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_analysis::grid::Grid;
    use landform_analysis::hydrology::fill_depressions;

    /// A valley that falls to the south, with slopes on both sides.
    #[test]
    fn a_valley_has_one_river_and_it_ends_at_the_shore() {
        let grid = Grid::new([21, 60], [10.0; 2]).unwrap();
        let heights: Vec<f64> = (0..grid.cell_count())
            .map(|cell| {
                let [column, row] = grid.position(cell).map(|index| index as f64);
                3.0 * (column - 10.0).abs() + 0.5 * (49.25 - row)
            })
            .collect();
        let filled = fill_depressions(&grid, &heights).unwrap();
        let directions = FlowDirections::over_filled(&grid, &filled).unwrap();
        let cells = directions.contributing_cells();
        let all = Streams::new(&directions, &cells, &heights, None);
        assert_eq!(all.rivers.len(), 1, "{:?}", all.rivers);
        assert!(all.rivers[0].iter().all(|point| point[0] == 10.0));
        assert_eq!(all.rivers[0].last(), Some(&[10.0, 59.0]));
        let land = Streams::new(&directions, &cells, &heights, Some(0.0));
        assert_eq!(land.rivers[0].last(), Some(&[10.0, 50.0]), "the first cell of the sea");
    }
}
