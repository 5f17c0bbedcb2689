//! One image of the descent.

use super::candidates::{LookAhead, survives, viewpoint};
use super::correct::{CorrectionModel, Outcome, correct};
use super::designated::with_designated_errors;
use super::imu::ImuIncrement;
use super::initialize::{InitializationModel, with_landmark, without_landmark};
use super::measurement::{BearingObservation, CameraMount};
use super::predict::predict;
use super::recovery::Contradiction;
use super::{DescentEstimate, LandingConfig};
use crate::navigation::landmark::{Candidate, Viewpoint, choose};
use crate::stats::random_stream;
use crate::vision::TrackObservation;
use nalgebra::{Rotation3, Unit, Vector3};
use std::collections::BTreeSet;
use std::f64::consts::TAU;

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

/// Without the landmarks that this image does not show or that were gated twice in a row.
fn without_lost(navigator: &Navigator, bearings: &[BearingObservation]) -> Navigator {
    let mut after = navigator.clone();
    for index in (0..after.estimate.state.landmarks.len()).rev() {
        let landmark = after.estimate.state.landmarks[index];
        let is_seen = bearings.iter().any(|b| b.track_id == landmark.track_id);
        let is_unknown = landmark.track_id != TrackObservation::DESIGNATED;
        if is_unknown && (!is_seen || landmark.gated >= 2) {
            after.estimate = without_landmark(&after.estimate, index);
        }
    }
    after
}

/// What the choice of new landmarks needs.
struct Selection<'a> {
    view: Viewpoint,
    frame: &'a FrameInput,
    mount: &'a CameraMount,
    config: &'a LandingConfig,
}

impl<'a> Selection<'a> {
    fn new(navigator: &Navigator, frame: &'a FrameInput, mount: &'a CameraMount, config: &'a LandingConfig) -> Self {
        let known = frame.bearings.iter().find(|b| b.track_id == TrackObservation::DESIGNATED);
        let sigma_rad = known.or(frame.bearings.first()).map_or(1e-3, BearingObservation::sigma_rad);
        let view = viewpoint(&navigator.estimate, &frame.increment, sigma_rad, config);
        Selection { view, frame, mount, config }
    }

    /// Ideal direction of one of several simultaneous landmarks: the selector's, turned about the vertical by an equal
    /// share of a full turn.
    fn ideal_direction(&self, slot: usize, image: u64) -> Option<Unit<Vector3<f64>>> {
        let slots = self.config.unknown_landmarks;
        let mut random = random_stream(self.config.seed, "landmark", image * slots as u64 + slot as u64);
        let point_m = self.config.selector.ideal_landmark_in_site_m(&self.view, &mut random)?;
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), TAU * slot as f64 / slots as f64);
        Some(Unit::new_normalize(turn * (point_m - self.view.lander_in_site_m)))
    }

    /// The real feature nearest the ideal direction that has not served before and will stay in view.
    fn feature(
        &self,
        navigator: &Navigator,
        bearings: &'a [BearingObservation],
        slot: usize,
    ) -> Option<&'a BearingObservation> {
        let ideal = self.ideal_direction(slot, navigator.images)?;
        let site_from_lander = navigator.estimate.state.lander_from_site.inverse();
        let is_fresh = |id: u64| id != TrackObservation::DESIGNATED && !navigator.spent_tracks.contains(&id);
        let nadir = -Vector3::z();
        let (candidates, seen): (Vec<Candidate>, Vec<&BearingObservation>) = bearings
            .iter()
            .filter(|b| is_fresh(b.track_id))
            .map(|b| {
                (Candidate { track_id: b.track_id, direction_in_site: site_from_lander * b.direction_in_lander }, b)
            })
            .unzip();
        let ahead = LookAhead {
            view: &self.view,
            increment: &self.frame.increment,
            images: self.config.reselect_after,
            margin_px: self.config.edge_margin_px,
        };
        let bearing_of = |c: &Candidate| seen.iter().copied().find(|b| b.track_id == c.track_id);
        let stays = |c: &Candidate| {
            c.direction_in_site.angle(&nadir) < self.config.ground.largest_off_nadir_rad
                && bearing_of(c).is_some_and(|b| survives(&navigator.estimate.state, b, self.mount, &ahead))
        };
        choose(&ideal, &candidates, stays).and_then(bearing_of)
    }
}

/// With a new landmark in every empty slot, and in place of every landmark that has been observed often enough.
fn with_chosen(navigator: &Navigator, bearings: &[BearingObservation], selection: &Selection<'_>) -> Navigator {
    let model = InitializationModel {
        kind: selection.config.filter,
        camera_in_lander_m: selection.mount.camera_in_lander_m(),
        ground: selection.config.ground,
    };
    let mut after = navigator.clone();
    for slot in 0..selection.config.unknown_landmarks {
        let old = after.estimate.state.landmarks.iter().position(|l| l.slot == slot);
        let is_due = |k: usize| after.estimate.state.landmarks[k].observations >= selection.config.reselect_after;
        if !old.is_none_or(is_due) {
            continue;
        }
        let Some(bearing) = selection.feature(&after, bearings, slot) else { continue };
        let kept = old.map_or(after.estimate.clone(), |k| without_landmark(&after.estimate, k));
        if let Some(estimate) = with_landmark(&kept, bearing, slot, &model) {
            after.estimate = estimate;
            after.spent_tracks.insert(bearing.track_id);
        }
    }
    after
}
