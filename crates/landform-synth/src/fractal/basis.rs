//! The noises that octaves are made of, and their places on a lattice.

use landform_graph::Lattice;
use landform_sim::random::RandomStream;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::cells::{CellNoise, Cells};
use super::cellular::{CellularFeature, CellularNoise};
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

/// One octave: noise of one wavelength, at its place on the lattice.
#[derive(Debug)]
pub(super) struct Octave<'a> {
    noise: Noise<'a>,
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
enum Noise<'a> {
    Gradient(GradientNoise<'a>),
    Simplex(SimplexNoise<'a>),
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

impl<'a> Octave<'a> {
    /// An octave of `basis`. On periodic axes the wavelength is rounded so that a whole number
    /// of cells fits, and the octave is not turned.
    pub fn new(
        basis: Basis,
        lattice: &Lattice,
        stream: &RandomStream,
        placement: Placement,
        directions: &'a Directions,
    ) -> Self {
        let turned = !(lattice.is_periodic(0) || lattice.is_periodic(1));
        let turn_deg = if turned { placement.turn_deg } else { 0.0 };
        let mut scale = [1.0 / placement.wavelength; 2];
        let mut period = [0; 2];
        for axis in (0..2).filter(|&axis| lattice.is_periodic(axis)) {
            let extent = lattice.size()[axis] as f64 * lattice.spacing();
            // Rows of triangles repeat in pairs only.
            let step = if axis == 1 && basis == Basis::Simplex { 2.0 } else { 1.0 };
            let cells = step * (extent / (placement.wavelength * step)).round().max(1.0);
            (scale[axis], period[axis]) = (cells / extent, cells as i64);
        }
        let (cells, shift) = Cells::new(stream, placement.number, period);
        let noise = Noise::new(basis, cells, directions);
        let turn = turn_deg.to_radians().sin_cos().into();
        Self { noise, scale, turn, shift, amplitude: placement.amplitude }
    }

    /// The noise at `positions` in metres, moved by `translation` cells. `points` is scratch.
    pub fn row(
        &self,
        positions: &[[f64; 2]],
        translation: [f64; 2],
        points: &mut [[f64; 2]],
        values: &mut [f64],
    ) {
        let shift = [0, 1].map(|axis| self.shift[axis] + translation[axis]);
        let [sine, cosine] = self.turn;
        for (point, &[x, y]) in points.iter_mut().zip(positions) {
            let turned = [cosine * x + sine * y, cosine * y - sine * x];
            *point = [0, 1].map(|axis| turned[axis] * self.scale[axis] + shift[axis]);
        }
        match &self.noise {
            Noise::Gradient(noise) => noise.row(points, values),
            Noise::Simplex(noise) => noise.row(points, values),
            Noise::Cellular(noise) => noise.row(points, values),
        }
    }
}

impl<'a> Noise<'a> {
    fn new(basis: Basis, cells: Cells, directions: &'a Directions) -> Self {
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
