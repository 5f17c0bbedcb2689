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

// Both halves, each mapped to [-1, 1]; by way of signed integers, which a software adapter converts faster.
fn halves(h: u32) -> vec2<f32> {
    return vec2(f32(i32(h & 0xffffu)), f32(i32(h >> 16u))) * (1.0 / 32767.5) - 1.0;
}

fn fade(t: vec3<f32>) -> vec3<f32> {
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

fn fade_slope(t: vec3<f32>) -> vec3<f32> {
    return 30.0 * t * t * (t - 1.0) * (t - 1.0);
}

// Between the values at the corners (0, 0), (1, 0), (0, 1) and (1, 1) of a cell.
fn between(corners: vec4<f32>, weight: vec2<f32>) -> f32 {
    let rows = corners.xz + weight.x * (corners.yw - corners.xz);
    return rows.x + weight.y * (rows.y - rows.x);
}

fn noise_2d(cell: vec2<i32>, f: vec2<f32>, seed: u32) -> NoiseSample {
    let low = vec2<u32>(cell);
    let hashes = array(
        pcg2d(vec2(low.x ^ seed, low.y)),
        pcg2d(vec2((low.x + 1u) ^ seed, low.y)),
        pcg2d(vec2(low.x ^ seed, low.y + 1u)),
        pcg2d(vec2((low.x + 1u) ^ seed, low.y + 1u)),
    );
    let from_x = vec4(f.x, f.x - 1.0, f.x, f.x - 1.0);
    let from_y = vec4(f.y, f.y, f.y - 1.0, f.y - 1.0);
    let g = array(halves(hashes[0].x), halves(hashes[1].x), halves(hashes[2].x), halves(hashes[3].x));
    let gradient_x = vec4(g[0].x, g[1].x, g[2].x, g[3].x);
    let gradient_y = vec4(g[0].y, g[1].y, g[2].y, g[3].y);
    let a = array(halves(hashes[0].y), halves(hashes[1].y), halves(hashes[2].y), halves(hashes[3].y));
    let albedo = vec4(a[0].x, a[1].x, a[2].x, a[3].x) * from_x + vec4(a[0].y, a[1].y, a[2].y, a[3].y) * from_y;
    let values = gradient_x * from_x + gradient_y * from_y;
    let weight = fade(vec3(f, 0.0)).xy;
    let slope = fade_slope(vec3(f, 0.0)).xy;
    let along_x = values.yw - values.xz;
    let along_y = values.zw - values.xy;
    let by_weight = vec2(along_x.x + weight.y * (along_x.y - along_x.x), along_y.x + weight.x * (along_y.y - along_y.x));
    let relief_gradient = vec2(between(gradient_x, weight), between(gradient_y, weight)) + slope * by_weight;
    return NoiseSample(between(values, weight), between(albedo, weight), vec3(relief_gradient, 0.0));
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
