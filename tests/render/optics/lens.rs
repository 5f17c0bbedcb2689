//! Pictures through a lens with distortion.

use super::pixels::{add_disc, centroid};
use crate::render::{inner, lobed, look_at, nearest_hit, plain, render};
use nalgebra::{Vector2, Vector3};
use opnav::geometry::{Camera, Distortion};
use opnav::render::{RenderConfig, RenderedFrame, World};
use opnav::scene::{Mesh, SmallBody};

fn lenses() -> [Camera; 2] {
    let camera = Camera { center_px: Vector2::new(130.3, 97.8), ..Camera::from_fov(256, 200, 1.1) };
    [Distortion::RadialTangential([-0.28, 0.07, 1e-3, -8e-4]), Distortion::Equidistant([-0.02, 0.004, 0.0, 0.0])]
        .map(|distortion| Camera { distortion, ..camera })
}

#[test]
fn a_lens_moves_points_as_its_formula_says() {
    let eye = Vector3::new(0.3, -0.2, 100.0);
    let view = look_at(eye, eye - Vector3::z(), Vector3::new(0.1, 1.0, 0.0), Vector3::z());
    for camera in lenses() {
        let mut mesh = Mesh::default();
        let mut pixels = Vec::new();
        for k in 0..48 {
            let pixel = Vector2::new(f64::from(k % 8) * 30.0 + 22.3, f64::from(k / 8) * 30.0 + 22.7);
            let along = camera.unproject(&pixel).expect("inside the field");
            let center = view.reference_from_camera * nalgebra::Point3::from(along.as_ref() * (100.0 / along.z));
            // Small, so that the lens does not move their centroid.
            add_disc(&mut mesh, &center.coords, 3.0 * 100.0 / camera.focal_px.x);
            pixels.push(pixel);
        }
        let body = SmallBody { mesh, surface: plain() };
        let config = RenderConfig { supersampling: 4, ..RenderConfig::default() };
        let frame = render(World::Body(&body), &camera, &config, &view);
        let offset = |p: &Vector2<f64>| centroid(&frame, p) - p;
        let bias = pixels.iter().map(offset).sum::<Vector2<f64>>() / pixels.len() as f64;
        let square = pixels.iter().map(|p| offset(p).norm_squared()).sum::<f64>() / pixels.len() as f64;
        println!("{:?}: bias {:.4} px, r.m.s. {:.4} px", camera.distortion, bias.norm(), square.sqrt());
        assert!(bias.norm() < 0.01 && square.sqrt() < 0.03, "bias {bias}, r.m.s. {}", square.sqrt());
        // A pinhole camera would have seen them elsewhere.
        let pinhole = Camera { distortion: Distortion::None, ..camera };
        let elsewhere =
            pixels.iter().filter_map(|p| pinhole.project(camera.unproject(p)?.as_ref()).map(|q| (q - p).norm()));
        assert!(elsewhere.fold(0.0, f64::max) > 3.0);
    }
}

#[test]
fn depth_through_a_lens_is_that_of_the_pixel_s_own_ray() {
    let body = SmallBody { mesh: lobed(24), surface: plain() };
    for camera in lenses() {
        let eye = Vector3::new(500.0, 450.0, 200.0);
        let view = look_at(eye, Vector3::zeros(), Vector3::z(), Vector3::new(1.0, 1.0, 0.4));
        let frame = render(World::Body(&body), &camera, &RenderConfig::default(), &view);
        let hits = inner(&frame, 2, |i| frame.mask[i] & RenderedFrame::BODY != 0);
        assert!(hits.len() > 4000, "{} px are hit", hits.len());
        let hit = |u: f64, v: f64| {
            let ideal = camera.normalize(&Vector2::new(u, v)).expect("inside the field");
            nearest_hit(&body.mesh, &eye, &(view.reference_from_camera.rotation * Vector3::new(ideal.x, ideal.y, 1.0)))
        };
        let error = |(u, v): &(u32, u32), shift: f64| {
            let (at_u, at_v) = (f64::from(*u) + shift, f64::from(*v));
            let (depth_m, face) = hit(at_u, at_v)?;
            // Away from the mesh's edges.
            let beside = [(-0.7, -0.7), (0.7, -0.7), (-0.7, 0.7), (0.7, 0.7)];
            let same = beside.iter().all(|(du, dv)| hit(at_u + du, at_v + dv).is_some_and(|(_, other)| other == face));
            same.then(|| (f64::from(frame.depth_m[frame.index(*u, *v)]) / depth_m - 1.0).abs())
        };
        let sorted = |shift: f64| {
            let mut errors: Vec<f64> = hits.iter().step_by(7).filter_map(|at| error(at, shift)).collect();
            errors.sort_by(f64::total_cmp);
            errors
        };
        let (right, wrong) = (sorted(0.0), sorted(0.5));
        let worst = right[right.len() - 1];
        println!("{:?}: relative error at most {worst:.1e} at {} px", camera.distortion, right.len());
        assert!(right.len() > 300 && worst < 1e-5, "{worst:.1e} at {} px", right.len());
        assert!(wrong[wrong.len() / 2] > 1e-4, "half a pixel shows");
    }
}
