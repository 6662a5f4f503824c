//! Parameters in words, for people who write scenarios.

use serde::Serialize;
use serde_json::Value;

use super::Parameters;
use super::schema::{allows, alternatives, is_name, range, schema_of, variant};

/// One parameter as its definition describes it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterDescription {
    /// Name in scenarios; `look: Relief(scale)` for a parameter of a variant.
    pub name: String,
    /// Type in words.
    pub kind: String,
    /// Unit; empty when it has none.
    pub unit: String,
    /// Range in words; empty when anything of the type goes.
    pub range: String,
    /// Value when the scenario says nothing, as RON; empty when it must say something.
    pub default: String,
    /// Where the parameter and its default come from.
    pub source: String,
    /// What it does.
    pub description: String,
}

/// Describes every parameter of `P`, in the order of their definition, each followed by the
/// parameters of the structs that it may hold.
pub(crate) fn describe<P: Parameters>() -> Vec<ParameterDescription> {
    let defaults = serde_json::to_value(P::default()).unwrap_or_default();
    let mut list = Vec::new();
    describe_fields(&schema_of::<P>(), &defaults, &|name| name.to_owned(), &mut list);
    list
}

fn describe_fields(
    schema: &Value,
    defaults: &Value,
    name_of: &dyn Fn(&str) -> String,
    list: &mut Vec<ParameterDescription>,
) {
    for (name, property) in schema["properties"].as_object().into_iter().flatten() {
        let required =
            schema["required"].as_array().is_some_and(|all| all.contains(&name.as_str().into()));
        let default = defaults.get(name).or(property.get("default")).filter(|_| !required);
        list.push(ParameterDescription {
            name: name_of(name),
            kind: kind_of(property),
            unit: text(property, "x-unit"),
            range: range(property),
            default: default.map_or(String::new(), |value| ron_text(property, value)),
            source: text(property, "x-source"),
            description: text(property, "description").replace('\n', " "),
        });
        for (prefix, inner) in inner_structs(property) {
            let inside = |field: &str| format!("{}: {prefix}({field})", name_of(name));
            describe_fields(inner, &Value::Null, &inside, list);
        }
    }
}

/// The structs that a parameter may hold: of variants, of an option, of a list.
fn inner_structs(property: &Value) -> Vec<(String, &Value)> {
    let mut inner: Vec<(String, &Value)> = alternatives(property)
        .map(|alternative| match variant(alternative) {
            Some((name, content)) => (name.clone(), content),
            None => (String::new(), alternative),
        })
        .collect();
    inner.push((String::new(), property));
    inner.extend(property.get("items").map(|items| (String::new(), items)));
    inner.retain(|(_, schema)| schema.get("properties").is_some());
    inner
}

fn text(property: &Value, key: &str) -> String {
    property[key].as_str().unwrap_or_default().to_owned()
}

fn kind_of(property: &Value) -> String {
    if let Some(list) = property["enum"].as_array() {
        return list.iter().filter_map(Value::as_str).collect::<Vec<_>>().join(" or ");
    }
    if let Some(name) = property["const"].as_str() {
        return name.to_owned();
    }
    if let Some((name, content)) = variant(property) {
        return match content.get("properties") {
            Some(_) => format!("{name}(..)"),
            None => format!("{name}({})", kind_of(content)),
        };
    }
    if let Some(type_name) = property["$ref"].as_str() {
        return type_name.rsplit('/').next().unwrap_or_default().to_owned();
    }
    let choices: Vec<String> = alternatives(property).map(kind_of).collect();
    if !choices.is_empty() {
        return choices.join(" or ");
    }
    let kind = match &property["type"] {
        Value::String(kind) => kind.as_str(),
        Value::Array(kinds) => kinds.iter().find_map(Value::as_str).unwrap_or("value"),
        _ => "value",
    };
    let kind = match kind {
        "array" => list_of(property),
        "object" => {
            let keys = property["properties"].as_object().into_iter().flatten();
            format!("({})", keys.map(|(key, _)| key.as_str()).collect::<Vec<_>>().join(", "))
        }
        "null" => "None".to_owned(),
        other => other.to_owned(),
    };
    match allows(property, "null") && kind != "None" {
        true => format!("{kind} or None"),
        false => kind,
    }
}

fn list_of(property: &Value) -> String {
    if let Some(items) = property["prefixItems"].as_array() {
        return format!("({})", items.iter().map(kind_of).collect::<Vec<_>>().join(", "));
    }
    if let (Some(items), Some(count)) = (property.get("items"), fixed_length(property)) {
        return format!("({})", vec![kind_of(items); count].join(", "));
    }
    let items = property.get("items").map_or_else(|| "values".to_owned(), kind_of);
    format!("list of {items}")
}

/// Length of an array that has always the same: scenarios write it as a tuple.
fn fixed_length(property: &Value) -> Option<usize> {
    let length = property["maxItems"].as_u64()?;
    (property["minItems"].as_u64() == Some(length)).then_some(length as usize)
}

/// A value in the notation of scenario files; `schema` tells names from texts.
fn ron_text(schema: &Value, value: &Value) -> String {
    match value {
        Value::Null => "None".to_owned(),
        Value::String(name) if is_name(schema) => name.clone(),
        Value::Array(items) => {
            let tuple = schema.get("prefixItems").is_some() || fixed_length(schema).is_some();
            let item_schema = |index| {
                schema.get("items").or(schema["prefixItems"].get(index)).unwrap_or(&Value::Null)
            };
            let items = items.iter().enumerate();
            let items: Vec<String> =
                items.map(|(index, item)| ron_text(item_schema(index), item)).collect();
            match tuple {
                true => format!("({})", items.join(", ")),
                false => format!("[{}]", items.join(", ")),
            }
        }
        Value::Object(fields) => {
            let content = alternatives(schema).find_map(|alternative| {
                let (name, content) = variant(alternative)?;
                Some((name, ron_text(content, fields.get(name)?)))
            });
            if let Some((name, inner)) = content {
                return match inner.starts_with('(') {
                    true => format!("{name}{inner}"),
                    false => format!("{name}({inner})"),
                };
            }
            let fields = fields.iter().map(|(name, value)| {
                format!("{name}: {}", ron_text(&schema["properties"][name], value))
            });
            format!("({})", fields.collect::<Vec<_>>().join(", "))
        }
        other => other.to_string(),
    }
}
