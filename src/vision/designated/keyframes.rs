//! Past images to which the designated point is tied, and what their places of it say together.
//!
//! Each place has drifted off the ground point of the first image, and the drifts of images share a history. With the
//! joint covariance of the drifts, the mean of what the past images say has the least variance that weights can give
//! (best linear unbiased estimate), and an honest one.

use crate::stats::symmetric;
use crate::vision::front_end::DesignatedStep;
use crate::vision::noise_model::DesignatedNoise;
use image::GrayImage;
use nalgebra::{DMatrix, DVector, Matrix2, Vector2};

/// Changes of scale to past images that are tied besides the last two: a long tie adds one error where a chain of short
/// ones adds many.
const SCALES: [f64; 4] = [1.05, 1.1, 1.2, 1.3];
/// Most images kept.
const MOST_KEPT: usize = 40;

/// A past image with its place of the point.
pub(super) struct Keyframe {
    pub(super) frame: usize,
    pub(super) image: GrayImage,
    pub(super) step: DesignatedStep,
    /// Size of a pixel on the ground, over that in the first image.
    size: f64,
    /// Share of the first pixel's covariance, px².
    first_px2: Matrix2<f64>,
    /// Variance by which the looks of the ground have moved since the first image, in squared pixels of that.
    looks: f64,
}

/// What one past image says of the point in a new one.
pub(super) struct KeyframeMeasurement {
    /// Which past image.
    pub(super) from: usize,
    pub(super) pixel_px: Vector2<f64>,
    pub(super) sigma_px: f64,
    /// Map of the ground about the point from the past image to the new one.
    pub(super) linear: Matrix2<f64>,
    pub(super) refined: bool,
}

impl KeyframeMeasurement {
    fn scale(&self) -> f64 {
        self.linear.determinant().abs().max(1e-12).sqrt()
    }

    fn variance_px2(&self, noise: &DesignatedNoise) -> f64 {
        self.sigma_px.powi(2) + (noise.scale_sigma_px * self.scale().ln()).powi(2)
    }
}

/// The images kept, oldest first, with the joint covariance of their drifts over the looks of the ground, in squared
/// pixels of the first image. That the looks move is no tie's error: it comes on top, and no weights lessen it.
pub(super) struct Keyframes {
    noise: DesignatedNoise,
    kept: Vec<Keyframe>,
    drift: DMatrix<f64>,
}

/// The point in a new image, to be kept with the image.
pub(super) struct Fused {
    pub(super) step: DesignatedStep,
    size: f64,
    first_px2: Matrix2<f64>,
    looks: f64,
    with_past: DVector<f64>,
    drift: f64,
}

impl Keyframes {
    pub(super) fn new(frame: usize, image: GrayImage, step: DesignatedStep, noise: DesignatedNoise) -> Self {
        let first_px2 = step.covariance_px2;
        Keyframes {
            noise,
            kept: vec![Keyframe { frame, image, step, size: 1.0, first_px2, looks: 0.0 }],
            drift: DMatrix::zeros(1, 1),
        }
    }

    /// The images to tie the next one to, oldest first, with their places among those kept.
    pub(super) fn chosen(&self) -> impl Iterator<Item = (usize, &Keyframe)> {
        let last = self.kept.len() - 1;
        let off = |index: usize, scale: f64| (self.kept[index].size / self.kept[last].size / scale).ln().abs();
        let nearest = |scale: &f64| (0..=last).min_by(|a, b| off(*a, *scale).total_cmp(&off(*b, *scale)));
        let mut chosen: Vec<usize> = SCALES.iter().filter_map(nearest).chain(last.saturating_sub(1)..=last).collect();
        chosen.sort_unstable();
        chosen.dedup();
        chosen.into_iter().map(|index| (index, &self.kept[index]))
    }

    /// What the ties say together; `None` without any.
    pub(super) fn fused(&self, t_ns: i64, ties: &[KeyframeMeasurement]) -> Option<Fused> {
        let newest = ties.last()?;
        let from = &self.kept[newest.from];
        let size = from.size / newest.scale();
        let n = ties.len();
        let past = DMatrix::from_fn(n, n, |i, j| self.drift[(ties[i].from, ties[j].from)]);
        let variance = |tie: &KeyframeMeasurement| tie.variance_px2(&self.noise) * size * size;
        let total = &past + DMatrix::from_diagonal(&DVector::from_iterator(n, ties.iter().map(variance)));
        let information = total.clone().cholesky()?.solve(&DVector::from_element(n, 1.0));
        let weights = &information / information.sum();
        let least = ties.iter().map(variance).fold(f64::INFINITY, f64::min);
        let last = &self.kept[self.kept.len() - 1];
        let looks = last.looks + (self.noise.looks_sigma_px * size).powi(2) * (last.size / size).ln().abs();
        let drift = (weights.transpose() * &total * &weights)[(0, 0)] + self.noise.common_share * least;
        let with_past = DVector::from_fn(self.kept.len(), |k, _| {
            ties.iter().zip(weights.iter()).map(|(tie, w)| w * self.drift[(tie.from, k)]).sum()
        });
        let first_px2 = symmetric(&(newest.linear * from.first_px2 * newest.linear.transpose()));
        let step = DesignatedStep {
            t_ns,
            pixel_px: ties.iter().zip(weights.iter()).map(|(tie, w)| tie.pixel_px * *w).sum(),
            step_sigma_px: ties.iter().zip(weights.iter()).map(|(tie, w)| tie.sigma_px * w.abs()).sum(),
            covariance_px2: first_px2 + Matrix2::identity() * ((drift + looks) / (size * size)),
            pixel_size: size,
            drift_first_px2: drift + looks,
            t_ns_from: from.step.t_ns,
            refined: ties.iter().any(|tie| tie.refined),
        };
        Some(Fused { step, size, first_px2, looks, with_past, drift })
    }

    /// Keeps an image; the oldest that no tie can reach any more makes room.
    pub(super) fn keep(&mut self, frame: usize, image: GrayImage, fused: Fused) {
        let n = self.kept.len();
        let mut drift = self.drift.clone().resize(n + 1, n + 1, 0.0);
        drift.view_mut((n, 0), (1, n)).copy_from(&fused.with_past.transpose());
        drift.view_mut((0, n), (n, 1)).copy_from(&fused.with_past);
        drift[(n, n)] = fused.drift;
        self.drift = drift;
        let Fused { step, size, first_px2, looks, .. } = fused;
        self.kept.push(Keyframe { frame, image, step, size, first_px2, looks });
        let too_far = |k: &Keyframe| (k.size / size).ln().abs() > 1.2 * SCALES[SCALES.len() - 1].ln();
        while self.kept.len() > 2 && (self.kept.len() > MOST_KEPT || too_far(&self.kept[0])) {
            self.kept.remove(0);
            self.drift = self.drift.clone().remove_row(0).remove_column(0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::random_stream;
    use rand_distr::{Distribution, StandardNormal};

    /// A camera that comes 2 % nearer from image to image to a point whose true pixel stays at 0. Returns the error of
    /// the last pixel and its predicted variance, both of one coordinate and in px.
    fn flight(run: u64, noise: f64) -> (f64, f64) {
        const STEP: f64 = 1.02;
        let model = DesignatedNoise::default();
        let mut random = random_stream(run, "designated-keyframes", 0);
        let mut normal = move || -> f64 { StandardNormal.sample(&mut random) };
        let start = DesignatedStep {
            t_ns: 0,
            pixel_px: Vector2::zeros(),
            step_sigma_px: 0.0,
            covariance_px2: Matrix2::zeros(),
            pixel_size: 1.0,
            drift_first_px2: 0.0,
            t_ns_from: 0,
            refined: true,
        };
        let mut keyframes = Keyframes::new(0, GrayImage::default(), start, model);
        // By how much the looks have moved over the ground at each image, in pixels of the first.
        let mut looks = vec![0.0];
        let size = |frame: usize| STEP.powi(-(frame as i32));
        for frame in 1..=80 {
            looks.push(looks[frame - 1] + noise * model.looks_sigma_px * size(frame) * STEP.ln().sqrt() * normal());
            let shared = normal();
            let chosen: Vec<(usize, usize, f64)> =
                keyframes.chosen().map(|(from, k)| (from, k.frame, k.step.pixel_px.x)).collect();
            let mut tie = |(from, past, x): &(usize, usize, f64)| {
                let scale = size(*past) / size(frame);
                let mut tie = KeyframeMeasurement {
                    from: *from,
                    pixel_px: Vector2::zeros(),
                    sigma_px: 0.025,
                    linear: Matrix2::identity() * scale,
                    refined: true,
                };
                // What all ties share is as large as the share of the least variance.
                let least = 0.025f64.powi(2) + (model.scale_sigma_px * STEP.ln()).powi(2);
                let (own, common) = (tie.variance_px2(&model), model.common_share * least);
                let error = own.sqrt() * normal() + common.sqrt() * shared;
                tie.pixel_px.x = scale * x + (looks[frame] - looks[*past]) / size(frame) + noise * error;
                tie
            };
            let ties: Vec<KeyframeMeasurement> = chosen.iter().map(&mut tie).collect();
            let fused = keyframes.fused(frame as i64, &ties).expect("ties");
            keyframes.keep(frame, GrayImage::default(), fused);
        }
        let last = &keyframes.kept[keyframes.kept.len() - 1].step;
        (last.pixel_px.x, last.covariance_px2[(0, 0)])
    }

    fn mean_square_over_prediction(noise: f64) -> f64 {
        const RUNS: u64 = 400;
        (0..RUNS).map(|run| flight(run, noise)).map(|(error, variance)| error * error / variance).sum::<f64>()
            / RUNS as f64
    }

    #[test]
    fn the_predicted_covariance_is_that_of_many_flights() {
        // Each mean of 400 squared normal errors lies within ±0.23 of 1 with a probability of 99.9 %.
        let ratio = mean_square_over_prediction(1.0);
        assert!((0.77..1.23).contains(&ratio), "{ratio}");
        let ratio = mean_square_over_prediction(1.3);
        assert!(ratio > 1.23, "errors 1.3 times as large pass unnoticed: {ratio}");
    }

    #[test]
    fn without_noise_the_point_stays() {
        assert!(flight(1, 0.0).0.abs() < 1e-12);
    }
}
