//! Rotations of pairs against the true ones.

use super::bench::{Bench, SECOND_NS, assert_near, figure, small_camera, white};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use opnav::dataset::{CameraSensor, StampedPose, write_camera_sensor, write_tum};
use opnav::geometry::so3::exp;
use std::fs;

const PAIR_HEADER: &str =
    "t_ns_from,t_ns_to,qw,qx,qy,qz,sigma_x_rad,sigma_y_rad,sigma_z_rad,matches,inliers,model,status\n";

fn pair_line(from: i64, to: i64, rotation: &UnitQuaternion<f64>, status: &str) -> String {
    let q = rotation;
    format!("{from},{to},{},{},{},{},0.001,0.002,0.003,100,90,essential,{status}\n", q.w, q.i, q.j, q.k)
}

/// A tracking result over turning views; `spoil` changes each true rotation camera(to)_from_camera(from).
fn pairs_bench(count: i64, spoil: impl Fn(i64, UnitQuaternion<f64>) -> UnitQuaternion<f64>) -> Bench {
    let bench = Bench::new("tracking");
    let sensor = CameraSensor {
        camera: small_camera(),
        spacecraft_from_camera: Isometry3::identity(),
        rate_hz: None,
        bits: None,
    };
    write_camera_sensor(&bench.root().join("cam0/sensor.yaml"), &sensor).expect("write");
    let pose = |k: i64| {
        let rotation = exp(&(Vector3::new(0.02, 0.1, -0.05) * k as f64)) * exp(&Vector3::new(0.5 * k as f64, 0.0, 0.1));
        Isometry3::from_parts(Translation3::new(k as f64, 0.0, 1.0), rotation)
    };
    let poses: Vec<StampedPose> =
        (0..=count).map(|k| StampedPose { t_ns: k * SECOND_NS, reference_from_moving: pose(k) }).collect();
    write_tum(&bench.root().join("truth/cam0.tum"), &poses).expect("write");
    let mut text = String::from(PAIR_HEADER);
    for k in 0..count {
        let true_to_from = pose(k + 1).rotation.inverse() * pose(k).rotation;
        text += &pair_line(k * SECOND_NS, (k + 1) * SECOND_NS, &spoil(k, true_to_from), "ok");
    }
    bench.put("relative_rotations.csv", &text);
    bench
}

#[test]
fn perfect_pairs_have_no_error_and_swapped_ones_do() {
    let metrics = pairs_bench(20, |_, q| q).metrics();
    assert_near(&metrics, "pair_rotation_error_max", 0.0, 1e-6);
    assert_near(&metrics, "pair_nees_per_dof", 0.0, 1e-9);
    let metrics = pairs_bench(20, |_, q| q.inverse()).metrics();
    assert!(figure(&metrics, "pair_rotation_error_median") > 10.0);
}

#[test]
fn pair_errors_are_measured_in_the_second_camera() {
    let metrics = pairs_bench(21, |k, q| exp(&Vector3::new(0.0, 0.0, -0.001 * k as f64)) * q).metrics();
    assert_near(&metrics, "pair_rotation_error_median", 0.010f64.to_degrees(), 1e-6);
    assert_near(&metrics, "pair_rotation_error_p95", 0.019f64.to_degrees(), 1e-6);
    assert_near(&metrics, "pair_rotation_error_max", 0.020f64.to_degrees(), 1e-6);
    // Only the third sigma, 0.003, sees an error about z: mean of k² from 0 to 20 is 410/3.
    assert_near(&metrics, "pair_nees_per_dof", 410.0 / 3.0 / 9.0 / 3.0, 1e-5);
    let curve = metrics.series("pair_rotation_error").expect("a curve");
    assert_eq!((curve.t_s[0], curve.values.len()), (1.0, 21));
}

#[test]
fn pairs_with_noise_as_large_as_their_sigma_are_consistent() {
    let sigma = Vector3::new(0.001, 0.002, 0.003);
    let noisy = |k: i64, q| exp(&-white::<3>(k as u64).component_mul(&sigma)) * q;
    let metrics = pairs_bench(200, noisy).metrics();
    let nees = metrics.figures.iter().find(|f| f.name == "pair_nees_per_dof").expect("NEES");
    assert!(nees.bound.expect("bounds").contains(nees.value), "{nees:?}");
    let metrics = pairs_bench(200, |k, q| exp(&(-white::<3>(k as u64).component_mul(&sigma) * 1.3)) * q).metrics();
    let nees = metrics.figures.iter().find(|f| f.name == "pair_nees_per_dof").expect("NEES");
    assert!(!nees.bound.expect("bounds").contains(nees.value), "{nees:?}");
}

#[test]
fn pairs_are_counted_by_status_and_only_good_ones_judged() {
    let bench = pairs_bench(3, |_, q| q);
    let path = bench.result().join("relative_rotations.csv");
    let mut text = fs::read_to_string(&path).expect("written");
    text += "0,2000000000,0,0,0,0,,,,3,0,none,few-matches\n";
    text += &pair_line(0, 3 * SECOND_NS, &exp(&Vector3::new(1.0, 1.0, 1.0)), "rejected");
    text += &pair_line(0, 77, &UnitQuaternion::identity(), "ok");
    fs::write(&path, text).expect("write");
    let metrics = bench.metrics();
    for (name, count) in [("pairs_ok", 4.0), ("pairs_few_matches", 1.0), ("pairs_rejected", 1.0)] {
        assert_near(&metrics, name, count, 0.0);
    }
    assert_near(&metrics, "pair_rotation_error_max", 0.0, 1e-6);
    assert!(metrics.notes.iter().any(|n| n.contains("1 of 4 rotations have no true pose")), "{:?}", metrics.notes);
}
