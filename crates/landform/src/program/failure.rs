//! How commands end that do not do what they were asked, with a message and its code.

use std::fmt;

use landform_sim::code::Code;

/// How a command ended without doing what it was asked. The message begins with its code:
/// `error[L0201]: ...`.
pub(crate) enum Failure {
    /// The input was refused: exit status 2.
    Refused(String),
    /// The run failed: exit status 1.
    Failed(String),
    /// The user interrupted: exit status 130.
    Interrupted(String),
}

impl Failure {
    /// The input was refused.
    pub fn refused(code: Code, message: impl fmt::Display) -> Self {
        Self::Refused(coded(code, &message.to_string()))
    }

    /// The run failed.
    pub fn failed(code: Code, message: impl fmt::Display) -> Self {
        Self::Failed(coded(code, &message.to_string()))
    }

    /// The user interrupted.
    pub fn interrupted(message: impl fmt::Display) -> Self {
        Self::Interrupted(coded(Code::Interrupted, &message.to_string()))
    }

    /// The message.
    pub fn message(&self) -> &str {
        match self {
            Self::Refused(message) | Self::Failed(message) | Self::Interrupted(message) => message,
        }
    }

    /// The exit status.
    pub fn status(&self) -> u8 {
        match self {
            Self::Refused(_) => 2,
            Self::Failed(_) => 1,
            Self::Interrupted(_) => 130,
        }
    }
}

/// The message with its code in front. What shows its place in a scenario has a code already.
pub(crate) fn coded(code: Code, message: &str) -> String {
    match message.starts_with("error[") {
        true => message.to_owned(),
        false => format!("error[{code}]: {message}"),
    }
}

/// Makes refusals of messages.
pub(crate) fn refused<M: fmt::Display>(code: Code) -> impl Fn(M) -> Failure + Copy {
    move |message| Failure::refused(code, message)
}

/// Makes failures of messages.
pub(crate) fn failed<M: fmt::Display>(code: Code) -> impl Fn(M) -> Failure + Copy {
    move |message| Failure::failed(code, message)
}
