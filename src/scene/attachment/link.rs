//! How the links between the spacecraft bend and twist: small slow vibrations of each about its place.

use crate::settings::{OutOfRange, limits};
use crate::stats::random_stream;
use nalgebra::SVector;
use rand::{Rng, RngExt};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Vibration of each spacecraft about its place in the formation: three sinusoids on each axis, of the same amplitude,
/// with periods spread evenly in their logarithm and random phases.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FlexConfig {
    /// R.m.s. displacement along x and y in m an axis, 0 to 100 (default 0.005).
    pub in_plane_m: f64,
    /// R.m.s. displacement along z in m, 0 to 100 (default 0.046: 5 % of a side between two nodes).
    pub out_of_plane_m: f64,
    /// R.m.s. rotation about x and y in degrees an axis, 0 to 20 (default 1.5).
    pub tilt_deg: f64,
    /// R.m.s. rotation about z in degrees, 0 to 20 (default 0.5).
    pub twist_deg: f64,
    /// Shortest period in s, 0.1 to 1e6 (default 60).
    pub shortest_period_s: f64,
    /// Longest period in s (default 400).
    pub longest_period_s: f64,
}

impl Default for FlexConfig {
    fn default() -> Self {
        FlexConfig {
            in_plane_m: 0.005,
            out_of_plane_m: 0.046,
            tilt_deg: 1.5,
            twist_deg: 0.5,
            shortest_period_s: 60.0,
            longest_period_s: 400.0,
        }
    }
}

impl FlexConfig {
    /// R.m.s. values of displacement x, y, z (m) and rotation x, y, z (rad).
    pub fn rms(&self) -> SVector<f64, 6> {
        let (tilt, twist) = (self.tilt_deg.to_radians(), self.twist_deg.to_radians());
        SVector::from([self.in_plane_m, self.in_plane_m, self.out_of_plane_m, tilt, tilt, twist])
    }

    /// The vibration of one spacecraft, seeded by its number.
    pub fn vibration(&self, seed: u64, node: u32) -> Sinusoids {
        let mut random = random_stream(seed, "flex", u64::from(node));
        let terms = std::array::from_fn(|_| self.axis(&mut random));
        Sinusoids { amplitude: self.rms() * (2.0 / TERMS as f64).sqrt(), terms }
    }

    fn axis(&self, random: &mut impl Rng) -> [Sinusoid; TERMS] {
        let (low, high) = (self.shortest_period_s.ln(), self.longest_period_s.ln());
        std::array::from_fn(|_| {
            let period_s = (low + (high - low) * random.random::<f64>()).exp();
            Sinusoid {
                rate_rad_s: std::f64::consts::TAU / period_s,
                phase_rad: std::f64::consts::TAU * random.random::<f64>(),
            }
        })
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("in_plane_m", self.in_plane_m, 0.0, 100.0)?;
        limits::within("out_of_plane_m", self.out_of_plane_m, 0.0, 100.0)?;
        limits::within("tilt_deg", self.tilt_deg, 0.0, 20.0)?;
        limits::within("twist_deg", self.twist_deg, 0.0, 20.0)?;
        limits::within("shortest_period_s", self.shortest_period_s, 0.1, 1e6)?;
        limits::within("longest_period_s", self.longest_period_s, self.shortest_period_s, 1e6)
    }
}

const TERMS: usize = 3;

#[derive(Debug, Clone, Copy, PartialEq)]
struct Sinusoid {
    rate_rad_s: f64,
    phase_rad: f64,
}

/// A vibration: displacement x, y, z in m and rotation vector x, y, z in rad, with its derivatives by time.
#[derive(Debug, Clone, PartialEq)]
pub struct Sinusoids {
    amplitude: SVector<f64, 6>,
    terms: [[Sinusoid; TERMS]; 6],
}

impl Sinusoids {
    /// The value (`order` 0) or its first or second derivative by time (1, 2) at a time in s.
    pub fn derivative(&self, order: u32, t_s: f64) -> SVector<f64, 6> {
        let quarter = f64::from(order) * std::f64::consts::FRAC_PI_2;
        let term = |s: &Sinusoid| s.rate_rad_s.powi(order as i32) * (s.rate_rad_s * t_s + s.phase_rad + quarter).sin();
        SVector::from_fn(|axis, _| self.amplitude[axis] * self.terms[axis].iter().map(term).sum::<f64>())
    }
}
