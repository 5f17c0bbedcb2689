//! The bearing of a landmark, linearised: Li et al. 2023, equations (14) to (18).

use nalgebra::{Matrix3, SMatrix, UnitQuaternion, Vector3};

/// `(|ρ|² I - ρ ρᵀ) / |ρ|³`: derivative of the unit vector of ρ by ρ (equation (18) without its rotation), 1/m.
pub fn projector_over_range(relative_m: &Vector3<f64>) -> Matrix3<f64> {
    let range_m = relative_m.norm();
    let direction = relative_m / range_m;
    (Matrix3::identity() - direction * direction.transpose()) / range_m
}

/// Rows of one landmark, `[H_r 0 H_θ H_p]` (3×12), for the errors of position, velocity, attitude δθ (lander axes) and
/// of the landmark: H_r = -H_C, H_θ = H_C [ρ×] Cᵀ, H_p = H_C (equations (15) to (18)), with C = `lander_from_site` and
/// ρ = p - r in site axes. A known landmark has no H_p: pass `unknown = false`.
pub fn bearing_jacobian(
    lander_from_site: &UnitQuaternion<f64>,
    relative_in_site_m: &Vector3<f64>,
    unknown: bool,
) -> SMatrix<f64, 3, 12> {
    let c = lander_from_site.to_rotation_matrix().into_inner();
    let h_c = c * projector_over_range(relative_in_site_m);
    let mut h = SMatrix::<f64, 3, 12>::zeros();
    h.fixed_view_mut::<3, 3>(0, 0).copy_from(&-h_c);
    h.fixed_view_mut::<3, 3>(0, 6).copy_from(&(h_c * relative_in_site_m.cross_matrix() * c.transpose()));
    if unknown {
        h.fixed_view_mut::<3, 3>(0, 9).copy_from(&h_c);
    }
    h
}

/// The paper's H_{1,1} (6×12, rank 4): the known landmark at the origin above the unknown one (equation (14)).
pub fn bearing_matrix(
    lander_from_site: &UnitQuaternion<f64>,
    lander_in_site_m: &Vector3<f64>,
    landmark_in_site_m: &Vector3<f64>,
) -> SMatrix<f64, 6, 12> {
    let mut h = SMatrix::<f64, 6, 12>::zeros();
    let known = bearing_jacobian(lander_from_site, &-lander_in_site_m, false);
    let unknown = bearing_jacobian(lander_from_site, &(landmark_in_site_m - lander_in_site_m), true);
    h.fixed_view_mut::<3, 12>(0, 0).copy_from(&known);
    h.fixed_view_mut::<3, 12>(3, 0).copy_from(&unknown);
    h
}
