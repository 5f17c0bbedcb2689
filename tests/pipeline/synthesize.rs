//! Scenario to data set: layout, truth files, exports, interruptions, disks that fail.

mod disk;
mod export;
mod layout;
mod resume;

use opnav::dataset::sha256_hex;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A small data set with everything in it: two cameras, optical flow, landmarks.
const SMALL: &str = "\
[truth]
flow = true
[[cameras]]
width_px = 96
height_px = 96
[[cameras]]
width_px = 64
height_px = 80
turn_deg = [0.0, 2.0, 0.0]
[tumbling]
frames = 24
[tumbling.shape.procedural]
subdivisions = 4
";

fn scenario_file(folder: &Path, text: &str) -> PathBuf {
    let path = folder.join("scenario.toml");
    std::fs::write(&path, text).expect("a scenario is written");
    path
}

/// `opnav render` with a scenario, ready to start.
fn render(scenario: &Path, out: &Path) -> Command {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin("opnav"));
    command.arg("render").arg(scenario).arg("--out").arg(out);
    command
}

/// Runs to the end and returns what was printed to both outputs.
fn succeed(command: &mut Command) -> String {
    let output = command.output().expect("the command starts");
    let text = String::from_utf8_lossy(&output.stdout).to_string() + &String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    text
}

/// Runs, expects exit 1 and one line of error, and returns that line.
fn fail(command: &mut Command) -> String {
    let output = command.output().expect("the command starts");
    let text = String::from_utf8_lossy(&output.stderr).to_string();
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(!text.contains("panicked"), "{text}");
    let errors: Vec<&str> = text.lines().filter(|line| line.starts_with("error: ")).collect();
    let ours = errors.iter().find(|line| !line.contains("XDG_RUNTIME_DIR"));
    ours.unwrap_or_else(|| panic!("no error in: {text}")).to_string()
}

/// SHA-256 of every file under a folder, by path.
fn checksums(root: &Path) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    let mut folders = vec![root.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let name = path.strip_prefix(root).expect("under the root").to_string_lossy().into_owned();
            found.insert(name, sha256_hex(&std::fs::read(&path).expect("a file")));
        }
    }
    found
}

/// The first difference between two data sets, if any.
fn difference(one: &Path, other: &Path) -> Option<String> {
    let (one, other) = (checksums(one), checksums(other));
    let names: std::collections::BTreeSet<&String> = one.keys().chain(other.keys()).collect();
    names.into_iter().find(|name| one.get(*name) != other.get(*name)).cloned()
}
