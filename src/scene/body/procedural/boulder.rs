//! Boulders that lie on a small body.

use super::relief::BodyRelief;
use crate::scene::body::mesh::Mesh;
use nalgebra::{UnitQuaternion, Vector3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::{PI, TAU};

/// Height of a boulder's centre above the ground over its shortest semi-axis: a quarter of its height is buried.
const RAISED: f64 = 0.5;
/// Standard deviation of the tilt of its short axis from the vertical, rad.
const TILT_RAD: f64 = 0.3;
/// R.m.s. relief of a boulder over its longest semi-axis, and its octaves.
const RELIEF: f64 = 0.07;
const RELIEF_OCTAVES: u32 = 3;
/// A boulder has 80 to 5120 faces.
const SUBDIVISIONS: (u32, u32) = (1, 4);
/// Mean edge of an icosphere's faces over its radius, before it is cut.
const ICOSAHEDRON_EDGE: f64 = 1.05;

/// Radii between two limits with N(>R) ~ R^-exponent.
#[derive(Clone, Copy)]
pub(super) struct SizeLaw {
    pub smallest_m: f64,
    pub largest_m: f64,
    pub exponent: f64,
}

impl SizeLaw {
    /// Radius in m that a share 0 to 1 of all is smaller than.
    pub fn radius_m(&self, share: f64) -> f64 {
        let inverse_power =
            (1.0 - share) * self.smallest_m.powf(-self.exponent) + share * self.largest_m.powf(-self.exponent);
        inverse_power.powf(-1.0 / self.exponent)
    }
}

/// A rough ellipsoid that lies on its flat side, its longest semi-axis the boulder's radius. Intermediate and short
/// axes are those of Itokawa's boulders, about 0.7 and 0.5 (Michikami et al., "Boulder size and shape distributions on
/// asteroid Itokawa", 2010).
pub(super) struct Boulder {
    center_m: Vector3<f64>,
    semi_axes_m: Vector3<f64>,
    asteroid_from_boulder: UnitQuaternion<f64>,
    relief: BodyRelief,
}

impl Boulder {
    /// Boulder at a place on the ground; up is away from the body's centre.
    pub fn random(ground_m: Vector3<f64>, sizes: &SizeLaw, random: &mut ChaCha8Rng) -> Self {
        let radius_m = sizes.radius_m(random.random());
        let ratios = Vector3::new(1.0, random.random_range(0.6..0.9), random.random_range(0.45..0.7));
        let heading = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), random.random_range(0.0..TAU));
        let tilt: [f64; 2] = [StandardNormal.sample(random), StandardNormal.sample(random)];
        let tilt = UnitQuaternion::from_scaled_axis(Vector3::new(tilt[0], tilt[1], 0.0) * TILT_RAD);
        let up = ground_m.normalize();
        let upright = UnitQuaternion::rotation_between(&Vector3::z(), &up)
            .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), PI));
        let semi_axes_m = ratios * radius_m;
        Boulder {
            center_m: ground_m + up * (RAISED * semi_axes_m.z),
            semi_axes_m,
            asteroid_from_boulder: upright * tilt * heading,
            relief: BodyRelief::new(RELIEF, RELIEF_OCTAVES, random),
        }
    }

    /// The boulder as a closed mesh of its own, its faces no longer than `edge_m` as far as its size allows.
    pub fn mesh(&self, edge_m: f64) -> Mesh {
        let halvings = (ICOSAHEDRON_EDGE * self.semi_axes_m.x / edge_m).log2().ceil();
        let mut mesh = Mesh::icosphere(halvings.clamp(f64::from(SUBDIVISIONS.0), f64::from(SUBDIVISIONS.1)) as u32);
        for vertex in &mut mesh.vertices_m {
            let point = *vertex * (1.0 + self.relief.at(vertex)).max(0.5);
            *vertex = self.center_m + self.asteroid_from_boulder * point.component_mul(&self.semi_axes_m);
        }
        mesh
    }
}
