//! Where water comes in and goes out.

use landform_graph::Lattice;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::RiverError;

/// A side of the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Side {
    /// The first row.
    North,
    /// The last column.
    East,
    /// The last row.
    South,
    /// The first column.
    West,
}

impl Side {
    /// All four.
    pub const ALL: [Self; 4] = [Self::North, Self::East, Self::South, Self::West];

    /// Name of its border in ledgers and messages.
    pub fn border(self) -> &'static str {
        match self {
            Self::North => "north border",
            Self::East => "east border",
            Self::South => "south border",
            Self::West => "west border",
        }
    }

    /// Number of rows or columns of a plane from this side to the one across.
    pub fn depth(self, lattice: &Lattice) -> usize {
        match self {
            Self::North | Self::South => lattice.height(),
            Self::East | Self::West => lattice.width(),
        }
    }

    /// Whether the lattice ends on this side.
    pub fn is_open(self, lattice: &Lattice) -> bool {
        !lattice.is_periodic(usize::from(matches!(self, Self::North | Self::South)))
    }
}

/// The nodes on a side of a plane, from west to east or from north to south.
pub fn border_nodes(lattice: &Lattice, side: Side) -> Vec<usize> {
    nodes_beside(lattice, side, 0)
}

/// The row or column of nodes of a plane at `distance` rows or columns from a side, which is less than
/// [`Side::depth`], from west to east or from north to south.
pub fn nodes_beside(lattice: &Lattice, side: Side, distance: usize) -> Vec<usize> {
    let [width, height] = [lattice.width(), lattice.height()];
    let row = |row: usize| (row * width..(row + 1) * width).collect();
    let column = |column: usize| (0..height).map(|row| row * width + column).collect();
    match side {
        Side::North => row(distance),
        Side::South => row(height - 1 - distance),
        Side::West => column(distance),
        Side::East => column(width - 1 - distance),
    }
}

/// A disc on the map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// Its middle: share of the width from west to east, of the height from south to north.
    pub center: [f64; 2],
    /// Its radius; the node nearest to the middle belongs to it in any case.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m"))]
    #[serde(default)]
    pub radius_m: f64,
}

impl Place {
    /// Its nodes, in order.
    ///
    /// # Errors
    /// [`RiverError::Outside`] if the middle is not on the map.
    pub fn nodes(&self, lattice: &Lattice) -> Result<Vec<usize>, RiverError> {
        let [east, north] = self.center;
        if ![east, north].iter().all(|share| (0.0..=1.0).contains(share)) {
            return Err(RiverError::Outside { center: self.center });
        }
        let spacing = lattice.spacing();
        let last = [lattice.width() - 1, lattice.height() - 1].map(|count| count as f64);
        let center = [east * last[0], (1.0 - north) * last[1]];
        let nearest = center.map(|at| at.round() as usize);
        let reach = (self.radius_m / spacing).max(0.0);
        let span = |axis: usize| {
            let first = (center[axis] - reach).ceil().max(0.0) as usize;
            first.min(nearest[axis])
                ..=((center[axis] + reach).min(last[axis]) as usize).max(nearest[axis])
        };
        let within = |x: usize, y: usize| {
            (x as f64 - center[0]).hypot(y as f64 - center[1]) <= reach || [x, y] == nearest
        };
        let row = |y: usize| {
            let columns = span(0).filter(move |&x| within(x, y));
            columns.map(move |x| x + lattice.width() * y)
        };
        Ok(span(1).flat_map(row).collect())
    }
}
