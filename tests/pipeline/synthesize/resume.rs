//! Data sets that were interrupted or damaged end up with the same bytes as undisturbed ones.

use super::{SMALL, difference, fail, render, scenario_file, succeed};
use opnav::stats::random_stream;
use rand::RngExt;
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};
use tempfile::TempDir;

fn undisturbed(folder: &Path) -> (std::path::PathBuf, std::path::PathBuf, Duration) {
    let scenario = scenario_file(folder, SMALL);
    let whole = folder.join("whole");
    let start = Instant::now();
    succeed(&mut render(&scenario, &whole));
    (scenario, whole, start.elapsed())
}

/// Starts the job and kills it as soon as its journal has this many lines; false if it ended before.
fn killed_at(scenario: &Path, out: &Path, lines: usize) -> bool {
    let mut command = render(scenario, out);
    let mut job = command.arg("--resume").stderr(Stdio::null()).stdout(Stdio::null()).spawn().expect("a job");
    let noted = || fs::read(out.join("unfinished.txt")).map_or(0, |text| text.iter().filter(|b| **b == b'\n').count());
    while noted() < lines {
        if job.try_wait().expect("a job").is_some() {
            return false;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    job.kill().expect("a job that runs");
    !job.wait().expect("a job").success()
}

/// Kills the job at seeded random moments, by time and by the number of files that are finished, again and again, then
/// lets it finish.
#[test]
fn a_job_killed_at_random_moments_ends_up_with_the_same_bytes() {
    let folder = TempDir::new().expect("a temporary folder");
    let (scenario, whole, duration) = undisturbed(folder.path());
    let mut random = random_stream(11, "kills", 0);
    let mut killed = 0;
    for round in 0..3 {
        let out = folder.path().join(format!("killed{round}"));
        let mut early = render(&scenario, &out).stderr(Stdio::null()).stdout(Stdio::null()).spawn().expect("a job");
        std::thread::sleep(duration.mul_f64(random.random_range(0.0..0.5)));
        early.kill().expect("a job");
        early.wait().expect("a job");
        // Two cameras of 24 pictures, each of three files, and a line of heading.
        for third in 0..3 {
            killed += u32::from(killed_at(&scenario, &out, 2 + 48 * third + random.random_range(0..46)));
        }
        succeed(render(&scenario, &out).arg("--resume"));
        assert_eq!(difference(&whole, &out), None, "round {round}");
    }
    println!("{killed} of 9 jobs were killed amid their pictures");
    assert!(killed >= 4, "{killed} of 9 jobs were killed before they ended");
}

/// Files that were cut short, emptied, changed or lost after they were finished are made anew; so are all lists.
#[test]
fn damaged_files_are_found_and_made_anew() {
    let folder = TempDir::new().expect("a temporary folder");
    let (scenario, whole, _) = undisturbed(folder.path());
    let broken = folder.path().join("broken");
    succeed(&mut render(&scenario, &broken));
    let (first, second) = ("2000000000", "5000000000");
    let cut = fs::OpenOptions::new().write(true).open(broken.join(format!("truth/depth/cam0/{first}.tiff")));
    cut.and_then(|file| file.set_len(1000)).expect("cut short");
    fs::write(broken.join(format!("cam1/data/{first}.png")), b"").expect("emptied");
    let mask = broken.join(format!("truth/mask/cam1/{second}.png"));
    let mut bytes = fs::read(&mask).expect("a mask");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&mask, &bytes).expect("one bit changed");
    fs::remove_file(broken.join(format!("truth/flow/cam0/{second}.flo"))).expect("lost");
    fs::write(broken.join("truth/cam1.tum"), "0 0 0 0 0 0 0 1\n").expect("a list changed");
    fs::write(broken.join("truth/.partial-Ab3"), "half a fi").expect("a killed job's leftover");
    assert!(difference(&whole, &broken).is_some(), "nothing was damaged");
    succeed(render(&scenario, &broken).arg("--resume"));
    assert_eq!(difference(&whole, &broken), None);
}

/// Frames made in pieces, in any order, are the same data set; without a manifest or journal nothing is trusted.
#[test]
fn pieces_make_the_same_data_set() {
    let folder = TempDir::new().expect("a temporary folder");
    let (scenario, whole, _) = undisturbed(folder.path());
    let out = folder.path().join("pieces");
    succeed(render(&scenario, &out).args(["--frames", "5..9"]));
    assert!(
        out.join("truth/flow/cam0/7000000000.flo").exists() && !out.join("truth/flow/cam0/8000000000.flo").exists()
    );
    succeed(render(&scenario, &out).args(["--frames", "0..2", "--resume"]));
    let list = fs::read_to_string(out.join("cam1/data.csv")).expect("a list");
    assert_eq!(list.lines().count(), 1 + 6, "{list}");
    fs::remove_file(out.join("manifest.json")).expect("a manifest");
    fs::write(out.join("cam0/data/6000000000.png"), "nonsense").expect("written");
    succeed(render(&scenario, &out).arg("--resume"));
    assert_eq!(difference(&whole, &out), None);
}

#[test]
fn another_scenario_or_adapter_is_refused() {
    let folder = TempDir::new().expect("a temporary folder");
    let (scenario, whole, _) = undisturbed(folder.path());
    let error = fail(render(&scenario, &whole).args(["--resume", "--seed", "9"]));
    assert!(error.contains("another scenario"), "{error}");
    let error = fail(&mut render(&scenario, &whole));
    assert!(error.contains("not empty") && error.contains("--resume"), "{error}");
    let manifest = whole.join("manifest.json");
    let text = fs::read_to_string(&manifest).expect("a manifest");
    let adapter = text.lines().find(|line| line.contains("\"adapter\"")).expect("an adapter");
    fs::write(&manifest, text.replace(adapter, "  \"adapter\": \"Another 3000\",")).expect("written");
    let error = fail(render(&scenario, &whole).arg("--resume"));
    assert!(error.contains("Another 3000") && error.contains("--adapter"), "{error}");
}
