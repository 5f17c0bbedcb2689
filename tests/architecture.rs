//! The house rules: which room may use which, and which rooms may name wgpu and OpenCV.
//!
//! The test reads the sources as text: every `crate::room…` path (grouped imports included) and every `wgpu::`,
//! `opencv::`. The checker itself is tested on forbidden imports.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// A room and the rooms that it may use. `dataset/truth` is a room of its own behind the truth wall.
const TABLE: &[(&str, &[&str])] = &[
    ("geometry", &[]),
    ("stats", &["geometry"]),
    ("dataset", &["geometry", "stats"]),
    ("scene", &["geometry", "stats", "dataset", "dataset/truth"]),
    ("render", &["geometry", "stats", "dataset", "dataset/truth", "scene"]),
    ("vision", &["geometry", "stats", "dataset"]),
    ("navigation/filter", &["geometry", "stats"]),
    ("navigation/landmark", &["geometry", "stats"]),
    ("navigation/observability", &["geometry", "stats"]),
    ("navigation/landing", MISSION),
    ("navigation/tumbling", MISSION),
    ("navigation/attachment", MISSION),
    ("evaluation", &["geometry", "stats", "dataset", "dataset/truth", "scene", "render", "vision", "navigation"]),
    ("report", &["geometry", "stats", "dataset", "evaluation", "vision", "navigation"]),
    ("pipeline", ALL),
    ("cli", &["pipeline", "report"]),
];
const MISSION: &[&str] =
    &["geometry", "stats", "dataset", "vision", "navigation/filter", "navigation/landmark", "navigation/observability"];
const ALL: &[&str] = &[
    "geometry",
    "stats",
    "dataset",
    "dataset/truth",
    "scene",
    "render",
    "vision",
    "navigation",
    "evaluation",
    "report",
];

/// What one file does against the rules, in words; empty if nothing.
fn violations(file: &str, source: &str) -> Vec<String> {
    let Some(room) = room_of_file(file) else { return Vec::new() };
    let code: String = source.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n");
    let allowed = TABLE.iter().find(|(name, _)| *name == room).map(|(_, uses)| *uses).unwrap_or(&[]);
    let own = |used: &str| used == room || (room == "dataset" && used.starts_with("dataset"));
    let permitted = |used: &str| {
        own(used) || allowed.iter().any(|a| *a == used || (*a == "navigation" && used.starts_with("navigation")))
    };
    let mut found: Vec<String> = used_rooms(&code)
        .into_iter()
        .filter(|used| !permitted(used))
        .map(|used| format!("{file}: room `{room}` may not use `{used}`"))
        .collect();
    for (library, owner) in [("wgpu", "render"), ("opencv", "vision")] {
        if room != owner && names_crate(&code, library) {
            found.push(format!("{file}: only `{owner}` may name `{library}`"));
        }
    }
    found
}

/// The room of a file under `src/`; `None` for the crate's roots and for front doors above several rooms.
fn room_of_file(file: &str) -> Option<String> {
    let inside = file.strip_prefix("src/")?;
    let mut parts = inside.split('/');
    let first = parts.next()?;
    match (first, parts.next()) {
        (_, None) => None,
        ("navigation", Some("mod.rs")) => None,
        ("navigation", Some(mission)) => Some(format!("navigation/{mission}")),
        (room, Some(_)) => Some(room.to_string()),
    }
}

/// Every room that a source names by `crate::…` or, as the command line does, `opnav::…`.
fn used_rooms(code: &str) -> BTreeSet<String> {
    let mut rooms = BTreeSet::new();
    for root in ["crate::", "opnav::"] {
        for (at, _) in code.match_indices(root) {
            let preceded = code[..at].chars().next_back().is_some_and(|c| c.is_alphanumeric() || c == '_' || c == '$');
            if !preceded {
                expand(&code[at + root.len()..], "", &mut rooms);
            }
        }
    }
    rooms
}

/// Follows a path such as `a::{b::c, d}` and notes the room of each leaf.
fn expand(rest: &str, prefix: &str, rooms: &mut BTreeSet<String>) {
    let rest = rest.trim_start();
    if let Some(group) = rest.strip_prefix('{') {
        let mut depth = 1;
        let mut start = 0;
        for (at, c) in group.char_indices() {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                _ => {}
            }
            if (c == ',' && depth == 1) || depth == 0 {
                let item = &group[start..at];
                if !item.trim().is_empty() {
                    expand(item, prefix, rooms);
                }
                start = at + 1;
            }
            if depth == 0 {
                break;
            }
        }
        return;
    }
    let word: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    let path = if prefix.is_empty() { word.clone() } else { format!("{prefix}/{word}") };
    let after = rest[word.len()..].trim_start();
    let deeper = after.strip_prefix("::").filter(|_| path == "navigation" || path == "dataset");
    match deeper {
        Some(next) => expand(next, &path, rooms),
        None => {
            rooms.insert(room_of_path(&path));
        }
    }
}

fn room_of_path(path: &str) -> String {
    if path.starts_with("navigation/") || path == "dataset/truth" {
        return path.to_string();
    }
    path.split('/').next().unwrap_or(path).to_string()
}

fn names_crate(code: &str, library: &str) -> bool {
    [format!("{library}::"), format!("use {library};"), format!("use {library} as")].iter().any(|needle| {
        code.match_indices(needle.as_str())
            .any(|(at, _)| !code[..at].chars().next_back().is_some_and(|c| c.is_alphanumeric() || c == '_'))
    })
}

fn rust_files(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("the folder of sources can be listed") {
        let path = entry.expect("a folder entry").path();
        if path.is_dir() {
            rust_files(&path, into);
        } else if path.extension().is_some_and(|e| e == "rs") {
            into.push(path);
        }
    }
}

#[test]
fn every_room_keeps_to_the_table() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    rust_files(&root.join("src"), &mut files);
    assert!(files.len() > 20, "the sources were not found");
    let mut found = Vec::new();
    for path in files {
        let name = path.strip_prefix(root).expect("under the root").to_string_lossy().replace('\\', "/");
        let source = std::fs::read_to_string(&path).expect("a readable source");
        found.extend(violations(&name, &source));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn every_room_is_in_the_table() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for entry in std::fs::read_dir(root).expect("src can be listed") {
        let path = entry.expect("a folder entry").path();
        let name = path.file_name().expect("a name").to_string_lossy().to_string();
        let known = name == "navigation" || TABLE.iter().any(|(room, _)| *room == name);
        assert!(!path.is_dir() || known, "src/{name} is not a room of the table");
    }
}

#[test]
fn forbidden_imports_are_found() {
    let cases = [
        ("src/navigation/landing/step.rs", "use crate::dataset::truth::LanderState;"),
        ("src/navigation/landing/step.rs", "use crate::{geometry::so3, dataset::{ImuSample, truth::LanderState}};"),
        ("src/navigation/tumbling/fit.rs", "fn f() { crate::scene::Scenario::default(); }"),
        ("src/navigation/filter/gate.rs", "use crate::dataset::ImuSample;"),
        ("src/vision/harris.rs", "use crate::dataset::truth;"),
        ("src/vision/harris.rs", "use wgpu::Device;"),
        ("src/render/device.rs", "use opencv::core::Mat;"),
        ("src/geometry/camera.rs", "use crate::stats::Estimate;"),
        ("src/cli/land.rs", "use opnav::navigation::landing::LandingConfig;"),
    ];
    for (file, source) in cases {
        assert_eq!(violations(file, source).len(), 1, "{file}: {source}");
    }
}

#[test]
fn permitted_imports_pass() {
    let cases = [
        ("src/navigation/landing/step.rs", "use crate::{geometry::so3, dataset::{ImuSample, InitialState}};"),
        ("src/navigation/landing/step.rs", "use crate::navigation::filter::gate;"),
        ("src/scene/imu.rs", "use crate::dataset::truth::LanderState; // crate::render"),
        ("src/render/device.rs", "use wgpu::Device;"),
        ("src/vision/harris.rs", "use opencv::core::Mat;"),
        ("src/evaluation/landing.rs", "use crate::dataset::{truth::read_lander_states, read_tum};"),
    ];
    for (file, source) in cases {
        assert!(violations(file, source).is_empty(), "{file}: {:?}", violations(file, source));
    }
}
