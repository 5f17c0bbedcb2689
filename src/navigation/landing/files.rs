//! Result files.

use super::result::LandingResult;
use crate::dataset::{DatasetError, write_timed_table};
use std::path::Path;

const ESTIMATE_HEADER: &str = "t_ns,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_s,vy_m_s,vz_m_s,sigma_x_m,sigma_y_m,sigma_z_m,\
sigma_vx_m_s,sigma_vy_m_s,sigma_vz_m_s,sigma_roll_rad,sigma_pitch_rad,sigma_yaw_rad,\
designated_x_m,designated_y_m,designated_z_m";

const ERRORS: [&str; 9] = ["x", "y", "z", "vx", "vy", "vz", "roll", "pitch", "yaw"];

/// Writes `estimate.csv`: pose (`site_from_lander`) and velocity in the site frame, then 1σ of each; roll, pitch and yaw
/// are small turns about the site's x, y and z axes; last, where the designated point is believed to lie.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_estimate_csv(path: &Path, result: &LandingResult) -> Result<(), DatasetError> {
    let row = |epoch: &super::result::LandingEpoch| {
        let (p, q) = (epoch.site_from_lander.translation, epoch.site_from_lander.rotation);
        let v = epoch.lander_velocity_in_site_m_s;
        let mut row = vec![p.x, p.y, p.z, q.w, q.i, q.j, q.k, v.x, v.y, v.z];
        row.extend(epoch.sigma());
        row.extend(epoch.designated_in_site_m.iter());
        (epoch.t_ns, row)
    };
    let rows: Vec<(i64, Vec<f64>)> = result.epochs.iter().map(row).collect();
    write_timed_table(path, ESTIMATE_HEADER, rows.iter().map(|(t, v)| (*t, v.as_slice())))
}

/// Writes `covariance.csv`: the upper triangle, row by row, of the covariance of position (m), velocity (m/s) and
/// attitude (rad) errors in site axes.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_covariance_csv(path: &Path, result: &LandingResult) -> Result<(), DatasetError> {
    let upper = || (0..9).flat_map(|row| (row..9).map(move |column| (row, column)));
    let names: Vec<String> = upper().map(|(row, column)| format!("cov_{}_{}", ERRORS[row], ERRORS[column])).collect();
    let header = format!("t_ns,{}", names.join(","));
    let rows: Vec<(i64, Vec<f64>)> =
        result.epochs.iter().map(|e| (e.t_ns, upper().map(|entry| e.covariance[entry]).collect())).collect();
    write_timed_table(path, &header, rows.iter().map(|(t, v)| (*t, v.as_slice())))
}
