//! Tests of the wing `scene::descent`.

mod build;
mod guidance;
mod imu;
mod schedule;

use opnav::scene::{DescentMotion, GuidanceConfig, PolynomialGuidance};

fn path() -> PolynomialGuidance {
    PolynomialGuidance::new(&GuidanceConfig::default())
}

fn motion() -> DescentMotion {
    DescentMotion::new(path())
}

const END_NS: i64 = 198_000_000_000;
const STEP_NS: i64 = 10_000_000;
