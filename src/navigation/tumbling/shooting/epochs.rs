//! Times of the images that shooting works at.

use super::shooting::ShootingFit;
use crate::navigation::tumbling::result::{InertiaKnowledge, TumblingEpoch};
use crate::stats::symmetric;

/// Times since the first image in s.
pub fn seconds(frame_times_ns: &[i64]) -> Vec<f64> {
    frame_times_ns.iter().map(|t| (t - frame_times_ns[0]) as f64 * 1e-9).collect()
}

/// Epochs of a shooting fit; the covariance follows the motion through the sensitivities.
pub fn shooting_epochs(shot: &ShootingFit, frame_times_ns: &[i64]) -> Vec<TumblingEpoch> {
    let ratio_covariance = shot.covariance.fixed_view::<5, 5>(3, 3).into_owned();
    let inertia = InertiaKnowledge::new(&shot.fit.inertia, &ratio_covariance, &shot.undetermined);
    let points = shot.fit.points.iter().zip(frame_times_ns);
    points
        .map(|(point, &t_ns)| TumblingEpoch {
            t_ns,
            asteroid_from_inertial: point.state.asteroid_from_inertial,
            rate_in_asteroid_rad_s: point.state.rate_in_asteroid_rad_s,
            covariance: symmetric(&(point.sensitivity * shot.covariance * point.sensitivity.transpose())),
            inertia: inertia.clone(),
        })
        .collect()
}
