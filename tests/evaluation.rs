//! Tests of the room `evaluation`.

mod picture;

use image::{ImageBuffer, Luma};
use nalgebra::{Isometry3, Matrix3, SMatrix, SVector, Translation3, UnitQuaternion, Vector2, Vector3};
use opnav::dataset::truth::{AsteroidInertia, AsteroidState, LanderState, write_asteroid, write_lander_states};
use opnav::dataset::{CameraSensor, StampedPose, write_camera_sensor, write_depth_tiff, write_tum};
use opnav::evaluation::*;
use opnav::geometry::so3::exp;
use opnav::geometry::{Camera, Distortion};
use opnav::stats::{ConsistencyBounds, random_stream};
use rand_distr::{Distribution, StandardNormal};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

const SECOND_NS: i64 = 1_000_000_000;

/// A data set and a result side by side.
struct Bench {
    dir: tempfile::TempDir,
}

impl Bench {
    fn new(mission: &str) -> Self {
        let bench = Bench { dir: tempfile::tempdir().expect("a temporary folder") };
        fs::create_dir_all(bench.root().join("truth")).expect("a folder");
        bench.put("summary.json", &format!("{{\"mission\": \"{mission}\", \"opnav_version\": \"0.1.0\"}}"));
        bench
    }
    fn root(&self) -> PathBuf {
        self.dir.path().join("data set")
    }
    fn result(&self) -> PathBuf {
        self.dir.path().join("result")
    }
    fn put(&self, name: &str, text: &str) -> PathBuf {
        fs::create_dir_all(self.result()).expect("a folder");
        fs::write(self.result().join(name), text).expect("a file");
        self.result().join(name)
    }
    fn evaluate(&self) -> Result<Metrics, EvaluationError> {
        evaluate(&self.result(), &self.root())
    }
    fn metrics(&self) -> Metrics {
        self.evaluate().unwrap_or_else(|error| panic!("{error}"))
    }
}

fn figure(metrics: &Metrics, name: &str) -> f64 {
    metrics.figure(name).unwrap_or_else(|| panic!("no {name} among {:?}, notes {:?}", metrics.figures, metrics.notes))
}

fn assert_near(metrics: &Metrics, name: &str, expected: f64, tolerance: f64) {
    let value = figure(metrics, name);
    assert!((value - expected).abs() <= tolerance, "{name} is {value}, {expected} expected");
}

// ---------------------------------------------------------------------------------------------------- landing

/// A smooth descent that ends in the site's origin after 100 s.
fn descent(t_ns: i64) -> LanderState {
    let left = 100.0 - t_ns as f64 * 1e-9;
    let position = Vector3::new(0.10, -0.05, 0.30) * left.powi(2);
    LanderState {
        t_ns,
        site_from_lander: Isometry3::from_parts(
            Translation3::from(position),
            exp(&(Vector3::new(0.05, -0.1, 0.2) * (left / 100.0))),
        ),
        lander_velocity_in_site_m_s: Vector3::new(0.10, -0.05, 0.30) * (-2.0 * left),
        gyro_bias_rad_s: Vector3::zeros(),
        accelerometer_bias_m_s2: Vector3::zeros(),
    }
}

/// The lander's camera looks straight down.
fn lander_from_camera() -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::identity(), exp(&Vector3::new(std::f64::consts::PI, 0.0, 0.0)))
}

fn small_camera() -> Camera {
    Camera { distortion: Distortion::RadialTangential([-0.05, 0.01, 1e-4, -1e-4]), ..Camera::from_fov(64, 48, 1.2) }
}

/// A descent over flat ground, truth sampled ten times a second, a picture every 20 s.
fn landing_bench() -> Bench {
    let bench = Bench::new("landing");
    let states: Vec<LanderState> = (0..=1000).map(|k| descent(k * SECOND_NS / 10)).collect();
    write_lander_states(&bench.root(), &states).expect("write");
    let sensor = CameraSensor {
        camera: small_camera(),
        spacecraft_from_camera: lander_from_camera(),
        rate_hz: None,
        bits: None,
    };
    write_camera_sensor(&bench.root().join("cam0/sensor.yaml"), &sensor).expect("write");
    let poses: Vec<StampedPose> =
        picture_times().map(|t_ns| StampedPose { t_ns, reference_from_moving: true_camera(t_ns) }).collect();
    write_tum(&bench.root().join("truth/cam0.tum"), &poses).expect("write");
    for t_ns in picture_times() {
        write_flat_depth(&bench.root(), t_ns);
    }
    bench
}

fn picture_times() -> impl Iterator<Item = i64> {
    (0..5).map(|k| k * 20 * SECOND_NS)
}

fn true_camera(t_ns: i64) -> Isometry3<f64> {
    descent(t_ns).site_from_lander * lander_from_camera()
}

/// The point of the plane z = 0 that a pixel sees, and its z-depth.
fn ground_under(t_ns: i64, pixel: &Vector2<f64>) -> (Vector3<f64>, f64) {
    let site_from_camera = true_camera(t_ns);
    let ideal = small_camera().normalize(pixel).expect("inside the picture");
    let ray = site_from_camera.rotation * Vector3::new(ideal.x, ideal.y, 1.0);
    let depth = -site_from_camera.translation.z / ray.z;
    (site_from_camera.translation.vector + ray * depth, depth)
}

fn write_flat_depth(root: &Path, t_ns: i64) {
    let depth = ImageBuffer::<Luma<f32>, Vec<f32>>::from_fn(64, 48, |u, v| {
        Luma([ground_under(t_ns, &Vector2::new(f64::from(u), f64::from(v))).1 as f32])
    });
    write_depth_tiff(&root.join(format!("truth/depth/cam0/{t_ns}.tiff")), 64, 48, depth.as_raw()).expect("write");
}

#[derive(Clone)]
struct LandingRow {
    t_ns: i64,
    pose: Isometry3<f64>,
    velocity: Vector3<f64>,
}

fn perfect_landing() -> Vec<LandingRow> {
    let row = |k: i64| {
        let truth = descent(k * SECOND_NS);
        LandingRow { t_ns: truth.t_ns, pose: truth.site_from_lander, velocity: truth.lander_velocity_in_site_m_s }
    };
    (0..=100).map(row).collect()
}

/// Columns in another order than the documents', which must not matter.
fn landing_csv(rows: &[LandingRow]) -> String {
    let mut text = String::from(
        "t_ns,qw,qx,qy,qz,x_m,y_m,z_m,sigma_x_m,sigma_y_m,sigma_z_m,sigma_yaw_rad,sigma_pitch_rad,sigma_roll_rad,\
         sigma_vx_m_s,sigma_vy_m_s,sigma_vz_m_s,vx_m_s,vy_m_s,vz_m_s\n",
    );
    for row in rows {
        let (p, q, v) = (row.pose.translation, row.pose.rotation, row.velocity);
        writeln!(
            text,
            "{},{},{},{},{},{},{},{},1,2,3,0.03,0.02,0.01,4,5,6,{},{},{}",
            row.t_ns, q.w, q.i, q.j, q.k, p.x, p.y, p.z, v.x, v.y, v.z
        )
        .expect("text");
    }
    text
}

fn covariance_csv<const N: usize>(rows: impl Iterator<Item = (i64, SMatrix<f64, N, N>)>) -> String {
    let mut text = String::from("t_ns,upper triangle row by row\n");
    for (t_ns, covariance) in rows {
        write!(text, "{t_ns}").expect("text");
        for i in 0..N {
            for j in i..N {
                write!(text, ",{}", covariance[(i, j)]).expect("text");
            }
        }
        text.push('\n');
    }
    text
}

/// A root of a covariance with strong correlations and units of very different size.
fn covariance_root<const N: usize>(scale: impl Fn(usize) -> f64) -> SMatrix<f64, N, N> {
    SMatrix::from_fn(|i, j| {
        let mixing = ((3 * i + 5 * j + i * j) as f64).sin() * 0.6;
        scale(i)
            * if i == j {
                1.0
            } else if j < i {
                mixing
            } else {
                0.0
            }
    })
}

fn white<const N: usize>(index: u64) -> SVector<f64, N> {
    let mut random = random_stream(11, "white errors", index);
    SVector::from_fn(|_, _| StandardNormal.sample(&mut random))
}

#[test]
fn a_perfect_landing_has_no_error() {
    let bench = landing_bench();
    bench.put("estimate.csv", &landing_csv(&perfect_landing()));
    let metrics = bench.metrics();
    assert_eq!((metrics.mission, figure(&metrics, "epochs")), (Mission::Landing, 101.0));
    for name in
        ["final_horizontal_error", "final_z_error", "final_speed_error", "ate_position_rms", "rpe_10s_position_rms"]
    {
        assert_near(&metrics, name, 0.0, 1e-9);
    }
    for name in ["final_roll_error", "final_pitch_error", "final_yaw_error", "rpe_10s_attitude_rms"] {
        assert_near(&metrics, name, 0.0, 1e-6);
    }
    assert!(metrics.verdict("converged").expect("a verdict").holds);
    let x = metrics.series("position_error_x").expect("a curve");
    assert_eq!((x.t_s.len(), x.sigma[0], x.unit.as_str()), (101, 1.0, "m"));
    assert_eq!(metrics.series("roll_error").expect("a curve").sigma[0], 0.01f64.to_degrees());
    assert_eq!(metrics.series("velocity_error_z").expect("a curve").sigma[0], 6.0);
}

#[test]
fn a_known_offset_is_found_exactly() {
    let bench = landing_bench();
    let mut rows = perfect_landing();
    for row in &mut rows {
        row.pose.translation.vector -= Vector3::new(3.0, 4.0, -2.0);
        row.velocity -= Vector3::new(0.1, 0.2, -0.2);
        let (roll, pitch, yaw) = row.pose.rotation.euler_angles();
        row.pose.rotation = UnitQuaternion::from_euler_angles(roll - 0.001, pitch + 0.002, yaw - 3.0);
    }
    bench.put("estimate.csv", &landing_csv(&rows));
    let metrics = bench.metrics();
    assert_near(&metrics, "final_horizontal_error", 5.0, 1e-9);
    assert_near(&metrics, "final_z_error", -2.0, 1e-9);
    assert_near(&metrics, "final_speed_error", 0.3, 1e-9);
    assert_near(&metrics, "final_roll_error", 0.001f64.to_degrees(), 1e-9);
    assert_near(&metrics, "final_pitch_error", -0.002f64.to_degrees(), 1e-9);
    assert_near(&metrics, "final_yaw_error", 3f64.to_degrees(), 1e-9);
    assert_near(&metrics, "ate_position_rms", 29f64.sqrt(), 1e-9);
    assert!(metrics.series("position_error_y").expect("a curve").values.iter().all(|v| (v - 4.0).abs() < 1e-9));
    let verdict = metrics.verdict("converged").expect("a verdict");
    assert!(!verdict.holds);
    assert!(verdict.reason.contains("horizontal error 5.000 m") && verdict.reason.contains("pitch"), "{verdict:?}");
    assert!(!verdict.reason.contains("roll error") && !verdict.reason.contains("z error"), "{verdict:?}");
}

#[test]
fn relative_errors_see_drift_and_not_offset() {
    let bench = landing_bench();
    let mut rows = perfect_landing();
    for (k, row) in rows.iter_mut().enumerate() {
        row.pose.translation.vector += Vector3::new(100.0 + 0.5 * k as f64, 0.0, 0.0);
    }
    bench.put("estimate.csv", &landing_csv(&rows));
    assert_near(&bench.metrics(), "rpe_10s_position_rms", 5.0, 1e-9);
}

#[test]
fn a_swapped_frame_is_noticed() {
    let bench = landing_bench();
    let mut rows = perfect_landing();
    for row in &mut rows {
        row.pose.rotation = row.pose.rotation.inverse();
    }
    bench.put("estimate.csv", &landing_csv(&rows));
    let roll = &bench.metrics().series("roll_error").expect("a curve").values.clone();
    assert!(roll[0].abs() > 3.0, "an attitude given the wrong way round must show: {}", roll[0]);
}

#[test]
fn epochs_between_the_truth_samples_are_interpolated() {
    let bench = landing_bench();
    let rows: Vec<LandingRow> = (0..50)
        .map(|k| {
            let truth = descent(k * SECOND_NS + 51_234_567);
            LandingRow { t_ns: truth.t_ns, pose: truth.site_from_lander, velocity: truth.lander_velocity_in_site_m_s }
        })
        .collect();
    bench.put("estimate.csv", &landing_csv(&rows));
    let metrics = bench.metrics();
    assert_near(&metrics, "ate_position_rms", 0.0, 1e-9);
    assert_near(&metrics, "final_speed_error", 0.0, 1e-9);
    assert_near(&metrics, "final_roll_error", 0.0, 1e-4);
}

/// Errors drawn from the covariance that is handed in, every epoch independent; `scale` spoils the covariance.
fn landing_with_noise(scale: f64) -> Bench {
    let bench = landing_bench();
    let root = covariance_root::<9>(|i| [2.0, 1.0, 4.0, 0.1, 0.2, 0.05, 1e-3, 2e-3, 3e-2][i]);
    let mut rows = perfect_landing();
    for (k, row) in rows.iter_mut().enumerate() {
        let error = root * white::<9>(k as u64);
        row.pose.translation.vector -= error.fixed_rows::<3>(0);
        row.velocity -= error.fixed_rows::<3>(3);
        row.pose.rotation = exp(&-Vector3::from(error.fixed_rows::<3>(6))) * row.pose.rotation;
    }
    bench.put("estimate.csv", &landing_csv(&rows));
    let covariance = root * root.transpose() * scale;
    bench.put("covariance.csv", &covariance_csv(rows.iter().map(|row| (row.t_ns, covariance))));
    bench
}

#[test]
fn errors_drawn_from_the_covariance_are_called_consistent() {
    let metrics = landing_with_noise(1.0).metrics();
    let nees = metrics.figures.iter().find(|f| f.name == "nees_per_dof_mean").expect("NEES");
    let bound = nees.bound.expect("bounds");
    assert!(bound.contains(nees.value), "{nees:?}");
    assert!((nees.value - 1.0).abs() < 0.15, "{nees:?}");
    assert!(figure(&metrics, "nees_effective_samples") > 70.0, "independent epochs count in full");
    assert!(figure(&metrics, "nees_share_within_95") > 0.88);
    assert!(metrics.verdict("consistent").expect("a verdict").holds);
    let curve = metrics.series("nees_per_dof").expect("a curve");
    assert_eq!(curve.bound, Some(ConsistencyBounds::of_mean(9, 1, 0.95)));
    assert_eq!(curve.values.len(), 101);
}

#[test]
fn the_sigma_of_roll_pitch_and_yaw_follow_from_the_covariance_in_site_axes() {
    let bench = landing_bench();
    let mut rows = perfect_landing();
    let turned = UnitQuaternion::from_euler_angles(0.3, 0.0, std::f64::consts::FRAC_PI_2);
    rows[7].pose.rotation = turned;
    bench.put("estimate.csv", &landing_csv(&rows));
    let sigma = SVector::<f64, 9>::from_iterator([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 0.01, 0.02, 0.03]);
    let covariance = SMatrix::<f64, 9, 9>::from_diagonal(&sigma.component_mul(&sigma));
    bench.put("covariance.csv", &covariance_csv(rows.iter().map(|row| (row.t_ns, covariance))));
    let metrics = bench.metrics();
    // A lander that heads along the site's y rolls about y and pitches about -x.
    for (name, expected) in [("roll_error", 0.02f64), ("pitch_error", 0.01), ("yaw_error", 0.03)] {
        let found = metrics.series(name).expect("a curve").sigma[7];
        assert!((found - expected.to_degrees()).abs() < 1e-9, "{name}: {found}");
    }
    for (name, expected) in [("position_error_z", 3.0), ("velocity_error_x", 4.0), ("velocity_error_z", 6.0)] {
        assert_eq!(metrics.series(name).expect("a curve").sigma[7], expected, "{name}");
    }
}

#[test]
fn a_wrong_covariance_is_noticed_on_either_side() {
    for (scale, word) in [(0.5, "overconfident"), (2.0, "pessimistic")] {
        let verdict = landing_with_noise(scale).metrics().verdict("consistent").expect("a verdict").clone();
        assert!(!verdict.holds && verdict.reason.contains(word), "{scale}: {verdict:?}");
    }
}

#[test]
fn errors_that_persist_count_as_few_samples() {
    let one = white::<3>(0);
    let sample = |t: usize, whitened| NormalizedSample { t_s: t as f64, whitened };
    let constant: Vec<_> = (0..300).map(|t| sample(t, one)).collect();
    assert!(effective_samples(&constant) < 2.0);
    let independent: Vec<_> = (0..300).map(|t| sample(t, white::<3>(t as u64))).collect();
    assert!(effective_samples(&independent) > 250.0);
    // An autoregression of coefficient a has ρ_k = a^k, hence n (1 - a²)/(1 + a²) samples.
    let a: f64 = 0.9;
    let mut state = white::<3>(0);
    let walk: Vec<_> = (0..20_000)
        .map(|t| {
            state = state * a + white::<3>(t as u64 + 1) * (1.0 - a * a).sqrt();
            sample(t, state)
        })
        .collect();
    // Of 20 000 samples every tenth is kept, whose autoregression has the coefficient a^10.
    let squared = a.powi(20);
    let expected = 2000.0 * (1.0 - squared) / (1.0 + squared);
    let found = effective_samples(&walk);
    assert!((found / expected - 1.0).abs() < 0.1, "{found} for {expected}");
}

#[test]
fn a_covariance_that_is_not_positive_definite_is_reported() {
    let bench = landing_bench();
    let rows = perfect_landing();
    bench.put("estimate.csv", &landing_csv(&rows));
    bench.put("covariance.csv", &covariance_csv(rows.iter().map(|row| (row.t_ns, SMatrix::<f64, 9, 9>::zeros()))));
    let metrics = bench.metrics();
    assert_eq!(metrics.figure("nees_per_dof_mean"), None);
    assert!(metrics.notes.iter().any(|n| n.contains("positive definite")), "{:?}", metrics.notes);
}

/// Track 0 with the given pixel in the last picture, 80 s.
fn tracks_csv(last: &Vector2<f64>) -> String {
    let mut text = String::from("t_ns,track_id,u_px,v_px,sigma_px,response\n");
    for t_ns in picture_times() {
        let camera_from_site = true_camera(t_ns).inverse();
        let origin = camera_from_site.translation.vector;
        let pixel = small_camera().project(&origin).expect("ahead of the camera");
        let pixel = if t_ns == 80 * SECOND_NS { *last } else { pixel };
        writeln!(text, "{t_ns},0,{},{},0.1,0", pixel.x, pixel.y).expect("text");
    }
    text
}

#[test]
fn errors_are_told_from_the_ground_point_really_tracked() {
    let bench = landing_bench();
    let pixel = Vector2::new(40.3, 17.8);
    let (tracked, _) = ground_under(80 * SECOND_NS, &pixel);
    assert!(tracked.xy().norm() > 5.0, "the track must have slipped for this test: {tracked}");
    bench.put("tracks.csv", &tracks_csv(&pixel));
    // A perfect navigator that takes the tracked point for the origin.
    let mut rows = perfect_landing();
    for row in &mut rows {
        row.pose.translation.vector -= tracked;
    }
    bench.put("estimate.csv", &landing_csv(&rows));
    let metrics = bench.metrics();
    // Depth is stored in single precision and read between pixels: a few centimetres on this lens.
    assert_near(&metrics, "tracked_point_from_site_origin", tracked.norm(), 0.05);
    assert_near(&metrics, "tracked_point_drift", tracked.norm(), 0.5);
    assert_near(&metrics, "final_horizontal_error", tracked.xy().norm(), 1e-9);
    assert_near(&metrics, "final_from_tracked_point_horizontal_error", 0.0, 0.05);
    assert_near(&metrics, "last_picture_from_tracked_point_z_error", 0.0, 0.05);
    assert_near(&metrics, "last_picture_time", 80.0, 1e-9);
    assert!(!metrics.verdict("converged").expect("a verdict").holds);
    assert!(metrics.verdict("converged_from_tracked_point").expect("a verdict").holds);
}

#[test]
fn without_tracks_the_verdict_says_so() {
    let bench = landing_bench();
    bench.put("estimate.csv", &landing_csv(&perfect_landing()));
    let metrics = bench.metrics();
    assert!(metrics.verdict("converged_from_tracked_point").is_none());
    assert!(metrics.notes.iter().any(|n| n.contains("site's origin only")), "{:?}", metrics.notes);
}

// ---------------------------------------------------------------------------------------------------- tumbling

/// The reference case: inertia in the axes of the camera at the start.
fn inertia() -> Matrix3<f64> {
    Matrix3::new(0.85, 0.13, 0.17, 0.13, 1.37, -0.11, 0.17, -0.11, 1.0)
}

/// Torque-free motion from the reference case, one sample every `step_s`, by fourth-order Runge-Kutta.
fn tumble(count: usize, step_s: f64) -> Vec<AsteroidState> {
    let inverse = inertia().try_inverse().expect("invertible");
    let rate_slope = |w: &Vector3<f64>| -inverse * w.cross(&(inertia() * w));
    // As matrices and quaternions: A' = exp(-w dt) A.
    let substeps = 200;
    let dt = step_s / f64::from(substeps);
    let mut w = Vector3::new(5.0, 2.3, 3.5).map(f64::to_radians);
    let mut attitude = UnitQuaternion::identity();
    let mut states = vec![];
    for k in 0..count {
        let t_ns = (k as f64 * step_s * 1e9).round() as i64;
        states.push(AsteroidState { t_ns, asteroid_from_inertial: attitude, rate_in_asteroid_rad_s: w });
        for _ in 0..substeps {
            let k1 = rate_slope(&w);
            let k2 = rate_slope(&(w + k1 * (0.5 * dt)));
            let k3 = rate_slope(&(w + k2 * (0.5 * dt)));
            let k4 = rate_slope(&(w + k3 * dt));
            let middle = w + (k1 * 5.0 + k2 * 8.0 - rate_slope(&(w + k3 * dt))) * (dt / 24.0);
            let mean = (w + (middle * 4.0) + (w + (k1 + (k2 + k3) * 2.0 + k4) * (dt / 6.0))) / 6.0;
            attitude = exp(&(-mean * dt)) * attitude;
            w += (k1 + (k2 + k3) * 2.0 + k4) * (dt / 6.0);
        }
    }
    states
}

#[test]
fn the_simulated_truth_agrees_with_the_reference() {
    let state = tumble(61, 1.0)[60];
    let w = Vector3::new(0.519253989963, 2.152258543697, -6.26030457059).map(f64::to_radians);
    assert!((state.rate_in_asteroid_rad_s - w).norm() < 1e-9);
    // The reference quaternion is scalar last and passive: asteroid_from_inertial is its conjugate in our notation.
    let q = nalgebra::Quaternion::new(0.590453671554, -0.649734687738, 0.32839425578, 0.348376965468);
    assert!(state.asteroid_from_inertial.angle_to(&UnitQuaternion::from_quaternion(q)) < 1e-6);
}

#[test]
fn tumbling_truth_is_interpolated_with_its_rates() {
    let coarse = tumble(21, 2.0);
    let fine = tumble(400, 0.1);
    for state in &fine {
        let found = asteroid_state_at(&coarse, state.t_ns).expect("inside");
        assert!(found.asteroid_from_inertial.angle_to(&state.asteroid_from_inertial) < 2e-5);
        assert!((found.rate_in_asteroid_rad_s - state.rate_in_asteroid_rad_s).norm() < 5e-5);
    }
    assert!(asteroid_state_at(&coarse, -1).is_none() && asteroid_state_at(&coarse, 41 * SECOND_NS).is_none());
}

/// Truth in asteroid axes turned by `gauge` from the camera's at the start.
fn tumbling_bench(gauge: &UnitQuaternion<f64>) -> Bench {
    let bench = Bench::new("tumbling");
    let turn = gauge.to_rotation_matrix();
    let states: Vec<AsteroidState> = tumble(61, 1.0)
        .iter()
        .map(|s| AsteroidState {
            t_ns: s.t_ns,
            asteroid_from_inertial: gauge * s.asteroid_from_inertial,
            rate_in_asteroid_rad_s: gauge * s.rate_in_asteroid_rad_s,
        })
        .collect();
    let tensor = turn.matrix() * inertia() * turn.matrix().transpose() * 7.0;
    let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| 0.5 * (tensor[(i, j)] + tensor[(j, i)])));
    write_asteroid(&bench.root(), &states, &AsteroidInertia { inertia: rows }).expect("write");
    bench
}

fn tumbling_csv(rows: &[AsteroidState], ratios: &str) -> String {
    let mut text = String::from("t_ns,qw,qx,qy,qz,wx_rad_s,wy_rad_s,wz_rad_s,Lxx,Lyy,Lxy,Lxz,Lyz,sigma_Lxx\n");
    for row in rows {
        let (q, w) = (row.asteroid_from_inertial, row.rate_in_asteroid_rad_s);
        writeln!(text, "{},{},{},{},{},{},{},{},{ratios},0.01", row.t_ns, q.w, q.i, q.j, q.k, w.x, w.y, w.z)
            .expect("text");
    }
    text
}

const TRUE_RATIOS: &str = "0.85,1.37,0.13,0.17,-0.11";
const INERTIA_ERRORS: [&str; 5] = ["Lxx_error", "Lyy_error", "Lxy_error", "Lxz_error", "Lyz_error"];

#[test]
fn a_perfect_tumbling_result_has_no_error_in_whatever_axes_the_truth_is() {
    for gauge in [Vector3::zeros(), Vector3::new(0.3, -1.2, 2.0), Vector3::new(3.0, 0.1, 0.0)] {
        let bench = tumbling_bench(&exp(&gauge));
        bench.put("estimate.csv", &tumbling_csv(&tumble(61, 1.0), TRUE_RATIOS));
        let metrics = bench.metrics();
        for name in ["final_attitude_error", "final_rate_error", "attitude_error_rms", "rate_error_rms_last_fifth"] {
            assert_near(&metrics, name, 0.0, 1e-6);
        }
        for name in INERTIA_ERRORS {
            assert_near(&metrics, name, 0.0, 1e-9);
        }
        assert_near(&metrics, "Lxx_sigma", 0.01, 1e-12);
    }
}

#[test]
fn the_inertial_axes_of_the_truth_need_not_be_the_cameras() {
    let bench = tumbling_bench(&exp(&Vector3::new(0.3, -1.2, 2.0)));
    let camera_from_inertial = exp(&Vector3::new(-0.4, 0.9, 0.2));
    let (states, tensor) = opnav::dataset::truth::read_asteroid(&bench.root()).expect("read");
    let start = states[0].asteroid_from_inertial;
    let pose = Isometry3::from_parts(Translation3::new(0.0, 0.0, -900.0), start);
    write_tum(&bench.root().join("truth/cam0.tum"), &[StampedPose { t_ns: 0, reference_from_moving: pose }])
        .expect("write");
    let turned: Vec<AsteroidState> = states
        .iter()
        .map(|s| AsteroidState { asteroid_from_inertial: s.asteroid_from_inertial * camera_from_inertial, ..*s })
        .collect();
    write_asteroid(&bench.root(), &turned, &tensor).expect("write");
    bench.put("estimate.csv", &tumbling_csv(&tumble(61, 1.0), TRUE_RATIOS));
    assert_near(&bench.metrics(), "attitude_error_rms", 0.0, 1e-6);
}

#[test]
fn a_start_later_than_the_truths_is_taken_from_the_summary_or_the_tracks() {
    let bench = tumbling_bench(&exp(&Vector3::new(0.3, -1.2, 2.0)));
    let states = tumble(61, 1.0);
    let start = states[10].asteroid_from_inertial.inverse();
    let late: Vec<AsteroidState> = states[10..]
        .iter()
        .map(|s| AsteroidState {
            t_ns: s.t_ns,
            asteroid_from_inertial: start * s.asteroid_from_inertial,
            rate_in_asteroid_rad_s: start * s.rate_in_asteroid_rad_s,
        })
        .collect();
    bench.put("estimate.csv", &tumbling_csv(&late, TRUE_RATIOS));
    assert!(figure(&bench.metrics(), "attitude_error_rms") > 10.0, "the wrong start must show");
    bench.put("tracks.csv", "t_ns,track_id,u_px,v_px,sigma_px,response\n10000000000,1,5,5,0.1,1\n");
    assert_near(&bench.metrics(), "attitude_error_rms", 0.0, 1e-6);
    bench.put("tracks.csv", "t_ns,track_id,u_px,v_px,sigma_px,response\n0,1,5,5,0.1,1\n");
    bench.put("summary.json", "{\"mission\": \"tumbling\", \"t0_ns\": 10000000000}");
    assert_near(&bench.metrics(), "attitude_error_rms", 0.0, 1e-6);
}

#[test]
fn known_errors_of_a_tumbling_result_are_found_exactly() {
    let bench = tumbling_bench(&exp(&Vector3::new(1.0, 0.5, -0.2)));
    let mut rows = tumble(61, 1.0);
    for row in &mut rows {
        row.rate_in_asteroid_rad_s -= Vector3::new(0.0, 0.003, 0.004);
        row.asteroid_from_inertial *= exp(&Vector3::new(-0.01, 0.0, 0.0));
    }
    bench.put("estimate.csv", &tumbling_csv(&rows, "0.80,1.37,0.13,0.17,-0.10"));
    let metrics = bench.metrics();
    assert_near(&metrics, "final_rate_error", 0.005f64.to_degrees(), 1e-9);
    assert_near(&metrics, "attitude_error_rms_last_fifth", 0.01f64.to_degrees(), 1e-9);
    assert_near(&metrics, "Lxx_error", 0.05, 1e-9);
    assert_near(&metrics, "Lyz_error", -0.01, 1e-9);
    assert_near(&metrics, "worst_inertia_error", 0.05, 1e-9);
    let curve = metrics.series("attitude_error_x").expect("a curve");
    assert!(curve.values.iter().all(|v| (v - 0.01f64.to_degrees()).abs() < 1e-6));
}

#[test]
fn a_transposed_attitude_is_noticed() {
    let bench = tumbling_bench(&UnitQuaternion::identity());
    let mut rows = tumble(61, 1.0);
    for row in &mut rows {
        row.asteroid_from_inertial = row.asteroid_from_inertial.inverse();
    }
    bench.put("estimate.csv", &tumbling_csv(&rows, TRUE_RATIOS));
    assert!(figure(&bench.metrics(), "attitude_error_rms") > 10.0);
}

#[test]
fn tumbling_consistency_uses_attitude_and_rate_in_that_order() {
    let bench = tumbling_bench(&exp(&Vector3::new(1.0, 0.5, -0.2)));
    let root = covariance_root::<6>(|i| [1e-3, 2e-3, 5e-4, 2e-5, 1e-5, 4e-5][i]);
    let mut rows = tumble(61, 1.0);
    for (k, row) in rows.iter_mut().enumerate() {
        let error = root * white::<6>(500 + k as u64);
        row.asteroid_from_inertial *= exp(&-Vector3::from(error.fixed_rows::<3>(0)));
        row.rate_in_asteroid_rad_s -= error.fixed_rows::<3>(3);
    }
    let covariance = root * root.transpose();
    bench.put("estimate.csv", &tumbling_csv(&rows, TRUE_RATIOS));
    bench.put("covariance.csv", &covariance_csv(rows.iter().map(|row| (row.t_ns, covariance))));
    let metrics = bench.metrics();
    assert!(metrics.verdict("consistent").expect("a verdict").holds, "{:?}", metrics.verdicts);
    assert_near(&metrics, "nees_per_dof_mean", 1.0, 0.2);
    assert_eq!(metrics.series("rate_error_z").expect("a curve").sigma[0], covariance[(5, 5)].sqrt().to_degrees());
}

#[test]
fn an_inertia_that_is_not_determined_gets_no_number() {
    let bench = tumbling_bench(&UnitQuaternion::identity());
    bench.put("estimate.csv", &tumbling_csv(&tumble(61, 1.0), "0.85,,NaN,0.17,-0.11"));
    let metrics = bench.metrics();
    assert_eq!((metrics.figure("Lyy_error"), metrics.figure("Lxy_error")), (None, None));
    assert_near(&metrics, "Lxz_error", 0.0, 1e-9);
    assert!(metrics.notes.iter().any(|n| n.contains("Lyy not determined")), "{:?}", metrics.notes);
}

// ---------------------------------------------------------------------------------------------------- pairs and tracks

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

/// Five pictures of a descent with tracks on a grid of ground points; every second picture is off by `shift_px`.
fn track_bench(shift_px: f64) -> Bench {
    let bench = landing_bench();
    bench.put("summary.json", "{\"mission\": \"tracking\"}");
    let mut text = String::from("t_ns,track_id,u_px,v_px,sigma_px,response\n");
    for (frame, t_ns) in picture_times().enumerate() {
        let camera_from_site = true_camera(t_ns).inverse();
        for id in 0..25 {
            let start = Vector2::new(20.0 + 5.5 * f64::from(id % 5), 14.0 + 4.7 * f64::from(id / 5));
            let point = ground_under(0, &start).0 * 0.1;
            let seen = camera_from_site * nalgebra::Point3::from(point);
            let pixel = small_camera().project(&seen.coords).expect("ahead");
            if small_camera().contains(&pixel, 2.0) {
                let shift = if frame % 2 == 1 { shift_px } else { 0.0 };
                writeln!(text, "{t_ns},{},{},{},0.1,1", id + 1, pixel.x + shift, pixel.y).expect("text");
            }
        }
    }
    bench.put("tracks.csv", &text);
    bench
}

#[test]
fn tracks_on_their_surface_points_have_no_error_and_slips_are_measured() {
    let metrics = track_bench(0.0).metrics();
    assert!(figure(&metrics, "track_steps_judged") > 60.0);
    assert_near(&metrics, "track_error_p95", 0.0, 0.02);
    let metrics = track_bench(3.0).metrics();
    // A shift of 3 px in one picture only shows in full from or into it, but for the change of scale between the two.
    let median = figure(&metrics, "track_error_median");
    assert!((2.5..6.0).contains(&median), "{median}");
}

#[test]
fn swapped_tracks_are_noticed() {
    let bench = track_bench(0.0);
    let text = fs::read_to_string(bench.result().join("tracks.csv")).expect("written");
    let (mut swapped, mut lines) = (String::new(), text.lines());
    writeln!(swapped, "{}", lines.next().expect("a header")).expect("text");
    for line in lines {
        let mut fields: Vec<&str> = line.split(',').collect();
        if fields[0] == "20000000000" {
            fields.swap(2, 3);
        }
        writeln!(swapped, "{}", fields.join(",")).expect("text");
    }
    bench.put("tracks.csv", &swapped);
    assert!(figure(&bench.metrics(), "track_error_p95") > 5.0);
}

// ---------------------------------------------------------------------------------------------------- files

#[test]
fn metrics_are_written_with_units_and_come_back() {
    let bench = landing_with_noise(1.0);
    let metrics = bench.metrics();
    // serde_json reads a number to within a few units of the last place.
    let same = |a: f64, b: f64| (a - b).abs() <= 8.0 * f64::EPSILON * b.abs();
    let back = Metrics::read(&bench.result()).expect("read");
    assert_eq!((back.mission, &back.verdicts, &back.notes), (metrics.mission, &metrics.verdicts, &metrics.notes));
    for (a, b) in back.figures.iter().zip(&metrics.figures) {
        assert_eq!((&a.name, &a.unit, a.bound.is_some()), (&b.name, &b.unit, b.bound.is_some()));
        assert!(same(a.value, b.value), "{}", a.name);
    }
    for (a, b) in back.series.iter().zip(&metrics.series) {
        assert_eq!((&a.name, &a.unit, a.t_s.len(), a.sigma.len()), (&b.name, &b.unit, b.t_s.len(), b.sigma.len()));
        assert!(a.values.iter().zip(&b.values).all(|(x, y)| same(*x, *y)), "{}", a.name);
    }
    assert_eq!((back.figures.len(), back.series.len()), (metrics.figures.len(), metrics.series.len()));
    let text = fs::read_to_string(bench.result().join("metrics.json")).expect("written");
    let object: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let figures = object["figures"].as_array().expect("figures");
    assert_eq!(figures.len(), metrics.figures.len());
    for figure in figures {
        assert!(figure["value"].is_f64() && !figure["unit"].as_str().expect("a unit").is_empty(), "{figure}");
    }
    assert_eq!(object["mission"], "landing");
}

fn complaint(bench: &Bench, words: &[&str]) {
    let error = bench.evaluate().expect_err("this should be refused").to_string();
    for word in words {
        assert!(error.contains(word), "'{word}' not in: {error}");
    }
}

#[test]
fn unusable_results_are_refused_with_file_and_line() {
    let bench = landing_bench();
    complaint(&bench, &["estimate.csv is missing"]);
    let good = landing_csv(&perfect_landing());
    bench.put("estimate.csv", &good.replace("vy_m_s,", "v_m_s,"));
    complaint(&bench, &["estimate.csv", "no column 'vy_m_s'", "vx_m_s"]);
    let spoil = |line: usize, change: &dyn Fn(&str) -> String| {
        let lines: Vec<String> =
            good.lines().enumerate().map(|(k, l)| if k + 1 == line { change(l) } else { l.to_string() }).collect();
        bench.put("estimate.csv", &lines.join("\n"));
    };
    spoil(5, &|l| l.replacen(",1,2,3,", ",1,2,nan,", 1));
    complaint(&bench, &["estimate.csv, line 5", "sigma_z_m 'nan' is not a finite number"]);
    spoil(4, &|l| l.rsplit_once(',').expect("columns").0.to_string());
    complaint(&bench, &["estimate.csv", "line: 4"]);
    spoil(7, &|l| format!("5000000000{}", &l[l.find(',').expect("columns")..]).replacen("5000000000", "4000000000", 1));
    complaint(&bench, &["estimate.csv, line 7", "does not come after"]);
    bench.put("estimate.csv", &good);
    bench.put("covariance.csv", "0,1,2,3\n");
    complaint(&bench, &["covariance.csv, line 1", "46 expected"]);
}

#[test]
fn results_of_another_data_set_are_refused() {
    let bench = landing_bench();
    let mut rows = perfect_landing();
    for row in &mut rows {
        row.t_ns += 1000 * SECOND_NS;
    }
    bench.put("estimate.csv", &landing_csv(&rows));
    complaint(&bench, &["no time of", "another data set"]);
}

#[test]
fn missing_summaries_and_truth_come_with_the_cure() {
    let bench = Bench::new("swimming");
    complaint(&bench, &["summary.json", "\"swimming\"", "landing"]);
    fs::write(bench.result().join("summary.json"), "{").expect("write");
    complaint(&bench, &["summary.json", "line 1"]);
    fs::remove_file(bench.result().join("summary.json")).expect("removed");
    complaint(&bench, &["summary.json is missing", "opnav land"]);
    let bench = Bench::new("tracking");
    complaint(&bench, &["sensor.yaml is missing"]);
    fs::remove_dir_all(bench.root().join("truth")).expect("removed");
    complaint(&bench, &["no folder 'truth'"]);
    assert!(Metrics::read(&bench.result()).expect_err("none").to_string().contains("opnav evaluate"));
}

#[test]
fn percentiles_interpolate_between_order_statistics() {
    assert_eq!(percentile(&[3.0, 1.0, 2.0, f64::NAN], 0.5), Some(2.0));
    assert_eq!(percentile(&[1.0, 2.0, 3.0, 4.0], 0.5), Some(2.5));
    assert_eq!(percentile(&[1.0, 2.0], 1.0), Some(2.0));
    assert_eq!(percentile(&[], 0.5), None);
    assert_eq!(root_mean_square([3.0, 4.0, 0.0, 0.0]), Some(2.5));
    assert_eq!(root_mean_square([]), None);
}
