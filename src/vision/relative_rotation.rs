//! The rotation between two pictures of any scene: essential matrix, homography or pure rotation, whichever explains
//! the matches, each refined by robust least squares.

use super::candidates::{Candidate, Fits};
use super::pair_fit::PairFit;
use super::pair_models::{General, KnownPlane, Plane, Turn};
use super::plausible::plausible;
use super::sight::{Sight, sights};
use super::{MatchedPair, PairStatus, RotationConfig, RotationModel, VisionError, usac};
use crate::geometry::{Camera, so3};
use nalgebra::{Matrix3, Unit, UnitQuaternion, Vector3};

/// What two pictures say about the motion between them.
#[derive(Debug, Clone, PartialEq)]
pub struct PairSolution {
    /// Rotation from the first camera's axes to the second's; identity where the status is not ok.
    pub camera_to_from_camera_from: UnitQuaternion<f64>,
    /// Covariance (rad²) of the error `d` in `true = exp(d) * estimated`, axes of the second camera; zero where the
    /// status is not ok.
    pub covariance_rad2: Matrix3<f64>,
    /// Direction of the translation in the second camera (`x_to = R x_from + t`), where there is one.
    pub direction_in_to: Option<Unit<Vector3<f64>>>,
    /// Normal of the dominant plane in the first camera, where the matches lie on one.
    pub normal_in_from: Option<Unit<Vector3<f64>>>,
    /// Which matches agree with the motion.
    pub inliers: Vec<bool>,
    /// Actual pixel noise over nominal pixel noise, as the residuals show it.
    pub noise_scale: f64,
    /// The model used.
    pub model: RotationModel,
    /// The outcome.
    pub status: PairStatus,
}

impl PairSolution {
    pub(super) fn failed(status: PairStatus, matches: usize) -> Self {
        PairSolution {
            camera_to_from_camera_from: UnitQuaternion::identity(),
            covariance_rad2: Matrix3::zeros(),
            direction_in_to: None,
            normal_in_from: None,
            inliers: vec![false; matches],
            noise_scale: 1.0,
            model: RotationModel::None,
            status,
        }
    }

    /// Matches that agree.
    pub fn inlier_count(&self) -> usize {
        self.inliers.iter().filter(|i| **i).count()
    }
}

/// Matched pixels with their noise.
#[derive(Debug, Clone, Copy)]
pub struct PixelMatches<'a> {
    /// The pixels.
    pub pair: &'a MatchedPair,
    /// 1σ of each coordinate of each match in px (of either pixel; their mean where they differ).
    pub sigma_px: &'a [f64],
}

/// What else is known of a pair.
#[derive(Debug, Clone, Copy, Default)]
pub struct PairHints {
    /// Predicted rotation (from a gyroscope, say): a start, a judge between rival solutions, and a gate.
    pub camera_to_from_camera_from: Option<UnitQuaternion<f64>>,
    /// Normal of the ground in the first camera as the pair before found it: a judge between rival solutions only.
    pub normal_in_from: Option<Unit<Vector3<f64>>>,
}

/// Rotation between two pictures from matched pixels.
///
/// Candidates come from USAC's essential matrix and homography and from the prediction. Each is refined by least
/// squares on Sampson or transfer errors; Torr's GRIC (1998) chooses among general motion, plane and pure rotation. Two
/// rival rotations that explain the matches equally well and that no hint tells apart make the pair degenerate.
///
/// # Errors
/// OpenCV's refusal. A pair without a sure rotation is an outcome ([`PairSolution::status`]), not an error.
pub fn relative_rotation(
    matches: PixelMatches,
    camera: &Camera,
    hints: &PairHints,
    config: &RotationConfig,
) -> Result<PairSolution, VisionError> {
    let all = sights(matches.pair, matches.sigma_px, camera);
    let usable: Vec<Sight> = all.iter().flatten().copied().collect();
    if usable.len() < config.min_matches {
        return Ok(PairSolution::failed(PairStatus::FewMatches, all.len()));
    }
    let focal_px = camera.mean_focal_px();
    let homography = usac::homography(&usable, focal_px, config);
    if homography.is_some_and(|h| is_mirror_image(&h, &usable, focal_px, config)) {
        return Ok(PairSolution::failed(PairStatus::Rejected, all.len()));
    }
    let essential = usac::essential(&usable, focal_px, config)?;
    let widest = config.threshold_px * 2.0 / median(matches.sigma_px);
    let planes = homography.as_ref().map(usac::planes).unwrap_or_default();
    let plausible = plausible(&usable, &planes, essential.as_ref(), widest);
    let kept: Vec<Sight> = usable.iter().zip(&plausible).filter(|(_, keep)| **keep).map(|(s, _)| *s).collect();
    let fits = Fits::new(&kept, widest, homography.as_ref(), essential.as_ref(), hints, config);
    let mut solution = judge(&fits, (&kept, usable.len()), hints, config);
    solution.inliers = spread(&spread(&solution.inliers, plausible.iter().copied()), all.iter().map(Option::is_some));
    Ok(solution)
}

/// Flags of chosen items, spread over all items.
fn spread(flags: &[bool], chosen: impl Iterator<Item = bool>) -> Vec<bool> {
    let mut flags = flags.iter();
    chosen.map(|c| c && *flags.next().unwrap_or(&false)).collect()
}

/// Whether most matches follow a homography that turns the scene inside out.
fn is_mirror_image(h: &Matrix3<f64>, sights: &[Sight], focal_px: f64, config: &RotationConfig) -> bool {
    let agrees = |s: &&Sight| {
        let p = h * s.first_ray();
        p.z > 0.0 && (p.xy() / p.z - s.to).norm() * focal_px < 2.0 * config.threshold_px
    };
    h.determinant() < 0.0 && sights.iter().filter(agrees).count() * 3 > sights.len()
}

/// Chooses a model, then holds the winner against every gate.
fn judge(
    fits: &Fits,
    (sights, offered): (&[Sight], usize),
    hints: &PairHints,
    config: &RotationConfig,
) -> PairSolution {
    let Some(winner) = fits.best(sights) else {
        return PairSolution::failed(PairStatus::Degenerate, sights.len());
    };
    let refused = |status| PairSolution { inliers: winner.inliers(), ..PairSolution::failed(status, sights.len()) };
    let enough = (config.min_inlier_ratio * offered as f64).max(config.min_matches as f64);
    if (winner.inlier_count() as f64) < enough {
        return refused(PairStatus::Rejected);
    }
    if let Candidate::Turn(turn) = &winner {
        return judge_turn(turn, sights, config).unwrap_or_else(refused);
    }
    let mut all = fits.rivals(&winner, sights, config);
    all.insert(0, winner.clone());
    let relief = || fits.favoured_by_relief(&all, sights);
    let chosen = match choose(&all, relief, hints, config) {
        Ok(chosen) => all.swap_remove(chosen),
        Err(status) => return refused(status),
    };
    let Some(covariance) = chosen.covariance().filter(|c| is_determined(c, config)) else {
        return refused(PairStatus::Degenerate);
    };
    PairSolution {
        camera_to_from_camera_from: chosen.rotation(),
        covariance_rad2: covariance,
        direction_in_to: chosen.direction(),
        normal_in_from: chosen.normal(),
        inliers: chosen.inliers(),
        noise_scale: chosen.scale(),
        model: chosen.model(),
        status: PairStatus::Ok,
    }
}

/// Which of the winner and its rivals, as the hints and the relief say; an error where nothing tells them apart or all
/// contradict the prediction.
fn choose(
    all: &[Candidate],
    relief: impl Fn() -> Option<usize>,
    hints: &PairHints,
    config: &RotationConfig,
) -> Result<usize, PairStatus> {
    if let Some(predicted) = hints.camera_to_from_camera_from {
        let off = |c: &Candidate| so3::log(&(c.rotation() * predicted.inverse())).norm();
        let best = least(all, off);
        let variance = config.prior_sigma_rad.powi(2) + all[best].covariance().map_or(0.0, |c| c.trace());
        return if off(&all[best]) < 5.0 * variance.sqrt() { Ok(best) } else { Err(PairStatus::Rejected) };
    }
    if all.len() == 1 {
        return Ok(0);
    }
    if let Some(chosen) = relief() {
        return Ok(chosen);
    }
    let normal = hints.normal_in_from.ok_or(PairStatus::Degenerate)?;
    let off = |c: &Candidate| c.normal().map_or(f64::INFINITY, |n| n.angle(&normal));
    let best = least(all, off);
    let next = (0..all.len()).filter(|i| *i != best).map(|i| off(&all[i])).fold(f64::INFINITY, f64::min);
    // The ground's slope changes little from picture to picture: the nearer normal must be near, and clearly nearer.
    let clear = off(&all[best]) < 0.15 && next > 2.0 * off(&all[best]) && next > off(&all[best]) + 0.1;
    if clear { Ok(best) } else { Err(PairStatus::Degenerate) }
}

fn least(all: &[Candidate], measure: impl Fn(&Candidate) -> f64) -> usize {
    (0..all.len()).min_by(|a, b| measure(&all[*a]).total_cmp(&measure(&all[*b]))).unwrap_or(0)
}

fn is_determined(covariance: &Matrix3<f64>, config: &RotationConfig) -> bool {
    let greatest = covariance.symmetric_eigenvalues().max();
    greatest.is_finite() && greatest.sqrt() < config.max_sigma_rad
}

/// A pure rotation: its covariance allows for an unseen translation over ground ahead; no rotation at all is no motion.
fn judge_turn(turn: &PairFit<3, Turn>, sights: &[Sight], config: &RotationConfig) -> Result<PairSolution, PairStatus> {
    const CHI2_3_AT_999: f64 = 16.27;
    const STILL_PX_SIGMA: f64 = 0.15;
    let alone = turn.covariance.ok_or(PairStatus::Degenerate)?;
    let angle = so3::log(&turn.model.0);
    let surprise = alone.try_inverse().map_or(0.0, |information| angle.dot(&(information * angle)));
    let still = super::pair_fit::robust_scale::<3, _>(&Turn(UnitQuaternion::identity()), sights, 1e6);
    if surprise < CHI2_3_AT_999 || still < STILL_PX_SIGMA {
        return Err(PairStatus::NoMotion);
    }
    let ahead = sights.iter().map(|s| s.first_ray().normalize()).sum::<Vector3<f64>>();
    let plane = Plane { rotation: turn.model.0, translation: Vector3::zeros(), normal: Unit::new_normalize(ahead) };
    let loss = super::pair_fit::Loss::Truncated(3.45 * turn.scale);
    let normal = super::pair_fit::normal_equations(&KnownPlane(plane), sights, loss);
    let covariance = normal.information.try_inverse().ok_or(PairStatus::Degenerate)? * turn.scale.powi(2);
    let covariance: Matrix3<f64> = covariance.fixed_view::<3, 3>(0, 0).into_owned();
    if !is_determined(&covariance, config) {
        return Err(PairStatus::Degenerate);
    }
    Ok(PairSolution {
        camera_to_from_camera_from: turn.model.0,
        covariance_rad2: covariance,
        inliers: turn.inliers.clone(),
        noise_scale: turn.scale,
        model: RotationModel::Homography,
        status: PairStatus::Ok,
        ..PairSolution::failed(PairStatus::Ok, 0)
    })
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(1.0)
}

/// Direction of a general motion, with the sign that puts the points in front of both cameras.
pub(super) fn facing(general: General, sights: &[Sight]) -> (General, Cheirality) {
    let there = Cheirality::of(general.rotation, &general.direction, sights);
    if there.ahead * 2 < there.seen {
        let back = Cheirality { ahead: there.seen - there.ahead, seen: there.seen };
        return (General { direction: -general.direction, ..general }, back);
    }
    (general, there)
}

/// How many points with a clear parallax lie in front of both cameras.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cheirality {
    pub(super) ahead: usize,
    pub(super) seen: usize,
}

impl Cheirality {
    /// Counts the points; those with a parallax below 4σ say nothing, and those ahead of one camera only count against.
    pub(super) fn of(rotation: UnitQuaternion<f64>, t: &Vector3<f64>, sights: &[Sight]) -> Self {
        let mut count = Cheirality { ahead: 0, seen: 0 };
        for s in sights {
            let (a, b) = ((rotation * s.first_ray()).normalize(), s.second_ray().normalize());
            let across = a.cross(&b);
            let sine2 = across.norm_squared();
            if sine2 < 16.0 * (s.from_covariance.trace() + s.to_covariance.trace()) {
                continue;
            }
            // λ b = μ a + t: crossing with a and with b gives both depths over |a×b|².
            let (lambda, mu) = (a.cross(t).dot(&across), b.cross(t).dot(&across));
            count.seen += 1;
            count.ahead += usize::from(lambda > 0.0 && mu > 0.0);
        }
        count
    }

    /// Whether the points contradict the motion.
    pub(super) fn contradicts(&self) -> bool {
        self.seen >= 8 && self.ahead * 10 < self.seen * 8
    }
}
