// How a material scatters sunlight: the twin of src/scene/photometry, whose documentation gives the formulas.

struct Photometry {
    asymmetry: f32,            // Hapke: xi of Henyey and Greenstein, negative scatters back
    opposition_amplitude: f32, // Hapke: B0
    opposition_width: f32,     // Hapke: h
    unused: f32,
    lunar: vec4<f32>,          // lunar-Lambert: coefficients of 1, phase, phase^2, phase^3 (rad) of the weight L
    rough: vec4<f32>,          // Oren-Nayar: C1, C2; Hapke: chi, tangent of the roughness
}

// Which law the material follows; the others are not compiled.
override MODEL: u32 = LUNAR_LAMBERT;

const LUNAR_LAMBERT: u32 = 0u;
const OREN_NAYAR: u32 = 1u;
const HAPKE: u32 = 2u;
const LUNAR_LAMBERT_BY_PHASE: u32 = 3u; // the weight is no constant
const LEAST_COSINE: f32 = 1e-4; // keeps every quotient finite
const LEAST_ROUGHNESS: f32 = 1e-3;

// Tangent of half the angle between unit vectors, exact near 0 and pi too.
fn half_angle_tangent(a: vec3<f32>, b: vec3<f32>) -> f32 {
    return length(a - b) / max(length(a + b), 1e-6);
}

// Tangent of half the azimuth between two unit vectors around the normal.
fn half_azimuth_tangent(normal: vec3<f32>, a: vec3<f32>, b: vec3<f32>) -> f32 {
    let across_a = a - normal * dot(normal, a);
    let across_b = b - normal * dot(normal, b);
    return half_angle_tangent(across_a / max(length(across_a), 1e-9), across_b / max(length(across_b), 1e-9));
}

// Chandrasekhar's H(x) for the single-scattering albedo w; as in src/scene/photometry/chandrasekhar.rs.
fn chandrasekhar_h(w: f32, x: f32) -> f32 {
    let gamma = sqrt(1.0 - w);
    let r0 = (1.0 - gamma) / (1.0 + gamma);
    let hapke = 1.0 / (1.0 - w * x * (r0 + (0.5 - r0 * x) * log((1.0 + x) / x)));
    let powers = vec3(1.0, x, x * x);
    let c0 = dot(powers, vec3(0.0271, -0.0336, 0.0149));
    let c1 = dot(powers, vec3(0.2652, -0.4981, 0.2804));
    let c2 = dot(powers, vec3(-0.214, 0.3815, -0.2267));
    return hapke * (1.0 + (1.0 - gamma) * (1.0 - gamma) * x * (c0 + gamma * (c1 + gamma * c2)));
}

// Hapke's E1 and E2 of a direction, its sine times the tangent of the roughness, and its eta over chi.
fn slopes(cosine: f32, tangent: f32) -> vec4<f32> {
    let sine_tangent = sqrt(max(1.0 - cosine * cosine, 0.0)) * tangent;
    let cotangents = cosine / max(sine_tangent, 1e-9);
    let e1 = exp(-0.63661977 * cotangents);
    let e2 = exp(-0.31830989 * cotangents * cotangents);
    return vec4(e1, e2, sine_tangent, cosine + sine_tangent * e2 / (2.0 - e1));
}

// Effective cosines of incidence and emission, and the shadowing S, of a rough surface.
fn effective_cosines(material: Photometry, cos_i: f32, cos_e: f32, half_tangent: f32) -> vec3<f32> {
    let chi = material.rough.z;
    let tangent = material.rough.w;
    let cos_near = max(cos_i, cos_e);
    let cos_far = min(cos_i, cos_e);
    let near = slopes(cos_near, tangent);
    let far = slopes(cos_far, tangent);
    let half = half_tangent * half_tangent / (1.0 + half_tangent * half_tangent); // sin^2 of half the azimuth
    let visible = 2.0 - far.x - 0.63661977 * atan(half_tangent) * near.x;
    let near_e = chi * (cos_near + near.z * ((1.0 - 2.0 * half) * far.y + half * near.y) / visible);
    let far_e = chi * (cos_far + far.z * (far.y - half * near.y) / visible);
    let shared_part = exp(-2.0 * half_tangent);
    let cosines = max(select(vec2(far_e, near_e), vec2(near_e, far_e), cos_i >= cos_e), vec2(LEAST_COSINE));
    let shadowing = cosines.y * cos_i / (chi * near.w * far.w) / (1.0 - shared_part + shared_part * cos_near / near.w);
    return select(vec3(cosines, shadowing), vec3(cos_i, cos_e, 1.0), tangent < LEAST_ROUGHNESS);
}

fn hapke(material: Photometry, albedo: f32, effective: vec3<f32>, to_sun: vec3<f32>, to_camera: vec3<f32>) -> f32 {
    let w = clamp(albedo, 0.0, 1.0);
    let half_tangent = half_angle_tangent(to_sun, to_camera);
    let surge = material.opposition_amplitude / (1.0 + half_tangent / material.opposition_width);
    let squared = material.asymmetry * material.asymmetry;
    let base = 1.0 + 2.0 * material.asymmetry * dot(to_sun, to_camera) + squared;
    let single = (1.0 + surge) * (1.0 - squared) / (base * sqrt(base));
    let multiple = chandrasekhar_h(w, effective.x) * chandrasekhar_h(w, effective.y) - 1.0;
    return 0.25 * w * effective.x / (effective.x + effective.y) * (single + multiple) * effective.z;
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
    if MODEL == OREN_NAYAR || MODEL == HAPKE {
        let half_tangent = half_azimuth_tangent(normal, to_sun, to_camera);
        if MODEL == HAPKE {
            let effective = effective_cosines(material, cos_i, cos_e, half_tangent);
            return hapke(material, albedo, effective, to_sun, to_camera);
        }
        let sines = sqrt((1.0 - cos_i * cos_i) * (1.0 - cos_e * cos_e));
        let squared = half_tangent * half_tangent;
        let lobe = max((1.0 - squared) / (1.0 + squared), 0.0) * sines / max(cos_i, cos_e);
        return albedo * cos_i * (material.rough.x + material.rough.y * lobe);
    }
    var weight = material.lunar.x;
    if MODEL == LUNAR_LAMBERT_BY_PHASE {
        let phase = 2.0 * atan(half_angle_tangent(to_sun, to_camera));
        weight = clamp(dot(material.lunar, vec4(1.0, phase, phase * phase, phase * phase * phase)), 0.0, 1.0);
    }
    return albedo * cos_i * (2.0 * weight / (cos_i + cos_e) + 1.0 - weight);
}
