//! Procedural small bodies: an ellipsoid with relief, craters and boulders.

use super::boulder::{Boulder, SizeLaw};
use super::crater::BodyCrater;
use super::relief::BodyRelief;
use crate::scene::body::mesh::Mesh;
use crate::settings::{OutOfRange, limits};
use crate::stats::random_stream;
use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, UnitSphere};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Cumulative number of craters over radius, N(>R) ~ R^-2.
const CRATER_EXPONENT: f64 = 2.0;

/// An ellipsoid with fractal relief, craters and boulders. Its ground is seen whole from its centre, so it is watertight;
/// each boulder is a closed mesh of its own, sunk a little into the ground. Mass properties count the part of a boulder
/// below the ground twice, as if boulders were a little denser than the body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ProceduralBody {
    /// Semi-axes along x, y, z in m, 0.01 to 1e6 (default 300, 250, 220).
    pub semi_axes_m: [f64; 3],
    /// Number n of subdivisions, 2 to 9; the mesh has 20·4ⁿ faces (default 6: 81920 faces).
    pub subdivisions: u32,
    /// R.m.s. relief over the mean semi-axis, 0 to 0.2 (default 0.04).
    pub relief: f64,
    /// Octaves of relief, from a third of the circumference down, 1 to 12 (default 5).
    pub relief_octaves: u32,
    /// Number of craters, 0 to 10000 (default 200).
    pub craters: usize,
    /// Radius of the smallest crater over the mean semi-axis (default 0.06).
    pub smallest_crater: f64,
    /// Radius of the largest crater over the mean semi-axis, 0.0001 to 1 (default 0.45).
    pub largest_crater: f64,
    /// Number of boulders, 0 to 20000 (default 0).
    pub boulders: usize,
    /// Longest semi-axis of the smallest boulder over the mean semi-axis (default 0.01).
    pub smallest_boulder: f64,
    /// Longest semi-axis of the largest boulder over the mean semi-axis, 1e-5 to 0.5 (default 0.1).
    pub largest_boulder: f64,
    /// Exponent p of the boulders' numbers over size, N(>R) ~ R^-p, 0.1 to 10 (default 2.9, as on Bennu: DellaGiustina
    /// et al. 2019).
    pub boulder_exponent: f64,
}

impl Default for ProceduralBody {
    fn default() -> Self {
        ProceduralBody {
            semi_axes_m: [300.0, 250.0, 220.0],
            subdivisions: 6,
            relief: 0.04,
            relief_octaves: 5,
            craters: 200,
            smallest_crater: 0.06,
            largest_crater: 0.45,
            boulders: 0,
            smallest_boulder: 0.01,
            largest_boulder: 0.1,
            boulder_exponent: 2.9,
        }
    }
}

impl ProceduralBody {
    /// The body's mesh, closed and outward; the same for the same seed. Its centre of mass is near the origin only.
    pub fn mesh(&self, seed: u64) -> Mesh {
        let ground = BareBody::new(self, seed);
        let mut mesh = Mesh::icosphere(self.subdivisions);
        mesh.vertices_m.par_iter_mut().for_each(|vertex| *vertex = ground.point_m(vertex));
        let edge_m = 0.5 * mesh.mean_edge_m();
        let sizes = self.sizes(self.smallest_boulder, self.largest_boulder, self.boulder_exponent);
        let boulder = |index: usize| {
            let (direction, mut random) = scattered(seed, "body-boulder", index);
            Boulder::random(ground.point_m(&direction), &sizes, &mut random).mesh(edge_m)
        };
        for boulder in (0..self.boulders).into_par_iter().map(boulder).collect::<Vec<_>>() {
            mesh.append(&boulder);
        }
        mesh
    }

    fn mean_m(&self) -> f64 {
        Vector3::from(self.semi_axes_m).mean()
    }

    fn sizes(&self, smallest: f64, largest: f64, exponent: f64) -> SizeLaw {
        SizeLaw { smallest_m: smallest * self.mean_m(), largest_m: largest * self.mean_m(), exponent }
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        for semi_axis_m in self.semi_axes_m {
            limits::within("semi_axes_m", semi_axis_m, 0.01, 1e6)?;
        }
        limits::count("subdivisions", self.subdivisions as usize, 2, 9)?;
        limits::within("relief", self.relief, 0.0, 0.2)?;
        limits::count("relief_octaves", self.relief_octaves as usize, 1, 12)?;
        limits::count("craters", self.craters, 0, 10_000)?;
        limits::within("largest_crater", self.largest_crater, 1e-4, 1.0)?;
        limits::within("smallest_crater", self.smallest_crater, 1e-4, self.largest_crater)?;
        limits::count("boulders", self.boulders, 0, 20_000)?;
        limits::within("largest_boulder", self.largest_boulder, 1e-5, 0.5)?;
        limits::within("smallest_boulder", self.smallest_boulder, 1e-5, self.largest_boulder)?;
        limits::within("boulder_exponent", self.boulder_exponent, 0.1, 10.0)
    }
}

/// A random direction, and the stream that goes on from it.
fn scattered(seed: u64, what: &str, index: usize) -> (Vector3<f64>, ChaCha8Rng) {
    let mut random = random_stream(seed, what, index as u64);
    (Vector3::from(UnitSphere.sample(&mut random)), random)
}

/// The body without its boulders: one point in each direction of its sphere.
struct BareBody {
    semi_axes_m: Vector3<f64>,
    relief: BodyRelief,
    craters: Vec<BodyCrater>,
}

impl BareBody {
    fn new(body: &ProceduralBody, seed: u64) -> Self {
        let semi_axes_m = Vector3::from(body.semi_axes_m);
        let sizes = body.sizes(body.smallest_crater, body.largest_crater, CRATER_EXPONENT);
        let crater = |index: usize| {
            let (direction, mut random) = scattered(seed, "body-crater", index);
            BodyCrater::random(direction.component_mul(&semi_axes_m), &sizes, &mut random)
        };
        BareBody {
            semi_axes_m,
            relief: BodyRelief::new(body.relief, body.relief_octaves, &mut random_stream(seed, "body-relief", 0)),
            craters: (0..body.craters).map(crater).collect(),
        }
    }

    /// Point of the ground over a point of the unit sphere.
    fn point_m(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        let point = direction.component_mul(&self.semi_axes_m);
        let mean_m = self.semi_axes_m.mean();
        let craters_m: f64 = self.craters.iter().map(|c| c.height_m(&point)).sum();
        let height_m = mean_m * self.relief.at(&(point / mean_m)) + craters_m;
        let radius_m = point.norm();
        point * ((radius_m + height_m).max(0.2 * radius_m) / radius_m)
    }
}
