//! Errors of the rotations between pairs of images.

use super::consistency::NormalizedSample;
use super::error::EvaluationError;
use super::landing_epochs::rotation;
use super::metrics::{Metrics, Series};
use super::named_table::NamedTable;
use super::spread::{median, percentile};
use super::true_camera::TrueCamera;
use crate::geometry::so3::log;
use crate::stats::ConsistencyBounds;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use std::collections::BTreeMap;
use std::path::Path;

/// A rotation as the front end gave it.
struct PairRow {
    t_ns_from: i64,
    t_ns_to: i64,
    to_from: UnitQuaternion<f64>,
    sigma_rad: Vector3<f64>,
}

/// Error of one pair.
struct PairError {
    t_ns: i64,
    error_rad: Vector3<f64>,
    sigma_rad: Vector3<f64>,
    normalized: Option<f64>,
}

/// Adds the figures and the curve of `relative_rotations.csv`; nothing where the result has none.
pub fn evaluate_pairs(
    result: &Path,
    camera: &TrueCamera,
    start_ns: i64,
    metrics: &mut Metrics,
) -> Result<(), EvaluationError> {
    let path = result.join("relative_rotations.csv");
    if !path.is_file() {
        metrics.note("There is no relative_rotations.csv, so no pair is judged.");
        return Ok(());
    }
    let (pairs, counts) = read_pairs(&path)?;
    for (status, count) in &counts {
        metrics.add(&format!("pairs_{}", status.replace('-', "_")), *count as f64, "1");
    }
    let mut errors: Vec<PairError> = pairs.iter().filter_map(|pair| pair_error(pair, camera)).collect();
    if errors.len() < pairs.len() {
        metrics.note(format!(
            "{} of {} rotations have no true pose at their times.",
            pairs.len() - errors.len(),
            pairs.len()
        ));
    }
    if errors.is_empty() {
        metrics.note("No pair has both the status ok and a true pose, so no rotation error can be given.");
        return Ok(());
    }
    errors.sort_by_key(|e| e.t_ns);
    add_figures(&errors, metrics);
    metrics.series.push(Series {
        name: "pair_rotation_error".into(),
        unit: "deg".into(),
        t_s: errors.iter().map(|e| (e.t_ns - start_ns) as f64 * 1e-9).collect(),
        values: errors.iter().map(|e| e.error_rad.norm().to_degrees()).collect(),
        sigma: errors.iter().map(|e| e.sigma_rad.norm().to_degrees()).collect(),
        bound: None,
    });
    Ok(())
}

fn read_pairs(path: &Path) -> Result<(Vec<PairRow>, BTreeMap<String, usize>), EvaluationError> {
    let table = NamedTable::read(path)?;
    let [from, to, status] = table.places(["t_ns_from", "t_ns_to", "status"])?;
    let quaternion = table.places(["qw", "qx", "qy", "qz"])?;
    let sigma = table.places(["sigma_x_rad", "sigma_y_rad", "sigma_z_rad"])?;
    let (mut pairs, mut counts) = (vec![], BTreeMap::from([("ok".to_string(), 0)]));
    for row in 0..table.len() {
        *counts.entry(table.text(row, status).to_string()).or_default() += 1;
        if table.text(row, status) == "ok" {
            pairs.push(PairRow {
                t_ns_from: table.integer(row, from)?,
                t_ns_to: table.integer(row, to)?,
                to_from: rotation(&table, row, quaternion)?,
                sigma_rad: Vector3::from(table.numbers(row, &sigma)?),
            });
        }
    }
    Ok((pairs, counts))
}

/// `true = exp(error) * estimated`, in the axes of the second camera.
fn pair_error(pair: &PairRow, camera: &TrueCamera) -> Option<PairError> {
    let reference_from_to = camera.reference_from_camera(pair.t_ns_to)?.rotation;
    let reference_from_from = camera.reference_from_camera(pair.t_ns_from)?.rotation;
    let true_to_from = reference_from_to.inverse() * reference_from_from;
    let error_rad = log(&(true_to_from * pair.to_from.inverse()));
    let covariance = Matrix3::from_diagonal(&pair.sigma_rad.component_mul(&pair.sigma_rad));
    let normalized = NormalizedSample::new(0.0, &error_rad, &covariance).map(|s| s.normalized());
    Some(PairError { t_ns: pair.t_ns_to, error_rad, sigma_rad: pair.sigma_rad, normalized })
}

fn add_figures(errors: &[PairError], metrics: &mut Metrics) {
    let angles_deg: Vec<f64> = errors.iter().map(|e| e.error_rad.norm().to_degrees()).collect();
    metrics.add("pair_rotation_error_median", median(&angles_deg), "deg");
    metrics.add("pair_rotation_error_p95", percentile(&angles_deg, 0.95), "deg");
    metrics.add("pair_rotation_error_max", percentile(&angles_deg, 1.0), "deg");
    let normalized: Vec<f64> = errors.iter().filter_map(|e| e.normalized).collect();
    if normalized.is_empty() {
        metrics.note("The pairs carry no 1σ above zero, so their consistency cannot be judged.");
        return;
    }
    let bounds = ConsistencyBounds::of_mean(3, normalized.len(), 0.95);
    let mean = normalized.iter().sum::<f64>() / normalized.len() as f64;
    metrics.add_bounded("pair_nees_per_dof", mean, "1", Some(bounds));
    let one = ConsistencyBounds::of_mean(3, 1, 0.95);
    let within = normalized.iter().filter(|v| one.contains(**v)).count() as f64 / normalized.len() as f64;
    metrics.add("pair_nees_share_within_95", within, "1");
    metrics.note(format!("Pair rotations are {}.", bounds.diagnosis(mean)));
}
