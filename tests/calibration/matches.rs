//! Pairs of pictures by the tracks that they share, with the truth; and the smooth part of their errors.

use super::components::{median, robust_sigma};
use super::truth::{PageImage, Sequence};
use nalgebra::{DMatrix, DVector, UnitQuaternion, Vector2};
use opnav::vision::*;
use std::collections::BTreeMap;
use std::f64::consts::SQRT_2;
use std::ops::Range;

/// Polynomials of the smooth error, as `vision/pair/covariance` has them.
const MODES: usize = 10;
const LOW_MODES: usize = 6;
/// Coefficients of both coordinates.
pub const COEFFICIENTS: usize = 2 * MODES;
/// Fewest points of a pair.
const FEWEST: usize = 60;

/// A pair with its true rotation.
pub struct TruePair {
    /// Scene that it is of.
    pub group: usize,
    pub matches: MatchedPair,
    pub sigma_px: Vec<f64>,
    /// True places in the second picture of the points of the first; `None` where they are hidden.
    true_to_px: Vec<Option<Vector2<f64>>>,
    pub true_rotation: UnitQuaternion<f64>,
    pub dt_s: f64,
    /// Squared translation over the distance from the ground.
    pub view: f64,
}

/// How a sequence is paired: mode, spans, every n-th picture as the first one, of a range of pictures.
#[derive(Debug, Clone)]
pub struct Pairing<'a> {
    pub mode: FrontEndMode,
    pub spans: &'a [usize],
    pub every: usize,
    pub frames: Range<usize>,
}

/// Tracks a sequence with the corners and patches of a noise model and pairs its pictures.
pub fn true_pairs(sequence: &Sequence, group: usize, pairing: &Pairing, model: &NoiseModel) -> Vec<TruePair> {
    let Pairing { mode, spans, every, frames } = pairing.clone();
    let config = FrontEndConfig { mode, keyframe_spans: vec![], ..FrontEndConfig::default() }.with_noise_model(model);
    let prior = |from_ns: i64, to_ns: i64| {
        let [from, to] = [from_ns, to_ns].map(|t| sequence.at(t).map(|p| p.reference_from_camera.rotation));
        Some(to?.inverse() * from?)
    };
    let inputs = TrackInputs { frames: frames.clone(), rotation_prior: Some(&prior), ..TrackInputs::default() };
    let found = track_sequence(&sequence.images, &config, &inputs, &|_| ()).expect("the pictures are tracked");
    let mut tracks: BTreeMap<i64, BTreeMap<u64, (Vector2<f64>, f64)>> = BTreeMap::new();
    for o in &found.observations {
        tracks.entry(o.t_ns).or_default().insert(o.track_id, (o.pixel_px, o.sigma_px));
    }
    let starts = (frames.start..frames.end.min(sequence.pictures.len())).step_by(every);
    let both = starts.flat_map(|k| spans.iter().map(move |s| (k, k + s)));
    both.filter_map(|(i, j)| {
        let (from, to) = (&sequence.pictures[i], sequence.pictures.get(j)?);
        TruePair::new((from, to), (tracks.get(&from.t_ns)?, tracks.get(&to.t_ns)?), sequence, group)
    })
    .collect()
}

type Points = BTreeMap<u64, (Vector2<f64>, f64)>;

impl TruePair {
    fn new(
        (from, to): (&PageImage, &PageImage),
        (before, after): (&Points, &Points),
        sequence: &Sequence,
        group: usize,
    ) -> Option<TruePair> {
        /// The front end's own 1σ of the first sight of a track, px.
        const LEAST_SIGMA_PX: f64 = 0.05;
        let camera = &sequence.camera;
        let (mut matches, mut sigma_px, mut true_to_px) = (MatchedPair::default(), vec![], vec![]);
        let mut distances_m = vec![];
        for (track, (from_px, before_px)) in before {
            let Some((to_px, after_px)) = after.get(track) else { continue };
            matches.from_px.push(*from_px);
            matches.to_px.push(*to_px);
            sigma_px.push((after_px.powi(2) - before_px.powi(2)).max(LEAST_SIGMA_PX.powi(2)).sqrt() / SQRT_2);
            true_to_px.push(from.true_pixel(from_px, to, camera));
            let place = from.reference_from_camera.translation.vector;
            distances_m.extend(from.point(from_px, camera).map(|p| (place - p.coords).z.abs()));
        }
        let moved_m =
            (to.reference_from_camera.translation.vector - from.reference_from_camera.translation.vector).norm();
        (true_to_px.iter().flatten().count() >= FEWEST).then(|| TruePair {
            group,
            view: (moved_m / median(&distances_m)).powi(2),
            matches,
            sigma_px,
            true_to_px,
            true_rotation: to.reference_from_camera.rotation.inverse() * from.reference_from_camera.rotation,
            dt_s: (to.t_ns - from.t_ns) as f64 * 1e-9,
        })
    }

    pub fn pixels(&self) -> PixelMatches<'_> {
        PixelMatches { pair: &self.matches, sigma_px: &self.sigma_px }
    }

    /// The smooth part of the pair's true errors; `None` where too few points are left.
    pub fn smooth_error(&self) -> Option<SmoothError> {
        let off = |(i, truth): (usize, &Option<Vector2<f64>>)| {
            truth.map(|t| (self.matches.from_px[i], (self.matches.to_px[i] - t) / (SQRT_2 * self.sigma_px[i])))
        };
        let all: Vec<(Vector2<f64>, Vector2<f64>)> = self.true_to_px.iter().enumerate().filter_map(off).collect();
        smooth_error(&all)
    }
}

/// The mean square of the coefficients of a smooth error over its expected pattern, in units of the noise, and what white
/// noise alone would make of it.
#[derive(Debug, Clone, Copy)]
pub struct SmoothError {
    pub mean_square: f64,
    pub of_white_noise: f64,
}

/// Least squares of the polynomials to the errors (place, error over its 1σ) of a pair, gross errors left out.
pub fn smooth_error(all: &[(Vector2<f64>, Vector2<f64>)]) -> Option<SmoothError> {
    let mut inside: Vec<(Vector2<f64>, Vector2<f64>)> = all.to_vec();
    let mut coefficients = [DVector::zeros(MODES), DVector::zeros(MODES)];
    let mut inverse = DMatrix::zeros(MODES, MODES);
    let mut scale = f64::NAN;
    for _ in 0..3 {
        if inside.len() < FEWEST {
            return None;
        }
        let count = inside.len() as f64;
        let center = inside.iter().map(|p| p.0).sum::<Vector2<f64>>() / count;
        let spread = (inside.iter().map(|p| (p.0 - center).norm_squared()).sum::<f64>() / (2.0 * count)).sqrt();
        let modes = |place: &Vector2<f64>| DVector::from_row_slice(&modes(&((place - center) / spread)));
        let rows = DMatrix::from_fn(inside.len(), MODES, |i, j| modes(&inside[i].0)[j]);
        inverse = (rows.transpose() * &rows).try_inverse()?;
        let right = |k: usize| rows.transpose() * DVector::from_iterator(inside.len(), inside.iter().map(|p| p.1[k]));
        coefficients = [&inverse * right(0), &inverse * right(1)];
        let left = |p: &(Vector2<f64>, Vector2<f64>)| {
            let m = modes(&p.0);
            Vector2::new(p.1.x - m.dot(&coefficients[0]), p.1.y - m.dot(&coefficients[1]))
        };
        scale = robust_sigma(&inside.iter().flat_map(|p| [left(p).x, left(p).y]).collect::<Vec<_>>());
        inside = all.iter().filter(|p| left(p).amax() < 4.0 * scale).copied().collect();
    }
    let weight = |mode: usize| if mode < LOW_MODES { 1.0 } else { 2.0 };
    let over = |value: &dyn Fn(usize, usize) -> f64| {
        (0..2).flat_map(|k| (0..MODES).map(move |m| (k, m))).map(|(k, m)| weight(m) * value(k, m)).sum::<f64>()
            / COEFFICIENTS as f64
    };
    Some(SmoothError {
        mean_square: over(&|k, m| coefficients[k][m].powi(2)) / scale.powi(2),
        of_white_noise: over(&|_, m| inverse[(m, m)]),
    })
}

/// The polynomials at a place, each of a mean square near 1 over an even picture.
fn modes(p: &Vector2<f64>) -> [f64; MODES] {
    const H: f64 = std::f64::consts::FRAC_1_SQRT_2;
    let (x2, y2) = (p.x * p.x, p.y * p.y);
    [
        1.0,
        p.x,
        p.y,
        p.x * p.y,
        H * (x2 - 1.0),
        H * (y2 - 1.0),
        0.5 * p.x * (x2 - 1.8),
        0.5 * p.y * (y2 - 1.8),
        0.5 * p.x * (y2 - 1.0),
        0.5 * p.y * (x2 - 1.0),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use opnav::stats::random_stream;
    use rand::RngExt;
    use rand_distr::{Distribution, StandardNormal};

    /// Mean of what is measured of many pairs whose smooth error has the share.
    fn measured(share: f64) -> (f64, f64) {
        let mut random = random_stream(9, "smooth errors", 0);
        let mut sums = (0.0, 0.0);
        const PAIRS: usize = 60;
        for _ in 0..PAIRS {
            let draw: Vec<f64> = (0..COEFFICIENTS).map(|_| StandardNormal.sample(&mut random)).collect();
            let weight = |m: usize| if m < LOW_MODES { 1.0 } else { 0.5f64.sqrt() };
            let mut point = || {
                let unit = Vector2::new(random.random_range(-1.7..1.7), random.random_range(-1.7..1.7));
                let m = modes(&unit);
                let smooth = |k: usize| (0..MODES).map(|j| share.sqrt() * weight(j) * draw[k * MODES + j] * m[j]).sum();
                let white: [f64; 2] = [StandardNormal.sample(&mut random), StandardNormal.sample(&mut random)];
                let smooth: [f64; 2] = [smooth(0), smooth(1)];
                let wild = if random.random::<f64>() < 0.05 { 40.0 } else { 0.0 };
                let error = Vector2::new(white[0] + smooth[0] + wild, white[1] + smooth[1] - wild);
                (Vector2::new(300.0, 200.0) + unit * 150.0, 0.4 * error)
            };
            let all: Vec<_> = (0..400).map(|_| point()).collect();
            let found = smooth_error(&all).expect("enough points");
            sums.0 += found.mean_square / PAIRS as f64;
            sums.1 += found.of_white_noise / PAIRS as f64;
        }
        sums
    }

    #[test]
    fn the_share_of_a_smooth_error_is_recovered_beside_noise_and_gross_errors() {
        let (all, white) = measured(0.04);
        assert!(((all - white) / 0.04 - 1.0).abs() < 0.15, "{all} {white}");
        let (none, white) = measured(0.0);
        assert!((none / white - 1.0).abs() < 0.2, "white noise alone shows no share: {none} {white}");
    }
}
