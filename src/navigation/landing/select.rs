//! Which unknown landmarks are followed (Li et al. 2023, fig. 3 and section 2.2).

use super::LandingConfig;
use super::candidates::{LookAhead, survives, viewpoint};
use super::initialize::{InitializationModel, with_landmark, without_landmark};
use super::measurement::{BearingObservation, CameraMount};
use super::step::{FrameInput, Navigator};
use crate::navigation::landmark::{Candidate, Viewpoint, choose};
use crate::stats::random_stream;
use crate::vision::TrackObservation;
use nalgebra::{Rotation3, Unit, Vector3};
use std::f64::consts::TAU;

/// Without the landmarks that this image does not show or that were gated twice in a row.
pub(super) fn without_lost(navigator: &Navigator, bearings: &[BearingObservation]) -> Navigator {
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
pub(super) struct Selection<'a> {
    view: Viewpoint,
    frame: &'a FrameInput,
    mount: &'a CameraMount,
    config: &'a LandingConfig,
}

impl<'a> Selection<'a> {
    pub(super) fn new(
        navigator: &Navigator,
        frame: &'a FrameInput,
        mount: &'a CameraMount,
        config: &'a LandingConfig,
    ) -> Self {
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
pub(super) fn with_chosen(
    navigator: &Navigator,
    bearings: &[BearingObservation],
    selection: &Selection<'_>,
) -> Navigator {
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
