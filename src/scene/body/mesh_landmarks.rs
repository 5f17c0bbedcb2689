//! Landmarks spread evenly over a mesh.

use super::Mesh;
use crate::dataset::truth::Landmark;
use crate::stats::random_stream;
use rand::RngExt;

impl Mesh {
    /// `count` random points on the surface, one in each of `count` pieces of equal area.
    pub fn spread_landmarks(&self, count: usize, seed: u64) -> Vec<Landmark> {
        let areas_m2: Vec<f64> = self.faces.iter().map(|face| self.face_area_m2(face)).collect();
        let piece_m2 = areas_m2.iter().sum::<f64>() / count.max(1) as f64;
        let mut random = random_stream(seed, "body-landmarks", 0);
        let mut landmarks = Vec::with_capacity(count);
        let mut passed_m2 = 0.0;
        let mut next_m2 = piece_m2 * random.random::<f64>();
        for (face, area_m2) in self.faces.iter().zip(&areas_m2) {
            passed_m2 += area_m2;
            while next_m2 < passed_m2 && landmarks.len() < count {
                let [a, b, c] = self.corners_m(face);
                let (mut s, mut t): (f64, f64) = (random.random(), random.random());
                if s + t > 1.0 {
                    (s, t) = (1.0 - s, 1.0 - t);
                }
                let position_m = a + (b - a) * s + (c - a) * t;
                landmarks.push(Landmark { id: landmarks.len() as u32, position_m });
                next_m2 = piece_m2 * (landmarks.len() as f64 + random.random::<f64>());
            }
        }
        landmarks
    }
}
