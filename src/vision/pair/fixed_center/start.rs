//! Starts of the fixed-centre model: many rotations are tried, and those that put the surface behind the camera or
//! beyond the centre are refused.

use super::problem::{CenterProblem, CenteredPair};
use crate::geometry::so3;
use crate::observations::PairStatus;
use crate::stats::upper_median;
use crate::vision::pair::cheirality::Cheirality;
use crate::vision::pair::config::RotationConfig;
use crate::vision::pair::models::AboutCenter;
use crate::vision::pair::normalized_match::{NormalizedMatch, normalized};
use crate::vision::pair::parallax_gate::passes_parallax_gate;
use crate::vision::pair::robust_fit::{Loss, cost, descend, fit};
use crate::vision::pair::usac;
use nalgebra::{Unit, UnitQuaternion, Vector3};

/// A pair ready to be solved.
pub(super) struct CenterView {
    /// Plausible matches.
    pub(super) normalized: Vec<NormalizedMatch>,
    /// Which of the offered matches they are.
    pub(super) kept: Vec<bool>,
    /// Matches offered.
    pub(super) offered: usize,
    /// Inlier threshold in units of the nominal σ.
    pub(super) widest: f64,
    /// Why the pair cannot be solved.
    pub(super) failure: Option<PairStatus>,
    predicted: Option<UnitQuaternion<f64>>,
    five_point: Vec<UnitQuaternion<f64>>,
}

impl CenterView {
    pub(super) fn new(pair: &CenteredPair, problem: &CenterProblem) -> Self {
        let config = problem.rotation;
        let all = normalized(pair.matches.pair, pair.matches.sigma_px, problem.camera);
        let usable: Vec<NormalizedMatch> = all.iter().flatten().copied().collect();
        let mut sigma: Vec<f64> = pair.matches.sigma_px.to_vec();
        let widest = 2.0 * config.threshold_px / upper_median(&mut sigma).unwrap_or(config.sigma_px);
        let mut view = CenterView {
            normalized: Vec::new(),
            kept: vec![false; all.len()],
            offered: all.len(),
            widest,
            failure: (usable.len() < config.min_matches).then_some(PairStatus::FewMatches),
            predicted: pair.predicted,
            five_point: Vec::new(),
        };
        if view.failure.is_none() {
            view.select(&all, &usable, problem);
        }
        view
    }

    /// The same pair with at most `count` of its matches, evenly chosen.
    pub(super) fn thinned(&self, count: usize) -> Self {
        let step = self.normalized.len().div_ceil(count).max(1);
        CenterView {
            normalized: self.normalized.iter().step_by(step).copied().collect(),
            kept: Vec::new(),
            five_point: self.five_point.clone(),
            ..*self
        }
    }

    fn select(&mut self, all: &[Option<NormalizedMatch>], usable: &[NormalizedMatch], problem: &CenterProblem) {
        let (focal_px, config) = (problem.camera.mean_focal_px(), problem.rotation);
        if is_still(usable) {
            self.failure = Some(PairStatus::NoMotion);
            return;
        }
        let essential = usac::essential(usable, focal_px, config).ok().flatten();
        let planes = usac::homography(usable, focal_px, config).map(|h| usac::planes(&h)).unwrap_or_default();
        let flags = passes_parallax_gate(usable, &planes, essential.as_ref(), self.widest);
        self.normalized = usable.iter().zip(&flags).filter(|(_, keep)| **keep).map(|(s, _)| *s).collect();
        let mut flags = flags.iter();
        self.kept = all.iter().map(|s| s.is_some() && *flags.next().unwrap_or(&false)).collect();
        let motions = essential.as_ref().map(usac::motions).unwrap_or_default();
        let turns = motions.iter().map(|m| m.rotation).chain(planes.iter().map(|p| p.rotation));
        self.five_point = turns.filter(|q| q.angle() < config.max_angle_rad).collect();
    }

    /// The prediction alone where there is one, else rotations about all axes by small and large angles.
    pub(super) fn predicted_starts(&self) -> Vec<UnitQuaternion<f64>> {
        if let Some(predicted) = self.predicted {
            return vec![predicted];
        }
        let mut starts = self.five_point.clone();
        let axes = [
            Vector3::x(),
            Vector3::y(),
            Vector3::z(),
            Vector3::new(1.0, 1.0, 0.0).normalize(),
            Vector3::new(1.0, -1.0, 0.0).normalize(),
        ];
        for angle_rad in [1.5f64, 5.0, 12.0].map(f64::to_radians) {
            starts.extend(axes.iter().flat_map(|a| [so3::exp(&(a * angle_rad)), so3::exp(&(a * -angle_rad))]));
        }
        starts
    }

    /// Flags of the passes_parallax_gate matches, spread over all offered.
    pub(super) fn spread(&self, flags: &[bool]) -> Vec<bool> {
        let mut flags = flags.iter();
        self.kept.iter().map(|k| *k && *flags.next().unwrap_or(&false)).collect()
    }
}

/// Whether the matches show no motion: their median displacement is below twice its noise.
fn is_still(normalized: &[NormalizedMatch]) -> bool {
    let mut sizes: Vec<f64> = normalized
        .iter()
        .map(|s| (s.to - s.from).norm_squared() / (s.from_covariance + s.to_covariance).trace().max(1e-300))
        .collect();
    upper_median(&mut sizes).is_some_and(|middle| middle < 4.0)
}

/// The best rotation about `center` from several starts; `None` where none is acceptable.
pub(super) fn best_start(
    view: &CenterView,
    center: Unit<Vector3<f64>>,
    starts: &[UnitQuaternion<f64>],
    config: &RotationConfig,
) -> Option<AboutCenter> {
    const SCREENING: usize = 100;
    if view.failure.is_some() || view.normalized.len() < config.min_matches {
        return None;
    }
    let few: Vec<NormalizedMatch> =
        view.normalized.iter().step_by(view.normalized.len().div_ceil(SCREENING)).copied().collect();
    let loss = Loss::Cauchy(view.widest);
    let mut screened: Vec<(f64, AboutCenter)> = Vec::new();
    for rotation in starts {
        let end = descend(AboutCenter { rotation: *rotation, center }, &few, loss, 12);
        let model = end.state;
        let known = |m: &AboutCenter| so3::log(&(m.rotation * model.rotation.inverse())).norm() < 1e-3;
        let acceptable = model.rotation.angle() < config.max_angle_rad && is_near_side(&model, &few);
        if acceptable && !screened.iter().any(|(_, m)| known(m)) {
            screened.push((end.normal.cost, model));
        }
    }
    screened.sort_by(|a, b| a.0.total_cmp(&b.0));
    let refined = screened.into_iter().take(2).map(|(_, m)| fit(m, &view.normalized, view.widest).model);
    let acceptable = refined.filter(|m| is_near_side(m, &view.normalized));
    acceptable.min_by(|a, b| {
        let c = |m: &AboutCenter| cost::<3, _>(m, &view.normalized, Loss::Truncated(view.widest / 2.0));
        c(a).total_cmp(&c(b))
    })
}

/// Whether the surface lies in front of both cameras, and most of it nearer than the centre: what one sees of a body is
/// its near side. The reversed solution of a narrow field of view (Necker's) puts it beyond.
pub(super) fn is_near_side(model: &AboutCenter, normalized: &[NormalizedMatch]) -> bool {
    let t = model.translation();
    let (mut near, mut seen) = (0, 0);
    for s in normalized {
        let (a, b) = ((model.rotation * s.first_ray()).normalize(), s.second_ray().normalize());
        let across = a.cross(&b);
        if across.norm_squared() < 16.0 * (s.from_covariance.trace() + s.to_covariance.trace()) {
            continue;
        }
        let range = b.cross(&t).dot(&across) / across.norm_squared();
        seen += 1;
        near += usize::from(range > 0.0 && range < 1.0);
    }
    near * 2 >= seen && !Cheirality::of(model.rotation, &t, normalized).contradicts()
}
