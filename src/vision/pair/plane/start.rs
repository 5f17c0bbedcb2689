//! Starts of a plane with relief: the plane through what a known motion sees, and variances from medians.

use super::model::ReliefPlane;
use crate::geometry::so3::hat;
use crate::stats::{NORMAL_MEDIAN, upper_median};
use crate::vision::pair::models::General;
use crate::vision::pair::normalized_match::NormalizedMatch;
use crate::vision::pair::residual::{Relation, residual};
use nalgebra::{Matrix3, Unit, Vector2, Vector3};

/// Least noise over the nominal one.
const LEAST_NOISE: f64 = 0.03;
/// Fewest matches that give a median.
const FEWEST: usize = 8;

/// The plane through what two cameras with a known motion see; `None` where there is none.
pub fn plane_of_motion(motion: &General, normalized: &[NormalizedMatch], widest: f64) -> Option<ReliefPlane> {
    let turn = motion.rotation.to_rotation_matrix().into_inner();
    let essential = hat(&motion.direction) * turn;
    let on_line = |s: &&NormalizedMatch| residual(Relation::Epipolar, &essential, s).x.abs() < widest;
    // Inverse depth ρ of each match, from `to × (R x + t ρ) = 0`, with its weight.
    let seen: Vec<(Vector3<f64>, f64, f64)> = normalized
        .iter()
        .filter(on_line)
        .map(|s| {
            let a = s.second_ray().cross(&(turn * s.first_ray()));
            let b = s.second_ray().cross(&motion.direction);
            let weight = b.norm_squared().max(1e-12);
            (s.first_ray(), weight, -a.dot(&b) / weight)
        })
        .collect();
    let mut plane = Vector3::zeros();
    let mut gate = f64::INFINITY;
    for _ in 0..4 {
        let (mut information, mut sum) = (Matrix3::identity() * 1e-9, Vector3::zeros());
        for (x, weight, inverse_depth) in seen.iter().filter(|(x, _, d)| (d - plane.dot(x)).abs() <= gate) {
            information += x * x.transpose() * *weight;
            sum += x * (*weight * *inverse_depth);
        }
        plane = information.cholesky()?.solve(&sum);
        let mut off: Vec<f64> = seen.iter().map(|(x, _, d)| (d - plane.dot(x)).abs()).collect();
        gate = 3.0 * upper_median(&mut off)? / NORMAL_MEDIAN;
    }
    let normal = Unit::try_new(plane, 1e-12)?;
    let translation = motion.direction.into_inner() * plane.norm();
    Some(ReliefPlane { rotation: motion.rotation, translation, normal, relief_variance: 0.0, noise_variance: 1.0 })
}

/// A match's residuals against a ground: across the line to the epipole in units of the nominal σ, along it in units of
/// the relief, and the nominal variance of the latter.
struct Off {
    across_sigma: f64,
    relief: f64,
    relief_variance: f64,
}

impl Off {
    fn of(ground: &ReliefPlane, homography: &Matrix3<f64>, matched: &NormalizedMatch) -> Option<Off> {
        let seen = ground.predict(homography, matched)?;
        let length = seen.by_relief.norm().max(1e-12);
        let along = seen.by_relief / length;
        let across = Vector2::new(-along.y, along.x);
        Some(Off {
            across_sigma: (across.dot(&seen.residual) / across.dot(&(seen.nominal * across)).sqrt()).abs(),
            relief: (along.dot(&seen.residual) / length).abs(),
            relief_variance: along.dot(&(seen.nominal * along)) / length.powi(2),
        })
    }
}

/// The start with variances from medians: noise from the residuals across the lines to the epipole that lie within
/// `widest` of the nominal σ, relief from those along them.
pub(super) fn with_variances(start: &ReliefPlane, normalized: &[NormalizedMatch], widest: f64) -> ReliefPlane {
    let homography = start.homography();
    let mut near: Vec<Off> = normalized.iter().filter_map(|s| Off::of(start, &homography, s)).collect();
    near.retain(|o| o.across_sigma < widest);
    let most = widest / 3.0;
    let middle = |value: fn(&Off) -> f64, from: &[Off]| upper_median(&mut from.iter().map(value).collect::<Vec<f64>>());
    let noise = match middle(|o| o.across_sigma, &near) {
        Some(off) if near.len() >= FEWEST => (off / NORMAL_MEDIAN).clamp(LEAST_NOISE, most),
        _ => most,
    };
    near.retain(|o| o.across_sigma < 3.0 * noise);
    let by_noise = middle(|o| o.relief_variance, &near).unwrap_or(1.0) * noise.powi(2);
    let spread = middle(|o| o.relief, &near).unwrap_or(1.0) / NORMAL_MEDIAN;
    let relief_variance = (spread.powi(2) - by_noise).max(0.01 * by_noise);
    ReliefPlane { relief_variance, noise_variance: noise.powi(2), ..*start }
}
