//! The program `landform` as a user starts it.

use std::env::{consts, current_exe};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

/// A call of the program in a folder.
pub struct Program {
    command: Command,
}

/// What a call left.
#[derive(Debug)]
pub struct Ended {
    /// Exit status; `None` when a signal ended it.
    pub status: Option<i32>,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
}

impl Program {
    /// The program with `folder` as its working directory.
    pub fn within(folder: &Path) -> Self {
        Self::of(&executable(), folder)
    }

    /// Another program that is built on Landform, with `folder` as its working directory.
    pub fn of(executable: &Path, folder: &Path) -> Self {
        let mut command = Command::new(executable);
        command.current_dir(folder).stdin(Stdio::null());
        Self { command }
    }

    /// Adds arguments.
    #[must_use]
    pub fn args<I: AsRef<OsStr>>(mut self, arguments: impl IntoIterator<Item = I>) -> Self {
        self.command.args(arguments);
        self
    }

    /// Adds the arguments of a line without quotes, split at spaces.
    #[must_use]
    pub fn line(self, arguments: &str) -> Self {
        self.args(arguments.split_whitespace())
    }

    /// The same call with at most so many KiB of address space.
    #[must_use]
    pub fn below_memory_kib(self, kib: u64) -> Self {
        let mut shell = Command::new("sh");
        shell.args(["-c", &format!("ulimit -v {kib} && exec \"$0\" \"$@\"")]);
        shell.arg(self.command.get_program()).args(self.command.get_args()).stdin(Stdio::null());
        shell.current_dir(self.command.get_current_dir().unwrap_or(Path::new(".")));
        Self { command: shell }
    }

    /// Runs to the end. That the program never panics is checked here for every test.
    pub fn run(mut self) -> Ended {
        self.command.stdout(Stdio::piped()).stderr(Stdio::piped());
        self.end()
    }

    /// Runs to the end with the streams that [`Program::command`] was given.
    pub fn end(mut self) -> Ended {
        let child = self.command.spawn().expect("the program starts");
        // What was handed to the program must not stay open here.
        drop(self.command);
        Ended::of(child.wait_with_output().expect("the program ends"))
    }

    /// Starts it and returns at once.
    pub fn start(mut self) -> Child {
        self.command.stdout(Stdio::piped()).stderr(Stdio::piped());
        self.command.spawn().expect("the program starts")
    }

    /// The command itself, for its streams.
    pub fn command(&mut self) -> &mut Command {
        &mut self.command
    }
}

impl Ended {
    /// What a finished process left; its talk must not be that of a panic.
    pub fn of(output: Output) -> Self {
        let ended = Self {
            status: output.status.code(),
            stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
        };
        for sign in ["panicked at", "RUST_BACKTRACE", "overflowed its stack", "memory allocation"] {
            assert!(!ended.stderr.contains(sign), "a panic: {ended:?}");
        }
        assert!(ended.status.is_some(), "a signal ended the program: {ended:?}");
        ended
    }

    /// Standard output of a call that must have succeeded.
    #[track_caller]
    pub fn good(self) -> String {
        assert_eq!(self.status, Some(0), "{self:?}");
        self.stdout
    }

    /// Standard error of a call whose input must have been refused, without a word on standard
    /// output.
    #[track_caller]
    pub fn refused(self) -> String {
        assert_eq!((self.status, self.stdout.as_str()), (Some(2), ""), "{self:?}");
        self.stderr
    }
}

/// The program `landform` as it was built for the tests.
pub fn executable() -> PathBuf {
    build_folder().join(format!("landform-under-test{}", consts::EXE_SUFFIX))
}

/// The folder that Cargo puts programs into, such as `target/debug`. The tests lie in a folder
/// below it.
pub fn build_folder() -> PathBuf {
    let test = current_exe().expect("the test knows its own path");
    test.parent().and_then(Path::parent).expect("tests lie in a folder of the build").to_owned()
}
