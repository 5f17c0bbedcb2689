//! Which unknown landmarks are followed (Li et al. 2023, fig. 3 and section 2.2).

use super::delayed_start::{triangulated, with_ray};
use super::initialize::{InitializationModel, with_landmark, without_landmark};
use super::visibility::{LookAhead, survives, viewpoint};
use crate::navigation::landing::bearings::{BearingObservation, CameraMount};
use crate::navigation::landing::config::{LandingConfig, LandmarkStart};
use crate::navigation::landing::error_state::{DescentEstimate, LandmarkRole};
use crate::navigation::landing::inertial::ImuIncrement;
use crate::navigation::landmark::{Candidate, Viewpoint, choose};
use crate::observations::TrackObservation;
use crate::stats::random_stream;
use nalgebra::{Rotation3, Unit, Vector3};
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// What the choice of landmarks remembers from image to image.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Memory {
    /// Tracks that have been landmarks before: their ground height must not be counted twice.
    pub spent_tracks: BTreeSet<u64>,
    /// Number of images so far.
    pub images: u64,
}

/// The bearing of a track in an image.
fn of_track(bearings: &[BearingObservation], track_id: u64) -> Option<&BearingObservation> {
    bearings.iter().find(|b| b.track_id == track_id && b.known.is_none())
}

/// Drops the landmarks that this image does not show or that were gated twice in a row.
pub fn without_lost(estimate: &mut DescentEstimate, bearings: &[BearingObservation]) {
    for index in (0..estimate.state.landmarks.len()).rev() {
        let Some(landmark) = estimate.state.landmarks.get(index) else { continue };
        let is_seen = of_track(bearings, landmark.track_id).is_some();
        let is_unknown = landmark.track_id != TrackObservation::DESIGNATED;
        if is_unknown && (!is_seen || landmark.gated >= 2) {
            *estimate = without_landmark(estimate, index);
        }
    }
}

/// Places the landmarks whose first ray this image's bearing meets at an angle.
pub fn with_triangulated(
    estimate: &mut DescentEstimate,
    bearings: &[BearingObservation],
    mount: &CameraMount,
    config: &LandingConfig,
) {
    let model = initialization(mount, config);
    let mut index = 0;
    while let Some(landmark) = estimate.state.landmarks.get(index) {
        if landmark.role == LandmarkRole::RayOrigin
            && let Some(bearing) = of_track(bearings, landmark.track_id)
            && let Some(placed) = triangulated(estimate, index, bearing, (config.least_parallax_rad, &model))
        {
            *estimate = placed;
        }
        index += 1;
    }
}

fn initialization(mount: &CameraMount, config: &LandingConfig) -> InitializationModel {
    InitializationModel { kind: config.filter, camera_in_lander_m: mount.camera_in_lander_m(), ground: config.ground }
}

/// What the choice of new landmarks needs.
pub struct Selection<'a> {
    pub increment: &'a ImuIncrement,
    pub mount: &'a CameraMount,
    pub config: &'a LandingConfig,
}

impl Selection<'_> {
    fn view(&self, estimate: &DescentEstimate, bearings: &[BearingObservation]) -> Viewpoint {
        let known = of_track(bearings, TrackObservation::DESIGNATED);
        let sigma_rad = known.or(bearings.first()).map_or(1e-3, BearingObservation::sigma_rad);
        viewpoint(estimate, self.increment, sigma_rad, self.config)
    }

    /// Ideal direction of one of several simultaneous landmarks: the selector's, turned about the vertical by an equal
    /// share of a full turn.
    fn ideal_direction(&self, view: &Viewpoint, slot: usize, image: u64) -> Option<Unit<Vector3<f64>>> {
        let slots = self.config.unknown_landmarks;
        let mut random = random_stream(self.config.seed, "landmark", image * slots as u64 + slot as u64);
        let point_m = self.config.selector.ideal_landmark_in_site_m(view, &mut random)?;
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), TAU * slot as f64 / slots as f64);
        Some(Unit::new_normalize(turn * (point_m - view.lander_in_site_m)))
    }

    /// The real feature nearest the ideal direction that has not served before and will stay in view.
    fn feature<'b>(
        &self,
        (estimate, memory): (&DescentEstimate, &Memory),
        (view, bearings): (&Viewpoint, &'b [BearingObservation]),
        slot: usize,
    ) -> Option<&'b BearingObservation> {
        let ideal = self.ideal_direction(view, slot, memory.images)?;
        let site_from_lander = estimate.state.lander_from_site.inverse();
        let is_fresh = |b: &&BearingObservation| {
            b.known.is_none()
                && b.track_id != TrackObservation::DESIGNATED
                && !memory.spent_tracks.contains(&b.track_id)
        };
        let nadir = -Vector3::z();
        let candidates: Vec<Candidate> = bearings
            .iter()
            .filter(is_fresh)
            .map(|b| Candidate { track_id: b.track_id, direction_in_site: site_from_lander * b.direction_in_lander })
            .collect();
        let ahead = LookAhead {
            view,
            increment: self.increment,
            images: self.config.reselect_after,
            margin_px: self.config.edge_margin_px,
        };
        let stays = |c: &Candidate| {
            c.direction_in_site.angle(&nadir) < self.config.ground.largest_off_nadir_rad
                && of_track(bearings, c.track_id).is_some_and(|b| survives(&estimate.state, b, self.mount, &ahead))
        };
        choose(&ideal, &candidates, stays).and_then(|c| of_track(bearings, c.track_id))
    }

    /// The estimate with a new landmark in a slot.
    fn started(
        &self,
        estimate: &DescentEstimate,
        bearing: &BearingObservation,
        slot: usize,
    ) -> Option<DescentEstimate> {
        let model = initialization(self.mount, self.config);
        match self.config.landmark_start {
            LandmarkStart::Plane => with_landmark(estimate, bearing, slot, &model),
            // Any distance would do: the ray is a straight line.
            LandmarkStart::Delayed => {
                let reach_m = estimate.state.lander_in_site_m.norm().max(1.0);
                Some(with_ray(estimate, bearing, (slot, reach_m), &model))
            }
        }
    }
}

/// Puts a new landmark in every empty slot, and in place of every landmark that has been observed often enough.
pub fn with_chosen(
    estimate: &mut DescentEstimate,
    memory: &mut Memory,
    bearings: &[BearingObservation],
    selection: &Selection<'_>,
) {
    let is_free = |estimate: &DescentEstimate, slot: usize| {
        let old = estimate.state.landmarks.iter().position(|l| l.slot == slot);
        let is_due = |k: usize| {
            let landmark = &estimate.state.landmarks[k];
            landmark.role == LandmarkRole::Point && landmark.observations >= selection.config.reselect_after
        };
        (old.is_none_or(is_due), old)
    };
    let slots = 0..selection.config.unknown_landmarks;
    if !slots.clone().any(|slot| is_free(estimate, slot).0) {
        return;
    }
    let view = selection.view(estimate, bearings);
    for slot in slots {
        let (true, old) = is_free(estimate, slot) else { continue };
        let Some(bearing) = selection.feature((estimate, memory), (&view, bearings), slot) else { continue };
        let kept = old.map_or(estimate.clone(), |k| without_landmark(estimate, k));
        if let Some(started) = selection.started(&kept, bearing, slot) {
            *estimate = started;
            memory.spent_tracks.insert(bearing.track_id);
        }
    }
}
