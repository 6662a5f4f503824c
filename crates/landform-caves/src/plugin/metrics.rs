//! Metrics of caves.

use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::growth::{CaveHistory, CaveWorks};
use crate::courses::{Course, courses};
use crate::record::{CaveEventKind, starts};

/// Passages: `passage_voxels`, `passage_percent` of all voxels, and `mean_porosity` of the rock with
/// all that is in it. With `weak_porosity` also `weak_percent` of the voxels that had at least that
/// porosity when the run was first measured, planes and fractures say, and `in_weak_percent` of the
/// passages that lie there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Passages {
    /// Porosity from which a voxel is part of a passage.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub passage_porosity: f64,
    /// Porosity from which rock counts as weak.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub weak_porosity: Option<f64>,
}

impl Default for Passages {
    fn default() -> Self {
        Self { passage_porosity: 0.35, weak_porosity: None }
    }
}

/// The rock when it was first measured.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FirstRock {
    /// Voxels of weak rock, in order; `None` before the first measurement.
    weak: Option<Vec<u32>>,
}

impl Metric for Passages {
    type Memory = FirstRock;
    const NAME: &'static str = "Passages";

    fn fields(&self) -> Vec<String> {
        vec!["porosity".to_owned()]
    }

    fn measure(
        &self,
        first: &mut FirstRock,
        snapshot: &Snapshot<'_>,
    ) -> Result<Vec<(String, f64)>, Problem> {
        let porosity = snapshot.field("porosity");
        let porosity = porosity.map_err(|error| Problem::new("", error.to_string(), ""))?;
        let count = porosity.len().max(1) as f64;
        let is_open = |value: &f64| *value >= self.passage_porosity;
        let open = porosity.iter().filter(|value| is_open(value)).count() as f64;
        let mean = landform_sim::sums::sum(&porosity) / count;
        let mut values = vec![
            ("passage_voxels", open),
            ("passage_percent", 100.0 * open / count),
            ("mean_porosity", mean),
        ];
        if let Some(least) = self.weak_porosity {
            let weak = first.weak.get_or_insert_with(|| {
                (0..porosity.len() as u32)
                    .filter(|&node| porosity[node as usize] >= least)
                    .collect()
            });
            let inside = weak.iter().filter(|&&node| is_open(&porosity[node as usize])).count();
            values.push(("weak_percent", 100.0 * weak.len() as f64 / count));
            values.push(("in_weak_percent", 100.0 * inside as f64 / open.max(1.0)));
        }
        Ok(values.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
    }
}

/// The courses of water through a cave that grows: `sources_drained` by passages; `tributaries`, the
/// courses that join another; `longest_sequence` of courses each of which joins the next; `courses_own`
/// that reach a sink by themselves; `phreatic_loops` on all courses and their `climb_m`; and how often
/// passages `links`, `breakthroughs` and `captures` happened.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CaveCourses {}

impl Metric for CaveCourses {
    type Memory = ();
    const NAME: &'static str = "CaveCourses";

    fn fields(&self) -> Vec<String> {
        vec!["pressure".to_owned()]
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let world = snapshot.world();
        let (works, history) =
            (world.get_resource::<CaveWorks>(), world.get_resource::<CaveHistory>());
        let (Some(works), Some(CaveHistory(record))) = (works, history) else {
            return Ok(Vec::new());
        };
        let pressure = snapshot.field("pressure");
        let pressure = pressure.map_err(|error| Problem::new("", error.to_string(), ""))?;
        let starts = starts(&record.drained, &works.growth.openings().sources, &pressure);
        let courses = courses(snapshot.lattice(), &pressure, &starts, works.scale);
        let events = |kind| record.count(kind) as f64;
        let ends_at_sink =
            |course: &&Course| course.trail.last().is_some_and(|&end| pressure[end] == 0.0);
        let own =
            courses.iter().filter(|course| course.joins.is_none()).filter(ends_at_sink).count();
        let tributaries = courses.iter().filter(|course| course.joins.is_some()).count();
        let longest = courses.iter().map(|course| course.order + 1).max().unwrap_or(0);
        let loops = courses.iter().map(|course: &Course| course.loops.len()).sum::<usize>();
        let values = [
            ("sources_drained", courses.len() as f64),
            ("tributaries", tributaries as f64),
            ("courses_own", own as f64),
            ("longest_sequence", f64::from(longest)),
            ("phreatic_loops", loops as f64),
            (
                "climb_m",
                courses.iter().map(Course::climb_m).fold(0.0, |sum, climb_m| sum + climb_m),
            ),
            ("links", events(CaveEventKind::Link)),
            ("breakthroughs", events(CaveEventKind::Breakthrough)),
            ("captures", events(CaveEventKind::Capture)),
        ];
        Ok(values.map(|(name, value)| (name.to_owned(), value)).into())
    }
}
