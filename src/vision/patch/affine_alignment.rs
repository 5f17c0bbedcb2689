//! How a patch is stretched from one image to the next, by its own grey levels.
//!
//! The matches about a point give the stretch of the ground at large. On a body, whose surface turns away within a few
//! matches, a patch warped by that is a little askew, and an askew patch settles a little beside its point: by hundredths
//! of a pixel, but alike wherever the surface curves alike, which no number of matches averages out. So the affine map is
//! refined with the patch itself (Shi and Tomasi 1994), held near what the matches say.

use super::alignment::{AlignedPatch, LEAST_VARIANCE_DN2, covariance_px2, refine_by_patch};
use super::config::KltConfig;
use super::local_affine::Affine;
use super::sampling::{dot, halved_difference, sample_square, sample_warped, sum};
use image::GrayImage;
use nalgebra::{Matrix2, SMatrix, SVector, Vector2};

/// Shift (2), stretch (4), gain and offset of the grey levels, and a ramp (2): light changes over a patch that turns.
const COLUMNS: usize = 10;
/// Where the stretch begins among them.
const STRETCH: usize = 2;
/// Where the gain is among them.
const GAIN: usize = 6;
/// 1σ of the stretch that the matches about a point give: a prior that keeps the stretch determined, no noise.
const STRETCH_SIGMA: f64 = 0.05;
/// A stretch further off is no better one.
const MOST: f64 = 0.1;
/// Greatest shift of an aligned patch, px.
const MOST_SHIFT_PX: f64 = 0.3;
/// Times that the stretch is refined.
const ROUNDS: usize = 2;

/// Aligns a patch as [`refine_by_patch`] does, then with its own stretch and a ramp of light as unknowns too; returns the
/// stretch as well. As the matches stretch it, where its own stretch makes the patch no more alike.
pub fn refine_with_stretch(
    images: (&GrayImage, &GrayImage),
    old_px: &Vector2<f64>,
    affine: &Affine,
    config: &KltConfig,
) -> Option<(AlignedPatch, Matrix2<f64>)> {
    let mut refined = refine_by_patch(images, old_px, affine, config)?;
    let mut linear = affine.linear;
    for _ in 0..ROUNDS {
        let places = (old_px, &refined.pixel_px);
        let Some(better) = better_fit(images, places, &linear, config) else { break };
        let start = Affine::about(old_px, &refined.pixel_px, better.linear);
        match refine_by_patch(images, old_px, &start, config) {
            Some(again) if again.correlation >= refined.correlation => (refined, linear) = (again, better.linear),
            _ => break,
        }
    }
    if let Some(better) = better_fit(images, (old_px, &refined.pixel_px), &linear, config) {
        refined.pixel_px += better.shift_px;
        refined.covariance_px2 = better.covariance_px2;
    }
    Some((refined, linear))
}

/// What makes two patches more alike.
struct Better {
    linear: Matrix2<f64>,
    shift_px: Vector2<f64>,
    covariance_px2: Matrix2<f64>,
}

/// The shift and the stretch (new by old) that make the patches about both places most alike; `None` at an edge, on
/// featureless ground, or where the stretch is far from `linear` or the shift is no small one.
fn better_fit(
    (old, new): (&GrayImage, &GrayImage),
    (old_px, new_px): (&Vector2<f64>, &Vector2<f64>),
    linear: &Matrix2<f64>,
    config: &KltConfig,
) -> Option<Better> {
    let (half_px, noise) = (config.half_px as usize, &config.noise);
    let (columns, zero_dn) = columns(old, old_px, &linear.try_inverse()?, half_px)?;
    let mut here = vec![0.0; columns[0].len()];
    sample_square(new, new_px, (half_px, zero_dn), &mut here)?;
    let mut normal = SMatrix::<f64, COLUMNS, COLUMNS>::zeros();
    for i in 0..COLUMNS {
        for j in 0..=i {
            normal[(i, j)] = dot(&columns[i], &columns[j]);
            normal[(j, i)] = normal[(i, j)];
        }
    }
    let right = SVector::<f64, COLUMNS>::from_fn(|i, _| dot(&columns[i], &here));
    let free = normal.cholesky()?.solve(&right);
    let misfit_dn2 = ((dot(&here, &here) - free.dot(&right)) / here.len() as f64).max(LEAST_VARIANCE_DN2);
    let variance_dn2 = noise.shared_pixels * misfit_dn2;
    for k in STRETCH..GAIN {
        normal[(k, k)] += variance_dn2 / STRETCH_SIGMA.powi(2);
    }
    let inverse = normal.cholesky()?.inverse();
    let found = inverse * right;
    let gain = found[GAIN];
    let shift_px = found.xy() / gain;
    let change = Matrix2::new(found[2], found[3], found[4], found[5]) / gain;
    let near = gain > 0.0 && change.amax() < MOST && shift_px.norm() < MOST_SHIFT_PX;
    near.then(|| Better {
        linear: (Matrix2::identity() + change) * linear,
        shift_px,
        covariance_px2: covariance_px2(
            &inverse.fixed_view::<2, 2>(0, 0).into_owned(),
            misfit_dn2 / gain.powi(2),
            noise,
        ),
    })
}

/// The columns of the linear model at the old patch, warped, and the level from which they count. A stretch moves what is
/// at `w` by `M w`.
fn columns(
    old: &GrayImage,
    old_px: &Vector2<f64>,
    old_from_new: &Matrix2<f64>,
    half_px: usize,
) -> Option<([Vec<f32>; COLUMNS], f32)> {
    let (side, wide) = (2 * half_px + 1, 2 * half_px + 3);
    let patch = sample_warped(old, old_px, old_from_new, half_px + 1)?;
    let zero_dn = (sum(&patch) / patch.len() as f64) as f32;
    let mut columns: [Vec<f32>; COLUMNS] = std::array::from_fn(|_| vec![0.0; side * side]);
    for row in 0..side {
        let line = |down: usize, right: usize| &patch[(row + down) * wide + right..][..side];
        let at = row * side;
        halved_difference(line(1, 0), line(1, 2), &mut columns[0][at..at + side]);
        halved_difference(line(0, 1), line(2, 1), &mut columns[1][at..at + side]);
        let v = row as f32 - half_px as f32;
        for (i, grey) in line(1, 1).iter().enumerate() {
            let u = i as f32 - half_px as f32;
            let (along_u, along_v) = (columns[0][at + i], columns[1][at + i]);
            let rest = [along_u * u, along_u * v, along_v * u, along_v * v, grey - zero_dn, 1.0, u, v];
            columns[STRETCH..].iter_mut().zip(rest).for_each(|(column, value)| column[at + i] = value);
        }
    }
    Some((columns, zero_dn))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HALF_PX: usize = 10;

    /// A smooth texture of many waves.
    fn grey(p: Vector2<f64>) -> f64 {
        let wave = |k: f64| (p.dot(&Vector2::new((2.3 * k).cos(), (2.3 * k).sin())) * (0.25 + 0.05 * k) + k).sin();
        (1..9).map(|k| wave(f64::from(k))).sum::<f64>() * 12.0 + 128.0
    }

    fn image(at: impl Fn(Vector2<f64>) -> f64) -> GrayImage {
        GrayImage::from_fn(96, 96, |u, v| image::Luma([at(Vector2::new(f64::from(u), f64::from(v))).round() as u8]))
    }

    /// Old and new image of a surface that is stretched by `true_linear` about its middle, with a ramp of light.
    fn images(true_linear: &Matrix2<f64>) -> (GrayImage, GrayImage) {
        let middle = Vector2::new(48.0, 48.0);
        let old_from_new = true_linear.try_inverse().expect("regular");
        (image(grey), image(|p| grey(middle + old_from_new * (p - middle)) + 0.2 * (p.x - 48.0)))
    }

    #[test]
    fn the_stretch_is_found_from_a_wrong_one() {
        let (true_linear, middle) = (Matrix2::new(0.97, 0.05, -0.04, 1.02), Vector2::new(48.0, 48.0));
        let (old, new) = images(&true_linear);
        let start = Affine::about(&middle, &middle, true_linear + Matrix2::new(0.03, -0.03, 0.02, -0.03));
        let config = KltConfig { half_px: HALF_PX as u32, ..KltConfig::default() };
        let (refined, linear) = refine_with_stretch((&old, &new), &middle, &start, &config).expect("alike");
        assert!((linear - true_linear).amax() < 4e-3, "{linear}");
        let given = refine_by_patch((&old, &new), &middle, &start, &config).expect("alike");
        let off = |found: &AlignedPatch| (found.pixel_px - middle).norm();
        assert!(off(&refined) < 0.01, "{}", off(&refined));
        assert!(off(&given) > 2.0 * off(&refined), "a wrong stretch displaces: {} {}", off(&given), off(&refined));
    }

    #[test]
    fn a_stretch_far_from_the_given_one_is_refused() {
        let (true_linear, middle) = (Matrix2::new(1.0, 0.0, 0.0, 1.0), Vector2::new(48.0, 48.0));
        let (old, new) = images(&true_linear);
        let far = true_linear * 1.6;
        let config = KltConfig { half_px: HALF_PX as u32, ..KltConfig::default() };
        let found = |linear: &Matrix2<f64>| better_fit((&old, &new), (&middle, &middle), linear, &config);
        assert!(found(&true_linear).is_some());
        let misled = found(&far).map(|better| better.linear);
        assert!(misled.is_none_or(|linear| (linear - true_linear).amax() > 0.1), "{misled:?}");
    }
}
