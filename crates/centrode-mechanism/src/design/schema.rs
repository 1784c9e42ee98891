use schemars::Schema;
use schemars::generate::SchemaSettings;
use serde_json::{Value, json};

use super::DesignFamily;

/// The JSON schema of the design files of some families.
#[must_use]
pub fn json_schema<F: AsRef<DesignFamily>>(families: &[F]) -> Value {
    let mut generator = SchemaSettings::default().into_generator();
    let alternatives: Vec<Value> = families
        .iter()
        .map(|family| {
            let family: &DesignFamily = family.as_ref();
            let mut schema = (family.schema)(&mut generator);
            family.tag(&mut schema);
            schema.insert("description".into(), json!(family.about));
            schema.to_value()
        })
        .collect();
    json!({
        "oneOf": alternatives,
        "description": "A mechanism as written: one of the families, by the key `family`.",
        "title": "Design",
        "$schema": generator.settings().meta_schema,
        "$defs": generator.take_definitions(true),
    })
}

impl DesignFamily {
    /// The JSON schema of the family's design files.
    #[must_use]
    pub fn json_schema(&self) -> Value {
        let mut generator = SchemaSettings::default().into_generator();
        let mut schema = (self.schema)(&mut generator);
        schema.insert("title".into(), json!((self.title)()));
        schema.insert("$schema".into(), json!(generator.settings().meta_schema));
        let definitions = generator.take_definitions(true);
        if !definitions.is_empty() {
            schema.insert("$defs".into(), Value::Object(definitions));
        }
        self.tag(&mut schema);
        schema.to_value()
    }

    /// Adds the key that names the family.
    fn tag(&self, schema: &mut Schema) {
        let word = json!({ "type": "string", "const": self.word });
        if let Some(properties) = schema.get_mut("properties").and_then(|p| p.as_object_mut()) {
            properties.insert("family".into(), word);
        }
        match schema.get_mut("required").and_then(|r| r.as_array_mut()) {
            Some(required) => required.push("family".into()),
            None => {
                schema.insert("required".into(), json!(["family"]));
            }
        }
    }
}
