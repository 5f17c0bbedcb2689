//! A fractal texture, and pictures of it with known geometry.

use image::GrayImage;
use nalgebra::{Matrix3, Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::stats::random_stream;
use rand_distr::{Distribution, StandardNormal};

fn lattice(x: i64, y: i64, octave: u64) -> f64 {
    let mut h = (x as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (y as u64).wrapping_mul(0xc2b2_ae3d_27d4_eb4f);
    h = (h ^ octave.wrapping_mul(0x1656_67b1_9e37_79f9)).wrapping_mul(0xff51_afd7_ed55_8ccd);
    h = (h ^ (h >> 33)).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    ((h ^ (h >> 33)) >> 11) as f64 / (1u64 << 53) as f64 - 0.5
}

fn noise(p: Vector2<f64>, octave: u64) -> f64 {
    let (x, y) = (p.x.floor(), p.y.floor());
    let smooth = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let (s, t) = (smooth(p.x - x), smooth(p.y - y));
    let at = |i: i64, j: i64| lattice(x as i64 + i, y as i64 + j, octave);
    (at(0, 0) * (1.0 - s) + at(1, 0) * s) * (1.0 - t) + (at(0, 1) * (1.0 - s) + at(1, 1) * s) * t
}

/// Grey level in 0..1 with wavelengths from 128 down to 4 units.
pub fn texture(p: Vector2<f64>) -> f64 {
    let mut value = 0.5;
    for octave in 0..6 {
        let wavelength = 128.0 / f64::from(1 << octave);
        value += 0.55
            * 0.72f64.powi(octave)
            * noise(p / wavelength + Vector2::new(17.3, 5.1) * f64::from(octave), octave as u64);
    }
    value
}

/// Image whose pixel `p` shows the texture at `place(p)`, with normal noise in grey levels.
pub fn picture(
    width: u32,
    height: u32,
    noise_dn: f64,
    seed: u64,
    place: impl Fn(Vector2<f64>) -> Vector2<f64>,
) -> GrayImage {
    let mut random = random_stream(seed, "grey", 0);
    GrayImage::from_fn(width, height, |u, v| {
        let z: f64 = StandardNormal.sample(&mut random);
        let grey = 255.0 * texture(place(Vector2::new(f64::from(u), f64::from(v)))) + noise_dn * z;
        image::Luma([grey.round().clamp(0.0, 255.0) as u8])
    })
}

pub fn apply(h: &Matrix3<f64>, p: Vector2<f64>) -> Vector2<f64> {
    let q: Vector3<f64> = h * p.push(1.0);
    q.xy() / q.z
}

/// Scale by 3 % and turn by 2° about a pixel.
pub fn similarity(scale: f64, turn_deg: f64, about_px: Vector2<f64>) -> Matrix3<f64> {
    let (s, c) = turn_deg.to_radians().sin_cos();
    let linear = nalgebra::Matrix2::new(c, -s, s, c) * scale;
    let shift = about_px - linear * about_px;
    let mut h = Matrix3::identity();
    h.fixed_view_mut::<2, 2>(0, 0).copy_from(&linear);
    h.fixed_view_mut::<2, 1>(0, 2).copy_from(&shift);
    h
}

/// Where a pixel's ray meets the ground z = 0, m.
pub fn ground(camera: &Camera, pose: &nalgebra::Isometry3<f64>, pixel: Vector2<f64>) -> Vector3<f64> {
    let ray = pose.rotation * camera.unproject(&pixel).unwrap().into_inner();
    let origin = pose.translation.vector;
    origin - ray * (origin.z / ray.z)
}
