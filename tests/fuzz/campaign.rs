//! Runs one reader on many damaged files.

use super::mutation::damaged;
use opnav::stats::random_stream;
use rand::RngExt;
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// A reader, and whole files for it.
pub struct Target {
    /// Name of the target.
    pub name: &'static str,
    /// Path under the folder of the file that is damaged.
    pub file: &'static str,
    /// Other files that stay whole, by path under the folder.
    pub beside: Vec<(&'static str, Vec<u8>)>,
    /// Whole files to start from.
    pub whole: Vec<Vec<u8>>,
    /// Reads the folder; the error's text if it refuses. Panics where what it read breaks a promise of the reader.
    pub read: fn(&Path) -> Result<(), String>,
}

/// Longest time for one file.
const PATIENCE: Duration = Duration::from_secs(5);
/// Most files kept to start from.
const MOST_KEPT: usize = 500;

/// Some hundreds of files, the same each time.
pub fn in_short(target: Target) {
    run(target, 1, |runs, _| runs < 400);
}

/// As long as `FUZZ_SECONDS` says (600), from the seed in `FUZZ_SEED` (the clock).
pub fn at_length(target: Target) {
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    let limit = Duration::from_secs(number("FUZZ_SECONDS").unwrap_or(600));
    let now = std::time::UNIX_EPOCH.elapsed().map_or(0, |d| d.as_secs());
    run(target, number("FUZZ_SEED").unwrap_or(now), |_, elapsed| elapsed < limit);
}

fn run(target: Target, seed: u64, go_on: impl Fn(u64, Duration) -> bool) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, bytes) in &target.beside {
        put(&folder.path().join(name), bytes);
    }
    for (number, bytes) in target.whole.iter().enumerate() {
        put(&folder.path().join(target.file), bytes);
        (target.read)(folder.path()).unwrap_or_else(|e| panic!("{}: whole file {number} is refused: {e}", target.name));
    }
    let (mut random, start) = (random_stream(seed, target.name, 0), Instant::now());
    let mut kept = target.whole.clone();
    let (mut runs, mut kinds) = (0, BTreeSet::new());
    while go_on(runs, start.elapsed()) {
        let [a, b] = [0, 1].map(|_| random.random_range(0..kept.len()));
        let bytes = damaged(&kept[a], &kept[b], &mut random);
        runs += 1;
        // A refusal that was not met before means that the reader went another way: worth going on from. So are some of
        // the files that are whole in another way.
        let new = match outcome(&target, folder.path(), &bytes) {
            Err(error) => kinds.insert(kind(&error)),
            Ok(()) => random.random_ratio(1, 10),
        };
        if new && kept.len() < MOST_KEPT {
            kept.push(bytes);
        }
    }
    println!("{}: {runs} files, refused in {} ways, {} kept, seed {seed}", target.name, kinds.len(), kept.len());
    assert!(!kinds.is_empty(), "{}: no damage was noticed", target.name);
}

fn outcome(target: &Target, folder: &Path, bytes: &[u8]) -> Result<(), String> {
    put(&folder.join(target.file), bytes);
    let start = Instant::now();
    let result = catch_unwind(AssertUnwindSafe(|| (target.read)(folder)));
    let fault = match &result {
        Err(_) => "it panicked",
        Ok(_) if start.elapsed() > PATIENCE => "it took too long",
        Ok(Err(error)) if !names_a_file(target, folder, error) => "its error names no file",
        Ok(_) => return result.expect("no panic"),
    };
    let path = keep(target.name, bytes);
    panic!("{}: {fault} on {}: {:?}", target.name, path.display(), result.ok());
}

/// Whether an error names the damaged file, or another one in the folder that no longer fits.
fn names_a_file(target: &Target, folder: &Path, error: &str) -> bool {
    error.contains(target.file) || error.contains(&format!("{}/", folder.display()))
}

fn keep(name: &str, bytes: &[u8]) -> PathBuf {
    let path = std::env::temp_dir().join(format!("opnav-fuzz-{name}"));
    put(&path, bytes);
    path
}

fn put(path: &Path, bytes: &[u8]) {
    std::fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
    std::fs::write(path, bytes).expect("a file");
}

/// An error's text without what differs from file to file: up to the first quotation, letters alone.
fn kind(error: &str) -> String {
    let ours = error.split(['\'', '`', '"']).next().unwrap_or_default();
    ours.chars().filter(|c| c.is_ascii_alphabetic() || *c == ' ').take(120).collect()
}
