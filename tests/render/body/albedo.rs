//! Albedo painted on bodies, against its twin on the CPU.

use crate::render::{look_at, nearest_hit, plain, ray, render, sphere};
use nalgebra::{Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderedFrame, World};
use opnav::scene::{AlbedoImage, GlobeMap, ImageEdge, Mesh, MeshAlbedo, SmallBody, View};
use std::f64::consts::TAU;

/// One sample a pixel, at its centre.
fn sharp() -> RenderConfig {
    RenderConfig { supersampling: 1, ..RenderConfig::default() }
}

fn camera() -> Camera {
    Camera::from_fov(160, 140, 0.5)
}

fn view() -> View {
    look_at(Vector3::new(350.0, 250.0, 130.0), Vector3::zeros(), Vector3::z(), Vector3::new(1.0, 0.9, 0.5))
}

/// A smooth picture without any symmetry, mean near 1.
fn picture(width_px: u32, height_px: u32, vertical_edge: ImageEdge) -> AlbedoImage {
    let value = |k: u32| {
        let (x, y) = (f64::from(k % width_px) / f64::from(width_px), f64::from(k / width_px) / f64::from(height_px));
        (1.0 + 0.4 * (TAU * (2.0 * x + 0.3)).sin() + 0.3 * (4.0 * y * y - 1.0) + 0.2 * (TAU * (x + 3.0 * y)).cos())
            as f32
    };
    AlbedoImage::new(width_px, height_px, (0..width_px * height_px).map(value).collect(), vertical_edge)
}

fn body(albedo: MeshAlbedo) -> SmallBody {
    SmallBody { mesh: Mesh { albedo, ..sphere(24, |_| 100.0) }, surface: plain() }
}

fn frame(albedo: MeshAlbedo) -> RenderedFrame {
    render(World::Body(&body(albedo)), &camera(), &sharp(), &view())
}

/// Drawn albedo over its mean, and that of the twin, at pixels that are lit and not seen at a slant.
fn both(drawn: &RenderedFrame, twin: &Mesh) -> Vec<(f64, f64)> {
    let uniform = frame(MeshAlbedo::Uniform);
    let (camera, view) = (camera(), view());
    let eye = view.reference_from_camera.translation.vector;
    let mut found = Vec::new();
    for (v, u) in (0..camera.height_px).step_by(3).flat_map(|v| (0..camera.width_px).step_by(3).map(move |u| (v, u))) {
        let at = drawn.index(u, v);
        if uniform.radiance[at] < 0.1 {
            continue;
        }
        let direction = ray(&camera, &view, u, v);
        let Some((t, face)) = nearest_hit(twin, &eye, &direction) else { continue };
        let point = eye + direction * t;
        if direction.normalize().dot(&point.normalize()) > -0.4 {
            continue;
        }
        let [a, b, c] = twin.corners_m(&twin.faces[face]);
        let normal = (b - a).cross(&(c - a));
        let part =
            |p: Vector3<f64>, q: Vector3<f64>| (p - point).cross(&(q - point)).dot(&normal) / normal.norm_squared();
        let expected = twin.relative_albedo(face, [part(b, c), part(c, a), part(a, b)]);
        found.push((f64::from(drawn.radiance[at] / uniform.radiance[at]), expected));
    }
    assert!(found.len() > 300, "{} pixels", found.len());
    found
}

fn worst(pairs: &[(f64, f64)]) -> f64 {
    pairs.iter().map(|(drawn, expected)| (drawn - expected).abs()).fold(0.0, f64::max)
}

/// Texture coordinates of each face from longitude and latitude, with a seam, turned and repeated.
fn corners(mesh: &Mesh) -> Vec<[[f32; 2]; 3]> {
    let coordinates = |face: &[u32; 3]| {
        let corners = mesh.corners_m(face);
        let first = corners.iter().sum::<Vector3<f64>>().y.atan2(corners.iter().sum::<Vector3<f64>>().x);
        corners.map(|p| {
            let turn = (p.y.atan2(p.x) - first + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
            [(1.3 + 2.0 * (first + turn) / TAU) as f32, (0.5 + p.z / 230.0) as f32]
        })
    };
    mesh.faces.iter().map(coordinates).collect()
}

#[test]
fn texture_is_drawn_where_its_twin_says() {
    let image = picture(48, 40, ImageEdge::Repeat);
    let albedo = MeshAlbedo::Texture { corners: corners(&sphere(24, |_| 100.0)), image };
    let drawn = frame(albedo.clone());
    let twin = body(albedo.clone()).mesh;
    let error = worst(&both(&drawn, &twin));
    assert!(error < 1e-3, "{error}");
    // The check can tell a flipped picture.
    let MeshAlbedo::Texture { corners, image } = albedo else { unreachable!() };
    let upside_down = corners.iter().map(|face| face.map(|[u, v]| [u, 1.0 - v])).collect();
    let flipped = Mesh { albedo: MeshAlbedo::Texture { corners: upside_down, image }, ..twin };
    assert!(worst(&both(&drawn, &flipped)) > 0.1);
}

#[test]
fn map_is_drawn_where_its_twin_says() {
    let map = |west_edge_rad: f64| {
        let image = picture(64, 32, ImageEdge::Clamp);
        MeshAlbedo::Globe(GlobeMap { image, west_edge_rad, origin_m: Vector3::new(3.0, -4.0, 2.0) })
    };
    for west_edge_rad in [-TAU / 2.0, 0.6] {
        let drawn = frame(map(west_edge_rad));
        let error = worst(&both(&drawn, &body(map(west_edge_rad)).mesh));
        assert!(error < 1e-3, "{west_edge_rad}: {error}");
        // The check can tell half a pixel of the map.
        let shifted = body(map(west_edge_rad + 0.5 * TAU / 64.0)).mesh;
        assert!(worst(&both(&drawn, &shifted)) > 0.02);
    }
}

#[test]
fn albedo_of_vertices_is_drawn_linearly_across_faces() {
    let mesh = sphere(24, |_| 100.0);
    let values: Vec<f32> = mesh.vertices_m.iter().map(|p| (1.0 + 0.004 * p.x - 0.003 * p.z) as f32).collect();
    let drawn = frame(MeshAlbedo::Vertices(values.clone()));
    let twin = body(MeshAlbedo::Vertices(values.clone())).mesh;
    let error = worst(&both(&drawn, &twin));
    assert!(error < 1e-3, "{error}");
    let reversed = body(MeshAlbedo::Vertices(values.into_iter().rev().collect())).mesh;
    assert!(worst(&both(&drawn, &reversed)) > 0.1);
}

#[test]
fn fine_maps_fade_to_their_mean_instead_of_flickering() {
    let chequered = (0..2048 * 1024).map(|k| if (k % 2048 + k / 2048) % 2 == 0 { 0.2 } else { 1.8 }).collect();
    let image = AlbedoImage::new(2048, 1024, chequered, ImageEdge::Clamp);
    let albedo = MeshAlbedo::Globe(GlobeMap { image, west_edge_rad: 0.0, origin_m: Vector3::zeros() });
    let uniform = frame(MeshAlbedo::Uniform);
    let drawn = frame(albedo);
    for (at, radiance) in uniform.radiance.iter().enumerate().filter(|(_, radiance)| **radiance > 0.05) {
        let ratio = drawn.radiance[at] / radiance;
        assert!((ratio - 1.0).abs() < 0.02, "pixel {} {}: {ratio}", at % 160, at / 160);
    }
}

#[test]
fn supersampled_albedo_is_the_mean_of_its_samples() {
    let image = picture(64, 32, ImageEdge::Clamp);
    let map = MeshAlbedo::Globe(GlobeMap { image, west_edge_rad: 0.0, origin_m: Vector3::zeros() });
    let smooth = RenderConfig { supersampling: 4, ..sharp() };
    let fine = render(World::Body(&body(map.clone())), &camera(), &smooth, &view());
    let coarse = frame(map);
    let uniform = frame(MeshAlbedo::Uniform);
    let center = Vector2::new(80.0, 70.0);
    for (v, u) in (0..140).flat_map(|v| (0..160).map(move |u| (v, u))) {
        let at = fine.index(u, v);
        if (Vector2::new(f64::from(u), f64::from(v)) - center).norm() < 30.0 && uniform.radiance[at] > 0.1 {
            let change = (fine.radiance[at] - coarse.radiance[at]) / uniform.radiance[at];
            assert!(change.abs() < 0.01, "{u} {v}: {change}");
        }
    }
}
