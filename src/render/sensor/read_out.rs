//! Full well, read noise, gain, black level, quantisation.

use crate::scene::SensorConfig;
use rand::Rng;
use rand_distr::{Distribution, StandardNormal};

/// From electrons to digital numbers: y = black level + electrons / gain, rounded to a whole number within the range
/// (EMVA 1288, equations 8 and 11; our gain is the inverse 1/K of the standard's).
#[derive(Debug, Clone, Copy)]
pub(super) struct ReadOut {
    full_well_electrons: f64,
    read_noise_electrons: f64,
    dn_per_electron: f64,
    black_level_dn: f64,
    largest_dn: f64,
}

impl ReadOut {
    pub(super) fn new(config: &SensorConfig) -> Self {
        ReadOut {
            full_well_electrons: config.full_well_electrons,
            read_noise_electrons: config.read_noise_electrons,
            dn_per_electron: 1.0 / config.gain_electrons_per_dn(),
            black_level_dn: config.black_level_dn,
            largest_dn: config.largest_dn(),
        }
    }

    /// Electrons that the pixel holds of those freed.
    pub(super) fn held(&self, freed_electrons: f64) -> f64 {
        freed_electrons.min(self.full_well_electrons)
    }

    /// The digital number of `electrons` read with normal noise.
    pub(super) fn noisy(&self, electrons: f64, random: &mut impl Rng) -> u16 {
        let z: f64 = StandardNormal.sample(random);
        self.number(electrons + self.read_noise_electrons * z)
    }

    /// The digital number of `electrons`.
    pub(super) fn number(&self, electrons: f64) -> u16 {
        // Half a number up, then cut off: rounded.
        let number = self.black_level_dn + self.dn_per_electron * electrons + 0.5;
        number.clamp(0.0, self.largest_dn) as u16
    }
}
