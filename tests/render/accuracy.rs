//! What the renderer promises to the hundredth of a pixel, measured against its bounds.
//!
//! Each module measures one promise: small in the ordinary tests, in full by `accuracy_of_the_renderer`, which prints
//! every figure beside its bound. Each also has tampered measurements (half a pixel off, range for depth, upside down),
//! which its bars have to refuse.

mod closure;
mod continuity;
mod defocus;
mod depth;
mod fiducials;
mod level_of_detail;
mod shadows;
mod sphere;
mod tilted_ground;

use crate::accuracy_bar::{Bar, Extent, check, check_table};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use opnav::geometry::Camera;
use rand::RngExt;

/// What is done to a measurement on purpose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tamper {
    /// Nothing.
    Honest,
    /// Pixels half a pixel to the right and down.
    HalfPixel,
    /// The distance along the ray in place of the depth along the optical axis.
    RangeForDepth,
    /// Rows counted from below.
    UpsideDown,
}

/// Fails unless a bar refuses the tampered measurement.
fn check_refused(tamper: Tamper, bars: &[Bar]) {
    assert!(bars.iter().any(|bar| !bar.holds()), "{tamper:?} passes unnoticed: {bars:#?}");
}

/// All bars of the renderer as one table.
#[test]
#[ignore = "minutes long: run by `make accuracy`"]
fn accuracy_of_the_renderer() {
    let parts: [fn(Extent) -> Vec<Bar>; _] = [
        fiducials::bars,
        level_of_detail::bars,
        continuity::bars,
        depth::bars,
        tilted_ground::bars,
        closure::bars,
        shadows::bars,
        sphere::bars,
        defocus::bars,
    ];
    check_table("renderer", parts.into_iter().map(|part| part(Extent::Full)));
}

/// A camera with nothing convenient about it: odd size, principal point off the middle, pixels not square.
fn awkward_camera(width_px: u32, height_px: u32, fov_x_rad: f64) -> Camera {
    let plain = Camera::from_fov(width_px, height_px, fov_x_rad);
    let size = nalgebra::Vector2::new(f64::from(width_px), f64::from(height_px));
    Camera {
        focal_px: plain.focal_px.component_mul(&nalgebra::Vector2::new(1.0, 0.963)),
        center_px: plain.center_px + size.component_mul(&nalgebra::Vector2::new(-0.031, 0.023)),
        ..plain
    }
}

/// A camera at `eye` that looks along `forward`, rolled by any angle.
fn rolled(eye: Vector3<f64>, forward: Vector3<f64>, random: &mut impl rand::Rng) -> Isometry3<f64> {
    let facing = UnitQuaternion::rotation_between(&Vector3::z(), &forward)
        .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
    let roll = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), random.random_range(0.0..std::f64::consts::TAU));
    Isometry3::from_parts(Translation3::from(eye), facing * roll)
}
