//! The rotation between two images as a check of the gyroscope, or as a measurement.

use crate::geometry::so3::{exp, log};
use crate::navigation::filter::{Innovation, correction};
use crate::navigation::landing::error_state::{BIASES, DescentEstimate, FilterKind};
use crate::navigation::landing::inertial::ImuIncrement;
use crate::observations::{PairStatus, RelativeRotation};
use nalgebra::{Isometry3, Matrix3, SVector, UnitQuaternion, Vector3};
use smallvec::smallvec;

/// The lander's rotation between two images, as the images tell it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImageRotation {
    /// Time of the first image, ns.
    pub from_t_ns: i64,
    /// Time of the second, ns.
    pub to_t_ns: i64,
    /// `lander_after_from_lander_before`.
    pub after_from_before: UnitQuaternion<f64>,
    /// Covariance of its error in the lander's axes after, rad².
    pub covariance_rad2: Matrix3<f64>,
}

/// Gyroscope less images, whitened.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotationCheck {
    /// Angle between the two rotations, rad.
    pub angle_rad: f64,
    /// Normalised difference squared, 3 degrees of freedom.
    pub normalized_squared: f64,
}

impl ImageRotation {
    /// The error n of the increment's rotation plus the images' own, lander axes after: C_true = exp(-n) C_gyro.
    fn difference_rad(&self, increment: &ImuIncrement) -> Vector3<f64> {
        -log(&(self.after_from_before * increment.before_from_after))
    }

    /// How well gyroscope and images agree; `None` if the covariance is singular.
    pub fn check(&self, increment: &ImuIncrement) -> Option<RotationCheck> {
        let difference = self.difference_rad(increment);
        let covariance = self.covariance_rad2 + increment.covariance.fixed_view::<3, 3>(0, 0);
        let normalized_squared = difference.dot(&covariance.cholesky()?.solve(&difference));
        Some(RotationCheck { angle_rad: difference.norm(), normalized_squared })
    }

    /// The increment corrected by the images' rotation: its error is estimated from the difference, by the correlation
    /// of rotation, velocity and position. `None` if the covariance is singular.
    pub fn fused(&self, increment: &ImuIncrement) -> Option<ImuIncrement> {
        let innovation =
            Innovation::<3, 3>::dense(self.difference_rad(increment), Matrix3::identity(), self.covariance_rad2);
        let after = correction(increment.covariance, &[innovation])?;
        let error = SVector::from_column_slice(&after.shift);
        Some(ImuIncrement { covariance: after.covariance, ..increment.adjusted(&error) })
    }

    /// The estimate with its biases corrected by the difference, and the increment that the new biases give. The
    /// increment's own noise counts as the measurement's. `None` if no biases are estimated or a covariance is singular.
    pub fn with_biases(
        &self,
        estimate: &DescentEstimate,
        increment: &ImuIncrement,
        kind: FilterKind,
    ) -> Option<(DescentEstimate, ImuIncrement)> {
        estimate.state.biases?;
        let innovation = Innovation::<3, 6> {
            residual: self.difference_rad(increment),
            jacobian: smallvec![(BIASES, increment.by_bias.fixed_rows::<3>(0).into_owned())],
            noise: self.covariance_rad2 + increment.covariance.fixed_view::<3, 3>(0, 0),
        };
        let after = correction(estimate.covariance.clone(), &[innovation])?;
        let biases = SVector::<f64, 6>::from_column_slice(&after.shift[BIASES..BIASES + 6]);
        let state = kind.retract(estimate.state.clone(), &after.shift);
        let estimate = DescentEstimate { state, covariance: after.covariance };
        Some((estimate, increment.adjusted(&(increment.by_bias * biases))))
    }
}

impl ImuIncrement {
    /// The increment with an estimated error taken in: rotation (lander axes after), velocity and position (before).
    pub fn adjusted(&self, error: &SVector<f64, 9>) -> Self {
        let part = |start: usize| error.fixed_rows::<3>(start).into_owned();
        ImuIncrement {
            before_from_after: self.before_from_after * exp(&part(0)),
            velocity_in_before_m_s: self.velocity_in_before_m_s + part(3),
            position_in_before_m: self.position_in_before_m + part(6),
            ..self.clone()
        }
    }
}

/// The rotations between adjacent frames in lander axes, by the time of the second: the usable ones among `rotations`, of
/// frames at `frame_times_ns` in order of time.
pub fn image_rotations(
    rotations: &[RelativeRotation],
    frame_times_ns: &[i64],
    lander_from_camera: &Isometry3<f64>,
) -> Vec<ImageRotation> {
    let mount = lander_from_camera.rotation;
    let turn = mount.to_rotation_matrix().into_inner();
    let adjacent =
        |r: &&RelativeRotation| frame_times_ns.windows(2).any(|pair| (pair[0], pair[1]) == (r.t_ns_from, r.t_ns_to));
    let usable = rotations.iter().filter(|r| r.status == PairStatus::Ok);
    let mut rotations: Vec<ImageRotation> = usable
        .filter(adjacent)
        .map(|r| ImageRotation {
            from_t_ns: r.t_ns_from,
            to_t_ns: r.t_ns_to,
            after_from_before: mount * r.camera_to_from_camera_from * mount.inverse(),
            covariance_rad2: turn * r.covariance_rad2 * turn.transpose(),
        })
        .collect();
    rotations.sort_by_key(|r| r.to_t_ns);
    rotations.dedup_by_key(|r| r.to_t_ns);
    rotations
}
