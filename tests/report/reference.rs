//! The reference of a scenario's keys, `datasets/REFERENCE.md`.

use opnav::report::scenario_reference;
use opnav::scene::Scenario;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn datasets() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets")
}

fn reference() -> String {
    scenario_reference(&Scenario::schema())
}

/// The path of every key in a reference: a heading's paths before the keys of its lines.
fn keys_of_reference(text: &str) -> BTreeSet<String> {
    let mut keys = BTreeSet::new();
    let mut tables: Vec<&str> = Vec::new();
    for line in text.lines() {
        if let Some(heading) = line.strip_prefix("## ") {
            tables = heading.split('`').skip(1).step_by(2).map(|path| path.trim_matches(['[', ']'])).collect();
        } else if let Some(key) = line.strip_prefix("| `").and_then(|rest| rest.split('`').next()) {
            match tables.as_slice() {
                [] => _ = keys.insert(key.to_string()),
                tables => keys.extend(tables.iter().map(|table| format!("{table}.{key}"))),
            }
        }
    }
    keys
}

/// The path of every key in a scenario file.
fn keys_of_scenario(value: &toml::Value, path: &str, keys: &mut BTreeSet<String>) {
    match value {
        toml::Value::Table(table) => {
            for (key, value) in table {
                let below = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                keys_of_scenario(value, &below, keys);
                keys.insert(below);
            }
        }
        toml::Value::Array(entries) => entries.iter().for_each(|entry| keys_of_scenario(entry, path, keys)),
        _ => {}
    }
}

fn unknown_keys(text: &str) -> Vec<String> {
    let table: toml::Table = text.parse().expect("TOML");
    let mut keys = BTreeSet::new();
    keys_of_scenario(&toml::Value::Table(table), "", &mut keys);
    assert!(keys.len() > 3, "the keys were not found");
    keys.difference(&keys_of_reference(&reference())).cloned().collect()
}

#[test]
fn the_committed_reference_is_that_of_the_types() {
    let committed = std::fs::read_to_string(datasets().join("REFERENCE.md")).expect("a reference");
    assert!(committed == reference(), "it is out of date: `cargo run -- reference > datasets/REFERENCE.md` renews it");
}

#[test]
fn every_key_of_every_scenario_is_in_the_reference() {
    let files = std::fs::read_dir(datasets()).expect("the scenarios").map(|entry| entry.expect("an entry").path());
    let scenarios: Vec<PathBuf> = files.filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    assert!(scenarios.len() >= 12, "the scenarios were not found");
    for path in scenarios {
        let written = std::fs::read_to_string(&path).expect("a scenario");
        let resolved = Scenario::read(&path, &[]).expect("a scenario").to_toml();
        for text in [written, resolved] {
            assert_eq!(unknown_keys(&text), Vec::<String>::new(), "{}", path.display());
        }
    }
}

#[test]
fn every_choice_of_a_scenario_is_in_the_reference() {
    let text = "[[cameras]]\nsensor.exposure.percentile = { percent = 90.0, full_well_share = 0.5 }\n\
                [tumbling.surface.photometry.hapke]\nroughness_deg = 3.0\n[tumbling.sky]\nstars = true\n";
    assert_eq!(unknown_keys(text), Vec::<String>::new());
}

#[test]
fn a_key_that_no_type_has_is_missed() {
    let text = "[camera]\nwidth_px = 64\ncolour = 1\n[sensor]\nshutter.speed = 2.0\n";
    assert_eq!(unknown_keys(text), ["camera.colour", "sensor.shutter.speed"]);
}

#[test]
fn every_key_has_a_type_and_a_meaning() {
    let text = reference();
    let mut lines = 0;
    for line in text.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<&str> = line.split(" | ").collect();
        assert_eq!(cells.len(), 5, "{line}");
        assert!(cells[1].len() > 1 && cells[4].len() > 6, "{line}");
        lines += 1;
    }
    assert!(lines > 150, "{lines} keys were found");
}

/// Numbers of a text, in order.
fn numbers(text: &str) -> Vec<f64> {
    let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || "+-.".contains(c)));
    words.filter_map(|word| word.trim_end_matches('.').parse().ok()).filter(|n: &f64| n.is_finite()).collect()
}

/// Defaults that a type's documentation states otherwise than its code: the key, what is said, what holds.
fn false_defaults(node: &serde_json::Value, key: &str, found: &mut Vec<String>) {
    match node {
        serde_json::Value::Object(map) => {
            map.iter().for_each(|(key, value)| false_defaults(value, key, found));
            let said = map.get("description").and_then(|d| d.as_str()).and_then(|d| d.split("(default ").nth(1));
            let (Some(said), Some(value)) = (said, map.get("default").filter(|d| !d.is_object())) else { return };
            let value = value.to_string();
            let holds = numbers(&value);
            let close = |(said, holds): (&f64, &f64)| (said - holds).abs() <= 1e-4 * holds.abs();
            let wrong = numbers(said).len() < holds.len() || !numbers(said).iter().zip(&holds).all(close);
            let wrong_word = ["true", "false"].iter().any(|word| value == *word && !said.starts_with(word));
            if wrong || wrong_word {
                found.push(format!("{key}: \"(default {said}\" against {value}"));
            }
        }
        serde_json::Value::Array(items) => items.iter().for_each(|item| false_defaults(item, key, found)),
        _ => {}
    }
}

#[test]
fn stated_defaults_are_those_of_the_code() {
    let mut found = Vec::new();
    false_defaults(&Scenario::schema(), "", &mut found);
    assert!(found.is_empty(), "{}", found.join("\n"));
    for (said, value) in [("0.3", serde_json::json!(0.4)), ("true", false.into()), ("1, 2", serde_json::json!([1, 3]))]
    {
        let node = serde_json::json!({ "description": format!("A key (default {said})."), "default": value });
        false_defaults(&node, "key", &mut found);
    }
    assert_eq!(found.len(), 3, "a false default was not found: {found:?}");
}
