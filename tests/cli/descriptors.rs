//! `--detector` and `--descriptor`: one of the words that there are, stated in the result.

use super::{image_folder, opnav};
use crate::vision::texture::picture;
use nalgebra::Vector2;
use std::path::Path;
use tempfile::TempDir;

#[test]
fn a_word_that_there_is_not_is_refused() {
    let (pictures, out) = (image_folder(), TempDir::new().expect("a temporary folder"));
    let wrong = [("--descriptor", "orb, sift"), ("--detector", "harris, shi-tomasi")];
    for (command, (option, words)) in ["track", "land", "tumble"].iter().flat_map(|c| wrong.map(|w| (*c, w))) {
        let result = out.path().join(command);
        let run = &mut opnav();
        run.arg(command).arg(pictures.path()).arg("--out").arg(&result).args([option, "surf"]);
        let output = run.output().expect("the command starts");
        let text = String::from_utf8_lossy(&output.stderr).to_string();
        assert_eq!(output.status.code(), Some(2), "{text}");
        for word in ["'surf'", option, words] {
            assert!(text.contains(word), "'{word}' is not in: {text}");
        }
        assert!(!result.exists());
    }
}

/// The result's tracks, and the detector and descriptor that its summary states.
fn tracked(folder: &Path, out: &Path, more: &[&str]) -> (Vec<u8>, [String; 2]) {
    let run = &mut opnav();
    run.arg("track").arg(folder).args(["--fov-deg", "60"]).args(more).arg("--out").arg(out).assert().success();
    let summary = std::fs::read_to_string(out.join("summary.json")).expect("a summary");
    let summary: serde_json::Value = serde_json::from_str(&summary).expect("JSON");
    let front_end = &summary["options"]["front_end"];
    let stated = [&front_end["detector"]["kind"], &front_end["matcher"]["descriptor"]];
    let words = stated.map(|word| word.as_str().expect("a word").to_string());
    (std::fs::read(out.join("tracks.csv")).expect("tracks"), words)
}

#[test]
fn the_choice_is_stated_and_has_a_default() {
    let folder = TempDir::new().expect("a temporary folder");
    let pictures = folder.path().join("pictures");
    std::fs::create_dir(&pictures).expect("a folder");
    for k in 0..3u32 {
        let moved = move |p: Vector2<f64>| p + Vector2::new(3.0, -2.0) * f64::from(k);
        picture(256, 256, 1.0, k.into(), moved).save(pictures.join(format!("a{k}.png"))).expect("written");
    }
    let result = |name: &str, more: &[&str]| tracked(&pictures, &folder.path().join(name), more);
    let (default, stated) = result("default", &[]);
    assert_eq!(stated, ["harris", "orb"]);
    let named = result("named", &["--descriptor", "orb", "--detector", "harris"]);
    assert_eq!(named, (default.clone(), stated));
    let (sift, stated) = result("sift", &["--descriptor", "sift"]);
    assert_eq!(stated, ["harris", "sift"]);
    let (shi_tomasi, stated) = result("shi-tomasi", &["--detector", "shi-tomasi"]);
    assert_eq!(stated, ["shi-tomasi", "orb"]);
    assert!(!sift.is_empty() && sift != default && !shi_tomasi.is_empty() && shi_tomasi != default);
}
