//! IMU samples integrated between two times.

use super::biases::ImuBiases;
use crate::dataset::{ImuNoise, ImuSample};
use crate::geometry::so3::{exp, hat, left_jacobian};
use crate::navigation::landing::error::LandingError;
use nalgebra::{Matrix3, SMatrix, SVector, UnitQuaternion, Vector3};

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
    /// Derivative of those errors by what the biases are larger than those taken off, gyroscope first.
    pub by_bias: SMatrix<f64, 9, 6>,
    /// Variance that the biases gain on the way, rad²/s² and m²/s⁴.
    pub bias_walk: [f64; 6],
    /// Time without samples that was bridged, s.
    pub bridged_s: f64,
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
            by_bias: SMatrix::zeros(),
            bias_walk: [0.0; 6],
            bridged_s: 0.0,
        }
    }

    /// M = C_j C_iᵀ, `lander_after_from_lander_before`.
    pub fn after_from_before(&self) -> Matrix3<f64> {
        self.before_from_after.inverse().to_rotation_matrix().into_inner()
    }

    /// The increment longer by one sample, held over `duration_s`, the biases taken off. The noise is white, by density
    /// (Forster et al., "On-manifold preintegration for real-time visual-inertial odometry", 2017, appendix A).
    pub fn extended(&self, sample: &ImuSample, duration_s: f64, noise: &ImuNoise, biases: &ImuBiases) -> Self {
        let white = white_variances(noise, duration_s);
        let mut longer = self.lengthened(sample, duration_s, biases, &white);
        if let Some(walk) = noise.bias {
            for k in 0..6 {
                let density = if k < 3 { walk.gyroscope_random_walk } else { walk.accelerometer_random_walk };
                longer.bias_walk[k] += density.powi(2) * duration_s;
            }
        }
        longer
    }

    /// The increment longer by a time without samples, through which `guess` is held: wrong by a constant of
    /// [`GAP_RATE_SIGMA_RAD_S`] and [`GAP_FORCE_SIGMA_M_S2`].
    fn bridged(&self, guess: &ImuSample, duration_s: f64, biases: &ImuBiases) -> Self {
        let (rate, force) = (GAP_RATE_SIGMA_RAD_S.powi(2), GAP_FORCE_SIGMA_M_S2.powi(2));
        let constant = SVector::<f64, 6>::from_column_slice(&[rate, rate, rate, force, force, force]);
        let longer = self.lengthened(guess, duration_s, biases, &constant);
        ImuIncrement { bridged_s: self.bridged_s + duration_s, ..longer }
    }

    fn lengthened(&self, sample: &ImuSample, duration_s: f64, biases: &ImuBiases, variances: &SVector<f64, 6>) -> Self {
        let dt = duration_s;
        let turn = (sample.rate_in_lander_rad_s - biases.gyroscope_rad_s) * dt;
        let force = sample.specific_force_in_lander_m_s2 - biases.accelerometer_m_s2;
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
        g.fixed_view_mut::<3, 3>(3, 0).copy_from(&(by_rotation * (0.5 * dt * dt)));
        g.fixed_view_mut::<3, 3>(6, 0).copy_from(&(by_rotation * (dt.powi(3) / 6.0)));
        g.fixed_view_mut::<3, 3>(3, 3).copy_from(&(rotation * dt));
        g.fixed_view_mut::<3, 3>(6, 3).copy_from(&(rotation * (0.5 * dt * dt)));
        let white = SMatrix::<f64, 6, 6>::from_diagonal(variances);
        ImuIncrement {
            duration_s: self.duration_s + dt,
            before_from_after: self.before_from_after * exp(&turn),
            velocity_in_before_m_s: self.velocity_in_before_m_s + rotation * left_jacobian(&turn) * force * dt,
            position_in_before_m: self.position_in_before_m
                + self.velocity_in_before_m_s * dt
                + rotation * half * force * (dt * dt),
            covariance: f * self.covariance * f.transpose() + g * white * g.transpose(),
            by_bias: f * self.by_bias - g,
            bias_walk: self.bias_walk,
            bridged_s: self.bridged_s,
        }
    }
}

/// 1σ of the constant by which the rate held through a time without samples is wrong, rad/s.
pub const GAP_RATE_SIGMA_RAD_S: f64 = 0.01;
/// 1σ of the constant by which the specific force held through a time without samples is wrong, m/s².
pub const GAP_FORCE_SIGMA_M_S2: f64 = 0.5;
/// The longest time without samples that is bridged, s.
pub const LONGEST_GAP_S: f64 = 60.0;

/// Variances of rate and specific force averaged over `duration_s`.
fn white_variances(noise: &ImuNoise, duration_s: f64) -> SVector<f64, 6> {
    let rate = noise.gyroscope_noise_density.powi(2) / duration_s;
    let force = noise.accelerometer_noise_density.powi(2) / duration_s;
    SVector::<f64, 6>::from_column_slice(&[rate, rate, rate, force, force, force])
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
    /// The increment from `from_ns` to `to_ns`, the biases taken off; samples across an end are used in part. Where
    /// samples are missing, the mean of those on both sides is held and the covariance grows.
    ///
    /// # Errors
    /// [`LandingError::ImuGap`] where they are missing for longer than [`LONGEST_GAP_S`].
    pub fn between(&self, from_ns: i64, to_ns: i64, biases: &ImuBiases) -> Result<ImuIncrement, LandingError> {
        let period_ns = (1e9 / self.noise.rate_hz) as i64;
        let first = self.samples.partition_point(|s| s.t_ns <= from_ns);
        let mut increment = ImuIncrement::identity();
        let mut now_ns = from_ns;
        for index in first..self.samples.len() {
            if now_ns >= to_ns {
                break;
            }
            let sample = &self.samples[index];
            let covered_from_ns = self.covered_from_ns(index, period_ns);
            if covered_from_ns > now_ns {
                let until_ns = covered_from_ns.min(to_ns);
                increment = self.bridge(&increment, (now_ns, until_ns), index, biases)?;
                now_ns = until_ns;
            }
            let end_ns = sample.t_ns.min(to_ns);
            if end_ns > now_ns {
                increment = increment.extended(sample, (end_ns - now_ns) as f64 * 1e-9, self.noise, biases);
                now_ns = end_ns;
            }
        }
        let late_ns = to_ns - now_ns;
        match self.samples.last() {
            Some(last) if late_ns > 0 && late_ns <= period_ns + period_ns / 2 => {
                Ok(increment.extended(last, late_ns as f64 * 1e-9, self.noise, biases))
            }
            _ if late_ns > 0 => self.bridge(&increment, (now_ns, to_ns), self.samples.len(), biases),
            _ => Ok(increment),
        }
    }

    /// From when on a sample tells of the motion: its interval, or more where the clock is a little off.
    fn covered_from_ns(&self, index: usize, period_ns: i64) -> i64 {
        let t_ns = self.samples[index].t_ns;
        match index.checked_sub(1).map(|before| self.samples[before].t_ns) {
            None => t_ns - period_ns - period_ns / 2,
            Some(before_ns) if t_ns - before_ns <= 2 * period_ns => before_ns,
            Some(_) => t_ns - period_ns,
        }
    }

    /// The increment over a time without samples, before the sample `next`.
    fn bridge(
        &self,
        increment: &ImuIncrement,
        (from_ns, to_ns): (i64, i64),
        next: usize,
        biases: &ImuBiases,
    ) -> Result<ImuIncrement, LandingError> {
        let duration_s = (to_ns - from_ns) as f64 * 1e-9;
        let around = (next.checked_sub(1).and_then(|k| self.samples.get(k)), self.samples.get(next));
        let guess = match around {
            (Some(a), Some(b)) => ImuSample {
                t_ns: from_ns,
                rate_in_lander_rad_s: (a.rate_in_lander_rad_s + b.rate_in_lander_rad_s) * 0.5,
                specific_force_in_lander_m_s2: (a.specific_force_in_lander_m_s2 + b.specific_force_in_lander_m_s2)
                    * 0.5,
            },
            (Some(only), None) | (None, Some(only)) => *only,
            (None, None) => return Err(LandingError::ImuGap { from_ns, to_ns }),
        };
        if duration_s > LONGEST_GAP_S {
            return Err(LandingError::ImuGap { from_ns, to_ns });
        }
        Ok(increment.bridged(&guess, duration_s, biases))
    }
}
