//! The text of a scenario file: where each value stands in it, and messages that point there.
//!
//! `ron` reads the values; this module knows the positions. A [`Source`] is the text with its
//! name, [`Tree`] says what stands where, [`locate`] turns a path such as
//! `stages[0].processes.Dunes.slab_m` into a [`Span`], [`set`] edits a value as the command
//! line's `--set path=value` asks, and a [`Diagnostic`] shows the line with carets below it.

mod diagnostic;
mod edit;
mod lexer;
mod nearest;
mod path;
#[cfg(test)]
mod properties;
mod ron_error;
mod source;
mod tree;

pub use diagnostic::{Diagnostic, Located, render_all};
pub use edit::set;
pub use nearest::{nearest, one_of};
pub use path::{locate, locate_key};
pub use ron_error::ron_diagnostic;
pub use source::{Place, Position, Source, Span};
pub use tree::{Entry, Key, Kind, Node, Tree};
