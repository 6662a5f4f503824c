//! Checkpoints as files: `checkpoint/state.npz` in the folder of a run.

use std::borrow::Cow;
use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};
use std::time::Instant;

use landform_io::npz::{self, Content, Member};
use landform_io::{IfExists, IoError};
use landform_sim::checkpoint::{Array, Checkpoint, FOLDER};
use landform_sim::code::Code;
use landform_sim::simulation::{Keeper, Progress};

use super::arguments::Interval;
use super::{Failure, talk};

/// Name of the file in the folder of checkpoints.
const FILE: &str = "state.npz";

/// Name of the text that holds the scenario.
const SCENARIO: &str = "scenario.ron";

/// Folder of the checkpoint of a run.
pub(super) fn folder(run: &Path) -> PathBuf {
    run.join(FOLDER)
}

/// The checkpoint of a run.
pub(super) fn path(run: &Path) -> PathBuf {
    folder(run).join(FILE)
}

/// Reads the checkpoint in the folder of a run.
///
/// # Errors
/// What is wrong with the file, and where.
pub(super) fn read(run: &Path) -> Result<Checkpoint<'static>, String> {
    let path = path(run);
    let mut checkpoint = Checkpoint::default();
    for Member { name, content } in npz::read(&path).map_err(|error| error.to_string())? {
        match content {
            Content::Text(text) => drop(checkpoint.texts.insert(name, text.into_owned())),
            Content::Array { kind, bytes, .. } => {
                let array = Array::from_bytes(&kind, &bytes).ok_or_else(|| {
                    format!("{}: `{name}` holds numbers of type {kind}", path.display())
                })?;
                let name = name.strip_suffix(".npy").unwrap_or(&name).to_owned();
                checkpoint.arrays.insert(name, array);
            }
        }
    }
    Ok(checkpoint)
}

/// Takes the text of the scenario out of a checkpoint.
pub(super) fn take_scenario(checkpoint: &mut Checkpoint<'_>) -> String {
    checkpoint.texts.remove(SCENARIO).unwrap_or_default()
}

/// Writes checkpoints into the folder of a run, at an interval.
pub(super) struct FileKeeper {
    path: PathBuf,
    interval: Interval,
    scenario: String,
    /// Rows, columns and so on, as NumPy counts them, of a field with a number at every node.
    shape: Vec<usize>,
    latest: Instant,
}

impl FileKeeper {
    /// A keeper for the run in `run`, of a scenario with this text on a lattice of this size.
    pub(super) fn new(run: &Path, interval: Interval, scenario: &str, size: [usize; 3]) -> Self {
        let [width, height, depth] = size;
        let shape = if depth == 1 { vec![height, width] } else { vec![depth, height, width] };
        let (path, scenario) = (path(run), scenario.to_owned());
        Self { path, interval, scenario, shape, latest: Instant::now() }
    }

    fn write(&self, checkpoint: &Checkpoint<'_>) -> Result<(), IoError> {
        let nodes: usize = self.shape.iter().product();
        let arrays = checkpoint.arrays.iter().map(|(name, array)| {
            let shape = match array.len() == nodes {
                true => self.shape.clone(),
                false => vec![array.len()],
            };
            let (kind, bytes) = (array.kind().to_owned(), Cow::Borrowed(array.bytes()));
            Member { name: format!("{name}.npy"), content: Content::Array { kind, shape, bytes } }
        });
        let texts = checkpoint.texts.iter().map(|(name, text)| (name.clone(), text.as_str()));
        let texts = texts.chain([(SCENARIO.to_owned(), self.scenario.as_str())]);
        let texts =
            texts.map(|(name, text)| Member { name, content: Content::Text(Cow::Borrowed(text)) });
        let members: Vec<Member<'_>> = texts.chain(arrays).collect();
        npz::write(&self.path, &members, IfExists::Replace)
    }
}

impl Keeper for FileKeeper {
    fn is_due(&mut self, progress: &Progress<'_>) -> bool {
        match self.interval {
            Interval::Never => false,
            Interval::Seconds(seconds) => self.latest.elapsed().as_secs_f64() >= seconds,
            Interval::Iterations(count) => {
                progress.iteration > 0 && progress.iteration.is_multiple_of(count)
            }
        }
    }

    fn keep(&mut self, checkpoint: Checkpoint<'_>) -> Result<(), String> {
        let written = self.write(&checkpoint).map_err(|error| error.to_string());
        // After a failure the next attempt waits as well: a full disk is not asked all the time.
        self.latest = Instant::now();
        written.inspect_err(|message| talk::tell(&format!("no checkpoint: {message}")))
    }
}

/// Claims the folder of a run, so that no other process works in it; the claim ends with the
/// value, or with the process.
pub(super) struct Claim(File);

impl Claim {
    /// Claims the folder of a run and makes the folder for its checkpoint.
    ///
    /// # Errors
    /// A message when another process is at work there or the folder cannot be written.
    pub(super) fn new(run: &Path) -> Result<Self, Failure> {
        let folder = folder(run);
        let refused = |error: &dyn std::fmt::Display| {
            let message = format!("cannot write into {}: {error}", folder.display());
            Failure::refused(Code::Unwritable, message)
        };
        fs::create_dir_all(&folder).map_err(|error| refused(&error))?;
        let file = File::create(folder.join("lock")).map_err(|error| refused(&error))?;
        match file.try_lock() {
            Ok(()) => Ok(Self(file)),
            Err(TryLockError::WouldBlock) => {
                let shown = run.display();
                let message = format!(
                    "another run is at work in {shown}; wait for its end or name another folder \
                     with -o"
                );
                Err(Failure::refused(Code::Busy, message))
            }
            // Some file systems have no locks; the run is not worse for it.
            Err(TryLockError::Error(_)) => Ok(Self(file)),
        }
    }

    /// Forgets what tells of an earlier run: its checkpoint, and the report that it is over.
    ///
    /// # Errors
    /// A message when that is impossible.
    pub(super) fn clear(&self, run: &Path) -> Result<(), String> {
        [path(run), run.join("report.json")].iter().try_for_each(|path| {
            match fs::remove_file(path) {
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                    Err(format!("cannot remove {}: {error}", path.display()))
                }
                _ => Ok(()),
            }
        })
    }

    /// Ends the claim; nothing is left to resume from when the run is `over`.
    pub(super) fn release(self, run: &Path, over: bool) {
        if over || !path(run).exists() {
            // A folder that stays behind does no harm: the report says that the run is over.
            let _ = fs::remove_dir_all(folder(run));
        }
        drop(self.0);
    }
}
