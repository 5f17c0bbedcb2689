//! Known points for a descent: each picture matched with a map from where the filter predicts the camera; and whether the
//! designated point lies where the map says the site's origin is.

use crate::dataset::{GroundMap, ImageSequence};
use crate::navigation::filter::Gate;
use crate::navigation::landing::{
    CameraMount, CorrectionModel, DescentEstimate, FrameInput, ImuRecord, KnownSighting, LandingConfig, LandingError,
    LandingInput, Navigator, step,
};
use crate::navigation::{correct, predict};
use crate::pipeline::error::PipelineError;
use crate::pipeline::progress::Progress;
use crate::pipeline::summary::Summary;
use crate::vision::{
    DesignatedStep, MapFix, MapMatchConfig, MapMatcher, MapSighting, MapStatus, PredictedCamera, TrackObservation,
};
use nalgebra::Isometry3;
use std::time::Instant;

/// Probability that designated point and map agree by [`PointByMap::contradicts`], if both are right.
const AGREEMENT: f64 = 1.0 - 1e-6;

/// The designated point, seen from where the map says the camera is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PointByMap {
    pub(super) t_ns: i64,
    /// Its bearing less that of the site's origin, normalised and squared, 2 degrees of freedom.
    pub(super) normalized_squared: f64,
    /// How far its ray passes from the site's origin, m.
    pub(super) off_m: f64,
    /// Whether that is more than a χ² test lets pass once in a million times.
    pub(super) contradicts: bool,
}

/// What a map says of a descent.
pub(super) struct SightedByMap {
    pub(super) known: Vec<KnownSighting>,
    pub(super) points: Vec<PointByMap>,
}

/// Sightings of the map's points in every picture of a descent. A filter of its own, by nothing but the IMU and the map,
/// predicts where the camera is; what each picture adds makes the prediction of the next one better.
///
/// # Errors
/// Settings out of range, IMU samples that do not fit the pictures, or a picture that cannot be read.
pub(super) fn known_sightings(
    sequence: &ImageSequence,
    input: &LandingInput,
    (map, designated, config): (&GroundMap, &[DesignatedStep], &LandingConfig),
    (progress, summary): (&dyn Progress, &mut Summary),
) -> Result<SightedByMap, PipelineError> {
    let start = Instant::now();
    let matcher = MapMatcher::new(map, &MapMatchConfig::default())?;
    let record = ImuRecord { samples: &input.imu, noise: &input.imu_noise };
    let mount = input.mount();
    let mut navigator = Navigator::new(&input.initial, config);
    let (mut last_ns, mut last_height_m) = (input.initial.t_ns, None);
    let (mut known, mut points) = (Vec::new(), Vec::new());
    progress.begin("matching the map", input.frame_times_ns.len());
    for (index, t_ns) in input.frame_times_ns.iter().copied().enumerate() {
        let increment = record.between(last_ns, t_ns, &navigator.biases())?;
        let predicted = predict(navigator.estimate.clone(), &increment, &config.planet(), config.filter);
        let mut bearings = Vec::new();
        if let Some(frame) = sequence.frames.iter().find(|f| f.t_ns == t_ns)
            && predicted.state.lander_in_site_m.z >= config.minimum_image_height_m
            && let Ok(picture) = sequence.load(frame)
        {
            let camera = predicted_camera(&predicted, &mount.lander_from_camera, config);
            let fix = matcher.sightings(&picture, &mount.camera, &camera)?;
            count(&fix, summary);
            let height_m = predicted.state.lander_in_site_m.z;
            let sharing = last_height_m.map_or(1.0, |last_m| pictures_that_share(height_m / last_m));
            last_height_m = Some(height_m);
            let sighting = |s: &MapSighting| known_sighting(t_ns, s, sharing);
            let sightings: Vec<KnownSighting> = fix.sightings.iter().map(sighting).collect();
            bearings.extend(sightings.iter().filter_map(|s| mount.known_bearing(s, config.sigma_floor_px)));
            known.extend(sightings);
        }
        let frame = FrameInput { increment, bearings, rotation: None };
        let (after, report) = step(navigator, &frame, &mount, config).ok_or(LandingError::BrokeDown { t_ns })?;
        if let Some(tracked) = designated.iter().find(|s| s.t_ns == t_ns && report.used() > 0) {
            points.extend(point_by_map(tracked, &after.estimate, &mount, config));
        }
        (navigator, last_ns) = (after, t_ns);
        progress.advance_to(index + 1);
    }
    progress.end();
    summary.counts.insert("map_sightings".into(), known.len());
    summary.timing_ms.insert("map".into(), start.elapsed().as_secs_f64() * 1e3);
    Ok(SightedByMap { known, points })
}

/// The tracked point against the site's origin, by an estimate that knows nothing of it. `None` where the origin is not
/// ahead of the camera, or the pixel has no bearing.
fn point_by_map(
    tracked: &DesignatedStep,
    estimate: &DescentEstimate,
    mount: &CameraMount,
    config: &LandingConfig,
) -> Option<PointByMap> {
    let observation = TrackObservation {
        sigma_px: tracked.covariance_px2.symmetric_eigenvalues().max().sqrt(),
        ..tracked.observation()
    };
    let bearing = mount.bearing(&observation, config.sigma_floor_px)?;
    let model = CorrectionModel {
        kind: config.filter,
        gate: Gate { confidence: AGREEMENT },
        iterations: 1,
        camera_in_lander_m: mount.camera_in_lander_m(),
        second_order: config.second_order_noise,
    };
    let outcome = *correct(estimate.clone(), &[bearing], &model)?.outcomes.first()?;
    let state = &estimate.state;
    let origin_m = -(state.lander_from_site * state.lander_in_site_m) - model.camera_in_lander_m;
    Some(PointByMap {
        t_ns: tracked.t_ns,
        normalized_squared: outcome.normalized_innovation_squared,
        off_m: origin_m.cross(&bearing.direction_in_lander).norm(),
        contradicts: !outcome.used,
    })
}

/// Where the camera is by an estimate, with the mean 1σ of its axes.
fn predicted_camera(
    estimate: &DescentEstimate,
    lander_from_camera: &Isometry3<f64>,
    config: &LandingConfig,
) -> PredictedCamera {
    let covariance = config.filter.site_covariance(estimate);
    let sigma = |first: usize| (covariance.diagonal().rows(first, 3).sum() / 3.0).max(0.0).sqrt();
    PredictedCamera {
        camera_from_site: (estimate.state.site_from_lander() * lander_from_camera).inverse(),
        sigma_position_m: sigma(0),
        sigma_attitude_rad: sigma(6),
    }
}

/// What a picture shows otherwise than the map stays wrong in the same way until the scale has changed by this, as a
/// natural logarithm (fitted to rendered ground).
const SHARED_SCALE: f64 = 0.14;

/// How many pictures share their errors, given the change of scale from each to the next.
fn pictures_that_share(scale: f64) -> f64 {
    (SHARED_SCALE / scale.ln().abs().max(1e-3)).max(1.0)
}

/// A sighting whose errors so many pictures `sharing` them make right together, taken as independent.
fn known_sighting(t_ns: i64, sighting: &MapSighting, sharing: f64) -> KnownSighting {
    let variance_m2 = (2.0 * sighting.sigma_horizontal_m.powi(2) + sighting.sigma_vertical_m.powi(2)) / 3.0;
    KnownSighting {
        t_ns,
        pixel_px: sighting.pixel_px,
        sigma_px: sighting.sigma_px() * sharing.sqrt(),
        point_in_site_m: sighting.point_in_site_m,
        sigma_point_m: (variance_m2 * sharing).sqrt(),
    }
}

fn count(fix: &MapFix, summary: &mut Summary) {
    let name = match fix.status {
        MapStatus::Tracked => "map_frames_tracked",
        MapStatus::Acquired => "map_frames_acquired",
        MapStatus::OffMap => "map_frames_off_map",
        MapStatus::Lost => "map_frames_lost",
    };
    *summary.counts.entry(name.into()).or_default() += 1;
}
