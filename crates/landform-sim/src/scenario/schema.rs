//! The JSON schema of a whole scenario, put together from the definitions of its parts.

use schemars::{JsonSchema, SchemaGenerator};
use serde_json::{Map, Value, json};

use crate::initial::Combine;
use crate::registry::{Kind, Registry};
use crate::stop::Stop;

/// The dialect that schemas are written in.
const DRAFT: &str = "https://json-schema.org/draft/2020-12/schema";

/// The JSON schema of the scenarios that `registry` can read, in their JSON form: a struct is an
/// object, a list or a tuple an array, and `Name(parameter: value)` is
/// `{"Name": {"parameter": value}}`. Every parameter has its description, unit, range, default
/// and source from its one definition.
pub fn scenario_schema(registry: &Registry) -> Value {
    let mut parts = Parts::default();
    let [stop, combine] = [parts.of::<Stop>(), parts.of::<Combine>()];
    let domain = parts.choice("domain", &registry.domains);
    let initial = parts.choice("initial", &registry.initial);
    let process = parts.choice("process", &registry.processes);
    let metric = parts.choice("metric", &registry.metrics);
    let output = parts.choice("output", &registry.outputs);
    let counted =
        |what: &str| json!({"description": what, "type": "integer", "minimum": 1, "default": 1});
    let initial_entry = object(
        &["field", "from"],
        json!({"field": text("Name of the field."), "from": initial, "combine": combine}),
    );
    let stage = object(
        &["processes"],
        json!({
            "name": text("Name in reports."),
            "processes": {"type": "array", "items": process, "minItems": 1},
            "stop": stop,
        }),
    );
    let mut schema = object(
        &["title", "domain", "stages"],
        json!({
            "title": text("What the run shows, in a line."),
            "description": text("What to look for, in a few sentences."),
            "seed": {"description": "Seed of all random numbers.", "type": "integer", "minimum": 0, "default": 1},
            "domain": domain,
            "initial": {"type": "array", "items": initial_entry},
            "stages": {"type": "array", "items": stage},
            "metrics": {"type": "array", "items": metric},
            "measure_every": counted("Iterations between two measurements."),
            "outputs": {"type": "array", "items": output},
        }),
    );
    schema["$schema"] = DRAFT.into();
    schema["title"] = "Landform scenario".into();
    schema["$defs"] = parts.definitions.into();
    schema
}

/// An object with these properties and no others.
fn object(required: &[&str], properties: Value) -> Value {
    json!({
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    })
}

fn text(what: &str) -> Value {
    json!({"description": what, "type": "string"})
}

/// Definitions that the schema refers to.
#[derive(Default)]
struct Parts {
    definitions: Map<String, Value>,
}

impl Parts {
    /// A type that may hold itself, by reference.
    fn of<T: JsonSchema>(&mut self) -> Value {
        let mut generator = SchemaGenerator::default();
        let reference = generator.subschema_for::<T>().to_value();
        self.definitions.extend(generator.take_definitions(true));
        reference
    }

    /// Any of the registered types of a kind, by reference.
    fn choice<T: ?Sized>(&mut self, name: &str, kind: &Kind<T>) -> Value {
        let alternatives: Vec<Value> = kind
            .iter()
            .map(|entry| {
                let content = self.hoisted(entry.schema());
                let mut alternative = object(&[entry.name], json!({entry.name: content}));
                alternative["description"] = entry.description().into();
                alternative
            })
            .collect();
        self.definitions.insert(name.to_owned(), json!({"oneOf": alternatives}));
        json!({"$ref": format!("#/$defs/{name}")})
    }

    /// A schema without the keys of a whole document; its definitions go where references, which
    /// begin at the whole document, look for them.
    fn hoisted(&mut self, mut schema: Value) -> Value {
        if let Some(keys) = schema.as_object_mut() {
            keys.remove("$schema");
            if let Some(Value::Object(own)) = keys.remove("$defs") {
                self.definitions.extend(own);
            }
        }
        schema
    }
}
