//! Aligns a patch of grey levels, warped by a predicted motion, with another image (Lucas and Kanade 1981), in the
//! inverse compositional form of Baker and Matthews (2004) with a gain and an offset of the grey levels.

use super::config::KltConfig;
use super::local_affine::Affine;
use super::sampling::{dot, halved_difference, sample_square, sample_warped, sum};
use crate::vision::noise_model::PatchNoise;
use image::GrayImage;
use nalgebra::{Matrix2, Matrix4, Vector2, Vector4};

/// A step shorter than this ends the alignment, px.
const SETTLED_PX: f64 = 0.01;

/// Least variance of residuals: that of rounding, in squared grey levels.
pub(super) const LEAST_VARIANCE_DN2: f64 = 1.0 / 12.0;

/// Covariance of a shift by the inverse of its normal matrix (px²/DN²) and the mean squared misfit (DN²).
pub(super) fn covariance_px2(inverse: &Matrix2<f64>, misfit_dn2: f64, noise: &PatchNoise) -> Matrix2<f64> {
    inverse * (noise.shared_pixels * misfit_dn2) + Matrix2::identity() * noise.floor_sigma_px.powi(2)
}

/// A refined pixel.
pub struct AlignedPatch {
    pub pixel_px: Vector2<f64>,
    pub(super) covariance_px2: Matrix2<f64>,
    pub(super) correlation: f64,
}

impl AlignedPatch {
    /// R.m.s. 1σ of both coordinates, px.
    pub fn sigma_px(&self) -> f64 {
        (0.5 * self.covariance_px2.trace()).sqrt()
    }
}

/// Aligns the patch of the old image about `old_px`, warped by `affine`, with the new image. `None` at the edge, on
/// featureless ground, further than allowed from where `affine` leads, or where the patches do not look alike.
pub fn refine_by_patch(
    (old, new): (&GrayImage, &GrayImage),
    old_px: &Vector2<f64>,
    affine: &Affine,
    config: &KltConfig,
) -> Option<AlignedPatch> {
    let template = Template::new(old, old_px, &affine.linear.try_inverse()?, config.half_px as usize)?;
    let start_px = affine.apply(old_px);
    let mut pixel_px = start_px;
    let mut here = vec![0.0; template.side * template.side];
    for _ in 0..config.max_iterations {
        sample_square(new, &pixel_px, (template.side / 2, template.zero_dn), &mut here)?;
        let fit = template.fit(&here, &config.noise)?;
        pixel_px += fit.step_px;
        if (pixel_px - start_px).norm() > config.max_off_px || !pixel_px.x.is_finite() {
            return None;
        }
        if fit.step_px.norm() < SETTLED_PX {
            let refined = AlignedPatch { pixel_px, covariance_px2: fit.covariance_px2, correlation: fit.correlation };
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
    fn fit(&self, here: &[f32], noise: &PatchNoise) -> Option<Fit> {
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
        let covariance_px2 = covariance_px2(&inverse, misfit_dn2 / gain.powi(2), noise);
        (gain > 0.0 && step_px.norm().is_finite()).then_some(Fit { step_px, covariance_px2, correlation })
    }
}
