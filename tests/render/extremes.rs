//! Odd input: a clear error or a picture, never a panic and never black by accident.

use super::{gpu, lobed, look_at, look_down, plain, render};
use nalgebra::{Unit, Vector3};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderError, RenderedFrame, Renderer, World};
use opnav::scene::{Mesh, SmallBody, Terrain, TerrainConfig, View};

fn from_outside() -> View {
    look_at(Vector3::new(900.0, 800.0, 300.0), Vector3::zeros(), Vector3::z(), Vector3::new(1.0, 0.6, 0.5))
}

fn new_error(mesh: Mesh, camera: &Camera) -> String {
    let body = SmallBody { mesh, surface: plain() };
    Renderer::new(&gpu(), World::Body(&body), camera, &RenderConfig::default()).expect_err("refused").to_string()
}

#[test]
fn the_smallest_images_are_images() {
    let terrain = Terrain::new(&TerrainConfig::default(), 3);
    let body = SmallBody { mesh: lobed(20), surface: plain() };
    for (width_px, height_px) in [(1, 1), (1, 37), (41, 1), (3, 2)] {
        let count = (width_px * height_px) as usize;
        let camera = Camera::from_fov(width_px, height_px, 0.3);
        let ground =
            render(World::Terrain(&terrain), &camera, &RenderConfig::default(), &look_down(&terrain, [5.0, 9.0], 80.0));
        assert_eq!((ground.radiance.len(), ground.depth_m.len(), ground.mask.len()), (count, count, count));
        assert!(ground.radiance.iter().all(|r| *r > 0.0), "{width_px}x{height_px} px of ground: {:?}", ground.radiance);
        let body = render(World::Body(&body), &camera, &RenderConfig::default(), &from_outside());
        assert!(body.depth_m.iter().any(|d| (800.0..1300.0).contains(d)), "{width_px}x{height_px} px of body");
    }
}

#[test]
fn a_mesh_with_a_vertex_that_is_no_number_is_refused_by_name() {
    for bad in [f64::NAN, f64::INFINITY] {
        let mut mesh = lobed(8);
        mesh.vertices_m[17].y = bad;
        let message = new_error(mesh, &Camera::from_fov(64, 48, 0.5));
        assert!(message.contains("17"), "{message}");
    }
    let message = new_error(Mesh::default(), &Camera::from_fov(64, 48, 0.5));
    assert!(message.contains("no faces"), "{message}");
}

#[test]
fn faces_without_area_change_nothing() {
    let mesh = lobed(24);
    let mut folded = mesh.clone();
    let lone = folded.vertices_m.len() as u32;
    folded.vertices_m.push(Vector3::new(10.0, 20.0, 30.0));
    folded.faces.extend([[5, 5, 5], [7, 8, 7], [lone, lone, lone]]);
    let camera = Camera::from_fov(157, 131, 0.6);
    let picture = |mesh: Mesh| {
        let body = SmallBody { mesh, surface: plain() };
        render(World::Body(&body), &camera, &RenderConfig::default(), &from_outside())
    };
    let (clean, odd) = (picture(mesh), picture(folded));
    let bits = |values: &[f32]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&clean.radiance), bits(&odd.radiance));
    assert_eq!(bits(&clean.depth_m), bits(&odd.depth_m));
    assert_eq!(clean.mask, odd.mask);
}

#[test]
fn cameras_without_a_image_are_refused() {
    let plain_camera = Camera::from_fov(64, 48, 0.5);
    for camera in [
        Camera { width_px: 0, ..plain_camera },
        Camera { height_px: 0, ..plain_camera },
        Camera { focal_px: plain_camera.focal_px * f64::NAN, ..plain_camera },
        Camera { center_px: plain_camera.center_px * f64::INFINITY, ..plain_camera },
        Camera { width_px: u32::MAX, ..plain_camera },
    ] {
        let message = new_error(lobed(8), &camera);
        assert!(!message.is_empty());
    }
}

#[test]
fn a_sun_that_is_no_direction_is_refused() {
    let body = SmallBody { mesh: lobed(8), surface: plain() };
    let camera = Camera::from_fov(64, 48, 0.5);
    let mut renderer = Renderer::new(&gpu(), World::Body(&body), &camera, &RenderConfig::default()).expect("ready");
    let view = View { sun_in_reference: Unit::new_unchecked(Vector3::repeat(f64::NAN)), ..from_outside() };
    assert!(matches!(renderer.render(&view), Err(RenderError::ViewNotFinite { .. })));
}

#[test]
fn a_body_far_away_or_behind_is_an_empty_image() {
    let body = SmallBody { mesh: lobed(20), surface: plain() };
    let camera = Camera::from_fov(64, 48, 0.5);
    let eye = Vector3::new(900.0, 800.0, 300.0);
    let away = look_at(eye, 2.0 * eye, Vector3::z(), Vector3::x());
    let far = look_at(1e7 * eye, Vector3::zeros(), Vector3::z(), Vector3::new(1.0, 0.9, 0.4));
    let mut renderer = Renderer::new(&gpu(), World::Body(&body), &camera, &RenderConfig::default()).expect("ready");
    for view in [away, far] {
        let frame = renderer.render(&view).expect("a picture");
        assert!(frame.radiance.iter().all(|r| r.is_finite() && *r >= 0.0));
        let nothing = |i: usize| frame.depth_m[i].is_nan() == (frame.mask[i] & RenderedFrame::BODY == 0);
        assert!((0..frame.mask.len()).all(nothing), "depth and mask disagree");
    }
    let frame = renderer.render(&away).expect("a picture");
    assert!(frame.mask.iter().all(|mask| *mask == 0) && frame.radiance.iter().all(|r| *r == 0.0));
}

#[test]
fn the_lit_side_of_a_body_is_not_black() {
    let body = SmallBody { mesh: lobed(20), surface: plain() };
    let camera = Camera::from_fov(128, 96, 0.6);
    let eye = Vector3::new(900.0, 800.0, 300.0);
    let frame = render(
        World::Body(&body),
        &camera,
        &RenderConfig::default(),
        &look_at(eye, Vector3::zeros(), Vector3::z(), eye),
    );
    let lit = frame.mask.iter().filter(|mask| **mask & RenderedFrame::LIT != 0).count();
    assert!(lit > 1000 && frame.radiance.iter().copied().fold(0.0, f32::max) > 0.3);
}
