//! What `ron` refuses, as messages.
use super::diagnostic::Diagnostic;
use super::source::{Position, Source, Span};
use ron::error::{Error, SpannedError};

/// Temporary.
pub fn ron_diagnostic(source: &Source, error: &SpannedError) -> Diagnostic {
    let offset =
        |p: ron::error::Position| Position { line: p.line, column: p.col }.offset(source.text());
    Diagnostic::new(message_of(&error.code))
        .at(Span::new(offset(error.span.start), offset(error.span.end)))
}

pub(super) fn message_of(code: &Error) -> String {
    code.to_string()
}
