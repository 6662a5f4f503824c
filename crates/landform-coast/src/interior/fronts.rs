//! Erosion that goes on into the interior of the land and leaves level sets behind (thesis,
//! listing 4.1).

use landform_graph::Lattice;

use crate::coast::{Coast, CoastError, CoastSettings, Events};

/// A node that no front has reached since the last level set.
const UNREACHED: u32 = u32::MAX;

/// When a level set is marked, and how a front that is stuck is moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrontSettings {
    /// Edges from the last level set that no front may go beyond before the next is marked.
    pub threshold: u32,
    /// By how much the force grows at each iteration that moves nothing, as a share of it, until
    /// the next level set.
    pub raise: f64,
}

impl Default for FrontSettings {
    /// A level set at every tenth node at the latest, and a force that grows by a twentieth.
    fn default() -> Self {
        Self { threshold: 10, raise: 0.05 }
    }
}

/// What fronts have done so far: all that does not follow from the fields.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct FrontRecord {
    /// Number of the last level set.
    pub level: u32,
    /// What the force is multiplied with.
    pub pressure: f64,
    /// Shore at the beginning in parts of a spacing ([`crate::coast::PARTS`]).
    pub initial_shore: u64,
}

/// The fields that fronts work on, one value a node.
#[derive(Debug)]
pub struct FrontFields<'a> {
    /// 1 on land that no front has passed, else 0.
    pub land: &'a mut [u8],
    /// Resistance of the rock.
    pub resistance: &'a mut [f64],
    /// Number of the level set that a node lies on or above: see [`super::LevelSets::band`].
    pub band: &'a mut [u32],
    /// 1 where a node lies on that level set, else 0.
    pub on_level: &'a mut [u8],
}

/// Fronts of erosion that move inland from a coast until nothing is left of the land.
///
/// An iteration is one of the coast model. When a front is more than the threshold away from the
/// last level set, what still stands on that level set falls, and the coast as it then is becomes
/// the next level set. When nothing falls, the force grows until something does; with the next
/// level set it is as it was.
#[derive(Clone, Debug)]
pub struct Fronts {
    coast: Coast,
    settings: FrontSettings,
    record: FrontRecord,
    /// Edges from the last level set over ground that was passed since.
    steps: Vec<u32>,
    queue: Vec<u32>,
}

impl Fronts {
    /// Fronts along the coast of the land, which is level set 0 together with the sea.
    ///
    /// # Errors
    /// See [`Coast::new`].
    pub fn new(
        lattice: &Lattice,
        coast: CoastSettings,
        settings: FrontSettings,
        fields: &mut FrontFields<'_>,
    ) -> Result<Self, CoastError> {
        let coast = Coast::new(lattice, coast, fields.land, fields.resistance)?;
        coast.require_coast(fields.land)?;
        fields.band.fill(0);
        for (on_level, land) in fields.on_level.iter_mut().zip(&*fields.land) {
            *on_level = u8::from(*land == 0);
        }
        let initial_shore = coast.shore().total();
        let record = FrontRecord { level: 0, pressure: 1.0, initial_shore };
        let steps = vec![UNREACHED; lattice.node_count()];
        let mut fronts = Self { coast, settings, record, steps, queue: Vec::new() };
        fronts.mark(fields);
        Ok(fronts)
    }

    /// Fronts as they were when `record` and the fields were saved.
    ///
    /// # Errors
    /// See [`Coast::new`].
    pub fn resume(
        lattice: &Lattice,
        coast: CoastSettings,
        settings: FrontSettings,
        fields: &FrontFields<'_>,
        record: FrontRecord,
    ) -> Result<Self, CoastError> {
        let mut coast = Coast::new(lattice, coast, fields.land, fields.resistance)?;
        coast.press(record.pressure);
        let steps = vec![UNREACHED; lattice.node_count()];
        let mut fronts = Self { coast, settings, record, steps, queue: Vec::new() };
        for node in 0..lattice.node_count() {
            if fields.on_level[node] > 0 && fields.band[node] == record.level {
                fronts.steps[node] = 0;
                fronts.queue.push(node as u32);
            }
        }
        fronts.spread(fields);
        Ok(fronts)
    }

    /// What the fronts have done so far.
    pub fn record(&self) -> FrontRecord {
        self.record
    }

    /// The coast along which the fronts stand.
    pub fn coast(&self) -> &Coast {
        &self.coast
    }

    /// One iteration. `tell` hears of what falls: at most twice, by the sea, and to free the last
    /// level set. Returns whether any land is left that a front stands before.
    ///
    /// # Errors
    /// See [`Coast::step`].
    pub fn step(
        &mut self,
        fields: &mut FrontFields<'_>,
        mut tell: impl FnMut(&Coast, &Events),
    ) -> Result<bool, CoastError> {
        let initial = self.record.initial_shore;
        let events = self.coast.step(fields.land, fields.resistance, initial)?.clone();
        tell(&self.coast, &events);
        self.pass(&events, fields);
        if events.eroded.is_empty() && !self.coast.nodes().is_empty() {
            self.record.pressure *= 1.0 + self.settings.raise;
            self.coast.press(self.record.pressure);
        }
        let coast = self.coast.nodes();
        let furthest = coast.iter().map(|&node| self.steps[node]).max();
        if furthest.is_some_and(|steps| steps > self.settings.threshold) {
            let left: Vec<u32> = (coast.iter().filter(|&&node| self.steps[node] == 0))
                .map(|&node| node as u32)
                .collect();
            let events = self.coast.fell(&left, fields.land, fields.resistance)?.clone();
            tell(&self.coast, &events);
            self.pass(&events, fields);
            self.record.level += 1;
            self.mark(fields);
        }
        Ok(!self.coast.nodes().is_empty())
    }

    /// Notes the ground that was passed and how far the land behind it is from the last level set.
    fn pass(&mut self, events: &Events, fields: &mut FrontFields<'_>) {
        for &node in &events.eroded {
            if fields.on_level[node as usize] == 0 {
                fields.band[node as usize] = self.record.level;
            }
        }
        let lattice = self.coast.shore().lattice();
        for &node in &events.exposed {
            let around = lattice.neighbours(node as usize).map(|edge| self.steps[edge.node]);
            self.steps[node as usize] = around.min().unwrap_or(UNREACHED).saturating_add(1);
        }
        self.queue.extend_from_slice(&events.exposed);
        self.spread(fields);
    }

    /// Shortens the ways that lead over the nodes of the queue.
    fn spread(&mut self, fields: &FrontFields<'_>) {
        let lattice = self.coast.shore().lattice();
        let mut next = 0;
        while let Some(&from) = self.queue.get(next) {
            next += 1;
            let steps = self.steps[from as usize].saturating_add(1);
            for edge in lattice.neighbours(from as usize) {
                let passed =
                    fields.land[edge.node] == 0 && fields.band[edge.node] == self.record.level;
                let open = passed || self.coast.is_coast(edge.node);
                if open && steps < self.steps[edge.node] {
                    self.steps[edge.node] = steps;
                    self.queue.push(edge.node as u32);
                }
            }
        }
        self.queue.clear();
    }

    /// Makes the coast the last level set, with the force of the settings before it.
    fn mark(&mut self, fields: &mut FrontFields<'_>) {
        self.steps.fill(UNREACHED);
        for node in self.coast.nodes() {
            self.steps[node] = 0;
            fields.band[node] = self.record.level;
            fields.on_level[node] = 1;
        }
        self.record.pressure = 1.0;
        self.coast.press(1.0);
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::Terrain;
    use super::*;
    use crate::coast::Perimeter;
    use landform_graph::{Boundary, Connectivity};

    fn lattice() -> Lattice {
        Lattice::plane([60, 50], 10.0, Connectivity::FourEight, [Boundary::Open; 2]).unwrap()
    }

    fn coast() -> CoastSettings {
        let perimeter = Perimeter::Near { radius_m: 100.0 };
        CoastSettings { force: 0.4, attenuation: 0.15, perimeter, ..Default::default() }
    }

    #[test]
    fn fronts_pass_all_land_and_level_sets_lie_round_each_other() {
        let lattice = lattice();
        let mut terrain = Terrain::new(&lattice, 5);
        let settings = FrontSettings { threshold: 4, raise: 0.05 };
        let mut fronts = Fronts::new(&lattice, coast(), settings, &mut terrain.fields()).unwrap();
        let mut iterations = 0;
        while fronts.step(&mut terrain.fields(), |_, _| {}).unwrap() {
            iterations += 1;
            assert!(iterations < 10_000);
        }
        assert!(terrain.land.iter().all(|&land| land == 0));
        assert!(fronts.record().level >= 4);
        for node in 0..lattice.node_count() {
            for edge in lattice.neighbours(node) {
                let [low, high] = [terrain.band[node], terrain.band[edge.node]];
                // Between two bands lies the level set of the higher one.
                assert!(high <= low || terrain.on_level[edge.node] == 1, "{low}, {high}");
            }
        }
    }

    /// Fronts that stand still under one force may move under another: what the search for
    /// contiguous shore leaves out must come back when the force changes.
    #[test]
    fn contiguous_fronts_go_on_alike_from_what_was_saved() {
        let perimeter = Perimeter::Contiguous { radius_m: 100.0 };
        go_on_alike(CoastSettings { perimeter, ..coast() });
    }

    #[test]
    fn fronts_go_on_alike_from_what_was_saved() {
        go_on_alike(coast());
    }

    fn go_on_alike(coast: CoastSettings) {
        let lattice = lattice();
        let mut terrain = Terrain::new(&lattice, 5);
        let settings = FrontSettings { threshold: 5, raise: 0.02 };
        let mut fronts =
            Fronts::new(&lattice, coast.clone(), settings, &mut terrain.fields()).unwrap();
        for iteration in 0.. {
            if iteration % 7 == 3 {
                let fields = terrain.fields();
                let again =
                    Fronts::resume(&lattice, coast.clone(), settings, &fields, fronts.record());
                let again = again.unwrap();
                for node in again.coast.nodes() {
                    assert_eq!(again.steps[node], fronts.steps[node], "iteration {iteration}");
                }
                fronts = again;
            }
            if !fronts.step(&mut terrain.fields(), |_, _| {}).unwrap() {
                break;
            }
        }
        let mut straight = Terrain::new(&lattice, 5);
        let mut fronts =
            Fronts::new(&lattice, coast.clone(), settings, &mut straight.fields()).unwrap();
        while fronts.step(&mut straight.fields(), |_, _| {}).unwrap() {}
        assert_eq!(terrain.band, straight.band);
        assert_eq!(terrain.on_level, straight.on_level);
    }
}
