//! Several cameras on one spacecraft, and what a picture's depths tell.

use crate::scene::{datasets, scenario};
use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector2, Vector3};
use opnav::geometry::{Camera, Distortion, so3};
use opnav::scene::{DepthImage, Scenario, Scene, View, optical_flow};

const TWO: &str = "[sensor]\nbits = 6\n[[cameras]]\nwidth_px = 64\nheight_px = 64\n[[cameras]]\nwidth_px = 96\nheight_px = 48\n\
                   fov_deg = 50\nturn_deg = [0, 20, 0]\noffset_m = [0.5, 0, 0.1]\n[cameras.sensor]\nbits = 7\n";

#[test]
fn each_camera_has_its_lens_its_place_and_its_detector() {
    for mission in ["[descent]\n", "[tumbling]\nframes = 4\n"] {
        let found = scenario(&format!("{TWO}{mission}")).expect("a scenario");
        assert_eq!(found, scenario(&found.to_toml()).expect("the resolved copy"), "{}", found.to_toml());
        let scene = found.build(datasets()).expect("a scene");
        let [first, second] = scene.cameras() else { panic!("two cameras expected") };
        assert_eq!((first.id.to_string(), second.id.to_string()), ("cam0".into(), "cam1".into()));
        assert_eq!((first.detector.bits, second.detector.bits), (6, 7));
        assert_eq!((second.sensor.camera.width_px, second.sensor.camera.height_px), (96, 48));
        let [a, b] = [first, second].map(|camera| camera.sensor.spacecraft_from_camera);
        let turn = so3::exp(&Vector3::new(0.0, 20_f64.to_radians(), 0.0));
        assert!((a.rotation * turn).angle_to(&b.rotation) < 1e-12);
        assert!((b.translation.vector - a.translation.vector - Vector3::new(0.5, 0.0, 0.1)).norm() < 1e-12);
        for (one, other) in first.views.iter().zip(&second.views) {
            assert_eq!(one.t_ns, other.t_ns);
            let spacecraft = one.reference_from_camera * a.inverse();
            assert!(
                (spacecraft * b).translation.vector.metric_distance(&other.reference_from_camera.translation.vector)
                    < 1e-8
            );
            assert_eq!(*other, scene.view_at(second, other.t_ns));
        }
        // Between pictures the view lies between theirs.
        let [t0, t1] = [second.views[0], second.views[1]];
        let middle = scene.view_at(second, (t0.t_ns + t1.t_ns) / 2);
        let angles =
            [t0, t1].map(|v| v.reference_from_camera.rotation.angle_to(&middle.reference_from_camera.rotation));
        let whole = t0.reference_from_camera.rotation.angle_to(&t1.reference_from_camera.rotation);
        assert!((angles[0] + angles[1] - whole).abs() < 0.02 * whole + 1e-9, "{angles:?} {whole}");
    }
}

#[test]
fn one_camera_reads_as_before_and_a_default_camera_changes_nothing() {
    let plain = scenario("[descent]").expect("a scenario");
    assert_eq!(plain.imagers.len(), 1);
    let listed = scenario("[[cameras]]\n[descent]").expect("a scenario");
    assert_eq!(plain.imagers, listed.imagers);
    let (Scene::Descent(a), Scene::Descent(b)) =
        (plain.build(datasets()).expect("a scene"), listed.build(datasets()).expect("a scene"))
    else {
        panic!("not a descent")
    };
    assert_eq!(a, b);
}

#[test]
fn faults_of_a_camera_are_named_with_its_place() {
    let error = |text: &str| scenario(text).expect_err("refused").to_string();
    assert!(error("[[cameras]]\n[[cameras]]\nfov_deg = 190\n[descent]").contains("cameras[1].fov_deg is 190"));
    assert!(
        error("[[cameras]]\n[[cameras]]\n[cameras.sensor]\nbits = 40\n[descent]").contains("cameras[1].sensor.bits")
    );
    assert!(error("[camera]\nturn_deg = [0, 270, 0]\n[descent]").contains("camera.turn_deg is 270"));
    let both = error("[camera]\nwidth_px = 64\n[[cameras]]\nwidth_px = 64\n[descent]");
    assert!(both.contains("[camera]") && both.contains("[[cameras]]"), "{both}");
    let set = |line: &str| Scenario::parse("[[cameras]]\n[[cameras]]\n[descent]", "test.toml".as_ref(), &[line.into()]);
    assert_eq!(set("cameras.1.fov_deg=50").expect("a scenario").imagers[1].camera.fov_deg, 50.0);
    assert!(
        set("cameras.2.fov_deg=50")
            .expect_err("refused")
            .to_string()
            .contains("--set cameras.2.fov_deg=50: there is no entry 2")
    );
    let unknown = Scenario::parse("[truth]\nsmell = true\n[descent]", "test.toml".as_ref(), &[]);
    assert!(unknown.expect_err("refused").to_string().contains("smell"));
}

// ------------------------------------------------------------------------------------------------------- optical flow

fn view(camera_in_reference_m: Vector3<f64>, rotation: UnitQuaternion<f64>) -> View {
    View {
        t_ns: 0,
        reference_from_camera: Isometry3::from_parts(Translation3::from(camera_in_reference_m), rotation),
        sun_in_reference: Unit::new_normalize(Vector3::z()),
        sun_angular_radius_rad: 0.0,
    }
}

/// z-depth of what a function of rays meets: a point and a direction in the reference frame give a distance along it.
fn depths(camera: &Camera, view: &View, meet: impl Fn(Vector3<f64>, Vector3<f64>) -> f64) -> Vec<f32> {
    let eye = view.reference_from_camera.translation.vector;
    let depth = |index: u32| {
        let pixel = Vector2::new(f64::from(index % camera.width_px), f64::from(index / camera.width_px));
        let ideal = camera.normalize(&pixel).expect("an invertible lens").push(1.0);
        meet(eye, view.reference_from_camera.rotation * ideal) as f32
    };
    (0..camera.width_px * camera.height_px).map(depth).collect()
}

fn plane(eye: Vector3<f64>, ray: Vector3<f64>) -> f64 {
    (100.0 - eye.z) / ray.z
}

#[test]
fn flow_of_a_plane_is_the_exact_motion_for_every_lens() {
    let lenses = [
        Distortion::None,
        Distortion::RadialTangential([-0.2, 0.05, 1e-3, -2e-3]),
        Distortion::Equidistant([0.01, -0.003, 0.0, 0.0]),
    ];
    for distortion in lenses {
        let camera = Camera { distortion, ..Camera::from_fov(64, 48, 1.2) };
        let first = view(Vector3::new(1.0, -2.0, 0.0), UnitQuaternion::identity());
        let next = view(Vector3::new(4.0, -1.0, 12.0), so3::exp(&Vector3::new(0.01, -0.02, 0.1)));
        let [a, b] = [&first, &next].map(|v| depths(&camera, v, plane));
        let [depth, next_depth] = [&a, &b].map(|d| DepthImage { width_px: 64, depth_m: d });
        let flow = optical_flow(&camera, (&first, &depth), (&next, &next_depth));
        let exact = |index: usize, from: &View, to: &View| {
            let pixel = Vector2::new((index % 64) as f64, (index / 64) as f64);
            let ray = from.reference_from_camera.rotation * camera.normalize(&pixel).expect("invertible").push(1.0);
            let eye = from.reference_from_camera.translation.vector;
            let point = Point3::from(eye + ray * plane(eye, ray));
            camera.project(&to.reference_from_camera.inverse_transform_point(&point).coords).map(|p| p - pixel)
        };
        let worst = |from: &View, to: &View| {
            let error = |(index, motion): (usize, &Vector2<f32>)| {
                Some((exact(index, from, to)? - motion.map(f64::from)).norm()).filter(|e| e.is_finite())
            };
            flow.motion_px.iter().enumerate().filter_map(error).fold(0.0, f64::max)
        };
        let known = flow.motion_px.iter().filter(|m| m.x.is_finite()).count();
        assert!(known > 64 * 48 / 2, "{known} pixels have flow");
        assert!(worst(&first, &next) < 1e-4, "{}", worst(&first, &next));
        assert!(worst(&next, &first) > 1.0, "the other direction passes too");
    }
}

/// A post in front of a wall: what it hides in the next picture has no flow, what it does not hide has.
#[test]
fn what_is_hidden_in_the_next_image_has_no_flow() {
    let camera = Camera::from_fov(200, 20, 1.0);
    let scene = |eye: Vector3<f64>, ray: Vector3<f64>| {
        let near = (20.0 - eye.z) / ray.z;
        let x = eye.x + ray.x * near;
        if (-1.0..1.0).contains(&x) { near } else { plane(eye, ray) }
    };
    let first = view(Vector3::zeros(), UnitQuaternion::identity());
    let next = view(Vector3::new(3.0, 0.0, 0.0), UnitQuaternion::identity());
    let [a, b] = [&first, &next].map(|v| depths(&camera, v, scene));
    let [depth, next_depth] = [&a, &b].map(|d| DepthImage { width_px: 200, depth_m: d });
    let flow = optical_flow(&camera, (&first, &depth), (&next, &next_depth));
    let mut counts = [0; 2];
    for u in 0..200_usize {
        let index = 10 * 200 + u;
        let point = Vector3::new((u as f64 - camera.center_px.x) / camera.focal_px.x, 0.0, 1.0) * f64::from(a[index]);
        // The ray from the next camera to a wall point passes the post's plane at a fifth of the way.
        let crossing = 3.0 + (point.x - 3.0) * 0.2;
        let edge = (crossing.abs() - 1.0).abs() < 0.3;
        let inside = camera.project(&(point - Vector3::x() * 3.0)).is_some_and(|p| camera.contains(&p, 1.0));
        if edge || !inside || point.z < 50.0 {
            continue;
        }
        let hidden = crossing.abs() < 1.0;
        assert_eq!(flow.motion_px[index].x.is_nan(), hidden, "column {u}");
        counts[usize::from(hidden)] += 1;
    }
    assert!(counts[0] > 50 && counts[1] > 3, "{counts:?}");
}
