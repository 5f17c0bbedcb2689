//! Rotations of a body that turns about a centre at a fixed place in the camera: three unknowns a pair, and the
//! direction of the centre for the whole sequence.
//!
//! `E(R) = [(I - R) T]× R`: the scale cancels, and a narrow field of view determines `R` where a free translation would
//! not. The centre starts at the centroid of the bright silhouette and is refined over all pairs at once.

use super::problem::{CenterProblem, CenterSolution, CenteredPair};
use super::start::{CenterView, best_start, is_near_side};
use crate::geometry::so3;
use crate::observations::{PairStatus, RotationModel};
use crate::stats::median;
use crate::vision::pair::config::FixedCenterConfig;
use crate::vision::pair::covariance::{COEFFICIENTS, Size, White, refine, spread};
use crate::vision::pair::models::{AboutCenter, WithCenter};
use crate::vision::pair::robust_fit::{Loss, cost, fit, observed_information};
use crate::vision::pair::solution::PairSolution;
use nalgebra::{Matrix2, Matrix2x3, Matrix2x5, Matrix3, Matrix3x2, Matrix5, SMatrix, Unit, Vector2, Vector3};
use rayon::prelude::*;

/// Solves all pairs of a sequence; pairs in time order, so that the rate gate can compare neighbours.
///
/// Motion mostly in the image's plane has a reversed rival with a displaced centre. So several first guesses of the
/// centre are followed on a few pairs, and the one that explains them best is taken for all.
pub fn rotations_about_center(pairs: &[CenteredPair], problem: &CenterProblem) -> CenterSolution {
    let views: Vec<CenterView> = pairs.par_iter().map(|p| CenterView::new(p, problem)).collect();
    let thinned: Vec<CenterView> = views.iter().map(|v| v.thinned(200)).collect();
    let few = Joint::few(&thinned, pairs);
    let ends: Vec<(f64, Unit<Vector3<f64>>)> =
        guesses(problem).par_iter().map(|guess| few.settle(*guess, problem)).map(|j| (j.cost, j.center)).collect();
    let best = ends.iter().min_by(|a, b| a.0.total_cmp(&b.0)).map_or(problem.center_guess, |e| e.1);
    let Settled { center, covariance, mut found, .. } =
        Joint { views: views.iter().collect(), pairs: pairs.to_vec() }.settle(best, problem);
    drop_strays(&mut found, pairs, problem.config);
    solve_again(&mut found, &views, pairs, (center, problem));
    let solved = views.par_iter().zip(&found).map(|(v, f)| finish(v, *f, &covariance, problem)).collect();
    CenterSolution { center_in_camera: center, center_covariance_rad2: covariance, pairs: solved }
}

/// The first guess, and eight points about it at its 1σ.
fn guesses(problem: &CenterProblem) -> Vec<Unit<Vector3<f64>>> {
    let basis = so3::tangent_basis(&problem.center_guess);
    let ring = (0..8).map(|k| {
        let angle = f64::from(k) * std::f64::consts::FRAC_PI_4;
        let off = Vector2::new(angle.cos(), angle.sin()) * problem.config.center_sigma_rad;
        Unit::new_normalize(problem.center_guess.into_inner() + basis * off)
    });
    std::iter::once(problem.center_guess).chain(ring).collect()
}

/// Pairs that share a centre.
struct Joint<'a> {
    views: Vec<&'a CenterView>,
    pairs: Vec<CenteredPair<'a>>,
}

/// A centre with the rotations about it.
struct Settled {
    center: Unit<Vector3<f64>>,
    covariance: Matrix2<f64>,
    found: Vec<Option<AboutCenter>>,
    cost: f64,
}

impl<'a> Joint<'a> {
    /// At most six pairs, evenly chosen.
    fn few(views: &'a [CenterView], pairs: &[CenteredPair<'a>]) -> Self {
        let step = views.len().div_ceil(6).max(1);
        let chosen = (0..views.len()).step_by(step);
        Joint { views: chosen.clone().map(|k| &views[k]).collect(), pairs: chosen.map(|k| pairs[k]).collect() }
    }

    /// Rotations about a first guess, then centre and rotations in turns until the centre rests.
    fn settle(&self, guess: Unit<Vector3<f64>>, problem: &CenterProblem) -> Settled {
        let mut center = guess;
        let mut covariance = Matrix2::identity() * problem.config.center_sigma_rad.powi(2);
        let start = |v: &&CenterView| best_start(v, center, &v.predicted_starts(), problem.rotation);
        let mut found: Vec<Option<AboutCenter>> = self.views.par_iter().map(start).collect();
        for _ in 0..12 {
            drop_strays(&mut found, &self.pairs, problem.config);
            let before = center;
            (center, covariance) = refine_center(&self.views, &found, center, problem);
            let moved = |(v, f): (&&CenterView, &Option<AboutCenter>)| f.map(|f| moved_to(center, f, v));
            found = self.views.par_iter().zip(&found).map(moved).collect();
            if center.angle(&before) < 1e-6 {
                break;
            }
        }
        let prior = (center.angle(&problem.center_guess) / problem.config.center_sigma_rad).powi(2);
        let cost = self.views.iter().zip(&found).map(|(v, f)| pair_cost(v, f)).sum::<f64>() + prior;
        Settled { center, covariance, found, cost }
    }
}

/// Truncated misfit of a pair; an unsolved one costs as if every match were wrong.
fn pair_cost(view: &CenterView, found: &Option<AboutCenter>) -> f64 {
    const GATE: f64 = 3.0;
    match found {
        Some(model) => 2.0 * cost::<3, _>(model, &view.normalized, Loss::Truncated(GATE)),
        None => GATE * GATE * view.normalized.len() as f64,
    }
}

/// Solves one pair about a known centre, from a predicted rotation.
pub fn rotation_about_center(
    pair: &CenteredPair,
    center: (&Unit<Vector3<f64>>, &Matrix2<f64>),
    problem: &CenterProblem,
) -> PairSolution {
    let view = CenterView::new(pair, problem);
    let found = best_start(&view, *center.0, &view.predicted_starts(), problem.rotation);
    finish(&view, found, center.1, problem)
}

fn moved_to(center: Unit<Vector3<f64>>, found: AboutCenter, view: &CenterView) -> AboutCenter {
    fit(AboutCenter { center, ..found }, &view.normalized, view.widest).model
}

/// Newton step of the centre over all solved pairs, their rotations eliminated (Schur complement); the covariance is that
/// of the step where the matches' errors vary smoothly over the image besides their noise, and alike in all pairs: the
/// light stands still while the body turns on.
fn refine_center(
    views: &[&CenterView],
    found: &[Option<AboutCenter>],
    center: Unit<Vector3<f64>>,
    problem: &CenterProblem,
) -> (Unit<Vector3<f64>>, Matrix2<f64>) {
    let prior = problem.config.center_sigma_rad.powi(-2);
    let basis = so3::tangent_basis(&center);
    let off = basis.transpose() * (problem.center_guess.into_inner() - center.into_inner());
    let mut information = Matrix2::identity() * prior;
    let mut by_correlated_error = SMatrix::<f64, 2, COEFFICIENTS>::zeros();
    let mut gradient: Vector2<f64> = -off * prior;
    for (view, model) in views.iter().zip(found).filter_map(|(v, f)| f.map(|f| (v, AboutCenter { center, ..f }))) {
        let scale = crate::vision::pair::robust_fit::robust_scale::<3, _>(&model, &view.normalized, view.widest);
        let white = White::of(&WithCenter(model), &view.normalized, scale);
        if let Some(by_center) = without_rotation(&white.information) {
            information += by_center * white.information * by_center.transpose();
            by_correlated_error += by_center * white.by_correlated_error;
            gradient += by_center * white.gradient;
        }
    }
    let spread = information + spread(&by_correlated_error, problem.config.noise.correlated_error_share);
    let inverse = information.try_inverse().unwrap_or_else(Matrix2::identity);
    let step = -(inverse * gradient);
    let step = step * (0.05 / step.norm().max(0.05));
    (Unit::new_normalize(center.into_inner() + basis * step), inverse * spread * inverse)
}

/// The centre's part of the unknowns of rotation and centre once the rotation follows the centre (Schur complement).
fn without_rotation(information: &Matrix5<f64>) -> Option<Matrix2x5<f64>> {
    let rr: Matrix3<f64> = information.fixed_view::<3, 3>(0, 0).into_owned();
    let cr: Matrix2x3<f64> = information.fixed_view::<2, 3>(3, 0).into_owned();
    let mut by_center = Matrix2x5::zeros();
    by_center.fixed_columns_mut::<3>(0).copy_from(&-(cr * rr.try_inverse()?));
    by_center.fixed_columns_mut::<2>(3).copy_from(&Matrix2::identity());
    Some(by_center)
}

/// Rotation rate of a pair, rad/s, in the first camera's axes.
fn rate(found: &Option<AboutCenter>, pair: &CenteredPair) -> Option<Vector3<f64>> {
    found.map(|f| so3::log(&f.rotation) / pair.dt_s)
}

/// Component-wise median of the rates of a pair's solved neighbours (at most three on each side), itself left out.
fn neighbours_rate(rates: &[Option<Vector3<f64>>], index: usize) -> Option<Vector3<f64>> {
    let before = rates[..index].iter().rev().flatten().take(3);
    let near: Vec<&Vector3<f64>> = before.chain(rates[index + 1..].iter().flatten().take(3)).collect();
    let along = |i: usize| median(&mut near.iter().map(|r| r[i]).collect::<Vec<f64>>());
    if near.len() < 2 {
        return None;
    }
    Some(Vector3::new(along(0)?, along(1)?, along(2)?))
}

fn is_stray(rate: &Vector3<f64>, expected: &Vector3<f64>, config: &FixedCenterConfig) -> bool {
    (rate - expected).norm() > config.rate_gate_rad_s.max(config.rate_gate_ratio * expected.norm())
}

/// Forgets the rotations that leave their neighbours' median.
fn drop_strays(found: &mut [Option<AboutCenter>], pairs: &[CenteredPair], config: &FixedCenterConfig) {
    let rates: Vec<_> = found.iter().zip(pairs).map(|(f, p)| rate(f, p)).collect();
    for (index, slot) in found.iter_mut().enumerate() {
        let both = rates[index].zip(neighbours_rate(&rates, index));
        if both.is_some_and(|(own, expected)| is_stray(&own, &expected, config)) {
            *slot = None;
        }
    }
}

/// Solves the forgotten pairs from their neighbours' median rate; what strays again stays unsolved.
fn solve_again(
    found: &mut [Option<AboutCenter>],
    views: &[CenterView],
    pairs: &[CenteredPair],
    (center, problem): (Unit<Vector3<f64>>, &CenterProblem),
) {
    let rates: Vec<_> = found.iter().zip(pairs).map(|(f, p)| rate(f, p)).collect();
    for (index, slot) in found.iter_mut().enumerate().filter(|(_, slot)| slot.is_none()) {
        let Some(expected) = neighbours_rate(&rates, index) else { continue };
        let starts = [1.0, 0.9, 1.1].map(|k| so3::exp(&(expected * pairs[index].dt_s * k)));
        let again = best_start(&views[index], center, &starts, problem.rotation);
        *slot = again.filter(|f| !is_stray(&(so3::log(&f.rotation) / pairs[index].dt_s), &expected, problem.config));
    }
}

/// Holds a solved pair against every gate; its covariance includes that of the centre.
fn finish(
    view: &CenterView,
    found: Option<AboutCenter>,
    center_covariance: &Matrix2<f64>,
    problem: &CenterProblem,
) -> PairSolution {
    let config = problem.rotation;
    let refused = |status| PairSolution::failed(status, view.offered);
    let Some(model) = found else {
        return refused(view.failure.unwrap_or(PairStatus::Rejected));
    };
    let fitted = fit(model, &view.normalized, view.widest);
    let enough = (config.min_inlier_ratio * view.offered as f64).max(config.min_matches as f64);
    if (fitted.inlier_count() as f64) < enough || !is_near_side(&fitted.model, &view.normalized) {
        return refused(PairStatus::Rejected);
    }
    let noise = &problem.config.noise;
    let size = Size { share: noise.correlated_error_share, over_likeliest: noise.over_likeliest };
    let Some(refined) = refine(&fitted, &view.normalized, size) else { return refused(PairStatus::Degenerate) };
    let full = observed_information(
        &WithCenter(refined.model),
        &fitted.agreeing(&view.normalized),
        Loss::Truncated(f64::INFINITY),
    );
    let rr: Matrix3<f64> = full.fixed_view::<3, 3>(0, 0).into_owned();
    let rc: Matrix3x2<f64> = full.fixed_view::<3, 2>(0, 3).into_owned();
    let by_center = rr.try_inverse().unwrap_or_else(Matrix3::zeros) * rc;
    let covariance = refined.rotation_covariance_rad2 + by_center * center_covariance * by_center.transpose();
    if covariance.symmetric_eigenvalues().max().sqrt() > config.max_sigma_rad {
        return refused(PairStatus::Degenerate);
    }
    PairSolution {
        camera_to_from_camera_from: refined.model.rotation,
        covariance_rad2: covariance,
        direction_in_to: Unit::try_new(refined.model.translation(), 1e-12),
        normal_in_from: None,
        inliers: view.spread(&fitted.inliers),
        noise_scale: fitted.scale,
        model: RotationModel::FixedCenter,
        status: PairStatus::Ok,
    }
}
