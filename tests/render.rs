//! Tests of the room `render`. They need a graphics adapter; Mesa's lavapipe will do.

mod accuracy;
mod body;
mod extremes;
mod gpu;
mod image_polygon;
mod optics;
mod ray_caster;
mod refusals;
mod sensor;
mod shading;
mod stars;
mod terrain;

use nalgebra::{Isometry3, Matrix3, Unit, UnitQuaternion, Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::render::{Detector, Gpu, RenderConfig, RenderedFrame, Renderer, World};
use opnav::scene::{BodySurface, Mesh, Photometry, SensorConfig, Terrain, TerrainConfig, View};

/// A frame lit everywhere, its radiance from each pixel's place.
fn lit_frame(side_px: u32, radiance: impl Fn(u32, u32) -> f32) -> RenderedFrame {
    let count = (side_px * side_px) as usize;
    RenderedFrame {
        width_px: side_px,
        height_px: side_px,
        radiance: (0..side_px).flat_map(|v| (0..side_px).map(move |u| (u, v))).map(|(u, v)| radiance(u, v)).collect(),
        depth_m: vec![1.0; count],
        mask: vec![RenderedFrame::BODY | RenderedFrame::LIT; count],
        surface: None,
    }
}

/// The detector of a camera with square pixels that takes frames of that size.
fn detector(frame: &RenderedFrame, config: &SensorConfig, seed: u64) -> Detector {
    let camera = Camera::from_fov(frame.width_px, frame.height_px, 1.2);
    Detector::new(&camera, config, seed, 0)
}

pub fn gpu() -> Gpu {
    Gpu::new(None).expect("a graphics adapter")
}

/// A camera at `eye` that looks at `target`, with `up` upwards in the picture.
fn look_at(eye: Vector3<f64>, target: Vector3<f64>, up: Vector3<f64>, sun: Vector3<f64>) -> View {
    let forward = (target - eye).normalize();
    let right = forward.cross(&up).normalize();
    let rotation = Matrix3::from_columns(&[right, forward.cross(&right), forward]);
    View {
        t_ns: 7,
        reference_from_camera: Isometry3::from_parts(eye.into(), UnitQuaternion::from_matrix(&rotation)),
        sun_in_reference: Unit::new_normalize(sun),
        sun_angular_radius_rad: 0.0,
    }
}

/// Straight down from above (x, y), x to the right in the picture.
fn look_down(terrain: &Terrain, [x, y]: [f64; 2], height_m: f64) -> View {
    let eye = Vector3::new(x, y, terrain.height_m(x, y) + height_m);
    look_at(eye, eye - Vector3::z(), Vector3::y(), Vector3::new(1.0, 0.5, 0.8))
}

/// A sphere whose radius is changed direction by direction.
fn sphere(rings: u32, radius_m: impl Fn(&Vector3<f64>) -> f64) -> Mesh {
    let around = 2 * rings;
    let mut mesh = Mesh::default();
    let angle = |k: u32| std::f64::consts::PI * f64::from(k) / f64::from(rings);
    for j in 0..=rings {
        for i in 0..around {
            let (colatitude, longitude) = (angle(j), angle(i));
            let direction =
                Vector3::new(colatitude.sin() * longitude.cos(), colatitude.sin() * longitude.sin(), colatitude.cos());
            mesh.vertices_m.push(direction * radius_m(&direction));
        }
    }
    // One vertex a pole, so that its normal counts all faces around it.
    let vertex = |i: u32, j: u32| j * around + if j == 0 || j == rings { 0 } else { i % around };
    for j in 0..rings {
        for i in 0..around {
            mesh.faces.push([vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1)]);
            mesh.faces.push([vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j)]);
        }
    }
    mesh
}

/// Two lobes with a neck, so that one shadows the other.
fn lobed(rings: u32) -> Mesh {
    sphere(rings, |d| 80.0 + 250.0 * d.x * d.x + 15.0 * (5.0 * d.y).sin() * (4.0 * d.z).cos())
}

fn plain() -> BodySurface {
    let photometry = Photometry::Lambert;
    BodySurface { albedo: 0.5, photometry, albedo_contrast: 0.0, detail_slope: 0.0, ..BodySurface::default() }
}

fn render(world: World, camera: &Camera, config: &RenderConfig, view: &View) -> RenderedFrame {
    Renderer::new(&gpu(), world, camera, config).expect("a renderer").render(view).expect("a picture")
}

/// Bearing of a pixel with z = 1, in the reference frame.
fn ray(camera: &Camera, view: &View, u_px: u32, v_px: u32) -> Vector3<f64> {
    let ideal = camera.normalize(&Vector2::new(f64::from(u_px), f64::from(v_px))).expect("a pinhole");
    view.reference_from_camera.rotation * Vector3::new(ideal.x, ideal.y, 1.0)
}

/// Nearest hit of a ray with a mesh in units of the direction's length, and the face (Möller and Trumbore 1997).
fn nearest_hit(mesh: &Mesh, origin: &Vector3<f64>, direction: &Vector3<f64>) -> Option<(f64, usize)> {
    let mut nearest = None;
    for (index, face) in mesh.faces.iter().enumerate() {
        let [a, b, c] = face.map(|i| mesh.vertices_m[i as usize]);
        let (ab, ac) = (b - a, c - a);
        let p = direction.cross(&ac);
        let determinant = ab.dot(&p);
        if determinant.abs() < 1e-14 {
            continue;
        }
        let from_a = origin - a;
        let u = from_a.dot(&p) / determinant;
        let q = from_a.cross(&ab);
        let v = direction.dot(&q) / determinant;
        let t = ac.dot(&q) / determinant;
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 1e-6 && nearest.is_none_or(|(n, _)| t < n) {
            nearest = Some((t, index));
        }
    }
    nearest
}

/// Pixels whose whole neighbourhood of `margin` px satisfies a condition.
fn inner(frame: &RenderedFrame, margin: u32, holds: impl Fn(usize) -> bool) -> Vec<(u32, u32)> {
    let (width, height) = (frame.width_px, frame.height_px);
    let all = (margin..height - margin).flat_map(|v| (margin..width - margin).map(move |u| (u, v)));
    all.filter(|(u, v)| {
        let near = (v - margin..=v + margin).flat_map(|b| (u - margin..=u + margin).map(move |a| (a, b)));
        near.into_iter().all(|(a, b)| holds(frame.index(a, b)))
    })
    .collect()
}

/// Lambertian ground without relief, under a black sky.
fn flat() -> TerrainConfig {
    TerrainConfig { photometry: Photometry::Lambert, sky_light: 0.0, ..TerrainConfig::level() }
}

fn interpolated(frame: &RenderedFrame, pixel: &Vector2<f64>) -> f64 {
    let (u, v) = (pixel.x.floor(), pixel.y.floor());
    let (a, b) = (pixel.x - u, pixel.y - v);
    let at = |du: u32, dv: u32| f64::from(frame.radiance[frame.index(u as u32 + du, v as u32 + dv)]);
    (at(0, 0) * (1.0 - a) + at(1, 0) * a) * (1.0 - b) + (at(0, 1) * (1.0 - a) + at(1, 1) * a) * b
}
