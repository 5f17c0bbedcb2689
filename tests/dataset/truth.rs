//! Tests of the wing `dataset::truth`.

use super::{close, complaint, folder, pose, put};
use nalgebra::{Vector2, Vector3};
use opnav::dataset::truth::{
    AsteroidInertia, AsteroidState, LanderState, Landmark, LandmarkObservation, read_asteroid, read_lander_states,
    read_landmarks, read_observations, write_asteroid, write_lander_states, write_landmarks, write_observations,
};
use std::fs;

#[test]
fn true_states_return() {
    let dir = folder();
    let state = |k: i64| LanderState {
        t_ns: k,
        site_from_lander: pose(k as f64),
        lander_velocity_in_site_m_s: Vector3::new(1.0, 2.0, 3.0 + k as f64),
        gyro_bias_rad_s: Vector3::new(1e-6, 0.0, -1e-6),
        accelerometer_bias_m_s2: Vector3::new(0.0, 1e-4, 0.0),
    };
    let states: Vec<LanderState> = (0..4).map(state).collect();
    write_lander_states(dir.path(), &states).expect("write");
    for (back, state) in read_lander_states(dir.path()).expect("read").iter().zip(&states) {
        assert!(close(&back.site_from_lander, &state.site_from_lander));
        assert_eq!(LanderState { site_from_lander: state.site_from_lander, ..*back }, *state);
    }
}

#[test]
fn asteroid_truth_returns() {
    let dir = folder();
    let state = |k: i64| AsteroidState {
        t_ns: k * 1_000_000_000,
        asteroid_from_inertial: pose(k as f64).rotation,
        rate_in_asteroid_rad_s: Vector3::new(0.087, 0.04, 0.061),
    };
    let states: Vec<AsteroidState> = (0..3).map(state).collect();
    let inertia = AsteroidInertia { inertia: [[0.85, 0.13, 0.17], [0.13, 1.37, -0.11], [0.17, -0.11, 1.0]] };
    write_asteroid(dir.path(), &states, &inertia).expect("write");
    let (back, back_inertia) = read_asteroid(dir.path()).expect("read");
    assert_eq!(back_inertia, inertia);
    assert_eq!(inertia.matrix()[(0, 2)], 0.17);
    for (a, b) in back.iter().zip(&states) {
        assert_eq!((a.t_ns, a.rate_in_asteroid_rad_s), (b.t_ns, b.rate_in_asteroid_rad_s));
        assert!(a.asteroid_from_inertial.angle_to(&b.asteroid_from_inertial) < 1e-15);
    }
}

#[test]
fn landmark_files_have_the_promised_columns() {
    let dir = folder();
    let landmark = Landmark { id: 4, position_m: Vector3::new(1.0, 2.5, -3.0) };
    let seen = LandmarkObservation { t_ns: 9, camera: 0, id: 4, pixel_px: Vector2::new(10.5, 20.25), visible: true };
    let hidden = LandmarkObservation { visible: false, ..seen };
    write_landmarks(dir.path(), &[landmark]).expect("write");
    write_observations(dir.path(), None, &[seen, hidden]).expect("write");
    assert_eq!(read_landmarks(dir.path()).expect("read"), [landmark]);
    assert_eq!(read_observations(dir.path(), None).expect("read"), [seen, hidden]);
    let text = |name: &str| fs::read_to_string(dir.path().join(name)).expect("written");
    assert_eq!(text("truth/landmarks.csv"), "id,x_m,y_m,z_m\n4,1,2.5,-3\n");
    assert_eq!(
        text("truth/observations.csv"),
        "t_ns,cam,id,u_px,v_px,visible\n9,0,4,10.5,20.25,1\n9,0,4,10.5,20.25,0\n"
    );
}

#[test]
fn bad_truth_is_refused_with_file_and_line() {
    let dir = folder();
    let good = "1,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,0\n";
    let path = put(dir.path(), "truth/state.csv", format!("#t\n{good}{}", good.replace("1,0,0,0,1", "2,0,0,0,0")));
    complaint(read_lander_states(dir.path()), &path, Some(3), &["quaternion's length is 0"]);
    let path = put(dir.path(), "truth/asteroid.csv", "#t\n1,0.5,0,0,0,1,1,1\n");
    complaint(read_asteroid(dir.path()), &path, Some(2), &["quaternion's length is 0.5"]);
    put(dir.path(), "truth/asteroid.csv", "#t\n1,1,0,0,0,1,1,1\n");
    let path = dir.path().join("truth/asteroid.json");
    complaint(read_asteroid(dir.path()), &path, None, &["missing"]);
    put(dir.path(), "truth/asteroid.json", "{\"inertia\": [[1,0,0],[0,1,0]]}");
    complaint(read_asteroid(dir.path()), &path, None, &["length 2", "line 1"]);
    for bad in ["[[1,0.5,0],[0,1,0],[0,0,1]]", "[[1,0,0],[0,-1,0],[0,0,1]]"] {
        put(dir.path(), "truth/asteroid.json", format!("{{\"inertia\": {bad}}}"));
        complaint(read_asteroid(dir.path()), &path, None, &["symmetric positive definite"]);
    }
}
