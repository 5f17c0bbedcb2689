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

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use opnav::geometry::Camera;
use rand::RngExt;

/// How much is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extent {
    /// Enough to notice a fault.
    Small,
    /// Enough to state a figure.
    Full,
}

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

/// One figure and its bound.
#[derive(Debug, Clone)]
pub struct Bar {
    quantity: String,
    measured: f64,
    bound: f64,
    unit: &'static str,
    side: Side,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Side {
    AtMost,
    AtLeast,
    Stated,
}

impl Bar {
    fn at_most(quantity: impl Into<String>, measured: f64, bound: f64, unit: &'static str) -> Self {
        Bar { quantity: quantity.into(), measured, bound, unit, side: Side::AtMost }
    }

    fn at_least(quantity: impl Into<String>, measured: f64, bound: f64, unit: &'static str) -> Self {
        Bar { quantity: quantity.into(), measured, bound, unit, side: Side::AtLeast }
    }

    /// A figure that helps to judge the others and has no bound.
    fn stated(quantity: impl Into<String>, measured: f64, unit: &'static str) -> Self {
        Bar { quantity: quantity.into(), measured, bound: f64::NAN, unit, side: Side::Stated }
    }

    /// NaN never holds.
    fn holds(&self) -> bool {
        match self.side {
            Side::AtMost => self.measured <= self.bound,
            Side::AtLeast => self.measured >= self.bound,
            Side::Stated => true,
        }
    }

    fn row(&self) -> String {
        let bound = match self.side {
            Side::AtMost => format!("<= {}", figure(self.bound)),
            Side::AtLeast => format!(">= {}", figure(self.bound)),
            Side::Stated => String::new(),
        };
        let verdict = match self.side {
            Side::Stated => "",
            _ if self.holds() => "pass",
            _ => "FAIL",
        };
        format!("{:<72} {:>10} {:>12} {:<12} {verdict}", self.quantity, figure(self.measured), bound, self.unit)
    }
}

fn figure(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e5).contains(&size) { format!("{value:.1e}") } else { format!("{value:.4}") }
}

/// Prints the bars and fails if one does not hold.
fn check(bars: &[Bar]) {
    bars.iter().for_each(|bar| println!("{}", bar.row()));
    let failed: Vec<String> = bars.iter().filter(|bar| !bar.holds()).map(Bar::row).collect();
    assert!(failed.is_empty(), "not held:\n{}", failed.join("\n"));
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
    println!("\n{:<72} {:>10} {:>12}", "renderer", "measured", "bound");
    let mut failed = Vec::new();
    for part in parts {
        for bar in part(Extent::Full) {
            println!("{}", bar.row());
            failed.extend((!bar.holds()).then(|| bar.row()));
        }
    }
    assert!(failed.is_empty(), "not held:\n{}", failed.join("\n"));
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
