//! Motion during the exposure.

use crate::render::{gpu, look_at, plain};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderedFrame, Renderer, World};
use opnav::scene::{Mesh, ShutterConfig, SmallBody, View};

const T_NS: i64 = 2_000_000_000;

/// A camera at 1000 m that turns about its own axes and looks at the origin at the time stamp.
fn turning(rate_in_camera_rad_s: Vector3<f64>) -> impl Fn(i64) -> View {
    let eye = Vector3::new(1000.0, 0.0, 0.0);
    let still = look_at(eye, Vector3::zeros(), Vector3::z(), Vector3::new(1.0, 0.0, 0.0));
    move |t_ns| {
        let turn = UnitQuaternion::from_scaled_axis(rate_in_camera_rad_s * ((t_ns - T_NS) as f64 * 1e-9));
        let reference_from_camera = still.reference_from_camera * Isometry3::from_parts(Translation3::identity(), turn);
        View { t_ns, reference_from_camera, ..still }
    }
}

fn camera() -> Camera {
    Camera::from_fov(160, 160, 0.2)
}

fn exposed(mesh: Mesh, shutter: &ShutterConfig, view_at: &dyn Fn(i64) -> View) -> RenderedFrame {
    let body = SmallBody { mesh, surface: plain() };
    let mut renderer = Renderer::new(&gpu(), World::Body(&body), &camera(), &fine()).expect("ready");
    renderer.expose(shutter, T_NS, view_at).expect("a picture")
}

/// A block around the origin that leans to the right by so much of its height; the camera sees its flat front.
fn block(half_height_m: f64, lean: f64) -> Mesh {
    let half_m = Vector3::new(2.0, 2.0, half_height_m);
    let corner = |i: usize| half_m.map_with_location(|row, _, x| if i >> row & 1 == 0 { -x } else { x });
    let leaning = |p: Vector3<f64>| Vector3::new(p.x, p.y + lean * p.z, p.z);
    #[rustfmt::skip]
    let faces = [
        [0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
        [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5],
    ];
    Mesh { vertices_m: (0..8).map(corner).map(leaning).collect(), faces: faces.to_vec(), ..Mesh::default() }
}

/// A block of three pixels.
fn point() -> Mesh {
    block(2.0, 0.0)
}

/// A post of three pixels' width, higher than the picture. It leans, so that its edges pass the samples at all distances
/// in turn, and a line through its rows is not rounded to the samples.
fn post() -> Mesh {
    block(200.0, 0.1)
}

/// Samples close enough that a place in the picture is right to a hundredth of a pixel.
fn fine() -> RenderConfig {
    RenderConfig { supersampling: 8, ..RenderConfig::default() }
}

fn shutter(exposure_time_s: f64, row_time_s: f64) -> ShutterConfig {
    ShutterConfig { exposure_time_s, row_time_s, ..ShutterConfig::default() }
}

/// Light, centroid, and second central moments (uu, vv, uv).
fn moments(frame: &RenderedFrame) -> (f64, Vector2<f64>, Vector3<f64>) {
    let (mut sum, mut first, mut second) = (0.0, Vector2::zeros(), Vector3::zeros());
    for (u, v) in (0..frame.height_px).flat_map(|v| (0..frame.width_px).map(move |u| (u, v))) {
        let light = f64::from(frame.radiance[frame.index(u, v)]);
        let p = Vector2::new(f64::from(u), f64::from(v)).add_scalar(-79.5);
        sum += light;
        first += p * light;
        second += Vector3::new(p.x * p.x, p.y * p.y, p.x * p.y) * light;
    }
    assert!(sum > 0.0, "no light: {} pixels are no number", frame.radiance.iter().filter(|r| r.is_nan()).count());
    let mean = first / sum;
    (sum, mean.add_scalar(79.5), second / sum - Vector3::new(mean.x * mean.x, mean.y * mean.y, mean.x * mean.y))
}

#[test]
fn without_time_the_image_is_the_still_one_bit_for_bit() {
    let view_at = turning(Vector3::new(0.1, 0.3, 0.2));
    let body = SmallBody { mesh: point(), surface: plain() };
    let mut renderer = Renderer::new(&gpu(), World::Body(&body), &camera(), &fine()).expect("ready");
    let still = renderer.render(&view_at(T_NS)).expect("a picture");
    let bits = |frame: &RenderedFrame| -> Vec<u32> { frame.radiance.iter().map(|r| r.to_bits()).collect() };
    for shutter in [shutter(0.0, 0.0), ShutterConfig { motion: false, ..shutter(0.1, 1e-3) }] {
        assert_eq!(bits(&renderer.expose(&shutter, T_NS, &view_at).expect("a picture")), bits(&still));
    }
    let nothing_moves = |t_ns| View { t_ns, ..view_at(T_NS) };
    assert_eq!(bits(&renderer.expose(&shutter(0.1, 1e-3), T_NS, &nothing_moves).expect("a picture")), bits(&still));
    let moved = renderer.expose(&shutter(0.1, 0.0), T_NS, &view_at).expect("a picture");
    assert_ne!(bits(&moved), bits(&still));
    // The truth is that of the time stamp.
    let same = |a: &f32, b: &f32| a == b || a.is_nan() && b.is_nan();
    assert!(moved.depth_m.iter().zip(&still.depth_m).all(|(a, b)| same(a, b)) && moved.mask == still.mask);
}

#[test]
fn a_turn_smears_a_point_over_its_way() {
    let (_, _, still) = moments(&exposed(point(), &shutter(0.0, 0.0), &turning(Vector3::zeros())));
    let focal_px = camera().focal_px.x;
    for (rate, exposure_time_s) in [
        (Vector3::new(0.0, 0.04, 0.0), 0.2), // to the left: a turn about the axis that points down
        (Vector3::new(0.03, 0.0, 0.0), 0.3), // down
        (Vector3::new(0.02, 0.04, 0.0), 0.4), // down to the left
    ] {
        let (sum, centroid, second) = moments(&exposed(point(), &shutter(exposure_time_s, 0.0), &turning(rate)));
        // A pixel at the axis moves by f·ω×: (-ω_y, ω_x).
        let way_px = Vector2::new(-rate.y, rate.x) * (focal_px * exposure_time_s);
        let smear = second - still;
        let found_px = (12.0 * (smear.x + smear.y)).sqrt();
        assert!((found_px / way_px.norm() - 1.0).abs() < 0.01, "{found_px} px for {}", way_px.norm());
        let expected = Vector3::new(way_px.x.powi(2), way_px.y.powi(2), way_px.x * way_px.y) / 12.0;
        assert!((smear - expected).norm() < 0.02 * expected.norm(), "{smear} for {expected}");
        let mirrored = Vector3::new(expected.x, expected.y, -expected.z);
        let crossed = rate.x != 0.0 && rate.y != 0.0;
        assert!(!crossed || (smear - mirrored).norm() > 0.5 * expected.norm(), "the wrong direction goes unnoticed");
        // The centre of the picture is what the camera looks at in the middle of the exposure.
        assert!((centroid - Vector2::new(79.5, 79.5)).norm() < 0.02, "centroid {centroid}");
        let late_px = way_px.norm() * 0.05; // a time stamp a twentieth of the exposure aside
        assert!(late_px > 0.02, "the bar would not find a late time stamp: {late_px}");
        assert!(sum > 0.0);
    }
}

/// Centroid of each of the rows.
fn row_centroids(frame: &RenderedFrame, rows: std::ops::Range<u32>) -> Vec<(f64, f64)> {
    let centroid = |v: u32| {
        let light = |u: u32| f64::from(frame.radiance[frame.index(u, v)]);
        let sum: f64 = (0..frame.width_px).map(light).sum();
        (0..frame.width_px).map(|u| f64::from(u) * light(u)).sum::<f64>() / sum
    };
    rows.map(|v| (f64::from(v), centroid(v))).collect()
}

/// Slope, value at the picture's middle row, and largest residual of the straight line through centroids by rows.
fn line_through(centroids: &[(f64, f64)]) -> (f64, f64, f64) {
    let count = centroids.len() as f64;
    let moment = |f: &dyn Fn(f64, f64) -> f64| centroids.iter().map(|(v, u)| f(v - 79.5, *u)).sum::<f64>() / count;
    let (row, column) = (moment(&|v, _| v), moment(&|_, u| u));
    let slope = (moment(&|v, u| v * u) - row * column) / (moment(&|v, _| v * v) - row * row);
    let middle = column - slope * row;
    let residual = centroids.iter().map(|(v, u)| (u - middle - slope * (v - 79.5)).abs()).fold(0.0, f64::max);
    (slope, middle, residual)
}

#[test]
fn a_rolling_shutter_shears_what_passes() {
    let rows = 30..130;
    let still = exposed(post(), &shutter(0.0, 0.0), &turning(Vector3::zeros()));
    let (lean, middle, _) = line_through(&row_centroids(&still, rows.clone()));
    assert!((lean + 0.1).abs() < 1e-3 && (middle - 79.5).abs() < 0.02, "the still post: {lean}, {middle}");
    let (rate_rad_s, row_time_s) = (-0.1, 5e-4);
    // A turn of -ω about the axis that points down moves the picture to the right: f·ω px a second, in each row as long
    // after the middle one as rows were read since.
    let px_a_row = camera().focal_px.x * -rate_rad_s * row_time_s;
    for exposure_time_s in [0.0, 0.02] {
        let shutter = shutter(exposure_time_s, row_time_s);
        let frame = exposed(post(), &shutter, &turning(Vector3::new(0.0, rate_rad_s, 0.0)));
        let (slope, middle, residual) = line_through(&row_centroids(&frame, rows.clone()));
        let sheared = (slope - lean) / px_a_row;
        assert!((sheared - 1.0).abs() < 0.005, "{exposure_time_s} s: {sheared} of {px_a_row} px a row");
        assert!((middle - 79.5).abs() < 0.02, "{exposure_time_s} s: the middle row's post is at {middle}");
        // Eight samples a pixel place an edge to an eighth of a pixel.
        assert!(residual < 0.125, "{exposure_time_s} s: {residual} px off the line");
        // Negative controls: two per cent more time a row, and a time stamp two rows late.
        assert!((sheared / 1.02 - 1.0).abs() > 0.005 && (middle - 79.5 - 2.0 * px_a_row).abs() > 0.02);
    }
    let other_way = exposed(post(), &shutter(0.0, row_time_s), &turning(Vector3::new(0.0, -rate_rad_s, 0.0)));
    let (slope, ..) = line_through(&row_centroids(&other_way, rows));
    assert!(((slope - lean) / px_a_row + 1.0).abs() < 0.005, "the other turn shears the other way: {slope}");
}

#[test]
fn few_images_are_enough_where_little_moves() {
    // The limit of sub-pictures keeps the smear's length: only its evenness suffers.
    let view_at = turning(Vector3::new(0.0, 0.04, 0.0));
    let (_, _, still) = moments(&exposed(point(), &shutter(0.0, 0.0), &view_at));
    let few = ShutterConfig { sub_pictures_at_most: 4, ..shutter(0.2, 0.0) };
    let (_, _, second) = moments(&exposed(point(), &few, &view_at));
    let length_px = (12.0 * (second - still).x).sqrt();
    let way_px = 0.04 * 0.2 * camera().focal_px.x;
    assert!((length_px / way_px - 1.0).abs() < 0.01, "{length_px} px for {way_px}");
}
