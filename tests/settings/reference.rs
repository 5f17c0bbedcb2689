//! The page of settings, `datasets/SETTINGS.md`.

use super::all_keys;
use opnav::pipeline::{command_settings, settings_reference};
use std::path::Path;

#[test]
fn the_committed_page_is_that_of_the_types() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets/SETTINGS.md");
    let committed = std::fs::read_to_string(path).expect("a page");
    assert!(
        committed == settings_reference(),
        "it is out of date: `cargo run -- reference settings > datasets/SETTINGS.md` renews it"
    );
}

#[test]
fn every_key_has_a_line_with_type_default_and_meaning() {
    let page = settings_reference();
    let rows: Vec<Vec<&str>> =
        page.lines().filter(|line| line.starts_with("| `")).map(|line| line.split(" | ").collect()).collect();
    for cells in &rows {
        assert_eq!(cells.len(), 5, "{cells:?}");
        assert!(cells[1].len() > 1 && cells[4].len() > 6, "{cells:?}");
    }
    for key in all_keys() {
        let last = key.path.rsplit('.').next().expect("a key");
        assert!(rows.iter().any(|cells| cells[0] == format!("| `{last}`")), "{}", key.path);
    }
    for settings in command_settings() {
        assert!(page.contains(&format!("## `opnav {}`", settings.command)));
    }
}

#[test]
fn defaults_are_those_of_the_command() {
    let page = settings_reference();
    let line = |key: &str| page.lines().find(|line| line.starts_with(&format!("| `{key}` "))).expect("a line");
    let landmarks = line("unknown_landmarks");
    assert!(landmarks.contains("| `3`; in `montecarlo landing` 1, the paper's"), "{landmarks}");
    let mode = line("mode");
    assert!(mode.contains("auto; in `tumble` `\"fixed-center\"`"), "{mode}");
    assert!(line("max_angle_rad").contains("number, rad | 1.0 | above 0 |"), "{}", line("max_angle_rad"));
}
