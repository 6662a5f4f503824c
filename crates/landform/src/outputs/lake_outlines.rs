//! Lakes as areas.

use std::path::{Path, PathBuf};

use landform_analysis::{LevelSet, LevelSetEdge, level_sets};
use landform_graph::Lattice;
use landform_io::{Feature, Geometry};
use landform_rivers::lakes::lakes;
use landform_sim::output::{FileOutput, When};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::field_file;
use super::map_place::{MapPlace, check_plane};

/// Lakes as areas, GeoJSON: depressions of the bed that hold water, with islands in them as holes.
/// Each has its `lake` number, `area_m2`, `volume_m3`, the mean `level_m` of its water and its
/// greatest `depth_m`.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LakeOutlines {
    /// File name below the output folder.
    pub file: PathBuf,
    /// Name of the field of heights below the water.
    pub bed: String,
    /// Name of the field of water depths.
    pub water: String,
    /// Depth above which a node is wet.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m"))]
    pub least_depth_m: f64,
    /// Nodes of the smallest lake.
    #[schemars(range(min = 1))]
    pub least_nodes: u32,
    /// When it is written.
    pub when: When,
}

impl Default for LakeOutlines {
    fn default() -> Self {
        Self {
            file: "lakes.geojson".into(),
            bed: "bed".to_owned(),
            water: "water".to_owned(),
            least_depth_m: 0.1,
            least_nodes: 4,
            when: When::End,
        }
    }
}

impl FileOutput for LakeOutlines {
    const NAME: &'static str = "LakeOutlines";
    const KIND: &'static str = "areas";
    const EXTENSIONS: &'static [&'static str] = &["geojson", "csv"];

    fn order(&self) -> (&Path, &When) {
        (&self.file, &self.when)
    }

    fn fields(&self) -> Vec<String> {
        vec![self.bed.clone(), self.water.clone()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)
    }

    fn write(&self, path: &Path, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        let (bed, _) = field_file::values(snapshot, &self.bed)?;
        let (water, _) = field_file::values(snapshot, &self.water)?;
        let lattice = snapshot.lattice();
        let found = lakes(lattice, (&bed, &water), self.least_depth_m, self.least_nodes);
        let found = found.map_err(|error| Problem::new("", error.to_string(), ""))?;
        let place = MapPlace::of(snapshot);
        let feature = |(index, nodes): (usize, &Vec<usize>)| {
            let geometry = Geometry::Areas(outline(lattice, nodes, &place)?);
            let mut properties = vec![("lake", (index + 1) as f64)];
            properties.extend(measures(lattice, nodes, (&bed, &water)));
            Ok(Feature { geometry, properties })
        };
        let features = found.iter().enumerate().map(feature);
        place.write(path, &features.collect::<Result<Vec<_>, Problem>>()?)
    }
}

/// Area, volume, mean level and greatest depth of a lake.
fn measures(
    lattice: &Lattice,
    nodes: &[usize],
    (bed, water): (&[f64], &[f64]),
) -> [(&'static str, f64); 4] {
    let (node_m2, count) = (lattice.spacing().powi(2), nodes.len() as f64);
    let depths = || nodes.iter().map(|&node| water[node]);
    let levels = nodes.iter().map(|&node| bed[node] + water[node]);
    [
        ("area_m2", node_m2 * count),
        ("volume_m3", node_m2 * depths().sum::<f64>()),
        ("level_m", levels.sum::<f64>() / count),
        ("depth_m", depths().fold(0.0, f64::max)),
    ]
}

/// The outer rings of a patch of nodes, each with the rings of its holes. Nodes count as squares
/// whose corners are cut.
fn outline(
    lattice: &Lattice,
    nodes: &[usize],
    place: &MapPlace,
) -> Result<Vec<Vec<Vec<[f64; 2]>>>, Problem> {
    let at = |node: usize, axis: usize| lattice.coordinates(node)[axis];
    let bounds = |axis: usize| {
        let (low, high) = nodes.iter().fold((usize::MAX, 0), |(low, high), &node| {
            (low.min(at(node, axis)), high.max(at(node, axis)))
        });
        // A rim of nodes outside closes every ring.
        (low as f64 - 1.0, high - low + 3)
    };
    let [(west, width), (north, height)] = [0, 1].map(bounds);
    let mut inside = vec![0.0; width * height];
    for &node in nodes {
        let [column, row] = [(0, west), (1, north)].map(|(axis, low)| at(node, axis) as f64 - low);
        inside[column as usize + width * row as usize] = 1.0;
    }
    let rings = level_sets(&inside, [width, height], 0.5, LevelSetEdge::End);
    let rings = rings.map_err(|error| Problem::new("", error.to_string(), ""))?;
    let (outer, holes): (Vec<&LevelSet>, Vec<&LevelSet>) =
        rings.iter().partition(|ring| ring.is_island());
    let placed = |ring: &LevelSet| {
        let point = |&[column, row]: &[f64; 2]| place.point([column + west, row + north]);
        ring.points.iter().map(point).collect()
    };
    let mut areas: Vec<Vec<Vec<[f64; 2]>>> = outer.iter().map(|ring| vec![placed(ring)]).collect();
    for hole in holes {
        // Of rings within one another the innermost has the hole.
        let around = (0..outer.len()).filter(|&at| contains(&outer[at].points, hole.points[0]));
        let nearest = around.min_by(|&a, &b| outer[a].area().total_cmp(&outer[b].area()));
        if let Some(at) = nearest {
            areas[at].push(placed(hole));
        }
    }
    Ok(areas)
}

/// Whether a point lies within a ring, by the edges to its east.
fn contains(ring: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let crossed = |pair: &&[[f64; 2]]| {
        let [[x1, y1], [x2, y2]] = [pair[0], pair[1]];
        (y1 > y) != (y2 > y) && x < x1 + (y - y1) / (y2 - y1) * (x2 - x1)
    };
    ring.windows(2).filter(crossed).count() % 2 == 1
}
