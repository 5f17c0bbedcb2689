//! Trajectories of the wing `dataset::exchange`.

use super::{close, complaint, folder, pose, put};
use nalgebra::UnitQuaternion;
use opnav::dataset::*;
use std::fs;

#[test]
fn trajectories_return_with_negative_and_long_times() {
    let dir = folder();
    let path = dir.path().join("trajectory.tum");
    let times = [
        i64::MIN,
        -1_500_000_001,
        -1_000_000_000,
        -500_000_000,
        -1,
        0,
        1,
        999_999_999,
        1_403_636_579_763_555_584,
        i64::MAX,
    ];
    let poses: Vec<StampedPose> =
        times.iter().map(|&t_ns| StampedPose { t_ns, reference_from_moving: pose(1.0) }).collect();
    write_tum(&path, &poses).expect("write");
    let back = read_tum(&path).expect("read");
    assert_eq!(back.iter().map(|p| p.t_ns).collect::<Vec<_>>(), times);
    assert!(back.iter().all(|p| close(&p.reference_from_moving, &pose(1.0))));
    assert!(fs::read_to_string(&path).expect("text").contains("\n-0.500000000 "));
}

#[test]
fn trajectories_of_other_tools_are_read() {
    let dir = folder();
    let text = "# timestamp tx ty tz qx qy qz qw\n\n1.5e0 0 0 0 0 0 0 1\n1305031102.1758 1 2 3 0 0 0 2\n";
    let back = read_tum(&put(dir.path(), "a.tum", text)).expect("read");
    assert_eq!((back[0].t_ns, back[1].t_ns), (1_500_000_000, 1_305_031_102_175_800_000));
    assert_eq!(back[1].reference_from_moving.rotation, UnitQuaternion::identity());
}

#[test]
fn bad_trajectories_are_refused_with_file_and_line() {
    let dir = folder();
    let cases = [
        ("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0\n", Some(2), "7 columns found, 8 expected"),
        ("0 0 0 0 0 0 0 0\n", Some(1), "quaternion is zero"),
        ("0 0 nan 0 0 0 0 1\n", Some(1), "not a finite number"),
        ("noon 0 0 0 0 0 0 1\n", Some(1), "'noon' is not a time"),
        ("1e30 0 0 0 0 0 0 1\n", Some(1), "is not a time"),
        ("# t\n1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", Some(3), "does not come after"),
        ("# nothing\n", None, "no poses"),
    ];
    for (number, (text, line, word)) in cases.into_iter().enumerate() {
        let path = put(dir.path(), &format!("{number}.tum"), text);
        complaint(read_tum(&path), &path, line, &[word]);
    }
}
