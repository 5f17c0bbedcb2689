//! Volume, centre of mass and inertia of a solid of uniform density bounded by a mesh.
//!
//! Exact for a polyhedron: the solid is the signed sum of tetrahedra over its faces. With a, b, c the corners of a face
//! and 6V = a·(b×c), a tetrahedron with its fourth corner at the origin has ∫x dV = V (a+b+c)/4 and
//! ∫x xᵀ dV = V/20 (s sᵀ + a aᵀ + b bᵀ + c cᵀ), s = a+b+c (Tonon, "Explicit exact formulas for the 3-D tetrahedron
//! inertia tensor", 2004).

use super::mesh::Mesh;
use crate::scene::error::SceneError;
use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use rayon::prelude::*;
use std::iter::Sum;

/// Mass properties at a density of 1 kg/m³.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassProperties {
    /// Volume in m³.
    pub volume_m3: f64,
    /// Centre of mass in the mesh's axes, m.
    pub center_m: Vector3<f64>,
    /// Inertia tensor about the centre of mass in the mesh's axes, m⁵ (kg m² at 1 kg/m³).
    pub inertia_m5: Matrix3<f64>,
}

impl MassProperties {
    /// Principal moments of inertia in ascending order, m⁵.
    pub fn principal_moments_m5(&self) -> Vector3<f64> {
        principal_moments(&self.inertia_m5)
    }
}

/// Eigenvalues of a symmetric tensor in ascending order.
pub fn principal_moments(inertia: &Matrix3<f64>) -> Vector3<f64> {
    let mut moments: [f64; 3] = SymmetricEigen::new(*inertia).eigenvalues.into();
    moments.sort_by(f64::total_cmp);
    Vector3::from(moments)
}

impl Mesh {
    /// Mass properties of the solid inside.
    ///
    /// # Errors
    /// [`SceneError::NotSolid`] for a mesh that is open, has flipped faces or is inside out.
    pub fn mass_properties(&self) -> Result<MassProperties, SceneError> {
        self.check_closed()?;
        // About a point near the body, so that a far origin costs no digits.
        let near_m = self.vertices_m.iter().sum::<Vector3<f64>>() / self.vertices_m.len().max(1) as f64;
        let Moments { volume, first, second } = self.moments_about(&near_m);
        if volume.is_nan() || volume <= 0.0 {
            let problem = format!("encloses a volume of {volume} m³: it is inside out; reverse its faces");
            return Err(SceneError::NotSolid { problem });
        }
        let center = first / volume;
        let about_center = second - center * center.transpose() * volume;
        let inertia_m5 = Matrix3::identity() * about_center.trace() - about_center;
        Ok(MassProperties { volume_m3: volume, center_m: near_m + center, inertia_m5 })
    }

    /// Fixed pieces are summed in order, so that the sum does not depend on the number of threads.
    fn moments_about(&self, near_m: &Vector3<f64>) -> Moments {
        let of_faces = |faces: &[[u32; 3]]| {
            faces.iter().map(|face| Moments::of(self.corners_m(face).map(|corner| corner - near_m))).sum::<Moments>()
        };
        self.faces.par_chunks(4096).map(of_faces).collect::<Vec<_>>().into_iter().sum()
    }
}

/// Volume and its first and second moments.
struct Moments {
    volume: f64,
    first: Vector3<f64>,
    second: Matrix3<f64>,
}

impl Moments {
    /// Of the tetrahedron over a face.
    fn of([a, b, c]: [Vector3<f64>; 3]) -> Self {
        let volume = a.dot(&b.cross(&c)) / 6.0;
        let s = a + b + c;
        let squares = s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose();
        Moments { volume, first: s * (volume / 4.0), second: squares * (volume / 20.0) }
    }
}

impl Sum for Moments {
    fn sum<I: Iterator<Item = Moments>>(parts: I) -> Self {
        let zero = Moments { volume: 0.0, first: Vector3::zeros(), second: Matrix3::zeros() };
        parts.fold(zero, |all, part| Moments {
            volume: all.volume + part.volume,
            first: all.first + part.first,
            second: all.second + part.second,
        })
    }
}
