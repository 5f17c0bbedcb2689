//! Words and numbers on the command line, and how they are laid over settings.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// Parses numbers with commas between them.
pub fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let found: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse()).collect();
    let numbers = found.ok().and_then(|numbers| numbers.try_into().ok());
    numbers.ok_or_else(|| format!("'{text}' is not {N} numbers with commas between them"))
}

/// Parses one of the words of a choice, each explained by the documentation of its value.
pub fn word<T: JsonSchema + DeserializeOwned + Clone + Send + Sync + 'static>() -> impl TypedValueParser<Value = T> {
    let schema = schemars::schema_for!(T).to_value();
    let text = |value: &Value| value.as_str().unwrap_or_default().trim_end_matches('.').to_string();
    let values = schema["oneOf"].as_array().into_iter().flatten();
    // The parser keeps words for as long as the program runs, and is made once.
    let words: Vec<PossibleValue> = values
        .map(|value| PossibleValue::new(text(&value["const"]).leak() as &str).help(text(&value["description"])))
        .collect();
    PossibleValuesParser::new(words).map(|word| serde_json::from_value(word.into()).expect("one of the possible words"))
}

/// Puts what is given in the place of a setting.
pub fn put<T: Copy>(setting: &mut T, given: Option<T>) {
    if let Some(value) = given {
        *setting = value;
    }
}
