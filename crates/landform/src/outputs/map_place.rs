//! Where the nodes of a run lie on the map.

use std::path::Path;

use landform_graph::Lattice;
use landform_io::{Feature, FeatureSystem, Georeference, IfExists, write_features};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;

use crate::explain::file_problem;

/// Refuses lattices of several layers, which are no map.
pub(super) fn check_plane(lattice: &Lattice) -> Result<(), Problem> {
    match lattice.depth() {
        1 => Ok(()),
        layers => {
            let message = format!("the domain has {layers} layers");
            Err(Problem::new("", message, "a domain with two sizes"))
        }
    }
}

/// Coordinates of a run's nodes: those of the file that the domain came from, or metres from the
/// south-western corner.
pub(super) struct MapPlace {
    place: Georeference,
    size: [usize; 2],
}

impl MapPlace {
    pub fn of(snapshot: &Snapshot<'_>) -> Self {
        let lattice = snapshot.lattice();
        let size = [lattice.width(), lattice.height()];
        let place = snapshot.domain().georeference.as_ref();
        let place = place.and_then(|place| place.downcast_ref::<Georeference>()).cloned();
        let place = place.unwrap_or_else(|| Georeference::local(size[1], lattice.spacing()));
        Self { place, size }
    }

    /// The point at a column and a row, of which whole ones are nodes.
    pub fn point(&self, [column, row]: [f64; 2]) -> [f64; 2] {
        let steps = [column + 0.5, -(row + 0.5)];
        let corner = [self.place.west, self.place.north];
        [0, 1].map(|axis| corner[axis] + steps[axis] * self.place.cell_size[axis])
    }

    /// Writes features in these coordinates.
    pub fn write(&self, path: &Path, features: &[Feature]) -> Result<(), Problem> {
        let system = FeatureSystem::of(&self.place, self.size);
        write_features(path, features, system, IfExists::Replace)
            .map_err(|error| file_problem("file", &error))
    }
}
