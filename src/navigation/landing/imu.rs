//! IMU samples integrated between two times.

use super::LandingError;
use crate::dataset::{ImuNoise, ImuSample};
use crate::geometry::so3::{exp, hat, left_jacobian};
use nalgebra::{Matrix3, SMatrix, UnitQuaternion, Vector3};

/// Motion between two times as the IMU alone gives it, free of the initial state and of gravity.
#[derive(Debug, Clone, PartialEq)]
pub struct ImuIncrement {
    /// Length of the interval T, s.
    pub duration_s: f64,
    /// Attitude after, seen from before: `lander_before_from_lander_after`.
    pub before_from_after: UnitQuaternion<f64>,
    /// ∫ specific force, in lander axes before, m/s.
    pub velocity_in_before_m_s: Vector3<f64>,
    /// ∬ specific force, in lander axes before, m.
    pub position_in_before_m: Vector3<f64>,
    /// Covariance of the errors: rotation (rad, lander axes after), velocity (m/s) and position (m, axes before).
    pub covariance: SMatrix<f64, 9, 9>,
}

impl ImuIncrement {
    /// No motion, no time.
    pub fn identity() -> Self {
        ImuIncrement {
            duration_s: 0.0,
            before_from_after: UnitQuaternion::identity(),
            velocity_in_before_m_s: Vector3::zeros(),
            position_in_before_m: Vector3::zeros(),
            covariance: SMatrix::zeros(),
        }
    }

    /// M = C_j C_iᵀ, `lander_after_from_lander_before`.
    pub fn after_from_before(&self) -> Matrix3<f64> {
        self.before_from_after.inverse().to_rotation_matrix().into_inner()
    }

    /// The increment longer by one sample, held over `duration_s`. The noise is white, by density (Forster et al.,
    /// "On-manifold preintegration for real-time visual-inertial odometry", 2017, appendix A).
    pub fn extended(&self, sample: &ImuSample, duration_s: f64, noise: &ImuNoise) -> Self {
        let dt = duration_s;
        let turn = sample.rate_in_lander_rad_s * dt;
        let force = sample.specific_force_in_lander_m_s2;
        let rotation = self.before_from_after.to_rotation_matrix().into_inner();
        let half = Matrix3::identity() * 0.5 + hat(&turn) / 6.0;
        let by_rotation = -rotation * hat(&force);
        let mut f = SMatrix::<f64, 9, 9>::identity();
        f.fixed_view_mut::<3, 3>(0, 0).copy_from(&exp(&-turn).to_rotation_matrix().into_inner());
        f.fixed_view_mut::<3, 3>(3, 0).copy_from(&(by_rotation * dt));
        f.fixed_view_mut::<3, 3>(6, 0).copy_from(&(by_rotation * (0.5 * dt * dt)));
        f.fixed_view_mut::<3, 3>(6, 3).copy_from(&(Matrix3::identity() * dt));
        let mut g = SMatrix::<f64, 9, 6>::zeros();
        g.fixed_view_mut::<3, 3>(0, 0).copy_from(&(Matrix3::identity() * dt));
        g.fixed_view_mut::<3, 3>(3, 3).copy_from(&(rotation * dt));
        g.fixed_view_mut::<3, 3>(6, 3).copy_from(&(rotation * (0.5 * dt * dt)));
        let white = SMatrix::<f64, 6, 6>::from_diagonal(&white_noise(noise, dt));
        ImuIncrement {
            duration_s: self.duration_s + dt,
            before_from_after: self.before_from_after * exp(&turn),
            velocity_in_before_m_s: self.velocity_in_before_m_s + rotation * left_jacobian(&turn) * force * dt,
            position_in_before_m: self.position_in_before_m
                + self.velocity_in_before_m_s * dt
                + rotation * half * force * (dt * dt),
            covariance: f * self.covariance * f.transpose() + g * white * g.transpose(),
        }
    }
}

/// Variances of rate and specific force averaged over `duration_s`.
fn white_noise(noise: &ImuNoise, duration_s: f64) -> SMatrix<f64, 6, 1> {
    let rate = noise.gyroscope_noise_density.powi(2) / duration_s;
    let force = noise.accelerometer_noise_density.powi(2) / duration_s;
    SMatrix::<f64, 6, 1>::from_column_slice(&[rate, rate, rate, force, force, force])
}

/// The whole record of an IMU; each sample is the mean over the interval that ends at its time.
#[derive(Debug, Clone, Copy)]
pub struct ImuRecord<'a> {
    /// Samples in order of time.
    pub samples: &'a [ImuSample],
    /// Noise densities and rate.
    pub noise: &'a ImuNoise,
}

impl ImuRecord<'_> {
    /// The increment from `from_ns` to `to_ns`; samples across an end are used in part.
    ///
    /// # Errors
    /// [`LandingError::ImuGap`] where samples are missing for longer than 1 s, or at either end for longer than one and
    /// a half sample intervals.
    pub fn between(&self, from_ns: i64, to_ns: i64) -> Result<ImuIncrement, LandingError> {
        let period_ns = (1e9 / self.noise.rate_hz) as i64;
        let first = self.samples.partition_point(|s| s.t_ns <= from_ns);
        let mut increment = ImuIncrement::identity();
        let mut now_ns = from_ns;
        for index in first..self.samples.len() {
            if now_ns >= to_ns {
                break;
            }
            let sample = &self.samples[index];
            let start_ns = index.checked_sub(1).map_or(sample.t_ns - period_ns, |before| self.samples[before].t_ns);
            let allowed_ns = if index == 0 { period_ns / 2 } else { 0 };
            if start_ns > now_ns + allowed_ns || sample.t_ns - start_ns > 1_000_000_000.max(2 * period_ns) {
                return Err(LandingError::ImuGap { from_ns: now_ns, to_ns: sample.t_ns });
            }
            let end_ns = sample.t_ns.min(to_ns);
            increment = increment.extended(sample, (end_ns - now_ns) as f64 * 1e-9, self.noise);
            now_ns = end_ns;
        }
        let late_ns = to_ns - now_ns;
        match self.samples.last() {
            Some(last) if late_ns > 0 && late_ns <= period_ns + period_ns / 2 => {
                Ok(increment.extended(last, late_ns as f64 * 1e-9, self.noise))
            }
            _ if late_ns > 0 => Err(LandingError::ImuGap { from_ns: now_ns, to_ns }),
            _ => Ok(increment),
        }
    }
}
