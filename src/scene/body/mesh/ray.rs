//! Rays through a mesh.

use super::mesh::Mesh;
use nalgebra::Vector3;
use rayon::prelude::*;

/// A ray is lifted off the surface by this share of the mesh's radius.
const LIFT: f64 = 1e-7;

/// Where a ray goes through a face.
struct Crossing {
    /// Distance in units of the ray's direction.
    distance: f64,
    /// Whether it leaves the solid there (1) or enters it (-1).
    sense: i32,
}

impl Mesh {
    /// How many times the surface of a closed mesh surrounds a point: 0 outside, 1 inside, 2 where two closed parts
    /// overlap. The crossings of one ray are counted with their sense; it is a random one, so that it meets no edge.
    pub fn surrounds(&self, point_m: &Vector3<f64>) -> i32 {
        self.crossings(point_m, &Vector3::new(0.531_276_19, -0.283_651_74, 0.798_314_27)).iter().map(|c| c.sense).sum()
    }

    /// Distance in m from a point to where a ray in the given direction (a unit vector) crosses the surface for the
    /// last time; `None` if it never does.
    pub fn last_crossing_m(&self, from_m: &Vector3<f64>, direction: &Vector3<f64>) -> Option<f64> {
        self.crossings(from_m, direction).into_iter().map(|c| c.distance).max_by(f64::total_cmp)
    }

    /// Whether a point on a face is outside all closed parts of the mesh, not buried where two of them overlap.
    pub(super) fn is_exposed(&self, face: &[u32; 3], point_m: &Vector3<f64>) -> bool {
        let [a, b, c] = self.corners_m(face);
        let Some(normal) = (b - a).cross(&(c - a)).try_normalize(0.0) else { return false };
        self.surrounds(&(point_m + normal * (LIFT * self.radius_m()))) == 0
    }

    /// Source: Möller and Trumbore, "Fast, minimum storage ray-triangle intersection", Journal of Graphics Tools 2(1),
    /// 1997.
    fn crossings(&self, from_m: &Vector3<f64>, direction: &Vector3<f64>) -> Vec<Crossing> {
        let crossing = |face: &[u32; 3]| {
            let [a, b, c] = self.corners_m(face);
            let (ab, ac) = (b - a, c - a);
            let p = direction.cross(&ac);
            let determinant = ab.dot(&p); // its sign is that of a ray that enters
            let from_a = from_m - a;
            let u = from_a.dot(&p) / determinant;
            let q = from_a.cross(&ab);
            let v = direction.dot(&q) / determinant;
            let distance = ac.dot(&q) / determinant;
            let hit = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0;
            hit.then_some(Crossing { distance, sense: if determinant < 0.0 { 1 } else { -1 } })
        };
        self.faces.par_iter().with_min_len(16_384).filter_map(crossing).collect()
    }
}
