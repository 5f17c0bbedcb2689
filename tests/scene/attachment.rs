//! Linked spacecraft over a small body's site.

use super::{datasets, scenario};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use opnav::dataset::ImuSample;
use opnav::geometry::{Manifold, so3};
use opnav::scene::{
    ApolloGuidance, ApproachConfig, AttachmentScene, BodyConfig, FlexConfig, NodeMotion, Scene, SensedMotion,
    TurningBody,
};

fn attachment(text: &str) -> AttachmentScene {
    match scenario(text).expect("a scenario").build(datasets()).expect("a scene") {
        Scene::Attachment(scene) => *scene,
        _ => panic!("not linked spacecraft"),
    }
}

/// Small pictures, few of them, no noise.
const QUIET: &str = "[camera]\nwidth_px = 32\nheight_px = 32\n[attachment]\npicture_interval_s = 600\n\
                     [attachment.imu]\nnoise = false\n";

fn node(number: u32) -> NodeMotion {
    NodeMotion {
        center: ApolloGuidance::new(&ApproachConfig::default()),
        place_m: Vector3::new(-0.6495, -0.375, 0.0),
        vibration: FlexConfig::default().vibration(1, number),
        body: TurningBody::new(&BodyConfig::default()),
    }
}

#[test]
fn guidance_passes_the_known_point_and_ends_at_rest() {
    let path = ApolloGuidance::new(&ApproachConfig::default());
    let close = |found: Vector3<f64>, known: [f64; 3], tolerance: f64| {
        assert!((found - Vector3::from(known)).abs().max() < tolerance, "{found} and not {known:?}");
    };
    close(path.position_in_site_m(0.0), [10.0, 10.0, 800.0], 1e-9);
    close(path.velocity_in_site_m_s(0.0), [-0.02, 0.01, -0.5], 1e-12);
    close(path.position_in_site_m(900.0), [0.875, 4.25, 214.375], 1e-9);
    close(path.velocity_in_site_m_s(900.0), [-1.0 / 300.0, -0.010_833_3, -0.516_666_7], 1e-7);
    close(path.position_in_site_m(1800.0), [0.0, 0.0, 30.0], 1e-12);
    close(path.velocity_in_site_m_s(1800.0), [0.0; 3], 1e-12);
    let slope = (path.velocity_in_site_m_s(700.5) - path.velocity_in_site_m_s(699.5)) / 1.0;
    close(path.acceleration_in_site_m_s2(700.0), slope.into(), 1e-9);
}

#[test]
fn vibrations_have_their_amplitudes_and_derivatives() {
    let config = FlexConfig::default();
    let mut mean_square = nalgebra::SVector::<f64, 6>::zeros();
    let count = 40 * 500;
    for number in 0..40 {
        let vibration = config.vibration(7, number);
        for step in 0..500 {
            let value = vibration.derivative(0, 37.0 * f64::from(step));
            mean_square += value.component_mul(&value) / f64::from(count);
        }
    }
    let ratio = mean_square.map(f64::sqrt).component_div(&config.rms());
    assert!(ratio.iter().all(|r| (r - 1.0).abs() < 0.02), "{ratio}");
    let known = [0.005, 0.005, 0.046, 1.5_f64.to_radians(), 1.5_f64.to_radians(), 0.5_f64.to_radians()];
    assert_eq!(config.rms().as_slice(), known);
    let vibration = config.vibration(7, 0);
    assert_ne!(vibration, config.vibration(7, 1), "two nodes vibrate alike");
    for (order, step_s) in [(0, 1e-3), (1, 1e-3)] {
        for t_s in [0.0, 123.4, 1800.0] {
            let slope = (vibration.derivative(order, t_s + step_s) - vibration.derivative(order, t_s - step_s))
                / (2.0 * step_s);
            let error = (slope - vibration.derivative(order + 1, t_s)).abs().max();
            assert!(error < 1e-9, "order {order}: {error}");
        }
    }
}

#[test]
fn the_triangle_keeps_its_sides_but_for_the_vibration() {
    let sides_m = |scene: &AttachmentScene, t_s: f64| {
        [(0, 1), (1, 2), (2, 0)].map(|(i, j)| {
            let [a, b]: [&NodeMotion; 2] = [i, j].map(|k: usize| &scene.nodes[k].motion);
            (a.position_in_site_m(t_s) - b.position_in_site_m(t_s)).norm()
        })
    };
    let stiff = "[attachment.flex]\nin_plane_m = 0\nout_of_plane_m = 0\ntilt_deg = 0\ntwist_deg = 0\n";
    let stiff = attachment(&format!("{QUIET}{stiff}"));
    let flexible = attachment(QUIET);
    let mut largest = 0.0_f64;
    for t_s in [0.0, 400.0, 1234.5, 1800.0] {
        assert!(sides_m(&stiff, t_s).iter().all(|side_m| (side_m - 1.299).abs() < 1e-4), "{:?}", sides_m(&stiff, t_s));
        for side_m in sides_m(&flexible, t_s) {
            assert!((side_m - 1.299).abs() < 0.06, "{side_m}");
            largest = largest.max((side_m - 1.299).abs());
        }
    }
    assert!(largest > 1e-3, "the links do not bend");
    assert!(stiff.nodes[0].motion.site_from_node(100.0).angle() < 1e-15);
}

#[test]
fn rates_agree_with_the_turn_of_short_intervals() {
    let motion = node(0);
    for t_s in [10.0, 500.0, 1500.0] {
        let rate = so3::log(&motion.turn(t_s - 5e-4, t_s + 5e-4)) / 1e-3;
        assert!((rate - motion.rate_in_node_rad_s(t_s)).norm() < 1e-10);
        // The rate against the turning site is another one.
        let against_site = motion.site_from_node(t_s - 5e-4).inverse() * motion.site_from_node(t_s + 5e-4);
        let spin_rad_s = std::f64::consts::TAU / (4.3 * 3600.0);
        let difference = (so3::log(&against_site) / 1e-3 - motion.rate_in_node_rad_s(t_s)).norm();
        assert!((difference / spin_rad_s - 1.0).abs() < 1e-3);
    }
}

#[test]
fn gravity_and_apparent_forces_are_those_of_a_turning_body() {
    let body = TurningBody::new(&BodyConfig::default());
    let omega = body.rate_in_site_rad_s;
    assert!((omega.y / omega.norm() - 30_f64.to_radians().cos()).abs() < 1e-12 && omega.x == 0.0);
    // A free body in inertial axes keeps its velocity; seen from the turning site it accelerates by the apparent forces.
    let still = TurningBody::new(&BodyConfig { gm_m3_s2: 0.0, ..BodyConfig::default() });
    let (start, velocity) = (Vector3::new(30.0, -20.0, 350.0), Vector3::new(0.1, 0.2, -0.4));
    let seen = |t_s: f64| so3::exp(&(-omega * t_s)) * (start + Vector3::z() * 250.0 + velocity * t_s);
    let h = 0.5;
    let speed = (seen(h) - seen(-h)) / (2.0 * h);
    let acceleration = (seen(h) - seen(0.0) * 2.0 + seen(-h)) / (h * h);
    let found = still.free_acceleration_m_s2(&start, &speed);
    assert!((found - acceleration).norm() < 1e-9, "{found} and not {acceleration}");
    let weight = body.free_acceleration_m_s2(&start, &speed) - found;
    let rho = start + Vector3::z() * 250.0;
    assert!((weight + rho * (5.0 / rho.norm().powi(3))).norm() < 1e-15);
}

/// Strap-down integration in the turning site frame; `coriolis` false leaves the apparent forces of the turn out.
fn integrated(scene: &AttachmentScene, samples: &[ImuSample], with_turn: bool) -> [f64; 3] {
    let still = TurningBody::new(&BodyConfig { spin_period_h: 1e6, ..BodyConfig::default() });
    let body = if with_turn { scene.body } else { still };
    let omega = body.rate_in_site_rad_s;
    let first = &scene.nodes[0].states[0];
    let (mut attitude, mut position) = (first.site_from_lander.rotation, first.site_from_lander.translation.vector);
    let mut velocity = first.lander_velocity_in_site_m_s;
    let mut last_ns = 0;
    for sample in samples {
        let dt = (sample.t_ns - last_ns) as f64 * 1e-9;
        let turned = |share: f64| -> UnitQuaternion<f64> {
            so3::exp(&(omega * (-dt * share))) * attitude * so3::exp(&(sample.rate_in_lander_rad_s * (dt * share)))
        };
        let force = turned(0.5) * sample.specific_force_in_lander_m_s2;
        let rough = force + body.free_acceleration_m_s2(&position, &velocity);
        let middle = (position + velocity * (0.5 * dt), velocity + rough * (0.5 * dt));
        let acceleration = force + body.free_acceleration_m_s2(&middle.0, &middle.1);
        position += velocity * dt + acceleration * (0.5 * dt * dt);
        velocity += acceleration * dt;
        attitude = turned(1.0);
        last_ns = sample.t_ns;
    }
    let last = scene.nodes[0].states.last().expect("states");
    [
        (position - last.site_from_lander.translation.vector).norm(),
        (velocity - last.lander_velocity_in_site_m_s).norm(),
        attitude.minus(&last.site_from_lander.rotation).norm(),
    ]
}

#[test]
fn measurements_without_noise_integrate_back_to_the_motion() {
    let scene = attachment(QUIET);
    let samples = &scene.nodes[0].imu;
    assert_eq!((samples.len(), scene.nodes[0].states.len()), (18_000, 18_001));
    let [position_m, velocity_m_s, attitude_rad] = integrated(&scene, samples, true);
    println!("after 1800 s: {position_m:.2e} m, {velocity_m_s:.2e} m/s, {attitude_rad:.2e} rad");
    assert!(position_m < 1e-3 && velocity_m_s < 2e-6 && attitude_rad < 1e-9);
    // The check has to be able to fail: without the site's turn, and with the axes' signs changed.
    assert!(integrated(&scene, samples, false)[0] > 1.0);
    let flipped = samples.iter().map(|s| ImuSample { rate_in_lander_rad_s: -s.rate_in_lander_rad_s, ..*s });
    assert!(integrated(&scene, &flipped.collect::<Vec<_>>(), true)[2] > 1e-3);
}

#[test]
fn noise_and_biases_have_their_size() {
    let text = "[camera]\nwidth_px = 32\nheight_px = 32\n[attachment]\npicture_interval_s = 600\n";
    let (noisy, ideal) = (attachment(text), attachment(QUIET));
    let mut ratios = [0.0; 2];
    for (with, without) in noisy.nodes.iter().zip(&ideal.nodes) {
        for ((sample, clean), state) in with.imu.iter().zip(&without.imu).zip(&with.states[1..]) {
            assert_eq!(sample.t_ns, state.t_ns);
            let gyro = sample.rate_in_lander_rad_s - clean.rate_in_lander_rad_s - state.gyro_bias_rad_s;
            let force = sample.specific_force_in_lander_m_s2
                - clean.specific_force_in_lander_m_s2
                - state.accelerometer_bias_m_s2;
            let sigma = |density: f64| density * 10_f64.sqrt();
            ratios[0] += gyro.norm_squared() / (3.0 * sigma(0.05_f64.to_radians() / 60.0).powi(2));
            ratios[1] += force.norm_squared() / (3.0 * sigma(1e-4).powi(2));
        }
    }
    let count = 3.0 * 18_000.0;
    assert!(ratios.iter().all(|sum| (sum / count - 1.0).abs() < 0.02), "{ratios:?}");
    let biases = noisy.nodes.iter().map(|n| n.states[0].accelerometer_bias_m_s2.norm());
    assert!(biases.into_iter().all(|b| b > 1e-6 && b < 5e-4));
    let drift = noisy.nodes[0].states[0].gyro_bias_rad_s - noisy.nodes[0].states[18_000].gyro_bias_rad_s;
    assert!(drift.norm() > 1e-7, "the bias does not wander");
    let noise = noisy.imu_noise.bias.expect("the file tells how biases wander");
    assert!((noise.accelerometer_random_walk - 1e-4 * (2.0_f64 / 2000.0).sqrt()).abs() < 1e-15);
}

/// r_i = S r_j + s with S = C R_ij C and s = C R_iᵀ p_ij: the cameras' poses are those of the conventions.
#[test]
fn relative_poses_of_the_cameras_follow_from_the_nodes() {
    let scene = attachment(QUIET);
    let c = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
    for index in [0, 2, 3] {
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let [view_i, view_j] = [i, j].map(|k: usize| &scene.cameras[k].views[index]);
            let camera_i_from_j = view_i.reference_from_camera.inv_mul(&view_j.reference_from_camera);
            let [node_i, node_j] = [i, j].map(|k: usize| scene.nodes[k].motion.state(view_i.t_ns).site_from_lander);
            let rotation = (node_i.rotation.inverse() * node_j.rotation).to_rotation_matrix().into_inner();
            let baseline = node_i.rotation.inverse() * (node_j.translation.vector - node_i.translation.vector);
            let found = camera_i_from_j.rotation.to_rotation_matrix().into_inner();
            assert!((found - c * rotation * c).abs().max() < 1e-12);
            assert!((camera_i_from_j.translation.vector - c * baseline).norm() < 1e-9);
            assert!((found - rotation).abs().max() > 1e-4, "C has no part in it");
        }
    }
    let axis = scene.cameras[0].views[0].reference_from_camera * Vector3::z();
    assert!(axis.z < -0.99, "the camera does not look down: {axis}");
}

#[test]
fn the_sun_stands_still_among_the_stars_while_the_site_turns() {
    let scene = attachment(QUIET);
    let [first, last] = [0, 3].map(|index| &scene.cameras[0].views[index]);
    let turn = so3::exp(&(scene.body.rate_in_site_rad_s * (last.t_ns as f64 * 1e-9)));
    assert!((turn * last.sun_in_reference.into_inner() - first.sun_in_reference.into_inner()).norm() < 1e-12);
    assert!(last.sun_in_reference.dot(&first.sun_in_reference) < 0.9, "42° of turn move the Sun");
}

#[test]
fn cameras_and_nodes_are_named_and_seen_at_any_time() {
    let text = "[[cameras]]\nwidth_px = 32\n[[cameras]]\nwidth_px = 64\nturn_deg = [0, 10, 0]\n[attachment]\n\
                picture_interval_s = 900\n";
    let scenario = scenario(text).expect("a scenario");
    let scene = scenario.build(datasets()).expect("a scene");
    let names: Vec<String> = scene.cameras().iter().map(|camera| camera.id.to_string()).collect();
    assert_eq!(names, ["node0/cam0", "node0/cam1", "node1/cam0", "node1/cam1", "node2/cam0", "node2/cam1"]);
    for camera in scene.cameras() {
        for view in &camera.views {
            assert_eq!(*view, scene.view_at(camera, view.t_ns));
        }
    }
    let [straight, turned] = [2, 3].map(|k: usize| scene.cameras()[k].views[1].reference_from_camera);
    assert!((straight.rotation.angle_to(&turned.rotation).to_degrees() - 10.0).abs() < 1e-9);
}

#[test]
fn impossible_settings_are_refused_with_their_key() {
    let cases = [
        ("[attachment]\nnodes_m = []", "attachment.nodes_m"),
        ("[attachment]\npicture_interval_s = 0.05", "attachment.picture_interval_s"),
        ("[attachment.approach]\nfinal_position_m = [0, 0, -5]", "attachment.approach.duration_s"),
        ("[attachment.body]\nspin_period_h = 0", "attachment.body.spin_period_h"),
        ("[attachment.flex]\nlongest_period_s = 10", "attachment.flex.longest_period_s"),
        ("[attachment.imu]\nrate_hz = 7", "attachment.imu.rate_hz"),
        ("[attachment.terrain]\nalbedo = 0.1", "attachment.terrain.sky_light"),
    ];
    for (text, key) in cases {
        let error = scenario(text).expect_err("refused").to_string();
        assert!(error.contains("test.toml") && error.contains(&format!("{key} is ")), "{text}: {error}");
    }
}
