//! Our numbers beside the thesis', and the verdicts.

use std::path::PathBuf;

use serde::Serialize;

use super::{Average, Target};

/// Whether a number was reproduced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// The average lies in the band, and so do the numbers of most seeds.
    Reproduced,
    /// The average lies in the band, but a seed in four or more does not.
    Partly,
    /// The average lies outside the band.
    Missed,
    /// There is no band: the number stands beside the thesis' own.
    Printed,
    /// The data that it is taken from are not there: neither reproduced nor missed.
    Absent,
}

impl Verdict {
    /// All of them, from the best.
    pub const ALL: [Self; 5] =
        [Self::Reproduced, Self::Partly, Self::Missed, Self::Printed, Self::Absent];

    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::Partly => "partly",
            Self::Missed => "missed",
            Self::Printed => "printed",
            Self::Absent => "absent",
        }
    }
}

/// Our numbers beside those of a figure.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FigureReport {
    /// Name of its target file, and of the folder of its pictures.
    pub name: String,
    /// Name in the thesis or another source: `figure 5.9`.
    pub id: String,
    /// What it shows.
    pub title: String,
    /// What the numbers beside ours are from.
    pub source: String,
    /// The scenarios that made it.
    pub scenarios: Vec<PathBuf>,
    /// The files of data that were analysed for it.
    pub data: Vec<PathBuf>,
    /// Pictures of the first seed, relative to the output folder.
    pub pictures: Vec<PathBuf>,
    /// The numbers.
    pub targets: Vec<TargetReport>,
}

/// Our number beside one of the thesis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TargetReport {
    /// What it is.
    pub name: String,
    /// Average over the seeds, the median unless the figure says otherwise; none where data are absent.
    pub value: Option<f64>,
    /// The number of each seed, from seed 1.
    pub seeds: Vec<f64>,
    /// The thesis' number.
    pub thesis: Option<f64>,
    /// What counts as reproduced.
    pub band: String,
    /// Whether it was reproduced.
    pub verdict: Verdict,
    /// What is known about a difference.
    pub reason: String,
}

impl TargetReport {
    /// The thesis' number, ours, and the smallest and the largest over the seeds, as text; a dash for
    /// what there is not. Ours have as many decimals as the thesis and the band, two at least.
    pub fn columns(&self) -> [String; 3] {
        let thesis = self.thesis.map_or("-".to_owned(), |value| value.to_string());
        let digits = decimals(&thesis).max(decimals(&self.band)).max(2);
        let low = self.seeds.iter().copied().fold(f64::INFINITY, f64::min);
        let high = self.seeds.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        match self.value {
            Some(value) => {
                [thesis, format!("{value:.digits$}"), format!("{low:.digits$} to {high:.digits$}")]
            }
            None => [thesis, "-".to_owned(), "-".to_owned()],
        }
    }
}

/// Most decimals of a number in a text.
fn decimals(text: &str) -> usize {
    let after = text.split('.').skip(1);
    let digits = |rest: &str| rest.chars().take_while(char::is_ascii_digit).count();
    after.map(digits).max().unwrap_or(0)
}

/// Compares the numbers of a target; there are none where data are absent.
pub(super) fn judge(
    target: &Target,
    average: Average,
    seeds: Vec<f64>,
    absence: Option<&str>,
) -> TargetReport {
    let value = average.of(&seeds);
    let outside = seeds.iter().filter(|&&value| target.band.holds(value) == Some(false)).count();
    let verdict = match value.map(|value| target.band.holds(value)) {
        None => Verdict::Absent,
        Some(None) => Verdict::Printed,
        Some(Some(false)) => Verdict::Missed,
        Some(Some(true)) if 4 * outside >= seeds.len() => Verdict::Partly,
        Some(Some(true)) => Verdict::Reproduced,
    };
    TargetReport {
        name: target.name.clone(),
        value,
        seeds,
        thesis: target.thesis,
        band: target.band.to_string(),
        verdict,
        reason: absence.unwrap_or(&target.reason).to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::{Band, Quantity, Source};

    fn verdict(band: Band, seeds: &[f64]) -> (f64, Verdict) {
        let source = Source { run: String::new(), stage: String::new(), metric: String::new() };
        let target = Target {
            name: String::new(),
            value: Quantity::Metric(source),
            thesis: None,
            band,
            reason: String::new(),
        };
        let report = judge(&target, Average::Median, seeds.to_vec(), None);
        (report.value.unwrap_or(f64::NAN), report.verdict)
    }

    #[test]
    fn averages_are_medians_or_means() {
        let seeds = [5.0, 1.0, 3.0, 2.0, 9.0];
        assert_eq!(
            [Average::Median, Average::Mean].map(|of| of.of(&seeds)),
            [Some(3.0), Some(4.0)]
        );
        assert_eq!([Average::Median, Average::Mean].map(|of| of.of(&[])), [None; 2]);
    }

    #[test]
    fn verdicts_follow_the_median_and_the_seeds() {
        let seeds = [5.0, 1.0, 3.0, 2.0, 4.0];
        assert_eq!(verdict(Band::Printed, &seeds), (3.0, Verdict::Printed));
        assert_eq!(verdict(Band::AtMost(5.0), &seeds), (3.0, Verdict::Reproduced));
        assert_eq!(verdict(Band::AtMost(4.5), &seeds), (3.0, Verdict::Reproduced));
        assert_eq!(verdict(Band::AtMost(3.5), &seeds), (3.0, Verdict::Partly));
        assert_eq!(verdict(Band::AtLeast(3.5), &seeds), (3.0, Verdict::Missed));
        assert_eq!(verdict(Band::Within(0.0, 9.0), &seeds), (3.0, Verdict::Reproduced));
    }
}
