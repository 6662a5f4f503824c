//! Why a part of an analysis is missing, or not what one would expect.

use std::fmt::Display;

/// Remarks on an analysis, in the order of its parts.
#[derive(Clone, Debug, Default)]
pub(super) struct Notes(Vec<String>);

impl Notes {
    /// Adds a remark on a part.
    pub fn add(&mut self, part: &str, remark: impl Display) {
        self.0.push(format!("{part}: {remark}"));
    }

    /// What a part found, or nothing and a remark that says why.
    pub fn found<T, E: Display>(&mut self, part: &str, result: Result<T, E>) -> Option<T> {
        result.map_err(|error| self.add(part, error)).ok()
    }

    /// All remarks.
    pub fn into_inner(self) -> Vec<String> {
        self.0
    }
}
