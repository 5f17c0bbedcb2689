//! Fractal relief of a small body: a sum of random plane waves, octave by octave, in three dimensions.
//!
//! Waves of random direction and phase make a Gaussian random field (Shinozuka and Jan, "Digital simulation of random
//! processes and its applications", 1972); cut by the body's surface it is isotropic and has no seam and no pole.

use nalgebra::Vector3;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, UnitSphere};
use std::f64::consts::TAU;

const WAVES_PER_OCTAVE: usize = 32;

/// A random field with zero mean and the given r.m.s.
pub(super) struct BodyRelief {
    waves: Vec<Wave>,
}

struct Wave {
    vector: Vector3<f64>,
    phase_rad: f64,
    amplitude: f64,
}

impl BodyRelief {
    /// Field on points of about unit length; octave k has `3·2^k` waves a circumference or so, and half of the
    /// amplitude of the octave before.
    pub fn new(rms: f64, octaves: u32, random: &mut ChaCha8Rng) -> Self {
        let total: f64 = (0..octaves).map(|k| 0.25_f64.powi(k as i32)).sum();
        let amplitude = |k: u32| rms * 0.5_f64.powi(k as i32) * (2.0 / (total * WAVES_PER_OCTAVE as f64)).sqrt();
        let mut waves = Vec::new();
        for k in 0..octaves {
            for _ in 0..WAVES_PER_OCTAVE {
                let direction = Vector3::from(UnitSphere.sample(random));
                let number = 3.0 * 2.0_f64.powi(k as i32) * random.random_range(0.75..1.5);
                let phase_rad = random.random_range(0.0..TAU);
                waves.push(Wave { vector: direction * number, phase_rad, amplitude: amplitude(k) });
            }
        }
        BodyRelief { waves }
    }

    /// Value of the field at a point, in the unit of its r.m.s.
    pub fn at(&self, point: &Vector3<f64>) -> f64 {
        self.waves.iter().map(|w| w.amplitude * (w.vector.dot(point) + w.phase_rad).cos()).sum()
    }
}
