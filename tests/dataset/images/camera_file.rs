//! The description of a camera, as EuRoC writes it.

use crate::dataset::{complaint, folder, pose, put, sensor};
use nalgebra::{Vector2, Vector3};
use opnav::dataset::*;
use opnav::geometry::Distortion;

#[test]
fn camera_files_return_for_every_lens() {
    let dir = folder();
    let path = dir.path().join("cam0/sensor.yaml");
    let lenses = [
        Distortion::None,
        Distortion::RadialTangential([-0.28, 0.07, 2e-4, 1.7e-5]),
        Distortion::Equidistant([0.003, 0.0007, -0.002, 0.0002]),
    ];
    for lens in lenses {
        write_camera_sensor(&path, &sensor(lens)).expect("write");
        let back = read_camera_sensor(&path).expect("read");
        assert_eq!((back.camera, back.rate_hz), (sensor(lens).camera, Some(20.0)));
        let (a, b) = (back.spacecraft_from_camera, pose(2.0));
        assert!(a.translation == b.translation && a.rotation.angle_to(&b.rotation) < 1e-12);
    }
}

const EUROC_CAMERA: &str = "# General sensor definitions.
sensor_type: camera
comment: VI-Sensor cam0 (MT9M034)

T_BS:
  cols: 4
  rows: 4
  data: [0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216401454975,
         0.999557249008, 0.0149672133247, 0.025715529948, -0.064676986768,
        -0.0257744366974, 0.00375618835797, 0.999660727178, 0.00981073058949,
         0.0, 0.0, 0.0, 1.0]

rate_hz: 20
resolution: [752, 480]
camera_model: pinhole
intrinsics: [458.654, 457.296, 367.215, 248.375] #fu, fv, cu, cv
distortion_model: radial-tangential
distortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]
";

#[test]
fn the_camera_file_of_euroc_is_read() {
    let dir = folder();
    let sensor =
        read_camera_sensor(&put(dir.path(), "sensor.yaml", format!("%YAML:1.0\n{EUROC_CAMERA}"))).expect("read");
    assert_eq!((sensor.camera.width_px, sensor.camera.height_px, sensor.rate_hz), (752, 480, Some(20.0)));
    assert_eq!(sensor.camera.center_px, Vector2::new(367.215, 248.375));
    assert_eq!(sensor.spacecraft_from_camera.translation.y, -0.064676986768);
    let forward = sensor.spacecraft_from_camera.rotation * Vector3::z();
    assert!((forward - Vector3::new(0.00414, 0.0257, 0.99966)).norm() < 1e-4);
}

#[test]
fn bad_camera_files_are_refused_with_the_key() {
    let dir = folder();
    let cases = [
        ("intrinsics: [458.654, 457.296, 367.215, 248.375]", "intrinsics: [458.654, 457.296]", "intrinsics"),
        ("458.654", ".nan", "fu"),
        ("458.654", "-458.654", "fu"),
        ("248.375", ".inf", "cv"),
        ("resolution: [752, 480]", "", "resolution"),
        ("[752, 480]", "[0, 480]", "width"),
        ("radial-tangential", "swirl", "'swirl' is not one of"),
        (", 1.76187114e-05]", "]", "3 numbers"),
        ("0.07395907", ".nan", "distortion_coefficients"),
        ("-0.28340811", "-1.9", "cannot be inverted"),
        ("0.0148655429818", "0.5", "not a rotation"),
        ("-0.064676986768", ".nan", "T_BS"),
        ("0.0, 0.0, 0.0, 1.0]", "0.0]", "13 numbers"),
        ("rate_hz: 20", "rate_hz: 0", "rate_hz"),
        ("resolution: [752, 480]", "resolution: [752, 480", "line"),
    ];
    for (from, to, word) in cases {
        assert!(EUROC_CAMERA.contains(from), "{from}");
        let path = put(dir.path(), "sensor.yaml", EUROC_CAMERA.replace(from, to));
        complaint(read_camera_sensor(&path), &path, None, &[word]);
    }
}
