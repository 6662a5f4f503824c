//! A checkpoint in memory: named arrays and named values, and how they are put in and taken out.

use std::borrow::Cow;
use std::collections::BTreeMap;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{Array, Damage, Element, Keep};

/// Everything that a run needs to go on: arrays and texts by name.
///
/// Names are paths with `/`, such as `fields/sand`. Texts hold values in RON, which keeps every
/// bit of a finite number, and are read by people too.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checkpoint<'a> {
    /// Numbers, most of them one a node.
    pub arrays: BTreeMap<String, Array<'a>>,
    /// Everything else.
    pub texts: BTreeMap<String, String>,
    unsaved: Option<Damage>,
}

/// Puts the parts of one thing into a checkpoint, below a path of its own.
pub struct Saver<'c, 'a> {
    checkpoint: &'c mut Checkpoint<'a>,
    path: String,
}

impl<'a> Checkpoint<'a> {
    /// A place for what is to be saved below `path`.
    pub fn saver(&mut self, path: impl Into<String>) -> Saver<'_, 'a> {
        Saver { checkpoint: self, path: path.into() }
    }

    /// The same checkpoint with copies of all numbers, to keep it while the run goes on.
    pub fn into_owned(self) -> Checkpoint<'static> {
        let arrays = self.arrays.into_iter().map(|(name, array)| (name, array.into_owned()));
        Checkpoint { arrays: arrays.collect(), texts: self.texts, unsaved: self.unsaved }
    }

    /// Refuses a checkpoint some of whose values RON has no words for.
    ///
    /// # Errors
    /// The first of them.
    pub fn check(&self) -> Result<(), Damage> {
        self.unsaved.clone().map_or(Ok(()), Err)
    }

    /// What was saved below `path`.
    pub fn loader(&self, path: impl Into<String>) -> Loader<'_> {
        Loader { checkpoint: self, path: path.into() }
    }
}

impl<'a> Saver<'_, 'a> {
    /// Saves numbers, without a copy of them.
    pub fn array<T: Element>(&mut self, name: &str, values: &'a [T]) {
        self.insert(name, T::array(Cow::Borrowed(values)));
    }

    /// Saves numbers that were made for it.
    pub fn owned<T: Element>(&mut self, name: &str, values: Vec<T>) {
        self.insert(name, T::array(Cow::Owned(values)));
    }

    /// Saves a small value of any type that serde knows. Large arrays of numbers belong into
    /// [`Saver::array`], which is a hundred times faster.
    pub fn value<T: Serialize + ?Sized>(&mut self, name: &str, value: &T) {
        let name = below(&self.path, name) + RON;
        match ron::to_string(value) {
            Ok(text) => drop(self.checkpoint.texts.insert(name, text)),
            Err(error) => {
                let message = error.to_string();
                self.checkpoint.unsaved.get_or_insert(Damage::Value { name, message });
            }
        }
    }

    /// Saves something that has several parts.
    pub fn keep(&mut self, name: &str, kept: &'a impl Keep) {
        kept.save(&mut self.below(name));
    }

    /// A place below this one.
    pub fn below(&mut self, name: &str) -> Saver<'_, 'a> {
        Saver { path: below(&self.path, name), checkpoint: self.checkpoint }
    }

    fn insert(&mut self, name: &str, array: Array<'a>) {
        self.checkpoint.arrays.insert(below(&self.path, name), array);
    }
}

/// Takes the parts of one thing out of a checkpoint.
pub struct Loader<'c> {
    checkpoint: &'c Checkpoint<'c>,
    path: String,
}

impl<'c> Loader<'c> {
    /// The numbers that were saved as `name`.
    ///
    /// # Errors
    /// [`Damage::Missing`], [`Damage::Kind`].
    pub fn array<T: Element>(&self, name: &str) -> Result<&'c [T], Damage> {
        let name = below(&self.path, name);
        match self.checkpoint.arrays.get(&name) {
            Some(array) => array.numbers(&name),
            None => Err(Damage::Missing { name }),
        }
    }

    /// The numbers that were saved as `name`, of which there must be `length`.
    ///
    /// # Errors
    /// [`Damage::Missing`], [`Damage::Kind`], [`Damage::Length`].
    pub fn array_of<T: Element>(&self, name: &str, length: usize) -> Result<&'c [T], Damage> {
        let values = self.array(name)?;
        if values.len() != length {
            let name = below(&self.path, name);
            return Err(Damage::Length { name, found: values.len(), expected: length });
        }
        Ok(values)
    }

    /// The value that was saved as `name`.
    ///
    /// # Errors
    /// [`Damage::Missing`], [`Damage::Value`].
    pub fn value<T: DeserializeOwned>(&self, name: &str) -> Result<T, Damage> {
        let name = below(&self.path, name) + RON;
        let Some(text) = self.checkpoint.texts.get(&name) else {
            return Err(Damage::Missing { name });
        };
        ron::from_str(text).map_err(|error| Damage::Value { name, message: error.to_string() })
    }

    /// Something that has several parts.
    ///
    /// # Errors
    /// As [`Keep::restore`] says.
    pub fn keep<T: Keep>(&self, name: &str) -> Result<T, Damage> {
        T::restore(&self.below(name))
    }

    /// Whether nothing was saved here.
    pub fn is_empty(&self) -> bool {
        let inside = |name: &str| match name.strip_prefix(self.path.as_str()) {
            Some(rest) => rest.is_empty() || rest == RON || rest.starts_with('/'),
            None => false,
        };
        let Checkpoint { arrays, texts, .. } = self.checkpoint;
        !arrays.keys().chain(texts.keys()).any(|name| inside(name))
    }

    /// What was saved below this place.
    pub fn below(&self, name: &str) -> Loader<'c> {
        Loader { checkpoint: self.checkpoint, path: below(&self.path, name) }
    }

    /// The refusal of a value that makes no sense here.
    pub fn refuse(&self, name: &str, message: impl Into<String>) -> Damage {
        Damage::Value { name: below(&self.path, name), message: message.into() }
    }
}

/// What the names of values in RON end in.
const RON: &str = ".ron";

/// The path of `name` below `path`; an empty one is the thing itself.
fn below(path: &str, name: &str) -> String {
    match (path, name) {
        ("", name) => name.to_owned(),
        (path, "") => path.to_owned(),
        (path, name) => format!("{path}/{name}"),
    }
}
