//! The drawn ground against the analytic ground, at every height of a descent.
//!
//! A place on the drawn ground, found by the depth of a pixel, is compared with the place of the analytic ground nearest
//! to it. On screen is their distance in the same picture; from the side is their distance over the footprint of a
//! pixel, which no viewpoint as near can exceed.

use super::{Bar, Extent, Tamper, awkward_camera, check, check_refused};
use crate::render::{gpu, look_at};
use nalgebra::{Point3, Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderedFrame, Renderer, World};
use opnav::scene::{Terrain, TerrainConfig, View};
use opnav::stats::random_stream;
use rand::RngExt;

const HEIGHTS_M: [f64; 9] = [12_000.0, 6_000.0, 2_000.0, 600.0, 200.0, 60.0, 20.0, 6.0, 2.0];
const BOUND_PX: f64 = 0.25;
const WITHIN: &str = "share within a quarter of a pixel";

/// The place of the ground nearest to a point: the best of some steps along the ground from the place below it.
pub fn nearest_ground(terrain: &Terrain, point: &Vector3<f64>) -> Vector3<f64> {
    let ground = |at: Vector2<f64>| at.push(terrain.height_m(at.x, at.y));
    let mut at = point.xy();
    let mut best = ground(at);
    for _ in 0..20 {
        let gradient = terrain.gradient(at.x, at.y);
        let above = point - ground(at);
        let normal = Vector3::new(-gradient.x, -gradient.y, 1.0).normalize();
        let along = above - normal * normal.dot(&above);
        if along.norm() < 1e-4 * above.norm() {
            break;
        }
        at += 0.7 * along.xy();
        let found = ground(at);
        if (found - point).norm() < (best - point).norm() {
            best = found;
        }
    }
    best
}

/// Offsets of drawn places from the ground in px: on screen, and from the side.
#[derive(Default)]
struct Offsets {
    on_screen_px: Vec<f64>,
    from_the_side_px: Vec<f64>,
}

impl Offsets {
    fn add(
        &mut self,
        terrain: &Terrain,
        (camera, view): (&Camera, &View),
        frame: &RenderedFrame,
        work: (usize, Tamper),
    ) {
        let (step, tamper) = work;
        for index in (0..frame.depth_m.len()).step_by(step) {
            let (u, v) = (index as u32 % frame.width_px, index as u32 / frame.width_px);
            let pixel = match tamper {
                Tamper::HalfPixel => Vector2::new(f64::from(u) + 0.5, f64::from(v) + 0.5),
                Tamper::UpsideDown => Vector2::new(f64::from(u), f64::from(frame.height_px - 1 - v)),
                _ => Vector2::new(f64::from(u), f64::from(v)),
            };
            let bearing = camera.unproject(&pixel).expect("a pinhole").into_inner();
            let depth_m = f64::from(frame.depth_m[index]);
            if !depth_m.is_finite() {
                continue;
            }
            let in_camera =
                if tamper == Tamper::RangeForDepth { bearing * depth_m } else { bearing * (depth_m / bearing.z) };
            let drawn = view.reference_from_camera * Point3::from(in_camera);
            let ground = nearest_ground(terrain, &drawn.coords);
            let seen = camera.project(&(view.reference_from_camera.inverse() * Point3::from(ground)).coords);
            self.on_screen_px.push(seen.map_or(f64::INFINITY, |seen| (seen - pixel).norm()));
            self.from_the_side_px.push((ground - drawn.coords).norm() * camera.mean_focal_px() / in_camera.norm());
        }
    }
}

/// Down and aside, by up to 40° off the vertical.
pub fn view_from(terrain: &Terrain, height_m: f64, random: &mut impl rand::Rng) -> View {
    let [x, y] =
        [random.random_range(-1.0..1.0), random.random_range(-1.0..1.0)].map(|c: f64| c * (50.0 + 0.5 * height_m));
    let eye = Vector3::new(x, y, terrain.height_m(x, y) + height_m);
    let forward = Vector3::new(random.random_range(-0.8..0.8), random.random_range(-0.8..0.8), -1.0);
    let up = Vector3::new(random.random_range(-1.0..1.0), random.random_range(-1.0..1.0), 0.1);
    look_at(eye, eye + forward, up, Vector3::new(1.0, 0.5, 0.8))
}

fn share_within(offsets: &[f64], bound: f64) -> f64 {
    offsets.iter().filter(|o| **o <= bound).count() as f64 / offsets.len() as f64
}

fn measure(heights_m: &[f64], (views, step): (u64, usize), tamper: Tamper) -> Vec<Bar> {
    let terrain = Terrain::new(&TerrainConfig::default(), 7);
    let camera = awkward_camera(597, 443, 1.2);
    let mut renderer =
        Renderer::new(&gpu(), World::Terrain(&terrain), &camera, &RenderConfig::default()).expect("a renderer");
    let mut bars = Vec::new();
    for height_m in heights_m {
        let mut offsets = Offsets::default();
        for index in 0..views {
            let view = view_from(&terrain, *height_m, &mut random_stream(31, "level-of-detail", index));
            let frame = renderer.render(&view).expect("a picture");
            offsets.add(&terrain, (&camera, &view), &frame, (step, tamper));
        }
        let what = |figure: &str| format!("ground from {height_m} m: {figure}");
        let share = share_within(&offsets.on_screen_px, BOUND_PX);
        offsets.on_screen_px.sort_by(f64::total_cmp);
        offsets.from_the_side_px.sort_by(f64::total_cmp);
        let at = |values: &[f64], part: f64| values[((values.len() - 1) as f64 * part) as usize];
        bars.push(Bar::at_most(
            what("off the analytic ground on screen, 99.9 %"),
            at(&offsets.on_screen_px, 0.999),
            BOUND_PX,
            "px",
        ));
        bars.push(Bar::stated(what("the worst of them"), at(&offsets.on_screen_px, 1.0), "px"));
        bars.push(Bar::stated(what(WITHIN), share, ""));
        bars.push(Bar::stated(what("from the side, median"), at(&offsets.from_the_side_px, 0.5), "px"));
        bars.push(Bar::stated(what("from the side, 99 %"), at(&offsets.from_the_side_px, 0.99), "px"));
    }
    bars
}

pub fn bars(extent: Extent) -> Vec<Bar> {
    match extent {
        Extent::Small => measure(&[12_000.0, 600.0, 20.0, 2.0], (1, 331), Tamper::Honest),
        Extent::Full => measure(&HEIGHTS_M, (3, 37), Tamper::Honest),
    }
}

#[test]
fn nearly_all_drawn_ground_is_the_analytic_ground() {
    let shares: Vec<Bar> = bars(Extent::Small)
        .into_iter()
        .filter(|bar| bar.quantity.ends_with(WITHIN))
        .map(|bar| Bar::at_least(bar.quantity, bar.measured, 0.975, ""))
        .collect();
    assert_eq!(shares.len(), 4);
    check(&shares);
}

#[test]
fn misplaced_ground_is_noticed() {
    for tamper in [Tamper::HalfPixel, Tamper::RangeForDepth, Tamper::UpsideDown] {
        check_refused(tamper, &measure(&[20.0], (1, 331), tamper));
    }
}

#[test]
#[ignore = "in full"]
fn in_full() {
    check(&bars(Extent::Full));
}
