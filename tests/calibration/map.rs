//! Errors of a map's points in pictures: each point's own, and what all points of a picture have in common.

use super::components::{Sample, median, robust_sigma};
use super::truth::Sequence;
use nalgebra::{Isometry3, Matrix2, Matrix2x3, Matrix3, Vector2, Vector3};
use opnav::dataset::read_ground_map;
use opnav::geometry::so3;
use opnav::observations::PredictedCamera;
use opnav::stats::random_stream;
use opnav::vision::*;
use rand::RngExt;
use rayon::prelude::*;
use std::path::Path;

/// 1σ of a point's own errors that is assumed while points are chosen, px: wide, so that none is dropped for it.
const WIDE_PX: f64 = 0.5;
/// Pictures of a sequence, at most: the lowest ones of a whole descent see little that the map knows.
const MOST_IMAGES: usize = 36;
/// Fewest points of a picture.
const FEWEST: usize = 12;

/// What a picture's points have in common: a shift (u, v) in px of the halved picture, and how far they stand out in
/// footprints, with the variances that the points' own errors leave; and the height above the site, m.
#[derive(Debug, Clone, Copy)]
pub struct Common {
    pub group: usize,
    pub value: Vector3<f64>,
    pub variance: Vector3<f64>,
    pub height_m: f64,
}

/// Errors of a sequence's pictures against its map. The points' own come with the patches' covariance as the fixed part.
pub fn map_errors(sequence: &Sequence, map: &Path, group: usize, model: &NoiseModel) -> (Vec<Sample<1>>, Vec<Common>) {
    let noise = MapNoise {
        looks_sigma_px: WIDE_PX,
        common_sigma_px: 0.0,
        standing_out: 0.0,
        standing_out_sigma: 0.0,
        shared_ln_scale: 0.0,
    };
    let config = MapMatchConfig { noise, patch_noise: model.patch, most_sightings: 60, ..MapMatchConfig::default() };
    let matcher = MapMatcher::new(&read_ground_map(map).expect("a map"), &MapFeatures::default(), &config)
        .expect("usable settings");
    let of = |index: usize| of_image(sequence, (index, group), &matcher);
    let all: Vec<_> = (0..sequence.pictures.len().min(MOST_IMAGES)).into_par_iter().filter_map(of).collect();
    let commons = all.iter().map(|(_, common)| *common).collect();
    (all.into_iter().flat_map(|(samples, _)| samples).collect(), commons)
}

fn of_image(
    sequence: &Sequence,
    (index, group): (usize, usize),
    matcher: &MapMatcher,
) -> Option<(Vec<Sample<1>>, Common)> {
    let (picture, camera) = (&sequence.pictures[index], &sequence.camera);
    let height_m = picture.reference_from_camera.translation.z;
    let mut random = random_stream(super::SEED, "map prediction", (group * 1000 + index) as u64);
    let mut draw = |half: f64| Vector3::from_fn(|_, _| random.random_range(-half..half));
    let off = Isometry3::from_parts(draw(5e-4 * height_m).into(), so3::exp(&draw(5e-4)));
    let predicted = PredictedCamera {
        camera_from_site: off * picture.reference_from_camera.inverse(),
        sigma_position_m: 1e-3 * height_m,
        sigma_attitude_rad: 1e-3,
    };
    let fix = matcher.sightings(&picture.image, camera, &predicted).expect("OpenCV works");
    if fix.sightings.len() < FEWEST {
        return None;
    }
    let one = |s: &MapSighting| point(s, &picture.reference_from_camera, (camera, fix.scale));
    let points: Vec<Point> = fix.sightings.iter().filter_map(one).collect();
    let (value, inverse) = common(&points)?;
    let left: Vec<Vector2<f64>> = points.iter().map(|p| p.error_px - p.by_common * value).collect();
    // Three unknowns a picture are taken off: the rest is a little too small.
    let count = (2 * points.len()) as f64;
    let larger = (count / (count - 3.0)).sqrt();
    let samples = points.iter().zip(&left).map(|(p, left)| Sample {
        group,
        error: left * larger,
        fixed: p.by_patch_px2,
        parts: [Matrix2::identity()],
    });
    let sigma_px = larger * robust_sigma(&left.iter().flat_map(|l| [l.x, l.y]).collect::<Vec<_>>());
    let variance = inverse.diagonal() * sigma_px.powi(2);
    Some((samples.collect(), Common { group, value, variance, height_m }))
}

/// A point in px of the halved picture.
struct Point {
    error_px: Vector2<f64>,
    by_patch_px2: Matrix2<f64>,
    /// Derivative by what is common: shift, and standing out by a footprint.
    by_common: Matrix2x3<f64>,
}

fn point(
    sighting: &MapSighting,
    site_from_camera: &Isometry3<f64>,
    (camera, scale): (&opnav::geometry::Camera, f64),
) -> Option<Point> {
    let place_m = sighting.point_in_site_m;
    let in_camera = |p: Vector3<f64>| site_from_camera.inverse_transform_point(&p.into()).coords;
    let footprint_m = in_camera(place_m).norm() / camera.mean_focal_px() * scale;
    let [on, above] = [0.0, footprint_m].map(|h| camera.project(&in_camera(place_m + Vector3::z() * h)));
    let on = on?;
    let rises_px = (above? - on) / scale;
    let by_patch_px2 = sighting.covariance_px2 / scale.powi(2) - Matrix2::identity() * WIDE_PX.powi(2);
    Some(Point {
        error_px: (sighting.pixel_px - on) / scale,
        by_patch_px2: Matrix2::identity() * (0.5 * by_patch_px2.trace()).max(1e-6),
        by_common: Matrix2x3::new(1.0, 0.0, rises_px.x, 0.0, 1.0, rises_px.y),
    })
}

/// What the points have in common by robust least squares, and the inverse of the normal matrix.
fn common(points: &[Point]) -> Option<(Vector3<f64>, Matrix3<f64>)> {
    let (mut value, mut inverse, mut scale_px) = (Vector3::zeros(), Matrix3::zeros(), f64::INFINITY);
    for _ in 0..8 {
        // The prior keeps what a picture looked at straight down does not tell.
        let mut normal = Matrix3::from_diagonal(&Vector3::new(1e-6, 1e-6, 1e-2));
        let mut right = Vector3::zeros();
        for p in points {
            let left = (p.error_px - p.by_common * value).norm() / (2.0 * scale_px);
            let weight = 1.0 / (1.0 + left * left).powi(2);
            normal += p.by_common.transpose() * p.by_common * weight;
            right += p.by_common.transpose() * p.error_px * weight;
        }
        inverse = normal.try_inverse()?;
        value = inverse * right;
        let sizes: Vec<f64> = points.iter().map(|p| (p.error_px - p.by_common * value).norm()).collect();
        scale_px = (median(&sizes) / 1.1774).max(1e-3);
    }
    Some((value, inverse))
}

/// `[common_sigma_px, standing_out, standing_out_sigma, shared_ln_scale]`.
pub fn constants(all: &[&Common]) -> [f64; 4] {
    let component = |k: usize| all.iter().map(|c| c.value[k]).collect::<Vec<f64>>();
    let left = |k: usize| median(&all.iter().map(|c| c.variance[k]).collect::<Vec<f64>>());
    // What pictures scatter beyond what their points' own errors make of it.
    let sigma = |k: usize, scatter: f64| (scatter.powi(2) - left(k)).max(1e-4 * scatter.powi(2)).sqrt();
    let about_zero = |k: usize| 1.4826 * median(&component(k).iter().map(|v| v.abs()).collect::<Vec<f64>>());
    let common_px = (0..2).map(|k| sigma(k, about_zero(k)).powi(2) / 2.0).sum::<f64>().sqrt();
    let standing_out = median(&component(2));
    let standing_out_sigma = sigma(2, robust_sigma(&component(2)));
    [common_px, standing_out, standing_out_sigma, shared_ln_scale(all)]
}

/// Twice the change of scale, as a logarithm, over which what is common is forgotten e-fold: the correlation of pictures of
/// one scene against their change of scale is fitted by `r exp(-Δ/ℓ)`, by signs, which tails cannot spoil. `N` pictures `Δ`
/// apart count as about `N Δ/(2ℓr)` independent ones.
fn shared_ln_scale(all: &[&Common]) -> f64 {
    const BINS: [f64; 9] = [0.0, 0.02, 0.05, 0.08, 0.13, 0.2, 0.3, 0.5, 0.8];
    let mut sums = [[0.0; 3]; BINS.len() - 1];
    let middle = Vector3::from_fn(|k, _| median(&all.iter().map(|c| c.value[k]).collect::<Vec<f64>>()));
    for (i, a) in all.iter().enumerate() {
        for b in all[i + 1..].iter().filter(|b| b.group == a.group) {
            let delta = (a.height_m / b.height_m).ln().abs();
            let Some(bin) = (0..sums.len()).find(|k| (BINS[*k]..BINS[*k + 1]).contains(&delta)) else { continue };
            for k in 0..3 {
                sums[bin][0] += ((a.value[k] - middle[k]) * (b.value[k] - middle[k])).signum();
                sums[bin][1] += 1.0;
                sums[bin][2] += delta;
            }
        }
    }
    // Of normal numbers with the correlation ρ, the product is positive so often that its mean sign is 2/π asin ρ.
    let point = |s: &[f64; 3]| (s[2] / s[1], (std::f64::consts::FRAC_PI_2 * s[0] / s[1]).sin(), s[1]);
    let points: Vec<(f64, f64, f64)> = sums.iter().filter(|s| s[1] > 20.0).map(point).collect();
    let fit = |length: f64| {
        let model = |delta: f64| (-delta / length).exp();
        let up: f64 = points.iter().map(|(d, r, w)| w * r * model(*d)).sum();
        let down: f64 = points.iter().map(|(d, _, w)| w * model(*d).powi(2)).sum();
        let height = (up / down.max(1e-12)).clamp(0.0, 1.0);
        (points.iter().map(|(d, r, w)| w * (r - height * model(*d)).powi(2)).sum::<f64>(), 2.0 * length * height)
    };
    let fits = (0..=60).map(|k| fit(0.01 * 100f64.powf(f64::from(k) / 60.0)));
    fits.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(f64::NAN, |(_, shared)| shared)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_distr::{Distribution, StandardNormal};

    /// Pictures of scenes whose common errors are forgotten e-fold over a change of scale of `length`.
    fn pictures(length: f64) -> Vec<Common> {
        const STEP: f64 = 0.03;
        let mut random = random_stream(11, "common errors", 0);
        let mut all = Vec::new();
        for group in 0..30 {
            let mut normal = || Vector3::from_fn(|_, _| -> f64 { StandardNormal.sample(&mut random) });
            let mut state = normal();
            for k in 0..30 {
                let (kept, own) = ((-STEP / length).exp(), normal());
                state = state * kept + own * (1.0 - kept * kept).sqrt();
                let measured = state.component_mul(&Vector3::new(0.06, 0.06, 0.2)) + normal() * 0.01;
                all.push(Common {
                    group,
                    value: measured + Vector3::z() * 0.15,
                    variance: Vector3::repeat(1e-4),
                    height_m: 1000.0 * (-STEP * f64::from(k)).exp(),
                });
            }
        }
        all
    }

    #[test]
    fn what_is_common_is_recovered_with_how_long_it_lasts() {
        let all = pictures(0.1);
        let [common_px, standing_out, sigma, shared] = constants(&all.iter().collect::<Vec<_>>());
        assert!((common_px / 0.06 - 1.0).abs() < 0.15, "{common_px}");
        assert!((standing_out - 0.15).abs() < 0.05 && (sigma / 0.2 - 1.0).abs() < 0.2, "{standing_out} {sigma}");
        assert!((shared / 0.2).ln().abs() < 0.35, "{shared}");
        let quick = pictures(0.01);
        assert!(constants(&quick.iter().collect::<Vec<_>>())[3] < 0.06, "errors that do not last");
    }
}
