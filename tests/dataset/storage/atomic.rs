//! Files that are there whole or not at all.

use crate::dataset::{complaint, folder, put};
use opnav::dataset::*;
use std::fs;
use std::path::Path;

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn a_failed_write_leaves_nothing_and_keeps_what_was_there() {
    let dir = folder();
    let path = dir.path().join("result.csv");
    let fail = |w: &mut (dyn std::io::Write + '_)| {
        w.write_all(b"half a fi")?;
        Err(std::io::Error::other("the disk is full"))
    };
    complaint(write_atomically(&path, fail), &path, None, &["the disk is full"]);
    assert_eq!(names(dir.path()), Vec::<String>::new());
    write_text(&path, "first").expect("write");
    complaint(write_atomically(&path, fail), &path, None, &["could not write"]);
    assert_eq!(names(dir.path()), ["result.csv"]);
    assert_eq!(fs::read_to_string(&path).expect("kept"), "first");
    write_text(&path, "second").expect("write");
    assert_eq!(fs::read_to_string(&path).expect("replaced"), "second");
}

#[test]
fn a_destination_that_is_a_folder_is_named_and_nothing_is_left_beside_it() {
    let dir = folder();
    let path = dir.path().join("taken");
    fs::create_dir(&path).expect("a folder");
    put(&path, "inside", "x");
    complaint(write_text(&path, "text"), &path, None, &["could not write"]);
    assert_eq!(names(dir.path()), ["taken"]);
}

#[cfg(unix)]
#[test]
fn finished_files_can_be_read_by_others() {
    use std::os::unix::fs::PermissionsExt;
    let dir = folder();
    let path = dir.path().join("a.txt");
    write_text(&path, "x").expect("write");
    assert_eq!(fs::metadata(&path).expect("it exists").permissions().mode() & 0o777, 0o644);
}
