//! Lines and dusts whose dimension is known, measured.

use landform_analysis::{
    Polyline, RangeError, ScaleRange, box_dimension, divider_dimension, self_crossings,
};
use landform_graph::Lattice;
use landform_sim::code::Code;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_synth::SynthError;
use landform_synth::exact::{
    cantor_set, koch_curve, quadric_koch_curve, sierpinski_triangle, squig,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::columns;

/// A curve or a dust between two places a kilometre apart.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub enum KnownLine {
    /// Koch's curve, of dimension 1.2619.
    Koch {
        /// How often it is made finer, at most 9.
        #[schemars(range(min = 0, max = 9))]
        level: u32,
    },
    /// Koch's quadric curve, of dimension 1.5.
    QuadricKoch {
        /// How often it is made finer, at most 6.
        #[schemars(range(min = 0, max = 6))]
        level: u32,
    },
    /// Cantor's set, of dimension 0.6309.
    Cantor {
        /// How often it is made finer, at most 16.
        #[schemars(range(min = 0, max = 16))]
        level: u32,
    },
    /// Sierpinski's triangle, of dimension 1.5850.
    Triangle {
        /// How often it is made finer, at most 10.
        #[schemars(range(min = 0, max = 10))]
        level: u32,
    },
    /// A squig, with random numbers of the run's seed.
    Squig {
        /// How often its pieces are parted, at most 11.
        #[schemars(range(min = 0, max = 11))]
        level: u32,
        /// Chance of the shorter way round every bend.
        #[schemars(range(min = 0.5, max = 1.0))]
        shortcut: f64,
    },
}

/// Shape of a line that is known: its dimension by dividers and by boxes, how often it meets itself,
/// and its length by the distance of its ends. Cantor's set and Sierpinski's triangle have a
/// dimension by boxes alone. Of the run it takes the seed.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LineShape {
    /// The line.
    pub of: KnownLine,
    /// Smallest and largest scale; when missing those that suit the line.
    #[schemars(extend("x-unit" = "m"))]
    pub scales_m: Option<(f64, f64)>,
}

impl Default for LineShape {
    fn default() -> Self {
        Self { of: KnownLine::Squig { level: 7, shortcut: 0.75 }, scales_m: None }
    }
}

/// Length of the way from one end to the other, in metres.
const LENGTH_M: f64 = 1000.0;

impl KnownLine {
    /// Its points if it is one line, none if it is a dust.
    fn points(self, seed: u64) -> Result<Option<Vec<[f64; 2]>>, SynthError> {
        Ok(match self {
            Self::Koch { level } => Some(koch_curve(level)?),
            Self::QuadricKoch { level } => Some(quadric_koch_curve(level)?),
            Self::Squig { level, shortcut } => Some(squig(level, shortcut, seed)?),
            Self::Cantor { .. } | Self::Triangle { .. } => None,
        })
    }

    /// Short lines at the places of a dust.
    fn specks(self) -> Result<Vec<[[f64; 2]; 2]>, SynthError> {
        Ok(match self {
            Self::Cantor { level } => {
                let intervals = cantor_set(level)?;
                intervals.into_iter().map(|[from, to]| [[from, 0.0], [to, 0.0]]).collect()
            }
            Self::Triangle { level } => {
                let triangles = sierpinski_triangle(level)?;
                triangles.into_iter().map(|[a, ..]| [a, [a[0] + 1e-9, a[1]]]).collect()
            }
            Self::Koch { .. } | Self::QuadricKoch { .. } | Self::Squig { .. } => Vec::new(),
        })
    }
}

/// A line in metres.
fn line(points: &[[f64; 2]]) -> Option<Polyline> {
    let metres: Vec<[f64; 2]> = points.iter().map(|point| point.map(|at| at * LENGTH_M)).collect();
    Polyline::planar(&metres).ok()
}

impl LineShape {
    fn range(&self, lines: &[Polyline]) -> Result<ScaleRange, RangeError> {
        match self.scales_m {
            Some((least, most)) => ScaleRange::new(least, most),
            None => ScaleRange::usual(lines),
        }
    }
}

impl Metric for LineShape {
    type Memory = ();
    const NAME: &'static str = "LineShape";

    fn validate(&self, _: &Lattice) -> Result<(), Problem> {
        self.of.points(0).map_err(refusal)?;
        self.of.specks().map_err(refusal)?;
        let scales = self.scales_m.map(|(least, most)| ScaleRange::new(least, most));
        let scales = scales.transpose().map(|_| ());
        scales.map_err(|error| misfit(&error))
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let points = self.of.points(snapshot.clock().seed).map_err(refusal)?;
        let specks = self.of.specks().map_err(refusal)?;
        let whole = points.as_deref().and_then(line);
        let lines: Vec<Polyline> =
            whole.into_iter().chain(specks.iter().filter_map(|speck| line(speck))).collect();
        let range = self.range(&lines).map_err(|error| misfit(&error))?;
        let boxes = box_dimension(&lines, &range).map_err(|error| misfit(&error))?;
        let divider = points.as_ref().map(|_| divider_dimension(&lines, &range)).transpose();
        let divider = divider.map_err(|error| misfit(&error))?;
        let of_line = |measure: fn(&[[f64; 2]]) -> f64| points.as_deref().map(measure);
        Ok(columns([
            ("line_box_dimension", Some(boxes.dimension)),
            ("line_divider_dimension", divider.map(|divider| divider.dimension)),
            ("line_crossings", of_line(|points| self_crossings(points) as f64)),
            ("line_tortuosity", of_line(tortuosity)),
        ]))
    }
}

fn refusal(error: SynthError) -> Problem {
    Problem::new("of", error.to_string(), "").code(error.code())
}

fn misfit(error: &dyn std::error::Error) -> Problem {
    Problem::new("scales_m", error.to_string(), "scales that suit the line").code(Code::Rulers)
}

/// Length of a line by the distance of its ends.
fn tortuosity(points: &[[f64; 2]]) -> f64 {
    let distance = |a: [f64; 2], b: [f64; 2]| (b[0] - a[0]).hypot(b[1] - a[1]);
    let length: f64 = points.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
    let ends = points.first().zip(points.last());
    ends.map_or(f64::NAN, |(first, last)| length / distance(*first, *last))
}
