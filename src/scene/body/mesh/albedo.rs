//! Albedo painted on a mesh.

use super::albedo_image::AlbedoImage;
use super::mesh::Mesh;
use nalgebra::Vector3;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Albedo over the surface's mean: 1 on average.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum MeshAlbedo {
    /// The same everywhere.
    #[default]
    Uniform,
    /// One value a vertex, linear across each face.
    Vertices(Vec<f32>),
    /// An image laid on by texture coordinates.
    Texture {
        /// Coordinates of the three corners of each face: u to the right and v up, 0 to 1 over the image.
        corners: Vec<[[f32; 2]; 3]>,
        /// The image.
        image: AlbedoImage,
    },
    /// A map of east longitude (to the right) and latitude (up), over the whole sphere.
    Globe(GlobeMap),
}

/// A simple cylindrical (plate carrée) map.
#[derive(Debug, Clone, PartialEq)]
pub struct GlobeMap {
    /// The image.
    pub image: AlbedoImage,
    /// East longitude of its left edge in rad.
    pub west_edge_rad: f64,
    /// Where longitudes and latitudes are counted from, in the mesh's axes, m.
    pub origin_m: Vector3<f64>,
}

impl GlobeMap {
    /// Value in the direction of a point in the mesh's axes.
    pub fn at(&self, point_m: &Vector3<f64>) -> f64 {
        let direction = point_m - self.origin_m;
        let longitude_rad = direction.y.atan2(direction.x);
        let latitude_rad = direction.z.atan2(direction.x.hypot(direction.y));
        self.image.at([(longitude_rad - self.west_edge_rad) / TAU, 0.5 - latitude_rad / PI])
    }
}

/// Places where the mean of the albedo is taken, at least.
const MEAN_SAMPLES: usize = 200_000;

impl MeshAlbedo {
    /// Albedo of vertices as a file has it; scaled later.
    pub(in crate::scene) fn of_vertices(values: &[f64]) -> Self {
        MeshAlbedo::Vertices(values.iter().map(|v| *v as f32).collect())
    }

    fn scaled(self, factor: f64) -> Self {
        match self {
            MeshAlbedo::Uniform => MeshAlbedo::Uniform,
            MeshAlbedo::Vertices(values) => {
                MeshAlbedo::Vertices(values.into_iter().map(|v| (f64::from(v) * factor) as f32).collect())
            }
            MeshAlbedo::Texture { corners, image } => MeshAlbedo::Texture { corners, image: image.scaled(factor) },
            MeshAlbedo::Globe(map) => MeshAlbedo::Globe(GlobeMap { image: map.image.scaled(factor), ..map }),
        }
    }
}

impl Mesh {
    /// Albedo over the surface's mean at a point of a face, given by the weights of its corners (which add up to 1).
    ///
    /// # Panics
    /// If the mesh has no such face.
    pub fn relative_albedo(&self, face: usize, weights: [f64; 3]) -> f64 {
        let mixed = |values: [f64; 3]| (0..3).map(|k| weights[k] * values[k]).sum::<f64>();
        match &self.albedo {
            MeshAlbedo::Uniform => 1.0,
            MeshAlbedo::Vertices(values) => mixed(self.faces[face].map(|vertex| f64::from(values[vertex as usize]))),
            MeshAlbedo::Texture { corners, image } => {
                let [u, v] = [0, 1].map(|axis| mixed(corners[face].map(|corner| f64::from(corner[axis]))));
                image.at([u, 1.0 - v])
            }
            MeshAlbedo::Globe(map) => {
                let [a, b, c] = self.corners_m(&self.faces[face]);
                map.at(&(a * weights[0] + b * weights[1] + c * weights[2]))
            }
        }
    }

    /// The mesh with its albedo scaled to a mean of 1 over its surface; uniform if the mean is not above 0.
    pub(in crate::scene) fn with_mean_albedo_1(mut self) -> Self {
        if self.albedo == MeshAlbedo::Uniform || self.faces.is_empty() {
            return self;
        }
        // The middles of n² equal pieces of each face.
        let n = (MEAN_SAMPLES as f64 / self.faces.len() as f64).sqrt().ceil().max(1.0) as usize;
        let parts: Vec<(f64, f64)> = self
            .faces
            .par_chunks(4096)
            .enumerate()
            .map(|(k, faces)| {
                let sums = faces.iter().enumerate().map(|(index, face)| {
                    let area_m2 = self.face_area_m2(face);
                    (area_m2 * self.mean_albedo_of_face(4096 * k + index, n), area_m2)
                });
                sums.fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1))
            })
            .collect();
        let (sum, area_m2) = parts.iter().fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
        let mean = sum / area_m2;
        self.albedo =
            if mean > 0.0 { std::mem::take(&mut self.albedo).scaled(1.0 / mean) } else { MeshAlbedo::Uniform };
        self
    }

    fn mean_albedo_of_face(&self, face: usize, n: usize) -> f64 {
        let mut sum = 0.0;
        for i in 0..n {
            for j in 0..2 * (n - i) - 1 {
                // Row i has upright pieces (j even) and pieces on their heads (j odd).
                let (upright, k) = (j % 2 == 0, j / 2);
                let third = if upright { 1.0 / 3.0 } else { 2.0 / 3.0 };
                let (s, t) = ((i as f64 + third) / n as f64, (k as f64 + third) / n as f64);
                sum += self.relative_albedo(face, [1.0 - s - t, s, t]);
            }
        }
        sum / (n * n) as f64
    }
}
