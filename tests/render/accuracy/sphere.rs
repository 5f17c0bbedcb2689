//! A finely meshed Lambert sphere against its formula, averaged over each pixel.

use super::{Bar, Extent, Tamper, awkward_camera, check, check_refused, rolled};
use crate::render::ray_caster::RayCaster;
use crate::render::{gpu, inner, plain};
use nalgebra::{Unit, Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderedFrame, Renderer, World};
use opnav::scene::{Mesh, SmallBody, View};
use opnav::stats::random_stream;
use rand_distr::{Distribution, UnitSphere};

const RADIUS_M: f64 = 100.0;
/// Rays a pixel and axis.
const RAYS: u32 = 4;
/// Where the Sun stands lower, or the surface is seen more obliquely, the formula changes much within a pixel.
const LEAST_COSINE: f64 = 0.1;

/// The sphere as one picture has it.
struct Scene<'a> {
    camera: &'a Camera,
    view: View,
    albedo: f64,
}

impl Scene<'_> {
    fn direction(&self, pixel: &Vector2<f64>) -> Vector3<f64> {
        let ideal = self.camera.normalize(pixel).expect("a pinhole");
        self.view.reference_from_camera.rotation * ideal.push(1.0)
    }

    /// Cosines of incidence and emission where a ray meets the sphere.
    fn cosines(&self, pixel: &Vector2<f64>) -> Option<(f64, f64)> {
        let (eye, direction) = (self.view.reference_from_camera.translation.vector, self.direction(pixel).normalize());
        let along = -eye.dot(&direction);
        let squared = along * along - eye.norm_squared() + RADIUS_M * RADIUS_M;
        (squared > 0.0).then(|| {
            let normal = (eye + direction * (along - squared.sqrt())) / RADIUS_M;
            (normal.dot(&self.view.sun_in_reference), -normal.dot(&direction))
        })
    }

    /// Radiance over a pixel; `None` where a ray misses the sphere or grazes.
    fn radiance(&self, pixel: &Vector2<f64>) -> Option<f64> {
        let mut sum = 0.0;
        for k in 0..RAYS * RAYS {
            let share = |k: u32| (f64::from(k) + 0.5) / f64::from(RAYS) - 0.5;
            let (sun, eye) = self.cosines(&(pixel + Vector2::new(share(k % RAYS), share(k / RAYS))))?;
            if sun < LEAST_COSINE || eye < LEAST_COSINE {
                return None;
            }
            sum += sun;
        }
        Some(self.albedo * sum / f64::from(RAYS * RAYS))
    }

    /// Radiance at a pixel's centre of the mesh with normals that are blended from those of its vertices.
    fn radiance_of_mesh(&self, caster: &RayCaster, mesh: &Mesh, pixel: &Vector2<f64>) -> Option<f64> {
        let eye = self.view.reference_from_camera.translation.vector;
        let hit = caster.nearest(&eye, &self.direction(pixel), 0.0)?;
        let [a, b, c] = mesh.faces[hit.face].map(|i| mesh.vertices_m[i as usize]);
        let [u, v] = hit.weights;
        let normal = (a * (1.0 - u - v) + b * u + c * v).normalize();
        Some(self.albedo * normal.dot(&self.view.sun_in_reference))
    }
}

fn worst(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}

fn measure(subdivisions: u32, views: u64, tamper: Tamper) -> Vec<Bar> {
    let mut mesh = Mesh::icosphere(subdivisions);
    mesh.vertices_m.iter_mut().for_each(|vertex| *vertex *= RADIUS_M);
    let body = SmallBody { mesh, surface: plain() };
    let caster = RayCaster::new(&body.mesh);
    let camera = awkward_camera(523, 517, 0.24);
    let mut renderer =
        Renderer::new(&gpu(), World::Body(&body), &camera, &RenderConfig::default()).expect("a renderer");
    let (mut errors, mut of_the_mesh) = (Vec::new(), Vec::new());
    for index in 0..views {
        let mut random = random_stream(41, "sphere", index);
        let forward = Vector3::from(UnitSphere.sample(&mut random));
        let sun = Vector3::from(UnitSphere.sample(&mut random)) - forward;
        let view = View {
            t_ns: 0,
            reference_from_camera: rolled(-forward * 1000.0, forward, &mut random),
            sun_in_reference: Unit::new_normalize(sun),
            sun_angular_radius_rad: 0.0,
        };
        let frame = renderer.render(&view).expect("a picture");
        let scene = Scene { camera: &camera, view, albedo: body.surface.albedo };
        for (u, v) in inner(&frame, 1, |i| frame.mask[i] & RenderedFrame::LIT != 0) {
            let at = match tamper {
                Tamper::HalfPixel => Vector2::new(f64::from(u) + 0.5, f64::from(v) + 0.5),
                Tamper::UpsideDown => Vector2::new(f64::from(u), f64::from(frame.height_px - 1 - v)),
                _ => Vector2::new(f64::from(u), f64::from(v)),
            };
            let Some(expected) = scene.radiance(&at) else { continue };
            errors.push((f64::from(frame.radiance[frame.index(u, v)]) / expected - 1.0).abs());
            let meshed = scene.radiance_of_mesh(&caster, &body.mesh, &at).expect("the mesh is hit");
            let smooth = scene.cosines(&at).expect("the sphere is hit").0 * scene.albedo;
            of_the_mesh.push((meshed / smooth - 1.0).abs());
        }
    }
    let faces = body.mesh.faces.len();
    vec![
        Bar::at_most("Lambert sphere: relative error of radiance, worst", worst(errors.iter().copied()), 2e-3, ""),
        Bar::stated("Lambert sphere: the same, mean", errors.iter().sum::<f64>() / errors.len() as f64, ""),
        Bar::stated(format!("Lambert sphere: worst that its {faces} faces cause"), worst(of_the_mesh.into_iter()), ""),
        Bar::at_least("Lambert sphere: pixels compared", errors.len() as f64, 10_000.0, ""),
    ]
}

pub fn bars(extent: Extent) -> Vec<Bar> {
    match extent {
        Extent::Small => measure(7, 1, Tamper::Honest),
        Extent::Full => measure(8, 6, Tamper::Honest),
    }
}

#[test]
fn a_lambert_sphere_has_the_radiance_of_its_formula() {
    check(&bars(Extent::Small));
}

#[test]
fn a_misplaced_sphere_is_noticed() {
    for tamper in [Tamper::HalfPixel, Tamper::UpsideDown] {
        check_refused(tamper, &measure(5, 1, tamper)[..1]);
    }
}

#[test]
#[ignore = "in full"]
fn in_full() {
    check(&bars(Extent::Full));
}
