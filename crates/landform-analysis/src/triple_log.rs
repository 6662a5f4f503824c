//! The triple-log plot of a spectrum: logarithmic along all three axes.

use crate::Spectrum;

/// Most waves a pixel and axis whose logarithms are averaged.
const SAMPLES: i64 = 6;

/// Natural logarithms of the amplitudes of a spectrum over the logarithms of both wave numbers
/// (thesis, figure 2.3 c), on a square of pixels.
///
/// Pixels lie at equal steps of `ln(1 + periods)` on both sides of frequency 0, which stands in the
/// middle. One that covers several waves has the mean of their logarithms (of at most 7 x 7 of
/// them), one that covers none that of the nearest.
#[derive(Clone, Debug, PartialEq)]
pub struct TripleLogPlot {
    /// The logarithms, row by row; the first row has the most negative wave numbers.
    pub logarithms: Vec<f64>,
    /// Number of columns and of rows.
    pub side: usize,
    /// Wave numbers at the ends of both axes: half the nodes and half a wave.
    pub reach: [f64; 2],
}

impl TripleLogPlot {
    /// Draws a spectrum on `side` x `side` pixels; amplitudes below `floor` (above 0, in the unit of
    /// the heights) are drawn as `floor`.
    pub fn new(spectrum: &Spectrum, side: usize, floor: f64) -> Self {
        let floor = floor.max(f64::MIN_POSITIVE);
        let reach = spectrum.size().map(|nodes| (nodes / 2) as f64 + 0.5);
        let axis = |reach: f64| (0..side).map(|pixel| waves(pixel, side, reach)).collect();
        let [across, down]: [Vec<Vec<i64>>; 2] = reach.map(axis);
        let mut logarithms = Vec::with_capacity(side * side);
        for rows in &down {
            for columns in &across {
                let pairs = rows.iter().flat_map(|&y| columns.iter().map(move |&x| [x, y]));
                let sum: f64 = pairs.map(|wave| spectrum.amplitude(wave).max(floor).ln()).sum();
                logarithms.push(sum / (rows.len() * columns.len()) as f64);
            }
        }
        Self { logarithms, side, reach }
    }
}

/// Wave numbers that a pixel of an axis covers, or the one nearest to it.
fn waves(pixel: usize, side: usize, reach: f64) -> Vec<i64> {
    let periods = |place: f64| {
        let share = 2.0 * place / side as f64 - 1.0;
        share.signum() * ((share.abs() * (1.0 + reach).ln()).exp() - 1.0)
    };
    let place = pixel as f64;
    let [first, last] = [periods(place).ceil(), periods(place + 1.0).floor()];
    let [first, last] =
        if first <= last { [first, last] } else { [periods(place + 0.5).round(); 2] };
    let most = reach.floor();
    let [first, last] = [first, last].map(|wave| wave.clamp(-most, most) as i64);
    let step = ((last - first) / SAMPLES + 1) as usize;
    (first..=last).step_by(step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity, Lattice};

    #[test]
    fn pixels_cover_all_waves_in_order() {
        const SIDE: usize = 601;
        for reach in [0.5, 1.5, 20.5, 512.5, 10_000.5] {
            let all: Vec<Vec<i64>> = (0..SIDE).map(|pixel| waves(pixel, SIDE, reach)).collect();
            assert!(all.iter().all(|waves| !waves.is_empty() && waves.len() <= 7), "{reach}");
            assert!(all.concat().is_sorted());
            assert_eq!(all[SIDE / 2], [0]);
            let most = reach as i64;
            assert_eq!(all[0][0], -most);
            assert!(all[SIDE - 1].iter().all(|&wave| wave <= most));
            if reach < 100.0 {
                let mut found = all.concat();
                found.dedup();
                assert_eq!(found, (-most..=most).collect::<Vec<_>>());
            }
        }
    }

    /// A wave of 5 periods to the east and 2 to the south is a pair of bright spots.
    #[test]
    fn a_wave_stands_where_its_numbers_are() {
        let plane =
            Lattice::plane([64, 48], 1.0, Connectivity::Four, [Boundary::Periodic; 2]).unwrap();
        let heights: Vec<f64> = (0..64 * 48)
            .map(|node| (node % 64, node / 64))
            .map(|(x, y)| 5.0 * x as f64 / 64.0 + 2.0 * y as f64 / 48.0)
            .map(|phase| (std::f64::consts::TAU * phase).cos())
            .collect();
        let plot = TripleLogPlot::new(&Spectrum::new(&plane, &heights).unwrap(), 201, 1e-3);
        let place = |wave: f64, reach: f64| 100.5 + 100.5 * (1.0 + wave).ln() / (1.0 + reach).ln();
        let [column, row] =
            [place(5.0, plot.reach[0]) as usize, place(2.0, plot.reach[1]) as usize];
        let mirrored = (200 - column) + 201 * (200 - row);
        let amplitude = (0.5 * f64::from(64 * 48).sqrt()).ln();
        for pixel in [column + 201 * row, mirrored] {
            assert!((plot.logarithms[pixel] - amplitude).abs() < 1e-9, "{pixel}");
        }
        assert_eq!(plot.logarithms[column + 201 * (200 - row)], 1e-3_f64.ln());
    }
}
