//! On which side of the cameras points lie.

use super::normalized_match::NormalizedMatch;
use nalgebra::{UnitQuaternion, Vector3};

/// How many points with a clear parallax lie in front of both cameras.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cheirality {
    pub(super) ahead: usize,
    pub(super) seen: usize,
}

impl Cheirality {
    /// Counts the points; those with a parallax below 4σ say nothing, and those ahead of one camera only count against.
    pub(super) fn of(rotation: UnitQuaternion<f64>, t: &Vector3<f64>, normalized: &[NormalizedMatch]) -> Self {
        let mut count = Cheirality { ahead: 0, seen: 0 };
        for s in normalized {
            let (a, b) = ((rotation * s.first_ray()).normalize(), s.second_ray().normalize());
            let across = a.cross(&b);
            let sine2 = across.norm_squared();
            if sine2 < 16.0 * (s.from_covariance.trace() + s.to_covariance.trace()) {
                continue;
            }
            // λ b = μ a + t: crossing with a and with b gives both depths over |a×b|².
            let (lambda, mu) = (a.cross(t).dot(&across), b.cross(t).dot(&across));
            count.seen += 1;
            count.ahead += usize::from(lambda > 0.0 && mu > 0.0);
        }
        count
    }

    /// Whether the points contradict the motion.
    pub(super) fn contradicts(&self) -> bool {
        self.seen >= 8 && self.ahead * 10 < self.seen * 8
    }
}
