//! Candidate motions of a picture pair, and the choice among them.

use super::pair_fit::{Loss, PairFit, PairModel, cost, descend, fit, residual};
use super::pair_models::{General, Heading, Plane, Turn};
use super::relative_rotation::facing;
use super::sight::Sight;
use super::{PairHints, RotationConfig, RotationModel, usac};
use crate::geometry::so3;
use nalgebra::{Matrix3, Rotation3, Unit, UnitQuaternion, Vector3};

/// A fitted motion.
#[derive(Debug, Clone)]
pub(super) enum Candidate {
    General(PairFit<5, General>),
    Plane(Box<PairFit<8, Plane>>),
    Turn(PairFit<3, Turn>),
}

impl Candidate {
    pub(super) fn rotation(&self) -> UnitQuaternion<f64> {
        match self {
            Candidate::General(f) => f.model.rotation,
            Candidate::Plane(f) => f.model.rotation,
            Candidate::Turn(f) => f.model.0,
        }
    }

    /// Covariance of the rotation, the other parameters marginalised.
    pub(super) fn covariance(&self) -> Option<Matrix3<f64>> {
        match self {
            Candidate::General(f) => f.covariance.map(|c| c.fixed_view::<3, 3>(0, 0).into_owned()),
            Candidate::Plane(f) => f.covariance.map(|c| c.fixed_view::<3, 3>(0, 0).into_owned()),
            Candidate::Turn(f) => f.covariance,
        }
    }

    pub(super) fn direction(&self) -> Option<Unit<Vector3<f64>>> {
        match self {
            Candidate::General(f) => Some(f.model.direction),
            Candidate::Plane(f) => Unit::try_new(f.model.translation, 1e-9),
            Candidate::Turn(_) => None,
        }
    }

    pub(super) fn normal(&self) -> Option<Unit<Vector3<f64>>> {
        match self {
            Candidate::Plane(f) => Some(f.model.normal),
            _ => None,
        }
    }

    pub(super) fn inliers(&self) -> Vec<bool> {
        match self {
            Candidate::General(f) => f.inliers.clone(),
            Candidate::Plane(f) => f.inliers.clone(),
            Candidate::Turn(f) => f.inliers.clone(),
        }
    }

    pub(super) fn inlier_count(&self) -> usize {
        match self {
            Candidate::General(f) => f.inlier_count(),
            Candidate::Plane(f) => f.inlier_count(),
            Candidate::Turn(f) => f.inlier_count(),
        }
    }

    pub(super) fn scale(&self) -> f64 {
        match self {
            Candidate::General(f) => f.scale,
            Candidate::Plane(f) => f.scale,
            Candidate::Turn(f) => f.scale,
        }
    }

    pub(super) fn model(&self) -> RotationModel {
        match self {
            Candidate::General(_) => RotationModel::Essential,
            _ => RotationModel::Homography,
        }
    }

    fn squares(&self, sights: &[Sight], scale: f64) -> Vec<f64> {
        match self {
            Candidate::General(f) => squares::<5, _>(&f.model, sights, scale),
            Candidate::Plane(f) => squares::<8, _>(&f.model, sights, scale),
            Candidate::Turn(f) => squares::<3, _>(&f.model, sights, scale),
        }
    }

    /// Torr's geometric robust information criterion (1998), at noise `scale`.
    fn gric(&self, sights: &[Sight], scale: f64) -> f64 {
        match self {
            Candidate::General(f) => gric::<5, _>(&f.model, sights, scale, 3.0),
            Candidate::Plane(f) => gric::<8, _>(&f.model, sights, scale, 2.0),
            Candidate::Turn(f) => gric::<3, _>(&f.model, sights, scale, 2.0),
        }
    }
}

fn gric<const N: usize, M: PairModel<N>>(model: &M, sights: &[Sight], scale: f64, dimension: f64) -> f64 {
    const COORDINATES: f64 = 4.0;
    let most = 2.0 * (COORDINATES - dimension);
    let matrix = model.matrix().0;
    let square = |s: &Sight| (residual(M::RELATION, &matrix, s).norm_squared() / scale.powi(2)).min(most);
    let misfit: f64 = sights.iter().map(square).sum();
    let n = sights.len() as f64;
    misfit + n * dimension * COORDINATES.ln() + N as f64 * (COORDINATES * n).ln()
}

/// All fitted motions of a pair.
pub(super) struct Fits {
    generals: Vec<PairFit<5, General>>,
    planes: Vec<PairFit<8, Plane>>,
    turn: Option<PairFit<3, Turn>>,
}

/// Matches used to compare starts; the winners are refined on all.
const SCREENING: usize = 150;

/// A residual beyond this many σ counts no further when rivals are compared.
const GATE_SIGMA: f64 = 3.0;

/// By how much a match the GRIC of general motion must lie below the plane's.
const GENERAL_HANDICAP: f64 = 0.25;

impl Fits {
    pub(super) fn new(
        sights: &[Sight],
        widest: f64,
        homography: Option<&Matrix3<f64>>,
        essential: Option<&Matrix3<f64>>,
        hints: &PairHints,
        config: &RotationConfig,
    ) -> Self {
        let small = |q: &UnitQuaternion<f64>| q.angle() < config.max_angle_rad;
        let planes: Vec<Plane> = homography.map(usac::planes).unwrap_or_default();
        let planes: Vec<Plane> = planes.into_iter().filter(|p| small(&p.rotation) && is_visible(p, sights)).collect();
        let mut turns: Vec<UnitQuaternion<f64>> = hints.camera_to_from_camera_from.into_iter().collect();
        turns.extend(homography.and_then(nearest_turn));
        let mut starts: Vec<General> = essential.map(usac::motions).unwrap_or_default();
        starts.extend(planes.iter().filter_map(|p| {
            Unit::try_new(p.translation, 1e-9).map(|direction| General { rotation: p.rotation, direction })
        }));
        starts.extend(turns.iter().flat_map(|q| {
            [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()].map(|d| General { rotation: *q, direction: d })
        }));
        starts.retain(|s| small(&s.rotation));
        Fits {
            generals: fit_generals(&starts, sights, widest),
            planes: fit_planes(&planes, sights, widest),
            turn: turns.first().map(|q| fit(Turn(*q), sights, widest)),
        }
    }

    /// The model with the lowest GRIC; general motion has to win clearly. Where relief barely shows above the noise, its
    /// fit has several shallow minima and promises too much, while the plane's rotation is as good.
    pub(super) fn best(&self, sights: &[Sight]) -> Option<Candidate> {
        let candidates = || self.all();
        // The noise is that of the model that explains most with the least.
        let scale = candidates().map(|c| c.scale()).fold(f64::INFINITY, f64::min).max(0.1);
        let handicap = |c: &Candidate| match c {
            Candidate::General(_) => GENERAL_HANDICAP * sights.len() as f64,
            _ => 0.0,
        };
        let score = |c: &Candidate| c.gric(sights, scale) + handicap(c);
        candidates().min_by(|a, b| score(a).total_cmp(&score(b)))
    }

    fn all(&self) -> impl Iterator<Item = Candidate> + '_ {
        let generals = self.generals.iter().cloned().map(Candidate::General);
        let planes = self.planes.iter().cloned().map(|f| Candidate::Plane(Box::new(f)));
        generals.chain(planes).chain(self.turn.iter().cloned().map(Candidate::Turn))
    }

    /// Which of rival planes the relief favours: each rotation is held, its direction of translation freed, and the misfit
    /// to the epipolar lines must differ clearly. `None` where relief does not tell.
    pub(super) fn favoured_by_relief(&self, rivals: &[Candidate], sights: &[Sight]) -> Option<usize> {
        let scale = self.all().map(|c| c.scale()).fold(f64::INFINITY, f64::min);
        let held = |c: &Candidate| -> Option<Vec<f64>> {
            let start = Heading(General { rotation: c.rotation(), direction: c.direction()? });
            let best = descend(start, sights, Loss::Truncated(GATE_SIGMA * scale), 15).0;
            Some(squares::<2, _>(&best, sights, scale))
        };
        let misfits: Vec<Vec<f64>> = rivals.iter().map(held).collect::<Option<_>>()?;
        let total = |i: usize| misfits[i].iter().sum::<f64>();
        let best = (0..misfits.len()).min_by(|a, b| total(*a).total_cmp(&total(*b)))?;
        (0..misfits.len()).all(|i| i == best || is_clearly_worse(&misfits[i], &misfits[best])).then_some(best)
    }

    /// Motions of the winner's kind with another rotation that do not explain the matches clearly worse.
    pub(super) fn rivals(&self, winner: &Candidate, sights: &[Sight], config: &RotationConfig) -> Vec<Candidate> {
        let sigma = winner.covariance().map_or(config.max_sigma_rad, |c| c.trace().max(0.0).sqrt());
        let off = |c: &Candidate| so3::log(&(c.rotation() * winner.rotation().inverse())).norm();
        let apart = |c: &Candidate| off(c) > (3.0 * sigma).max(1e-3);
        let best = winner.squares(sights, winner.scale());
        let as_good = |c: &Candidate| !is_clearly_worse(&c.squares(sights, winner.scale()), &best);
        let same_kind = |c: &Candidate| c.model() == winner.model() && !matches!(c, Candidate::Turn(_));
        self.all().filter(|c| same_kind(c) && apart(c) && as_good(c)).collect()
    }
}

/// Squared residuals over the noise's variance, none beyond the gate.
fn squares<const N: usize, M: PairModel<N>>(model: &M, sights: &[Sight], scale: f64) -> Vec<f64> {
    let matrix = model.matrix().0;
    let square = |s: &Sight| residual(M::RELATION, &matrix, s).norm_squared() / scale.powi(2);
    sights.iter().map(|s| square(s).min(GATE_SIGMA * GATE_SIGMA)).collect()
}

/// Whether one model's squared residuals exceed another's by more than 3σ of their difference (Vuong 1989): neither model
/// contains the other, so chance makes their sums differ by much more than a χ² with few degrees of freedom.
fn is_clearly_worse(squares: &[f64], best: &[f64]) -> bool {
    const CLEAR_SIGMA: f64 = 3.0;
    let (mut sum, mut sum_of_squares) = (0.0, 0.0);
    for (a, b) in squares.iter().zip(best) {
        sum += a - b;
        sum_of_squares += (a - b).powi(2);
    }
    sum > CLEAR_SIGMA * sum_of_squares.sqrt()
}

/// Fits the first plane, then its twins: the other decompositions of the same fitted homography.
fn fit_planes(starts: &[Plane], sights: &[Sight], widest: f64) -> Vec<PairFit<8, Plane>> {
    let Some(start) = starts.first() else { return Vec::new() };
    let first = fit(*start, sights, widest);
    let off = |p: &Plane| so3::log(&(p.rotation * first.model.rotation.inverse())).norm();
    let twins: Vec<Plane> =
        usac::planes(&first.model.matrix().0).into_iter().filter(|p| is_visible(p, sights)).collect();
    let itself = twins.iter().map(off).fold(f64::INFINITY, f64::min);
    let fitted: Vec<_> = twins.iter().filter(|p| off(p) > itself + 1e-6).map(|p| fit(*p, sights, widest)).collect();
    std::iter::once(first).chain(fitted).collect()
}

/// Screens the starts on some matches, then refines the distinct best on all; those behind the camera are dropped.
fn fit_generals(starts: &[General], sights: &[Sight], widest: f64) -> Vec<PairFit<5, General>> {
    let step = sights.len().div_ceil(SCREENING);
    let few: Vec<Sight> = sights.iter().step_by(step).copied().collect();
    let loss = Loss::Cauchy(0.5 * widest / 3.0);
    let mut screened: Vec<(f64, General)> = Vec::new();
    for start in starts {
        let (model, normal) = descend(*start, &few, loss, 8);
        let known = |m: &General| so3::log(&(m.rotation * model.rotation.inverse())).norm() < 1e-3;
        if !screened.iter().any(|(_, m)| known(m)) {
            screened.push((normal.cost, model));
        }
    }
    screened.sort_by(|a, b| a.0.total_cmp(&b.0));
    let limit = screened.first().map_or(0.0, |s| 1.3 * s.0 + 10.0);
    let mut fits: Vec<PairFit<5, General>> = Vec::new();
    for (_, model) in screened.into_iter().filter(|s| s.0 <= limit).take(2) {
        let mut refined = fit(model, sights, widest);
        let inside: Vec<Sight> =
            sights.iter().zip(&refined.inliers).filter(|(_, inlier)| **inlier).map(|(s, _)| *s).collect();
        let (model, cheirality) = facing(refined.model, &inside);
        refined.model = model;
        if !cheirality.contradicts() {
            fits.push(refined);
        }
    }
    fits.sort_by(|a, b| {
        let c = |f: &PairFit<5, General>| cost::<5, _>(&f.model, sights, loss);
        c(a).total_cmp(&c(b))
    });
    fits
}

fn is_visible(plane: &Plane, sights: &[Sight]) -> bool {
    let ahead = sights.iter().filter(|s| plane.normal.dot(&s.first_ray()) > 0.0).count();
    ahead * 10 >= sights.len() * 9
}

/// The rotation nearest to a homography.
fn nearest_turn(h: &Matrix3<f64>) -> Option<UnitQuaternion<f64>> {
    let svd = h.svd(true, true);
    let r = svd.u? * svd.v_t?;
    (r.determinant() > 0.0).then(|| UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(r)))
}
