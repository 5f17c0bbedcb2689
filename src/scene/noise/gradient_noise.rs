//! Band-limited gradient noise on a hashed integer lattice, the building block of terrain and surface detail.
//!
//! The shader `shaders/noise.wgsl` computes the same function from the same integers, so that an image's texture is
//! known exactly on the CPU. Hash: pcg2d and pcg3d of Jarzynski and Olano, "Hash Functions for GPU Rendering", Journal
//! of Computer Graphics Techniques 9(3), 2020. Interpolation: Perlin, "Improving Noise", SIGGRAPH 2002.

use nalgebra::{Vector2, Vector3};

/// R.m.s. value of [`noise_2d`]: gradients are uniform in [-1, 1] an axis.
pub const NOISE_2D_RMS: f64 = 0.176_127_132_922_507_5;
/// R.m.s. length of the gradient of [`noise_2d`], per lattice unit.
pub const NOISE_2D_SLOPE_RMS: f64 = 0.721_216_505_236_793_3;
/// No gradient of [`noise_2d`] or its albedo field is longer than this, per lattice unit.
pub const NOISE_2D_STEEPEST: f64 = 7.0;
/// R.m.s. value of [`noise_3d`].
pub const NOISE_3D_RMS: f64 = 0.190_943_637_876_723_3;
/// R.m.s. length of the gradient of [`noise_3d`] along a surface (two of its three axes), per lattice unit.
pub const NOISE_3D_TANGENT_SLOPE_RMS: f64 = 0.704_412_230_018;

/// Two independent noise fields at one point: relief with its gradient, and albedo.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoiseSample {
    /// Value of the relief field.
    pub relief: f64,
    /// Gradient of the relief field per lattice unit (z is 0 in two dimensions).
    pub relief_gradient: Vector3<f64>,
    /// Value of the albedo field.
    pub albedo: f64,
}

pub fn pcg2d(x: u32, y: u32) -> [u32; 2] {
    let (mut x, mut y) = (mix(x), mix(y));
    x = x.wrapping_add(y.wrapping_mul(MULTIPLIER));
    y = y.wrapping_add(x.wrapping_mul(MULTIPLIER));
    x ^= x >> 16;
    y ^= y >> 16;
    x = x.wrapping_add(y.wrapping_mul(MULTIPLIER));
    y = y.wrapping_add(x.wrapping_mul(MULTIPLIER));
    [x ^ (x >> 16), y ^ (y >> 16)]
}

fn pcg3d(x: u32, y: u32, z: u32) -> [u32; 3] {
    let (mut x, mut y, mut z) = (mix(x), mix(y), mix(z));
    x = x.wrapping_add(y.wrapping_mul(z));
    y = y.wrapping_add(z.wrapping_mul(x));
    z = z.wrapping_add(x.wrapping_mul(y));
    x ^= x >> 16;
    y ^= y >> 16;
    z ^= z >> 16;
    x = x.wrapping_add(y.wrapping_mul(z));
    y = y.wrapping_add(z.wrapping_mul(x));
    z = z.wrapping_add(x.wrapping_mul(y));
    [x, y, z]
}

const MULTIPLIER: u32 = 1_664_525;

fn mix(v: u32) -> u32 {
    v.wrapping_mul(MULTIPLIER).wrapping_add(1_013_904_223)
}

/// The lower and upper half of a hash, each mapped to [-1, 1].
fn halves(h: u32) -> [f64; 2] {
    [f64::from(h & 0xffff) / 32767.5 - 1.0, f64::from(h >> 16) / 32767.5 - 1.0]
}

fn fade(t: f64) -> f64 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

fn fade_slope(t: f64) -> f64 {
    30.0 * t * t * (t - 1.0) * (t - 1.0)
}

/// Cell of a lattice coordinate and the fraction inside it.
pub(super) fn split(lattice: f64) -> (i64, f64) {
    // A cast truncates toward zero; `floor` would be a library call on some processors.
    let toward_zero = lattice as i64;
    let cell = toward_zero - i64::from(toward_zero as f64 > lattice);
    (cell, lattice - cell as f64)
}

/// One number each of the relief field and of the albedo field.
type Pair = [f64; 2];

/// What a lattice point carries: gradients of both fields by x, then by y.
pub(super) type PointGradients = [Pair; 2];

/// Lattice points of a cell, x fastest.
pub(super) type Corners = [PointGradients; 4];

/// Gradients at a lattice point; its coordinates wrap to 32 bits, as the shader's do.
pub(super) fn point_gradients(x: i64, y: i64, seed: u32) -> PointGradients {
    let hash = pcg2d(x as u32 ^ seed, y as u32);
    let ([gx, gy], [ax, ay]) = (halves(hash[0]), halves(hash[1]));
    [[gx, ax], [gy, ay]]
}

/// Gradients at the corners of a cell.
pub(super) fn corners_of([x, y]: [i64; 2], seed: u32) -> Corners {
    [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[dx, dy]| point_gradients(x + dx, y + dy, seed))
}

/// Gradient noise in two dimensions at a point in lattice units.
pub fn noise_2d(at: &Vector2<f64>, seed: u32) -> NoiseSample {
    let ((x, fx), (y, fy)) = (split(at.x), split(at.y));
    interpolate(&corners_of([x, y], seed), [fx, fy])
}

/// `low` to `high` by `t`, of both fields.
fn between(low: Pair, high: Pair, t: f64) -> Pair {
    [low[0] + (high[0] - low[0]) * t, low[1] + (high[1] - low[1]) * t]
}

/// Both fields' planes through the corners, at a place in the cell.
fn planes(corners: &Corners, [fx, fy]: [f64; 2]) -> [Pair; 4] {
    let (x, y) = ([fx, fx - 1.0], [fy, fy - 1.0]);
    let plane = |k: usize| {
        let [by_x, by_y] = corners[k];
        let (x, y) = (x[k & 1], y[k >> 1]);
        [by_x[0] * x + by_y[0] * y, by_x[1] * x + by_y[1] * y]
    };
    [plane(0), plane(1), plane(2), plane(3)]
}

/// Relief and albedo inside a cell, from its corners.
pub(super) fn interpolate_values(corners: &Corners, at: [f64; 2]) -> [f64; 2] {
    let [ux, uy] = at.map(fade);
    let v = planes(corners, at);
    between(between(v[0], v[1], ux), between(v[2], v[3], ux), uy)
}

/// Noise inside a cell, from its corners; the values are those of [`interpolate_values`] to the last bit.
pub(super) fn interpolate(corners: &Corners, at: [f64; 2]) -> NoiseSample {
    let [relief, albedo] = interpolate_values(corners, at);
    let [gx, gy] = gradients(corners, at).map(|by| by[0]);
    NoiseSample { relief, relief_gradient: Vector3::new(gx, gy, 0.0), albedo }
}

/// Gradient of the albedo field inside a cell, per lattice unit.
pub(super) fn albedo_gradient(corners: &Corners, at: [f64; 2]) -> Vector2<f64> {
    let [gx, gy] = gradients(corners, at).map(|by| by[1]);
    Vector2::new(gx, gy)
}

/// Derivatives of both fields by x and by y.
fn gradients(corners: &Corners, at: [f64; 2]) -> [Pair; 2] {
    let ([ux, uy], [dx, dy]) = (at.map(fade), at.map(fade_slope));
    let v = planes(corners, at);
    let across =
        |g: usize| between(between(corners[0][g], corners[1][g], ux), between(corners[2][g], corners[3][g], ux), uy);
    let less = |a: Pair, b: Pair| [a[0] - b[0], a[1] - b[1]];
    let plus = |a: Pair, b: Pair, by: f64| [a[0] + b[0] * by, a[1] + b[1] * by];
    let by_fade_x = between(less(v[1], v[0]), less(v[3], v[2]), uy);
    let by_fade_y = between(less(v[2], v[0]), less(v[3], v[1]), ux);
    [plus(across(0), by_fade_x, dx), plus(across(1), by_fade_y, dy)]
}

/// Gradient noise in three dimensions at a point in lattice units.
pub fn noise_3d(at: &Vector3<f64>, seed: u32) -> NoiseSample {
    let cells = [split(at.x), split(at.y), split(at.z)];
    let mut sample = NoiseSample { relief: 0.0, relief_gradient: Vector3::zeros(), albedo: 0.0 };
    for corner in 0..8_u32 {
        let upper = [corner & 1, (corner >> 1) & 1, corner >> 2];
        let index = |axis: usize| (cells[axis].0 as u32).wrapping_add(upper[axis]);
        let hash = pcg3d(index(0) ^ seed, index(1), index(2));
        let from_corner = Vector3::from_fn(|axis, _| cells[axis].1 - f64::from(upper[axis]));
        let side = |axis: usize, low: f64, high: f64| if upper[axis] == 1 { high } else { low };
        let weight = Vector3::from_fn(|a, _| side(a, 1.0 - fade(cells[a].1), fade(cells[a].1)));
        let slope = Vector3::from_fn(|a, _| side(a, -fade_slope(cells[a].1), fade_slope(cells[a].1)));
        let ([gx, gy], [gz, az], [ax, ay]) = (halves(hash[0]), halves(hash[1]), halves(hash[2]));
        let gradient = Vector3::new(gx, gy, gz);
        let value = gradient.dot(&from_corner);
        let others = Vector3::new(weight.y * weight.z, weight.x * weight.z, weight.x * weight.y);
        let product = weight.x * others.x;
        sample.relief += value * product;
        sample.relief_gradient += gradient * product + value * slope.component_mul(&others);
        sample.albedo += Vector3::new(ax, ay, az).dot(&from_corner) * product;
    }
    sample
}
