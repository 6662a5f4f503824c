//! The amplitude of every wave of a height field, by a two-dimensional Fourier transform.

use landform_graph::Lattice;
use rayon::prelude::*;
use realfft::num_complex::Complex;
use realfft::{RealFftPlanner, RealToComplex};
use rustfft::FftPlanner;
use thiserror::Error;

use crate::grid::Grid;

/// Why a height field cannot be analysed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum AnalysisError {
    /// The field does not belong to the lattice.
    #[error("the field has {values} values but the lattice has {nodes} nodes; pass one a node")]
    Length {
        /// Number of values passed.
        values: usize,
        /// Number of nodes of the lattice.
        nodes: usize,
    },
    /// The lattice is a volume.
    #[error("the lattice has {layers} layers; a height field has one: take a layer or a surface")]
    Volume {
        /// Number of layers of the lattice.
        layers: usize,
    },
    /// A height is infinite, not a number, or so large that its square could be.
    #[error("the height of node {node} is {value}; every height must be finite and below 1e100")]
    NotFinite {
        /// Index of the first such node.
        node: usize,
        /// Its height.
        value: f64,
    },
    /// Too little is left to fit a line through.
    #[error(
        "only {points} points are left to fit a line to, at least 3 are needed; \
         the terrain is flat or the lattice too small"
    )]
    TooFewPoints {
        /// Number of points left.
        points: usize,
    },
}

/// One wave of a spectrum: see [`Spectrum::waves`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Whole periods across the width and the height of the lattice; negative ones run the
    /// other way.
    pub periods: [i64; 2],
    /// Frequency in periods per side of a square of the same area in metres. On a square lattice
    /// it is the length of [`Wave::periods`].
    pub frequency: f64,
    /// Amplitude in the unit of the heights: see [`Spectrum`].
    pub amplitude: f64,
}

/// Amplitudes of the discrete Fourier transform of a height field.
///
/// The transform is unitary: amplitude = |DFT| / sqrt(nodes), so the squares of the amplitudes
/// add up to the squares of the heights. Those squares are the spectral density of definition
/// 7 of the thesis up to a constant factor.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    size: [usize; 2],
    cell_m: [f64; 2],
    amplitudes: Vec<f64>,
}

impl Spectrum {
    /// Transforms `heights` (one value a node of a 2-D `lattice`, usually metres).
    ///
    /// Any size works; sizes with small prime factors are fastest. Cost: N log N.
    ///
    /// # Errors
    /// [`AnalysisError`] if the field does not fit the lattice, or holds a value that is not
    /// finite.
    pub fn new(lattice: &Lattice, heights: &[f64]) -> Result<Self, AnalysisError> {
        check(lattice, heights)?;
        let size = [lattice.width(), lattice.height()];
        let amplitudes = amplitudes(heights, size);
        Ok(Self { size, cell_m: [lattice.spacing(); 2], amplitudes })
    }

    /// The same spectrum over the cells of a grid, which may be oblong, as those of rasters in
    /// degrees are on the ground: frequencies are counted a metre, not a cell.
    #[must_use]
    pub fn on_cells_of(self, grid: &Grid) -> Self {
        Self { cell_m: grid.cell_size(), ..self }
    }

    /// Number of columns and rows.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Amplitude of the wave with `periods` whole periods across the width and the height.
    /// Counts beyond half the number of nodes stand for their aliases.
    pub fn amplitude(&self, periods: [i64; 2]) -> f64 {
        let [width, height] = self.size;
        let column = periods[0].rem_euclid(width as i64) as usize;
        let row = periods[1].rem_euclid(height as i64) as usize;
        self.amplitudes[column + width * row]
    }

    /// The waves that are independent of each other, the mean height (frequency 0) included.
    ///
    /// The heights are real, so the wave with periods (x, y) has the amplitude of the one with
    /// (-x, -y), and only one of the two is given: 32770 of the 65536 on a 256 x 256 lattice.
    pub fn waves(&self) -> impl Iterator<Item = Wave> + '_ {
        let [width, height] = self.size;
        (0..=width / 2).flat_map(move |column| {
            let own_mirror = column == 0 || 2 * column == width;
            let rows = if own_mirror { height / 2 + 1 } else { height };
            (0..rows).map(move |row| self.wave(column, row))
        })
    }

    /// Share of the waves above half the Nyquist frequency that are empty: those with less than
    /// a thousandth of the amplitude that the smoothest fractional Brownian surface (H = 1, a
    /// fall-off as 1 / frequency squared) with the same strongest wave has at their frequency.
    ///
    /// Such surfaces have next to none, sums of few octaves of noise many (thesis, figure 2.7).
    /// `None` for a level surface and for lattices without such waves.
    pub fn empty_share(&self) -> Option<f64> {
        let moving = || self.waves().filter(|wave| wave.frequency > 0.0);
        let strongest = moving().max_by(|a, b| a.amplitude.total_cmp(&b.amplitude))?;
        if strongest.amplitude == 0.0 {
            return None;
        }
        let half_nyquist = (self.size[0] as f64 * self.size[1] as f64).sqrt() / 4.0;
        let [mut fine, mut empty] = [0.0; 2];
        for wave in moving().filter(|wave| wave.frequency > half_nyquist) {
            let falloff = (strongest.frequency / wave.frequency).powi(2);
            let least = 1e-3 * strongest.amplitude * falloff;
            fine += 1.0;
            empty += f64::from(u8::from(wave.amplitude < least));
        }
        (fine > 0.0).then_some(empty / fine)
    }

    fn wave(&self, column: usize, row: usize) -> Wave {
        let [width, height] = self.size;
        let periods = [signed(column, width), signed(row, height)];
        let side = (width as f64 * height as f64).sqrt();
        let stretch = self.stretch();
        let [x, y] = [0, 1]
            .map(|axis| periods[axis] as f64 * (side / self.size[axis] as f64) * stretch[axis]);
        let amplitude = self.amplitudes[column + width * row];
        Wave { periods, frequency: (x * x + y * y).sqrt(), amplitude }
    }

    /// Frequency 1 of [`Wave::frequency`] in periods a metre.
    pub fn base_frequency_per_m(&self) -> f64 {
        let [width, height] = self.size;
        1.0 / ((width as f64 * height as f64).sqrt() * (self.cell_m[0] * self.cell_m[1]).sqrt())
    }

    /// Half the Nyquist frequency of the longer side of the cells, in periods per side: see
    /// [`Wave::frequency`].
    pub fn half_nyquist(&self) -> f64 {
        let [width, height] = self.size;
        let [x, y] = self.stretch();
        (width as f64 * height as f64).sqrt() / 4.0 * x.min(y)
    }

    /// Side of a square of a cell's area, in widths and in heights of the cell.
    fn stretch(&self) -> [f64; 2] {
        let [width, height] = self.cell_m;
        [(height / width).sqrt(), (width / height).sqrt()]
    }

    /// The triple-log plot of the thesis (figure 2.3): natural logarithm of the amplitude at
    /// every wave, frequency 0 at column `width / 2` and row `height / 2`, in node order.
    ///
    /// Amplitudes below `floor` (greater than 0, in the unit of the heights) are drawn as
    /// `floor`. The axes are linear: an axis on which distance from the centre is
    /// `ln(frequency)` belongs to whoever draws it.
    pub fn triple_log_plot(&self, floor: f64) -> Vec<f64> {
        let [width, height] = self.size;
        let floor = floor.max(f64::MIN_POSITIVE);
        (0..width * height)
            .map(|pixel| {
                let x = (pixel % width) as i64 - (width / 2) as i64;
                let y = (pixel / width) as i64 - (height / 2) as i64;
                self.amplitude([x, y]).max(floor).ln()
            })
            .collect()
    }
}

/// Whether `heights` are the finite heights of a 2-D lattice.
pub(crate) fn check(lattice: &Lattice, heights: &[f64]) -> Result<(), AnalysisError> {
    if lattice.depth() != 1 {
        return Err(AnalysisError::Volume { layers: lattice.depth() });
    }
    if heights.len() != lattice.node_count() {
        let [values, nodes] = [heights.len(), lattice.node_count()];
        return Err(AnalysisError::Length { values, nodes });
    }
    match heights.iter().position(|height| height.is_nan() || height.abs() > 1e100) {
        Some(node) => Err(AnalysisError::NotFinite { node, value: heights[node] }),
        None => Ok(()),
    }
}

/// Number of periods that entry `index` of a transform of `length` stands for.
fn signed(index: usize, length: usize) -> i64 {
    match 2 * index > length {
        true => index as i64 - length as i64,
        false => index as i64,
    }
}

/// Unitary amplitudes of all waves: real transforms along the rows, complex ones down the
/// columns of the half that they fill, the other half by symmetry.
fn amplitudes(heights: &[f64], [width, height]: [usize; 2]) -> Vec<f64> {
    let columns = half_spectrum(heights, [width, height]);
    let scale = 1.0 / (width as f64 * height as f64).sqrt();
    let mut amplitudes = vec![0.0; width * height];
    amplitudes.par_chunks_mut(width).enumerate().for_each(|(row, line)| {
        let mirror_row = (height - row) % height;
        for (column, amplitude) in line.iter_mut().enumerate() {
            let entry = match column <= width / 2 {
                true => columns[column * height + row],
                false => columns[(width - column) * height + mirror_row],
            };
            *amplitude = entry.norm() * scale;
        }
    });
    amplitudes
}

/// The transform for 0 to `width / 2` periods across the width, column after column.
fn half_spectrum(heights: &[f64], [width, height]: [usize; 2]) -> Vec<Complex<f64>> {
    let mut planner = RealFftPlanner::<f64>::new();
    let along_rows = planner.plan_fft_forward(width);
    let half = width / 2 + 1;
    let mut rows = vec![Complex::default(); half * height];
    rows.par_chunks_mut(half)
        .zip(heights.par_chunks(width))
        .for_each(|(output, input)| transform_row(along_rows.as_ref(), input, output));

    let mut columns = vec![Complex::default(); half * height];
    let down_columns = FftPlanner::<f64>::new().plan_fft_forward(height);
    columns.par_chunks_mut(height).enumerate().for_each(|(column, line)| {
        for (row, entry) in line.iter_mut().enumerate() {
            *entry = rows[row * half + column];
        }
        down_columns.process(line);
    });
    columns
}

fn transform_row(plan: &dyn RealToComplex<f64>, input: &[f64], output: &mut [Complex<f64>]) {
    let mut scratch_row = input.to_vec();
    plan.process(&mut scratch_row, output).expect("the plan was made for rows of this length");
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};
    use std::f64::consts::TAU;

    fn lattice(size: [usize; 2]) -> Lattice {
        Lattice::plane(size, 1.0, Connectivity::Eight, [Boundary::Periodic; 2]).unwrap()
    }

    /// Heights without any symmetry.
    fn rough([width, height]: [usize; 2]) -> Vec<f64> {
        (0..width * height).map(|i| ((i * i * 7 + i * 3) % 101) as f64 / 10.0 - 3.0).collect()
    }

    /// The definition of the transform, wave by wave.
    fn by_definition(heights: &[f64], [width, height]: [usize; 2], [p, q]: [i64; 2]) -> f64 {
        let mut sum = Complex::new(0.0, 0.0);
        for (node, &value) in heights.iter().enumerate() {
            let x = (node % width) as f64 * p as f64 / width as f64;
            let y = (node / width) as f64 * q as f64 / height as f64;
            sum += Complex::from_polar(value, -TAU * (x + y));
        }
        sum.norm() / ((width * height) as f64).sqrt()
    }

    #[test]
    fn any_size_agrees_with_the_definition() {
        for size in [[8, 8], [7, 5], [6, 9], [16, 3], [5, 1], [1, 4]] {
            let heights = rough(size);
            let plane = Lattice::plane(size, 1.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
            let spectrum = Spectrum::new(&plane, &heights).unwrap();
            for p in -(size[0] as i64) / 2..=size[0] as i64 / 2 {
                for q in -(size[1] as i64) / 2..=size[1] as i64 / 2 {
                    let expected = by_definition(&heights, size, [p, q]);
                    let found = spectrum.amplitude([p, q]);
                    assert!((found - expected).abs() < 1e-9, "{size:?} {p} {q}");
                }
            }
        }
    }

    #[test]
    fn each_pair_of_waves_is_given_once() {
        let count = |size| Spectrum::new(&lattice(size), &rough(size)).unwrap().waves().count();
        assert_eq!(count([256, 256]), 32_770, "the number in section 2.1.6 of the thesis");
        assert_eq!(count([5, 5]), 13);
        assert_eq!(count([6, 5]), 16);
    }

    #[test]
    fn squares_add_up_to_those_of_the_heights() {
        let size = [12, 9];
        let heights = rough(size);
        let spectrum = Spectrum::new(&lattice(size), &heights).unwrap();
        let squares: f64 = spectrum.amplitudes.iter().map(|a| a * a).sum();
        let expected: f64 = heights.iter().map(|h| h * h).sum();
        assert!((squares / expected - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_wave_has_the_same_frequency_in_metres_on_any_shape() {
        let size = [64, 16];
        let heights: Vec<f64> =
            (0..1024).map(|node| (TAU * (node % 64) as f64 / 8.0).cos()).collect();
        let spectrum = Spectrum::new(&lattice(size), &heights).unwrap();
        let peak = spectrum.waves().max_by(|a, b| a.amplitude.total_cmp(&b.amplitude)).unwrap();
        let per_metre = peak.frequency * spectrum.base_frequency_per_m();
        assert!((per_metre - 0.125).abs() < 1e-12, "{per_metre} periods a metre");
    }

    /// Waves of 400 m to the east and of 400 m to the south on cells of 25 m by 50 m.
    #[test]
    fn frequencies_are_those_on_the_ground_where_cells_are_oblong() {
        let size = [64, 48];
        let oblong = Grid::new(size, [25.0, 50.0]).unwrap();
        for (east, south, periods) in [(16.0, f64::INFINITY, [4, 0]), (f64::INFINITY, 8.0, [0, 6])]
        {
            let heights: Vec<f64> = (0..64 * 48)
                .map(|node| (TAU * ((node % 64) as f64 / east + (node / 64) as f64 / south)).cos())
                .collect();
            let spectrum = Spectrum::new(&lattice(size), &heights).unwrap().on_cells_of(&oblong);
            let peak = spectrum.waves().max_by(|a, b| a.amplitude.total_cmp(&b.amplitude)).unwrap();
            assert_eq!(peak.periods.map(i64::abs), periods);
            let per_metre = peak.frequency * spectrum.base_frequency_per_m();
            assert!((per_metre * 400.0 - 1.0).abs() < 1e-12, "{per_metre} periods a metre");
        }
        let spectrum = Spectrum::new(&lattice(size), &vec![0.0; 64 * 48]).unwrap();
        let highest =
            |spectrum: &Spectrum| spectrum.half_nyquist() * spectrum.base_frequency_per_m();
        assert_eq!(highest(&spectrum), 0.25);
        let highest = highest(&spectrum.on_cells_of(&oblong));
        assert!((highest * 200.0 - 1.0).abs() < 1e-12, "{highest}: four cells of 50 m a period");
    }

    #[test]
    fn the_plot_is_centred() {
        let size = [6, 5];
        let plot = Spectrum::new(&lattice(size), &[2.0; 30]).unwrap().triple_log_plot(1e-3);
        let highest = plot.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).unwrap();
        assert_eq!(highest.0, 3 + 6 * 2);
        assert!((highest.1 - (2.0 * 30.0_f64.sqrt()).ln()).abs() < 1e-12);
        assert_eq!(plot[0], 1e-3_f64.ln());
    }

    #[test]
    fn bad_fields_are_refused() {
        let plane = lattice([4, 4]);
        assert!(matches!(Spectrum::new(&plane, &[0.0; 3]), Err(AnalysisError::Length { .. })));
        let mut heights = [0.0; 16];
        heights[5] = f64::NAN;
        let refused = Spectrum::new(&plane, &heights).unwrap_err();
        assert!(matches!(refused, AnalysisError::NotFinite { node: 5, .. }), "{refused}");
        let open = [Boundary::Open; 3];
        let volume = Lattice::volume([2, 2, 2], 1.0, Connectivity::Voxel6, open).unwrap();
        let refused = Spectrum::new(&volume, &[0.0; 8]).unwrap_err();
        assert_eq!(refused, AnalysisError::Volume { layers: 2 });
    }
}
