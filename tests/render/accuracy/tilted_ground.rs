//! Depth of drawn ground that is one inclined plane, by an elevation model whose posts lie on it: there the triangles are
//! the ground, and depth is that of a ray and a plane.

use super::{Bar, Extent, Tamper, awkward_camera, check, check_refused, rolled};
use crate::render::gpu;
use nalgebra::{Unit, Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderedFrame, Renderer, World};
use opnav::scene::{ElevationModel, Georeference, GroundBase, Raster, Terrain, TerrainConfig, View};
use opnav::stats::random_stream;
use rand::RngExt;

/// Gradients of the planes by x and y: no two alike, up to 48° steep.
const GRADIENTS: [[f64; 2]; 3] = [[0.25, -0.125], [-0.5, 0.75], [1.0, 0.5]];
/// Posts are as far apart as the camera is high, over this.
const POSTS_A_HEIGHT: f64 = 4.0;

/// A plane through the origin, and its terrain to many heights of the camera on every side.
fn plane(gradient: Vector2<f64>, height_m: f64) -> Terrain {
    const POSTS: usize = 401;
    // A whole power of two, so that heights at posts are exact.
    let post_m = (height_m / POSTS_A_HEIGHT).log2().round().exp2();
    let first_m = 0.5 * (POSTS - 1) as f64 * post_m;
    let place = |i: usize| Vector2::new((i % POSTS) as f64 * post_m - first_m, first_m - (i / POSTS) as f64 * post_m);
    let values = (0..POSTS * POSTS).map(|i| gradient.dot(&place(i)) as f32).collect();
    let georeference = Georeference::Metres { first_m: [-first_m, first_m], step_m: [post_m; 2] };
    let elevation = Some(ElevationModel::new(Raster { columns: POSTS, values, georeference }, None).expect("a model"));
    Terrain::on_base(&TerrainConfig::level(), GroundBase { elevation, ..GroundBase::default() }, 1)
}

/// A pixel's relative error of depth.
fn error(
    (camera, view): (&Camera, &View),
    frame: &RenderedFrame,
    (u, v): (u32, u32),
    (gradient, tamper): (&Vector2<f64>, Tamper),
) -> f64 {
    let pixel = match tamper {
        Tamper::HalfPixel => Vector2::new(f64::from(u) + 0.5, f64::from(v) + 0.5),
        Tamper::UpsideDown => Vector2::new(f64::from(u), f64::from(frame.height_px - 1 - v)),
        _ => Vector2::new(f64::from(u), f64::from(v)),
    };
    let ideal = camera.normalize(&pixel).expect("a pinhole").push(1.0);
    let normal = Vector3::new(-gradient.x, -gradient.y, 1.0);
    let ray = view.reference_from_camera.rotation * ideal;
    let depth_m = -normal.dot(&view.reference_from_camera.translation.vector) / normal.dot(&ray);
    let by = if tamper == Tamper::RangeForDepth { ideal.norm() } else { 1.0 };
    (f64::from(frame.depth_m[frame.index(u, v)]) / (depth_m * by) - 1.0).abs()
}

/// Worst relative error over views from `height_m`, at every `step`th pixel.
fn worst(height_m: f64, (views, step): (u64, usize), tamper: Tamper) -> f64 {
    let camera = awkward_camera(437, 331, 1.0);
    let mut worst: f64 = 0.0;
    for gradient in GRADIENTS.map(Vector2::from) {
        let terrain = plane(gradient, height_m);
        let mut renderer =
            Renderer::new(&gpu(), World::Terrain(&terrain), &camera, &RenderConfig::default()).expect("a renderer");
        for index in 0..views {
            let mut random = random_stream(22, "tilted-ground", index);
            let mut aside = |most: f64| random.random_range(-most..most);
            let (x, y) = (aside(height_m), aside(height_m));
            let eye = Vector3::new(x, y, gradient.dot(&Vector2::new(x, y)) + height_m);
            let forward = Vector3::new(aside(0.2) - gradient.x, aside(0.2) - gradient.y, 1.0) * -1.0;
            let pose = rolled(eye, forward.normalize(), &mut random);
            let sun_in_reference = Unit::new_normalize(Vector3::new(0.2, 0.3, 1.0));
            let view = View { t_ns: 0, reference_from_camera: pose, sun_in_reference, sun_angular_radius_rad: 0.0 };
            let frame = renderer.render(&view).expect("a picture");
            for at in (0..frame.depth_m.len()).step_by(step) {
                let pixel = (at as u32 % frame.width_px, at as u32 / frame.width_px);
                worst = worst.max(error((&camera, &view), &frame, pixel, (&gradient, tamper)));
            }
        }
    }
    worst
}

fn measure(height_m: f64, work: (u64, usize), tamper: Tamper) -> Bar {
    let what = format!("inclined ground from {height_m} m: relative error of z-depth, worst");
    Bar::at_most(what, worst(height_m, work, tamper), 1e-5, "")
}

pub fn bars(extent: Extent) -> Vec<Bar> {
    let work = if extent == Extent::Small { (1, 7) } else { (6, 1) };
    [10.0, 10_000.0].iter().map(|height_m| measure(*height_m, work, Tamper::Honest)).collect()
}

#[test]
fn depth_of_inclined_ground_is_that_of_its_plane() {
    check(&bars(Extent::Small));
}

#[test]
fn wrong_depth_of_inclined_ground_is_noticed() {
    for tamper in [Tamper::HalfPixel, Tamper::RangeForDepth, Tamper::UpsideDown] {
        check_refused(tamper, &[measure(10.0, (1, 101), tamper)]);
        check_refused(tamper, &[measure(10_000.0, (1, 101), tamper)]);
    }
}

#[test]
#[ignore = "in full"]
fn in_full() {
    check(&bars(Extent::Full));
}
