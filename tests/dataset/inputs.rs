//! What a navigator is given: inertial samples, the designated point, the initial state.

use super::{close, complaint, folder, pose, put};
use nalgebra::{Matrix2, Vector2, Vector3};
use opnav::dataset::*;

#[test]
fn imu_files_return() {
    let dir = folder();
    let sample = |k: i64| ImuSample {
        t_ns: k * 10_000_000,
        rate_in_lander_rad_s: Vector3::new(0.1, 0.2, 1.0 / 7.0) * k as f64,
        specific_force_in_lander_m_s2: Vector3::new(-1.0, 3.711, 1e-9),
    };
    let samples: Vec<ImuSample> = (0..5).map(sample).collect();
    let noise =
        ImuNoise { rate_hz: 100.0, gyroscope_noise_density: 4.8e-7, accelerometer_noise_density: 5e-4, bias: None };
    write_imu(dir.path(), &samples).expect("write");
    write_imu_sensor(dir.path(), &noise).expect("write");
    assert_eq!(read_imu(dir.path()).expect("read"), (noise, samples));
}

#[test]
fn designated_point_and_initial_state_return() {
    let dir = folder();
    let point = DesignatedPoint {
        t_ns: 12,
        pixel_px: Vector2::new(511.25, 400.5),
        covariance_px2: Matrix2::new(0.25, 0.01, 0.01, 0.3),
    };
    write_designated(dir.path(), &point).expect("write");
    assert_eq!(read_designated(dir.path()).expect("read"), point);
    let state = InitialState {
        t_ns: -3,
        site_from_lander: pose(3300.0),
        lander_velocity_in_site_m_s: Vector3::new(-56.0, -66.0, -90.0),
        sigma_position_m: 577.0,
        sigma_velocity_m_s: 5.77,
        sigma_attitude_rad: 0.02,
    };
    write_initial_state(dir.path(), &state).expect("write");
    let back = read_initial_state(dir.path()).expect("read");
    assert!(close(&back.site_from_lander, &state.site_from_lander));
    assert_eq!(InitialState { site_from_lander: state.site_from_lander, ..back }, state);
}

#[test]
fn bad_points_states_and_imus_are_refused() {
    let dir = folder();
    let path = put(dir.path(), "designated.csv", "0,1,1,1,2,1\n");
    complaint(read_designated(dir.path()), &path, None, &["not positive definite"]);
    let path = put(dir.path(), "initial_state.csv", "#t\n0,0,0,0,1,0,0,0,0,0,0,1,0,1\n");
    complaint(read_initial_state(dir.path()), &path, None, &["sigma"]);
    let path = put(dir.path(), "initial_state.csv", "#t\n0,0,0,0,0,0,0,0,0,0,0,1,1,1\n");
    complaint(read_initial_state(dir.path()), &path, Some(2), &["quaternion"]);
    put(dir.path(), "imu0/data.csv", "0,0,0,0,0,0,0\n");
    let path = dir.path().join("imu0/sensor.yaml");
    complaint(read_imu(dir.path()), &path, None, &["missing"]);
    put(dir.path(), "imu0/sensor.yaml", "rate_hz: 200\ngyroscope_noise_density: -1\naccelerometer_noise_density: 1\n");
    complaint(read_imu(dir.path()), &path, None, &["positive"]);
    put(dir.path(), "imu0/sensor.yaml", "rate_hz: 200\n");
    complaint(read_imu(dir.path()), &path, None, &["gyroscope_noise_density"]);
    let path = put(dir.path(), "manifest.json", "{");
    complaint(read_manifest(dir.path()), &path, None, &["line 1"]);
}
