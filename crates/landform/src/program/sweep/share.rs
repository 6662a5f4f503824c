//! Shares of the runs of a sweep, for arrays of jobs on a cluster.

/// One of several equal shares of the runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Share {
    /// Number of the share, from zero.
    index: usize,
    /// Number of shares.
    count: usize,
}

impl Share {
    /// Reads `I/N`, counted from one; everything without it.
    pub fn parse(text: Option<&str>) -> Result<Self, String> {
        let Some(text) = text else { return Ok(Self { index: 0, count: 1 }) };
        let numbers = text.split_once('/').and_then(|(index, count)| {
            Some((index.trim().parse::<usize>().ok()?, count.trim().parse::<usize>().ok()?))
        });
        match numbers {
            Some((index, count)) if (1..=count).contains(&index) => {
                Ok(Self { index: index - 1, count })
            }
            Some((0, _)) => Err(format!(
                "--index {text}: shares are counted from 1; with Slurm use --array=1-N"
            )),
            _ => Err(format!("--index {text}: write it as I/N with I from 1 to N, 3/10 say")),
        }
    }

    /// Whether the share is the whole.
    pub fn is_all(self) -> bool {
        self.count == 1
    }

    /// Whether a run, counted from zero, belongs to the share. Shares take turns, so that long
    /// runs, which often lie at one end of a grid, are spread over them.
    pub fn has(self, run: usize) -> bool {
        run % self.count == self.index
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_run_belongs_to_one_share() {
        let shares: Vec<Share> =
            (1..=3).map(|index| Share::parse(Some(&format!("{index}/3"))).unwrap()).collect();
        for run in 0..20 {
            assert_eq!(shares.iter().filter(|share| share.has(run)).count(), 1);
        }
        assert!(Share::parse(None).unwrap().has(7) && Share::parse(Some("1/1")).unwrap().is_all());
    }

    #[test]
    fn other_texts_are_refused() {
        for text in ["", "3", "0/3", "4/3", "a/b", "1/0", "-1/2", "1/2/3"] {
            let message = Share::parse(Some(text)).unwrap_err();
            assert!(message.contains("--index"), "{message}");
        }
        assert!(Share::parse(Some("0/3")).unwrap_err().contains("from 1"));
    }
}
