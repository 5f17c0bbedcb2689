//! Stars in pictures.

use super::{look_at, plain, render, sphere};
use nalgebra::{Unit, UnitQuaternion, Vector2, Vector3};
use opnav::geometry::{Camera, Distortion};
use opnav::render::{RenderConfig, RenderedFrame, World, add_stars};
use opnav::scene::{Sky, SmallBody, Star};
use opnav::stats::random_stream;
use rand::RngExt;

const SIZE_PX: u32 = 96;

fn camera() -> Camera {
    Camera::from_fov(SIZE_PX, SIZE_PX, 0.4)
}

/// A sphere in the middle of the picture, a third as wide; the camera looks along -z, x to the right.
fn picture() -> RenderedFrame {
    let body = SmallBody { mesh: sphere(40, |_| 10.0), surface: plain() };
    let view = look_at(Vector3::new(0.0, 0.0, 150.0), Vector3::zeros(), Vector3::y(), Vector3::new(1.0, 1.0, 1.0));
    render(World::Body(&body), &camera(), &RenderConfig::default(), &view)
}

fn sky(stars: Vec<Star>) -> Sky {
    Sky { stars, zero_point_if_px: Some(2.0), sun_distance_au: 1.0 }
}

fn star(camera: &Camera, pixel: Vector2<f64>, magnitude: f64) -> Star {
    Star { direction: camera.unproject(&pixel).expect("a bearing"), magnitude }
}

/// What one star adds to a picture: its light, and the centroid of it.
fn added(before: &RenderedFrame, camera: &Camera, star: Star, turn: &UnitQuaternion<f64>) -> (f64, Vector2<f64>) {
    let mut after = before.clone();
    let inertial = Star { direction: turn.inverse() * star.direction, ..star };
    add_stars(&mut after, camera, &sky(vec![inertial]), turn);
    let (mut light, mut moment) = (0.0, Vector2::zeros());
    for (v, u) in (0..SIZE_PX).flat_map(|v| (0..SIZE_PX).map(move |u| (v, u))) {
        let more = f64::from(after.radiance[after.index(u, v)]) - f64::from(before.radiance[before.index(u, v)]);
        light += more;
        moment += more * Vector2::new(f64::from(u), f64::from(v));
    }
    assert_eq!((&after.mask, after.depth_m.len()), (&before.mask, before.depth_m.len()), "truth stays as it is");
    (light, moment / light)
}

#[test]
fn a_stars_light_lies_around_its_place() {
    let before = picture();
    let turn = UnitQuaternion::from_euler_angles(0.3, -1.1, 2.0);
    let mut random = random_stream(3, "star", 0);
    let bent = Camera { distortion: Distortion::RadialTangential([-0.2, 0.05, 1e-3, -5e-4]), ..camera() };
    let mut off_px: f64 = 0.0;
    for k in 0..200 {
        let camera = if k % 2 == 0 { camera() } else { bent };
        let pixel = Vector2::new(random.random_range(1.0..94.0), random.random_range(1.0..20.0));
        let magnitude = random.random_range(-1.0..4.0);
        let (light, centroid) = added(&before, &camera, star(&camera, pixel, magnitude), &turn);
        let expected = 2.0 * 10.0_f64.powf(-0.4 * magnitude);
        assert!((light / expected - 1.0).abs() < 1e-5, "{light} for {expected}");
        off_px = off_px.max((centroid - pixel).amax());
    }
    println!("centroids are off by {off_px:.1e} px at most");
    assert!(off_px < 0.01, "off by {off_px} px");
    // A place half a pixel beside is told apart.
    let (_, centroid) = added(&before, &camera(), star(&camera(), Vector2::new(30.5, 10.0), 0.0), &turn);
    assert!((centroid - Vector2::new(30.0, 10.0)).amax() > 0.4);
}

#[test]
fn the_body_hides_stars_and_the_edge_cuts_them() {
    let (before, camera, turn) = (picture(), camera(), UnitQuaternion::identity());
    let (mut hidden, mut seen) = (0, 0);
    for (v, u) in (0..SIZE_PX).step_by(3).flat_map(|v| (0..SIZE_PX).step_by(3).map(move |u| (v, u))) {
        let on_body = before.mask[before.index(u, v)] & RenderedFrame::BODY != 0;
        let place = Vector2::new(f64::from(u) + 0.2, f64::from(v) - 0.3);
        let inside = place.y >= 0.0;
        let (light, _) = added(&before, &camera, star(&camera, place, 0.0), &turn);
        assert_eq!(light.abs() < 1e-12, on_body, "light {light} at {u}, {v}");
        assert!(on_body || !inside || (light - 2.0).abs() < 1e-4, "light {light} at {u}, {v}");
        hidden += u32::from(on_body);
        seen += u32::from(!on_body);
    }
    assert!(hidden > 50 && seen > 500, "{hidden} hidden, {seen} seen");
    // Half a pixel outside the outermost centres, half the light is lost; behind the camera or far outside, all of it.
    let (light, _) = added(&before, &camera, star(&camera, Vector2::new(-0.5, 40.0), 0.0), &turn);
    assert!((light - 1.0).abs() < 1e-5, "{light}");
    for direction in [Vector3::new(0.0, 0.1, -1.0), Vector3::new(1.0, 0.0, 0.5), Vector3::new(0.0, 1.0, 0.0)] {
        let away = Star { direction: Unit::new_normalize(direction), magnitude: -5.0 };
        assert_eq!(added(&before, &camera, away, &turn).0, 0.0, "{direction:?}");
    }
}
