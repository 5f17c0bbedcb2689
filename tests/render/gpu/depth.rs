//! Depth against the surface that is drawn.

use crate::render::{flat, gpu, inner, lobed, look_at, look_down, nearest_hit, ray, render};
use nalgebra::{Unit, Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderedFrame, Renderer, World};
use opnav::scene::{BodySurface, SmallBody, Terrain, TerrainConfig};
use opnav::stats::random_stream;
use rand::RngExt;

#[test]
fn depth_of_a_body_is_that_of_its_triangles() {
    let body = SmallBody { mesh: lobed(24), surface: BodySurface::default() };
    let camera = Camera { center_px: Vector2::new(140.2, 101.7), ..Camera::from_fov(256, 192, 0.45) };
    for eye in [Vector3::new(900.0, 1100.0, 500.0), Vector3::new(20.0, 260.0, 120.0), Vector3::new(6e4, -8e4, 3e4)] {
        let closer = f64::max(eye.norm() / 1500.0, 0.4);
        let camera = Camera { focal_px: camera.focal_px * closer, ..camera };
        let view = look_at(eye, Vector3::zeros(), Vector3::z(), Vector3::new(1.0, 1.0, 0.4));
        let frame = render(World::Body(&body), &camera, &RenderConfig::default(), &view);
        let hits = inner(&frame, 1, |i| frame.mask[i] & RenderedFrame::BODY != 0);
        assert!(hits.len() > 2000, "{} px are hit", hits.len());
        let mut worst: f64 = 0.0;
        for (u, v) in hits.iter().step_by(17) {
            let (depth_m, _) = nearest_hit(&body.mesh, &eye, &ray(&camera, &view, *u, *v)).expect("the ray hits");
            worst = worst.max((f64::from(frame.depth_m[frame.index(*u, *v)]) / depth_m - 1.0).abs());
        }
        println!("worst relative depth error {worst:.2e} from {:.0} m", eye.norm());
        assert!(worst < 1e-4, "relative depth error {worst:.2e} from {eye}");
        let empty = inner(&frame, 1, |i| frame.mask[i] == 0);
        for (u, v) in empty.iter().step_by(53) {
            assert!(frame.depth_m[frame.index(*u, *v)].is_nan());
            assert_eq!(nearest_hit(&body.mesh, &eye, &ray(&camera, &view, *u, *v)), None);
        }
    }
}

#[test]
fn depth_of_level_ground_is_exact() {
    let terrain = Terrain::new(&flat(), 1);
    let camera = Camera { center_px: Vector2::new(100.0, 140.0), ..Camera::from_fov(256, 256, 1.4) };
    for height_m in [9000.0, 300.0, 2.0] {
        let eye = Vector3::new(-1234.567, 4321.123, height_m);
        let target = eye + Vector3::new(0.4, 0.2, -1.0);
        let view = look_at(eye, target, Vector3::y(), Vector3::new(1.0, 0.0, 1.0));
        let frame = render(World::Terrain(&terrain), &camera, &RenderConfig::default(), &view);
        let mut worst: f64 = 0.0;
        for (u, v) in (0..256).flat_map(|v| (0..256).map(move |u| (u, v))).step_by(37) {
            let depth_m = -height_m / ray(&camera, &view, u, v).z;
            worst = worst.max((f64::from(frame.depth_m[frame.index(u, v)]) / depth_m - 1.0).abs());
        }
        println!("worst relative depth error {worst:.2e} from {height_m} m");
        assert!(worst < 1e-5, "relative depth error {worst:.2e} from {height_m} m");
    }
}

#[test]
fn depth_of_rough_ground_is_that_of_the_analytic_terrain() {
    let terrain = Terrain::new(&TerrainConfig::default(), 7);
    let camera = Camera::from_fov(512, 512, 1.2);
    for (place, height_m) in
        [([3300.0, 5870.0], 6570.0), ([150.0, 500.0], 1250.0), ([1.0, 2.0], 30.0), ([0.3, 0.2], 3.0)]
    {
        let view = look_down(&terrain, place, height_m);
        let frame = render(World::Terrain(&terrain), &camera, &RenderConfig::default(), &view);
        let eye = view.reference_from_camera.translation.vector;
        let mut off = Vec::new();
        for (u, v) in (0..512).flat_map(|v| (0..512).map(move |u| (u, v))).step_by(509) {
            let direction = ray(&camera, &view, u, v);
            let range_m = terrain.ray_cast(&eye, &Unit::new_normalize(direction)).expect("the ray meets the ground");
            let depth_m = range_m / direction.norm();
            // In footprints of a pixel: the mesh leaves out what is finer than its vertices' spacing.
            let footprint_m = depth_m / camera.mean_focal_px();
            off.push((f64::from(frame.depth_m[frame.index(u, v)]) - depth_m).abs() / footprint_m);
        }
        off.sort_by(f64::total_cmp);
        let (median, most) = (off[off.len() / 2], off[off.len() * 98 / 100]);
        println!("{height_m} m: median {median:.3} footprints, 98 % below {most:.3}");
        assert!(median < 0.1 && most < 1.0, "from {height_m} m: median {median:.3}, 98 % below {most:.3} footprints");
    }
}

#[test]
fn terrain_has_no_cracks() {
    let terrain = Terrain::new(&TerrainConfig::default(), 5);
    let camera = Camera::from_fov(384, 384, 1.5);
    let mut renderer =
        Renderer::new(&gpu(), World::Terrain(&terrain), &camera, &RenderConfig::default()).expect("ready");
    let mut random = random_stream(5, "crack", 0);
    for _ in 0..12 {
        let height_m = 10.0_f64.powf(random.random_range(0.2..4.0));
        let place = [random.random_range(-5e3..5e3), random.random_range(-5e3..5e3)];
        let frame = renderer.render(&look_down(&terrain, place, height_m)).expect("a picture");
        assert!(frame.depth_m.iter().all(|d| d.is_finite()), "a crack in the truth from {height_m} m at {place:?}");
        let least = frame.radiance.iter().copied().fold(f32::INFINITY, f32::min);
        let sky = 0.02 * 0.15 * 0.5;
        assert!(least > sky, "a crack in the picture from {height_m} m at {place:?}: {least}");
    }
}
