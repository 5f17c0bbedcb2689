//! Refines a point by the grey levels about it (Lucas and Kanade 1981), after warping the old patch.

use super::local_affine::Affine;
use image::GrayImage;
use nalgebra::{Matrix3, Vector2, Vector3, Vector4};

/// A refined pixel.
pub(super) struct Refined {
    pub(super) pixel_px: Vector2<f64>,
    pub(super) sigma_px: f64,
}

/// Aligns the old patch of `2 half_px + 1` pixels a side, warped by `affine`, with the new picture: shift, gain and
/// offset, by Gauss-Newton. `None` at the edge, on featureless ground, or where the patches do not look alike (correlation below 0.8).
pub(super) fn refine_by_patch(
    (old, new): (&GrayImage, &GrayImage),
    old_px: &Vector2<f64>,
    affine: &Affine,
    half_px: i32,
) -> Option<Refined> {
    let to_old = affine.linear.try_inverse()?;
    let mut pixel = affine.apply(old_px);
    let template = sample_patch(old, half_px, |d| old_px + to_old * d)?;
    for _ in 0..15 {
        let (step, quality) = alignment(&template, new, &pixel, half_px)?;
        pixel += step;
        if (pixel - affine.apply(old_px)).norm() > 6.0 {
            return None;
        }
        if step.norm() < 0.005 {
            return (quality.correlation > 0.8).then_some(Refined { pixel_px: pixel, sigma_px: quality.sigma_px });
        }
    }
    None
}

struct Quality {
    correlation: f64,
    sigma_px: f64,
}

fn offsets(half_px: i32) -> impl Iterator<Item = Vector2<f64>> {
    (-half_px..=half_px).flat_map(move |v| (-half_px..=half_px).map(move |u| Vector2::new(f64::from(u), f64::from(v))))
}

fn sample_patch(picture: &GrayImage, half_px: i32, place: impl Fn(Vector2<f64>) -> Vector2<f64>) -> Option<Vec<f64>> {
    offsets(half_px).map(|d| sample(picture, &place(d))).collect()
}

/// Bilinear grey level; `None` outside.
fn sample(picture: &GrayImage, p: &Vector2<f64>) -> Option<f64> {
    let (u, v) = (p.x.floor(), p.y.floor());
    if u < 0.0 || v < 0.0 || u + 1.0 >= f64::from(picture.width()) || v + 1.0 >= f64::from(picture.height()) {
        return None;
    }
    let (fu, fv) = (p.x - u, p.y - v);
    let at = |i: u32, j: u32| f64::from(picture.get_pixel(u as u32 + i, v as u32 + j).0[0]);
    Some((at(0, 0) * (1.0 - fu) + at(1, 0) * fu) * (1.0 - fv) + (at(0, 1) * (1.0 - fu) + at(1, 1) * fu) * fv)
}

/// One Gauss-Newton step of the shift, and how alike the patches are.
fn alignment(template: &[f64], new: &GrayImage, pixel: &Vector2<f64>, half_px: i32) -> Option<(Vector2<f64>, Quality)> {
    let here = sample_patch(new, half_px, |d| pixel + d)?;
    let side = (2 * half_px + 1) as usize;
    let (mut normal, mut right) = (nalgebra::Matrix4::<f64>::zeros(), Vector4::zeros());
    for index in interior(side) {
        let slope = Vector2::new(here[index + 1] - here[index - 1], here[index + side] - here[index - side]) * 0.5;
        let row = Vector4::new(slope.x, slope.y, -template[index], -1.0);
        normal += row * row.transpose();
        right -= row * here[index];
    }
    // here(p + s) = gain * template + offset.
    let solution = normal.cholesky()?.solve(&right);
    let (gain, offset) = (solution[2], solution[3]);
    let shift = Vector2::new(solution[0], solution[1]);
    let count = interior(side).count() as f64;
    let mut moments = Matrix3::zeros();
    let mut misfit = 0.0;
    for index in interior(side) {
        let m = Vector3::new(1.0, here[index], template[index]);
        moments += m * m.transpose();
        misfit += (here[index] - gain * template[index] - offset).powi(2);
    }
    let covariance = |i: usize, j: usize| moments[(i, j)] / count - moments[(0, i)] * moments[(0, j)] / (count * count);
    let correlation = covariance(1, 2) / (covariance(1, 1) * covariance(2, 2)).sqrt().max(1e-9);
    let inverse = normal.try_inverse()?;
    // Neighbouring grey levels share their noise and the warp's error: count one in four as independent.
    let variance = (4.0 * misfit / count).max(0.1);
    let sigma_px = (variance * 0.5 * (inverse[(0, 0)] + inverse[(1, 1)])).sqrt().max(0.05);
    (shift.norm().is_finite() && sigma_px < 1.0).then_some((shift, Quality { correlation, sigma_px }))
}

fn interior(side: usize) -> impl Iterator<Item = usize> {
    (1..side - 1).flat_map(move |v| (1..side - 1).map(move |u| v * side + u))
}
