//! Guidance, attitude, inertial measurements, schedule and the descent scene.

use super::{descent, scenario};
use nalgebra::{Point3, UnitQuaternion, Vector3};
use opnav::dataset::ImuSample;
use opnav::geometry::{Manifold, so3};
use opnav::scene::{
    DescentMotion, FrameSchedule, GuidanceConfig, GuidanceProfile, ImuConfig, InitialErrorConfig, PolynomialGuidance,
    Scenario, Scene, ideal_samples,
};

fn path() -> PolynomialGuidance {
    PolynomialGuidance::new(&GuidanceConfig::default())
}

fn motion() -> DescentMotion {
    DescentMotion::new(path())
}

const END_NS: i64 = 198_000_000_000;
const STEP_NS: i64 = 10_000_000;

#[test]
fn coefficients_follow_from_the_boundary_conditions() {
    let known = [
        [0.34343434343, -8.8426351053e-4, 7.7295761e-7],
        [0.10162228344, 9.9917654249e-4, -2.9551965e-6],
        [0.70812672176, -3.6512971775e-3, 7.69795515e-6],
    ];
    let path = path();
    for (axis, [c2, c3, c4]) in known.into_iter().enumerate() {
        assert!((path.coefficients[2][axis] / c2 - 1.0).abs() < 1e-9);
        assert!((path.coefficients[3][axis] / c3 - 1.0).abs() < 1e-9);
        assert!((path.coefficients[4][axis] / c4 - 1.0).abs() < 1e-7); // printed to 8 or 9 digits
        assert_eq!(path.coefficients[5][axis], 0.0);
    }
    let at_60_m = path.position_in_site_m(60.0);
    assert!((at_60_m - Vector3::new(995.380, 2453.363, 3030.342)).abs().max() < 5.1e-4, "{at_60_m}");
    let at_120_m_s = path.velocity_in_site_m_s(120.0);
    assert!((at_120_m_s - Vector3::new(-6.433, -18.873, -24.577)).abs().max() < 5.1e-4, "{at_120_m_s}");
}

#[test]
fn path_ends_at_rest_on_the_site() {
    let quintic = GuidanceConfig {
        profile: GuidanceProfile::Quintic { initial_acceleration_m_s2: [-0.6, 1.8, 0.0] },
        ..GuidanceConfig::default()
    };
    for config in [GuidanceConfig::default(), quintic] {
        let path = PolynomialGuidance::new(&config);
        assert!((path.position_in_site_m(0.0) - Vector3::new(3300.0, 5870.0, 6570.0)).norm() < 1e-9);
        assert!((path.velocity_in_site_m_s(0.0) - Vector3::new(-56.0, -66.0, -90.0)).norm() < 1e-12);
        assert!(path.position_in_site_m(198.0).norm() < 1e-8);
        assert!(path.velocity_in_site_m_s(198.0).norm() < 1e-9);
        let thrust = path.specific_force_in_site_m_s2(198.0);
        assert!((thrust - Vector3::new(0.0, 0.0, 0.7 + 3.711)).norm() < 1e-10);
        if let GuidanceProfile::Quintic { initial_acceleration_m_s2: a } = config.profile {
            let thrust = path.specific_force_in_site_m_s2(0.0);
            assert!((thrust - Vector3::new(a[0], a[1], a[2] + 3.711)).norm() < 1e-10);
        }
    }
}

#[test]
fn derivatives_agree_with_differences() {
    let (path, h) = (path(), 1e-3);
    for t_s in [0.5, 33.0, 120.0, 190.0] {
        let slope = |f: &dyn Fn(f64) -> Vector3<f64>| (f(t_s + h) - f(t_s - h)) / (2.0 * h);
        let velocity = slope(&|t| path.position_in_site_m(t)) - path.velocity_in_site_m_s(t_s);
        assert!(velocity.norm() < 1e-7, "{velocity}");
        let gravity = Vector3::new(0.0, 0.0, -3.711);
        let force = slope(&|t| path.velocity_in_site_m_s(t)) - gravity - path.specific_force_in_site_m_s2(t_s);
        assert!(force.norm() < 1e-7, "{force}");
        let jerk = slope(&|t| path.specific_force_in_site_m_s2(t)) - path.jerk_in_site_m_s3(t_s);
        assert!(jerk.norm() < 1e-9, "{jerk}");
    }
}

#[test]
fn attitude_points_the_thrust_with_zero_yaw() {
    let motion = motion();
    let (roll, pitch, yaw) = motion.site_from_lander(0.0).euler_angles();
    assert!((roll.to_degrees() + 2.25).abs() < 5.1e-3 && (pitch.to_degrees() - 7.63).abs() < 5.1e-3, "{roll} {pitch}");
    assert!(yaw.abs() < 1e-12);
    let (mut weakest, mut strongest) = (f64::INFINITY, 0.0_f64);
    for step in 0..=1980 {
        let t_s = 0.1 * f64::from(step);
        let force = motion.specific_force_in_lander_m_s2(t_s);
        assert!(force.xy().norm() < 1e-12 && force.z > 0.0);
        assert!(motion.site_from_lander(t_s).euler_angles().2.abs() < 1e-12);
        (weakest, strongest) = (weakest.min(force.z), strongest.max(force.z));
    }
    assert!((weakest - 3.85).abs() < 0.01 && (strongest - 5.18).abs() < 0.01, "{weakest} {strongest}");
    for (t_s, expected_deg) in [(0.0, 40.3), (50.0, 35.6), (100.0, 23.1), (150.0, 8.7), (190.0, 1.0)] {
        let state = motion.state((t_s * 1e9) as i64);
        let site = state.site_from_lander.inverse_transform_point(&Point3::origin()).coords;
        let off_axis_deg = (-site.z / site.norm()).acos().to_degrees();
        assert!((off_axis_deg - expected_deg).abs() < 0.051, "t = {t_s}: {off_axis_deg}");
    }
}

#[test]
fn angular_rate_agrees_with_the_attitude() {
    let (motion, h) = (motion(), 1e-2);
    for t_s in [1.0, 33.0, 120.0, 190.0] {
        let turn = motion.site_from_lander(t_s + h).minus(&motion.site_from_lander(t_s - h));
        let error = turn / (2.0 * h) - motion.rate_in_lander_rad_s(t_s);
        assert!(error.norm() < 1e-9, "t = {t_s}: {error}");
        assert!(motion.rate_in_lander_rad_s(t_s).norm() > 1e-5);
    }
}

/// Strap-down integration; `middle` is the share of an interval's turn at which the specific force is applied.
fn integrated(samples: &[ImuSample], middle: f64) -> (UnitQuaternion<f64>, Vector3<f64>, Vector3<f64>) {
    let start = motion().state(0);
    let (mut attitude, mut velocity) = (start.site_from_lander.rotation, start.lander_velocity_in_site_m_s);
    let mut position = start.site_from_lander.translation.vector;
    let (gravity, dt_s) = (Vector3::new(0.0, 0.0, -3.711), STEP_NS as f64 * 1e-9);
    for sample in samples {
        let turn = sample.rate_in_lander_rad_s * dt_s;
        let acceleration = attitude * so3::exp(&(turn * middle)) * sample.specific_force_in_lander_m_s2 + gravity;
        position += velocity * dt_s + acceleration * (0.5 * dt_s * dt_s);
        velocity += acceleration * dt_s;
        attitude *= so3::exp(&turn);
    }
    (attitude, velocity, position)
}

#[test]
fn noise_free_samples_close_on_the_truth_at_touchdown() {
    let samples = ideal_samples(&motion(), STEP_NS, END_NS);
    assert_eq!((samples.len(), samples[0].t_ns, samples.last().unwrap().t_ns), (19_800, STEP_NS, END_NS));
    let end = motion().state(END_NS);
    let (attitude, velocity, position) = integrated(&samples, 0.5);
    let turn_rad = attitude.angle_to(&end.site_from_lander.rotation);
    let off_m_s = (velocity - end.lander_velocity_in_site_m_s).norm();
    let off_m = (position - end.site_from_lander.translation.vector).norm();
    assert!(turn_rad < 1e-6 && off_m_s < 1e-6 && off_m < 1e-3, "{turn_rad} rad, {off_m_s} m/s, {off_m} m");
    // Applied in the attitude of the beginning of each interval they do not: an integrating unit turns as it sums.
    let (_, _, position) = integrated(&samples, 0.0);
    assert!((position - end.site_from_lander.translation.vector).norm() > 1e-2);
}

#[test]
fn imu_noise_has_its_densities_and_is_seeded() {
    let (config, motion) = (ImuConfig::default(), motion());
    let ideal = ideal_samples(&motion, STEP_NS, END_NS);
    let noisy = config.samples(&motion, END_NS, 5);
    assert_eq!(noisy, config.samples(&motion, END_NS, 5));
    assert_ne!(noisy, config.samples(&motion, END_NS, 6));
    let quiet = ImuConfig { noise: false, ..config };
    assert_eq!(quiet.samples(&motion, END_NS, 5), ideal);
    // Means over 1 s have 1σ of 5e-4 m/s² and 2.78e-5 °/s.
    let seconds = noisy.chunks_exact(100).zip(ideal.chunks_exact(100));
    let (mut rate, mut force) = (0.0, 0.0);
    for (n, i) in seconds {
        let mean = |f: &dyn Fn(usize) -> Vector3<f64>| (0..100).map(f).sum::<Vector3<f64>>() / 100.0;
        rate += mean(&|k| n[k].rate_in_lander_rad_s - i[k].rate_in_lander_rad_s).norm_squared();
        force += mean(&|k| n[k].specific_force_in_lander_m_s2 - i[k].specific_force_in_lander_m_s2).norm_squared();
    }
    let rms = |sum: f64| (sum / (3.0 * 198.0)).sqrt();
    assert!((rms(rate).to_degrees() / 2.78e-5 - 1.0).abs() < 0.1, "{}", rms(rate).to_degrees());
    assert!((rms(force) / 5e-4 - 1.0).abs() < 0.1, "{}", rms(force));
    assert!((config.gyroscope_noise_density / 4.852e-7 - 1.0).abs() < 1e-3);
}

#[test]
fn constant_scale_pictures_shrink_the_height_by_one_ratio() {
    let schedule = FrameSchedule::ConstantScale { count: 60, end_height_m: 15.0 };
    let times_ns = schedule.times_ns(&path(), STEP_NS).unwrap();
    assert_eq!((times_ns.len(), times_ns[0]), (60, 0));
    assert!(times_ns.iter().all(|t| t % STEP_NS == 0));
    let heights: Vec<f64> = times_ns.iter().map(|t| path().position_in_site_m(*t as f64 * 1e-9).z).collect();
    let ratio = (15.0_f64 / 6570.0).powf(1.0 / 59.0);
    for pair in heights.windows(2) {
        assert!((pair[1] / pair[0] / ratio - 1.0).abs() < 5e-3, "{pair:?}"); // time is rounded to 10 ms
    }
    assert!((heights[59] - 15.0).abs() < 0.05, "{}", heights[59]);
    let crowded = FrameSchedule::ConstantScale { count: 50_000, end_height_m: 15.0 };
    let error = crowded.times_ns(&path(), STEP_NS).unwrap_err().to_string();
    assert!(error.contains("constant-scale.count"), "{error}");
}

#[test]
fn uniform_pictures_end_at_the_height_or_the_time() {
    let times = |rate_hz, start_s, end_s| {
        FrameSchedule::Uniform { rate_hz, start_s, end_s, end_height_m: 15.0 }.times_ns(&path(), STEP_NS).unwrap()
    };
    let all = times(1.0, 0.0, 1e4);
    assert!(all.iter().enumerate().all(|(index, t)| *t == index as i64 * 1_000_000_000));
    let height_m = |t_ns: i64| path().position_in_site_m(t_ns as f64 * 1e-9).z;
    let last = *all.last().unwrap();
    assert!(height_m(last) >= 15.0 && height_m(last + 1_000_000_000) < 15.0);
    assert_eq!(times(2.0, 10.0, 12.0), [10.0, 10.5, 11.0, 11.5, 12.0].map(|t| (t * 1e9) as i64));
    assert_eq!(times(30.0, 0.0, 0.1), [0, 30_000_000, 70_000_000, 100_000_000]);
    let none = FrameSchedule::Uniform { rate_hz: 1.0, start_s: 197.9, end_s: 1e4, end_height_m: 15.0 };
    assert!(none.times_ns(&path(), STEP_NS).unwrap_err().to_string().contains("start_s"));
}

const SMALL: &str = "[camera]\nwidth_px = 512\nheight_px = 512\n[descent.schedule.constant-scale]\ncount = 60\n";

#[test]
fn scene_has_states_samples_and_views_on_one_clock() {
    let scene = descent(SMALL);
    assert_eq!((scene.lander_states.len(), scene.imu.len(), scene.cameras[0].views.len()), (19_801, 19_800, 60));
    assert_eq!(scene.imu_noise.rate_hz, 100.0);
    for (state, sample) in scene.lander_states[1..].iter().zip(&scene.imu) {
        assert_eq!(state.t_ns, sample.t_ns);
    }
    assert_eq!(scene.cameras[0].views[0].t_ns, 0);
    for view in &scene.cameras[0].views {
        let state = &scene.lander_states[(view.t_ns / STEP_NS) as usize];
        let expected = state.site_from_lander * scene.cameras[0].sensor.spacecraft_from_camera;
        assert_eq!(view.reference_from_camera, expected);
        let down = view.reference_from_camera * Vector3::z();
        assert!((down + state.site_from_lander * Vector3::z()).norm() < 1e-12);
        let up_in_picture = view.reference_from_camera * -Vector3::y();
        assert!((up_in_picture - state.site_from_lander * Vector3::y()).norm() < 1e-12);
    }
}

#[test]
fn canted_narrow_camera_keeps_the_site_in_its_pictures() {
    let canted =
        "[camera]\nfov_deg = 60\n[descent.camera_mount]\ncant_deg = 20\n[descent.schedule.uniform]\nrate_hz = 1\n";
    let scene = descent(canted);
    for view in &scene.cameras[0].views {
        let site = view.reference_from_camera.inverse_transform_point(&Point3::origin()).coords;
        let pixel = scene.cameras[0].sensor.camera.project(&site).unwrap();
        assert!(scene.cameras[0].sensor.camera.contains(&pixel, 0.0), "t = {} ns: {pixel}", view.t_ns);
    }
    let axis = scene.cameras[0].sensor.spacecraft_from_camera * Vector3::z();
    assert!(((-axis.z).acos().to_degrees() - 20.0).abs() < 1e-9);
    let site = scene.cameras[0].views[0].reference_from_camera.inverse_transform_point(&Point3::origin()).coords;
    assert!((site.xy().norm().atan2(site.z).to_degrees() - 20.3).abs() < 0.06);
    let blind = scenario(&canted.replace("20", "0")).unwrap().build(super::datasets()).unwrap_err().to_string();
    assert!(blind.contains("cant_deg") && blind.contains("40.3°"), "{blind}");
}

#[test]
fn lever_arm_moves_the_camera_in_lander_axes() {
    let scene = descent(&format!("{SMALL}[descent.camera_mount]\ncamera_in_lander_m = [0.5, -0.25, -1]\n"));
    let (view, state) = (&scene.cameras[0].views[0], &scene.lander_states[0]);
    let found = state.site_from_lander.inverse() * view.reference_from_camera;
    assert!((found.translation.vector - Vector3::new(0.5, -0.25, -1.0)).norm() < 1e-9);
}

#[test]
fn initial_state_errs_uniformly_as_it_says() {
    let (config, truth) = (InitialErrorConfig::default(), motion().state(0));
    let (mut position, mut velocity, mut attitude) = (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
    let runs = 2000;
    for seed in 0..runs {
        let state = config.initial_state(&truth, seed);
        let dp = state.site_from_lander.translation.vector - truth.site_from_lander.translation.vector;
        let dv = state.lander_velocity_in_site_m_s - truth.lander_velocity_in_site_m_s;
        let da = state.site_from_lander.rotation.minus(&truth.site_from_lander.rotation);
        assert!(dp.abs().max() <= 1000.0 && dv.abs().max() <= 10.0 && da.abs().max() <= 2.0_f64.to_radians() + 1e-12);
        position += dp.component_mul(&dp) / runs as f64;
        velocity += dv.component_mul(&dv) / runs as f64;
        attitude += da.component_mul(&da) / runs as f64;
    }
    let state = config.initial_state(&truth, 0);
    let pairs = [
        (position, state.sigma_position_m, 577.350),
        (velocity, state.sigma_velocity_m_s, 5.77350),
        (attitude, state.sigma_attitude_rad, 0.0201532),
    ];
    for (variance, sigma, expected) in pairs {
        assert!((sigma / expected - 1.0).abs() < 1e-5, "{sigma}");
        assert!((variance.map(f64::sqrt) / sigma - Vector3::repeat(1.0)).abs().max() < 0.05, "{variance}");
    }
    assert_eq!(state, config.initial_state(&truth, 0));
}

#[test]
fn designated_pixel_is_the_site_with_its_noise() {
    let scene = descent(SMALL);
    let site = scene.cameras[0].views[0].reference_from_camera.inverse_transform_point(&Point3::origin()).coords;
    let true_px = scene.cameras[0].sensor.camera.project(&site).unwrap();
    let off_px = scene.designated.pixel_px - true_px;
    assert!(off_px.norm() > 1e-6 && off_px.norm() < 0.5, "{off_px}");
    assert!((scene.designated.covariance_px2 - nalgebra::Matrix2::identity() * 0.01).abs().max() < 1e-15);
    assert_eq!(scene.designated.t_ns, 0);
    let config = InitialErrorConfig::default();
    let mean_square: f64 =
        (0..2000).map(|seed| (config.designated(0, &true_px, seed).pixel_px - true_px).norm_squared()).sum::<f64>()
            / 2000.0;
    assert!((mean_square / 0.02 - 1.0).abs() < 0.1, "{mean_square}");
}

#[test]
fn landmarks_lie_on_the_ground_at_every_scale() {
    let scene = descent(SMALL);
    assert_eq!(scene.landmarks.len(), 200);
    assert_eq!(scene.landmarks[0].position_m, Vector3::zeros());
    for landmark in &scene.landmarks {
        let p = landmark.position_m;
        assert!((p.z - scene.terrain.height_m(p.x, p.y)).abs() < 1e-9);
    }
    let seen = |index: usize| {
        let view = &scene.cameras[0].views[index];
        let inside = |p: &Vector3<f64>| {
            let in_camera = view.reference_from_camera.inverse_transform_point(&Point3::from(*p)).coords;
            scene.cameras[0]
                .sensor
                .camera
                .project(&in_camera)
                .is_some_and(|pixel| scene.cameras[0].sensor.camera.contains(&pixel, 0.0))
        };
        scene.landmarks.iter().filter(|l| inside(&l.position_m)).count()
    };
    for index in [0, 20, 40, 59] {
        assert!(seen(index) > 20, "picture {index}: {}", seen(index));
    }
}

#[test]
fn tilted_scenario_starts_in_the_attitude_of_the_papers_table() {
    let scenario = Scenario::read(&super::datasets().join("mars_descent_tilted.toml"), &[]).unwrap();
    let Scene::Descent(scene) = scenario.build(super::datasets()).unwrap() else { panic!("not a descent") };
    let (roll, pitch, yaw) = scene.lander_states[0].site_from_lander.rotation.euler_angles();
    let error_deg = Vector3::new(roll, pitch, yaw).map(f64::to_degrees) - Vector3::new(-25.7, -9.8, 0.0);
    assert!(error_deg.abs().max() < 0.05, "{error_deg}");
}
