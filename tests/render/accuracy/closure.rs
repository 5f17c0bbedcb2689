//! One frame, carried by its depth and the poses into the next, looks like the next.
//!
//! Both are seen through the default detector's optics, without noise and before the grey levels are rounded. A camera
//! that comes nearer resolves more: of the two, the finer picture is blurred to the coarser one's resolution. A surface that
//! is not Lambert's looks brighter from one side than from another: each grey level is carried by the ratio of what the
//! photometric function says for both cameras, from the truth's normal and albedo. Without that the residual is stated, too.

use super::{Bar, Extent, Tamper, check, check_refused};
use crate::render::{gpu, look_at};
use nalgebra::{Point3, Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderedFrame, Renderer, World};
use opnav::scene::{BodySurface, PhotometricAngles, Photometry, ProceduralBody, Scenario, Scene, SmallBody, View};
use std::path::Path;

const BOUND_LEVELS: f64 = 1.5;
/// Standard deviation of the default point-spread function, px.
const PSF_SIGMA_PX: f64 = 0.5;
/// Variance of a pixel's own square, px².
const PIXEL_VARIANCE_PX2: f64 = 1.0 / 12.0;
/// Depths that differ by less are those of one surface.
const SAME_DEPTH: f64 = 0.01;

/// A frame in grey levels of 255.
struct Exposed<'a> {
    frame: &'a RenderedFrame,
    levels: Vec<f64>,
}

impl<'a> Exposed<'a> {
    fn new(frame: &'a RenderedFrame, levels_per_radiance: f64, sigma_px: f64) -> Self {
        let levels: Vec<f64> = frame.radiance.iter().map(|r| f64::from(*r) * levels_per_radiance).collect();
        let (width, height) = (frame.width_px as usize, frame.height_px as usize);
        let across = blurred(&levels, (width, height), (1, width), sigma_px);
        Exposed { frame, levels: blurred(&across, (height, width), (width, 1), sigma_px) }
    }

    fn level(&self, index: usize) -> f64 {
        self.levels[index]
    }

    /// The 4×4 pixels around a place whose middle four carry it, row by row; `None` at the picture's edge.
    fn around(&self, pixel: &Vector2<f64>) -> Option<[usize; 16]> {
        let (u, v) = (pixel.x.floor(), pixel.y.floor());
        let fits = |low: f64, size: u32| low >= 1.0 && low + 2.0 < f64::from(size);
        (fits(u, self.frame.width_px) && fits(v, self.frame.height_px)).then(|| {
            std::array::from_fn(|k| self.frame.index(u as u32 - 1 + k as u32 % 4, v as u32 - 1 + k as u32 / 4))
        })
    }

    /// Grey level and depth at a place of the picture, by cubic convolution (Keys 1981); `None` unless all pixels that
    /// count are lit and belong to one surface.
    fn at(&self, pixel: &Vector2<f64>) -> Option<(f64, f64)> {
        let around = self.around(pixel)?;
        let depths = around.map(|index| f64::from(self.frame.depth_m[index]));
        let (low, high) =
            depths.iter().fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), d| (low.min(*d), high.max(*d)));
        let lit = around.iter().all(|index| self.frame.mask[*index] & RenderedFrame::LIT != 0);
        if !lit || high > low * (1.0 + 4.0 * SAME_DEPTH) {
            return None;
        }
        let (a, b) = (cubic_weights(pixel.x.fract()), cubic_weights(pixel.y.fract()));
        let blend = |value: &dyn Fn(usize) -> f64| (0..16).map(|k| a[k % 4] * b[k / 4] * value(k)).sum::<f64>();
        Some((blend(&|k| self.level(around[k])), blend(&|k| depths[k])))
    }
}

/// Blurs lines of values by a Gaussian; lines and the values in them lie `line` and `step` apart.
fn blurred(values: &[f64], (length, lines): (usize, usize), (step, line): (usize, usize), sigma_px: f64) -> Vec<f64> {
    let reach = (4.0 * sigma_px).ceil() as i64;
    let weight = |k: i64| if k == 0 { 1.0 } else { (-0.5 * (k as f64 / sigma_px).powi(2)).exp() };
    let total: f64 = (-reach..=reach).map(weight).sum();
    let mut result = vec![0.0; values.len()];
    for (at, first) in (0..lines).flat_map(|l| (0..length).map(move |at| (at, l * line))) {
        let inside = |k: i64| (at as i64 + k).clamp(0, length as i64 - 1) as usize;
        let sum: f64 = (-reach..=reach).map(|k| weight(k) * values[first + inside(k) * step]).sum();
        result[first + at * step] = sum / total;
    }
    result
}

fn cubic_weights(t: f64) -> [f64; 4] {
    let near = |x: f64| (1.5 * x - 2.5) * x * x + 1.0;
    let far = |x: f64| ((-0.5 * x + 2.5) * x - 4.0) * x + 2.0;
    [far(1.0 + t), near(t), near(1.0 - t), far(2.0 - t)]
}

/// How a surface scatters light.
struct Material {
    photometry: Photometry,
    /// Radiance of the sky over that of a sunlit white surface.
    sky_light: f64,
}

impl Material {
    /// Radiance of a sunlit place toward a camera; normal in reference axes, with the albedo behind it.
    fn radiance(&self, surface: &[f32; 4], view: &View, place: &Point3<f64>) -> f64 {
        let [x, y, z, albedo] = surface.map(f64::from);
        let to_camera = (Point3::from(view.reference_from_camera.translation.vector) - place).normalize();
        let angles = PhotometricAngles::new(&Vector3::new(x, y, z), &view.sun_in_reference, &to_camera);
        self.photometry.reflectance(albedo, &angles) + self.sky_light * albedo * (0.5 + 0.5 * z)
    }
}

/// Residuals in grey levels of the pixels that both frames see lit.
fn residuals(
    camera: &Camera,
    material: Option<&Material>,
    [(from, from_view), (to, to_view)]: [(&Exposed, &View); 2],
    tamper: Tamper,
) -> Vec<f64> {
    let surface = from.frame.surface.as_ref().expect("asked for");
    let to_from = to_view.reference_from_camera.inverse() * from_view.reference_from_camera;
    let mut residuals = Vec::new();
    for (index, seen) in surface.iter().enumerate() {
        let (u, v) = (index as u32 % camera.width_px, index as u32 / camera.width_px);
        let depth_m = f64::from(from.frame.depth_m[index]);
        if from.frame.mask[index] & RenderedFrame::LIT == 0 {
            continue;
        }
        let bearing = camera.unproject(&Vector2::new(f64::from(u), f64::from(v))).expect("inside").into_inner();
        let scale = if tamper == Tamper::RangeForDepth { depth_m } else { depth_m / bearing.z };
        let place = (to_from * Point3::from(bearing * scale)).coords;
        let Some(mut pixel) = camera.project(&place) else { continue };
        match tamper {
            Tamper::HalfPixel => pixel = pixel.add_scalar(0.5),
            Tamper::UpsideDown => pixel.y = f64::from(camera.height_px) - 1.0 - pixel.y,
            _ => {}
        }
        let Some((level, seen_m)) = to.at(&pixel) else { continue };
        if (seen_m / place.z - 1.0).abs() < SAME_DEPTH {
            let place = from_view.reference_from_camera * Point3::from(bearing * scale);
            let brighter = material.map_or(1.0, |material| {
                let toward = |view: &View| material.radiance(seen, view, &place);
                toward(to_view) / toward(from_view)
            });
            residuals.push((level - from.level(index) * brighter).abs());
        }
    }
    residuals
}

/// Grey levels a unit of radiance that put the 99th percentile of the lit pixels at four fifths of the range.
fn levels_per_radiance(frame: &RenderedFrame) -> f64 {
    let lit = frame.radiance.iter().zip(&frame.mask).filter(|(_, mask)| **mask & RenderedFrame::LIT != 0);
    let mut lit: Vec<f32> = lit.map(|(radiance, _)| *radiance).collect();
    lit.sort_by(f32::total_cmp);
    0.8 * 255.0 / f64::from(lit[lit.len() * 99 / 100])
}

fn median_depth_m(frame: &RenderedFrame) -> f64 {
    let mut depths: Vec<f32> = frame.depth_m.iter().copied().filter(|d| d.is_finite()).collect();
    depths.sort_by(f32::total_cmp);
    f64::from(depths[depths.len() / 2])
}

/// What closes and what it is made of.
struct Pair<'a> {
    camera: &'a Camera,
    material: Material,
    views: [View; 2],
}

/// Median residuals between two views, with and without the change of the photometric function, and the share of the first
/// frame's lit pixels that they rest on.
fn closure(renderer: &mut Renderer, Pair { camera, material, views }: &Pair, tamper: Tamper) -> [f64; 3] {
    let frames = [0, 1].map(|k| renderer.render(&views[k]).expect("a picture"));
    let levels_per_radiance = levels_per_radiance(&frames[0]);
    let [near, far] = [&frames[1], &frames[0]].map(median_depth_m);
    // How much finer one pixel of the second frame is; what its blur lacks, in its own pixels.
    let variance = |finer: f64| (finer * finer - 1.0).max(0.0) * (PSF_SIGMA_PX.powi(2) + PIXEL_VARIANCE_PX2);
    let sigma_px = [near / far, far / near].map(|finer| (PSF_SIGMA_PX.powi(2) + variance(finer)).sqrt());
    let exposed = [0, 1].map(|k| Exposed::new(&frames[k], levels_per_radiance, sigma_px[k]));
    let [carried, as_they_are] = [Some(material), None].map(|material| {
        let mut found = residuals(camera, material, [(&exposed[0], &views[0]), (&exposed[1], &views[1])], tamper);
        found.sort_by(f64::total_cmp);
        found
    });
    let median = |residuals: &[f64]| residuals.get(residuals.len() / 2).copied().unwrap_or(f64::NAN);
    let lit = frames[0].mask.iter().filter(|mask| **mask & RenderedFrame::LIT != 0).count();
    [median(&carried), median(&as_they_are), carried.len() as f64 / lit as f64]
}

fn renderer(world: World, camera: &Camera) -> Renderer {
    let config = RenderConfig { surface_truth: true, ..RenderConfig::default() };
    Renderer::new(&gpu(), world, camera, &config).expect("a renderer")
}

fn scene(name: &str, size_px: u32) -> Scene {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/datasets"));
    let overrides = ["width", "height"].map(|side| format!("camera.{side}_px={size_px}"));
    let scenario = Scenario::read(&folder.join(name), &overrides).expect("a scenario of the project");
    scenario.build(folder).expect("a scene")
}

fn measured(what: &str, [carried, as_they_are, share]: [f64; 3]) -> [Bar; 3] {
    [
        Bar::at_most(format!("closure, {what}: median residual"), carried, BOUND_LEVELS, "levels"),
        Bar::stated(format!("closure, {what}: as if Lambert's surface"), as_they_are, "levels"),
        Bar::at_least(format!("closure, {what}: share of lit pixels"), share, 0.3, ""),
    ]
}

/// The reference descent, by the height of the first frame of each pair.
fn descent(heights_m: &[f64], size_px: u32, tamper: Tamper) -> Vec<Bar> {
    let Scene::Descent(scene) = scene("mars_descent.toml", size_px) else { panic!("not a descent") };
    let (camera, views) = (scene.cameras[0].sensor.camera, &scene.cameras[0].views);
    let mut renderer = renderer(World::Terrain(&scene.terrain), &camera);
    let pair = |height_m: f64| {
        let first = views.iter().position(|view| view.reference_from_camera.translation.z < height_m);
        let first = first.expect("the descent passes this height").min(views.len() - 2);
        let (photometry, sky_light) = (*scene.terrain.photometry(), scene.terrain.sky_light());
        let material = Material { photometry, sky_light };
        Pair { camera: &camera, material, views: [views[first], views[first + 1]] }
    };
    heights_m
        .iter()
        .flat_map(|h| measured(&format!("descent at {h} m"), closure(&mut renderer, &pair(*h), tamper)))
        .collect()
}

/// A camera that moves about a body which stands still under the Sun.
fn body(ranges_m: &[f64], size_px: u32, tamper: Tamper) -> Vec<Bar> {
    let mesh = ProceduralBody::default().mesh(5);
    let body = SmallBody { mesh, surface: BodySurface::default() };
    let camera = Camera::from_fov(size_px, size_px, 0.5);
    let mut renderer = renderer(World::Body(&body), &camera);
    let view = |range_m: f64, turn_rad: f64| {
        let eye = Vector3::new(turn_rad.cos(), turn_rad.sin(), 0.4).normalize() * range_m;
        look_at(eye, Vector3::zeros(), Vector3::new(0.2, 0.1, 1.0), Vector3::new(1.0, 0.8, 0.5))
    };
    let pair = |range_m: f64| Pair {
        camera: &camera,
        material: Material { photometry: body.surface.photometry, sky_light: 0.0 },
        views: [view(range_m, 0.3), view(0.995 * range_m, 0.3 + 1.5_f64.to_radians())],
    };
    ranges_m
        .iter()
        .flat_map(|r| measured(&format!("body from {r} m"), closure(&mut renderer, &pair(*r), tamper)))
        .collect()
}

/// A body that turns under the Sun changes its shading, so this one has no bound.
fn tumbling(size_px: u32) -> Bar {
    let Scene::Tumbling(scene) = scene("tumbling_paper.toml", size_px) else { panic!("not a tumbling body") };
    let (camera, views) = (scene.cameras[0].sensor.camera, &scene.cameras[0].views);
    let material = Material { photometry: scene.body.surface.photometry, sky_light: 0.0 };
    let pair = Pair { camera: &camera, material, views: [views[10], views[11]] };
    let [_, median, _] = closure(&mut renderer(World::Body(&scene.body), &camera), &pair, Tamper::Honest);
    Bar::stated("closure, body that tumbles by 7° a frame under the Sun: median residual", median, "levels")
}

pub fn bars(extent: Extent) -> Vec<Bar> {
    match extent {
        Extent::Small => [descent(&[3000.0], 256, Tamper::Honest), body(&[1500.0], 256, Tamper::Honest)].concat(),
        Extent::Full => [
            descent(&[6500.0, 3000.0, 1000.0, 300.0, 100.0, 30.0], 1024, Tamper::Honest),
            body(&[3000.0, 1500.0, 800.0, 450.0], 1024, Tamper::Honest),
            vec![tumbling(1024)],
        ]
        .concat(),
    }
}

#[test]
fn a_frame_carried_by_its_truth_looks_like_the_next() {
    check(&bars(Extent::Small));
}

#[test]
fn a_frame_carried_wrongly_is_noticed() {
    for tamper in [Tamper::HalfPixel, Tamper::RangeForDepth, Tamper::UpsideDown] {
        check_refused(tamper, &descent(&[1000.0], 256, tamper));
    }
    for tamper in [Tamper::HalfPixel, Tamper::UpsideDown] {
        check_refused(tamper, &body(&[1500.0], 256, tamper));
    }
}

#[test]
#[ignore = "in full"]
fn in_full() {
    check(&bars(Extent::Full));
}
