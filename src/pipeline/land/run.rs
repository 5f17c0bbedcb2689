//! A descent: images and IMU in, the lander's state out.

use super::map_sightings::known_sightings;
use super::notes::{land_notes, map_note};
use crate::dataset::{
    CameraSource, ImageSequence, StampedPose, read_designated, read_ground_map, read_imu, read_initial_state, write_tum,
};
use crate::navigation::landing::{
    ImuBiases, ImuRecord, LandingConfig, LandingEpoch, LandingInput, LandingResult, image_rotations, navigate,
    write_covariance_csv, write_estimate_csv,
};
use crate::pipeline::error::PipelineError;
use crate::pipeline::front_end_files::{write_front_end, write_images};
use crate::pipeline::progress::Progress;
use crate::pipeline::settings::{LandSettings, write_settings};
use crate::pipeline::summary::Summary;
use crate::pipeline::track::run_front_end;
use crate::settings::Settings;
use crate::vision::{FrontEnd, FrontEndConfig, TrackInputs, drift_per_image_px};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What to navigate by, and where the result goes.
#[derive(Debug, Clone)]
pub struct LandRequest {
    /// A data set with `imu0/`, `designated.csv` and `initial_state.csv`.
    pub folder: PathBuf,
    /// The result's folder.
    pub out: PathBuf,
    /// How it is navigated.
    pub settings: LandSettings,
}

/// Tracks the images, runs the landing filter and writes the result.
///
/// # Errors
/// A setting out of range, missing or malformed inputs, or a file that cannot be written.
pub fn land(request: &LandRequest, progress: &dyn Progress) -> Result<Summary, PipelineError> {
    let LandSettings { input: besides, landing: filter, .. } = &request.settings;
    request.settings.validate()?;
    let sequence = ImageSequence::open(&request.folder, &CameraSource::Folder)?;
    let (imu_noise, imu) = read_imu(&sequence.root)?;
    let designated = read_designated(&sequence.root)?;
    let initial = read_initial_state(&sequence.root)?;
    let front_end_config = with_gyro_prior(&request.settings.front_end);
    let map = besides.map.as_deref().map(read_ground_map).transpose()?;
    let options = serde_json::json!({
        "folder": request.folder.display().to_string(),
        "map": besides.map.as_ref().map(|folder| folder.display().to_string()),
        "filter": filter,
        "front_end": front_end_config,
    });
    let mut summary = Summary::new("landing", options);
    let lander_from_camera = sequence.sensor.spacecraft_from_camera;
    let record = ImuRecord { samples: &imu, noise: &imu_noise };
    let prior = |from_ns: i64, to_ns: i64| {
        let lander_from_from_lander_to = record.between(from_ns, to_ns, &ImuBiases::default()).ok()?.before_from_after;
        let mount = lander_from_camera.rotation;
        Some(mount.inverse() * lander_from_from_lander_to.inverse() * mount)
    };
    let inputs = TrackInputs {
        frames: 0..sequence.frames.len(),
        every: 1,
        rotation_prior: Some(&prior),
        designated: Some(designated),
        mask: None,
    };
    let front_end = run_front_end(&sequence, &front_end_config, &inputs, (progress, &mut summary))?;
    let frame_times_ns: Vec<i64> = front_end.frames.iter().map(|f| f.t_ns).collect();
    let mut input = LandingInput {
        imu: imu.clone(),
        imu_noise,
        camera: sequence.sensor.camera,
        lander_from_camera,
        observations: front_end.observations.clone(),
        initial,
        known: Vec::new(),
        rotations: image_rotations(&front_end.rotations, &frame_times_ns, &lander_from_camera),
        frame_times_ns,
    };
    if let Some(map) = &map {
        let designated = front_end.designated.as_slice();
        let by = (&input, &request.settings);
        let sighted = known_sightings(&sequence, by, (map, designated), (progress, &mut summary))?;
        summary.notes.extend(map_note(&sighted.points));
        input.known = sighted.known;
    }
    let start = Instant::now();
    progress.begin("navigating", input.frame_times_ns.len());
    let config = with_designated_errors(filter, &front_end);
    let result = navigate(&input, &config, &|done| progress.advance_to(done))?;
    progress.end();
    summary.timing_ms.insert("filter".into(), start.elapsed().as_secs_f64() * 1e3);
    describe(&result, &config, &mut summary);
    write_result(&request.out, &sequence, (&front_end, &result))?;
    write_settings(&request.out, "land", &request.settings)?;
    summary.write(&request.out)?;
    Ok(summary)
}

/// 1σ of a rotation that the gyroscope predicts between two images, rad: its noise over seconds, and a margin for the
/// camera's mounting. Tight enough to tell the right one of two rotations that explain a plane equally well.
const GYRO_SIGMA_RAD: f64 = 1e-3;

fn with_gyro_prior(front_end: &FrontEndConfig) -> FrontEndConfig {
    let mut config = front_end.clone();
    config.rotation.prior_sigma_rad = config.rotation.prior_sigma_rad.min(GYRO_SIGMA_RAD);
    config
}

/// The filter's options with what the front end says of the designated point: 1σ of the pixel that names it, and of the
/// drift of its track in each image.
fn with_designated_errors(config: &LandingConfig, front_end: &FrontEnd) -> LandingConfig {
    let steps = &front_end.designated;
    let Some(first) = steps.first() else { return config.clone() };
    LandingConfig {
        designated_sigma_px: first.step_sigma_px,
        designated_drift_px: drift_per_image_px(steps),
        ..config.clone()
    }
}

fn write_result(
    out: &Path,
    sequence: &ImageSequence,
    (front_end, result): (&FrontEnd, &LandingResult),
) -> Result<(), PipelineError> {
    write_front_end(out, front_end)?;
    write_images(out, sequence, front_end)?;
    write_estimate_csv(&out.join("estimate.csv"), result)?;
    write_covariance_csv(&out.join("covariance.csv"), result)?;
    let pose = |e: &LandingEpoch| StampedPose { t_ns: e.t_ns, reference_from_moving: e.site_from_lander };
    Ok(write_tum(&out.join("trajectory.tum"), &result.epochs.iter().map(pose).collect::<Vec<_>>())?)
}

/// Final state with 1σ, counts and notes for the summary.
fn describe(result: &LandingResult, config: &LandingConfig, summary: &mut Summary) {
    let with_image = result.epochs.iter().filter(|e| e.known_seen || e.unknown_track.is_some()).count();
    summary.counts.insert("epochs".into(), result.epochs.len());
    summary.counts.insert("epochs_with_bearings".into(), with_image);
    summary.counts.insert("bearings_gated".into(), result.epochs.iter().map(|e| e.gated).sum());
    let left_out = result.epochs.iter().filter(|e| e.contradiction.point_is_wrong && e.gated > 0).count();
    summary.counts.insert("designated_left_out".into(), left_out);
    summary.notes.extend(land_notes(result, config));
    summary.counts.insert("map_points_used".into(), result.epochs.iter().map(|e| e.known_points).sum());
    let Some(last) = result.epochs.last() else { return };
    let sigma = last.covariance.diagonal().map(|variance| variance.max(0.0).sqrt());
    let (p, q, v) =
        (last.site_from_lander.translation, last.site_from_lander.rotation, last.lander_velocity_in_site_m_s);
    summary.last = serde_json::json!({
        "t_ns": last.t_ns,
        "position_in_site_m": [p.x, p.y, p.z],
        "sigma_position_m": [sigma[0], sigma[1], sigma[2]],
        "velocity_in_site_m_s": [v.x, v.y, v.z],
        "sigma_velocity_m_s": [sigma[3], sigma[4], sigma[5]],
        "site_from_lander_wxyz": [q.w, q.i, q.j, q.k],
        "sigma_attitude_in_site_rad": [sigma[6], sigma[7], sigma[8]],
        "biases": last.biases.map(|(biases, sigma)| serde_json::json!({
            "gyroscope_rad_s": biases.gyroscope_rad_s.as_slice(),
            "accelerometer_m_s2": biases.accelerometer_m_s2.as_slice(),
            "sigma_gyroscope_rad_s": &sigma[..3],
            "sigma_accelerometer_m_s2": &sigma[3..],
        })),
    });
}
