//! How many numbers have which verdict.

use super::{FigureReport, Verdict};

/// Numbers by their verdicts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// In the order of [`Verdict::ALL`].
    counts: [usize; Verdict::ALL.len()],
}

impl Tally {
    /// The numbers of some figures.
    pub fn of(reports: &[FigureReport]) -> Self {
        let verdicts = || reports.iter().flat_map(|report| &report.targets).map(|of| of.verdict);
        let count = |verdict| verdicts().filter(|found| *found == verdict).count();
        Self { counts: Verdict::ALL.map(count) }
    }

    /// All of them.
    pub fn all(self) -> usize {
        self.counts.iter().sum()
    }

    /// Those that have a verdict.
    pub fn count(self, verdict: Verdict) -> usize {
        let pairs = Verdict::ALL.into_iter().zip(self.counts);
        pairs.filter(|(of, _)| *of == verdict).map(|(_, count)| count).sum()
    }

    /// Those that have a band and were found.
    pub fn judged(self) -> usize {
        [Verdict::Reproduced, Verdict::Partly, Verdict::Missed]
            .map(|of| self.count(of))
            .iter()
            .sum()
    }
}

impl std::fmt::Display for Tally {
    /// `251 numbers with a band: 232 reproduced (92 %), 13 partly, 6 missed`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (judged, good) = (self.judged(), self.count(Verdict::Reproduced));
        let share = 100.0 * good as f64 / judged.max(1) as f64;
        let [partly, missed] = [Verdict::Partly, Verdict::Missed].map(|of| self.count(of));
        write!(
            f,
            "{judged} numbers with a band: {good} reproduced ({share:.0} %), {partly} partly, \
             {missed} missed"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::TargetReport;

    #[test]
    fn numbers_are_counted_by_their_verdicts() {
        let target = |verdict| TargetReport {
            name: String::new(),
            value: None,
            seeds: Vec::new(),
            thesis: None,
            band: String::new(),
            verdict,
            reason: String::new(),
        };
        let report = |verdicts: &[Verdict]| FigureReport {
            name: String::new(),
            id: String::new(),
            title: String::new(),
            source: String::new(),
            scenarios: Vec::new(),
            data: Vec::new(),
            pictures: Vec::new(),
            targets: verdicts.iter().copied().map(target).collect(),
        };
        let reports = [
            report(&[Verdict::Reproduced, Verdict::Missed, Verdict::Absent]),
            report(&[Verdict::Reproduced, Verdict::Partly, Verdict::Printed, Verdict::Reproduced]),
        ];
        let tally = Tally::of(&reports);
        assert_eq!((tally.all(), tally.judged(), tally.count(Verdict::Reproduced)), (7, 5, 3));
        let told = "5 numbers with a band: 3 reproduced (60 %), 1 partly, 1 missed";
        assert_eq!(tally.to_string(), told);
        assert_eq!(Tally::of(&[]).judged(), 0);
    }
}
