//! Views and worlds that cannot be pictures.

use super::{gpu, lobed, look_at, look_down, plain};
use nalgebra::{Isometry3, Vector2, Vector3};
use opnav::geometry::{Camera, Distortion};
use opnav::render::{RenderConfig, RenderError, Renderer, World};
use opnav::scene::{Mesh, SmallBody, Terrain, TerrainConfig, View};

#[test]
fn views_that_cannot_be_images_are_refused() {
    let camera = Camera::from_fov(64, 64, 1.5);
    let terrain = Terrain::new(&TerrainConfig::default(), 3);
    let config = RenderConfig::default();
    let gpu = gpu();
    let mut ground = Renderer::new(&gpu, World::Terrain(&terrain), &camera, &config).expect("ready");
    let view = look_down(&terrain, [5.0, 5.0], 10.0);
    ground.render(&view).expect("this one is a picture");
    let below = look_down(&terrain, [5.0, 5.0], -1.0);
    assert!(matches!(ground.render(&below), Err(RenderError::CameraBelowGround { t_ns: 7, .. })));
    let night = View { sun_in_reference: -Vector3::z_axis(), ..view };
    assert!(matches!(ground.render(&night), Err(RenderError::SunBelowHorizon { .. })));
    let nowhere = View { reference_from_camera: Isometry3::translation(f64::NAN, 0.0, 0.0), ..view };
    assert!(matches!(ground.render(&nowhere), Err(RenderError::ViewNotFinite { .. })));

    let body = SmallBody { mesh: lobed(20), surface: plain() };
    let mut around = Renderer::new(&gpu, World::Body(&body), &camera, &config).expect("ready");
    let at = |eye| look_at(eye, Vector3::new(1.0, 2.0, 500.0), Vector3::y(), Vector3::x());
    assert!(matches!(around.render(&at(Vector3::new(200.0, 5.0, 0.0))), Err(RenderError::CameraInsideBody { .. })));
    around.render(&at(Vector3::new(0.0, 0.0, 260.0))).expect("inside the bounding sphere, outside the body");

    // 85° off the axis in the corners.
    let half_diagonal_px = 0.5 * f64::from(camera.width_px).hypot(f64::from(camera.height_px));
    let focal_px = Vector2::repeat(half_diagonal_px / 85_f64.to_radians());
    let fisheye = Camera { distortion: Distortion::Equidistant([0.0; 4]), focal_px, ..camera };
    assert!(matches!(Renderer::new(&gpu, World::Body(&body), &fisheye, &config), Err(RenderError::LensTooWide)));
    let huge = Camera::from_fov(200_000, 64, 1.0);
    assert!(matches!(Renderer::new(&gpu, World::Body(&body), &huge, &config), Err(RenderError::ImageTooLarge { .. })));
    let wrong = RenderConfig { supersampling: 0, ..config };
    let message = Renderer::new(&gpu, World::Body(&body), &camera, &wrong).expect_err("refused").to_string();
    assert!(message.contains("render.supersampling"), "{message}");
    let torn = SmallBody { mesh: Mesh { faces: vec![[0, 1, 9]], ..body.mesh.clone() }, ..body };
    assert!(Renderer::new(&gpu, World::Body(&torn), &camera, &config).is_ok());
    let torn = SmallBody { mesh: Mesh { faces: vec![[0, 1, 9_999_999]], ..torn.mesh }, ..torn };
    assert!(matches!(Renderer::new(&gpu, World::Body(&torn), &camera, &config), Err(RenderError::UnusableMesh { .. })));
}
