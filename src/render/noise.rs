//! The table of octaves that `shaders/noise.wgsl` evaluates.

use super::gpu_data::{OCTAVES, Octave};
use crate::scene::NoiseOctave;
use bytemuck::Zeroable;
use nalgebra::Vector3;

/// Octaves with lattice coordinates relative to the camera: its cell as integers, its place in the cell as a fraction.
/// Octaves too fine for any pixel (wavelength below `finest_m`) and those beyond the table are left out.
pub(super) fn octave_table(
    octaves: &[NoiseOctave],
    camera_in_reference_m: &Vector3<f64>,
    finest_m: f64,
) -> ([Octave; OCTAVES], u32) {
    let mut table = [Octave::zeroed(); OCTAVES];
    let seen = octaves.iter().take_while(|o| o.wavelength_m >= finest_m).take(OCTAVES);
    let mut count = 0;
    for (entry, octave) in table.iter_mut().zip(seen) {
        *entry = octave_relative_to(octave, camera_in_reference_m);
        count += 1;
    }
    (table, count)
}

fn octave_relative_to(octave: &NoiseOctave, camera_in_reference_m: &Vector3<f64>) -> Octave {
    let m = &octave.lattice_from_reference;
    let lattice = m * camera_in_reference_m + octave.offset;
    let row = |r: usize, last: f64| [m[(r, 0)] as f32, m[(r, 1)] as f32, m[(r, 2)] as f32, last as f32];
    // Wrapped to 32 bits, as the hash sees them.
    let cell = lattice.map(|c| c.floor() as i64 as i32);
    let fraction = lattice.map(|c| (c - c.floor()) as f32);
    Octave {
        row_x: row(0, octave.wavelength_m),
        row_y: row(1, octave.relief_m),
        row_z: row(2, octave.albedo),
        cell: [cell.x, cell.y, cell.z, octave.seed as i32],
        fraction: [fraction.x, fraction.y, fraction.z, 0.0],
    }
}
