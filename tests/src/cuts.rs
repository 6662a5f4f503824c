//! Any scenario, made small enough for a test.

use std::fs;
use std::path::Path;

use landform::sim::text::{Tree, locate};

/// Most columns and rows that are left.
const MOST_NODES: usize = 64;

/// Most columns, rows and layers that are left of a volume.
const MOST_VOXELS: usize = 24;

/// Most iterations that are left of a stage.
const MOST_ITERATIONS: usize = 4;

/// The `--set` arguments that make a scenario small: its grid or volume, its stages and its
/// perspective pictures. A grid whose coarse shape is given keeps its size. A raster domain gets `raster`, a
/// file of a test, instead of its own; a shoreline domain the `.csv` file beside it.
pub fn cuts(scenario: &Path, raster: &Path) -> Vec<String> {
    let text = fs::read_to_string(scenario).expect("the scenario can be read");
    let tree = Tree::parse(&text);
    let value = |path: &str| locate(&tree, path).map(|span| span.of(&text));
    let mut cuts = Vec::new();
    let domain = value("domain").unwrap_or_default();
    if domain.starts_with("Raster") {
        cuts.push(format!("domain.path={:?}", raster.display().to_string()));
        cuts.push("domain.every=1".to_owned());
    } else if domain.starts_with("Shoreline") {
        let shore = raster.with_extension("csv");
        cuts.push(format!("domain.path={:?}", shore.display().to_string()));
        cuts.push(format!("domain.nodes={MOST_NODES}"));
    } else if !text.contains("coarse_m: ") {
        let cut = |axis: usize, most: usize| {
            let nodes = value(&format!("domain.size[{axis}]")).and_then(|text| text.parse().ok());
            nodes.unwrap_or(most).min(most).to_string()
        };
        let size = match domain.starts_with("Volume") {
            true => [0, 1, 2].map(|axis| cut(axis, MOST_VOXELS)).join(", "),
            false => [0, 1].map(|axis| cut(axis, MOST_NODES)).join(", "),
        };
        cuts.push(format!("domain.size=({size})"));
    }
    for stage in (0..).take_while(|stage| value(&format!("stages[{stage}]")).is_some()) {
        cuts.push(format!("stages[{stage}].stop=Iterations({MOST_ITERATIONS})"));
    }
    for output in (0..).take_while(|output| value(&format!("outputs[{output}]")).is_some()) {
        let look = format!("outputs[{output}].look");
        let in_perspective = |look: &str| {
            ["Perspective", "Passages", "CaveInterior"].iter().any(|name| look.starts_with(name))
        };
        if value(&look).is_some_and(in_perspective) {
            cuts.push(format!("{look}.size=(96, 60)"));
        }
    }
    cuts.into_iter().flat_map(|cut| ["--set".to_owned(), cut]).collect()
}
