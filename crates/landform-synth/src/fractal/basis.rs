//! The noises that octaves are made of, and their places on a lattice.

use std::f64::consts::SQRT_2;

use landform_sim::random::RandomStream;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::cells::{CellNoise, Cells};
use super::cellular::{CellularFeature, CellularNoise};
use super::frame::Frame;
use super::gradient::{Directions, GradientNoise, SimplexNoise};

/// The noise of a single octave, between -1 and 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub enum Basis {
    /// Perlin's gradient noise on squares: hills and hollows of one size, 0 at the corners.
    #[default]
    Gradient,
    /// Perlin's simplex noise, on triangles: fewer directions stand out.
    Simplex,
    /// Worley's F1, the distance to the nearest of random points: round hollows between ridges.
    CellularNearest,
    /// Worley's F2, the distance to the second nearest point.
    CellularSecond,
    /// Worley's F2 - F1: lowest along the borders between the points' cells.
    CellularDifference,
}

impl Basis {
    /// Steepest slope of the noise in cells of unit size: the largest value that the slope takes
    /// at any place with any random numbers. Distances have the slope 1.
    fn steepest(self) -> f64 {
        match self {
            // In the middle of a square, and in the middle of the base of a triangle.
            Self::Gradient => 2.926_175,
            Self::Simplex => 58.0 / 11.0,
            Self::CellularNearest => SQRT_2,
            Self::CellularSecond => 2.0 / 2.5_f64.sqrt(),
            Self::CellularDifference => 4.0 / 2.5_f64.sqrt(),
        }
    }
}

/// One octave: noise of one wavelength, at its place on the ground.
#[derive(Debug)]
pub(super) struct Octave {
    noise: Noise,
    /// Bound of the slope of the noise, a metre.
    pub steepest: f64,
    /// Cells a metre along either axis.
    scale: [f64; 2],
    /// Sine and cosine of the angle by which the octave is turned.
    turn: [f64; 2],
    /// Shift in cells.
    shift: [f64; 2],
    /// What values are multiplied with.
    pub amplitude: f64,
}

#[derive(Debug)]
enum Noise {
    Gradient(GradientNoise),
    Simplex(SimplexNoise),
    Cellular(CellularNoise),
}

/// Where an octave's cells lie and how strong it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    pub number: u64,
    pub wavelength: f64,
    pub turn_deg: f64,
    pub amplitude: f64,
}

impl Octave {
    /// An octave of `basis`. On periodic axes the wavelength is rounded so that a whole number
    /// of cells fits, and the octave is not turned.
    pub fn new(basis: Basis, frame: &Frame, stream: &RandomStream, placement: Placement) -> Self {
        let turned = frame.period.iter().all(Option::is_none);
        let turn_deg = if turned { placement.turn_deg } else { 0.0 };
        let mut scale = [1.0 / placement.wavelength; 2];
        let mut period = [0; 2];
        for axis in 0..2 {
            let Some(extent) = frame.period[axis] else { continue };
            // Rows of triangles repeat in pairs only.
            let step = if axis == 1 && basis == Basis::Simplex { 2.0 } else { 1.0 };
            let cells = step * (extent / (placement.wavelength * step)).round().max(1.0);
            (scale[axis], period[axis]) = (cells / extent, cells as i64);
        }
        let (cells, shift) = Cells::new(stream, placement.number, period);
        let noise = Noise::new(basis, cells);
        let turn = turn_deg.to_radians().sin_cos().into();
        let steepest = basis.steepest() * scale[0].max(scale[1]);
        Self { noise, steepest, scale, turn, shift, amplitude: placement.amplitude }
    }

    /// The noise at `positions` in metres, moved by `translation` cells. `points` is scratch.
    pub fn fill(
        &self,
        positions: &[[f64; 2]],
        translation: [f64; 2],
        points: &mut [[f64; 2]],
        values: &mut [f64],
    ) {
        let (points, values) = (&mut points[..positions.len()], &mut values[..positions.len()]);
        let shift = [0, 1].map(|axis| self.shift[axis] + translation[axis]);
        let [sine, cosine] = self.turn;
        for (point, &[x, y]) in points.iter_mut().zip(positions) {
            let turned = [cosine * x + sine * y, cosine * y - sine * x];
            *point = [0, 1].map(|axis| turned[axis] * self.scale[axis] + shift[axis]);
        }
        match &self.noise {
            Noise::Gradient(noise) => noise.fill(points, values),
            Noise::Simplex(noise) => noise.fill(points, values),
            Noise::Cellular(noise) => noise.fill(points, values),
        }
    }
}

impl Noise {
    fn new(basis: Basis, cells: Cells) -> Self {
        let directions = Directions::shared();
        let cellular = |feature| Self::Cellular(CellularNoise { cells, feature });
        match basis {
            Basis::Gradient => Self::Gradient(GradientNoise { cells, directions }),
            Basis::Simplex => Self::Simplex(SimplexNoise { cells, directions }),
            Basis::CellularNearest => cellular(CellularFeature::Nearest),
            Basis::CellularSecond => cellular(CellularFeature::Second),
            Basis::CellularDifference => cellular(CellularFeature::Difference),
        }
    }
}
