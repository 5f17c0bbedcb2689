//! Depth and silhouette against an independent ray caster on the same mesh, from 10 m and from 10 km.

use super::{Bar, Extent, Tamper, awkward_camera, check, check_refused, rolled};
use crate::render::ray_caster::RayCaster;
use crate::render::{gpu, lobed, plain};
use nalgebra::{Isometry3, Unit, Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderedFrame, Renderer, World};
use opnav::scene::{SmallBody, View};
use opnav::stats::random_stream;
use rand::RngExt;
use rand_distr::{Distribution, UnitSphere};

/// A surface that falls away faster than this from one pixel to the next, in footprints of a pixel, is an edge.
const STEEPEST_FOOTPRINTS: f64 = 8.0;
/// Distances in px at which a silhouette is looked for, and the number of directions.
const SILHOUETTE_PX: [f64; 7] = [0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5];
const DIRECTIONS: u32 = 16;
/// What stands for a silhouette that is farther than the farthest of them, px.
const LOST_PX: f64 = 2.0;

/// The mesh, seen by one camera, ray by ray.
struct Eye<'a> {
    caster: &'a RayCaster<'a>,
    camera: &'a Camera,
    pose: &'a Isometry3<f64>,
}

impl Eye<'_> {
    /// z-depth at a place in the picture.
    fn depth_m(&self, pixel: &Vector2<f64>) -> Option<f64> {
        let ideal = self.camera.normalize(pixel)?;
        let direction = self.pose.rotation * Vector3::new(ideal.x, ideal.y, 1.0);
        self.caster.nearest(&self.pose.translation.vector, &direction, 0.0).map(|hit| hit.t)
    }

    /// Range over depth of a pixel.
    fn range_over_depth(&self, pixel: &Vector2<f64>) -> f64 {
        self.camera.normalize(pixel).map_or(1.0, |ideal| ideal.push(1.0).norm())
    }

    /// Whether the surface goes on smoothly for a pixel to every side.
    fn is_away_from_edges(&self, pixel: &Vector2<f64>, depth_m: f64) -> bool {
        let most_m = STEEPEST_FOOTPRINTS * depth_m / self.camera.mean_focal_px();
        let around = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)].map(|(u, v)| pixel + Vector2::new(u, v));
        around.iter().all(|near| self.depth_m(near).is_some_and(|d| (d - depth_m).abs() < most_m))
    }

    /// Distance in px to the nearest place that is hit, or not hit.
    fn silhouette_px(&self, pixel: &Vector2<f64>, hit: bool) -> f64 {
        let found = SILHOUETTE_PX.iter().find(|radius| {
            (0..DIRECTIONS).any(|k| {
                let angle = std::f64::consts::TAU * f64::from(k) / f64::from(DIRECTIONS);
                let near = pixel + Vector2::new(angle.cos(), angle.sin()) * **radius;
                self.depth_m(&near).is_some() == hit
            })
        });
        found.copied().unwrap_or(LOST_PX)
    }
}

/// What one or more pictures show.
#[derive(Default)]
struct Findings {
    /// Relative error of each depth away from edges.
    depth_errors: Vec<f64>,
    /// Pixels at edges.
    at_edges: usize,
    /// Distance from the silhouette in px of each pixel that is hit in one of picture and ray casting.
    silhouette_px: Vec<f64>,
}

impl Findings {
    fn add(&mut self, eye: &Eye, frame: &RenderedFrame, step: usize, tamper: Tamper) {
        let count = frame.depth_m.len();
        for index in (0..count).step_by(step) {
            let (u, v) = (index as u32 % frame.width_px, index as u32 / frame.width_px);
            let pixel = match tamper {
                Tamper::HalfPixel => Vector2::new(f64::from(u) + 0.5, f64::from(v) + 0.5),
                Tamper::UpsideDown => Vector2::new(f64::from(u), f64::from(frame.height_px - 1 - v)),
                _ => Vector2::new(f64::from(u), f64::from(v)),
            };
            let drawn = frame.mask[index] & RenderedFrame::BODY != 0;
            let drawn_m = f64::from(frame.depth_m[index]);
            assert_eq!(drawn, drawn_m.is_finite(), "depth and mask disagree at {u}, {v}");
            match eye.depth_m(&pixel) {
                Some(depth_m) if drawn => {
                    let by = if tamper == Tamper::RangeForDepth { eye.range_over_depth(&pixel) } else { 1.0 };
                    if eye.is_away_from_edges(&pixel, depth_m) {
                        self.depth_errors.push((drawn_m / (depth_m * by) - 1.0).abs());
                    } else {
                        self.at_edges += 1;
                    }
                }
                cast if cast.is_some() != drawn => self.silhouette_px.push(eye.silhouette_px(&pixel, drawn)),
                _ => {}
            }
        }
    }
}

/// From `range_m` before a random place of the surface, looking at it off the vertical, so that the horizon is often in
/// view.
fn poses(caster: &RayCaster, range_m: f64, count: u64) -> Vec<Isometry3<f64>> {
    let pose = |index| {
        let mut random = random_stream(21, "depth", index);
        let inward = -Vector3::from(UnitSphere.sample(&mut random));
        let hit = caster.nearest(&(-inward * 1e4), &inward, 0.0).expect("the body surrounds the origin");
        let place = inward * (hit.t - 1e4);
        let aside = Vector3::from(UnitSphere.sample(&mut random)) * random.random_range(0.3..1.2);
        let forward = (inward + aside).normalize();
        rolled(place - forward * range_m, forward, &mut random)
    };
    (0..count).map(pose).collect()
}

fn measure(range_m: f64, (views, step): (u64, usize), tamper: Tamper) -> Vec<Bar> {
    let body = SmallBody { mesh: lobed(120), surface: plain() };
    let caster = RayCaster::new(&body.mesh);
    let mut findings = Findings::default();
    // The whole body fills the picture from far away.
    let camera = awkward_camera(437, 331, if range_m > 1e3 { 0.075 } else { 1.2 });
    let mut renderer =
        Renderer::new(&gpu(), World::Body(&body), &camera, &RenderConfig::default()).expect("a renderer");
    for pose in poses(&caster, range_m, views) {
        let sun_in_reference = Unit::new_normalize(Vector3::new(1.0, 1.0, 0.4));
        let view = View { t_ns: 0, reference_from_camera: pose, sun_in_reference, sun_angular_radius_rad: 0.0 };
        let frame = renderer.render(&view).expect("a picture");
        findings.add(&Eye { caster: &caster, camera: &camera, pose: &pose }, &frame, step, tamper);
    }
    let worst = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let what = |figure: &str| format!("body from {range_m} m: {figure}");
    let share = findings.at_edges as f64 / (findings.at_edges + findings.depth_errors.len()).max(1) as f64;
    vec![
        Bar::at_most(what("relative error of z-depth, worst"), worst(&findings.depth_errors), 1e-5, ""),
        Bar::at_least(what("pixels compared"), findings.depth_errors.len() as f64, 1000.0, ""),
        Bar::at_most(what("share of pixels left out at edges"), share, 0.2, ""),
        Bar::at_most(what("silhouette off by, worst"), worst(&findings.silhouette_px), 0.5, "px"),
    ]
}

pub fn bars(extent: Extent) -> Vec<Bar> {
    let work = if extent == Extent::Small { (2, 7) } else { (8, 1) };
    [10.0, 10_000.0].iter().flat_map(|range_m| measure(*range_m, work, Tamper::Honest)).collect()
}

#[test]
fn depth_of_a_body_is_that_of_an_independent_ray_caster() {
    check(&bars(Extent::Small));
}

#[test]
fn wrong_depth_is_noticed() {
    for tamper in [Tamper::HalfPixel, Tamper::RangeForDepth, Tamper::UpsideDown] {
        check_refused(tamper, &measure(10.0, (2, 17), tamper)[..1]);
    }
    for tamper in [Tamper::HalfPixel, Tamper::UpsideDown] {
        check_refused(tamper, &measure(10_000.0, (1, 3), tamper)[3..]);
    }
}

#[test]
#[ignore = "in full"]
fn in_full() {
    check(&bars(Extent::Full));
}
