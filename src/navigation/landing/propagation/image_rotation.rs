//! The rotation between two images as a check of the gyroscope, or as a measurement.

use crate::geometry::so3::{exp, log};
use crate::navigation::landing::config::FilterKind;
use crate::navigation::landing::error_state::{BIASES, DescentEstimate};
use crate::navigation::landing::inertial::ImuIncrement;
use nalgebra::{Matrix3, SMatrix, SVector, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

/// What is done with the rotations that images tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ImageRotationUse {
    /// They are compared with the gyroscope's; the estimate does not depend on them.
    #[default]
    Check,
    /// They correct the gyroscope's, or its bias where biases are estimated.
    Measure,
    /// Nothing.
    Ignore,
}

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
        let by_rotation: SMatrix<f64, 9, 3> = increment.covariance.fixed_columns::<3>(0).into_owned();
        let s = self.covariance_rad2 + by_rotation.fixed_rows::<3>(0);
        let gain = by_rotation * s.try_inverse()?;
        let p = increment.covariance - gain * by_rotation.transpose();
        Some(ImuIncrement {
            covariance: (p + p.transpose()) * 0.5,
            ..increment.adjusted(&(gain * self.difference_rad(increment)))
        })
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
        let h = increment.by_bias.fixed_rows::<3>(0).into_owned();
        let rows = h * estimate.covariance.rows(BIASES, 6);
        let s = rows.fixed_columns::<6>(BIASES) * h.transpose()
            + self.covariance_rad2
            + increment.covariance.fixed_view::<3, 3>(0, 0);
        let weight = s.cholesky()?.inverse();
        let shift = rows.transpose() * (weight * self.difference_rad(increment));
        let p = &estimate.covariance - rows.transpose() * weight * &rows;
        let biases: SVector<f64, 6> = shift.fixed_rows::<6>(BIASES).into_owned();
        let state = kind.retract(estimate.state.clone(), shift.as_slice());
        let covariance = (&p + p.transpose()) * 0.5;
        Some((DescentEstimate { state, covariance }, increment.adjusted(&(increment.by_bias * biases))))
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
