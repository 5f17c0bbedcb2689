// How a material scatters sunlight: the twin of src/scene/photometry, whose documentation gives the formulas.

struct Photometry {
    model: u32,         // LUNAR_LAMBERT, OREN_NAYAR
    unused_1: f32,
    unused_2: f32,
    unused_3: f32,
    lunar: vec4<f32>,   // coefficients of 1, phase, phase^2, phase^3 (rad) of the weight L
    rough: vec4<f32>,   // C1, C2 of Oren and Nayar
}

const LUNAR_LAMBERT: u32 = 0u;
const OREN_NAYAR: u32 = 1u;
const LEAST_COSINE: f32 = 1e-4; // keeps every quotient finite

// The phase itself, exact near 0 and pi too, of unit vectors.
fn phase_angle(to_sun: vec3<f32>, to_camera: vec3<f32>) -> f32 {
    return 2.0 * atan2(length(to_sun - to_camera), length(to_sun + to_camera));
}

// I/F of a place; all directions are unit vectors. 0 where the Sun is below the horizon of the place.
fn reflectance(
    material: Photometry,
    albedo: f32,
    normal: vec3<f32>,
    to_sun: vec3<f32>,
    to_camera: vec3<f32>,
) -> f32 {
    let sun_cosine = dot(normal, to_sun);
    if sun_cosine <= 0.0 {
        return 0.0;
    }
    let cos_i = clamp(sun_cosine, LEAST_COSINE, 1.0);
    let cos_e = clamp(dot(normal, to_camera), LEAST_COSINE, 1.0);
    if material.model == OREN_NAYAR {
        let across = max(dot(to_sun, to_camera) - cos_i * cos_e, 0.0); // sin i sin e cos psi
        return albedo * cos_i * (material.rough.x + material.rough.y * across / max(cos_i, cos_e));
    }
    var weight = material.lunar.x;
    if any(material.lunar.yzw != vec3(0.0)) {
        let phase = phase_angle(to_sun, to_camera);
        weight = clamp(dot(material.lunar, vec4(1.0, phase, phase * phase, phase * phase * phase)), 0.0, 1.0);
    }
    return albedo * cos_i * (2.0 * weight / (cos_i + cos_e) + 1.0 - weight);
}
