//! One image at a time: shooting over the first arc, then a filter that stores the attitudes of earlier images, so
//! that a pair is a measurement between two stored attitudes and errors along the chain are accounted for.

use crate::geometry::Manifold;
use crate::geometry::so3::log;
use crate::navigation::filter::{Innovation, correction};
use crate::navigation::tumbling::bounds::{INERTIA_UNIT, UndeterminedDirection, weak_ratios};
use crate::navigation::tumbling::config::TumblingConfig;
use crate::navigation::tumbling::error::TumblingError;
use crate::navigation::tumbling::motion::{InertiaRatios, SpinState, propagate};
use crate::navigation::tumbling::pair::RotationPair;
use crate::navigation::tumbling::result::{InertiaKnowledge, PairCount, TumblingEpoch, TumblingResult};
use crate::navigation::tumbling::shooting::{ShootingFit, seconds, shoot, shooting_epochs};
use nalgebra::{DMatrix, Matrix3, SMatrix, UnitQuaternion, Vector3, Vector6};
use smallvec::smallvec;

/// Size of (attitude error in inertial axes, rate error, ratio errors).
const CORE: usize = 11;

/// Fewest images of the arc that starts the filter.
const LEAST_FIRST_IMAGES: usize = 60;

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
        let lost = TumblingError::Diverged { t_ns: frame_times_ns[k] };
        filter = filter.predict(times_s[k] - times_s[k - 1]).ok_or(lost)?;
        filter = pairs.iter().filter(|p| p.to == k).fold(filter, CloneFilter::correct).stored(k, pairs);
        epochs.push(filter.epoch(frame_times_ns[k]));
    }
    let used = shot.pairs_used + filter.accepted;
    let squares = filter.squares + shot.residual_rms_sigma.powi(2) * 3.0 * shot.pairs_used as f64;
    let count = PairCount { used, given: pairs.len(), residual_rms_sigma: (squares / (3.0 * used as f64)).sqrt() };
    let (covariance, undetermined) = (filter.ratio_covariance(), filter.undetermined());
    Ok(TumblingResult::new(epochs, &filter.inertia, &covariance, undetermined, count))
}

/// The fit of the first arc, and its number of images; all of them if the inertia is never well determined.
fn shoot_until_determined(
    pairs: &[RotationPair],
    times_s: &[f64],
    config: &TumblingConfig,
) -> Result<(ShootingFit, usize), TumblingError> {
    let within = times_s.partition_point(|&t| t <= config.realtime_start_s);
    let mut first = within.max(LEAST_FIRST_IMAGES).min(times_s.len());
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
    /// Starts at the last image of the first arc. Images of the arc that later pairs start from are stored too; all
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
    fn predict(mut self, dt_s: f64) -> Option<Self> {
        let next = propagate(&self.state, &self.inertia, &[0.0, dt_s])?.pop()?;
        let mut transition = SMatrix::<f64, CORE, CORE>::identity();
        transition.fixed_view_mut::<6, 8>(0, 3).copy_from(&next.sensitivity);
        let moved = transition * self.covariance.rows(0, CORE);
        self.covariance.rows_mut(0, CORE).copy_from(&moved);
        let moved = self.covariance.columns(0, CORE) * transition.transpose();
        self.covariance.columns_mut(0, CORE).copy_from(&moved);
        Some(CloneFilter { state: next.state, ..self })
    }

    /// The filter after a pair into the present image; as it was if the first image is not stored or the pair fails
    /// the gate.
    fn correct(self, pair: &RotationPair) -> Self {
        let Some(slot) = self.stored.iter().position(|s| s.frame == pair.from) else { return self };
        let predicted = self.state.asteroid_from_inertial.inverse() * self.stored[slot].asteroid_from_inertial;
        // With A = Â exp(d), the prediction turns by -d_now + R̂ d_stored.
        let by_stored = predicted.to_rotation_matrix().into_inner();
        let innovation = Innovation::<3, 3> {
            residual: log(&(pair.measured * predicted.inverse())),
            jacobian: smallvec![(0, -Matrix3::identity()), (CORE + 3 * slot, by_stored)],
            noise: pair.covariance_rad2,
        };
        let Some(square) = innovation.normalized_squared(&self.covariance) else { return self };
        if square > self.config.reject_sigma.powi(2) {
            return self;
        }
        let Some(after) = correction(self.covariance.clone(), &[innovation]) else { return self };
        let moved = self.moved(&after.shift);
        CloneFilter {
            covariance: after.covariance,
            accepted: moved.accepted + 1,
            squares: moved.squares + square,
            ..moved
        }
    }

    /// The states moved by an error.
    fn moved(mut self, error: &[f64]) -> Self {
        self.state = self.state.plus(&Vector6::from_column_slice(&error[..6]));
        self.inertia = InertiaRatios(std::array::from_fn(|i| self.inertia.0[i] + error[6 + i]));
        for (stored, d) in self.stored.iter_mut().zip(error[CORE..].chunks_exact(3)) {
            stored.asteroid_from_inertial = stored.asteroid_from_inertial.plus(&Vector3::from_column_slice(d));
        }
        self
    }

    /// The filter that keeps the present attitude if a later pair starts from it, and has forgotten those no longer needed,
    /// or the oldest.
    fn stored(self, now: usize, pairs: &[RotationPair]) -> Self {
        let needed = |frame: usize| pairs.iter().any(|p| p.from == frame && p.to > now);
        let mut kept = self;
        while let Some(slot) = kept.stored.iter().position(|s| !needed(s.frame)) {
            kept = kept.without(slot);
        }
        if !needed(now) {
            return kept;
        }
        if kept.stored.len() >= kept.config.realtime_clones {
            kept = kept.without(0);
        }
        let size = kept.covariance.nrows();
        let mut grown = kept.covariance.resize(size + 3, size + 3, 0.0);
        let copied = grown.rows(0, 3).into_owned();
        grown.rows_mut(size, 3).copy_from(&copied);
        let copied = grown.columns(0, 3).into_owned();
        grown.columns_mut(size, 3).copy_from(&copied);
        kept.stored.push(Stored { frame: now, asteroid_from_inertial: kept.state.asteroid_from_inertial });
        CloneFilter { covariance: grown, ..kept }
    }

    fn without(mut self, slot: usize) -> Self {
        let first = CORE + 3 * slot;
        self.stored.remove(slot);
        CloneFilter { covariance: self.covariance.remove_rows(first, 3).remove_columns(first, 3), ..self }
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
