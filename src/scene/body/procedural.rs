//! Procedural small bodies: an ellipsoid with relief and craters.

use super::Mesh;
use super::crater::BodyCrater;
use super::relief::BodyRelief;
use crate::scene::{SceneError, limits};
use crate::stats::random_stream;
use nalgebra::Vector3;
use rand_distr::{Distribution, UnitSphere};
use serde::{Deserialize, Serialize};

/// An ellipsoid with fractal relief and craters. Its surface is seen whole from its centre, so it is watertight.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ProceduralBody {
    /// Semi-axes along x, y, z in m (default 300, 250, 220).
    pub semi_axes_m: [f64; 3],
    /// The mesh has 20·4ⁿ faces (default n = 6: 81,920).
    pub subdivisions: u32,
    /// R.m.s. relief over the mean semi-axis (default 0.04).
    pub relief: f64,
    /// Octaves of relief, from a third of the circumference down (default 5).
    pub relief_octaves: u32,
    /// Number of craters (default 200).
    pub craters: usize,
    /// Radius of the smallest crater over the mean semi-axis (default 0.06).
    pub smallest_crater: f64,
    /// Radius of the largest crater over the mean semi-axis (default 0.45).
    pub largest_crater: f64,
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
        }
    }
}

impl ProceduralBody {
    /// The body's mesh, closed and outward; the same for the same seed. Its centre of mass is near the origin only.
    pub fn mesh(&self, seed: u64) -> Mesh {
        let semi_axes = Vector3::from(self.semi_axes_m);
        let mean_m = semi_axes.mean();
        let relief = BodyRelief::new(self.relief, self.relief_octaves, &mut random_stream(seed, "body-relief", 0));
        let craters = self.random_craters(seed);
        let mut mesh = Mesh::icosphere(self.subdivisions);
        for vertex in &mut mesh.vertices_m {
            let point = vertex.component_mul(&semi_axes);
            let craters_m: f64 = craters.iter().map(|c| c.height_m(&point)).sum();
            let height_m = mean_m * relief.at(&(point / mean_m)) + craters_m;
            let radius_m = point.norm();
            *vertex = point * ((radius_m + height_m).max(0.2 * radius_m) / radius_m);
        }
        mesh
    }

    fn random_craters(&self, seed: u64) -> Vec<BodyCrater> {
        let semi_axes = Vector3::from(self.semi_axes_m);
        let radii_m = (self.smallest_crater * semi_axes.mean(), self.largest_crater * semi_axes.mean());
        let crater = |index: usize| {
            let mut random = random_stream(seed, "body-crater", index as u64);
            let center_m = Vector3::from(UnitSphere.sample(&mut random)).component_mul(&semi_axes);
            BodyCrater::random(center_m, radii_m, &mut random)
        };
        (0..self.craters).map(crater).collect()
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), SceneError> {
        for semi_axis_m in self.semi_axes_m {
            limits::within("semi_axes_m", semi_axis_m, 0.01, 1e6)?;
        }
        limits::count("subdivisions", self.subdivisions as usize, 2, 9)?;
        limits::within("relief", self.relief, 0.0, 0.2)?;
        limits::count("relief_octaves", self.relief_octaves as usize, 1, 12)?;
        limits::count("craters", self.craters, 0, 10_000)?;
        limits::within("largest_crater", self.largest_crater, 1e-4, 1.0)?;
        limits::within("smallest_crater", self.smallest_crater, 1e-4, self.largest_crater)
    }
}
