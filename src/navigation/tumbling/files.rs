//! The result on disk.

use super::error::TumblingError;
use super::result::TumblingResult;
use crate::dataset::write_timed_table;
use std::path::Path;

const ESTIMATE_HEADER: &str = "t_ns,qw,qx,qy,qz,wx_rad_s,wy_rad_s,wz_rad_s,Lxx,Lyy,Lxy,Lxz,Lyz,sigma_ax_rad,\
     sigma_ay_rad,sigma_az_rad,sigma_wx_rad_s,sigma_wy_rad_s,sigma_wz_rad_s,sigma_Lxx,sigma_Lyy,sigma_Lxy,sigma_Lxz,\
     sigma_Lyz";

/// Axes of the 6×6 covariance: attitude error in inertial axes (rad), rate error in asteroid axes (rad/s).
const ERROR_AXES: [&str; 6] = ["ax", "ay", "az", "wx", "wy", "wz"];

/// Writes the estimate of each image: attitude `asteroid_from_inertial`, rate in asteroid axes, inertia ratios, then 1σ
/// of each (attitude in inertial axes). Elements of the inertia that are not determined are `NaN`.
///
/// # Errors
/// [`TumblingError::Dataset`] names the file.
pub fn write_estimate_csv(path: &Path, result: &TumblingResult) -> Result<(), TumblingError> {
    let rows = result.epochs.iter().map(|epoch| {
        let q = &epoch.asteroid_from_inertial;
        let mut row = vec![q.w, q.i, q.j, q.k];
        row.extend(epoch.rate_in_asteroid_rad_s.iter());
        row.extend(epoch.inertia.elements.iter().map(|e| e.unwrap_or(f64::NAN)));
        row.extend(epoch.covariance.diagonal().iter().map(|v| v.max(0.0).sqrt()));
        row.extend(epoch.inertia.sigma.iter().map(|s| s.unwrap_or(f64::NAN)));
        (epoch.t_ns, row)
    });
    write_rows(path, ESTIMATE_HEADER, rows.collect())
}

/// Writes the upper triangle, row by row, of the 6×6 covariance of each image: (attitude error in inertial axes in rad,
/// rate error in asteroid axes in rad/s).
///
/// # Errors
/// [`TumblingError::Dataset`] names the file.
pub fn write_covariance_csv(path: &Path, result: &TumblingResult) -> Result<(), TumblingError> {
    let upper: Vec<(usize, usize)> = (0..6).flat_map(|i| (i..6).map(move |j| (i, j))).collect();
    let names = upper.iter().map(|&(i, j)| format!("c_{}_{}", ERROR_AXES[i], ERROR_AXES[j]));
    let header = std::iter::once("t_ns".to_string()).chain(names).collect::<Vec<_>>().join(",");
    let rows = result.epochs.iter().map(|e| (e.t_ns, upper.iter().map(|&place| e.covariance[place]).collect()));
    write_rows(path, &header, rows.collect())
}

fn write_rows(path: &Path, header: &str, rows: Vec<(i64, Vec<f64>)>) -> Result<(), TumblingError> {
    Ok(write_timed_table(path, header, rows.iter().map(|(t_ns, row)| (*t_ns, row.as_slice())))?)
}
