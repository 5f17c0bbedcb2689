//! Aligns a patch of grey levels, warped by a predicted motion, with another picture (Lucas and Kanade 1981), in the
//! inverse compositional form of Baker and Matthews (2004) with a gain and an offset of the grey levels.

use super::local_affine::Affine;
use crate::vision::config::KltConfig;
use image::GrayImage;
use nalgebra::{Matrix2, Matrix4, Vector2, Vector4};

/// A step shorter than this ends the alignment, px.
const SETTLED_PX: f64 = 0.01;

/// Residuals of neighbouring pixels share their noise: this many count as one (fitted to rendered ground).
pub(super) const SHARED: f64 = 2.7;

/// What the ground's own change between two pictures costs, px: the error that is left without noise.
pub(super) const FLOOR_SIGMA_PX: f64 = 0.02;

/// Least variance of residuals: that of rounding, in squared grey levels.
pub(super) const LEAST_VARIANCE_DN2: f64 = 1.0 / 12.0;

/// A refined pixel.
pub struct Refined {
    pub pixel_px: Vector2<f64>,
    pub(super) covariance_px2: Matrix2<f64>,
    pub(super) correlation: f64,
}

impl Refined {
    /// R.m.s. 1σ of both coordinates, px.
    pub fn sigma_px(&self) -> f64 {
        (0.5 * self.covariance_px2.trace()).sqrt()
    }
}

/// Aligns the patch of the old picture about `old_px`, warped by `affine`, with the new picture. `None` at the edge, on
/// featureless ground, further than allowed from where `affine` leads, or where the patches do not look alike.
pub fn refine_by_patch(
    (old, new): (&GrayImage, &GrayImage),
    old_px: &Vector2<f64>,
    affine: &Affine,
    config: &KltConfig,
) -> Option<Refined> {
    let template = Template::new(old, old_px, &affine.linear.try_inverse()?, config.half_px as usize)?;
    let start_px = affine.apply(old_px);
    let mut pixel_px = start_px;
    let mut here = vec![0.0; template.side * template.side];
    for _ in 0..config.max_iterations {
        sample_square(new, &pixel_px, (template.side / 2, template.zero_dn), &mut here)?;
        let fit = template.fit(&here)?;
        pixel_px += fit.step_px;
        if (pixel_px - start_px).norm() > config.max_off_px || !pixel_px.x.is_finite() {
            return None;
        }
        if fit.step_px.norm() < SETTLED_PX {
            let refined = Refined { pixel_px, covariance_px2: fit.covariance_px2, correlation: fit.correlation };
            return (fit.correlation > config.min_correlation).then_some(refined);
        }
    }
    None
}

/// The warped old patch, as columns of a linear model of the new one: -slope by u, -slope by v, grey level, 1.
struct Template {
    side: usize,
    columns: [Vec<f32>; 3],
    /// Mean grey level of the old patch, from which all levels are counted: sums keep their digits.
    zero_dn: f32,
    mean_dn: f64,
    inverse: Matrix4<f64>,
    variance_dn2: f64,
}

/// How the new patch follows from the old one.
struct Fit {
    step_px: Vector2<f64>,
    covariance_px2: Matrix2<f64>,
    correlation: f64,
}

impl Template {
    fn new(old: &GrayImage, old_px: &Vector2<f64>, old_from_new: &Matrix2<f64>, half_px: usize) -> Option<Self> {
        let (side, wide) = (2 * half_px + 1, 2 * half_px + 3);
        let patch = sample_warped(old, old_px, old_from_new, half_px + 1)?;
        let zero_dn = (sum(&patch) / patch.len() as f64) as f32;
        let mut columns = [0; 3].map(|_| vec![0.0; side * side]);
        let [along_u, along_v, level] = &mut columns;
        for row in 0..side {
            let line = |down: usize, right: usize| &patch[(row + down) * wide + right..][..side];
            let out = row * side..(row + 1) * side;
            halved_difference(line(1, 0), line(1, 2), &mut along_u[out.clone()]);
            halved_difference(line(0, 1), line(2, 1), &mut along_v[out.clone()]);
            level[out].iter_mut().zip(line(1, 1)).for_each(|(value, grey)| *value = grey - zero_dn);
        }
        let [a, b, c] = &columns;
        let count = (side * side) as f64;
        let (ab, ac, bc) = (dot(a, b), dot(a, c), dot(b, c));
        let (sa, sb, sc) = (sum(a), sum(b), sum(c));
        let normal = Matrix4::new(
            dot(a, a),
            ab,
            ac,
            sa, //
            ab,
            dot(b, b),
            bc,
            sb, //
            ac,
            bc,
            dot(c, c),
            sc, //
            sa,
            sb,
            sc,
            count,
        );
        let variance_dn2 = normal[(2, 2)] / count - (sc / count).powi(2);
        let inverse = normal.cholesky().filter(|_| variance_dn2 > LEAST_VARIANCE_DN2)?.inverse();
        Some(Template { side, columns, zero_dn, mean_dn: sc / count, inverse, variance_dn2 })
    }

    /// Least squares of the new patch's grey levels: gain · (old patch shifted by the step) + offset.
    fn fit(&self, here: &[f32]) -> Option<Fit> {
        let [a, b, c] = &self.columns;
        let count = here.len() as f64;
        let right = Vector4::new(dot(a, here), dot(b, here), dot(c, here), sum(here));
        let squares = dot(here, here);
        let solution = self.inverse * right;
        let gain = solution[2];
        let variance_dn2 = squares / count - (right[3] / count).powi(2);
        let covariance_dn2 = right[2] / count - right[3] / count * self.mean_dn;
        let correlation = covariance_dn2 / (variance_dn2 * self.variance_dn2).sqrt().max(1e-9);
        let misfit_dn2 = ((squares - solution.dot(&right)) / count).max(LEAST_VARIANCE_DN2);
        let step_px = solution.xy() / gain;
        let inverse: Matrix2<f64> = self.inverse.fixed_view::<2, 2>(0, 0).into_owned();
        let covariance_px2 =
            inverse * (SHARED * misfit_dn2 / gain.powi(2)) + Matrix2::identity() * FLOOR_SIGMA_PX.powi(2);
        (gain > 0.0 && step_px.norm().is_finite()).then_some(Fit { step_px, covariance_px2, correlation })
    }
}

pub(super) fn halved_difference(from: &[f32], to: &[f32], out: &mut [f32]) {
    out.iter_mut().zip(from).zip(to).for_each(|((value, from), to)| *value = 0.5 * (from - to));
}

/// Dot product in eight strands, which the compiler makes vectors of; always in the same order.
pub(super) fn dot(a: &[f32], b: &[f32]) -> f64 {
    let mut strands = [0.0f32; 8];
    let (a, b) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f32 = a.remainder().iter().zip(b.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a.zip(b) {
        for k in 0..8 {
            strands[k] += x[k] * y[k];
        }
    }
    strands.iter().map(|s| f64::from(*s)).sum::<f64>() + f64::from(rest)
}

pub(super) fn sum(a: &[f32]) -> f64 {
    let mut strands = [0.0f32; 8];
    let chunks = a.chunks_exact(8);
    let rest: f32 = chunks.remainder().iter().sum();
    for x in chunks {
        for k in 0..8 {
            strands[k] += x[k];
        }
    }
    strands.iter().map(|s| f64::from(*s)).sum::<f64>() + f64::from(rest)
}

/// Grey levels, counted from `zero_dn`, of a square of `2 half + 1` a side about a place, row by row, bilinear; `None` at
/// the edge.
pub(super) fn sample_square(
    picture: &GrayImage,
    center_px: &Vector2<f64>,
    (half, zero_dn): (usize, f32),
    out: &mut [f32],
) -> Option<()> {
    let (left, top) = (center_px.x.floor() - half as f64, center_px.y.floor() - half as f64);
    let side = 2 * half + 1;
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    if left < 0.0 || top < 0.0 || left as usize + side >= width || top as usize + side >= height {
        return None;
    }
    let (s, t) = ((center_px.x - center_px.x.floor()) as f32, (center_px.y - center_px.y.floor()) as f32);
    let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), (1.0 - s) * t, s * t];
    for (row, line) in out.chunks_exact_mut(side).enumerate() {
        let at = (top as usize + row) * width + left as usize;
        let (upper, lower) = (&picture.as_raw()[at..=at + side], &picture.as_raw()[at + width..=at + width + side]);
        for (i, value) in line.iter_mut().enumerate() {
            *value = weights[0] * f32::from(upper[i])
                + weights[1] * f32::from(upper[i + 1])
                + weights[2] * f32::from(lower[i])
                + weights[3] * f32::from(lower[i + 1])
                - zero_dn;
        }
    }
    Some(())
}

/// Grey levels of a warped square of `2 half + 1` a side, row by row, bilinear; `None` at the edge.
pub(super) fn sample_warped(
    picture: &GrayImage,
    center_px: &Vector2<f64>,
    linear: &Matrix2<f64>,
    half: usize,
) -> Option<Vec<f32>> {
    let reach = half as f64;
    let corners = [(-reach, -reach), (reach, -reach), (-reach, reach), (reach, reach)];
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let inside = |(u, v): &(f64, f64)| {
        let p = center_px + linear * Vector2::new(*u, *v);
        p.x >= 0.0 && p.y >= 0.0 && p.x + 1.0 < width as f64 && p.y + 1.0 < height as f64
    };
    if !corners.iter().all(inside) {
        return None;
    }
    let grey = picture.as_raw();
    let side = 2 * half + 1;
    let step = linear.column(0).map(fixed);
    let mut out = vec![0.0; side * side];
    for (row, line) in out.chunks_exact_mut(side).enumerate() {
        let mut at = (center_px + linear * Vector2::new(-reach, row as f64 - reach)).map(fixed);
        for value in line {
            let [u, v] = [at.x, at.y].map(|c| (c >> FRACTION_BITS).max(0) as usize);
            let [s, t] = [at.x, at.y].map(|c| (c & FRACTION) as f32 * (1.0 / (FRACTION + 1) as f32));
            let first = v.min(height - 2) * width + u.min(width - 2);
            let (upper, lower) = (&grey[first..first + 2], &grey[first + width..first + width + 2]);
            let between = |pair: &[u8]| f32::from(pair[0]) + s * (f32::from(pair[1]) - f32::from(pair[0]));
            let (upper, lower) = (between(upper), between(lower));
            *value = upper + t * (lower - upper);
            at += step;
        }
    }
    Some(out)
}

/// Bits behind the point of fixed-point pixels.
const FRACTION_BITS: u32 = 20;
const FRACTION: i64 = (1 << FRACTION_BITS) - 1;

/// A pixel as a fixed-point number: cheaper to step along than a floating-point one, and exact to a millionth.
fn fixed(pixel_px: f64) -> i64 {
    (pixel_px * (FRACTION + 1) as f64).round() as i64
}
