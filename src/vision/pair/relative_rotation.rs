//! The rotation between two images of any scene: a body, ground with or without relief, or a pure turn.

use super::config::RotationConfig;
use super::hypotheses::{Hypotheses, RankedHypothesis};
use super::motion::Motion;
use super::normalized_match::{NormalizedMatch, normalized};
use super::pure_rotation::judge_turn;
use super::solution::{PairHints, PairSolution, PixelMatches, is_determined};
use super::usac;
use crate::geometry::Camera;
use crate::observations::PairStatus;
use crate::stats::upper_median;
use crate::vision::error::VisionError;
use nalgebra::Matrix3;

/// Rotation between two images from matched pixels.
///
/// Candidates come from USAC's essential matrix and homography. Each is refined to the greatest likelihood of a plane with
/// relief about it, which holds both: it becomes the epipolar constraint where relief shows and the homography where it
/// does not. Rival motions that explain the matches equally well and that no hint tells apart make the pair degenerate.
///
/// # Errors
/// OpenCV's refusal. A pair without a sure rotation is an outcome ([`PairSolution::status`]), not an error.
pub fn relative_rotation(
    matches: PixelMatches,
    camera: &Camera,
    hints: &PairHints,
    config: &RotationConfig,
) -> Result<PairSolution, VisionError> {
    let all = normalized(matches.pair, matches.sigma_px, camera);
    let usable: Vec<NormalizedMatch> = all.iter().flatten().copied().collect();
    if usable.len() < config.min_matches {
        return Ok(PairSolution::failed(PairStatus::FewMatches, all.len()));
    }
    let focal_px = camera.mean_focal_px();
    let homography = usac::homography(&usable, focal_px, config);
    if homography.is_some_and(|h| is_mirror_image(&h, &usable, focal_px, config)) {
        return Ok(PairSolution::failed(PairStatus::Rejected, all.len()));
    }
    let essential = usac::essential(&usable, focal_px, config)?;
    let widest = config.threshold_px * 2.0 / upper_median(&mut matches.sigma_px.to_vec()).unwrap_or(1.0);
    let fits = Hypotheses::new(&usable, widest, (homography.as_ref(), essential.as_ref()), (hints, config));
    let mut solution = judge(&fits, (&usable, widest), (hints, config));
    solution.inliers = spread(&solution.inliers, all.iter().map(Option::is_some));
    Ok(solution)
}

/// Flags of chosen items, spread over all items.
fn spread(flags: &[bool], chosen: impl Iterator<Item = bool>) -> Vec<bool> {
    let mut flags = flags.iter();
    chosen.map(|c| c && *flags.next().unwrap_or(&false)).collect()
}

/// Whether most matches follow a homography that turns the scene inside out.
fn is_mirror_image(h: &Matrix3<f64>, normalized: &[NormalizedMatch], focal_px: f64, config: &RotationConfig) -> bool {
    let agrees = |s: &&NormalizedMatch| {
        let p = h * s.first_ray();
        p.z > 0.0 && (p.xy() / p.z - s.to).norm() * focal_px < 2.0 * config.threshold_px
    };
    h.determinant() < 0.0 && normalized.iter().filter(agrees).count() * 3 > normalized.len()
}

/// Chooses a motion, then holds it against every gate.
fn judge(
    fits: &Hypotheses,
    (normalized, widest): (&[NormalizedMatch], f64),
    (hints, config): (&PairHints, &RotationConfig),
) -> PairSolution {
    let enough = (config.min_inlier_ratio * normalized.len() as f64).max(config.min_matches as f64) as usize;
    if let Some(turn) = fits.turn_alone((normalized, widest), enough) {
        let refused = |status| PairSolution { inliers: turn.inliers.clone(), ..PairSolution::failed(status, 0) };
        return judge_turn(&turn, normalized, config).unwrap_or_else(refused);
    }
    let Some(best) = fits.grounds.first() else {
        return PairSolution::failed(PairStatus::Degenerate, normalized.len());
    };
    let refused =
        |status| PairSolution { inliers: best.fit.inliers.clone(), ..PairSolution::failed(status, normalized.len()) };
    if best.fit.inlier_count() < enough {
        return refused(PairStatus::Rejected);
    }
    let motion = match choose(fits, normalized, hints, config) {
        Ok(chosen) => Motion::of(&chosen.fit, normalized, &config.noise),
        Err(status) => return refused(status),
    };
    let Some(motion) = motion.filter(|m| is_determined(&m.covariance_rad2, config)) else {
        return refused(PairStatus::Degenerate);
    };
    PairSolution {
        camera_to_from_camera_from: motion.rotation,
        covariance_rad2: motion.covariance_rad2,
        direction_in_to: motion.direction,
        normal_in_from: Some(motion.normal),
        inliers: motion.inliers,
        noise_scale: motion.noise_scale,
        model: motion.model,
        status: PairStatus::Ok,
    }
}

/// The likeliest motion, a prediction counting as a measurement; an error where nothing tells rivals apart or all
/// contradict the prediction.
fn choose<'a>(
    fits: &'a Hypotheses,
    normalized: &[NormalizedMatch],
    hints: &PairHints,
    config: &RotationConfig,
) -> Result<&'a RankedHypothesis, PairStatus> {
    if let Some(predicted) = hints.camera_to_from_camera_from {
        let off_rad = |r: &RankedHypothesis| r.fit.ground.rotation.angle_to(&predicted);
        let cost = |r: &RankedHypothesis| fits.surprise(r, normalized) + (off_rad(r) / config.prior_sigma_rad).powi(2);
        let chosen = fits.grounds.iter().min_by(|a, b| cost(a).total_cmp(&cost(b))).ok_or(PairStatus::Degenerate)?;
        let own = chosen.fit.rotation_covariance(normalized).map_or(0.0, |c| c.trace());
        let near = off_rad(chosen) < 5.0 * (config.prior_sigma_rad.powi(2) + own).sqrt();
        return if near { Ok(chosen) } else { Err(PairStatus::Rejected) };
    }
    let mut all = fits.rivals(normalized);
    if all.len() == 1 {
        return Ok(all[0]);
    }
    let normal = hints.normal_in_from.ok_or(PairStatus::Degenerate)?;
    let off_rad = |r: &RankedHypothesis| r.fit.ground.normal.angle(&normal);
    all.sort_by(|a, b| off_rad(a).total_cmp(&off_rad(b)));
    let (best, next) = (off_rad(all[0]), off_rad(all[1]));
    // The ground's slope changes little from image to image: the nearer normal must be near, and clearly nearer.
    // A decision between two motions: the angles enter no covariance.
    let clear = best < 0.15 && next > 2.0 * best && next > best + 0.1;
    if clear { Ok(all[0]) } else { Err(PairStatus::Degenerate) }
}
