//! The classical observability metrics, the rivals of the depth error.

use super::bearing::bearing_matrix;
use super::lookahead::stacked_bearings;
use super::viewpoint::Viewpoint;
use nalgebra::{UnitQuaternion, Vector3};

/// A measure of how well one known and one unknown landmark determine the state, on H_{1,1}'s four non-zero singular
/// values σ1 ≥ … ≥ σ4 (the literal smallest one is 0 and `HᵀH` is singular); larger is better for each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Metric {
    /// Smallest non-zero singular value σ4.
    SingularValue,
    /// Geometric dilution of precision, 1 / Σ σ_i⁻².
    Dilution,
    /// Inverse condition number σ4 / σ1.
    Condition,
    /// The closed form that the three share: λ4 ≈ ½ (|p|²/(d1² d2²) + 1/d2²), d1 = |r|, d2 = |p - r|.
    ClosedForm,
}

/// Value of a metric for a lander at `r` and a landmark at `p` (site frame, m); rotations of the lander do not change it.
pub fn metric(kind: Metric, lander_in_site_m: &Vector3<f64>, landmark_in_site_m: &Vector3<f64>) -> f64 {
    let (d1, d2) = (lander_in_site_m.norm(), (landmark_in_site_m - lander_in_site_m).norm());
    if kind == Metric::ClosedForm {
        return 0.5 * ((landmark_in_site_m.norm() / (d1 * d2)).powi(2) + d2.powi(-2));
    }
    let h = bearing_matrix(&UnitQuaternion::identity(), lander_in_site_m, landmark_in_site_m);
    let mut singular = h.singular_values();
    of_singular_values(kind, singular.as_mut_slice(), 4)
}

/// The same measures on what three epochs tell together: rows H Φᵏ scaled by 1/σ_b, columns by the prior σ. Of the 12
/// singular values 11 are not 0; the null vector is a turn about the vertical. [`Metric::ClosedForm`] has no such form
/// and is given as it is.
pub fn scaled_metric(kind: Metric, view: &Viewpoint, landmark_in_site_m: &Vector3<f64>) -> f64 {
    if kind == Metric::ClosedForm {
        return metric(kind, &view.lander_in_site_m, landmark_in_site_m);
    }
    let mut singular = stacked_bearings(view, landmark_in_site_m).singular_values();
    of_singular_values(kind, singular.as_mut_slice(), 11)
}

/// A metric of the largest `rank` singular values.
fn of_singular_values(kind: Metric, singular: &mut [f64], rank: usize) -> f64 {
    singular.sort_by(|a, b| b.total_cmp(a));
    match kind {
        Metric::SingularValue => singular[rank - 1],
        Metric::Dilution => 1.0 / singular[..rank].iter().map(|s| s.powi(-2)).sum::<f64>(),
        Metric::Condition | Metric::ClosedForm => singular[rank - 1] / singular[0],
    }
}
