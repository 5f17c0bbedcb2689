//! A tumbling small body: images in; attitude, rate and inertia ratios out.

use super::error::PipelineError;
use super::frame_range::checked_frames;
use super::front_end_files::{write_front_end, write_images};
use super::progress::Progress;
use super::settings::{TumbleSettings, write_settings};
use super::summary::Summary;
use super::track::{open, run_front_end};
use crate::dataset::{ImageSequence, StampedPose, write_tum};
use crate::navigation::tumbling::{TumblingEpoch, TumblingResult, estimate, write_covariance_csv, write_estimate_csv};
use crate::settings::Settings;
use crate::vision::{FrontEnd, TrackInputs};
use nalgebra::{Isometry3, Translation3, Unit, Vector3};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What to estimate from, and where the result goes.
#[derive(Debug, Clone)]
pub struct TumbleRequest {
    /// A data set or a folder of images of one tumbling body.
    pub folder: PathBuf,
    /// The result's folder.
    pub out: PathBuf,
    /// Which images are taken, and how.
    pub settings: TumbleSettings,
}

/// Tracks the images, estimates the tumbling motion and writes the result.
///
/// # Errors
/// A setting out of range, missing or malformed inputs, too few usable pairs, or a file that cannot be written.
pub fn tumble(request: &TumbleRequest, progress: &dyn Progress) -> Result<Summary, PipelineError> {
    let TumbleSettings { input, tumbling: config, front_end: front_end_config } = &request.settings;
    request.settings.validate()?;
    let (sequence, mask) = open(&request.folder, input)?;
    let frames = checked_frames(input.frame_range(), sequence.frames.len())?;
    let options = serde_json::json!({
        "folder": request.folder.display().to_string(),
        "estimator": config,
        "front_end": front_end_config,
    });
    let mut summary = Summary::new("tumbling", options);
    let inputs = TrackInputs { frames, every: input.every, mask: mask.as_ref(), ..TrackInputs::default() };
    let front_end = run_front_end(&sequence, front_end_config, &inputs, (progress, &mut summary))?;
    let times_ns: Vec<i64> = front_end.frames.iter().map(|f| f.t_ns).collect();
    let start = Instant::now();
    progress.begin("estimating", 1);
    let result = estimate(&front_end.rotations, &times_ns, config)?;
    progress.end();
    summary.timing_ms.insert("estimator".into(), start.elapsed().as_secs_f64() * 1e3);
    describe(&result, &mut summary);
    summary.notes.extend(front_end.center_in_camera.map(|c| center_note(&c)));
    write_result(&request.out, &sequence, (&front_end, &result))?;
    write_settings(&request.out, "tumble", &request.settings)?;
    summary.write(&request.out)?;
    Ok(summary)
}

fn write_result(
    out: &Path,
    sequence: &ImageSequence,
    (front_end, result): (&FrontEnd, &TumblingResult),
) -> Result<(), PipelineError> {
    write_front_end(out, front_end)?;
    write_images(out, sequence, front_end)?;
    write_estimate_csv(&out.join("estimate.csv"), result)?;
    write_covariance_csv(&out.join("covariance.csv"), result)?;
    let pose = |e: &TumblingEpoch| StampedPose {
        t_ns: e.t_ns,
        reference_from_moving: Isometry3::from_parts(Translation3::identity(), e.asteroid_from_inertial),
    };
    Ok(write_tum(&out.join("trajectory.tum"), &result.epochs.iter().map(pose).collect::<Vec<_>>())?)
}

fn center_note(center_in_camera: &Unit<Vector3<f64>>) -> String {
    let c = center_in_camera;
    format!("centre of rotation in the camera: ({:.6}, {:.6}) of (x/z, y/z)", c.x / c.z, c.y / c.z)
}

/// Final state with 1σ, counts and notes for the summary.
fn describe(result: &TumblingResult, summary: &mut Summary) {
    summary.counts.insert("pairs_used".into(), result.pairs_used);
    summary.counts.insert("pairs_rejected".into(), result.pairs_rejected);
    summary.notes.extend(result.undetermined.iter().map(|d| format!("inertia not determined: {}", d.name)));
    let Some(last) = result.epochs.last() else { return };
    let sigma = last.covariance.diagonal().map(|variance| variance.max(0.0).sqrt());
    let (q, w) = (last.asteroid_from_inertial, last.rate_in_asteroid_rad_s);
    summary.last = serde_json::json!({
        "t_ns": last.t_ns,
        "asteroid_from_inertial_wxyz": [q.w, q.i, q.j, q.k],
        "sigma_attitude_in_asteroid_rad": [sigma[0], sigma[1], sigma[2]],
        "rate_in_asteroid_rad_s": [w.x, w.y, w.z],
        "sigma_rate_rad_s": [sigma[3], sigma[4], sigma[5]],
        "inertia_ratios_xx_yy_xy_xz_yz": result.inertia_ratios,
        "sigma_inertia_ratios": result.inertia_sigma,
    });
}
