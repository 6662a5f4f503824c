//! Ranges: values that their definition does not allow.

use serde_json::Value;

use super::schema::{allows, alternatives, range, schema_of, variant};
use super::{Parameters, Problem};
use crate::code::Code;

/// Finds values outside the ranges of their definition, and numbers that are not finite.
pub(crate) fn check<P: Parameters>(parameters: &P) -> Vec<Problem> {
    let value = serde_json::to_value(parameters).unwrap_or_default();
    let schema = schema_of::<P>();
    let mut search = Search { definitions: &schema["$defs"], problems: Vec::new() };
    search.value(&schema, &value, String::new());
    search.problems
}

struct Search<'a> {
    /// Definitions of the types that may hold themselves, which stand for them by name.
    definitions: &'a Value,
    problems: Vec<Problem>,
}

impl<'a> Search<'a> {
    fn value(&mut self, schema: &'a Value, value: &Value, path: String) {
        let schema = self.defined(schema);
        match value {
            // JSON has no notation for infinities and NaN: serde_json turns them into null.
            Value::Null if allows(schema, "number") && !allows(schema, "null") => {
                let message = "the number is not finite";
                self.refuse(Problem::new(path, message, "a finite number"));
            }
            Value::Number(number) => {
                let number = number.as_f64().unwrap_or(f64::NAN);
                if !in_range(schema, number) {
                    let message = format!("{number} is out of range");
                    self.refuse(Problem::new(path, message, range(schema)));
                }
            }
            Value::Array(items) => {
                let least = schema["minItems"].as_u64().unwrap_or(0) as usize;
                if items.len() < least {
                    let message = format!("the list has {} entries", items.len());
                    self.refuse(Problem::new(&path, message, format!("at least {least}")));
                }
                for (index, item) in items.iter().enumerate() {
                    let inner = schema.get("items").or(schema["prefixItems"].get(index));
                    let path = format!("{path}[{index}]");
                    self.value(inner.unwrap_or(&Value::Null), item, path);
                }
            }
            Value::Object(fields) => self.object(schema, fields, path),
            _ => {}
        }
    }

    fn refuse(&mut self, problem: Problem) {
        self.problems.push(problem.code(Code::OutOfRange));
    }

    fn object(&mut self, schema: &'a Value, fields: &serde_json::Map<String, Value>, path: String) {
        if schema.get("properties").is_none() {
            // An enum: the path of `look: Relief(scale: 2.0)` is `look.scale`, as the file has it.
            for alternative in alternatives(schema) {
                let alternative = self.defined(alternative);
                match variant(alternative) {
                    Some((name, content)) => {
                        if let Some(value) = fields.get(name) {
                            return self.value(content, value, path);
                        }
                    }
                    None if allows(alternative, "object") => {
                        return self.object(alternative, fields, path);
                    }
                    None => {}
                }
            }
            return;
        }
        for (name, field) in fields {
            let dot = if path.is_empty() { "" } else { "." };
            let path = format!("{path}{dot}{name}");
            self.value(&schema["properties"][name], field, path);
        }
    }

    /// The schema that a reference stands for; any other is itself.
    fn defined(&self, schema: &'a Value) -> &'a Value {
        let name = schema["$ref"].as_str().and_then(|name| name.strip_prefix("#/$defs/"));
        name.and_then(|name| self.definitions.get(name)).unwrap_or(schema)
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

    #[derive(Clone, Serialize, Deserialize, JsonSchema)]
    enum Tree {
        Leaf(Inner),
        Branch(Vec<Tree>),
        Stem { next: Box<Tree> },
    }

    #[derive(Clone, Serialize, Deserialize, JsonSchema)]
    struct Forest {
        tree: Tree,
    }

    impl Default for Forest {
        fn default() -> Self {
            Self { tree: Tree::Branch(vec![]) }
        }
    }

    fn paths<P: Parameters>(value: &P) -> Vec<String> {
        check(value).into_iter().map(|problem| problem.parameter).collect()
    }

    #[test]
    fn ranges_are_checked_in_types_that_hold_themselves() {
        let leaf = |size_m| Tree::Leaf(Inner { size_m, limit: None });
        let stem = |tree| Tree::Stem { next: Box::new(tree) };
        let tree = stem(Tree::Branch(vec![leaf(2.0), stem(leaf(0.5)), leaf(f64::NAN)]));
        let found = paths(&Forest { tree });
        assert_eq!(found, ["tree.next[1].next.size_m", "tree.next[2].size_m"]);
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
