//! Matches whose parallax stands out: they are wrong, however well they sit on an epipolar line.
//!
//! The epipolar constraint leaves a point free along a line, and a long wrong displacement has great leverage there: a
//! fit of five parameters happily bends to a few of them. What lies far off the smooth motion of all others is removed
//! before any refinement.

use super::models::Plane;
use super::normalized_match::NormalizedMatch;
use super::residual::{Relation, residual};
use super::robust_fit::{Loss, descend};
use crate::stats::upper_median;
use nalgebra::Matrix3;

/// A parallax greater than this many times the median is implausible.
const PARALLAX_LIMIT: f64 = 6.0;

/// Which matches have a parallax, against the plane that fits best, like that of the others. `widest` is the inlier
/// threshold in units of the nominal σ. Without a plane or too few matches, all are passes_parallax_gate.
pub(super) fn passes_parallax_gate(
    normalized: &[NormalizedMatch],
    planes: &[Plane],
    essential: Option<&Matrix3<f64>>,
    widest: f64,
) -> Vec<bool> {
    let on_line = |s: &&NormalizedMatch| essential.is_none_or(|e| residual(Relation::Epipolar, e, s).x.abs() < widest);
    let agreeing: Vec<NormalizedMatch> = normalized.iter().filter(on_line).copied().collect();
    let Some(start) = planes.first().filter(|_| agreeing.len() >= 12) else {
        return vec![true; normalized.len()];
    };
    let mut plane = *start;
    let mut size = median_parallax(&plane, &agreeing);
    for _ in 0..2 {
        plane = descend(plane, &agreeing, Loss::Cauchy((2.0 * size).max(1.0)), 8).state;
        size = median_parallax(&plane, &agreeing);
    }
    let limit = (PARALLAX_LIMIT * size).max(widest);
    let matrix = matrix_of(&plane);
    normalized.iter().map(|s| residual(Relation::Transfer, &matrix, s).norm() < limit).collect()
}

fn matrix_of(plane: &Plane) -> Matrix3<f64> {
    plane.rotation.to_rotation_matrix().into_inner() + plane.translation * plane.normal.transpose()
}

fn median_parallax(plane: &Plane, normalized: &[NormalizedMatch]) -> f64 {
    let matrix = matrix_of(plane);
    let mut sizes: Vec<f64> = normalized.iter().map(|s| residual(Relation::Transfer, &matrix, s).norm()).collect();
    upper_median(&mut sizes).expect("a dozen matches at least")
}
