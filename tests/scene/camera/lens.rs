//! Camera settings.

use crate::scene::{scenario, tumbling};
use nalgebra::Vector2;
use opnav::geometry::{Camera, Distortion};

fn camera(text: &str) -> Camera {
    let first = scenario(text).expect("a scenario");
    assert_eq!(first, scenario(&first.to_toml()).expect("the resolved copy"), "{}", first.to_toml());
    first.imagers[0].camera.camera()
}

#[test]
fn lens_settings_reach_the_camera() {
    let text = "[camera]\nwidth_px = 640\nheight_px = 480\nfocal_px = [600.5, 598.25]\ncenter_px = [310.0, 250.5]\n\
                [camera.distortion]\nmodel = \"radial-tangential\"\ncoefficients = [-0.28, 0.07, 0.0002, 1.8e-5]\n[descent]";
    let found = camera(text);
    assert_eq!((found.width_px, found.height_px), (640, 480));
    assert_eq!(found.focal_px, Vector2::new(600.5, 598.25));
    assert_eq!(found.center_px, Vector2::new(310.0, 250.5));
    assert_eq!(found.distortion, Distortion::RadialTangential([-0.28, 0.07, 0.0002, 1.8e-5]));
    let fisheye = camera(
        "[camera]\nfov_deg = 60\n[camera.distortion]\nmodel = \"equidistant\"\ncoefficients = [0.01, 0, 0, 0]\n[descent]",
    );
    assert_eq!(fisheye.distortion, Distortion::Equidistant([0.01, 0.0, 0.0, 0.0]));
    assert_eq!(fisheye.focal_px, Camera::from_fov(1024, 1024, 60_f64.to_radians()).focal_px);
    // Left out: square pixels, the middle, no distortion.
    assert_eq!(camera("[descent]"), Camera::from_fov(1024, 1024, 90_f64.to_radians()));
}

#[test]
fn field_of_view_and_focal_lengths_exclude_each_other() {
    let error = scenario("[camera]\nfov_deg = 60\nfocal_px = [900, 900]\n[descent]").expect_err("refused").to_string();
    assert!(error.contains("test.toml") && error.contains("fov_deg") && error.contains("focal_px"), "{error}");
    let error = scenario("[camera.distortion]\nmodel = \"pincushion\"\n[descent]").expect_err("refused").to_string();
    assert!(error.contains("pincushion") && error.contains("line 2"), "{error}");
}

#[test]
fn a_body_stands_at_its_pixel_whatever_the_lens() {
    for lens in [
        "center_px = [20.0, 90.5]\nfocal_px = [150.0, 170.0]\n",
        "fov_deg = 40\n[camera.distortion]\nmodel = \"equidistant\"\ncoefficients = [0.02, 0, 0, 0]\n",
    ] {
        let text = format!(
            "[camera]\nwidth_px = 128\nheight_px = 128\n{lens}[tumbling]\nframes = 1\ncenter_offset_px = [12.0, -7.0]\n\
             fill_fraction = 0.3\n[tumbling.shape.procedural]\nsubdivisions = 2\n"
        );
        let scene = tumbling(&text);
        let pixel_px = scene.cameras[0].sensor.camera.project(&scene.center_in_spacecraft_m).expect("in front");
        assert!((pixel_px - Vector2::new(75.5, 56.5)).norm() < 1e-9, "{pixel_px}");
    }
}
