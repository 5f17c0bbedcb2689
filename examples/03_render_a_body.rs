//! Draw a small body, and ask the picture how far each pixel is.
//!
//!     cargo run --example 03_render_a_body [SHAPE.obj|ply|stl] [OUT.png]
//!
//! Without a shape file, a body is grown from a seed. The shape's unit of length is taken for a metre.

use nalgebra::{Isometry3, Matrix3, Unit, UnitQuaternion, Vector3};
use opnav::geometry::Camera;
use opnav::render::{Detector, Gpu, RenderConfig, Renderer, World};
use opnav::scene::{Mesh, ProceduralBody, SensorConfig, SmallBody, SurfaceConfig, View};
use std::error::Error;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mesh = match arguments.next() {
        Some(path) => Mesh::read(Path::new(&path), 1.0)?,
        None => ProceduralBody { subdivisions: 5, boulders: 60, ..ProceduralBody::default() }.mesh(7),
    };
    let out = arguments.next().map_or_else(|| std::env::temp_dir().join("body.png"), PathBuf::from);
    let (center_m, radius_m) = mesh.bounding_sphere();
    let surface = SurfaceConfig::default().on(&mesh, 7);
    let body = SmallBody { mesh: mesh.translated(&-center_m), surface };
    println!("{} faces within {radius_m:.0} m", body.mesh.faces.len());

    // A camera four radii away that looks at the centre; the Sun stands to its left, behind it.
    let camera = Camera::from_fov(384, 384, 32f64.to_radians());
    let eye_m = Vector3::new(4.0 * radius_m, 0.0, 0.8 * radius_m);
    let view = View {
        t_ns: 0,
        reference_from_camera: looking_at_center(eye_m),
        sun_in_reference: Unit::new_normalize(Vector3::new(1.0, -1.0, 0.6)),
        sun_angular_radius_rad: 0.0,
    };

    // The frame is what the optics collect, with the truth; the detector makes digital numbers of it.
    let gpu = Gpu::new(None)?;
    let frame = Renderer::new(&gpu, World::Body(&body), &camera, &RenderConfig::default())?.render(&view)?;
    let picture = Detector::new(&camera, &SensorConfig::default(), 7, 0).expose(&frame, view.t_ns);
    picture.to_image().ok_or("the numbers fill the picture")?.save(&out)?;

    let seen: Vec<f64> = frame.depth_m.iter().copied().filter(|d| d.is_finite()).map(f64::from).collect();
    let nearest_m = seen.iter().copied().fold(f64::INFINITY, f64::min);
    println!("drawn by {}: {} of {} pixels show the body", gpu.adapter_name(), seen.len(), frame.depth_m.len());
    println!("the nearest ground is {nearest_m:.1} m along the optical axis, the centre {:.1} m away", eye_m.norm());
    println!("picture: {}", out.display());
    Ok(())
}

/// Pose of a camera that looks at the origin, the z axis upwards in the picture.
fn looking_at_center(eye_m: Vector3<f64>) -> Isometry3<f64> {
    let forward = -eye_m.normalize();
    let right = forward.cross(&Vector3::z()).normalize();
    let axes = Matrix3::from_columns(&[right, forward.cross(&right), forward]);
    Isometry3::from_parts(eye_m.into(), UnitQuaternion::from_matrix(&axes))
}
