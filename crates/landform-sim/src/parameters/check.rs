//! Ranges: values that their definition does not allow.

use serde_json::Value;

use super::schema::{allows, alternatives, range, schema_of, variant};
use super::{Parameters, Problem};

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
        Value::Null if allows(schema, "number") && !allows(schema, "null") => {
            problems.push(Problem::new(path, "the number is not finite", "a finite number"));
        }
        Value::Number(number) => {
            let number = number.as_f64().unwrap_or(f64::NAN);
            if !in_range(schema, number) {
                let message = format!("{number} is out of range");
                problems.push(Problem::new(path, message, range(schema)));
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
                let path = format!("{path}[{index}]");
                check_value(inner.unwrap_or(&Value::Null), item, path, problems);
            }
        }
        Value::Object(fields) => check_object(schema, fields, path, problems),
        _ => {}
    }
}

fn check_object(
    schema: &Value,
    fields: &serde_json::Map<String, Value>,
    path: String,
    problems: &mut Vec<Problem>,
) {
    if schema.get("properties").is_none() {
        // An enum: the path of `look: Relief(scale: 2.0)` is `look.scale`, as the file has it.
        for alternative in alternatives(schema) {
            match variant(alternative) {
                Some((name, content)) => {
                    if let Some(value) = fields.get(name) {
                        return check_value(content, value, path, problems);
                    }
                }
                None if allows(alternative, "object") => {
                    return check_object(alternative, fields, path, problems);
                }
                None => {}
            }
        }
        return;
    }
    for (name, field) in fields {
        let dot = if path.is_empty() { "" } else { "." };
        let path = format!("{path}{dot}{name}");
        check_value(&schema["properties"][name], field, path, problems);
    }
}

fn in_range(schema: &Value, number: f64) -> bool {
    let bound = |key: &str| schema[key].as_f64();
    bound("minimum").is_none_or(|least| number >= least)
        && bound("exclusiveMinimum").is_none_or(|least| number > least)
        && bound("maximum").is_none_or(|most| number <= most)
        && bound("exclusiveMaximum").is_none_or(|most| number < most)
}

#[cfg(test)]
mod tests {
    use super::*;
    use schemars::JsonSchema;
    use serde::{Deserialize, Serialize};

    #[derive(Clone, Default, Serialize, Deserialize, JsonSchema)]
    struct Inner {
        #[schemars(range(min = 1.0))]
        size_m: f64,
        limit: Option<f64>,
    }

    #[derive(Clone, Serialize, Deserialize, JsonSchema)]
    enum Choice {
        One(Inner),
        Other,
    }

    #[derive(Clone, Serialize, Deserialize, JsonSchema)]
    struct Outer {
        choice: Choice,
        list: Vec<Inner>,
        maybe: Option<Inner>,
    }

    impl Default for Outer {
        fn default() -> Self {
            Self { choice: Choice::Other, list: vec![], maybe: None }
        }
    }

    fn paths(value: &Outer) -> Vec<String> {
        check(value).into_iter().map(|problem| problem.parameter).collect()
    }

    #[test]
    fn ranges_are_checked_in_variants_lists_and_options() {
        let good = Inner { size_m: 2.0, limit: None };
        let bad = Inner { size_m: 0.5, limit: None };
        assert!(paths(&Outer::default()).is_empty());
        let value = Outer {
            choice: Choice::One(bad.clone()),
            list: vec![good, bad.clone()],
            maybe: Some(bad),
        };
        assert_eq!(paths(&value), ["choice.size_m", "list[1].size_m", "maybe.size_m"]);
    }

    #[test]
    fn numbers_that_are_not_finite_are_found() {
        let value = Inner { size_m: f64::NAN, limit: None };
        assert_eq!(check(&value)[0].message, "the number is not finite");
    }
}
