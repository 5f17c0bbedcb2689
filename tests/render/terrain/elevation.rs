//! Measured ground as it is drawn: the interpolated model and nothing else, to the horizon and to the highest peak.

use crate::render::{gpu, look_at, ray, render};
use nalgebra::{Unit, Vector3};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderedFrame, Renderer, World};
use opnav::scene::{ElevationModel, Georeference, GroundBase, MapPlace, Raster, Terrain, TerrainConfig, View};

const MARS_M: f64 = 3_396_190.0;

fn ground(
    georeference: Georeference,
    [columns, rows]: [usize; 2],
    site: Option<MapPlace>,
    height: impl Fn(f64, f64) -> f64,
) -> Terrain {
    let at = |i: usize| height((i % columns) as f64, (i / columns) as f64) as f32;
    let raster = Raster { columns, values: (0..columns * rows).map(at).collect(), georeference };
    let elevation = Some(ElevationModel::new(raster, site.as_ref()).expect("a model"));
    Terrain::on_base(&TerrainConfig::default(), GroundBase { elevation, ..GroundBase::default() }, 1)
}

fn metres(step_m: f64) -> Georeference {
    Georeference::Metres { first_m: [0.0, 0.0], step_m: [step_m; 2] }
}

/// Differences between drawn depth and the first hit of a ray with `expected`, in footprints of a pixel, sorted; every
/// sampled pixel shows ground where the ray meets it, and only there.
fn depth_differences(frame: &RenderedFrame, expected: &Terrain, camera: &Camera, view: &View) -> Vec<f64> {
    let eye = view.reference_from_camera.translation.vector;
    let mut off = Vec::new();
    let (mut sampled, mut wrong) = (0, 0);
    for (u, v) in (0..camera.height_px).flat_map(|v| (0..camera.width_px).map(move |u| (u, v))).step_by(113) {
        let direction = ray(camera, view, u, v);
        let drawn_m = f64::from(frame.depth_m[frame.index(u, v)]);
        let range_m = expected.ray_cast(&eye, &Unit::new_normalize(direction));
        sampled += 1;
        wrong += i32::from(range_m.is_some() != drawn_m.is_finite());
        if let (Some(range_m), true) = (range_m, drawn_m.is_finite()) {
            let depth_m = range_m / direction.norm();
            off.push((drawn_m - depth_m).abs() * camera.mean_focal_px() / depth_m);
        }
    }
    assert!(f64::from(wrong) <= 0.01 * f64::from(sampled), "{wrong} of {sampled} pixels show ground or sky wrongly");
    off.sort_by(f64::total_cmp);
    off
}

#[test]
fn without_detail_the_drawn_ground_is_the_interpolated_model() {
    let waves = |shift: f64| {
        move |c: f64, r: f64| 20.0 * (0.9 * (c + shift)).sin() * (0.7 * r).cos() + 5.0 * (1.6 * r + 0.3 * c).sin()
    };
    let terrain = ground(metres(40.0), [121, 121], None, waves(0.0));
    let camera = Camera::from_fov(256, 256, 1.2);
    let eye = Vector3::new(130.0, -420.0, 1500.0);
    for (eye, along) in [(eye, Vector3::new(0.2, 0.5, -1.0)), (eye * 0.15, Vector3::new(0.1, 0.1, -1.0))] {
        let view = look_at(eye, eye + along, Vector3::y(), Vector3::new(1.0, 0.5, 0.8));
        let frame = render(World::Terrain(&terrain), &camera, &RenderConfig::default(), &view);
        let off = depth_differences(&frame, &terrain, &camera, &view);
        let (median, most) = (off[off.len() / 2], off[off.len() * 98 / 100]);
        println!("{:.0} m: median {median:.4} footprints, 98 % below {most:.4}", eye.z);
        assert!(median < 0.05 && most < 0.25, "median {median:.4}, 98 % below {most:.4} footprints");
        // A model half a post off is told apart.
        let shifted = ground(metres(40.0), [121, 121], None, waves(0.5));
        let off = depth_differences(&frame, &shifted, &camera, &view);
        assert!(off[off.len() / 2] > 0.3, "half a post is {} footprints", off[off.len() / 2]);
    }
}

#[test]
fn a_mountain_far_above_the_camera_is_drawn() {
    // 15 km high, as steep as its foot is flat: neither culled nor cut.
    let peak = |c: f64, r: f64| 15_000.0 * (-((c - 30.0).powi(2) + (r - 30.0).powi(2)) / 150.0).exp();
    let site = MapPlace::Metres { x_m: 1000.0, y_m: -9000.0 };
    let terrain = ground(metres(300.0), [61, 61], Some(site), peak);
    let camera = Camera::from_fov(256, 256, 1.4);
    let eye = Vector3::new(0.0, 0.0, 4000.0);
    let view = look_at(eye, Vector3::new(8000.0, 0.0, 5500.0), Vector3::z(), Vector3::new(-1.0, 0.4, 0.6));
    let frame = render(World::Terrain(&terrain), &camera, &RenderConfig::default(), &view);
    let off = depth_differences(&frame, &terrain, &camera, &view);
    let (median, most) = (off[off.len() / 2], off[off.len() * 97 / 100]);
    println!("median {median:.3} footprints, 97 % below {most:.3}");
    assert!(off.len() > 300 && median < 0.1 && most < 2.0, "{}: median {median:.3}, 97 % below {most:.3}", off.len());
}

/// Row of the highest ground in the middle column.
fn horizon_row(terrain: &Terrain, camera: &Camera) -> f64 {
    let eye = Vector3::new(0.0, 0.0, 10_000.0);
    let view = look_at(eye, eye + Vector3::x(), Vector3::z(), Vector3::new(-0.5, 0.4, 0.7));
    let mut renderer = Renderer::new(&gpu(), World::Terrain(terrain), camera, &RenderConfig::default()).expect("ready");
    let frame = renderer.render(&view).expect("a picture");
    let ground = |v: u32| frame.depth_m[frame.index(camera.width_px / 2, v)].is_finite();
    f64::from((0..camera.height_px).find(|v| ground(*v)).expect("some ground"))
}

#[test]
fn the_horizon_is_that_of_the_planet() {
    let camera = Camera::from_fov(400, 400, 1.0);
    let globe = Georeference::Degrees { first_deg: [-9.75, 9.75], step_deg: [0.5; 2], radius_m: MARS_M };
    let round = ground(globe, [40, 40], None, |_, _| 0.0);
    let dip_rad = (MARS_M / (MARS_M + 10_000.0)).acos();
    let expected = camera.center_px.y + camera.focal_px.y * dip_rad.tan();
    let found = horizon_row(&round, &camera);
    println!("horizon in row {found}, expected at {expected:.2}");
    assert!((found - 0.5 - expected).abs() < 1.0, "horizon in row {found}, expected at {expected:.2}");
    // On a plane it lies higher.
    let flat = horizon_row(&ground(metres(30_000.0), [40, 40], None, |_, _| 0.0), &camera);
    assert!(flat < expected - 10.0, "horizon of the plane in row {flat}");
}
