//! A whole descent.

use super::config::LandingConfig;
use super::error::LandingError;
use super::error_state::{BIASES, DescentEstimate};
use super::inertial::{ImuIncrement, ImuRecord};
use super::input::LandingInput;
use super::propagation::predict;
use super::result::{ImuGap, LandingEpoch, LandingResult};
use super::step::{FrameInput, Navigator, StepReport, step};
use crate::observations::TrackObservation;

/// Spacing of the epochs after the last frame, ns.
const COAST_STEP_NS: i64 = 1_000_000_000;

/// Estimates the lander's motion from IMU samples and tracks; `progress` hears the number of frames done.
///
/// # Errors
/// [`LandingError`] for input or options that cannot be used. Missing images and wrong tracks are no errors: the filter
/// then coasts on the IMU, and the result says when.
pub fn navigate(
    input: &LandingInput,
    config: &LandingConfig,
    progress: &dyn Fn(usize),
) -> Result<LandingResult, LandingError> {
    config.validate()?;
    input.validate()?;
    let imu = ImuRecord { samples: &input.imu, noise: &input.imu_noise };
    let mount = input.mount();
    let mut navigator = Navigator::new(&input.initial, config);
    let mut result = LandingResult::default();
    let mut last_ns = input.initial.t_ns;
    for (index, t_ns) in input.frame_times_ns.iter().copied().enumerate() {
        let increment = imu.between(last_ns, t_ns, &navigator.biases())?;
        result.add_gap(&increment, (last_ns, t_ns));
        let seen = at_time(&input.observations, t_ns, |o| o.t_ns);
        let known = at_time(&input.known, t_ns, |k| k.t_ns);
        let tracked = seen.iter().filter_map(|o| mount.bearing(o, config.sigma_floor_px));
        let bearings: Vec<_> =
            tracked.chain(known.iter().filter_map(|k| mount.known_bearing(k, config.sigma_floor_px))).collect();
        result.unusable_pixels += seen.len() + known.len() - bearings.len();
        let rotation = at_time(&input.rotations, t_ns, |r| r.to_t_ns).iter().find(|r| r.from_t_ns == last_ns).copied();
        let frame = FrameInput { increment, bearings, rotation };
        let (after, report) = step(navigator, &frame, &mount, config).ok_or(LandingError::BrokeDown { t_ns })?;
        result.add(epoch(t_ns, &after, &report, config), last_ns);
        (navigator, last_ns) = (after, t_ns);
        progress(index + 1);
    }
    coast(&mut result, navigator, &imu, config)?;
    Ok(result)
}

/// On the IMU alone from the last frame to the last sample.
fn coast(
    result: &mut LandingResult,
    mut navigator: Navigator,
    imu: &ImuRecord<'_>,
    config: &LandingConfig,
) -> Result<(), LandingError> {
    let end_ns = imu.samples.last().map_or(i64::MIN, |s| s.t_ns);
    let mut last_ns = result.epochs.last().map_or(end_ns, |e| e.t_ns);
    while last_ns < end_ns {
        let t_ns = (last_ns + COAST_STEP_NS).min(end_ns);
        let increment = imu.between(last_ns, t_ns, &navigator.biases())?;
        result.add_gap(&increment, (last_ns, t_ns));
        navigator.estimate = predict(navigator.estimate, &increment, &config.planet(), config.filter);
        result.add(epoch(t_ns, &navigator, &StepReport::default(), config), last_ns);
        last_ns = t_ns;
    }
    Ok(())
}

/// What a list in order of time holds of one time.
fn at_time<T>(list: &[T], t_ns: i64, time_of: impl Fn(&T) -> i64) -> &[T] {
    let start = list.partition_point(|entry| time_of(entry) < t_ns);
    let end = list.partition_point(|entry| time_of(entry) <= t_ns);
    &list[start..end]
}

fn epoch(t_ns: i64, navigator: &Navigator, report: &StepReport, config: &LandingConfig) -> LandingEpoch {
    let state = &navigator.estimate.state;
    let unknown_tracks: Vec<u64> =
        state.landmarks.iter().map(|l| l.track_id).filter(|id| *id != TrackObservation::DESIGNATED).collect();
    LandingEpoch {
        t_ns,
        site_from_lander: state.site_from_lander(),
        lander_velocity_in_site_m_s: state.lander_velocity_in_site_m_s,
        covariance: config.filter.site_covariance(&navigator.estimate),
        designated_in_site_m: state
            .landmark_of(TrackObservation::DESIGNATED)
            .map_or_else(nalgebra::Vector3::zeros, |index| state.landmarks[index].position_in_site_m),
        normalized_innovation_squared: report.normalized_innovation_squared,
        innovation_dof: 2 * report.used(),
        gated: report.outcomes.len() - report.used(),
        known_seen: report.outcomes.iter().any(|o| o.used && !o.known && o.track_id == TrackObservation::DESIGNATED),
        contradiction: navigator.contradiction,
        known_points: report.outcomes.iter().filter(|o| o.used && o.known).count(),
        rotation_check: report.rotation_check,
        biases: state.biases.map(|biases| (biases, bias_sigma(&navigator.estimate))),
        unknown_track: unknown_tracks.first().copied(),
        unknown_tracks,
    }
}

/// 1σ of the biases, gyroscope (rad/s) first.
fn bias_sigma(estimate: &DescentEstimate) -> [f64; 6] {
    std::array::from_fn(|k| estimate.covariance[(BIASES + k, BIASES + k)].max(0.0).sqrt())
}

impl LandingResult {
    /// Notes a time without IMU samples.
    fn add_gap(&mut self, increment: &ImuIncrement, interval_ns: (i64, i64)) {
        if increment.bridged_s > 0.0 {
            self.imu_gaps.push(ImuGap { interval_ns, bridged_s: increment.bridged_s });
        }
    }

    /// Appends an epoch; without a used bearing it lengthens the coasted stretch since `last_ns`, or begins one.
    fn add(&mut self, epoch: LandingEpoch, last_ns: i64) {
        let used = epoch.innovation_dof / 2;
        if used == 0 {
            match self.coasted.last_mut().filter(|stretch| stretch.1 == last_ns) {
                Some(stretch) => stretch.1 = epoch.t_ns,
                None => self.coasted.push((last_ns.min(epoch.t_ns), epoch.t_ns)),
            }
        }
        self.used += used;
        self.gated += epoch.gated;
        self.epochs.push(epoch);
    }
}
