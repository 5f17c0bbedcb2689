//! One image of the descent.

use super::correct::{CorrectionModel, Outcome, correct};
use super::designated::with_designated_errors;
use super::imu::ImuIncrement;
use super::measurement::{BearingObservation, CameraMount};
use super::predict::predict;
use super::recovery::Contradiction;
use super::select::{Selection, with_chosen, without_lost};
use super::{DescentEstimate, LandingConfig};
use std::collections::BTreeSet;

/// What is carried from image to image.
#[derive(Debug, Clone, PartialEq)]
pub struct Navigator {
    /// The estimate.
    pub estimate: DescentEstimate,
    /// Whether an image has corrected it yet.
    pub corrected: bool,
    /// Contradictions with the known landmark.
    pub contradiction: Contradiction,
    /// Tracks that have been landmarks before: their ground height must not be counted twice.
    pub spent_tracks: BTreeSet<u64>,
    /// Number of images so far.
    pub images: u64,
}

/// What one image brings.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameInput {
    /// IMU motion since the last image.
    pub increment: ImuIncrement,
    /// Bearings of every track seen.
    pub bearings: Vec<BearingObservation>,
}

/// What became of one image.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StepReport {
    /// The landmarks' bearings, used and gated.
    pub outcomes: Vec<Outcome>,
    /// Joint normalised innovation squared of those used.
    pub normalized_innovation_squared: Option<f64>,
}

impl StepReport {
    /// Number of bearings used.
    pub fn used(&self) -> usize {
        self.outcomes.iter().filter(|o| o.used).count()
    }
}

/// One image: propagate by the IMU (equations (1) to (10) of Li et al. 2023), correct by the bearings of the known
/// landmark and of the unknown ones ((11) to (18)), drop the landmarks that have served (fig. 3), choose new ones ((26))
/// and place them on the ground. `None` if the covariance is no longer positive definite.
pub fn step(
    before: &Navigator,
    frame: &FrameInput,
    mount: &CameraMount,
    config: &LandingConfig,
) -> Option<(Navigator, StepReport)> {
    let predicted = predict(&before.estimate, &frame.increment, &config.gravity_in_site_m_s2(), config.filter);
    let bearings = usable(&predicted, &frame.bearings, config);
    let prior =
        with_designated_errors(before.contradiction.resolved(predicted, config.filter), bearings, mount, config);
    let corrected = correct(&prior, bearings, &correction_model(before, mount, config))?;
    let report = StepReport {
        outcomes: corrected.outcomes,
        normalized_innovation_squared: corrected.normalized_innovation_squared,
    };
    let mut after = Navigator { estimate: corrected.estimate, images: before.images + 1, ..before.clone() };
    after.corrected |= report.used() > 0;
    after.contradiction = before.contradiction.after(&report.outcomes);
    if after.corrected && !bearings.is_empty() {
        after = without_lost(&after, bearings);
        after = with_chosen(&after, bearings, &Selection::new(&after, frame, mount, config));
    }
    Some((after, report))
}

/// The bearings if the lander is high enough for images, by its estimate; none otherwise.
fn usable<'a>(
    estimate: &DescentEstimate,
    bearings: &'a [BearingObservation],
    config: &LandingConfig,
) -> &'a [BearingObservation] {
    if estimate.state.lander_in_site_m.z >= config.minimum_image_height_m { bearings } else { &[] }
}

fn correction_model(navigator: &Navigator, mount: &CameraMount, config: &LandingConfig) -> CorrectionModel {
    CorrectionModel {
        kind: config.filter,
        gate: config.gate(),
        iterations: if navigator.corrected { 1 } else { config.first_iterations },
        camera_in_lander_m: mount.camera_in_lander_m(),
    }
}
