//! Radiance, shadow and albedo.

use crate::render::{flat, inner, lobed, look_at, look_down, nearest_hit, plain, ray, render, sphere};
use nalgebra::{Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderedFrame, World};
use opnav::scene::{BodySurface, GroundDetail, LunarWeight, Photometry, SmallBody, Terrain};

#[test]
fn lit_pixels_are_those_that_see_the_sun() {
    let body = SmallBody { mesh: lobed(40), surface: plain() };
    let camera = Camera::from_fov(256, 256, 0.4);
    let eye = Vector3::new(300.0, 1700.0, 500.0);
    let view = look_at(eye, Vector3::zeros(), Vector3::z(), Vector3::new(1.0, 0.35, 0.1));
    let frame = render(World::Body(&body), &camera, &RenderConfig::default(), &view);
    let sun = view.sun_in_reference.into_inner();
    let (mut shadowed, mut agree, mut total) = (0, 0, 0);
    for state in [RenderedFrame::BODY, RenderedFrame::BODY | RenderedFrame::LIT] {
        let same = inner(&frame, 2, |i| frame.mask[i] & !RenderedFrame::TERMINATOR == state);
        for (u, v) in same.iter().step_by(11) {
            let direction = ray(&camera, &view, *u, *v);
            let (t, face) = nearest_hit(&body.mesh, &eye, &direction).expect("the body is hit");
            let place = eye + direction * t;
            let [a, b, c] = body.mesh.faces[face].map(|i| body.mesh.vertices_m[i as usize]);
            let normal = (b - a).cross(&(c - a)).normalize();
            let faces_sun = normal.dot(&sun) > 0.0;
            let blocked = nearest_hit(&body.mesh, &(place + normal * 0.5), &sun).is_some();
            shadowed += u32::from(faces_sun && blocked);
            total += 1;
            agree += u32::from((faces_sun && !blocked) == (state & RenderedFrame::LIT != 0));
        }
    }
    println!("{agree} of {total} agree, {shadowed} in cast shadow");
    assert!(total > 1000 && shadowed > 40, "the scene casts shadows: {shadowed} of {total}");
    assert!(f64::from(agree) > 0.97 * f64::from(total), "{agree} of {total} agree");
}

#[test]
fn a_sphere_shines_as_its_formula_says() {
    let camera = Camera::from_fov(256, 256, 0.3);
    let eye = Vector3::new(1000.0, 0.0, 0.0);
    let view = look_at(eye, Vector3::zeros(), Vector3::z(), Vector3::new(1.0, 1.2, 0.3));
    for weight in [0.0, 0.6, 1.0] {
        let photometry = Photometry::LunarLambert { weight: LunarWeight::Constant(weight) };
        let body = SmallBody { mesh: sphere(160, |_| 100.0), surface: BodySurface { photometry, ..plain() } };
        let frame = render(World::Body(&body), &camera, &RenderConfig::default(), &view);
        let mut checked = 0;
        for (u, v) in inner(&frame, 2, |i| frame.mask[i] & RenderedFrame::LIT != 0) {
            let direction = ray(&camera, &view, u, v).normalize();
            let along = -eye.dot(&direction);
            let normal = (eye + direction * (along - (along * along - 99e4).max(0.0).sqrt())).normalize();
            let (sun_cosine, view_cosine) = (normal.dot(&view.sun_in_reference), -normal.dot(&direction));
            if sun_cosine < 0.1 || view_cosine < 0.2 {
                continue;
            }
            let lunar = 2.0 * weight / (sun_cosine + view_cosine) + 1.0 - weight;
            let expected = 0.5 * sun_cosine * lunar;
            let found = f64::from(frame.radiance[frame.index(u, v)]);
            assert!((found / expected - 1.0).abs() < 0.01, "{found} for {expected} at {u}, {v}, weight {weight}");
            checked += 1;
        }
        assert!(checked > 3000);
    }
}

#[test]
fn the_terminator_band_lies_between_80_and_100_degrees() {
    let body = SmallBody { mesh: sphere(120, |_| 100.0), surface: BodySurface::default() };
    let camera = Camera::from_fov(128, 128, 0.3);
    let eye = Vector3::new(1000.0, 0.0, 0.0);
    let view = look_at(eye, Vector3::zeros(), Vector3::z(), Vector3::y());
    let frame = render(World::Body(&body), &camera, &RenderConfig::default(), &view);
    for (u, v) in inner(&frame, 1, |i| frame.mask[i] & RenderedFrame::BODY != 0) {
        let direction = ray(&camera, &view, u, v).normalize();
        let along = -eye.dot(&direction);
        let normal = (eye + direction * (along - (along * along - 99e4).max(0.0).sqrt())).normalize();
        let incidence = normal.y.acos().to_degrees();
        let marked = frame.mask[frame.index(u, v)] & RenderedFrame::TERMINATOR != 0;
        if (incidence - 90.0).abs() < 9.0 {
            assert!(marked, "incidence {incidence} at {u}, {v}");
        } else if (incidence - 90.0).abs() > 11.0 {
            assert!(!marked, "incidence {incidence} at {u}, {v}");
        }
    }
}

#[test]
fn albedo_in_the_image_is_that_of_the_terrain() {
    let terrain = Terrain::new(&flat(), 4);
    let stranger = Terrain::new(&flat(), 5);
    let camera = Camera::from_fov(256, 256, 1.2);
    for (place, height_m) in [([3300.0, 5870.0], 6570.0), ([20_000.0, -15_000.0], 40.0), ([0.3, 0.2], 3.0)] {
        let view = look_down(&terrain, place, height_m);
        let config = RenderConfig { supersampling: 1, ..RenderConfig::default() };
        let frame = render(World::Terrain(&terrain), &camera, &config, &view);
        let eye = view.reference_from_camera.translation.vector;
        let (mut off, mut off_stranger): (f64, f64) = (0.0, 0.0);
        for (u, v) in (0..256).flat_map(|v| (0..256).map(move |u| (u, v))).step_by(29) {
            let direction = ray(&camera, &view, u, v);
            let at = eye + direction * (-eye.z / direction.z);
            let cosine = -direction.normalize().z;
            let footprint_m = eye.z / camera.mean_focal_px() / cosine.sqrt();
            let detail = GroundDetail { footprint_m, ..GroundDetail::default() };
            let albedo = |t: &Terrain| t.albedo_from_change(t.sample(at.x, at.y, &detail).albedo_change);
            let found = f64::from(frame.radiance[frame.index(u, v)]) / view.sun_in_reference.z;
            off = off.max((found - albedo(&terrain)).abs());
            off_stranger = off_stranger.max((found - albedo(&stranger)).abs());
        }
        println!("{height_m} m: albedo off by {off:.1e}, another terrain's by {off_stranger:.1e}");
        assert!(off < 1e-3, "albedo off by {off} from {height_m} m");
        assert!(off_stranger > 0.02, "the test can tell one terrain from another");
    }
}

/// Nothing shadows a sphere but itself: every pixel that faces the Sun is lit, however few there are.
#[test]
fn a_sphere_of_any_size_in_the_image_is_lit_where_it_faces_the_sun() {
    let body = SmallBody { mesh: sphere(160, |_| 100.0), surface: plain() };
    let camera = Camera { center_px: Vector2::new(79.8, 80.1), ..Camera::from_fov(160, 160, 0.3) };
    for (radius_px, least) in [(2.0, 8), (5.0, 50), (20.0, 1000), (60.0, 9000)] {
        let eye = Vector3::new(100.0 * camera.focal_px.x / radius_px, 0.0, 0.0);
        for sun in [Vector3::x(), Vector3::new(1.0, 0.6, 0.3)] {
            let view = look_at(eye, Vector3::zeros(), Vector3::z(), sun);
            let frame = render(World::Body(&body), &camera, &RenderConfig::default(), &view);
            let pixels = (0..160).flat_map(|v| (0..160).map(move |u| (u, v)));
            let (mut facing, mut dark) = (0, 0);
            for (u, v) in pixels.filter(|(u, v)| frame.mask[frame.index(*u, *v)] & RenderedFrame::BODY != 0) {
                let direction = ray(&camera, &view, u, v).normalize();
                let along = -eye.dot(&direction);
                let below = (along * along - eye.norm_squared() + 1e4).max(0.0).sqrt();
                let normal = (eye + direction * (along - below)).normalize();
                if normal.dot(&view.sun_in_reference) > 0.3 {
                    facing += 1;
                    let lit = frame.mask[frame.index(u, v)] & RenderedFrame::LIT != 0;
                    dark += usize::from(!lit || frame.radiance[frame.index(u, v)] < 0.02);
                }
            }
            println!("{radius_px} px, Sun {:?}: {dark} of {facing} px dark", sun.as_slice());
            assert!(
                facing >= least / 2 && dark == 0,
                "{radius_px} px: {dark} of {facing} px that face the Sun are dark"
            );
        }
    }
}
