//! Where things appear in the picture.

use crate::render::{look_at, plain, render};
use nalgebra::{Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderedFrame, World};
use opnav::scene::{Mesh, SmallBody};
use opnav::stats::random_stream;
use rand::RngExt;

/// An eight-sided disc at `center`, facing the camera's way.
pub(super) fn add_disc(mesh: &mut Mesh, center: &Vector3<f64>, radius_m: f64) {
    let first = mesh.vertices_m.len() as u32;
    mesh.vertices_m.push(*center);
    for k in 0..8 {
        // Seen from +z, that is, by a camera that looks along -z, this runs counter-clockwise.
        let angle = f64::from(k) * std::f64::consts::FRAC_PI_4;
        mesh.vertices_m.push(center + Vector3::new(angle.cos(), angle.sin(), 0.0) * radius_m);
        mesh.faces.push([first, first + 1 + k, first + 1 + (k + 1) % 8]);
    }
}

#[test]
fn known_points_land_on_their_pixels() {
    let camera = Camera {
        focal_px: Vector2::new(310.0, 290.0),
        center_px: Vector2::new(120.3, 97.8),
        ..Camera::from_fov(256, 200, 1.0)
    };
    let eye = Vector3::new(0.3, -0.2, 100.0);
    let view = look_at(eye, eye - Vector3::z(), Vector3::new(0.1, 1.0, 0.0), Vector3::z());
    let mut random = random_stream(4, "disc", 0);
    let mut mesh = Mesh::default();
    let mut pixels = Vec::new();
    for k in 0..48 {
        let cell = Vector2::new(f64::from(k % 8) * 30.0 + 22.0, f64::from(k / 8) * 30.0 + 22.0);
        let pixel = cell + Vector2::from_fn(|_, _| random.random_range(-3.0..3.0));
        let along = camera.unproject(&pixel).expect("a pinhole");
        let depth_m = random.random_range(95.0..105.0);
        let center = view.reference_from_camera * nalgebra::Point3::from(along.as_ref() * (depth_m / along.z));
        add_disc(&mut mesh, &center.coords, 2.2 * depth_m / 300.0);
        let in_camera = view.reference_from_camera.inverse() * center;
        pixels.push(camera.project(&in_camera.coords).expect("in front"));
    }
    let body = SmallBody { mesh, surface: plain() };
    let frame =
        render(World::Body(&body), &camera, &RenderConfig { supersampling: 8, ..RenderConfig::default() }, &view);
    let offsets: Vec<Vector2<f64>> = pixels.iter().map(|p| centroid(&frame, p) - p).collect();
    let bias = offsets.iter().sum::<Vector2<f64>>() / offsets.len() as f64;
    assert!(bias.norm() < 0.02, "bias {bias}");
    assert!(offsets.iter().all(|o| o.norm() < 0.1), "each disc: {offsets:?}");
    // The test can tell half a pixel, and an upside-down picture.
    let shifted: Vec<f64> = pixels.iter().map(|p| (centroid(&frame, p) - p.add_scalar(0.5)).norm()).collect();
    assert!(shifted.iter().all(|o| *o > 0.4));
    let flipped = pixels.iter().filter(|p| {
        let mirrored = Vector2::new(p.x, 199.0 - p.y);
        (centroid(&frame, &mirrored) - mirrored).norm() < 0.1
    });
    assert!(flipped.count() < 5, "the picture is not symmetric");
}

pub(super) fn centroid(frame: &RenderedFrame, near_px: &Vector2<f64>) -> Vector2<f64> {
    let (mut total, mut weight) = (Vector2::zeros(), 0.0);
    for (v, u) in (0..frame.height_px).flat_map(|v| (0..frame.width_px).map(move |u| (v, u))) {
        let pixel = Vector2::new(f64::from(u), f64::from(v));
        if (pixel - near_px).amax() < 8.0 {
            let radiance = f64::from(frame.radiance[frame.index(u, v)]);
            total += pixel * radiance;
            weight += radiance;
        }
    }
    total / weight
}

#[test]
fn up_in_the_world_is_up_in_the_image() {
    let mut mesh = Mesh::default();
    add_disc(&mut mesh, &Vector3::new(0.0, 10.0, 0.0), 4.0);
    let body = SmallBody { mesh, surface: plain() };
    let eye = Vector3::new(0.0, 0.0, 50.0);
    let view = look_at(eye, Vector3::zeros(), Vector3::y(), Vector3::z());
    let frame = render(World::Body(&body), &Camera::from_fov(64, 64, 1.0), &RenderConfig::default(), &view);
    let brightest = |rows: std::ops::Range<u32>| {
        rows.flat_map(|v| (0..64).map(move |u| (u, v)))
            .map(|(u, v)| frame.radiance[frame.index(u, v)])
            .fold(0.0, f32::max)
    };
    assert!(brightest(0..32) > 0.4 && brightest(32..64) == 0.0);
}
