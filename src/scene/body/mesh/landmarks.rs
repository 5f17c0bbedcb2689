//! Landmarks spread evenly over a mesh.

use super::mesh::Mesh;
use crate::dataset::truth::Landmark;
use crate::stats::random_stream;
use nalgebra::Vector3;
use rand::RngExt;
use rayon::prelude::*;

/// Tries for a place that is not buried.
const TRIES: u64 = 16;

impl Mesh {
    /// `count` random points on the surface, one in each of `count` pieces of equal area. Where closed parts of the mesh
    /// overlap, none is inside another part; pieces that are buried altogether have none.
    pub fn spread_landmarks(&self, count: usize, seed: u64) -> Vec<Landmark> {
        let mut places: Vec<Option<Vector3<f64>>> = vec![None; count];
        let tries = if self.part_count() > 1 { TRIES } else { 1 };
        for round in 0..tries {
            if places.iter().all(Option::is_some) {
                break;
            }
            let candidates = self.spread_points(count, seed, round);
            places.par_iter_mut().zip(candidates).filter(|(place, _)| place.is_none()).for_each(
                |(place, candidate)| {
                    let (face, point_m) = candidate;
                    let is_free = tries == 1 || self.is_exposed(&self.faces[face], &point_m);
                    *place = is_free.then_some(point_m);
                },
            );
        }
        let landmark = |(id, position_m): (usize, Vector3<f64>)| Landmark { id: id as u32, position_m };
        places.into_iter().flatten().enumerate().map(landmark).collect()
    }

    /// One random point a piece: its face and its place in m.
    fn spread_points(&self, count: usize, seed: u64, round: u64) -> Vec<(usize, Vector3<f64>)> {
        let areas_m2: Vec<f64> = self.faces.par_iter().map(|face| self.face_area_m2(face)).collect();
        let piece_m2 = areas_m2.iter().sum::<f64>() / count.max(1) as f64;
        let mut random = random_stream(seed, "body-landmarks", round);
        let mut points = Vec::with_capacity(count);
        let mut passed_m2 = 0.0;
        let mut next_m2 = piece_m2 * random.random::<f64>();
        for (index, (face, area_m2)) in self.faces.iter().zip(&areas_m2).enumerate() {
            passed_m2 += area_m2;
            while next_m2 < passed_m2 && points.len() < count {
                let [a, b, c] = self.corners_m(face);
                let (mut s, mut t): (f64, f64) = (random.random(), random.random());
                if s + t > 1.0 {
                    (s, t) = (1.0 - s, 1.0 - t);
                }
                points.push((index, a + (b - a) * s + (c - a) * t));
                next_m2 = piece_m2 * (points.len() as f64 + random.random::<f64>());
            }
        }
        points
    }
}
