//! The JSON schema of parameters, which everything else is read off.

use schemars::Schema;
use serde_json::Value;

use super::Parameters;

/// The schema of `P`, with every nested definition in place.
pub(crate) fn schema_of<P: Parameters>() -> Value {
    let settings = schemars::generate::SchemaSettings::default().with(|settings| {
        settings.inline_subschemas = true;
    });
    let schema: Schema = settings.into_generator().into_root_schema_for::<P>();
    schema.to_value()
}

/// The alternatives of an enum or an optional value; none for other schemas.
pub(super) fn alternatives(schema: &Value) -> impl Iterator<Item = &Value> {
    let list = schema["oneOf"].as_array().into_iter().chain(schema["anyOf"].as_array());
    list.flatten()
}

/// The name and the content of the variant that an alternative describes, `Name(content)`.
pub(super) fn variant(alternative: &Value) -> Option<(&String, &Value)> {
    let properties = alternative["properties"].as_object()?;
    let name = properties.keys().next()?;
    let single = properties.len() == 1 && name.starts_with(char::is_uppercase);
    single.then(|| properties.iter().next()).flatten()
}

/// Whether the schema allows values of a JSON type.
pub(super) fn allows(schema: &Value, kind: &str) -> bool {
    match &schema["type"] {
        Value::String(one) => one == kind,
        Value::Array(several) => several.iter().any(|one| one == kind),
        _ => false,
    }
}

/// Whether strings of this schema are names of variants and not texts.
pub(super) fn is_name(schema: &Value) -> bool {
    schema.get("enum").is_some()
        || schema.get("const").is_some()
        || alternatives(schema).any(is_name)
}

/// The bounds of numbers, in words; empty when anything of the type goes.
pub(super) fn range(schema: &Value) -> String {
    let bounds = [
        ("minimum", "at least"),
        ("exclusiveMinimum", "above"),
        ("maximum", "at most"),
        ("exclusiveMaximum", "below"),
    ];
    let parts = bounds.iter().filter_map(|(key, words)| {
        schema[*key].as_f64().map(|bound| format!("{words} {}", short(bound)))
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
