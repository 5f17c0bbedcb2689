//! One picture at a time: shooting over the first arc, then a filter that stores the attitudes of earlier pictures, so
//! that a pair is a measurement between two stored attitudes and errors along the chain are accounted for.

use crate::geometry::Manifold;
use crate::geometry::so3::log;
use crate::navigation::tumbling::bounds::{INERTIA_UNIT, UndeterminedDirection, weak_ratios};
use crate::navigation::tumbling::config::TumblingConfig;
use crate::navigation::tumbling::error::TumblingError;
use crate::navigation::tumbling::estimate::symmetric;
use crate::navigation::tumbling::motion::{InertiaRatios, SpinState, propagate};
use crate::navigation::tumbling::pair::RotationPair;
use crate::navigation::tumbling::result::{InertiaKnowledge, PairCount, TumblingEpoch, TumblingResult};
use crate::navigation::tumbling::shooting::{ShootingFit, seconds, shoot, shooting_epochs};
use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, UnitQuaternion, Vector3, Vector6};

/// Size of (attitude error in inertial axes, rate error, ratio errors).
const CORE: usize = 11;

/// Fewest pictures of the arc that starts the filter.
const LEAST_FIRST_PICTURES: usize = 60;

/// How many times the information that counts as determined the filter asks for, so that its linearisation holds.
const INFORMATION_MARGIN: f64 = 10.0;

/// Shooting until [`TumblingConfig::realtime_start_s`] (longer, while the inertia is not well determined), then the
/// filter; epochs before are the first fit's.
///
/// # Errors
/// What shooting says of the first arc; a filter that lost the motion.
pub fn filter_after_first_arc(
    pairs: &[RotationPair],
    frame_times_ns: &[i64],
    config: &TumblingConfig,
) -> Result<TumblingResult, TumblingError> {
    let times_s = seconds(frame_times_ns);
    let (shot, first) = shoot_until_determined(pairs, &times_s, config)?;
    let mut epochs = shooting_epochs(&shot, &frame_times_ns[..first]);
    let mut filter = CloneFilter::start(&shot, pairs, config);
    for k in first..times_s.len() {
        filter.predict(times_s[k] - times_s[k - 1]).ok_or(TumblingError::Diverged { t_ns: frame_times_ns[k] })?;
        for pair in pairs.iter().filter(|p| p.to == k) {
            filter.correct(pair);
        }
        filter.store(k, pairs);
        epochs.push(filter.epoch(frame_times_ns[k]));
    }
    let used = shot.pairs_used + filter.accepted;
    let squares = filter.squares + shot.residual_rms_sigma.powi(2) * 3.0 * shot.pairs_used as f64;
    let count = PairCount { used, given: pairs.len(), residual_rms_sigma: (squares / (3.0 * used as f64)).sqrt() };
    let (covariance, undetermined) = (filter.ratio_covariance(), filter.undetermined());
    Ok(TumblingResult::new(epochs, &filter.inertia, &covariance, undetermined, count))
}

/// The fit of the first arc, and its number of pictures; all of them if the inertia is never well determined.
fn shoot_until_determined(
    pairs: &[RotationPair],
    times_s: &[f64],
    config: &TumblingConfig,
) -> Result<(ShootingFit, usize), TumblingError> {
    let within = times_s.partition_point(|&t| t <= config.realtime_start_s);
    let mut first = within.max(LEAST_FIRST_PICTURES).min(times_s.len());
    loop {
        let early: Vec<RotationPair> = pairs.iter().filter(|p| p.to < first).cloned().collect();
        let shot = shoot(&early, &times_s[..first], config)?;
        if first == times_s.len() || shot.determines_inertia(INFORMATION_MARGIN * config.least_information) {
            return Ok((shot, first));
        }
        first = ((first as f64 * config.growth).ceil() as usize).min(times_s.len());
    }
}

/// An attitude kept for later pairs.
struct Stored {
    frame: usize,
    asteroid_from_inertial: UnitQuaternion<f64>,
}

/// Filter over the present state, the ratios and the stored attitudes; every attitude error is in inertial axes.
struct CloneFilter {
    state: SpinState,
    inertia: InertiaRatios,
    stored: Vec<Stored>,
    covariance: DMatrix<f64>,
    config: TumblingConfig,
    accepted: usize,
    squares: f64,
}

impl CloneFilter {
    /// Starts at the last picture of the first arc. Pictures of the arc that later pairs start from are stored too; all
    /// errors come from the same eight unknowns.
    fn start(shot: &ShootingFit, pairs: &[RotationPair], config: &TumblingConfig) -> Self {
        let points = &shot.fit.points;
        let last = points.len() - 1;
        let needed = |frame: &usize| pairs.iter().any(|p| p.from == *frame && p.to > last);
        let mut frames: Vec<usize> = (0..=last).filter(needed).collect();
        frames.drain(..frames.len().saturating_sub(config.realtime_clones));
        let mut by_unknowns = DMatrix::zeros(CORE + 3 * frames.len(), 8);
        by_unknowns.view_mut((0, 0), (6, 8)).copy_from(&points[last].sensitivity);
        by_unknowns.view_mut((6, 3), (5, 5)).fill_with_identity();
        for (slot, &frame) in frames.iter().enumerate() {
            by_unknowns.rows_mut(CORE + 3 * slot, 3).copy_from(&points[frame].sensitivity.fixed_rows::<3>(0));
        }
        let stored = frames
            .iter()
            .map(|&frame| Stored { frame, asteroid_from_inertial: points[frame].state.asteroid_from_inertial });
        CloneFilter {
            state: points[last].state,
            inertia: shot.fit.inertia,
            stored: stored.collect(),
            covariance: &by_unknowns * shot.covariance * by_unknowns.transpose(),
            config: *config,
            accepted: 0,
            squares: 0.0,
        }
    }

    /// The free-body motion, without process noise: the dynamics are exact.
    fn predict(&mut self, dt_s: f64) -> Option<()> {
        let next = propagate(&self.state, &self.inertia, &[0.0, dt_s])?.pop()?;
        let mut transition = SMatrix::<f64, CORE, CORE>::identity();
        transition.fixed_view_mut::<6, 8>(0, 3).copy_from(&next.sensitivity);
        let moved = transition * self.covariance.rows(0, CORE);
        self.covariance.rows_mut(0, CORE).copy_from(&moved);
        let moved = self.covariance.columns(0, CORE) * transition.transpose();
        self.covariance.columns_mut(0, CORE).copy_from(&moved);
        self.state = next.state;
        Some(())
    }

    /// Corrects by a pair into the present picture, unless its first picture is not stored or it fails the gate.
    fn correct(&mut self, pair: &RotationPair) {
        let Some(slot) = self.stored.iter().position(|s| s.frame == pair.from) else { return };
        let predicted = self.state.asteroid_from_inertial.inverse() * self.stored[slot].asteroid_from_inertial;
        let innovation: Vector3<f64> = log(&(pair.measured * predicted.inverse()));
        // With A = Â exp(d), the prediction turns by -d_now + R̂ d_stored.
        let column = CORE + 3 * slot;
        let by_stored = predicted.to_rotation_matrix().into_inner();
        let h_p = by_stored * self.covariance.rows(column, 3) - self.covariance.rows(0, 3);
        let p_ht = h_p.transpose();
        let s: Matrix3<f64> =
            (by_stored * p_ht.rows(column, 3) - p_ht.rows(0, 3)).fixed_view::<3, 3>(0, 0) + pair.covariance_rad2;
        let Some(s_inverse) = symmetric(&s).cholesky().map(|c| c.inverse()) else { return };
        let square = innovation.dot(&(s_inverse * innovation));
        if square > self.config.reject_sigma.powi(2) {
            return;
        }
        let gain = &p_ht * s_inverse;
        self.apply(&(&gain * innovation));
        self.covariance -= &gain * h_p;
        self.covariance = (&self.covariance + self.covariance.transpose()) * 0.5;
        self.accepted += 1;
        self.squares += square;
    }

    fn apply(&mut self, correction: &DVector<f64>) {
        self.state = self.state.plus(&Vector6::from_fn(|i, _| correction[i]));
        self.inertia = InertiaRatios(std::array::from_fn(|i| self.inertia.0[i] + correction[6 + i]));
        for (slot, stored) in self.stored.iter_mut().enumerate() {
            let d = Vector3::from_fn(|i, _| correction[CORE + 3 * slot + i]);
            stored.asteroid_from_inertial = stored.asteroid_from_inertial.plus(&d);
        }
    }

    /// Keeps the present attitude if a later pair starts from it, and forgets those no longer needed, or the oldest.
    fn store(&mut self, now: usize, pairs: &[RotationPair]) {
        let needed = |frame: usize| pairs.iter().any(|p| p.from == frame && p.to > now);
        while let Some(slot) = self.stored.iter().position(|s| !needed(s.frame)) {
            self.forget(slot);
        }
        if !needed(now) {
            return;
        }
        if self.stored.len() >= self.config.realtime_clones {
            self.forget(0);
        }
        let size = self.covariance.nrows();
        let mut grown = self.covariance.clone().resize(size + 3, size + 3, 0.0);
        let copied = grown.rows(0, 3).into_owned();
        grown.rows_mut(size, 3).copy_from(&copied);
        let copied = grown.columns(0, 3).into_owned();
        grown.columns_mut(size, 3).copy_from(&copied);
        self.covariance = grown;
        self.stored.push(Stored { frame: now, asteroid_from_inertial: self.state.asteroid_from_inertial });
    }

    fn forget(&mut self, slot: usize) {
        let first = CORE + 3 * slot;
        self.covariance = self.covariance.clone().remove_rows(first, 3).remove_columns(first, 3);
        self.stored.remove(slot);
    }

    fn ratio_covariance(&self) -> SMatrix<f64, 5, 5> {
        self.covariance.fixed_view::<5, 5>(6, 6).into_owned()
    }

    /// The same rule as for an arc, on the information left when the rate is unknown too.
    fn undetermined(&self) -> Vec<UndeterminedDirection> {
        let information = self.ratio_covariance().try_inverse().unwrap_or_else(SMatrix::zeros) * INERTIA_UNIT.powi(2);
        weak_ratios(&information, self.config.least_information)
    }

    fn epoch(&self, t_ns: i64) -> TumblingEpoch {
        TumblingEpoch {
            t_ns,
            asteroid_from_inertial: self.state.asteroid_from_inertial,
            rate_in_asteroid_rad_s: self.state.rate_in_asteroid_rad_s,
            covariance: self.covariance.fixed_view::<6, 6>(0, 0).into_owned(),
            inertia: InertiaKnowledge::new(&self.inertia, &self.ratio_covariance(), &self.undetermined()),
        }
    }
}
