//! Cameras and their lenses: there and back, derivatives, and what is refused.

use nalgebra::{SVector, Vector2, Vector3};
use opnav::geometry::{Camera, CameraError, Distortion, central_difference};

fn camera(distortion: Distortion) -> Camera {
    Camera {
        width_px: 752,
        height_px: 480,
        focal_px: Vector2::new(458.654, 457.296),
        center_px: Vector2::new(367.215, 248.375),
        distortion,
    }
}

/// The lenses of EuRoC and TUM-VI, and no lens at all.
fn cameras() -> [Camera; 3] {
    let radtan = [-0.283_408_11, 0.073_959_07, 0.000_193_59, 1.761_871_14e-5];
    let fisheye = [0.003_482_389_4, 0.000_715_034_8, -0.002_053_236_1, 0.000_202_936_7];
    let wide = Camera {
        width_px: 512,
        height_px: 512,
        focal_px: Vector2::new(190.978, 190.973),
        center_px: Vector2::new(254.931, 256.897),
        distortion: Distortion::Equidistant(fisheye),
    };
    [camera(Distortion::None), camera(Distortion::RadialTangential(radtan)), wide]
}

fn grid_px(camera: &Camera) -> Vec<Vector2<f64>> {
    let (w, h) = (f64::from(camera.width_px), f64::from(camera.height_px));
    let at = |i: u32, j: u32| Vector2::new(-0.5 + w * f64::from(i) / 12.0, -0.5 + h * f64::from(j) / 12.0);
    (0..=12).flat_map(|i| (0..=12).map(move |j| at(i, j))).collect()
}

#[test]
fn pixels_return_from_space_to_the_last_corner() {
    for camera in cameras() {
        // The fisheye's corners look further than 90° off the axis: nothing ahead of the camera falls there.
        let wide = matches!(camera.distortion, Distortion::Equidistant(_));
        assert!(wide || camera.validate().is_ok());
        let mut seen = 0;
        for pixel in grid_px(&camera) {
            let Some(bearing) = camera.unproject(&pixel) else {
                assert!(wide, "{:?} at {pixel}", camera.distortion);
                continue;
            };
            seen += 1;
            let back = camera.project(&(bearing.into_inner() * 1234.5)).expect("a bearing ahead of the camera");
            assert!((back - pixel).norm() < 1e-9, "{:?}: {pixel} came back as {back}", camera.distortion);
        }
        assert!(seen > 120, "{seen} of 169 pixels unprojected");
    }
}

#[test]
fn camera_jacobians_agree_with_central_differences() {
    for camera in cameras() {
        for pixel in grid_px(&camera) {
            let Some(bearing) = camera.unproject(&pixel) else { continue };
            // Beyond 85° off the axis the derivative by x and y grows without bound.
            if bearing.z < 0.1 {
                continue;
            }
            let point: SVector<f64, 3> = bearing.into_inner() * 3.0;
            let (_, analytic) = camera.project_with_jacobian(&point).expect("ahead of the camera");
            let project = |p: &SVector<f64, 3>| -> SVector<f64, 2> { camera.project(p).expect("ahead") };
            let numeric = central_difference(project, &point, 1e-6);
            let off = (analytic - numeric).abs().max() / analytic.abs().max();
            assert!(off < 1e-6, "{:?} at {pixel}: {off}", camera.distortion);
        }
    }
}

#[test]
fn the_axis_of_a_fisheye_is_smooth() {
    let camera = cameras()[2];
    for offset in [0.0, 1e-12, 1e-10, 1e-8, 1e-6] {
        let point = Vector3::new(offset, -offset, 1.0);
        let pixel = camera.project(&point).expect("ahead");
        let bearing = camera.unproject(&pixel).expect("on the axis");
        assert!((bearing.into_inner() - point.normalize()).norm() < 1e-13);
    }
}

#[test]
fn nothing_behind_the_camera_has_a_pixel() {
    for camera in cameras() {
        for z in [0.0, -1.0, f64::NAN] {
            assert_eq!(camera.project(&Vector3::new(0.1, 0.2, z)), None);
        }
    }
}

#[test]
fn a_lens_that_folds_over_brings_no_ghosts_into_the_image() {
    let camera = camera(Distortion::RadialTangential([-0.3, 0.0, 0.0, 0.0]));
    // Past 46° off the axis this polynomial turns back; without the check the point at 61° falls near the centre.
    assert!(camera.project(&Vector3::new(1.0, 0.0, 1.0)).is_some());
    assert_eq!(camera.project(&Vector3::new(1.15, 0.0, 1.0)), None);
    assert_eq!(camera.project(&Vector3::new(1.8, 0.0, 1.0)), None);
    assert_eq!(camera.project(&Vector3::new(2.5, 0.0, 1.0)), None);
}

#[test]
fn a_distortion_that_cannot_be_inverted_is_refused_with_its_corner() {
    let bad = [Distortion::RadialTangential([-1.5, 0.0, 0.0, 0.0]), Distortion::Equidistant([-0.9, 0.0, 0.0, 0.0])];
    for distortion in bad {
        let error = camera(distortion).validate().expect_err("corners cannot be undistorted");
        assert!(matches!(error, CameraError::NotInvertible { .. }), "{error}");
        assert!(error.to_string().contains("pixel ("), "{error}");
    }
}

#[test]
fn parameters_out_of_range_are_named() {
    let good = camera(Distortion::None);
    let bad = [
        ("width", Camera { width_px: 0, ..good }),
        ("height", Camera { height_px: 0, ..good }),
        ("fu", Camera { focal_px: Vector2::new(f64::NAN, 1.0), ..good }),
        ("fv", Camera { focal_px: Vector2::new(1.0, -1.0), ..good }),
        ("cu", Camera { center_px: Vector2::new(f64::INFINITY, 1.0), ..good }),
        ("cv", Camera { center_px: Vector2::new(1.0, f64::NAN), ..good }),
    ];
    assert_eq!(good.validate(), Ok(()));
    for (name, camera) in bad {
        let error = camera.validate().expect_err("out of range").to_string();
        assert!(error.contains(&format!("parameter {name} ")), "{error}");
    }
}

#[test]
fn the_field_of_view_spans_the_outer_edges_of_the_image() {
    let camera = Camera::from_fov(1024, 768, 60f64.to_radians());
    let edge = |u: f64| camera.unproject(&Vector2::new(u, camera.center_px.y)).expect("a pinhole").x.asin();
    assert!((edge(1023.5) - 30f64.to_radians()).abs() < 1e-12);
    assert!((edge(-0.5) + 30f64.to_radians()).abs() < 1e-12);
    assert_eq!(camera.mean_focal_px(), camera.focal_px.x);
}

#[test]
fn a_image_contains_its_pixels_and_keeps_its_margin() {
    let camera = Camera::from_fov(10, 8, 1.0);
    for (u, v, margin, inside) in [
        (-0.5, -0.5, 0.0, true),
        (9.5, 7.5, 0.0, true),
        (9.6, 7.5, 0.0, false),
        (1.0, 1.0, 1.5, true),
        (0.9, 1.0, 1.5, false),
        (8.1, 3.0, 1.5, false),
        (f64::NAN, 3.0, 0.0, false),
    ] {
        assert_eq!(camera.contains(&Vector2::new(u, v), margin), inside, "({u}, {v}) with {margin}");
    }
}
