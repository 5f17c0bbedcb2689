//! Every key of every command can be set from the command line.

use super::{all_keys, changes};

#[test]
fn every_key_can_be_set_to_its_own_default_without_change() {
    let keys = all_keys();
    for key in &keys {
        let line = format!("{}={}", key.path, key.default);
        assert_eq!(changes(key.command, &[&line]), Ok(false), "{}: {line}", key.command);
    }
    let of = |command: &str| keys.iter().filter(|key| key.command == command).count();
    assert!(
        of("track") > 40 && of("land") > 70 && of("tumble") > 55 && of("montecarlo landing") > 35,
        "{}",
        keys.len()
    );
}

#[test]
fn every_key_can_be_set_to_something_else() {
    for key in all_keys() {
        let other = match &key.default {
            serde_json::Value::Bool(value) => (!value).to_string(),
            serde_json::Value::String(_) => continue,
            serde_json::Value::Array(a) if a.is_empty() => continue,
            _ if key.is_whole() => odd_more(&key.default),
            _ => key.change(&nearby(&key.default)).split_once('=').expect("a change").1.into(),
        };
        let line = format!("{}={other}", key.path);
        assert_eq!(changes(key.command, &[&line]), Ok(true), "{}: {line}", key.command);
    }
    let words = [
        ("track", "front_end.matcher.descriptor=sift"),
        ("track", "front_end.mode=fixed-center"),
        ("land", "landing.filter=standard"),
        ("land", "landing.selector=svd"),
        ("land", "landing.landmark_start=delayed"),
        ("land", "landing.image_rotation=measure"),
        ("land", "input.map=some folder"),
        ("tumble", "tumbling.estimator=paper"),
        ("tumble", "tumbling.paper.integration=runge-kutta"),
        ("montecarlo landing", "campaign.field_of_view=canted"),
        ("montecarlo landing", "selectors=[\"random\"]"),
        ("demo", "tumble.tumbling.estimator=realtime"),
    ];
    for (command, line) in words {
        assert_eq!(changes(command, &[line]), Ok(true), "{line}");
    }
}

/// A whole number, or a list of them, that is greater by 2.
fn odd_more(value: &serde_json::Value) -> String {
    match value.as_array() {
        Some(values) => format!("[{}]", values.iter().map(odd_more).collect::<Vec<_>>().join(", ")),
        None => (value.as_u64().expect("a whole number") + 2).to_string(),
    }
}

/// A number a little below another one, or a little above 0.
fn nearby(value: &serde_json::Value) -> String {
    let first = value.as_array().and_then(|a| a.first()).unwrap_or(value).as_f64().expect("a number");
    if first == 0.0 { "1e-6".into() } else { (0.999 * first).to_string() }
}
