//! Memory over the length of a folder.

use crate::accuracy_bar::{Bar, check_table};
use crate::vision::texture::picture;
use nalgebra::Vector2;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

const SIDE: u32 = 160;
const SHORT: usize = 50;
const LONG: usize = 400;

/// Greatest memory in bytes that tracking the first `count` pictures takes, and the observations it writes.
fn peak_bytes(folder: &Path, count: usize) -> (f64, usize) {
    let out = tempfile::tempdir().expect("a temporary folder");
    let mut job = Command::new(assert_cmd::cargo::cargo_bin("opnav"))
        .args(["track", "--quiet", "--fov-deg", "60", "--frames", &format!("0..{count}")])
        .arg(folder)
        .arg("--out")
        .arg(out.path())
        .stdin(Stdio::null())
        .spawn()
        .expect("the command starts");
    let status = format!("/proc/{}/status", job.id());
    let mut peak_kib = 0.0_f64;
    while job.try_wait().expect("a state").is_none() {
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let now = line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<f64>().ok());
        peak_kib = peak_kib.max(now.unwrap_or(0.0));
        std::thread::sleep(Duration::from_millis(20));
    }
    assert!(job.wait().expect("an end").success());
    let tracks = std::fs::read_to_string(out.path().join("tracks.csv")).expect("tracks");
    (1024.0 * peak_kib, tracks.lines().count() - 1)
}

/// What a long folder takes more than a short one is its tracks: an observation is 48 bytes, and its list may have been
/// made with room for as many again.
#[test]
#[ignore = "half a minute"]
#[cfg(target_os = "linux")]
fn accuracy_of_memory_over_a_long_folder() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for k in 0..LONG {
        let place = |p: Vector2<f64>| p + Vector2::new(3.0 * k as f64, 1.0 * k as f64);
        let picture = picture(SIDE, SIDE, 1.0, k as u64, place);
        picture.save(folder.path().join(format!("a{k}.png"))).expect("written");
    }
    let (short, few) = peak_bytes(folder.path(), SHORT);
    let (long, many) = peak_bytes(folder.path(), LONG);
    let each = (long - short) / (many - few) as f64;
    let bars = vec![
        Bar::stated(format!("peak memory, {SHORT} pictures of {SIDE} px"), short / 1e6, "MB"),
        Bar::stated(format!("peak memory, {LONG} pictures of {SIDE} px"), long / 1e6, "MB"),
        Bar::stated("growth over that, a picture", (long - short) / (LONG - SHORT) as f64 / 1e3, "kB"),
        Bar::at_most("growth over that, an observation", each, 100.0, "bytes"),
    ];
    check_table("Memory of tracking", [bars].into_iter());
}
