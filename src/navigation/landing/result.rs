//! What the navigation of a descent gives back.

use super::bearings::Contradiction;
use super::inertial::ImuBiases;
use super::propagation::RotationCheck;
use nalgebra::{Isometry3, SMatrix, Vector3};

/// The estimate at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct LandingEpoch {
    /// Time in ns.
    pub t_ns: i64,
    /// Estimated pose of the lander in the site frame, m.
    pub site_from_lander: Isometry3<f64>,
    /// Estimated velocity of the lander in the site frame, m/s.
    pub lander_velocity_in_site_m_s: Vector3<f64>,
    /// Covariance of the errors, true less estimated: position (m), velocity (m/s) and attitude ψ (rad), all in site
    /// axes, where `true site_from_lander = exp(ψ) * estimated`.
    pub covariance: SMatrix<f64, 9, 9>,
    /// Where the ground point that track 0 follows is believed to lie, site frame, m: the origin unless the designated
    /// point's own errors are estimated. The lander's place above that point is known far better than either.
    pub designated_in_site_m: Vector3<f64>,
    /// Joint normalised innovation squared of the bearings used; `None` if none was.
    pub normalized_innovation_squared: Option<f64>,
    /// Its degrees of freedom.
    pub innovation_dof: usize,
    /// Bearings of landmarks that were gated.
    pub gated: usize,
    /// Whether the designated point was used.
    pub known_seen: bool,
    /// How far the contradiction between the filter and the designated point had come after this image.
    pub contradiction: Contradiction,
    /// Points of a map that were used.
    pub known_points: usize,
    /// Gyroscope against images, where the images told a rotation.
    pub rotation_check: Option<RotationCheck>,
    /// Biases of the IMU with their 1σ (gyroscope first), where they are estimated.
    pub biases: Option<(ImuBiases, [f64; 6])>,
    /// The first of the unknown landmarks being followed after this image.
    pub unknown_track: Option<u64>,
    /// All unknown landmarks being followed after this image.
    pub unknown_tracks: Vec<u64>,
}

impl LandingEpoch {
    /// 1σ of position (m), velocity (m/s) and attitude (rad), all in site axes.
    pub fn sigma(&self) -> [f64; 9] {
        std::array::from_fn(|k| self.covariance[(k, k)].max(0.0).sqrt())
    }
}

impl LandingResult {
    /// Stretches of epochs in a row of which something holds: the first and last time of each, ns.
    pub fn stretches(&self, holds: impl Fn(&LandingEpoch) -> bool) -> Vec<(i64, i64)> {
        let runs = self.epochs.chunk_by(|a, b| holds(a) == holds(b)).filter(|run| holds(&run[0]));
        runs.map(|run| (run[0].t_ns, run[run.len() - 1].t_ns)).collect()
    }
}

/// A time within an interval between two images for which the IMU has no samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImuGap {
    /// The interval, ns.
    pub interval_ns: (i64, i64),
    /// How long samples are missing in it, s.
    pub bridged_s: f64,
}

/// A navigated descent.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LandingResult {
    /// One epoch a frame, then one a second on the IMU alone to the end of its record.
    pub epochs: Vec<LandingEpoch>,
    /// Stretches (first and last time in ns) flown on the IMU alone: images missing, gated or too low.
    pub coasted: Vec<(i64, i64)>,
    /// Times that the IMU was silent; its motion was held through them.
    pub imu_gaps: Vec<ImuGap>,
    /// Bearings of landmarks used.
    pub used: usize,
    /// Bearings of landmarks gated.
    pub gated: usize,
    /// Observations whose pixel lies where the distortion cannot be inverted.
    pub unusable_pixels: usize,
}
