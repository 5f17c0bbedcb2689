//! How far a carried point drifts.

use crate::vision::DesignatedStep;

/// 1σ in px of independent steps, one an image, that would lead the track as far off over the ground as its drift does.
/// The steps that were taken are larger: ties to older images take much of their errors back.
pub fn drift_per_image_px(steps: &[DesignatedStep]) -> f64 {
    let drift_first_px2 = steps.iter().map(|s| s.drift_first_px2).fold(0.0, f64::max);
    let of_unit_steps = steps.iter().skip(1).map(|s| s.pixel_size.powi(2)).sum::<f64>();
    if of_unit_steps > 0.0 { (drift_first_px2 / of_unit_steps).sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix2, Vector2};

    fn steps(step_px: f64, ratio: f64) -> Vec<DesignatedStep> {
        let mut drift_first_px2 = 0.0;
        let step = |k: i32| {
            let pixel_size = ratio.powi(k);
            drift_first_px2 += if k > 0 { (step_px * pixel_size).powi(2) } else { 0.0 };
            DesignatedStep {
                t_ns: i64::from(k),
                pixel_px: Vector2::zeros(),
                step_sigma_px: step_px,
                covariance_px2: Matrix2::identity(),
                pixel_size,
                drift_first_px2,
                t_ns_from: i64::from(k - 1),
                refined: true,
            }
        };
        (0..50).map(step).collect()
    }

    #[test]
    fn independent_steps_drift_by_their_own_size() {
        for ratio in [1.0, 0.9] {
            assert!((drift_per_image_px(&steps(0.04, ratio)) - 0.04).abs() < 1e-12);
        }
        let mut held = steps(0.04, 0.9);
        held.iter_mut().for_each(|s| s.drift_first_px2 *= 0.25);
        assert!((drift_per_image_px(&held) - 0.02).abs() < 1e-12, "ties to older pictures that hold the point");
        assert_eq!(drift_per_image_px(&held[..1]), 0.0);
        assert_eq!(drift_per_image_px(&[]), 0.0);
    }
}
