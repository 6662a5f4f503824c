//! The river network as lines.

use std::path::{Path, PathBuf};

use landform_analysis::grid::{Grid, GridError};
use landform_analysis::hydrology::{
    FlowDirections, StreamLink, fill_depressions, stream_links, stream_orders, wet_cells,
};
use landform_graph::Lattice;
use landform_io::{Feature, Geometry};
use landform_sim::output::{FileOutput, When};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::field_file;
use super::map_place::{MapPlace, check_plane};

/// The river network of a field of heights as lines between junctions, GeoJSON or comma-separated
/// values. Rivers follow the steepest ways down the surface, over depressions filled to their
/// brims, where `channel_nodes` drain through them.
///
/// Each line has its `river` number, the number of the one it flows `into` (0 where it leaves the
/// map), Strahler's `order`, `length_m`, the `area_m2` that drains through its lower end, its mean
/// `width_m` (the wet nodes beside it by its length; one spacing at least), its greatest
/// `depth_m`, and `discharge_m3`, the most water that passes one of its nodes in an iteration.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RiverLines {
    /// File name below the output folder.
    pub file: PathBuf,
    /// Name of the field of heights below the water.
    pub bed: String,
    /// Name of the field of water depths; dry ground when missing.
    pub water: Option<String>,
    /// Name of the field of the water that passed a node, as a depth; no discharge when missing.
    pub flow: Option<String>,
    /// Nodes that drain through the beginning of a river.
    #[schemars(range(min = 1))]
    pub channel_nodes: u32,
    /// Depth of the shallowest water that makes a river wider.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m"))]
    pub least_depth_m: f64,
    /// When it is written.
    pub when: When,
}

impl Default for RiverLines {
    fn default() -> Self {
        Self {
            file: "rivers.geojson".into(),
            bed: "bed".to_owned(),
            water: None,
            flow: None,
            channel_nodes: 100,
            least_depth_m: 0.1,
            when: When::End,
        }
    }
}

/// What is known at every node.
struct Ground {
    bed: Vec<f64>,
    depths: Option<Vec<f64>>,
    flow: Option<Vec<f64>>,
}

impl FileOutput for RiverLines {
    const NAME: &'static str = "RiverLines";
    const KIND: &'static str = "lines";
    const EXTENSIONS: &'static [&'static str] = &["geojson", "csv"];

    fn order(&self) -> (&Path, &When) {
        (&self.file, &self.when)
    }

    fn fields(&self) -> Vec<String> {
        [Some(&self.bed), self.water.as_ref(), self.flow.as_ref()]
            .into_iter()
            .flatten()
            .cloned()
            .collect()
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)
    }

    fn write(&self, path: &Path, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        let values = |name: &String| field_file::map_values(snapshot, name);
        let ground = Ground {
            bed: values(&self.bed)?,
            depths: self.water.as_ref().map(values).transpose()?,
            flow: self.flow.as_ref().map(values).transpose()?,
        };
        let place = MapPlace::of(snapshot);
        let features = self.features(snapshot.lattice(), &ground, &place);
        let features = features.map_err(|error| Problem::new("", error.to_string(), ""))?;
        place.write(path, &features)
    }
}

impl RiverLines {
    fn features(
        &self,
        lattice: &Lattice,
        ground: &Ground,
        place: &MapPlace,
    ) -> Result<Vec<Feature>, GridError> {
        let grid = Grid::new([lattice.width(), lattice.height()], [lattice.spacing(); 2])?;
        let surface: Vec<f64> = match &ground.depths {
            Some(depths) => ground.bed.iter().zip(depths).map(|(bed, depth)| bed + depth).collect(),
            None => ground.bed.clone(),
        };
        let filled = fill_depressions(&grid, &surface)?;
        let directions = FlowDirections::over_filled(&grid, &filled)?;
        let cells = directions.contributing_cells();
        let links =
            stream_links(&directions, &stream_orders(&directions, &cells, self.channel_nodes));
        let depth = |cell: usize| ground.depths.as_ref().map_or(0.0, |depths| depths[cell]);
        let wet = wet_cells(&directions, &links, |cell| depth(cell) >= self.least_depth_m);
        let node_m2 = lattice.spacing().powi(2);
        // A line takes two points: a link of one node at the edge is no more than an end of others.
        let is_line = |number: usize| links[number].cells.len() > 1;
        let feature = |(number, link): (usize, &StreamLink)| {
            let own = link.own_cells();
            let greatest = |value: &dyn Fn(usize) -> f64| {
                own.iter().map(|&cell| value(cell)).fold(0.0, f64::max)
            };
            let length_m = link.length_m(&directions);
            let point = |&cell: &usize| place.point(grid.position(cell).map(|at| at as f64));
            let mut properties = vec![
                ("river", (number + 1) as f64),
                ("into", link.next.filter(|&next| is_line(next)).map_or(0.0, |n| (n + 1) as f64)),
                ("order", f64::from(link.order)),
                ("length_m", length_m),
                ("area_m2", node_m2 * greatest(&|cell| f64::from(cells[cell]))),
                // A link of one node is as long as the node.
                ("width_m", node_m2 * wet[number] as f64 / length_m.max(lattice.spacing())),
                ("depth_m", greatest(&depth)),
            ];
            if let Some(flow) = &ground.flow {
                properties.push(("discharge_m3", node_m2 * greatest(&|cell| flow[cell])));
            }
            Feature { geometry: Geometry::Line(link.cells.iter().map(point).collect()), properties }
        };
        let links = links.iter().enumerate().filter(|(number, _)| is_line(*number));
        Ok(links.map(feature).collect())
    }
}
