//! What `shaders/photometry.wgsl` reads of a material.

use crate::render::gpu::Photometry as PhotometryData;
use crate::scene::{HapkeParameters, LunarWeight, Photometry, oren_nayar_coefficients};
use bytemuck::Zeroable;

const LUNAR_LAMBERT: u32 = 0;
const OREN_NAYAR: u32 = 1;
const HAPKE: u32 = 2;
const LUNAR_LAMBERT_BY_PHASE: u32 = 3;

/// The law that a material follows: `MODEL` of the shader.
pub fn photometry_model(photometry: &Photometry) -> u32 {
    match photometry {
        Photometry::LunarLambert { weight: LunarWeight::Phase(_) } => LUNAR_LAMBERT_BY_PHASE,
        Photometry::Lambert | Photometry::LommelSeeliger | Photometry::LunarLambert { .. } => LUNAR_LAMBERT,
        Photometry::OrenNayar { .. } => OREN_NAYAR,
        Photometry::Hapke(_) => HAPKE,
    }
}

/// The material's parameters. Lambert's and Lommel-Seeliger's laws are the ends of the lunar-Lambert law.
pub fn photometry_data(photometry: &Photometry) -> PhotometryData {
    match photometry {
        Photometry::Lambert => lunar_lambert(&LunarWeight::Constant(0.0)),
        Photometry::LommelSeeliger => lunar_lambert(&LunarWeight::Constant(1.0)),
        Photometry::LunarLambert { weight } => lunar_lambert(weight),
        Photometry::OrenNayar { slope_sigma_deg } => {
            let [c1, c2] = oren_nayar_coefficients(slope_sigma_deg.to_radians());
            PhotometryData { rough: [c1 as f32, c2 as f32, 0.0, 0.0], ..Zeroable::zeroed() }
        }
        Photometry::Hapke(parameters) => hapke(parameters),
    }
}

fn lunar_lambert(weight: &LunarWeight) -> PhotometryData {
    PhotometryData { lunar: weight.coefficients().map(|c| c as f32), ..Zeroable::zeroed() }
}

fn hapke(parameters: &HapkeParameters) -> PhotometryData {
    let (chi, tangent) = parameters.roughness_factors();
    PhotometryData {
        asymmetry: parameters.asymmetry as f32,
        opposition_amplitude: parameters.opposition_amplitude as f32,
        opposition_width: parameters.opposition_width as f32,
        rough: [0.0, 0.0, chi as f32, tangent as f32],
        ..Zeroable::zeroed()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::gpu::Gpu;
    use crate::render::gpu::Twin;
    use crate::scene::PhotometricAngles;
    use nalgebra::Vector3;

    const TWIN: &str = concat!(
        include_str!("../../../shaders/photometry.wgsl"),
        "@group(0) @binding(0) var<storage, read> material: Photometry;
         @group(0) @binding(1) var<storage, read> directions: array<vec4<f32>>; // to the Sun, to the camera; w = albedo
         @group(0) @binding(2) var<storage, read_write> results: array<f32>;
         @compute @workgroup_size(64)
         fn reflect_all(@builtin(global_invocation_id) id: vec3<u32>) {
             if id.x < arrayLength(&results) {
                 let sun = directions[2u * id.x];
                 let camera = directions[2u * id.x + 1u];
                 results[id.x] = reflectance(material, sun.w, vec3(0.0, 0.0, 1.0), sun.xyz, camera.xyz);
             }
         }"
    );

    /// Directions to Sun and camera over the hemisphere, grazing and below the horizon too, with the albedo behind.
    fn places() -> Vec<[[f32; 4]; 2]> {
        const TILTS_DEG: [f64; 12] = [0.0, 0.02, 1.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0, 89.97, 95.0];
        const AZIMUTHS_DEG: [f64; 8] = [0.0, 0.01, 2.0, 45.0, 90.0, 135.0, 178.0, 180.0];
        let mut places = Vec::new();
        for (i, e) in TILTS_DEG.into_iter().flat_map(|i| TILTS_DEG.into_iter().map(move |e| (i, e))) {
            for (azimuth, albedo) in AZIMUTHS_DEG.into_iter().flat_map(|a| [0.05, 0.3, 1.0].map(|albedo| (a, albedo))) {
                let direction = |tilt_deg: f64, azimuth_deg: f64| {
                    let (sine, cosine) = tilt_deg.to_radians().sin_cos();
                    let (y, x) = azimuth_deg.to_radians().sin_cos();
                    [(sine * x) as f32, (sine * y) as f32, cosine as f32, albedo]
                };
                places.push([direction(i, 20.0), direction(e, 20.0 + azimuth)]);
            }
        }
        places
    }

    fn on_adapter(gpu: &Gpu, model: &Photometry, places: &[[[f32; 4]; 2]]) -> Vec<f32> {
        let numbers = photometry_data(model);
        let twin = Twin {
            source: TWIN,
            constants: &[("MODEL", f64::from(photometry_model(model)))],
            inputs: &[bytemuck::bytes_of(&numbers), bytemuck::cast_slice(places)],
            result_bytes: 4 * places.len(),
            invocations: places.len(),
        };
        bytemuck::pod_collect_to_vec(&twin.run(gpu))
    }

    fn direction([x, y, z, _]: [f32; 4]) -> Vector3<f64> {
        Vector3::new(x, y, z).cast::<f64>().normalize()
    }

    /// Largest difference of I/F between the adapter and a model on the CPU, over the larger of I/F and a hundredth of the
    /// albedo; infinite if the adapter gives no number.
    fn largest_difference(
        places: &[[[f32; 4]; 2]],
        found: &[f32],
        model: impl Fn(f64, &PhotometricAngles) -> f64,
    ) -> f64 {
        let difference = |([sun, camera], found): (&[[f32; 4]; 2], &f32)| {
            let angles = PhotometricAngles::new(&Vector3::z(), &direction(*sun), &direction(*camera));
            let albedo = f64::from(sun[3]);
            let expected = model(albedo, &angles);
            let off = (f64::from(*found) - expected).abs() / expected.max(0.01 * albedo);
            if off.is_finite() { off } else { f64::INFINITY }
        };
        places.iter().zip(found).map(difference).fold(0.0, f64::max)
    }

    #[test]
    fn the_adapter_reflects_as_the_cpu_does() {
        let gpu = Gpu::new(None).expect("an adapter");
        let places = places();
        let rough = HapkeParameters { roughness_deg: 30.0, ..HapkeParameters::default() };
        let smooth = HapkeParameters { roughness_deg: 0.0, asymmetry: 0.4, ..HapkeParameters::default() };
        let models = [
            Photometry::Lambert,
            Photometry::LommelSeeliger,
            Photometry::LunarLambert { weight: LunarWeight::Constant(0.6) },
            Photometry::LunarLambert { weight: LunarWeight::MOON },
            Photometry::OrenNayar { slope_sigma_deg: 25.0 },
            Photometry::Hapke(rough),
            Photometry::Hapke(smooth),
        ];
        for model in models {
            let found = on_adapter(&gpu, &model, &places);
            let off = largest_difference(&places, &found, |albedo, angles| model.reflectance(albedo, angles));
            println!("{model:?}: {off:.1e}");
            assert!(off < 1e-3, "{model:?} differs by {off:.1e}");
            // The incidence in place of the phase is another law, where the phase counts at all.
            let by_incidence = largest_difference(&places, &found, |albedo, angles| {
                let phase_rad = angles.cos_incidence.clamp(-1.0, 1.0).acos();
                model.reflectance(albedo, &PhotometricAngles { phase_rad, ..*angles })
            });
            let is_phased = matches!(model, Photometry::Hapke(_))
                || model == Photometry::LunarLambert { weight: LunarWeight::MOON };
            assert_eq!(by_incidence > 0.1, is_phased, "{model:?}: {by_incidence:.1e}");
        }
    }
}
