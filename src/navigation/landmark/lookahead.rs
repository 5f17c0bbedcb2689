//! What a landmark would do to the covariance over three epochs.

use super::bearing::projector_over_range;
use super::viewpoint::Viewpoint;
use crate::geometry::so3::{hat, tangent_basis};
use crate::navigation::filter::{Innovation, correction};
use nalgebra::{Matrix2, Matrix3, SMatrix, Unit, Vector2, Vector3};

type Matrix12 = SMatrix<f64, 12, 12>;

/// Number of epochs at which the landmark is observed; the first one initialises it.
const EPOCHS: usize = 3;

/// Trace of the position's covariance (m²) after a ground point has been observed at three epochs beside the known
/// landmark: rows H Φᵏ scaled by 1/σ_b against the prior covariance, the landmark's own prior from the ground.
pub fn posterior_position_variance_m2(view: &Viewpoint, landmark_in_site_m: &Vector3<f64>) -> f64 {
    let mut covariance = with_landmark(view, landmark_in_site_m);
    for epoch in 1..EPOCHS {
        let time_s = epoch as f64 * view.interval_s;
        let phi = transition(view, time_s);
        let lander_m = view.predicted_position_in_site_m(time_s);
        for (relative_m, unknown) in [(-lander_m, false), (landmark_in_site_m - lander_m, true)] {
            covariance = after_bearing(&covariance, &(bearing_rows(&relative_m, unknown) * phi), view);
        }
    }
    covariance.fixed_view::<3, 3>(0, 0).trace()
}

/// What three epochs tell (12×12): two rows of the known landmark and two of the unknown one an epoch, H Φᵏ scaled by
/// 1/σ_b, columns by the prior σ.
pub fn stacked_bearings(view: &Viewpoint, landmark_in_site_m: &Vector3<f64>) -> Matrix12 {
    let sigma = with_landmark(view, landmark_in_site_m).diagonal().map(f64::sqrt) / view.sigma_bearing_rad;
    let mut stacked = Matrix12::zeros();
    for epoch in 0..EPOCHS {
        let time_s = epoch as f64 * view.interval_s;
        let phi = transition(view, time_s);
        let lander_m = view.predicted_position_in_site_m(time_s);
        for (k, (relative_m, unknown)) in
            [(-lander_m, false), (landmark_in_site_m - lander_m, true)].into_iter().enumerate()
        {
            let rows = bearing_rows(&relative_m, unknown) * phi;
            stacked.fixed_view_mut::<2, 12>(4 * epoch + 2 * k, 0).copy_from(&rows);
        }
    }
    stacked * Matrix12::from_diagonal(&sigma)
}

/// Covariance with the landmark appended, initialised from its bearing and the ground's height (errors r, v, ψ, p).
fn with_landmark(view: &Viewpoint, landmark_in_site_m: &Vector3<f64>) -> Matrix12 {
    let relative_m = landmark_in_site_m - view.lander_in_site_m;
    let u = relative_m.normalize();
    let along_ground = Matrix3::identity() - u * Vector3::z().transpose() / u.z;
    let mut by_state = SMatrix::<f64, 12, 9>::identity();
    by_state.fixed_view_mut::<3, 3>(9, 0).copy_from(&along_ground);
    by_state.fixed_view_mut::<3, 3>(9, 6).copy_from(&(-along_ground * hat(&relative_m)));
    let sigma_across_m = view.sigma_bearing_rad * relative_m.norm();
    let height = u / u.z * view.ground.sigma_at_m(landmark_in_site_m);
    let own = along_ground * along_ground.transpose() * sigma_across_m.powi(2) + height * height.transpose();
    let mut covariance = by_state * view.covariance * by_state.transpose();
    let mut block = covariance.fixed_view_mut::<3, 3>(9, 9);
    block += own;
    covariance
}

/// Equations (6) to (10) in site axes: Φ13 = -½ T² [f×], Φ23 = -T [f×] with the specific force f.
fn transition(view: &Viewpoint, time_s: f64) -> Matrix12 {
    let force = hat(&view.specific_force_in_site_m_s2);
    let mut phi = Matrix12::identity();
    phi.fixed_view_mut::<3, 3>(0, 3).copy_from(&(Matrix3::identity() * time_s));
    phi.fixed_view_mut::<3, 3>(0, 6).copy_from(&(-force * (0.5 * time_s * time_s)));
    phi.fixed_view_mut::<3, 3>(3, 6).copy_from(&(-force * time_s));
    phi
}

/// Two rows of equation (14), attitude error ψ in site axes.
fn bearing_rows(relative_m: &Vector3<f64>, unknown: bool) -> SMatrix<f64, 2, 12> {
    let across = tangent_basis(&Unit::new_normalize(*relative_m)).transpose() * projector_over_range(relative_m);
    let mut h = SMatrix::<f64, 2, 12>::zeros();
    h.fixed_view_mut::<2, 3>(0, 0).copy_from(&-across);
    h.fixed_view_mut::<2, 3>(0, 6).copy_from(&(across * hat(relative_m)));
    if unknown {
        h.fixed_view_mut::<2, 3>(0, 9).copy_from(&across);
    }
    h
}

/// The covariance after a bearing; before it, if that has no noise and nothing new to tell.
fn after_bearing(p: &Matrix12, h: &SMatrix<f64, 2, 12>, view: &Viewpoint) -> Matrix12 {
    let noise = Matrix2::identity() * view.sigma_bearing_rad.powi(2);
    correction(*p, &[Innovation::dense(Vector2::zeros(), *h, noise)]).map_or(*p, |after| after.covariance)
}
