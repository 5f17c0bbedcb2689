//! `--descriptor`: one of the words that there are, stated in the result.

use super::{image_folder, opnav};
use crate::vision::texture::picture;
use nalgebra::Vector2;
use std::path::Path;
use tempfile::TempDir;

#[test]
fn a_word_that_is_no_descriptor_is_refused() {
    let (pictures, out) = (image_folder(), TempDir::new().expect("a temporary folder"));
    for command in ["track", "land", "tumble"] {
        let result = out.path().join(command);
        let run = &mut opnav();
        run.arg(command).arg(pictures.path()).arg("--out").arg(&result).args(["--descriptor", "surf"]);
        let output = run.output().expect("the command starts");
        let text = String::from_utf8_lossy(&output.stderr).to_string();
        assert_eq!(output.status.code(), Some(2), "{text}");
        for word in ["'surf'", "--descriptor", "orb, sift"] {
            assert!(text.contains(word), "'{word}' is not in: {text}");
        }
        assert!(!result.exists());
    }
}

/// The result's tracks, and the descriptor that its summary states.
fn tracked(folder: &Path, out: &Path, more: &[&str]) -> (Vec<u8>, String) {
    let run = &mut opnav();
    run.arg("track").arg(folder).args(["--fov-deg", "60"]).args(more).arg("--out").arg(out).assert().success();
    let summary = std::fs::read_to_string(out.join("summary.json")).expect("a summary");
    let summary: serde_json::Value = serde_json::from_str(&summary).expect("JSON");
    let stated = &summary["options"]["front_end"]["matcher"]["descriptor"];
    (std::fs::read(out.join("tracks.csv")).expect("tracks"), stated.as_str().expect("a word").to_string())
}

#[test]
fn the_descriptor_is_stated_and_orb_is_the_default() {
    let folder = TempDir::new().expect("a temporary folder");
    let pictures = folder.path().join("pictures");
    std::fs::create_dir(&pictures).expect("a folder");
    for k in 0..3u32 {
        let moved = move |p: Vector2<f64>| p + Vector2::new(3.0, -2.0) * f64::from(k);
        picture(256, 256, 1.0, k.into(), moved).save(pictures.join(format!("a{k}.png"))).expect("written");
    }
    let result = |name: &str, more: &[&str]| tracked(&pictures, &folder.path().join(name), more);
    let (default, stated) = result("default", &[]);
    assert_eq!(stated, "orb");
    assert_eq!(result("orb", &["--descriptor", "orb"]), (default.clone(), "orb".into()));
    let (sift, stated) = result("sift", &["--descriptor", "sift"]);
    assert_eq!(stated, "sift");
    assert!(!sift.is_empty() && sift != default);
}
