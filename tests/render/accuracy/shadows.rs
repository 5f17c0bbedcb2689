//! Edges of cast shadows against rays to the Sun, for a body and for ground at three elevations of the Sun.
//!
//! A pixel agrees if the ray from the surface at its centre to the Sun says the same as the mask. One that does not has
//! its edge within a pixel if rays within a pixel around it say what the mask says. Where the Sun grazes the surface
//! (the terminator), light and dark blend into each other and there is no edge to locate: such pixels are left out.

mod ground;

use super::{Bar, Extent, Tamper, awkward_camera, check, check_refused};
use crate::render::ray_caster::RayCaster;
use crate::render::{gpu, lobed, look_at, plain};
use nalgebra::{Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderedFrame, Renderer, World};
use opnav::scene::{SmallBody, View};
use rayon::prelude::*;

const WITHIN_PX: f64 = 1.0;
/// Cosine of the incidence below which the Sun grazes.
const GRAZING_COSINE: f64 = 0.12;

/// What rays say of a place in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Light {
    Lit,
    Shadowed,
    /// No surface, or one that the Sun grazes or does not face.
    Unknown,
}

/// Says what light falls on the surface at a place of the picture.
type Probe<'a> = dyn Fn(&Vector2<f64>) -> Light + Sync + 'a;

/// Counts over one picture.
#[derive(Debug, Default, Clone, Copy)]
struct Edges {
    /// Pixels beside an edge by rays.
    edges: usize,
    /// Pixels whose mask is that of no place within a pixel.
    misplaced: usize,
    /// Pixels in cast shadow.
    shadowed: usize,
}

fn is_lit(frame: &RenderedFrame, u: u32, v: u32) -> bool {
    frame.mask[frame.index(u, v)] & RenderedFrame::LIT != 0
}

/// Whether a place within a pixel has this light.
fn is_near(probe: &Probe, pixel: &Vector2<f64>, light: Light) -> bool {
    [0.3, 0.6, WITHIN_PX].iter().any(|radius| {
        (0..12).any(|k| {
            let angle = std::f64::consts::TAU * f64::from(k) / 12.0;
            probe(&(pixel + Vector2::new(angle.cos(), angle.sin()) * *radius)) == light
        })
    })
}

fn edges(frame: &RenderedFrame, probe: &Probe, tamper: Tamper) -> (Edges, Vector2<f64>) {
    let (width, height) = (frame.width_px, frame.height_px);
    let place = |u: u32, v: u32| match tamper {
        Tamper::HalfPixel => Vector2::new(f64::from(u) + 0.5, f64::from(v) + 0.5),
        Tamper::UpsideDown => Vector2::new(f64::from(u), f64::from(height - 1 - v)),
        _ => Vector2::new(f64::from(u), f64::from(v)),
    };
    let count = width * height;
    let lights: Vec<Light> = (0..count).into_par_iter().map(|k| probe(&place(k % width, k / width))).collect();
    let light = |u: u32, v: u32| lights[frame.index(u, v)];
    let mut found = Edges::default();
    let mut shifts: [Vec<f64>; 2] = Default::default();
    for (u, v) in (1..height - 1).flat_map(|v| (1..width - 1).map(move |u| (u, v))) {
        let here = light(u, v);
        if here == Light::Unknown {
            continue;
        }
        found.shadowed += usize::from(here == Light::Shadowed);
        let around = [(u - 1, v), (u + 1, v), (u, v - 1), (u, v + 1)].map(|(a, b)| light(a, b));
        if around.contains(&Light::Unknown) {
            continue;
        }
        found.edges += usize::from(around.iter().any(|other| *other != here));
        let drawn = if is_lit(frame, u, v) { Light::Lit } else { Light::Shadowed };
        if drawn != here && !is_near(probe, &place(u, v), drawn) {
            found.misplaced += 1;
        }
        for (axis, (a, b)) in [(0, (u + 1, v)), (1, (u, v + 1))] {
            let other = if is_lit(frame, a, b) { Light::Lit } else { Light::Shadowed };
            if other != drawn {
                let along = Vector2::ith(axis, 1.0);
                shifts[axis].extend(crossing(probe, &(place(u, v) + 0.5 * along), &along, (drawn, other)));
            }
        }
    }
    (found, Vector2::from(shifts.map(|s| s.iter().sum::<f64>() / s.len().max(1) as f64)))
}

/// Where along an axis the light really changes in this sense, in px from a place; `None` if not within 1.5 px.
fn crossing(probe: &Probe, middle: &Vector2<f64>, along: &Vector2<f64>, (from, to): (Light, Light)) -> Option<f64> {
    const STEP_PX: f64 = 0.1;
    let at = |k: i32| probe(&(middle + along * (f64::from(k) * STEP_PX)));
    let changes = |k: i32| at(k) == from && at(k + 1) == to;
    (0..15).flat_map(|k| [k, -k - 1]).find(|k| changes(*k)).map(|k| (f64::from(k) + 0.5) * STEP_PX)
}

fn bars_of(what: &str, (found, shift): (Edges, Vector2<f64>)) -> Vec<Bar> {
    let what = |figure: &str| format!("shadow edges, {what}: {figure}");
    vec![
        Bar::at_least(what("share within 1 px"), 1.0 - found.misplaced as f64 / found.edges.max(1) as f64, 0.99, ""),
        Bar::at_most(what("mean shift"), shift.amax(), 0.1, "px"),
        Bar::at_least(what("pixels on an edge"), found.edges as f64, 150.0, ""),
    ]
}

fn body(size_px: u32, tamper: Tamper) -> Vec<Bar> {
    let body = SmallBody { mesh: lobed(160), surface: plain() };
    let caster = RayCaster::new(&body.mesh);
    let camera = awkward_camera(size_px, size_px * 5 / 6, 0.42);
    let eye = Vector3::new(300.0, 1700.0, 500.0);
    let view = look_at(eye, Vector3::zeros(), Vector3::z(), Vector3::new(1.0, 0.35, 0.1));
    let frame = Renderer::new(&gpu(), World::Body(&body), &camera, &RenderConfig::default())
        .and_then(|mut renderer| renderer.render(&view))
        .expect("a picture");
    let sun = view.sun_in_reference.into_inner();
    let probe = |pixel: &Vector2<f64>| {
        let direction = direction(&camera, &view, pixel);
        let Some(hit) = caster.nearest(&eye, &direction, 0.0) else { return Light::Unknown };
        let [a, b, c] = body.mesh.faces[hit.face].map(|i| body.mesh.vertices_m[i as usize]);
        if (b - a).cross(&(c - a)).normalize().dot(&sun) < GRAZING_COSINE {
            return Light::Unknown;
        }
        let blocked = caster.nearest(&(eye + direction * hit.t), &sun, 1e-3).is_some();
        if blocked { Light::Shadowed } else { Light::Lit }
    };
    bars_of("body", edges(&frame, &probe, tamper))
}

/// Bearing of a place in the picture with z = 1, in the reference frame.
fn direction(camera: &Camera, view: &View, pixel: &Vector2<f64>) -> Vector3<f64> {
    let ideal = camera.normalize(pixel).expect("inside the picture");
    view.reference_from_camera.rotation * ideal.push(1.0)
}

pub fn bars(extent: Extent) -> Vec<Bar> {
    let size_px = if extent == Extent::Small { 300 } else { 900 };
    body(size_px, Tamper::Honest).into_iter().chain(ground::bars(extent)).collect()
}

#[test]
fn shadow_edges_lie_where_rays_to_the_sun_put_them() {
    check(&bars(Extent::Small));
}

#[test]
fn misplaced_shadows_are_noticed() {
    for tamper in [Tamper::HalfPixel, Tamper::UpsideDown] {
        check_refused(tamper, &body(300, tamper)[..2]);
        check_refused(tamper, &ground::tampered(tamper)[..2]);
    }
}

#[test]
#[ignore = "in full"]
fn in_full() {
    check(&bars(Extent::Full));
}
