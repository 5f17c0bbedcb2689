//! Discs at known places, against the pixels that the camera model gives them.

use super::{Bar, Extent, Tamper, awkward_camera, check, check_refused, rolled};
use crate::render::image_polygon::ImagePolygon;
use crate::render::{gpu, plain};
use nalgebra::{Isometry3, Point3, Unit, UnitQuaternion, Vector2, Vector3};
use opnav::geometry::{Camera, Distortion};
use opnav::render::{RenderConfig, RenderedFrame, Renderer, World};
use opnav::scene::{Mesh, SmallBody, View};
use opnav::stats::random_stream;
use rand::RngExt;
use rand_distr::{Distribution, UnitSphere};

const RANGES_M: [f64; 5] = [10.0, 56.0, 316.0, 1778.0, 10_000.0];
const CORNERS: usize = 32;
/// With four samples a pixel, the centroid of a disc this large is known to about 0.02 px.
const RADIUS_PX: f64 = 14.0;
const PITCH_PX: f64 = 66.0;
/// Distance of the middle of the discs from the origin of their frame, m.
const FROM_ORIGIN_M: f64 = 300.0;

fn lenses() -> [(&'static str, Camera); 3] {
    let camera = awkward_camera(630, 470, 1.5);
    let bent = |distortion| Camera { distortion, ..camera };
    [
        ("pinhole", camera),
        ("radial-tangential", bent(Distortion::RadialTangential([-0.12, 0.02, 1.1e-3, -0.7e-3]))),
        ("equidistant", bent(Distortion::Equidistant([-0.013, 0.021, -0.012, 0.002]))),
    ]
}

/// Discs over the whole field, with the outline in the picture of each.
struct Discs {
    mesh: Mesh,
    outlines: Vec<ImagePolygon>,
}

fn discs(camera: &Camera, pose: &Isometry3<f64>, range_m: f64, random: &mut impl rand::Rng) -> Discs {
    let mut discs = Discs { mesh: Mesh::default(), outlines: Vec::new() };
    let cells = |size_px: u32| ((f64::from(size_px) - 10.0) / PITCH_PX) as u32;
    let (columns, rows) = (cells(camera.width_px), cells(camera.height_px));
    for (i, j) in (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j))) {
        let along = |k: u32, count: u32, size_px: u32| (f64::from(k) + 0.5) / f64::from(count) * f64::from(size_px);
        let cell = Vector2::new(along(i, columns, camera.width_px), along(j, rows, camera.height_px));
        let pixel = cell + Vector2::from_fn(|_, _| random.random_range(-3.0..3.0));
        let bearing = camera.unproject(&pixel).expect("inside the picture").into_inner();
        let depth_m = range_m * random.random_range(0.97..1.03);
        let center_m = bearing * (depth_m / bearing.z);
        // As large as RADIUS_PX on the axis, whatever the lens does here.
        let (_, by_point) = camera.project_with_jacobian(&center_m).expect("in front");
        let radius_m = RADIUS_PX / (by_point.svd(false, false).singular_values.max());
        let facing = UnitQuaternion::rotation_between(&Vector3::z(), &-bearing).expect("not opposite");
        let tilt =
            UnitQuaternion::from_euler_angles(random.random_range(-0.4..0.4), random.random_range(-0.4..0.4), 0.0);
        let corner = |share: f64| {
            let angle = std::f64::consts::TAU * share;
            center_m + facing * tilt * Vector3::new(angle.cos(), angle.sin(), 0.0) * radius_m
        };
        let corners: Vec<Vector3<f64>> = (0..CORNERS).map(|k| corner(k as f64 / CORNERS as f64)).collect();
        discs.outlines.push(ImagePolygon::of(camera, &corners));
        let first = discs.mesh.vertices_m.len() as u32;
        discs.mesh.vertices_m.push((pose * Point3::from(center_m)).coords);
        discs.mesh.vertices_m.extend(corners.iter().map(|c| (pose * Point3::from(*c)).coords));
        let count = CORNERS as u32;
        discs.mesh.faces.extend((0..count).map(|k| [first, first + 1 + k, first + 1 + (k + 1) % count]));
    }
    discs
}

/// Centroid of the light around an outline; `None` if there is none.
fn centroid(frame: &RenderedFrame, outline: &ImagePolygon) -> Option<Vector2<f64>> {
    let (low, high) = outline.pixels(3.0);
    let (mut total, mut weight) = (Vector2::zeros(), 0.0);
    let within = |at: i64, size: u32| (0..i64::from(size)).contains(&at);
    for (u, v) in (low.y..=high.y).flat_map(|v| (low.x..=high.x).map(move |u| (u, v))) {
        if within(u, frame.width_px) && within(v, frame.height_px) {
            let radiance = f64::from(frame.radiance[frame.index(u as u32, v as u32)]);
            total += Vector2::new(u as f64, v as f64) * radiance;
            weight += radiance;
        }
    }
    (weight > 0.0).then(|| total / weight)
}

/// Errors of all discs' centroids in px, and those of the same estimator on perfectly integrated discs.
#[derive(Default)]
struct Errors {
    rendered: Vec<Vector2<f64>>,
    ideal: Vec<Vector2<f64>>,
}

fn errors(camera: &Camera, range_m: f64, views: u64, tamper: Tamper) -> Option<Errors> {
    let mut errors = Errors::default();
    for index in 0..views {
        let mut random = random_stream(11, "fiducials", index);
        let forward = Vector3::from(UnitSphere.sample(&mut random));
        let field_m = Vector3::from(UnitSphere.sample(&mut random)) * FROM_ORIGIN_M;
        let pose = rolled(field_m - forward * range_m, forward, &mut random);
        let Discs { mesh, outlines } = discs(camera, &pose, range_m, &mut random);
        let body = SmallBody { mesh, surface: plain() };
        let view = View {
            t_ns: 0,
            reference_from_camera: pose,
            sun_in_reference: Unit::new_normalize(-forward),
            sun_angular_radius_rad: 0.0,
        };
        let made = Renderer::new(&gpu(), World::Body(&body), camera, &RenderConfig::default());
        if camera.distortion != Distortion::None && made.is_err() {
            return None;
        }
        let frame = made.expect("a renderer").render(&view).expect("a picture");
        for outline in &outlines {
            let seen = match tamper {
                Tamper::UpsideDown => outline.upside_down(frame.height_px),
                _ => outline.clone(),
            };
            let shift = if tamper == Tamper::HalfPixel { 0.5 } else { 0.0 };
            let lost = Vector2::repeat(10.0);
            let found = centroid(&frame, &seen).map_or(lost, |c| c - seen.centroid().add_scalar(shift));
            errors.rendered.push(found);
            errors.ideal.push(outline.sampled_centroid() - outline.centroid());
        }
    }
    Some(errors)
}

fn bias_and_rms(errors: &[Vector2<f64>]) -> (f64, f64) {
    let count = errors.len() as f64;
    let bias = errors.iter().sum::<Vector2<f64>>() / count;
    (bias.norm(), (errors.iter().map(|e| e.norm_squared()).sum::<f64>() / count).sqrt())
}

fn measure(name: &str, camera: &Camera, (ranges_m, views): (&[f64], u64), tamper: Tamper) -> Vec<Bar> {
    let mut bars = Vec::new();
    for range_m in ranges_m {
        let what = |figure: &str| format!("fiducials, {name}, {range_m} m: {figure}");
        let Some(errors) = errors(camera, *range_m, views, tamper) else {
            return vec![Bar::at_most(what("r.m.s. (the camera is refused)"), f64::NAN, 0.03, "px")];
        };
        let (bias, rms) = bias_and_rms(&errors.rendered);
        bars.push(Bar::at_most(what("bias"), bias, 0.01, "px"));
        bars.push(Bar::at_most(what("r.m.s."), rms, 0.03, "px"));
        if *range_m == RANGES_M[0] {
            bars.push(Bar::stated(what("r.m.s. of the estimator itself"), bias_and_rms(&errors.ideal).1, "px"));
        }
    }
    bars
}

pub fn bars(extent: Extent) -> Vec<Bar> {
    let work: (&[f64], u64) = match extent {
        Extent::Small => (&[10.0, 10_000.0], 1),
        Extent::Full => (&RANGES_M, 4),
    };
    let lenses = lenses();
    let lenses = if extent == Extent::Small { &lenses[..1] } else { &lenses[..] };
    lenses.iter().flat_map(|(name, camera)| measure(name, camera, work, Tamper::Honest)).collect()
}

#[test]
fn fiducials_lie_on_their_pixels() {
    check(&bars(Extent::Small));
}

#[test]
fn misplaced_fiducials_are_noticed() {
    let [(name, camera), ..] = lenses();
    for tamper in [Tamper::HalfPixel, Tamper::UpsideDown] {
        check_refused(tamper, &measure(name, &camera, (&[316.0], 1), tamper));
    }
}

#[test]
#[ignore = "in full"]
fn in_full() {
    check(&bars(Extent::Full));
}
