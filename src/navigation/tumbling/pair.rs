//! Rotations between images as measurements of the motion.

use super::error::TumblingError;
use super::motion::TrajectoryPoint;
use crate::geometry::so3::log;
use crate::observations::{PairStatus, RelativeRotation};
use nalgebra::{Matrix3, SMatrix, UnitQuaternion, Vector3};

/// Fewest usable pairs: two more than the eight unknowns ask for.
const LEAST_PAIRS: usize = 5;

/// A measured rotation `camera(to)_from_camera(from)` between two images, as a camera that moves around the resting
/// body would see it: `A(to)⁻¹ A(from)` with `A = asteroid_from_inertial`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RotationPair {
    /// Number of the first image.
    pub from: usize,
    /// Number of the second image, larger.
    pub to: usize,
    /// The rotation.
    pub measured: UnitQuaternion<f64>,
    /// Covariance of `d` in `true = exp(d) * measured`, rad².
    pub covariance_rad2: Matrix3<f64>,
    /// `W` with `Wᵀ W = covariance⁻¹`, 1/rad.
    pub whitening: Matrix3<f64>,
}

impl RotationPair {
    /// `log(measured * predicted⁻¹)` in rad, in axes of the second camera.
    pub fn misfit_rad(&self, points: &[TrajectoryPoint]) -> Vector3<f64> {
        log(&(self.measured * self.predicted(points).inverse()))
    }

    /// Whitened misfit, and its derivative by (initial rate, ratios) with a minus sign: how the whitened prediction moves.
    /// With `A = Â exp(d)` the prediction turns by `-d_to + R̂ d_from`. (The inverse right Jacobian of the misfit is left
    /// out: it is the identity where the fit is good, and along the misfit itself everywhere.)
    pub fn whitened(&self, points: &[TrajectoryPoint]) -> (Vector3<f64>, SMatrix<f64, 3, 8>) {
        let predicted = self.predicted(points).to_rotation_matrix();
        let attitude_from = points[self.from].sensitivity.fixed_rows::<3>(0);
        let attitude_to = points[self.to].sensitivity.fixed_rows::<3>(0);
        let moves = predicted.matrix() * attitude_from - attitude_to;
        (self.whitening * self.misfit_rad(points), self.whitening * moves)
    }

    fn predicted(&self, points: &[TrajectoryPoint]) -> UnitQuaternion<f64> {
        points[self.to].state.asteroid_from_inertial.inverse() * points[self.from].state.asteroid_from_inertial
    }
}

/// The usable pairs (status ok) by image number, sorted by their second image.
///
/// # Errors
/// Names a pair that is not between two images, is not finite, or has no positive definite covariance; too few pairs.
pub(super) fn usable_pairs(
    rotations: &[RelativeRotation],
    frame_times_ns: &[i64],
) -> Result<Vec<RotationPair>, TumblingError> {
    if frame_times_ns.len() < 4 || frame_times_ns.windows(2).any(|w| w[0] >= w[1]) {
        return Err(TumblingError::FrameTimes { frames: frame_times_ns.len() });
    }
    let usable = rotations.iter().filter(|r| r.status == PairStatus::Ok);
    let mut pairs = usable.map(|r| checked_pair(r, frame_times_ns)).collect::<Result<Vec<_>, _>>()?;
    if pairs.len() < LEAST_PAIRS {
        return Err(TumblingError::TooFewPairs { usable: pairs.len(), given: rotations.len(), needed: LEAST_PAIRS });
    }
    pairs.sort_by_key(|p| (p.to, p.from));
    Ok(pairs)
}

fn checked_pair(rotation: &RelativeRotation, frame_times_ns: &[i64]) -> Result<RotationPair, TumblingError> {
    let (t_ns_from, t_ns_to) = (rotation.t_ns_from, rotation.t_ns_to);
    let find =
        |t_ns: i64| frame_times_ns.binary_search(&t_ns).map_err(|_| TumblingError::UnknownPair { t_ns_from, t_ns_to });
    let (from, to) = (find(t_ns_from)?, find(t_ns_to)?);
    if from >= to {
        return Err(TumblingError::UnknownPair { t_ns_from, t_ns_to });
    }
    let bad = |problem| TumblingError::BadPair { t_ns_from, t_ns_to, problem };
    let measured = rotation.camera_to_from_camera_from;
    if !measured.coords.iter().all(|c| c.is_finite()) || (measured.norm() - 1.0).abs() > 1e-6 {
        return Err(bad("a rotation that is not a unit quaternion of finite numbers"));
    }
    let covariance_rad2 = rotation.covariance_rad2;
    if !covariance_rad2.iter().all(|c| c.is_finite()) {
        return Err(bad("a covariance that is not made of finite numbers"));
    }
    let factor = covariance_rad2.cholesky().ok_or_else(|| bad("a covariance that is not positive definite"))?;
    let whitening = factor.l().try_inverse().ok_or_else(|| bad("a covariance that is not positive definite"))?;
    Ok(RotationPair { from, to, measured, covariance_rad2, whitening })
}
