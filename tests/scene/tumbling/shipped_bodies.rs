//! Where the camera stands before a tumbling body, and the motion of the scenarios that are hard to observe.

use crate::scene::{datasets, scenario, tumbling};
use nalgebra::{Matrix3, Vector3};
use opnav::scene::{RigidBody, Scenario, Scene, Spin, TumblingScene};

fn shipped(name: &str) -> TumblingScene {
    match Scenario::read(&datasets().join(name), &[]).unwrap().build(datasets()).unwrap() {
        Scene::Tumbling(scene) => *scene,
        _ => panic!("{name} is a descent"),
    }
}

/// Largest relative change of energy and of momentum over the scene's states.
fn drift(scene: &TumblingScene, inertia: &Matrix3<f64>) -> f64 {
    let body = RigidBody::new(inertia).unwrap();
    let spin = |k: usize| Spin {
        asteroid_from_inertial: scene.states[k].asteroid_from_inertial,
        rate_in_asteroid_rad_s: scene.states[k].rate_in_asteroid_rad_s,
    };
    let (energy, momentum) = (body.doubled_energy(&spin(0)), body.momentum_in_inertial(&spin(0)));
    let change = |k: usize| {
        let of_energy = (body.doubled_energy(&spin(k)) / energy - 1.0).abs();
        of_energy.max((body.momentum_in_inertial(&spin(k)) - momentum).norm() / momentum.norm())
    };
    (0..scene.states.len()).map(change).fold(0.0, f64::max)
}

#[test]
fn near_spin_body_nutates_by_a_degree() {
    let scene = shipped("tumbling_near_spin.toml");
    let inertia = scene.inertia.matrix();
    let axes = inertia.symmetric_eigen();
    let axis = axes.eigenvectors.column(axes.eigenvalues.imax()).into_owned();
    let nutation_deg = |w: &Vector3<f64>| (w.dot(&axis).abs() / w.norm()).acos().to_degrees();
    assert!((nutation_deg(&scene.states[0].rate_in_asteroid_rad_s) - 1.0).abs() < 1e-3);
    for state in &scene.states {
        assert!((nutation_deg(&state.rate_in_asteroid_rad_s) - 1.0).abs() < 0.8);
        assert!((state.rate_in_asteroid_rad_s.norm().to_degrees() - 6.0).abs() < 0.01);
    }
    assert!(drift(&scene, &inertia) < 1e-10);
    // The check can tell another body.
    assert!(drift(&scene, &Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 2.25))) > 1e-4);
}

#[test]
fn separatrix_body_flips_once_about_its_middle_axis() {
    let scene = shipped("tumbling_separatrix.toml");
    let inertia = scene.inertia.matrix();
    let moments = Vector3::new(1.0, 2.0, 2.25);
    assert!((inertia * 2.25 - Matrix3::from_diagonal(&moments)).abs().max() < 1e-12);
    assert!(drift(&scene, &inertia) < 1e-10);
    let rate = |k: usize| scene.states[k].rate_in_asteroid_rad_s;
    let momentum = inertia * rate(0);
    let off_separatrix = momentum.norm_squared() / (rate(0).dot(&momentum) * inertia[(1, 1)]) - 1.0;
    assert!(off_separatrix.abs() < 1e-5, "{off_separatrix}");
    // Exact on the separatrix, with the flip at t = 120 s: ω = ω∞ (√(8/5)/2 sech, tanh, √(32/45)·sech) of p (t - 120 s).
    let at_infinity = 4.0_f64.to_radians();
    let p = at_infinity / 3.0;
    for (k, state) in scene.states.iter().enumerate() {
        let x: f64 = p * (state.t_ns as f64 * 1e-9 - 120.0);
        let sech = 1.0 / x.cosh();
        let unit = 1.0 / 1.40625_f64.sqrt(); // of J₂ω∞ when ω₁ = 3/4 and ω₃ = 1 at the flip
        let expected = Vector3::new(0.75 * unit * sech, x.tanh(), unit * sech) * at_infinity;
        assert!((rate(k) - expected).norm() < 2e-3 * at_infinity, "frame {k}: {} {expected}", rate(k));
    }
    let signs: Vec<bool> = (0..scene.states.len()).map(|k| rate(k).y > 0.0).collect();
    assert_eq!(signs.windows(2).filter(|pair| pair[0] != pair[1]).count(), 1);
    let last = rate(scene.states.len() - 1);
    assert!(rate(0).y < -0.98 * rate(0).norm() && last.y > 0.98 * last.norm(), "{} {last}", rate(0));
}

const SPHERE: &str = "[camera]\nwidth_px = 64\nheight_px = 64\n[tumbling]\nframes = 5\nKEYS\n\
[tumbling.shape.procedural]\nsemi_axes_m = [100, 100, 100]\nrelief = 0.0\ncraters = 0\nsubdivisions = 5\n";

fn distances_m(keys: &str) -> Vec<f64> {
    let scene = tumbling(&SPHERE.replace("KEYS", keys));
    scene.cameras[0].views.iter().map(|view| view.reference_from_camera.translation.vector.norm()).collect()
}

#[test]
fn camera_stands_at_the_distance_it_is_given() {
    for distance_m in [100.5, 110.0, 10_000.0] {
        let found = distances_m(&format!("distance_m = {distance_m}"));
        assert!(found.iter().all(|d| (d - distance_m).abs() < 1e-9 * distance_m), "{found:?}");
    }
    // 10 m above faces that lie up to 3 cm within the sphere.
    let hover = distances_m("range_m = 10");
    assert!(hover.iter().all(|d| (109.95..110.001).contains(d)), "{hover:?}");
    let offset = distances_m("range_m = 10\ncenter_offset_px = [20, -10]");
    assert!(offset.iter().all(|d| (109.95..110.001).contains(d)), "{offset:?}");
    let approach = distances_m("distance_m = 500\napproach_m_s = 25");
    for (k, distance_m) in approach.iter().enumerate() {
        assert!((distance_m - (500.0 - 25.0 * k as f64)).abs() < 1e-9);
    }
}

#[test]
fn impossible_distances_name_their_key() {
    let fault = |keys: &str| {
        let scenario = match scenario(&SPHERE.replace("KEYS", keys)) {
            Ok(scenario) => scenario,
            Err(error) => return error.to_string(),
        };
        scenario.build(datasets()).unwrap_err().to_string()
    };
    let inside = fault("distance_m = 99");
    assert!(inside.contains("tumbling.distance_m is 99") && inside.contains("inside the body"), "{inside}");
    assert!(fault("distance_m = -5").contains("tumbling.distance_m is -5"));
    assert!(fault("distance_m = 500\nrange_m = 5").contains("drop one"));
    let past = fault("distance_m = 500\napproach_m_s = 200");
    assert!(past.contains("tumbling.approach_m_s is 200"), "{past}");
}

#[test]
fn camera_may_stand_in_a_hollow_inside_the_bounding_sphere() {
    // The middle of Itokawa's side is 150 m or so from its centre, its ends twice that.
    let text = "[tumbling]\nframes = 1\nasteroid_from_inertial = [0.5, -0.5, -0.5, -0.5]\nrange_m = 10\n\
                [tumbling.shape.mesh]\npath = \"shapes/itokawa.obj\"\nunit = \"km\"\n";
    let scene = tumbling(text);
    let camera_m = scene.cameras[0].views[0].reference_from_camera.translation.vector;
    assert!(camera_m.norm() < 0.8 * scene.body.mesh.radius_m(), "{camera_m}");
    assert_eq!(scene.body.mesh.surrounds(&camera_m), 0);
    assert_eq!(scene.body.mesh.surrounds(&(camera_m * 0.8)), 1);
}
