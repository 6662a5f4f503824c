//! Where regions come from.

use std::path::{Path, PathBuf};

use landform_io::{ReadLimits, read_lines};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::NAME;
use crate::SynthError;
use crate::error::Checks;
use crate::exact::{koch_snowflake, sierpinski_carpet_rings, sierpinski_triangle};

/// Most points of a region.
const MOST_POINTS: usize = 100_000;

/// A region of the plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum MaskSource {
    /// Polygons: rings of three points or more, `(east, north)`, which close by themselves.
    Rings(Vec<Vec<[f64; 2]>>),
    /// The lines of a file, closed to rings: CSV with columns `x` and `y`, or `lon` and `lat`, or
    /// GeoJSON. Longitude and latitude become metres east and north of the south-western corner,
    /// true along the middle parallel.
    Outline(PathBuf),
    /// A picture: grey PNG, or any other raster (GeoTIFF, ESRI ASCII, NPY).
    Picture(PathBuf),
    /// A fractal of known dimension in the unit square: `scale` is its side.
    Fractal {
        /// Which one.
        shape: KnownFractal,
        /// How often it is made finer: at most 7 for the snowflake, 9 for the triangle, 5 for the
        /// carpet.
        #[schemars(range(min = 0, max = 9))]
        level: u32,
    },
}

impl Default for MaskSource {
    /// A square of 100 m.
    fn default() -> Self {
        Self::Rings(vec![vec![[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]]])
    }
}

/// Fractals with an inside.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum KnownFractal {
    /// Koch's snowflake; the dimension of its shore is 1.2619.
    Snowflake,
    /// Sierpinski's triangle, of dimension 1.5850.
    Triangle,
    /// Sierpinski's carpet, of dimension 1.8928.
    Carpet,
}

impl MaskSource {
    /// The rings of the region; none for pictures.
    pub(super) fn rings(&self, folder: &Path) -> Result<Option<Vec<Vec<[f64; 2]>>>, SynthError> {
        let rings = match self {
            Self::Rings(rings) => rings.clone(),
            Self::Outline(path) => outline(&folder.join(path))?,
            Self::Fractal { shape, level } => fractal(*shape, *level)?,
            Self::Picture(_) => return Ok(None),
        };
        if rings.is_empty() {
            return Err(unusable("there is no ring; name one of three points or more".to_owned()));
        }
        let points = rings.iter().map(Vec::len).sum::<usize>();
        if points > MOST_POINTS {
            let what = "points of a mask";
            return Err(SynthError::TooLarge { generator: NAME, what, most: MOST_POINTS });
        }
        for (number, ring) in rings.iter().enumerate() {
            let closed = ring.len() > 1 && ring.first() == ring.last();
            let corners = ring.len() - usize::from(closed);
            if corners < 3 {
                let problem =
                    format!("ring {number} has {corners} points; a ring takes at least 3");
                return Err(unusable(problem));
            }
            ring.iter().try_for_each(|point| Checks(NAME).place("of", *point))?;
        }
        Ok(Some(rings))
    }
}

/// A region that cannot be used.
pub(super) fn unusable(problem: String) -> SynthError {
    SynthError::Unusable { generator: NAME, parameter: "of", problem }
}

fn fractal(shape: KnownFractal, level: u32) -> Result<Vec<Vec<[f64; 2]>>, SynthError> {
    let most = match shape {
        KnownFractal::Snowflake => 7,
        KnownFractal::Triangle => 9,
        KnownFractal::Carpet => 5,
    };
    Checks(NAME).range("level", f64::from(level), 0.0..=f64::from(most))?;
    let rings = |rings: Vec<Vec<[f64; 2]>>| rings;
    Ok(match shape {
        KnownFractal::Snowflake => rings(vec![koch_snowflake(level)?]),
        KnownFractal::Triangle => {
            sierpinski_triangle(level)?.into_iter().map(|ring| ring.to_vec()).collect()
        }
        KnownFractal::Carpet => {
            sierpinski_carpet_rings(level)?.into_iter().map(|ring| ring.to_vec()).collect()
        }
    })
}

/// The lines of a file, in metres.
fn outline(path: &Path) -> Result<Vec<Vec<[f64; 2]>>, SynthError> {
    let read = read_lines(path, &ReadLimits { max_cells: MOST_POINTS as u64 });
    let file = read.map_err(|error| unusable(error.to_string()))?;
    Ok(file.into_metres().0)
}
