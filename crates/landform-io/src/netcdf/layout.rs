//! What a file holds.

use crate::Fault;

/// What is said about a file, an axis or a field.
#[derive(Clone, Debug, PartialEq)]
pub enum Attribute {
    /// A text.
    Text(String),
    /// A number.
    Number(f64),
}

/// Something with a name and attributes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// What is said about it: `units`, `long_name`, ...
    pub attributes: Vec<(String, Attribute)>,
}

impl Variable {
    /// A variable without attributes.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), attributes: Vec::new() }
    }

    /// Adds a text, unless it is empty.
    #[must_use]
    pub fn text(mut self, name: &str, text: &str) -> Self {
        if !text.is_empty() {
            self.attributes.push((name.to_owned(), Attribute::Text(text.to_owned())));
        }
        self
    }

    /// Adds a number.
    #[must_use]
    pub fn number(mut self, name: &str, number: f64) -> Self {
        self.attributes.push((name.to_owned(), Attribute::Number(number)));
        self
    }
}

/// A spatial axis with the coordinates of its nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Name and attributes.
    pub variable: Variable,
    /// A coordinate for each node.
    pub values: Vec<f64>,
}

/// What a file holds: fields of doubles over the axes, at every record.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// Attributes of the whole file; its name is not used.
    pub whole: Variable,
    /// The axis of records: `iteration`.
    pub record: Variable,
    /// The other axes, the one that varies fastest last: `z`, `y`, `x`.
    pub axes: Vec<Axis>,
    /// The coordinate system as CF wants it: a variable that fields name as `grid_mapping`.
    pub system: Option<Variable>,
    /// The fields, all over the same axes.
    pub fields: Vec<Variable>,
}

impl Layout {
    /// Every variable, in the order of the file: axes, system, records, fields.
    pub(super) fn variables(&self) -> impl Iterator<Item = &Variable> {
        let axes = self.axes.iter().map(|axis| &axis.variable);
        axes.chain(&self.system).chain([&self.record]).chain(&self.fields)
    }

    /// Nodes of a field, if that number can be written.
    pub(super) fn nodes(&self) -> Result<usize, Fault> {
        let sizes = self.axes.iter().map(|axis| axis.values.len());
        let nodes = sizes.clone().try_fold(1_usize, usize::checked_mul).unwrap_or(usize::MAX);
        match nodes {
            0 => Err(Fault::new("an axis without nodes", "at least one", "give coordinates")),
            _ if nodes > MOST_NODES => {
                let sizes = sizes.map(|size| size.to_string()).collect::<Vec<_>>().join(" x ");
                let expected = format!("at most {MOST_NODES}, 4 GiB");
                let advice = "write .npy files, one for each moment";
                Err(Fault::new(format!("{sizes} nodes a record"), expected, advice))
            }
            _ => Ok(nodes),
        }
    }

    /// Refuses names that readers would trip over, and names that stand twice.
    pub(super) fn check_names(&self) -> Result<(), Fault> {
        let names: Vec<&str> = self.variables().map(|variable| variable.name.as_str()).collect();
        for (index, name) in names.iter().enumerate() {
            let plain = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
            let starts_well = name.starts_with(|first: char| !first.is_ascii_digit());
            if !starts_well || !name.chars().all(plain) {
                let expected = "letters, digits and _, and no digit first";
                let problem = format!("a variable called {name:?}");
                return Err(Fault::new(problem, expected, "rename it"));
            }
            if names[..index].contains(name) {
                let problem = format!("two variables are called {name:?}");
                return Err(Fault::new(problem, "different names", "leave one out"));
            }
        }
        Ok(())
    }
}

/// Nodes of a field that fit into the 4 GiB of a variable in a record.
const MOST_NODES: usize = (u32::MAX as usize - 3) / 8;
