//! The table of octaves that `shaders/noise.wgsl` evaluates.

use crate::render::gpu::{OCTAVES, Octave};
use crate::scene::NoiseOctave;
use bytemuck::Zeroable;
use nalgebra::Vector3;

/// Octaves with lattice coordinates relative to the camera: its cell as integers, its place in the cell as a fraction.
/// Octaves too fine for any pixel (wavelength below `finest_m`) and those beyond the table are left out; what is left of
/// the table has no wavelength.
pub fn octave_table(octaves: &[NoiseOctave], camera_in_reference_m: &Vector3<f64>, finest_m: f64) -> [Octave; OCTAVES] {
    let mut table = [Octave::zeroed(); OCTAVES];
    let seen = octaves.iter().take_while(|o| o.wavelength_m >= finest_m);
    for (entry, octave) in table.iter_mut().zip(seen) {
        *entry = octave_relative_to(octave, camera_in_reference_m);
    }
    table
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::gpu::Gpu;
    use crate::render::gpu::Twin;
    use crate::scene::OctaveStrength;
    use crate::stats::random_stream;
    use rand::RngExt;

    const TWIN: &str = concat!(
        include_str!("../../../shaders/noise.wgsl"),
        "@group(0) @binding(0) var<storage, read> table: array<Octave, OCTAVES>;
         @group(0) @binding(1) var<storage, read> places: array<vec4<f32>>; // relative to the camera; w = octave
         @group(0) @binding(2) var<storage, read_write> results: array<vec4<f32>>; // two a place: solid, planar
         @compute @workgroup_size(64)
         fn sample_all(@builtin(global_invocation_id) id: vec3<u32>) {
             let place = places[id.x];
             let octave = table[u32(place.w)];
             let planar = octave_planar(octave, place.xyz);
             let solid = octave_solid(octave, place.xyz);
             let to_lattice = octave.row_x.w; // gradients per wavelength
             results[2u * id.x] = vec4(solid.relief, solid.relief_gradient.xy * to_lattice, solid.albedo);
             results[2u * id.x + 1u] = vec4(planar.relief, planar.relief_gradient.xy * to_lattice, planar.albedo);
         }"
    );

    fn on_adapter(gpu: &Gpu, table: &[Octave; OCTAVES], places: &[[f32; 4]]) -> Vec<[f32; 4]> {
        let twin = Twin {
            source: TWIN,
            constants: &[],
            inputs: &[bytemuck::cast_slice(table), bytemuck::cast_slice(places)],
            result_bytes: 32 * places.len(),
            invocations: places.len(),
        };
        bytemuck::pod_collect_to_vec(&twin.run(gpu))
    }

    /// Largest difference between the adapter's noise and the CPU's around a camera, of the solid noise alone (1 function)
    /// or of both (2).
    fn largest_difference(
        octaves: &[NoiseOctave],
        table: &[Octave; OCTAVES],
        camera: &Vector3<f64>,
        functions: usize,
    ) -> f64 {
        let mut random = random_stream(1, "twin", 0);
        let place = |_| {
            let which = random.random_range(0..octaves.len());
            // As far as an octave is ever seen: some thousand wavelengths.
            let reach_m = 1000.0 * octaves[which].wavelength_m;
            let mut at = || random.random_range(-reach_m..reach_m) as f32;
            [at(), at(), at(), which as f32]
        };
        let places: Vec<[f32; 4]> = (0..6400).map(place).collect();
        let results = on_adapter(&Gpu::new(None).expect("an adapter"), table, &places);
        let difference = |(place, found): (&[f32; 4], &[[f32; 4]])| {
            let octave = &octaves[place[3] as usize];
            let at = camera + Vector3::new(place[0], place[1], place[2]).cast::<f64>();
            let samples = [octave.sample_solid(&at), octave.sample_planar(at.x, at.y)];
            samples.iter().zip(found).take(functions).fold(0.0, |most: f64, (sample, found)| {
                let g = sample.relief_gradient * octave.wavelength_m;
                let expected = [sample.relief, g.x, g.y, sample.albedo];
                expected.iter().zip(found).fold(most, |m, (e, f)| m.max((e - f64::from(*f)).abs()))
            })
        };
        places.iter().zip(results.chunks(2)).map(difference).fold(0.0, f64::max)
    }

    #[test]
    fn the_adapter_computes_the_same_noise_as_the_cpu() {
        let strength = OctaveStrength {
            largest_m: 6000.0,
            smallest_m: 0.02,
            slope_at_1_m: 0.1,
            hurst: 0.8,
            albedo_contrast: 0.05,
        };
        let camera = Vector3::new(-21_234.567, 17_654.321, 4.2);
        let planar = NoiseOctave::planar(&strength, 3, "twin");
        let solid = NoiseOctave::solid(&strength, 3, "twin");
        for (octaves, functions) in [(planar, 2), (solid, 1)] {
            let table = octave_table(&octaves, &camera, 0.0);
            assert_eq!(table.iter().filter(|entry| entry.row_x[3] > 0.0).count(), octaves.len());
            let off = largest_difference(&octaves, &table, &camera, functions);
            assert!(off < 1e-3, "noise differs by {off}");
            // One cell off is another noise.
            let mut wrong = table;
            wrong.iter_mut().for_each(|octave| octave.cell[0] += 1);
            assert!(largest_difference(&octaves, &wrong, &camera, functions) > 0.3);
        }
    }
}
