//! What an outcome names, in words: requirements, and readings of the document.

use std::collections::BTreeMap;

use adsdv_spec::{Reading, requirement};
use serde_json::Value;

/// All of them, wherever they stand.
pub(super) fn requirements(json: &Value) -> BTreeMap<String, &'static str> {
    let mut found = BTreeMap::new();
    let mut rest = vec![json];
    while let Some(value) = rest.pop() {
        match value {
            Value::String(text) => {
                if let Some(sentence) = requirement(text) {
                    found.insert(text.clone(), sentence);
                }
            }
            Value::Array(values) => rest.extend(values),
            Value::Object(values) => rest.extend(values.values()),
            Value::Null | Value::Bool(_) | Value::Number(_) => {}
        }
    }
    found
}

/// Every question by its id, and every answer as `question=answer`.
pub(super) fn readings() -> BTreeMap<String, &'static str> {
    let questions = Reading::ALL.iter().map(|reading| (reading.id().to_owned(), reading.question()));
    let answers = Reading::ALL.iter().flat_map(|reading| reading.choices());
    questions.chain(answers.map(|choice| (choice.to_string(), choice.text()))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requirements_are_found_wherever_they_stand_and_nothing_else_is() {
        let json =
            serde_json::json!({ "a": [{ "id": "HS-5", "b": ["RDY-7", "HS-999", "hs-5"] }], "RDY-1": 3 });
        let found = requirements(&json);
        assert_eq!(found.keys().collect::<Vec<_>>(), ["HS-5", "RDY-7"]);
        assert_eq!(found.get("HS-5").copied(), requirement("HS-5"));
    }
}
