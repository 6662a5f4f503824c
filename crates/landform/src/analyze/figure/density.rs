//! The triple-log plot of a spectrum.

use landform_analysis::{SpectralFit, Spectrum};
use landform_view::plot::{Axis, ColourScale, Panel, Picture};
use landform_view::{ColourMap, Ground, ViewError, flat};

use super::super::SpectralNumbers;

/// Pixels of the plot along either side; odd, so that frequency 0 has one of its own.
const SIDE: usize = 601;
/// Most waves a pixel and axis whose logarithms are averaged.
const SAMPLES: i64 = 6;

/// Logarithms of the amplitudes of a spectrum over the logarithms of both wave numbers.
#[derive(Clone, Debug)]
pub(in crate::analyze) struct Density {
    /// Natural logarithms, row by row from the north.
    logarithms: Vec<f64>,
    /// Largest wave numbers along both axes.
    reach: [f64; 2],
}

impl Density {
    /// Draws a spectrum into pixels at equal steps of `ln(1 + periods)` on both sides of 0. A pixel
    /// is the mean logarithm of the waves in it, at most 6 x 6 of them, or that of the nearest one.
    pub fn new(spectrum: &Spectrum) -> Self {
        let reach = spectrum.size().map(|nodes| (nodes / 2) as f64 + 0.5);
        let waves = reach.map(|reach| (0..SIDE).map(|pixel| waves(pixel, reach)).collect());
        let [across, down]: [Vec<Vec<i64>>; 2] = waves;
        let mut logarithms = Vec::with_capacity(SIDE * SIDE);
        for rows in &down {
            for columns in &across {
                let pairs = rows.iter().flat_map(|&y| columns.iter().map(move |&x| [x, y]));
                let sum: f64 = pairs
                    .map(|periods| spectrum.amplitude(periods).max(SpectralFit::FLOOR).ln())
                    .sum();
                logarithms.push(sum / (rows.len() * columns.len()) as f64);
            }
        }
        Self { logarithms, reach }
    }

    /// The plot with the two numbers of the thesis below it.
    pub fn panel(&self, numbers: &SpectralNumbers) -> Result<Panel, ViewError> {
        let colours = ColourMap::named("batlow")?;
        let range = flat::finite_range(&self.logarithms);
        let image = flat::colour_field(&self.logarithms, SIDE, SIDE, colours, Some(range), 1)?;
        let ground = Ground { range_m: Some(range), ..Ground::new(colours) };
        let label = "ln of the amplitude in metres".to_owned();
        let [x, y] = self.reach.map(|reach| [-reach, reach]);
        let axis = |label: &str, range| Axis { range: Some(range), ..Axis::signed_log(label) };
        Ok(Panel {
            title: "spectral density".to_owned(),
            x: axis("waves from west to east", x),
            y: axis("waves from south to north", y),
            picture: Some(Picture { image, x, y }),
            colours: Some(ColourScale { ground, range, label }),
            caption: caption(numbers),
            ..Panel::default()
        })
    }
}

/// Wave numbers that a pixel of an axis covers, or the one nearest to it.
fn waves(pixel: usize, reach: f64) -> Vec<i64> {
    let periods = |place: f64| {
        let share = 2.0 * place / SIDE as f64 - 1.0;
        share.signum() * ((share.abs() * (1.0 + reach).ln()).exp() - 1.0)
    };
    let [first, last] = [periods(pixel as f64).ceil(), periods(pixel as f64 + 1.0).floor()];
    let most = reach.floor();
    let [first, last] = match first <= last {
        true => [first, last],
        false => [periods(pixel as f64 + 0.5).round(); 2],
    };
    let [first, last] = [first, last].map(|wave| wave.clamp(-most, most) as i64);
    let step = ((last - first) / SAMPLES + 1).max(1) as usize;
    (first..=last).step_by(step).collect()
}

fn caption(numbers: &SpectralNumbers) -> String {
    let mut parts = Vec::new();
    if let (Some(rms), Some(r2)) = (numbers.rms, numbers.r2) {
        parts.push(format!("RMS {rms:.3}, R² {r2:.3}"));
    }
    if let (Some(beta), Some(error)) = (numbers.beta, numbers.beta_error) {
        parts.push(format!("β {beta:.2} ± {error:.2}"));
    }
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_cover_all_waves_in_order() {
        for reach in [0.5, 1.5, 20.5, 512.5, 10_000.5] {
            let all: Vec<Vec<i64>> = (0..SIDE).map(|pixel| waves(pixel, reach)).collect();
            assert!(all.iter().all(|waves| !waves.is_empty() && waves.len() <= 7), "{reach}");
            assert!(all.concat().is_sorted());
            assert_eq!(all[SIDE / 2], [0]);
            let most = reach as i64;
            assert_eq!([all[0][0], all[SIDE - 1].last().copied().unwrap()][0], -most);
            if reach < 100.0 {
                let mut found = all.concat();
                found.dedup();
                assert_eq!(found, (-most..=most).collect::<Vec<_>>());
            }
        }
    }
}
