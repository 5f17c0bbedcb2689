//! Known points from a map: the descent is flown by the IMU and the map alone, so that each image is searched where the
//! camera must be; and the designated point is held against where the map says the site's origin is.

use super::bearings::{BearingObservation, CameraMount, CorrectionModel, KnownSighting, correct};
use super::config::LandingConfig;
use super::error::LandingError;
use super::error_state::DescentEstimate;
use super::inertial::ImuRecord;
use super::input::LandingInput;
use super::propagation::predict;
use super::step::{FrameInput, Navigator, step};
use crate::navigation::filter::Gate;
use crate::observations::{PredictedCamera, TrackObservation};
use nalgebra::Isometry3;

/// Probability that designated point and map agree by [`PointByMap::contradicts`], if both are right.
const AGREEMENT: f64 = 1.0 - 1e-6;

/// The designated point, seen from where the map says the camera is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointByMap {
    /// Time of the frame, ns.
    pub t_ns: i64,
    /// Its bearing less that of the site's origin, normalised and squared, 2 degrees of freedom.
    pub normalized_squared: f64,
    /// How far its ray passes from the site's origin, m.
    pub off_m: f64,
    /// Whether that is more than a χ² test lets pass once in a million times.
    pub contradicts: bool,
}

/// What a map says of a descent.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SightedByMap {
    /// Sightings of the map's points, in order of time, for [`LandingInput::known`].
    pub known: Vec<KnownSighting>,
    /// The designated point at every frame where the map was seen too.
    pub points: Vec<PointByMap>,
}

/// Searches the frame at a time (ns) for points of a map, given where the camera is thought to be.
type Look<'a, E> = dyn FnMut(&PredictedCamera, i64) -> Result<Option<Vec<KnownSighting>>, E> + 'a;

/// Sightings of a map's points in every frame of a descent. A filter of its own, by nothing but the IMU and the map,
/// predicts where the camera is; what each frame adds makes the prediction of the next one better.
///
/// `look(camera, t_ns)` searches the frame at `t_ns` for points of the map, given where the camera is thought to be, and
/// tells them with the errors of that frame alone; `None` where there is no frame to search. `designated` is the track of
/// the designated point, 1σ being that of the drifted track. Frames below `config.minimum_image_height_m` are not searched.
///
/// # Errors
/// IMU samples that do not fit the frames, a filter that breaks down, or what `look` fails with.
pub fn sighted_by_map<E: From<LandingError>>(
    input: &LandingInput,
    designated: &[TrackObservation],
    config: &LandingConfig,
    look: &mut Look<E>,
) -> Result<SightedByMap, E> {
    let record = ImuRecord { samples: &input.imu, noise: &input.imu_noise };
    let mount = input.mount();
    let mut navigator = Navigator::new(&input.initial, config);
    let (mut last_ns, mut last_height_m) = (input.initial.t_ns, None);
    let mut sighted = SightedByMap::default();
    for t_ns in input.frame_times_ns.iter().copied() {
        let increment = record.between(last_ns, t_ns, &navigator.biases())?;
        let predicted = predict(navigator.estimate.clone(), &increment, &config.planet(), config.filter);
        let height_m = predicted.state.lander_in_site_m.z;
        let camera = predicted_camera(&predicted, &mount.lander_from_camera, config);
        let found = if height_m >= config.minimum_image_height_m { look(&camera, t_ns)? } else { None };
        let sharing = match (&found, last_height_m) {
            (Some(_), Some(last_m)) => frames_that_share(height_m / last_m, config.map_shared_ln_scale),
            _ => 1.0,
        };
        last_height_m = found.as_ref().map_or(last_height_m, |_| Some(height_m));
        let known: Vec<KnownSighting> = found.iter().flatten().map(|s| shared_by(s, sharing)).collect();
        let bearings = known.iter().filter_map(|s| mount.known_bearing(s, config.sigma_floor_px)).collect();
        let frame = FrameInput { increment, bearings, rotation: None };
        let (after, report) = step(navigator, &frame, &mount, config).ok_or(LandingError::BrokeDown { t_ns })?;
        if let Some(tracked) = designated.iter().find(|s| s.t_ns == t_ns && report.used() > 0) {
            sighted.points.extend(point_by_map(tracked, &after.estimate, &mount, config));
        }
        sighted.known.extend(known);
        (navigator, last_ns) = (after, t_ns);
    }
    Ok(sighted)
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

/// A sighting whose errors so many frames `sharing` them make right together, taken as independent.
fn shared_by(sighting: &KnownSighting, sharing: f64) -> KnownSighting {
    KnownSighting {
        sigma_px: sighting.sigma_px * sharing.sqrt(),
        sigma_point_m: (sighting.sigma_point_m.powi(2) * sharing).sqrt(),
        ..*sighting
    }
}

/// How many frames share their errors, given the change of scale from each to the next, and the change over which errors
/// stay the same.
fn frames_that_share(scale: f64, shared_ln_scale: f64) -> f64 {
    (shared_ln_scale / scale.ln().abs().max(1e-3)).max(1.0)
}

/// The tracked point against the site's origin, by an estimate that knows nothing of it. `None` where the origin is not
/// ahead of the camera, or the pixel has no bearing.
fn point_by_map(
    tracked: &TrackObservation,
    estimate: &DescentEstimate,
    mount: &CameraMount,
    config: &LandingConfig,
) -> Option<PointByMap> {
    let bearing: BearingObservation = mount.bearing(tracked, config.sigma_floor_px)?;
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
