//! The command line of a build that leaves rooms out.

use assert_cmd::Command;

#[test]
fn a_subcommand_that_the_build_lacks_names_its_features() {
    let output = Command::cargo_bin("opnav").expect("the binary").args(["track", "x", "--out", "y"]).output();
    let output = output.expect("the command starts");
    let text = String::from_utf8_lossy(&output.stderr).to_string();
    assert_eq!(output.status.code(), Some(2), "{text}");
    assert_eq!(text, "error: this build has no 'track': build opnav with --features cli,vision\n");
}

#[test]
fn an_unknown_subcommand_is_unknown() {
    let output = Command::cargo_bin("opnav").expect("the binary").arg("fly").output().expect("the command starts");
    let text = String::from_utf8_lossy(&output.stderr).to_string();
    assert!(output.status.code() == Some(2) && text.contains("unrecognized subcommand 'fly'"), "{text}");
}
