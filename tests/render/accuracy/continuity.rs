//! Ground without cracks, that does not jump as the camera descends, and does not repeat itself.

use super::level_of_detail::{nearest_ground, view_from};
use super::{Bar, Extent, awkward_camera, check};
use crate::render::{gpu, look_down};
use nalgebra::{Point3, Vector2};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderedFrame, Renderer, World};
use opnav::scene::{Terrain, TerrainConfig, View};
use opnav::stats::random_stream;
use rand::RngExt;

/// The height shrinks by this from one frame to the next: a tenth of what a descent does.
const STEP: f64 = 0.99;
/// No two parts of the ground look more alike than this.
const MOST_ALIKE: f64 = 0.4;

fn renderer(terrain: &Terrain, camera: &Camera) -> Renderer {
    Renderer::new(&gpu(), World::Terrain(terrain), camera, &RenderConfig::default()).expect("a renderer")
}

/// Pixels without ground in some views, after what is done to each picture.
fn cracks(views: u64, tamper: impl Fn(&mut RenderedFrame)) -> Bar {
    let terrain = Terrain::new(&TerrainConfig::default(), 5);
    let camera = awkward_camera(401, 299, 1.2);
    let mut renderer = renderer(&terrain, &camera);
    let mut missing = 0;
    for index in 0..views {
        let mut random = random_stream(51, "cracks", index);
        let height_m = 10.0_f64.powf(random.random_range(0.3..4.08));
        let mut frame = renderer.render(&view_from(&terrain, height_m, &mut random)).expect("a picture");
        tamper(&mut frame);
        missing += frame.depth_m.iter().filter(|d| !d.is_finite()).count();
    }
    Bar::at_most(format!("cracks: pixels without ground in {views} views"), missing as f64, 0.0, "px")
}

/// Height of the drawn over the analytic ground at a place, blended from the four pixels around it, in m.
fn gap_m(
    terrain: &Terrain,
    (camera, view): (&Camera, &View),
    frame: &RenderedFrame,
    place: &Vector2<f64>,
) -> Option<f64> {
    let point = Point3::new(place.x, place.y, terrain.height_m(place.x, place.y));
    let pixel = camera.project(&(view.reference_from_camera.inverse() * point).coords)?;
    if !camera.contains(&pixel, 2.0) {
        return None;
    }
    let (u, v, a, b) = (pixel.x.floor(), pixel.y.floor(), pixel.x.fract(), pixel.y.fract());
    let gap = |du: f64, dv: f64| {
        let at = Vector2::new(u + du, v + dv);
        let bearing = camera.unproject(&at).expect("a pinhole").into_inner();
        let depth_m = f64::from(frame.depth_m[frame.index(at.x as u32, at.y as u32)]);
        let drawn = (view.reference_from_camera * Point3::from(bearing * (depth_m / bearing.z))).coords;
        let ground = nearest_ground(terrain, &drawn);
        (drawn - ground).norm() * (drawn.z - ground.z).signum()
    };
    Some(
        (gap(0.0, 0.0) * (1.0 - a) + gap(1.0, 0.0) * a) * (1.0 - b)
            + (gap(0.0, 1.0) * (1.0 - a) + gap(1.0, 1.0) * a) * b,
    )
}

/// Changes from frame to frame of the gap at fixed places, in px, while the camera sinks from each height to half of it; the
/// drawn depth is multiplied by what `tamper` says of a height.
fn jumps_px(heights_m: &[f64], tamper: impl Fn(f64) -> f32) -> Vec<f64> {
    let terrain = Terrain::new(&TerrainConfig::default(), 7);
    let camera = awkward_camera(331, 307, 0.8);
    let mut renderer = renderer(&terrain, &camera);
    let center = [310.0, -120.0];
    let mut jumps = Vec::new();
    for top_m in heights_m {
        let mut random = random_stream(52, "jumps", *top_m as u64);
        let reach_m = 0.15 * top_m;
        let offset = |random: &mut _| RngExt::random_range(random, -reach_m..reach_m);
        let places: Vec<_> =
            (0..40).map(|_| Vector2::from(center) + Vector2::new(offset(&mut random), offset(&mut random))).collect();
        let mut before: Vec<Option<f64>> = vec![None; places.len()];
        let mut height_m = *top_m;
        while height_m > 0.5 * top_m {
            let view = look_down(&terrain, center, height_m);
            let mut frame = renderer.render(&view).expect("a picture");
            frame.depth_m.iter_mut().for_each(|depth_m| *depth_m *= tamper(height_m));
            let footprint_m = height_m / camera.mean_focal_px();
            for (place, last) in places.iter().zip(&mut before) {
                let now = gap_m(&terrain, (&camera, &view), &frame, place);
                jumps.extend(now.zip(*last).map(|(now, last)| (now - last).abs() / footprint_m));
                *last = now;
            }
            height_m *= STEP;
        }
    }
    jumps.sort_by(f64::total_cmp);
    jumps
}

/// Largest correlation of a picture, less its wide mean, with itself moved by any shift of 24 px and more.
fn most_alike(values: &[f64], width: usize) -> f64 {
    let height = values.len() / width;
    let rows = |v: usize| &values[v * width..(v + 1) * width];
    let mut most: f64 = 0.0;
    for (du, dv) in
        (0..height / 2).flat_map(|dv| (0..width / 2).map(move |du| (du, dv))).filter(|(u, v)| u.max(v) >= &24)
    {
        let (mut product, mut squares) = (0.0, [0.0; 2]);
        for v in 0..height - dv {
            for (a, b) in rows(v).iter().zip(&rows(v + dv)[du..]) {
                product += a * b;
                squares[0] += a * a;
                squares[1] += b * b;
            }
        }
        most = most.max(product / (squares[0] * squares[1]).sqrt());
    }
    most
}

/// Radiance less the mean of each 16×16 px block's surroundings, so that only texture remains.
fn texture(frame: &RenderedFrame) -> Vec<f64> {
    let radiance: Vec<f64> = frame.radiance.iter().map(|r| f64::from(*r)).collect();
    crate::render::shading::texture::high_passed(&radiance, frame.width_px as usize)
}

fn sameness(heights_m: &[f64]) -> Bar {
    let terrain = Terrain::new(&TerrainConfig::default(), 3);
    let camera = Camera::from_fov(160, 160, 1.2);
    let mut renderer = renderer(&terrain, &camera);
    let alike = heights_m.iter().map(|height_m| {
        let frame = renderer.render(&look_down(&terrain, [900.0, 400.0], *height_m)).expect("a picture");
        most_alike(&texture(&frame), 160)
    });
    Bar::at_most("repetition: correlation of a picture with itself moved", alike.fold(0.0, f64::max), MOST_ALIKE, "")
}

fn popping(tops_m: &[f64], tamper: impl Fn(f64) -> f32) -> [Bar; 2] {
    let jumps = jumps_px(tops_m, tamper);
    let at = |share: f64| jumps[((jumps.len() - 1) as f64 * share) as usize];
    [
        Bar::at_most("popping: change of the drawn ground from frame to frame, 99 %", at(0.99), 0.1, "px"),
        Bar::stated("popping: the same, worst", at(1.0), "px"),
    ]
}

pub fn bars(extent: Extent) -> Vec<Bar> {
    if extent == Extent::Small {
        return vec![cracks(12, |_| ()), sameness(&[2000.0])];
    }
    let [most, worst] = popping(&[12_000.0, 3000.0, 750.0, 200.0, 50.0, 12.0, 4.0], |_| 1.0);
    vec![cracks(60, |_| ()), most, worst, sameness(&[10_000.0, 2000.0, 300.0, 40.0, 5.0])]
}

#[test]
fn ground_is_whole_steady_and_never_the_same() {
    check(&bars(Extent::Small));
}

#[test]
fn a_image_of_two_equal_tiles_is_noticed() {
    let terrain = Terrain::new(&TerrainConfig::default(), 3);
    let camera = Camera::from_fov(160, 160, 1.2);
    let frame = renderer(&terrain, &camera).render(&look_down(&terrain, [900.0, 400.0], 2000.0)).expect("a picture");
    let mut values = texture(&frame);
    for (v, u) in (0..160).flat_map(|v| (50..110).map(move |u| (v, u))) {
        values[v * 160 + u] = values[v * 160 + u - 50];
    }
    let alike = most_alike(&values, 160);
    assert!(alike > MOST_ALIKE, "two equal tiles correlate by {alike} only");
}

#[test]
fn a_crack_of_one_pixel_is_noticed() {
    assert!(cracks(1, |_| ()).holds(), "whole ground is refused");
    assert!(!cracks(1, |frame| frame.depth_m[4321] = f32::INFINITY).holds(), "a hole passes unnoticed");
}

#[test]
fn ground_that_jumps_is_noticed() {
    let [steady, _] = popping(&[200.0], |_| 1.0);
    // By half a pixel, three times in seventy frames.
    let jumping = |height_m: f64| if ((height_m / 30.0) as u32).is_multiple_of(2) { 1.0 } else { 1.0 + 0.5 / 391.0 };
    let [most, _] = popping(&[200.0], jumping);
    assert!(!most.holds() && most.measured > 2.0 * steady.measured, "jumps pass unnoticed: {most:?}, {steady:?}");
}

#[test]
#[ignore = "in full"]
fn in_full() {
    check(&bars(Extent::Full));
}
