//! Torque-free motion and the tumbling scene.

use crate::reference_body::{STATES, acceleration_rad_s2, from_scalar_last, rate_rad_s, tensor};
use crate::scene::{scenario, tumbling};
use nalgebra::{Matrix3, Point3, Quaternion, UnitQuaternion, Vector3};
use opnav::geometry::so3;
use opnav::scene::{RigidBody, Spin};

fn paper_start() -> Spin {
    Spin { asteroid_from_inertial: UnitQuaternion::identity(), rate_in_asteroid_rad_s: rate_rad_s() }
}

#[test]
fn conversion_agrees_with_the_papers_matrix() {
    let q = STATES[0].scalar_last;
    let v = Vector3::new(q[0], q[1], q[2]);
    let matrix =
        Matrix3::identity() * (2.0 * q[3] * q[3] - 1.0) + v * v.transpose() * 2.0 - so3::hat(&v) * (2.0 * q[3]);
    let found = from_scalar_last(q).to_rotation_matrix();
    assert!((found.matrix() - matrix).abs().max() < 1e-11);
}

#[test]
fn rate_derivative_is_the_papers() {
    let body = RigidBody::new(&tensor()).unwrap();
    let found = body.rate_derivative(&paper_start().rate_in_asteroid_rad_s);
    assert!((found - acceleration_rad_s2()).abs().max() < 1e-12, "{found}");
}

#[test]
fn paper_case_reaches_the_known_states() {
    let body = RigidBody::new(&tensor()).unwrap();
    for known in STATES {
        let t_s = known.t_s;
        let spin = body.propagate(&paper_start(), t_s);
        let turn_rad = spin.asteroid_from_inertial.angle_to(&known.asteroid_from_inertial());
        assert!(turn_rad < 1e-10, "t = {t_s}: {turn_rad}");
        let off_deg_s = (spin.rate_in_asteroid_rad_s - known.rate_in_asteroid_rad_s()).map(f64::to_degrees);
        assert!(off_deg_s.abs().max() < 1e-9, "t = {t_s}: {off_deg_s}");
    }
}

#[test]
fn energy_and_momentum_stay_for_ten_minutes() {
    let body = RigidBody::new(&tensor()).unwrap();
    let start = paper_start();
    let (energy, momentum) = (body.doubled_energy(&start), body.momentum_in_inertial(&start));
    let mut spin = start;
    for _ in 0..10 {
        spin = body.propagate(&spin, 60.0);
        assert!((body.doubled_energy(&spin) / energy - 1.0).abs() < 1e-10);
        assert!((body.momentum_in_inertial(&spin) - momentum).norm() < 1e-10 * momentum.norm());
    }
    let back = body.propagate(&spin, -600.0);
    assert!(back.asteroid_from_inertial.angle_to(&start.asteroid_from_inertial) < 1e-9);
}

#[test]
fn attitude_turns_with_the_rate_in_asteroid_axes() {
    let body = RigidBody::new(&Matrix3::identity()).unwrap();
    let spin = body.propagate(&paper_start(), 10.0);
    let turned = so3::exp(&(paper_start().rate_in_asteroid_rad_s * -10.0));
    assert!(spin.asteroid_from_inertial.angle_to(&turned) < 1e-12);
}

#[test]
fn impossible_inertia_is_refused() {
    let refused = |m: Matrix3<f64>| RigidBody::new(&m).unwrap_err().to_string();
    assert!(refused(Matrix3::new(1.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)).contains("symmetric"));
    assert!(refused(Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, 1.0))).contains("positive definite"));
    assert!(refused(Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 2.1))).contains("add up"));
    assert!(refused(Matrix3::from_diagonal(&Vector3::new(f64::NAN, 1.0, 1.0))).contains("finite"));
    RigidBody::new(&Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 2.0))).unwrap(); // a thin plate
}

const SMALL: &str = "[camera]\nwidth_px = 256\nheight_px = 192\n[tumbling]\nframes = 8\n\
[tumbling.shape.procedural]\nsubdivisions = 4\n";

#[test]
fn scene_is_the_papers_case_by_default() {
    let scene = tumbling(SMALL);
    assert_eq!(scene.inertia.matrix(), tensor());
    let body = RigidBody::new(&tensor()).unwrap();
    assert_eq!(scene.states[0].asteroid_from_inertial, UnitQuaternion::identity());
    let expected = body.propagate(&paper_start(), 7.0);
    let last = scene.states.last().unwrap();
    assert_eq!(last.t_ns, 7_000_000_000);
    assert!(last.asteroid_from_inertial.angle_to(&expected.asteroid_from_inertial) < 1e-11);
    assert!((last.rate_in_asteroid_rad_s - expected.rate_in_asteroid_rad_s).norm() < 1e-12);
}

#[test]
fn body_fills_its_share_of_the_image_and_stays_in_place() {
    let scene = tumbling(&SMALL.replace("frames = 8", "frames = 8\nfill_fraction = 0.8\ncenter_offset_px = [10, -6]"));
    let camera = scene.cameras[0].sensor.camera;
    let (mut widest_px, radius_m) = (0.0_f64, scene.body.mesh.radius_m());
    for view in &scene.cameras[0].views {
        let center = view.reference_from_camera.inverse_transform_point(&Point3::origin()).coords;
        assert!((center - scene.center_in_spacecraft_m).norm() < 1e-9);
        let pixel = camera.project(&center).unwrap();
        assert!((pixel - camera.center_px - nalgebra::Vector2::new(10.0, -6.0)).norm() < 1e-9);
        for vertex in &scene.body.mesh.vertices_m {
            let in_camera = view.reference_from_camera.inverse_transform_point(&Point3::from(*vertex)).coords;
            widest_px = widest_px.max((camera.project(&in_camera).unwrap() - pixel).norm());
        }
    }
    assert!(widest_px < 0.5 * 0.8 * 192.0 * 1.01 && widest_px > 0.6 * 0.5 * 0.8 * 192.0, "{widest_px}");
    let silhouette = (radius_m / scene.center_in_spacecraft_m.norm()).asin().tan();
    assert!((silhouette * camera.focal_px.y - 0.5 * 0.8 * 192.0).abs() < 1e-9);
}

#[test]
fn sun_stands_still_for_the_camera_at_its_phase_angle() {
    let scene = tumbling(SMALL);
    for view in &scene.cameras[0].views {
        let sun = view.reference_from_camera.rotation.inverse() * view.sun_in_reference;
        let to_camera = -scene.center_in_spacecraft_m.normalize();
        assert!((sun.dot(&to_camera).acos().to_degrees() - 35.0).abs() < 1e-9);
        assert!(sun.x < 0.0 && sun.y < 0.0, "the light comes from the upper left: {sun:?}");
    }
}

#[test]
fn body_is_centred_and_real_shapes_turn_with_their_own_inertia() {
    let scene = tumbling(
        "[tumbling]\nframes = 3\ninertia = \"from-shape\"\nrate_deg_s = [1.2, -0.8, 3.0]\n\
         [tumbling.shape.mesh]\npath = \"shapes/itokawa.obj\"\nmetres_per_unit = 1000\n",
    );
    let found = scene.body.mesh.mass_properties().unwrap();
    assert!(found.center_m.norm() < 1e-9, "{}", found.center_m);
    let declared = scene.inertia.matrix();
    assert!((declared[(2, 2)] - 1.0).abs() < 1e-15);
    let own = found.inertia_m5 / found.inertia_m5[(2, 2)];
    assert!((declared - own).abs().max() < 1e-12);
    let body = RigidBody::new(&own).unwrap();
    let start = Spin {
        asteroid_from_inertial: UnitQuaternion::identity(),
        rate_in_asteroid_rad_s: Vector3::new(1.2, -0.8, 3.0).map(f64::to_radians),
    };
    let expected = body.propagate(&start, 2.0);
    assert!((scene.states[2].rate_in_asteroid_rad_s - expected.rate_in_asteroid_rad_s).norm() < 1e-12);
    assert!((250.0..350.0).contains(&scene.body.mesh.radius_m()), "{}", scene.body.mesh.radius_m());
}

#[test]
fn initial_attitude_is_taken_over() {
    let scene = tumbling(&SMALL.replace("frames = 8", "frames = 8\nasteroid_from_inertial = [0.5, 0.5, -0.5, 0.5]"));
    let expected = UnitQuaternion::from_quaternion(Quaternion::new(0.5, 0.5, -0.5, 0.5));
    assert_eq!(scene.states[0].asteroid_from_inertial, expected);
    let error = scenario("[tumbling]\nasteroid_from_inertial = [0, 0, 0, 0]").unwrap_err().to_string();
    assert!(error.contains("tumbling.asteroid_from_inertial") && error.contains("norm"), "{error}");
}
