//! Errors of a landing at the last image and at touchdown, and the verdict there.

use super::error::EvaluationError;
use super::ground::{TrackedGround, TrackedPixel, tracked_ground};
use super::landing_errors::LandingErrors;
use super::metrics::{Metrics, Verdict};
use super::true_camera::TrueCamera;
use nalgebra::Vector3;
use std::path::Path;

/// Adds the errors at the last image and at the end, from the site's origin and from the ground point really tracked.
pub fn add_final_errors(
    errors: &[LandingErrors],
    root: &Path,
    tracks: &[TrackedPixel],
    metrics: &mut Metrics,
) -> Result<(), EvaluationError> {
    let end = errors.last().expect("there is an epoch");
    add_state_errors("final", end, metrics);
    let last_image_ns = tracks.iter().map(|o| o.t_ns).max();
    let last_seen = last_image_ns.and_then(|t_ns| errors.iter().rev().find(|e| e.t_ns <= t_ns));
    match last_seen {
        Some(epoch) => {
            metrics.add("last_picture_time", epoch.t_s, "s");
            add_state_errors("last_picture", epoch, metrics);
        }
        None => metrics.note("Without tracks.csv the errors at the last picture cannot be told from those at the end."),
    }
    add_verdict("converged", "the site's origin", end, None, metrics);
    let ground = match TrueCamera::read(root) {
        Ok(camera) => tracked_ground(tracks, &camera)?,
        Err(error) => {
            metrics.note(format!("The tracked ground point is unknown: {error}."));
            None
        }
    };
    match ground {
        Some(TrackedGround { last_in_site_m: Some(point), first_in_site_m, far_error_px, .. }) => {
            if let Some(error_px) = far_error_px {
                metrics.add("tracked_point_pixel_error_beyond_3km_max", error_px, "px");
            }
            metrics.add("tracked_point_from_site_origin", point.norm(), "m");
            if let Some(first) = first_in_site_m {
                metrics.add("tracked_point_drift", (point - first).norm(), "m");
            }
            add_position_errors("final_from_tracked_point", end, Some(&point), metrics);
            if let Some(epoch) = last_seen {
                add_position_errors("last_picture_from_tracked_point", epoch, Some(&point), metrics);
            }
            add_verdict("converged_from_tracked_point", "the ground point really tracked", end, Some(&point), metrics);
        }
        _ => metrics.note(
            "The ground under the last observation of track 0 is unknown (no such track or no true depth): the verdict is \
             given against the site's origin only.",
        ),
    }
    Ok(())
}

/// Error of the position relative to the site's origin, or relative to the ground point of track 0, given where that
/// point truly is: what counts in a landing is the lander's place above the point that it steers for.
fn position_error_m(error: &LandingErrors, tracked_point_in_site_m: Option<&Vector3<f64>>) -> Vector3<f64> {
    let of_point = |truly: &Vector3<f64>| truly - error.estimated_designated_in_site_m;
    error.position_m - tracked_point_in_site_m.map_or_else(Vector3::zeros, of_point)
}

fn add_position_errors(
    prefix: &str,
    error: &LandingErrors,
    point_in_site_m: Option<&Vector3<f64>>,
    metrics: &mut Metrics,
) {
    let position = position_error_m(error, point_in_site_m);
    metrics.add(&format!("{prefix}_horizontal_error"), position.xy().norm(), "m");
    metrics.add(&format!("{prefix}_z_error"), position.z, "m");
}

fn add_state_errors(prefix: &str, error: &LandingErrors, metrics: &mut Metrics) {
    add_position_errors(prefix, error, None, metrics);
    metrics.add(&format!("{prefix}_speed_error"), error.velocity_m_s.norm(), "m/s");
    for (axis, name) in ["roll", "pitch", "yaw"].into_iter().enumerate() {
        metrics.add(&format!("{prefix}_{name}_error"), error.roll_pitch_yaw_rad[axis].to_degrees(), "deg");
    }
}

/// Converged: horizontal < 1 m, z < 40 m, |v| < 0.5 m/s, roll and pitch < 0.1°.
fn add_verdict(
    name: &str,
    origin: &str,
    error: &LandingErrors,
    point_in_site_m: Option<&Vector3<f64>>,
    metrics: &mut Metrics,
) {
    let position = position_error_m(error, point_in_site_m);
    let tilt_deg = error.roll_pitch_yaw_rad.xy().map(|angle| angle.to_degrees().abs());
    let limits = [
        ("horizontal error", position.xy().norm(), 1.0, "m"),
        ("z error", position.z.abs(), 40.0, "m"),
        ("velocity error", error.velocity_m_s.norm(), 0.5, "m/s"),
        ("roll error", tilt_deg.x, 0.1, "deg"),
        ("pitch error", tilt_deg.y, 0.1, "deg"),
    ];
    let broken: Vec<String> = limits
        .iter()
        .filter(|(_, value, limit, _)| value.is_nan() || value >= limit)
        .map(|(what, value, limit, unit)| format!("{what} {value:.3} {unit} is not under {limit} {unit}"))
        .collect();
    let holds = broken.is_empty();
    let kept = "every error is under its limit (horizontal 1 m, z 40 m, velocity 0.5 m/s, roll and pitch 0.1 deg)";
    let why = if holds { kept.to_string() } else { broken.join("; ") };
    let reason = format!("at {:.1} s against {origin}: {why}", error.t_s);
    metrics.verdicts.push(Verdict { name: name.into(), holds, reason });
}
