//! Parameters: what a scenario may say of a process, an initial condition, a metric, an output.
//!
//! A parameter is defined once, as a documented field of a struct: its doc comment is its
//! description, `#[schemars(range(..))]` its range, `#[schemars(extend("x-unit" = "m"))]` its
//! unit and `#[schemars(extend("x-source" = "..."))]` where it comes from. Descriptions, range
//! checks and defaults are all read off that definition.

use std::fmt;

use schemars::{JsonSchema, Schema};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// A struct of parameters. Derive `Clone, Serialize, Deserialize, JsonSchema`, implement
/// `Default`, and put `#[serde(deny_unknown_fields, default)]` on it.
pub trait Parameters:
    DeserializeOwned + Serialize + JsonSchema + Default + Clone + Send + Sync + 'static
{
}

impl<T> Parameters for T where
    T: DeserializeOwned + Serialize + JsonSchema + Default + Clone + Send + Sync + 'static
{
}

/// Why a parameter is refused.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Problem {
    /// Path of the parameter below the struct it belongs to, `winds[0].weight`; empty for the whole.
    pub parameter: String,
    /// What is wrong, with the value.
    pub message: String,
    /// What would have been accepted.
    pub expected: String,
    /// What to do, empty when `expected` says it.
    pub help: String,
}

impl Problem {
    /// A problem with one parameter.
    pub fn new(
        parameter: impl Into<String>,
        message: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        Self {
            parameter: parameter.into(),
            message: message.into(),
            expected: expected.into(),
            help: String::new(),
        }
    }

    /// Adds what to do about it.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = help.into();
        self
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.parameter.is_empty() {
            write!(f, "{}: ", self.parameter)?;
        }
        write!(f, "{}", self.message)?;
        if !self.expected.is_empty() {
            write!(f, "; expected {}", self.expected)?;
        }
        if !self.help.is_empty() {
            write!(f, "; {}", self.help)?;
        }
        Ok(())
    }
}

impl std::error::Error for Problem {}

/// One parameter as its definition describes it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterDescription {
    /// Name in scenarios.
    pub name: String,
    /// Type in words.
    pub kind: String,
    /// Unit; empty when it has none.
    pub unit: String,
    /// Range in words; empty when anything of the type goes.
    pub range: String,
    /// Value when the scenario says nothing, as RON.
    pub default: String,
    /// Where the parameter and its default come from.
    pub source: String,
    /// What it does.
    pub description: String,
}

/// The schema of `P`, with every nested definition in place.
pub(crate) fn schema_of<P: Parameters>() -> Value {
    let settings = schemars::generate::SchemaSettings::default().with(|settings| {
        settings.inline_subschemas = true;
    });
    let schema: Schema = settings.into_generator().into_root_schema_for::<P>();
    schema.to_value()
}

/// Describes every parameter of `P`, in the order of their definition.
pub(crate) fn describe<P: Parameters>() -> Vec<ParameterDescription> {
    let schema = schema_of::<P>();
    let defaults = serde_json::to_value(P::default()).unwrap_or_default();
    let Some(properties) = schema["properties"].as_object() else { return Vec::new() };
    properties
        .iter()
        .map(|(name, property)| ParameterDescription {
            name: name.clone(),
            kind: kind_of(property),
            unit: text(property, "x-unit"),
            range: range_of(property),
            default: ron_text(&defaults[name]),
            source: text(property, "x-source"),
            description: text(property, "description").replace('\n', " "),
        })
        .collect()
}

fn text(property: &Value, key: &str) -> String {
    property[key].as_str().unwrap_or_default().to_owned()
}

fn kind_of(property: &Value) -> String {
    let names = |list: &Vec<Value>| list.iter().map(kind_of).collect::<Vec<_>>().join(" or ");
    if let Some(list) = property["enum"].as_array() {
        return list.iter().filter_map(Value::as_str).collect::<Vec<_>>().join(" or ");
    }
    if let Some(name) = property["const"].as_str() {
        return name.to_owned();
    }
    for key in ["oneOf", "anyOf"] {
        if let Some(list) = property[key].as_array() {
            return names(list);
        }
    }
    match &property["type"] {
        Value::String(kind) if kind == "array" => {
            let items = property.get("items").or(property["prefixItems"].get(0));
            format!("list of {}", items.map_or_else(|| "values".to_owned(), kind_of))
        }
        Value::String(kind) if kind == "object" => {
            let keys = property["properties"].as_object().into_iter().flatten();
            format!("({})", keys.map(|(key, _)| key.as_str()).collect::<Vec<_>>().join(", "))
        }
        Value::String(kind) => kind.clone(),
        Value::Array(kinds) => {
            let kinds = kinds.iter().filter_map(Value::as_str);
            kinds
                .map(|kind| if kind == "null" { "None" } else { kind })
                .collect::<Vec<_>>()
                .join(" or ")
        }
        _ => "value".to_owned(),
    }
}

fn range_of(property: &Value) -> String {
    let bounds = [
        ("minimum", "at least"),
        ("exclusiveMinimum", "above"),
        ("maximum", "at most"),
        ("exclusiveMaximum", "below"),
    ];
    let parts = bounds.iter().filter_map(|(key, words)| {
        property[*key].as_f64().map(|bound| format!("{words} {}", short(bound)))
    });
    parts.collect::<Vec<_>>().join(", ")
}

/// A number without pages of zeros.
fn short(number: f64) -> String {
    let magnitude = number.abs();
    match magnitude == 0.0 || (1e-4..1e6).contains(&magnitude) {
        true => number.to_string(),
        false => format!("{number:e}"),
    }
}

/// A JSON value in the notation of scenario files, near enough to be copied into one.
pub(crate) fn ron_text(value: &Value) -> String {
    match value {
        Value::Null => "None".to_owned(),
        Value::Array(items) => {
            format!("[{}]", items.iter().map(ron_text).collect::<Vec<_>>().join(", "))
        }
        Value::Object(fields) => {
            let fields = fields.iter().map(|(name, value)| format!("{name}: {}", ron_text(value)));
            format!("({})", fields.collect::<Vec<_>>().join(", "))
        }
        other => other.to_string(),
    }
}

/// Finds values outside the ranges of their definition, and numbers that are not finite.
pub(crate) fn check<P: Parameters>(parameters: &P) -> Vec<Problem> {
    let mut problems = Vec::new();
    let value = serde_json::to_value(parameters).unwrap_or_default();
    check_value(&schema_of::<P>(), &value, String::new(), &mut problems);
    problems
}

fn check_value(schema: &Value, value: &Value, path: String, problems: &mut Vec<Problem>) {
    match value {
        // JSON has no notation for infinities and NaN: serde_json turns them into null.
        Value::Null if schema["type"].as_str() == Some("number") => {
            problems.push(Problem::new(path, "the number is not finite", "a finite number"));
        }
        Value::Number(number) => {
            let number = number.as_f64().unwrap_or(f64::NAN);
            if !in_range(schema, number) {
                let message = format!("{number} is out of range");
                problems.push(Problem::new(path, message, range_of(schema)));
            }
        }
        Value::Array(items) => {
            let least = schema["minItems"].as_u64().unwrap_or(0) as usize;
            if items.len() < least {
                let message = format!("the list has {} entries", items.len());
                problems.push(Problem::new(&path, message, format!("at least {least}")));
            }
            for (index, item) in items.iter().enumerate() {
                let inner = schema.get("items").or(schema["prefixItems"].get(index));
                check_value(
                    inner.unwrap_or(&Value::Null),
                    item,
                    format!("{path}[{index}]"),
                    problems,
                );
            }
        }
        Value::Object(fields) => {
            for (name, field) in fields {
                let dot = if path.is_empty() { "" } else { "." };
                let path = format!("{path}{dot}{name}");
                check_value(&schema["properties"][name], field, path, problems);
            }
        }
        _ => {}
    }
}

fn in_range(schema: &Value, number: f64) -> bool {
    let bound = |key: &str| schema[key].as_f64();
    bound("minimum").is_none_or(|least| number >= least)
        && bound("exclusiveMinimum").is_none_or(|least| number > least)
        && bound("maximum").is_none_or(|most| number <= most)
        && bound("exclusiveMaximum").is_none_or(|most| number < most)
}
