//! One image of the descent.

use super::bearings::{BearingObservation, CameraMount, Contradiction, CorrectionModel, Outcomes, correct};
use super::config::{ImageRotationUse, LandingConfig};
use super::error_state::DescentEstimate;
use super::inertial::{ImuBiases, ImuIncrement};
use super::landmarks::{
    Memory, Selection, initial_estimate, with_chosen, with_designated_errors, with_triangulated, without_lost,
};
use super::propagation::{ImageRotation, RotationCheck, predict};
use crate::dataset::InitialState;

/// What is carried from image to image.
#[derive(Debug, Clone, PartialEq)]
pub struct Navigator {
    /// The estimate.
    pub estimate: DescentEstimate,
    /// Whether an image has corrected it yet.
    pub corrected: bool,
    /// Contradictions with the known landmark.
    pub contradiction: Contradiction,
    /// What the choice of landmarks remembers.
    pub memory: Memory,
}

impl Navigator {
    /// Before the first image.
    pub fn new(initial: &InitialState, config: &LandingConfig) -> Self {
        Navigator {
            estimate: initial_estimate(initial, config),
            corrected: false,
            contradiction: Contradiction::default(),
            memory: Memory::default(),
        }
    }

    /// The biases that the next increment should be freed of.
    pub fn biases(&self) -> ImuBiases {
        self.estimate.state.biases.unwrap_or_default()
    }
}

/// What one image brings.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameInput {
    /// IMU motion since the last image.
    pub increment: ImuIncrement,
    /// Bearings of every track seen, and of known points.
    pub bearings: Vec<BearingObservation>,
    /// The rotation since the last image as the images tell it, where they do.
    pub rotation: Option<ImageRotation>,
}

/// What became of one image.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StepReport {
    /// The landmarks' bearings, used and gated.
    pub outcomes: Outcomes,
    /// Joint normalised innovation squared of those used.
    pub normalized_innovation_squared: Option<f64>,
    /// Gyroscope against images.
    pub rotation_check: Option<RotationCheck>,
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
    navigator: Navigator,
    frame: &FrameInput,
    mount: &CameraMount,
    config: &LandingConfig,
) -> Option<(Navigator, StepReport)> {
    let Navigator { estimate, corrected, contradiction, memory } = navigator;
    let rotation_check = checked(frame, config);
    let (estimate, increment) = with_image_rotation(estimate, frame, config);
    let predicted = predict(estimate, &increment, &config.planet(), config.filter);
    let bearings = usable(&predicted, &frame.bearings, config);
    let prior = with_designated_errors(contradiction.resolved(predicted, config.filter), bearings, mount, config);
    let result = correct(prior, bearings, &correction_model(corrected, mount, config))?;
    let report = StepReport {
        outcomes: result.outcomes,
        normalized_innovation_squared: result.normalized_innovation_squared,
        rotation_check,
    };
    let mut after = Navigator {
        estimate: result.estimate,
        corrected: corrected || report.used() > 0,
        contradiction: contradiction.after(&report.outcomes),
        memory: Memory { images: memory.images + 1, ..memory },
    };
    if after.corrected && !bearings.is_empty() {
        without_lost(&mut after.estimate, bearings);
        with_triangulated(&mut after.estimate, bearings, mount, config);
        with_chosen(
            &mut after.estimate,
            &mut after.memory,
            bearings,
            &Selection { increment: &increment, mount, config },
        );
    }
    Some((after, report))
}

fn checked(frame: &FrameInput, config: &LandingConfig) -> Option<RotationCheck> {
    let rotation = frame.rotation.filter(|_| config.image_rotation != ImageRotationUse::Ignore)?;
    rotation.check(&frame.increment)
}

/// Estimate and increment corrected by the images' rotation, where it is a measurement.
fn with_image_rotation(
    estimate: DescentEstimate,
    frame: &FrameInput,
    config: &LandingConfig,
) -> (DescentEstimate, ImuIncrement) {
    match frame.rotation.filter(|_| config.image_rotation == ImageRotationUse::Measure) {
        None => (estimate, frame.increment.clone()),
        Some(rotation) if estimate.state.biases.is_some() => rotation
            .with_biases(&estimate, &frame.increment, config.filter)
            .unwrap_or_else(|| (estimate, frame.increment.clone())),
        Some(rotation) => (estimate, rotation.fused(&frame.increment).unwrap_or_else(|| frame.increment.clone())),
    }
}

/// The bearings if the lander is high enough for images, by its estimate; none otherwise.
fn usable<'a>(
    estimate: &DescentEstimate,
    bearings: &'a [BearingObservation],
    config: &LandingConfig,
) -> &'a [BearingObservation] {
    if estimate.state.lander_in_site_m.z >= config.minimum_image_height_m { bearings } else { &[] }
}

fn correction_model(corrected: bool, mount: &CameraMount, config: &LandingConfig) -> CorrectionModel {
    CorrectionModel {
        kind: config.filter,
        gate: config.gate(),
        iterations: if corrected { 1 } else { config.first_iterations },
        camera_in_lander_m: mount.camera_in_lander_m(),
        second_order: config.second_order_noise,
    }
}
