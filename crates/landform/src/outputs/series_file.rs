//! The series of metrics as a file that grows while the run goes on.

use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use landform_io::{IfExists, IoError, write_atomically};
use landform_sim::checkpoint::{Damage, Loader, Saver};
use landform_sim::metric::{RowsKept, csv_header, csv_line};
use landform_sim::output::{Moment, OutputFile, Sink};
use landform_sim::parameters::Problem;
use landform_sim::simulation::Simulation;
use landform_sim::snapshot::Snapshot;

use crate::explain::file_problem;

/// Writes `series.csv` in whole lines, at the latest a second after they were measured, so that
/// a run can be watched and a killed one leaves its series.
///
/// A metric that has nothing to say at first gets its column later: the file is then written
/// anew, with empty cells in the earlier rows, and put in the place of the old one.
#[derive(Default)]
pub struct SeriesFile {
    open: Option<OpenFile>,
}

/// The file, and what it does not hold yet.
struct OpenFile {
    path: PathBuf,
    file: File,
    /// Bytes of the whole lines in it.
    length: u64,
    columns: usize,
    last: Option<u64>,
    lines: String,
    written: Instant,
}

/// Lines wait so long for others to be written with, ...
const LONGEST_WAIT: Duration = Duration::from_secs(1);
/// ... and no longer than until they are so many bytes.
const MOST_BYTES: usize = 1 << 16;

impl SeriesFile {
    /// Name of the file below the output folder.
    pub const NAME: &'static str = "series.csv";

    /// Lets a run write its series; in memory stays only what rules on metrics need.
    pub fn attach(simulation: &mut Simulation) {
        simulation.add_sink("series", Box::new(Self::default()));
        simulation.keep_rows(RowsKept::Latest);
    }
}

impl Sink for SeriesFile {
    fn observe(
        &mut self,
        _: Moment,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<Vec<OutputFile>, Problem> {
        let series = snapshot.series();
        let written = self.open.as_ref().and_then(|open| open.last);
        if series.latest_tick() == written {
            return Ok(Vec::new());
        }
        let Some((tick, row)) = series.rows().next_back() else { return Ok(Vec::new()) };
        let names = series.names();
        let path = folder.join(Self::NAME);
        let open = match &mut self.open {
            Some(open) => open,
            none => none.insert(OpenFile::create(path, names).map_err(problem)?),
        };
        open.push(names, tick, &row).map_err(problem)?;
        Ok(Vec::new())
    }

    fn flush(&mut self) -> Result<(), Problem> {
        self.open.as_mut().map_or(Ok(()), |open| open.write().map_err(problem))
    }

    fn save<'a>(&'a mut self, _: &mut Saver<'_, 'a>) -> Result<(), Problem> {
        self.flush()
    }

    fn restore(
        &mut self,
        from: &Loader<'_>,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<(), Damage> {
        let series = snapshot.series();
        let open = OpenFile::reopen(folder.join(Self::NAME), series.names(), series.latest_tick());
        self.open = Some(open.map_err(|error| from.refuse("", error.to_string()))?);
        Ok(())
    }
}

fn problem(error: IoError) -> Problem {
    file_problem("", &error)
}

impl OpenFile {
    /// Makes a file without rows.
    fn create(path: PathBuf, names: &[String]) -> Result<Self, IoError> {
        let header = csv_header(names);
        write_atomically(&path, IfExists::Replace, |file| file.write_all(header.as_bytes()))?;
        Self::append_to(path, names.len())
    }

    /// Opens the file that an interrupted run left: of its rows those up to `last` stay, and
    /// its columns become `names`.
    fn reopen(path: PathBuf, names: &[String], last: Option<u64>) -> Result<Self, IoError> {
        rewrite(&path, names, last)?;
        Ok(Self { last, ..Self::append_to(path, names.len())? })
    }

    fn append_to(path: PathBuf, columns: usize) -> Result<Self, IoError> {
        let file = OpenOptions::new().append(true).open(&path);
        let file = file.map_err(|error| IoError::system(&path, "open", error))?;
        let length = file.metadata().map_err(|error| IoError::system(&path, "read", error))?.len();
        let lines = String::new();
        Ok(Self { path, file, length, columns, last: None, lines, written: Instant::now() })
    }

    /// Adds a row, and writes when it is time to.
    fn push(&mut self, names: &[String], tick: u64, row: &[Option<f64>]) -> Result<(), IoError> {
        if names.len() > self.columns {
            self.write()?;
            rewrite(&self.path, names, self.last)?;
            *self = Self::append_to(std::mem::take(&mut self.path), names.len())?;
        }
        self.last = Some(tick);
        self.lines.push_str(&csv_line(tick, row));
        match self.lines.len() > MOST_BYTES || self.written.elapsed() > LONGEST_WAIT {
            true => self.write(),
            false => Ok(()),
        }
    }

    /// Appends the lines that wait.
    fn write(&mut self) -> Result<(), IoError> {
        if let Err(error) = self.file.write_all(self.lines.as_bytes()) {
            // A full disk may have taken a part of a line; the first error is the one to report.
            let _ = self.file.set_len(self.length);
            return Err(IoError::system(&self.path, "write", error));
        }
        self.length += self.lines.len() as u64;
        self.lines.clear();
        self.written = Instant::now();
        Ok(())
    }
}

/// Writes the file anew with the columns `names` and its rows up to `last`. A line that a kill
/// cut short is left out.
fn rewrite(path: &Path, names: &[String], last: Option<u64>) -> Result<(), IoError> {
    let old = File::open(path).map_err(|error| IoError::system(path, "open", error))?;
    write_atomically(path, IfExists::Replace, |new| {
        new.write_all(csv_header(names).as_bytes())?;
        copy_rows(BufReader::new(old), new, names.len(), last)
    })
}

fn copy_rows(
    mut old: impl BufRead,
    new: &mut BufWriter<File>,
    columns: usize,
    last: Option<u64>,
) -> std::io::Result<()> {
    let mut line = String::new();
    old.read_line(&mut line)?;
    loop {
        line.clear();
        old.read_line(&mut line)?;
        let Some(row) = line.strip_suffix('\n') else { return Ok(()) };
        let mut cells = row.split(',');
        let tick = cells.next().unwrap_or_default();
        if !tick.parse().is_ok_and(|tick: u64| Some(tick) <= last) {
            return Ok(());
        }
        new.write_all(tick.as_bytes())?;
        for _ in 0..columns.max(1) {
            new.write_all(b",")?;
            new.write_all(cells.next().unwrap_or_default().as_bytes())?;
        }
        new.write_all(b"\n")?;
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// A folder that is removed at the end.
    struct Scratch(PathBuf);

    impl Scratch {
        fn new(name: &str) -> Self {
            let folder =
                std::env::temp_dir().join(format!("landform_{name}_{}", std::process::id()));
            fs::create_dir_all(&folder).expect("the folder can be made");
            Self(folder)
        }
    }

    impl Drop for Scratch {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    fn names(names: &[&str]) -> Vec<String> {
        names.iter().map(|&name| name.to_owned()).collect()
    }

    #[test]
    fn late_columns_are_empty_in_earlier_rows() {
        let folder = Scratch::new("series_late");
        let path = folder.0.join("series.csv");
        let mut open = OpenFile::create(path.clone(), &names(&["a"])).unwrap();
        open.push(&names(&["a"]), 0, &[Some(1.5)]).unwrap();
        open.push(&names(&["a", "b"]), 5, &[None, Some(2.0)]).unwrap();
        open.write().unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "iteration,a,b\n0,1.5,\n5,,2.0\n");
    }

    /// Wherever a kill cuts the file, going on from a checkpoint makes the same file.
    #[test]
    fn a_reopened_file_grows_into_the_same_bytes() {
        let folder = Scratch::new("series_reopen");
        let path = folder.0.join("series.csv");
        let both = names(&["a", "b"]);
        let add = |open: &mut OpenFile, ticks: std::ops::Range<u64>| {
            for tick in ticks {
                open.push(&both, tick, &[Some(tick as f64 / 3.0), None]).unwrap();
            }
            open.write().unwrap();
        };
        let mut open = OpenFile::create(path.clone(), &both).unwrap();
        add(&mut open, 0..12);
        let whole = fs::read_to_string(&path).unwrap();
        let sixth = whole.match_indices('\n').nth(6).unwrap().0;
        for length in sixth + 1..=whole.len() {
            fs::write(&path, &whole[..length]).unwrap();
            let mut open = OpenFile::reopen(path.clone(), &both, Some(5)).unwrap();
            add(&mut open, 6..12);
            assert_eq!(fs::read_to_string(&path).unwrap(), whole, "cut at {length}");
        }
        // A column that appeared after the checkpoint goes again.
        OpenFile::reopen(path.clone(), &names(&["a"]), Some(1)).unwrap();
        let start = fs::read_to_string(&path).unwrap();
        assert_eq!(start, "iteration,a\n0,0.0\n1,0.3333333333333333\n");
    }
}
