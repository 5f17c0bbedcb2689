//! Disks that are full, folders that cannot be written, pictures of nothing.

use super::{SMALL, checksums, difference, fail, render, scenario_file, succeed};
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

fn assert_nothing_half_written(out: &Path) {
    let files = checksums(out);
    let left: Vec<&String> = files.keys().filter(|name| name.contains(".partial-")).collect();
    assert!(left.is_empty(), "{left:?}");
    assert!(!files.contains_key("manifest.json"), "a failed job has a manifest");
}

/// A limit on the size of files fails a write in the middle of a file, as a full disk does.
#[cfg(unix)]
#[test]
fn a_write_that_fails_ends_the_job_and_resuming_completes_it() {
    let folder = TempDir::new().expect("a temporary folder");
    let scenario = scenario_file(folder.path(), SMALL);
    let (whole, out) = (folder.path().join("whole"), folder.path().join("full"));
    succeed(&mut render(&scenario, &whole));
    let job = render(&scenario, &out);
    let mut limited = Command::new("bash");
    limited.args(["-c", "trap '' XFSZ; ulimit -f 30; exec \"$0\" \"$@\""]).arg(job.get_program()).args(job.get_args());
    limited.env("MESA_SHADER_CACHE_DISABLE", "true");
    let error = fail(&mut limited);
    assert!(error.contains("truth/depth/cam0") && error.contains("could not write"), "{error}");
    assert_nothing_half_written(&out);
    succeed(render(&scenario, &out).arg("--resume"));
    assert_eq!(difference(&whole, &out), None);
}

#[test]
fn folders_that_cannot_be_made_are_named() {
    let folder = TempDir::new().expect("a temporary folder");
    let scenario = scenario_file(folder.path(), SMALL);
    // A file stands where the data set, or one of its folders, should be.
    let error = fail(&mut render(&scenario, &scenario.join("out")));
    assert!(error.contains("scenario.toml/out"), "{error}");
    let out = folder.path().join("out");
    std::fs::create_dir_all(out.join("truth")).expect("a folder");
    std::fs::write(out.join("truth/depth"), "in the way").expect("a file");
    let error = fail(render(&scenario, &out).arg("--resume"));
    assert!(error.contains("truth/depth"), "{error}");
    assert_nothing_half_written(&out);
}

/// A user without the right to write; only root can become one.
#[cfg(unix)]
#[test]
fn a_read_only_folder_is_named() {
    use std::os::unix::fs::{MetadataExt, PermissionsExt};
    use std::os::unix::process::CommandExt;
    let folder = TempDir::new().expect("a temporary folder");
    let scenario = scenario_file(folder.path(), SMALL);
    let closed = folder.path().join("closed");
    std::fs::create_dir(&closed).expect("a folder");
    for (path, mode) in [(closed.as_path(), 0o555), (folder.path(), 0o755)] {
        std::fs::set_permissions(path, std::fs::Permissions::from_mode(mode)).expect("permissions");
    }
    let mut job = render(&scenario, &closed.join("out"));
    if std::fs::metadata(&closed).expect("a folder").uid() == 0 {
        let program = Path::new(job.get_program()).to_path_buf();
        let reachable = program
            .ancestors()
            .skip(1)
            .all(|place| place.metadata().is_ok_and(|found| found.permissions().mode() & 0o001 != 0));
        if !reachable {
            println!("skipped: nobody but root may start {}", program.display());
            return;
        }
        job.uid(65_534);
    }
    let error = fail(&mut job);
    assert!(error.contains("closed/out") && error.contains("ermission denied"), "{error}");
}

/// A picture without anything to see in it is drawn, for it may be meant, but never without a word.
#[test]
fn images_of_nothing_are_told() {
    let folder = TempDir::new().expect("a temporary folder");
    let text = "[[cameras]]\nwidth_px = 32\nheight_px = 32\n[[cameras]]\nwidth_px = 32\nheight_px = 32\n\
                turn_deg = [0.0, 120.0, 0.0]\n[tumbling]\nframes = 3\n[tumbling.shape.procedural]\nsubdivisions = 3\n";
    let scenario = scenario_file(folder.path(), text);
    let said = succeed(&mut render(&scenario, &folder.path().join("away")));
    assert!(said.contains("warning: 3 pictures (cam1 at 0 s the first) show nothing"), "{said}");
    let mut dark = render(&scenario, &folder.path().join("dark"));
    let said = succeed(dark.args(["--set", "tumbling.sun.phase_deg=180.0"]));
    assert!(said.contains("warning: 3 pictures (cam0 at 0 s the first) show no sunlit ground"), "{said}");
}
