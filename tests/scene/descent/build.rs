//! The descent scene: states, samples and views on one clock, its initial error, its landmarks.

use super::{STEP_NS, motion};
use crate::scene::{descent, scenario};
use nalgebra::{Point3, Vector3};
use opnav::geometry::Manifold;
use opnav::scene::{InitialErrorConfig, Scenario, Scene};

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
        let up_in_image = view.reference_from_camera * -Vector3::y();
        assert!((up_in_image - state.site_from_lander * Vector3::y()).norm() < 1e-12);
    }
}

#[test]
fn canted_narrow_camera_keeps_the_site_in_its_images() {
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
    let blind = scenario(&canted.replace("20", "0")).unwrap().build(crate::scene::datasets()).unwrap_err().to_string();
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
    let scenario = Scenario::read(&crate::scene::datasets().join("mars_descent_tilted.toml"), &[]).unwrap();
    let Scene::Descent(scene) = scenario.build(crate::scene::datasets()).unwrap() else { panic!("not a descent") };
    let (roll, pitch, yaw) = scene.lander_states[0].site_from_lander.rotation.euler_angles();
    let error_deg = Vector3::new(roll, pitch, yaw).map(f64::to_degrees) - Vector3::new(-25.7, -9.8, 0.0);
    assert!(error_deg.abs().max() < 0.05, "{error_deg}");
}
