//! What a front end finds in the pictures.

use crate::render::{detector, gpu, interpolated, lit_frame, look_at, look_down, render, sphere};
use image::GrayImage;
use nalgebra::{Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderedFrame, Renderer, World};
use opnav::scene::{BodySurface, SensorConfig, SmallBody, Terrain, TerrainConfig};

/// A picture minus its own wide mean.
pub fn high_passed(values: &[f64], width: usize) -> Vec<f64> {
    let height = values.len() / width;
    let reach = 5;
    let mean = |u: usize, v: usize| {
        let (rows, columns) =
            (v.saturating_sub(reach)..(v + reach + 1).min(height), u.saturating_sub(reach)..(u + reach + 1).min(width));
        let count = (rows.len() * columns.len()) as f64;
        rows.flat_map(|b| columns.clone().map(move |a| values[b * width + a])).sum::<f64>() / count
    };
    (0..values.len()).map(|i| values[i] - mean(i % width, i / width)).collect()
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(p, q)| p * q).sum::<f64>();
    dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()
}

/// A frame as the default detector's optics pass it on: what is finer than pixels resolve is no texture to a front end.
fn through_optics(mut frame: RenderedFrame) -> RenderedFrame {
    let config = SensorConfig { noise: false, bits: 16, ..SensorConfig::default() };
    let picture = detector(&frame, &config, 1).expose(&frame, 0).to_image().expect("a picture").into_luma16();
    frame.radiance = picture.into_raw().into_iter().map(f32::from).collect();
    frame
}

#[test]
fn texture_persists_over_a_tenth_of_scale() {
    let terrain = Terrain::new(&TerrainConfig::default(), 12);
    let camera = Camera::from_fov(320, 320, 1.2);
    let mut renderer =
        Renderer::new(&gpu(), World::Terrain(&terrain), &camera, &RenderConfig::default()).expect("ready");
    let place = [25.0, 31.0];
    for height_m in [7000.0, 2900.0, 1000.0, 333.0, 80.0, 23.0, 6.0] {
        // Sideways too, so that texture which hangs on the camera is found out.
        let aside = [place[0] + 0.037 * height_m, place[1] - 0.021 * height_m];
        let (near, far) = (look_down(&terrain, place, height_m), look_down(&terrain, aside, 1.1 * height_m));
        let [near_frame, far_frame] = [&near, &far].map(|view| through_optics(renderer.render(view).expect("a frame")));
        // Where each pixel of the near picture lies in the far one, by the near one's depth.
        let far_from_near = far.reference_from_camera.inverse() * near.reference_from_camera;
        let (mut seen_near, mut seen_far) = (Vec::new(), Vec::new());
        for (u, v) in (40..280).flat_map(|v| (40..280).map(move |u| (u, v))) {
            let index = near_frame.index(u, v);
            let ideal = camera.normalize(&Vector2::new(f64::from(u), f64::from(v))).expect("a pinhole");
            let place = Vector3::new(ideal.x, ideal.y, 1.0) * f64::from(near_frame.depth_m[index]);
            let pixel = camera.project(&(far_from_near * nalgebra::Point3::from(place)).coords).expect("in front");
            seen_near.push(f64::from(near_frame.radiance[index]));
            seen_far.push(interpolated(&far_frame, &pixel));
        }
        let same = correlation(&high_passed(&seen_near, 240), &high_passed(&seen_far, 240));
        println!("{height_m} m: correlation {same:.3}");
        assert!(same > 0.9, "correlation {same:.3} between {height_m} m and a tenth more");
    }
}

/// The picture of a detector with default settings.
fn detected(frame: &RenderedFrame) -> GrayImage {
    let picture = detector(frame, &SensorConfig::default(), 1).expose(frame, 0);
    picture.to_image().expect("a picture").into_luma8()
}

/// The best Harris response of each block of 8×8 px.
fn harris_responses(picture: &GrayImage) -> std::collections::BTreeMap<(u32, u32), f64> {
    let (width, height) = picture.dimensions();
    let at = |u: u32, v: u32| f64::from(picture.get_pixel(u, v)[0]);
    let gradient = |u: u32, v: u32| Vector2::new(at(u + 1, v) - at(u - 1, v), at(u, v + 1) - at(u, v - 1)) * 0.5;
    let response = |u: u32, v: u32| {
        let mut moments = nalgebra::Matrix2::zeros();
        for (a, b) in (u - 2..=u + 2).flat_map(|a| (v - 2..=v + 2).map(move |b| (a, b))) {
            let g = gradient(a, b);
            moments += g * g.transpose();
        }
        moments.determinant() - 0.04 * moments.trace().powi(2)
    };
    let mut best = std::collections::BTreeMap::new();
    for (u, v) in (3..height - 3).flat_map(|v| (3..width - 3).map(move |u| (u, v))) {
        let value = response(u, v);
        let entry = best.entry((u / 8, v / 8)).or_insert(value);
        *entry = value.max(*entry);
    }
    best
}

fn greatest(responses: &std::collections::BTreeMap<(u32, u32), f64>) -> f64 {
    responses.values().copied().fold(0.0, f64::max)
}

/// Blocks with a Harris response above a least one.
fn blocks_above(
    responses: &std::collections::BTreeMap<(u32, u32), f64>,
    least: f64,
) -> std::collections::BTreeSet<(u32, u32)> {
    responses.iter().filter(|(_, value)| **value > least).map(|(block, _)| *block).collect()
}

/// Blocks with a corner far above what noise alone makes.
fn harris_blocks(picture: &GrayImage) -> std::collections::BTreeSet<(u32, u32)> {
    const FAR_ABOVE_NOISE: f64 = 300.0;
    let noise = greatest(&harris_responses(&detected(&lit_frame(512, |_, _| 0.1))));
    blocks_above(&harris_responses(picture), FAR_ABOVE_NOISE * noise)
}

fn parts(corners: &std::collections::BTreeSet<(u32, u32)>) -> usize {
    corners.iter().map(|(u, v)| (u / 8, v / 8)).collect::<std::collections::BTreeSet<_>>().len()
}

fn seen_from_above(config: &TerrainConfig, place: [f64; 2], height_m: f64) -> GrayImage {
    let terrain = Terrain::new(config, 1);
    let camera = Camera::from_fov(512, 512, std::f64::consts::FRAC_PI_2);
    detected(&render(
        World::Terrain(&terrain),
        &camera,
        &RenderConfig::default(),
        &look_down(&terrain, place, height_m),
    ))
}

/// Also where a scarp outshines all else (1254 m): a share of the best corner would count little but its edge there.
#[test]
fn every_height_has_hundreds_of_spread_corners() {
    let bland = TerrainConfig { albedo_contrast: 0.01, rms_slope: 0.01, ..TerrainConfig::default().without_features() };
    for (place, height_m) in [
        ([3300.0, 5870.0], 6570.0),
        ([995.0, 2453.0], 3030.0),
        ([158.0, 527.0], 1254.0),
        ([6.0, 28.0], 225.0),
        ([0.0, 0.5], 21.0),
        ([0.0, 0.0], 5.0),
    ] {
        let corners = harris_blocks(&seen_from_above(&TerrainConfig::default(), place, height_m));
        let on_bland = harris_blocks(&seen_from_above(&bland, place, height_m)).len();
        let spread = parts(&corners);
        println!("{height_m} m: {} corners in {spread} of 64 parts, {on_bland} on bland ground", corners.len());
        assert!(corners.len() > 400 && spread > 55, "{height_m} m: {} in {spread} of 64", corners.len());
        assert!(on_bland < 100, "{height_m} m: {on_bland} corners on bland ground");
    }
}

#[test]
fn a_body_has_hundreds_of_corners() {
    let body = SmallBody { mesh: sphere(60, |d| 200.0 + 30.0 * d.x), surface: BodySurface::default() };
    for size_px in [512, 1024] {
        let camera = Camera::from_fov(size_px, size_px, 0.5);
        let eye = Vector3::new(1100.0, 300.0, 200.0);
        let view = look_at(eye, Vector3::zeros(), Vector3::z(), Vector3::new(1.0, 0.6, 0.5));
        let frame = render(World::Body(&body), &camera, &RenderConfig::default(), &view);
        let corners = harris_blocks(&detected(&frame)).len();
        println!("{size_px} px: {corners} corners");
        assert!(corners > 300, "{corners} corners at {size_px} px");
    }
}
