// Band-limited gradient noise on a hashed integer lattice: the same function, from the same integers, as src/scene/noise.rs.
// Lattice coordinates are a whole cell (of the camera, from f64) plus a small f32 offset, so they stay exact everywhere.

const OCTAVES: u32 = 32u;

struct Octave {
    row_x: vec4<f32>, // row of lattice_from_reference, per m; w = wavelength in m
    row_y: vec4<f32>, // w = relief in m
    row_z: vec4<f32>, // w = relative change of the albedo
    cell: vec4<i32>,  // lattice cell of the camera; w = seed
    fraction: vec4<f32>, // the camera's place inside its cell
}

struct NoiseSample {
    relief: f32,
    albedo: f32,
    relief_gradient: vec3<f32>,
}

const MULTIPLIER: u32 = 1664525u;
const INCREMENT: u32 = 1013904223u;

fn pcg2d(at: vec2<u32>) -> vec2<u32> {
    var v = at * MULTIPLIER + INCREMENT;
    v.x += v.y * MULTIPLIER;
    v.y += v.x * MULTIPLIER;
    v ^= v >> vec2(16u);
    v.x += v.y * MULTIPLIER;
    v.y += v.x * MULTIPLIER;
    return v ^ (v >> vec2(16u));
}

fn pcg3d(at: vec3<u32>) -> vec3<u32> {
    var v = at * MULTIPLIER + INCREMENT;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

fn halves(h: u32) -> vec2<f32> {
    return vec2(f32(h & 0xffffu), f32(h >> 16u)) / 32767.5 - 1.0;
}

fn fade(t: vec3<f32>) -> vec3<f32> {
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

fn fade_slope(t: vec3<f32>) -> vec3<f32> {
    return 30.0 * t * t * (t - 1.0) * (t - 1.0);
}

fn noise_2d(cell: vec2<i32>, f: vec2<f32>, seed: u32) -> NoiseSample {
    let high = fade(vec3(f, 0.0)).xy;
    let slope = fade_slope(vec3(f, 0.0)).xy;
    var total = NoiseSample(0.0, 0.0, vec3(0.0));
    for (var corner = 0u; corner < 4u; corner++) {
        let upper = vec2(corner & 1u, corner >> 1u);
        let is_upper = upper == vec2(1u);
        let at = vec2<u32>(cell) + upper;
        let hash = pcg2d(vec2(at.x ^ seed, at.y));
        let from_corner = f - vec2<f32>(upper);
        let weight = select(1.0 - high, high, is_upper);
        let side = select(-slope, slope, is_upper);
        let gradient = halves(hash.x);
        let value = dot(gradient, from_corner);
        total.relief += value * weight.x * weight.y;
        total.relief_gradient += vec3(weight.yx * (gradient * weight + value * side), 0.0);
        total.albedo += dot(halves(hash.y), from_corner) * weight.x * weight.y;
    }
    return total;
}

fn noise_3d(cell: vec3<i32>, f: vec3<f32>, seed: u32) -> NoiseSample {
    let high = fade(f);
    let slope = fade_slope(f);
    var total = NoiseSample(0.0, 0.0, vec3(0.0));
    for (var corner = 0u; corner < 8u; corner++) {
        let upper = vec3(corner & 1u, (corner >> 1u) & 1u, corner >> 2u);
        let is_upper = upper == vec3(1u);
        let at = vec3<u32>(cell) + upper;
        let hash = pcg3d(vec3(at.x ^ seed, at.y, at.z));
        let from_corner = f - vec3<f32>(upper);
        let weight = select(1.0 - high, high, is_upper);
        let side = select(-slope, slope, is_upper);
        let xy = halves(hash.x);
        let z = halves(hash.y);
        let gradient = vec3(xy, z.x);
        let albedo = vec3(halves(hash.z), z.y);
        let value = dot(gradient, from_corner);
        let others = weight.yzx * weight.zxy;
        total.relief += value * weight.x * others.x;
        total.relief_gradient += gradient * weight.x * others.x + value * side * others;
        total.albedo += dot(albedo, from_corner) * weight.x * others.x;
    }
    return total;
}

// Noise of one octave at a place relative to the camera (m); the gradient is per m.
fn octave_planar(octave: Octave, relative: vec3<f32>) -> NoiseSample {
    let lattice = vec2(dot(octave.row_x.xyz, relative), dot(octave.row_y.xyz, relative)) + octave.fraction.xy;
    let cell = floor(lattice);
    var noise = noise_2d(octave.cell.xy + vec2<i32>(cell), lattice - cell, u32(octave.cell.w));
    let g = noise.relief_gradient;
    noise.relief_gradient = octave.row_x.xyz * g.x + octave.row_y.xyz * g.y;
    return noise;
}

fn octave_solid(octave: Octave, relative: vec3<f32>) -> NoiseSample {
    let lattice = vec3(dot(octave.row_x.xyz, relative), dot(octave.row_y.xyz, relative), dot(octave.row_z.xyz, relative))
        + octave.fraction.xyz;
    let cell = floor(lattice);
    var noise = noise_3d(octave.cell.xyz + vec3<i32>(cell), lattice - cell, u32(octave.cell.w));
    let g = noise.relief_gradient;
    noise.relief_gradient = octave.row_x.xyz * g.x + octave.row_y.xyz * g.y + octave.row_z.xyz * g.z;
    return noise;
}

// How much of an octave a picture shows: 0 for cells below one pixel footprint, 1 above two and a half.
fn visibility(wavelength_m: f32, footprint_m: f32) -> f32 {
    let t = clamp((wavelength_m / footprint_m - 1.0) / 1.5, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}
