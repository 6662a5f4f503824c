//! Standard output for results, standard error for talk; neither may end the program.

use std::io::{ErrorKind, Write, stderr, stdout};

use super::{Failure, Outcome};

/// Writes a result. Who reads it may leave early, as `| head` does.
pub(super) fn say(text: &str) -> Outcome {
    let mut out = stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::Failed(format!("cannot write to standard output: {error}")))
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
    let start = if message.starts_with("error") { "" } else { "error: " };
    let _ = writeln!(stderr(), "{start}{message}");
}
