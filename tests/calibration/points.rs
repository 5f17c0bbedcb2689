//! Errors of corners and of aligned patches, point by point.

use super::components::Sample;
use super::truth::{PageImage, Sequence};
use nalgebra::{Matrix2, Vector2};
use opnav::vision::*;

/// Corners further from where a point truly is are others, px.
const SAME_PX: f64 = 1.5;
/// Points of a pair that are looked at, at most.
const MOST_POINTS: usize = 150;

/// Corners of a picture, with what a change of the looks and what noise do to each, px².
struct Corners {
    features: Vec<Feature>,
    by_change_px2: Vec<Matrix2<f64>>,
    by_noise_px2: Vec<Matrix2<f64>>,
}

impl Corners {
    fn find(picture: &PageImage, model: &NoiseModel) -> Corners {
        let open = DetectorConfig { max_sigma_px: f64::MAX, ..DetectorConfig::default() };
        let with = |change_per_px: f64, noise_factor: f64| {
            let config = DetectorConfig { noise: CornerNoise { change_per_px, noise_factor }, ..open.clone() };
            detect_features(&picture.image, None, &config).expect("OpenCV works")
        };
        let covariances = |features: Vec<Feature>| features.iter().map(|f| f.covariance_px2).collect::<Vec<_>>();
        let features = with(model.corner.change_per_px, model.corner.noise_factor);
        Corners { features, by_change_px2: covariances(with(1.0, 0.0)), by_noise_px2: covariances(with(0.0, 1.0)) }
    }

    /// Places of the corners that the front end would keep, evenly chosen.
    fn chosen(&self) -> impl Iterator<Item = usize> + '_ {
        let most_px = DetectorConfig::default().max_sigma_px;
        let kept: Vec<usize> = (0..self.features.len()).filter(|i| self.features[*i].sigma_px <= most_px).collect();
        let step = kept.len().div_ceil(MOST_POINTS).max(1);
        kept.into_iter().step_by(step)
    }
}

/// Errors of corners found again in the next picture; the parts are those of [`CornerNoise`]: change, noise.
pub fn corner_errors(sequence: &Sequence, group: usize, every: usize, model: &NoiseModel) -> Vec<Sample<2>> {
    let camera = &sequence.camera;
    let mut samples = Vec::new();
    for pair in sequence.pictures.windows(2).step_by(every) {
        let [old, new] = [&pair[0], &pair[1]].map(|p| Corners::find(p, model));
        for i in old.chosen() {
            let from_px = old.features[i].pixel_px;
            let Some(true_px) = pair[0].true_pixel(&from_px, &pair[1], camera) else { continue };
            let Some(warp) = pair[0].warp(&from_px, &pair[1], camera) else { continue };
            let distance = |f: &Feature| (f.pixel_px - true_px).norm();
            let near = (0..new.features.len()).filter(|j| distance(&new.features[*j]) < SAME_PX);
            let Some(j) = near.min_by(|a, b| distance(&new.features[*a]).total_cmp(&distance(&new.features[*b])))
            else {
                continue;
            };
            let carried = |m: &Matrix2<f64>| warp * m * warp.transpose();
            samples.push(Sample {
                group,
                error: new.features[j].pixel_px - true_px,
                fixed: Matrix2::zeros(),
                parts: [
                    carried(&old.by_change_px2[i]) + new.by_change_px2[j],
                    carried(&old.by_noise_px2[i]) + new.by_noise_px2[j],
                ],
            });
        }
    }
    samples
}

/// Patches about corners of one picture, followed into another: place, error, covariance by misfit alone, ln of the scale.
struct Followed {
    index: usize,
    error_px: Vector2<f64>,
    by_misfit_px2: Matrix2<f64>,
    ln_scale: f64,
}

fn followed(
    (from, to): (&PageImage, &PageImage),
    points_px: &[Vector2<f64>],
    camera: &opnav::geometry::Camera,
) -> Vec<Followed> {
    let noise = PatchNoise { shared_pixels: 1.0, floor_sigma_px: 0.0 };
    let klt = KltConfig { noise, ..KltConfig::default() };
    let predict = |pixel_px: &Vector2<f64>| from.true_pixel(pixel_px, to, camera);
    let found = track_patches((&from.image, &to.image), points_px, &predict, &klt).expect("OpenCV works");
    let one = |(index, (point_px, found)): (usize, (&Vector2<f64>, &Option<KltPoint>))| {
        let found = found.as_ref()?;
        let ln_scale = 0.5 * from.warp(point_px, to, camera)?.determinant().abs().ln();
        let error_px = found.pixel_px - predict(point_px)?;
        Some(Followed { index, error_px, by_misfit_px2: found.covariance_px2, ln_scale })
    };
    points_px.iter().zip(&found).enumerate().filter_map(one).collect()
}

fn corner_pixels(picture: &PageImage, model: &NoiseModel) -> Vec<Vector2<f64>> {
    let config = DetectorConfig { noise: model.corner, ..DetectorConfig::default() };
    let features = detect_features(&picture.image, None, &config).expect("OpenCV works");
    let step = features.len().div_ceil(MOST_POINTS).max(1);
    features.iter().step_by(step).map(|f| f.pixel_px).collect()
}

/// Errors of patches followed over so many pictures; the parts are the misfit, a floor, and the squared change of scale.
pub fn patch_errors(
    sequence: &Sequence,
    group: usize,
    (every, spans): (usize, &[usize]),
    model: &NoiseModel,
) -> Vec<Sample<3>> {
    let mut samples = Vec::new();
    for first in (0..sequence.pictures.len()).step_by(every) {
        let from = &sequence.pictures[first];
        let points_px = corner_pixels(from, model);
        for to in spans.iter().filter_map(|span| sequence.pictures.get(first + span)) {
            samples.extend(followed((from, to), &points_px, &sequence.camera).into_iter().map(|f| Sample {
                group,
                error: f.error_px,
                fixed: Matrix2::zeros(),
                parts: [f.by_misfit_px2, Matrix2::identity(), Matrix2::identity() * f.ln_scale.powi(2)],
            }));
        }
    }
    samples
}

/// Errors of the same points followed into a picture from the two pictures before it, over what is predicted of each:
/// pairs of (older, newer) coordinates, and the ratio of the older one's predicted variance to the newer one's.
pub fn shared_errors(sequence: &Sequence, every: usize, model: &NoiseModel) -> Vec<(f64, f64, f64)> {
    let camera = &sequence.camera;
    let variance = |f: &Followed| {
        model.patch.shared_pixels * 0.5 * f.by_misfit_px2.trace()
            + model.patch.floor_sigma_px.powi(2)
            + (model.designated.scale_sigma_px * f.ln_scale).powi(2)
    };
    let mut both = Vec::new();
    for three in sequence.pictures.windows(3).step_by(every) {
        let points_px = corner_pixels(&three[0], model);
        let pairs = points_px.iter().filter_map(|p| Some((*p, three[0].true_pixel(p, &three[1], camera)?)));
        let (first_px, second_px): (Vec<_>, Vec<_>) = pairs.unzip();
        let older = followed((&three[0], &three[2]), &first_px, camera);
        let newer = followed((&three[1], &three[2]), &second_px, camera);
        for a in &older {
            let Some(b) = newer.iter().find(|b| b.index == a.index) else { continue };
            let (va, vb) = (variance(a), variance(b));
            for k in 0..2 {
                both.push((a.error_px[k] / va.sqrt(), b.error_px[k] / vb.sqrt(), va / vb));
            }
        }
    }
    both
}
