//! Standard output for results, standard error for talk; neither may end the program.

use std::io::{ErrorKind, Write, stderr, stdout};
use std::process::ExitCode;

use landform_sim::code::Code;

use super::{Failure, Outcome, coded};

/// Writes a result. Who reads it may leave early, as `| head` does.
pub(super) fn say(text: &str) -> Outcome {
    let mut out = stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            let message = format!("cannot write to standard output: {error}");
            Err(Failure::failed(Code::Unwritable, message))
        }
        _ => Ok(()),
    }
}

/// Writes what is going on.
pub(super) fn tell(message: &str) {
    let _ = writeln!(stderr(), "{message}");
}

/// Writes what went wrong. Where that is impossible the exit status has to do.
pub(super) fn complain(message: &str) {
    let _ = writeln!(stderr(), "{message}");
}

/// Ends a call that asks for help or that cannot be understood.
pub(super) fn end(error: &clap::Error) -> ExitCode {
    let text = error.render().to_string();
    match text.strip_prefix("error: ") {
        Some(message) => {
            complain(coded(Code::Arguments, message).trim_end());
            ExitCode::from(2)
        }
        // Help and version, which keep their colours.
        None => {
            let _ = error.print();
            ExitCode::from(if error.use_stderr() { 2 } else { 0 })
        }
    }
}
