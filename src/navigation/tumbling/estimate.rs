//! The estimate from rotations between images: the recipe.

use super::config::{Estimator, TumblingConfig};
use super::error::TumblingError;
use super::filters::{PaperFilter, chained_attitudes, filter_after_first_arc};
use super::pair::{RotationPair, usable_pairs};
use super::result::{PairCount, TumblingResult};
use super::shooting::{ShootingFit, seconds, shoot, shooting_epochs};
use crate::observations::RelativeRotation;

/// Attitude, rate and inertia ratios at each image of `frame_times_ns`, from the rotations with status ok between them.
///
/// A rotation is camera(t_to)_from_camera(t_from) of a camera that seems to move around a resting body:
/// `asteroid_from_camera(t_to)⁻¹ * asteroid_from_camera(t_from)`. The camera itself must not turn, and the body must turn
/// freely. The rotations' covariances weigh them.
///
/// # Errors
/// Settings, times, pairs that are not usable, too few of them, or rotations that no free body makes: [`TumblingError`].
pub fn estimate(
    rotations: &[RelativeRotation],
    frame_times_ns: &[i64],
    config: &TumblingConfig,
) -> Result<TumblingResult, TumblingError> {
    config.validate()?;
    let pairs = usable_pairs(rotations, frame_times_ns)?;
    match config.estimator {
        Estimator::Shooting => {
            let shot = shoot(&pairs, &seconds(frame_times_ns), config)?;
            Ok(shooting_result(shot, frame_times_ns, pairs.len()))
        }
        Estimator::Realtime => filter_after_first_arc(&pairs, frame_times_ns, config),
        Estimator::Paper => filter_as_the_paper(&pairs, frame_times_ns, config),
    }
}

fn shooting_result(shot: ShootingFit, frame_times_ns: &[i64], given: usize) -> TumblingResult {
    let epochs = shooting_epochs(&shot, frame_times_ns);
    let covariance = shot.covariance.fixed_view::<5, 5>(3, 3).into_owned();
    let count = PairCount { used: shot.pairs_used, given, residual_rms_sigma: shot.residual_rms_sigma };
    TumblingResult::new(epochs, &shot.fit.inertia, &covariance, shot.undetermined, count)
}

fn filter_as_the_paper(
    pairs: &[RotationPair],
    frame_times_ns: &[i64],
    config: &TumblingConfig,
) -> Result<TumblingResult, TumblingError> {
    let times_s = seconds(frame_times_ns);
    let (attitudes, used) = chained_attitudes(pairs, times_s.len());
    let mut filter = PaperFilter::new(&config.paper);
    let mut epochs = vec![filter.epoch(frame_times_ns[0])];
    let (mut squares, mut innovations) = (0.0, 0_usize);
    for k in 1..times_s.len() {
        let diverged = || TumblingError::Diverged { t_ns: frame_times_ns[k] };
        filter = filter.predict(times_s[k] - times_s[k - 1]).ok_or_else(diverged)?;
        if let Some(attitude) = &attitudes[k] {
            let (corrected, square) = filter.correct(attitude).ok_or_else(diverged)?;
            filter = corrected;
            squares += square;
            innovations += 3;
        }
        epochs.push(filter.epoch(frame_times_ns[k]));
    }
    let residual_rms_sigma = (squares / innovations.max(1) as f64).sqrt();
    let count = PairCount { used, given: pairs.len(), residual_rms_sigma };
    Ok(TumblingResult::new(epochs, filter.inertia(), &filter.inertia_covariance(), Vec::new(), count))
}
