//! All seeds of all figures, several at once, with a record of what is done.

use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use landform_sim::registry::Registry;
use landform_sim::simulation::Limits;

use super::catalogue::Entry;
use super::data::Data;
use super::judge::FigureReport;
use super::measure::{Places, SeedNumbers, Watch, conclude, measure};
use super::record::Record;

/// How figures are reproduced.
pub struct Work<'a> {
    /// The figures.
    pub entries: &'a [Entry],
    /// Folder of data; without it they are absent.
    pub data: Option<&'a Path>,
    /// Output folder: pictures go below `output/NAME/`.
    pub output: &'a Path,
    /// What scenarios may name.
    pub registry: &'a Arc<Registry>,
    /// Limits of each run.
    pub limits: Limits,
    /// Runs at once, at least 1.
    pub jobs: usize,
    /// Hears what is being run.
    pub tell: &'a (dyn Fn(&str) + Sync),
    /// Whether to end.
    pub stop: &'a (dyn Fn() -> bool + Sync),
}

/// A seed of a figure.
#[derive(Clone, Copy)]
struct Job {
    entry: usize,
    seed: u64,
}

impl Work<'_> {
    /// Runs what `record` does not have, keeps it up to date in the output folder, and judges.
    ///
    /// A seed's numbers do not depend on what runs beside it, nor on what was recorded before.
    ///
    /// # Errors
    /// The message of the first job that failed; the others are ended.
    pub fn reproduce(&self, record: Record) -> Result<Vec<FigureReport>, String> {
        let jobs: Vec<Job> = self.jobs(&record);
        let data: Vec<OnceLock<Result<Data<'_>, String>>> =
            self.entries.iter().map(|_| OnceLock::new()).collect();
        let record = Mutex::new(record);
        let failure: Mutex<Option<String>> = Mutex::default();
        let (next, failed) = (AtomicUsize::new(0), AtomicBool::new(false));
        let worker = || loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(&job) = jobs.get(number).filter(|_| !failed.load(Ordering::Relaxed)) else {
                return;
            };
            let done = self.run(job, (number, jobs.len()), &data[job.entry], &failed);
            let kept = done.and_then(|numbers| {
                let entry = &self.entries[job.entry];
                let mut record = record.lock().unwrap_or_else(PoisonError::into_inner);
                record.keep(entry, job.seed, numbers);
                record.write(self.output)
            });
            if let Err(message) = kept {
                failure.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(message);
                failed.store(true, Ordering::Relaxed);
            }
        };
        std::thread::scope(|scope| {
            for _ in 0..self.jobs.clamp(1, jobs.len().max(1)) {
                scope.spawn(worker);
            }
        });
        if let Some(message) = failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
            return Err(message);
        }
        let record = record.into_inner().unwrap_or_else(PoisonError::into_inner);
        self.entries
            .iter()
            .zip(&data)
            .map(|(entry, data)| self.conclude(entry, data, &record))
            .collect()
    }

    fn conclude<'e>(
        &self,
        entry: &'e Entry,
        data: &OnceLock<Result<Data<'e>, String>>,
        record: &Record,
    ) -> Result<FigureReport, String> {
        let data = data.get_or_init(|| self.analyze(entry)).as_ref().map_err(Clone::clone)?;
        let seeds: Vec<SeedNumbers> =
            (1..=entry.figure.seeds).filter_map(|seed| record.find(entry, seed)).collect();
        conclude(&entry.figure, &entry.name, &seeds, data, &self.output.join(&entry.name))
    }

    /// The seeds that are not recorded, or lack numbers of data that may be there now.
    fn jobs(&self, record: &Record) -> Vec<Job> {
        let all = self
            .entries
            .iter()
            .enumerate()
            .flat_map(|(entry, of)| (1..=of.figure.seeds).map(move |seed| Job { entry, seed }));
        let is_whole = |numbers: SeedNumbers| {
            self.data.is_none() || numbers.values.iter().all(Option::is_some)
        };
        all.filter(|job| !record.find(&self.entries[job.entry], job.seed).is_some_and(is_whole))
            .collect()
    }

    fn run<'e>(
        &'e self,
        job: Job,
        (number, count): (usize, usize),
        data: &OnceLock<Result<Data<'e>, String>>,
        failed: &AtomicBool,
    ) -> Result<SeedNumbers, String> {
        let entry = &self.entries[job.entry];
        let tell = |what: &str| {
            (self.tell)(&format!("{}/{count} {}: {what}", number + 1, entry.figure.id));
        };
        let stop = || (self.stop)() || failed.load(Ordering::Relaxed);
        let data = data.get_or_init(|| self.analyze(entry)).as_ref().map_err(Clone::clone)?;
        let output = self.output.join(&entry.name);
        let places = Places { base: &entry.base, data: self.data, output: &output };
        let watch = Watch { tell: &tell, stop: &stop };
        measure(&entry.figure, job.seed, places, (self.registry, self.limits), data, watch)
    }

    fn analyze<'e>(&self, entry: &'e Entry) -> Result<Data<'e>, String> {
        let output = self.output.join(&entry.name);
        let places = Places { base: &entry.base, data: self.data, output: &output };
        let tell = |what: &str| (self.tell)(&format!("{}: {what}", entry.figure.id));
        Data::analyze(&entry.figure, places, self.limits, &tell)
    }
}
