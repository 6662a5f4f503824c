//! How rough a coast is on the sides of the map.

use landform_analysis::{LevelSetEdge, Polyline, ScaleRange, divider_dimension, level_sets};
use landform_coast::coast::MapSide;
use landform_graph::Lattice;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_plane, columns, heights};

/// Divider dimension of the longest shore of `land` in the west and east of the map, in its
/// north and south, and how much more it is in the north and south (thesis, figure 4.7). The
/// sides are the quarters between the diagonals; of each, the longest piece of shore counts,
/// and all four are measured with the same rulers.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SideDimension {}

impl Metric for SideDimension {
    type Memory = ();
    const NAME: &'static str = "SideDimension";

    fn fields(&self) -> Vec<String> {
        vec!["land".to_owned()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let lattice = snapshot.lattice();
        let land = heights(snapshot, "land")?;
        Ok(columns(match dimensions(lattice, &land) {
            Some([across, along]) => [
                ("west_east_dimension", Some(across)),
                ("north_south_dimension", Some(along)),
                ("side_dimension_difference", Some(along - across)),
            ],
            None => [("", None); 3],
        }))
    }
}

/// Dimensions in the west and east, and in the north and south; `None` where a shore is too short.
fn dimensions(lattice: &Lattice, land: &[f64]) -> Option<[f64; 2]> {
    let size = [lattice.width(), lattice.height()];
    let lines = level_sets(land, size, 0.5, LevelSetEdge::End).ok()?;
    let line = lines.into_iter().max_by_key(|line| line.points.len())?;
    let side = |&[column, row]: &[f64; 2]| {
        let [east, south] =
            [(column, 0), (row, 1)].map(|(at, axis)| (at + 0.5) / size[axis] as f64);
        MapSide::of([east, 1.0 - south])
    };
    let pieces: Vec<&[[f64; 2]]> =
        line.points.chunk_by(|one, other| side(one) == side(other)).collect();
    let longest = |wanted: MapSide| {
        let of_side = pieces.iter().filter(|piece| side(&piece[0]) == wanted);
        let piece = of_side.max_by_key(|piece| piece.len())?;
        let metres: Vec<[f64; 2]> =
            piece.iter().map(|point| point.map(|at| at * lattice.spacing())).collect();
        Polyline::planar(&metres).ok()
    };
    let across = [longest(MapSide::West)?, longest(MapSide::East)?];
    let along = [longest(MapSide::North)?, longest(MapSide::South)?];
    let range = ScaleRange::usual(&[&across[..], &along[..]].concat()).ok()?;
    let dimension = |lines: &[Polyline]| Some(divider_dimension(lines, &range).ok()?.dimension);
    Some([dimension(&across)?, dimension(&along)?])
}
