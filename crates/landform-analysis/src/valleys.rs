//! Spacing of valleys along lines that cross them.

/// Valleys counted along parallel lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValleySpacing {
    /// Length of a line over its mean number of valleys, in metres.
    pub spacing_m: f64,
    /// Root mean square over the lines of the standard deviation of their heights, in metres.
    pub amplitude_m: f64,
}

/// Depth of a valley below both crests beside it, as a share of the standard deviation of its line.
const PROMINENCE: f64 = 0.5;

/// The spacing of valleys along `lines`, each the heights in metres of points `step_m` apart. A valley is
/// the lowest point between two crests that rise above it by at least half the standard deviation of the
/// heights of the line. On `closed` lines the last point lies beside the first. `None` without valleys.
///
/// Spectra see branches and bends of large valleys as long waves, which shift a mean wavelength or a peak
/// upwards where valleys are fine; a count does not.
pub fn valley_spacing<'a>(
    lines: impl IntoIterator<Item = &'a [f64]>,
    step_m: f64,
    closed: bool,
) -> Option<ValleySpacing> {
    let [mut length_m, mut valleys, mut variances, mut count] = [0.0; 4];
    for line in lines {
        let variance = variance(line);
        length_m += step_m * line.len() as f64;
        valleys += valleys_of(line, PROMINENCE * variance.sqrt(), closed) as f64;
        variances += variance;
        count += 1.0;
    }
    let amplitude_m = (variances / count).sqrt();
    (valleys > 0.0).then(|| ValleySpacing { spacing_m: length_m / valleys, amplitude_m })
}

fn variance(line: &[f64]) -> f64 {
    let count = line.len().max(1) as f64;
    let mean = line.iter().sum::<f64>() / count;
    line.iter().map(|height| (height - mean).powi(2)).sum::<f64>() / count
}

/// Number of valleys at least `depth` below the crests on both sides.
fn valleys_of(line: &[f64], depth: f64, closed: bool) -> usize {
    let highest = (0..line.len()).max_by(|&a, &b| line[a].total_cmp(&line[b]));
    let Some(highest) = highest.filter(|_| depth > 0.0) else { return 0 };
    let around = |at: usize| line[(highest + at) % line.len()];
    let heights: Vec<f64> = match closed {
        true => (0..=line.len()).map(around).collect(),
        false => line.to_vec(),
    };
    let mut valleys = 0;
    // Highest point since the last valley; while one is entered, its lowest point.
    let mut crest = heights[0];
    let mut floor = None;
    for height in heights {
        match floor {
            None => {
                crest = crest.max(height);
                floor = (crest - height >= depth).then_some(height);
            }
            Some(lowest) if height - lowest >= depth => {
                valleys += 1;
                (crest, floor) = (height, None);
            }
            Some(lowest) => floor = Some(height.min(lowest)),
        }
    }
    valleys
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(count: usize, period: f64, phase: f64) -> Vec<f64> {
        let height = |at: usize| (std::f64::consts::TAU * at as f64 / period + phase).sin();
        (0..count).map(height).collect()
    }

    #[test]
    fn waves_have_their_length() {
        for phase in [0.0, 1.0, 2.0, 4.0, 5.5] {
            let lines = [wave(240, 24.0, phase), wave(240, 24.0, phase + 0.3)];
            let lines = || lines.iter().map(Vec::as_slice);
            let closed = valley_spacing(lines(), 5.0, true).unwrap();
            assert!((closed.spacing_m - 120.0).abs() < 1e-9);
            assert!((closed.amplitude_m - 0.5_f64.sqrt()).abs() < 1e-9);
            // Valleys that the ends cut do not count.
            let open = valley_spacing(lines(), 5.0, false).unwrap();
            assert!((120.0..=120.0 * 10.0 / 9.0 + 1e-9).contains(&open.spacing_m));
        }
    }

    /// Ripples that are small beside the waves are no valleys.
    #[test]
    fn shallow_hollows_do_not_count() {
        let [long, short] = [wave(400, 100.0, 0.5), wave(400, 8.0, 0.0)];
        let with = |share: f64| -> Vec<f64> {
            long.iter().zip(&short).map(|(long, short)| long + share * short).collect()
        };
        let spacing = |line: &[f64]| valley_spacing([line], 1.0, true).unwrap().spacing_m;
        assert_eq!(spacing(&with(0.1)), 100.0);
        assert!(spacing(&with(1.0)) < 20.0);
    }

    #[test]
    fn level_and_empty_lines_have_none() {
        let level = [3.0; 9];
        for line in [&level[..], &level[..1], &[]] {
            assert_eq!(valley_spacing([line], 1.0, true), None);
        }
        assert_eq!(valley_spacing([], 1.0, false), None);
    }
}
