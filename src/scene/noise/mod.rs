//! Gradient noise with its derivatives (`gradient_noise`, the CPU's twin of `shaders/noise.wgsl`) and octaves of it
//! with their strength and orientation (`octave`). Terrain, bodies and albedo are sums of these.

mod gradient_noise;
mod octave;

pub use gradient_noise::{
    NOISE_2D_RMS, NOISE_2D_SLOPE_RMS, NOISE_2D_STEEPEST, NOISE_3D_RMS, NOISE_3D_TANGENT_SLOPE_RMS, NoiseSample,
    noise_2d, noise_3d, pcg2d,
};
pub use octave::{NoiseOctave, NoiseTable, OctaveStrength};
