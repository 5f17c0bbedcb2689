//! What a lander believes of itself at the first frame, before any image: `initial_state.csv`.

use super::error::DatasetError;
use super::storage::{TimedRow, read_timed_table, write_timed_table};
use nalgebra::{Isometry3, Translation3, Vector3};
use std::path::Path;

/// A first estimate of the lander's state with independent 1σ, the same on each axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InitialState {
    /// Time in ns.
    pub t_ns: i64,
    /// Estimated pose of the lander in the site frame, m.
    pub site_from_lander: Isometry3<f64>,
    /// Estimated velocity of the lander in the site frame, m/s.
    pub lander_velocity_in_site_m_s: Vector3<f64>,
    /// 1σ of the position, m an axis.
    pub sigma_position_m: f64,
    /// 1σ of the velocity, m/s an axis.
    pub sigma_velocity_m_s: f64,
    /// 1σ of the attitude, rad an axis.
    pub sigma_attitude_rad: f64,
}

const HEADER: &str = "t_ns,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_s,vy_m_s,vz_m_s,sigma_position_m,sigma_velocity_m_s,\
sigma_attitude_rad";

/// Reads `initial_state.csv` under a data set's root.
///
/// # Errors
/// Names the file and line at fault, such as a 1σ that is not positive.
pub fn read_initial_state(root: &Path) -> Result<InitialState, DatasetError> {
    let path = root.join("initial_state.csv");
    let table = read_timed_table(&path, 13)?;
    let TimedRow { t_ns, values: v } = &table.rows[0];
    let rotation = table.rotation(&path, 0, 3)?;
    if v[10..].iter().any(|sigma| *sigma <= 0.0) {
        let problem = "every sigma must be positive".into();
        return Err(DatasetError::Unusable { path, problem });
    }
    let translation = Translation3::new(v[0], v[1], v[2]);
    Ok(InitialState {
        t_ns: *t_ns,
        site_from_lander: Isometry3::from_parts(translation, rotation),
        lander_velocity_in_site_m_s: Vector3::from_column_slice(&v[7..10]),
        sigma_position_m: v[10],
        sigma_velocity_m_s: v[11],
        sigma_attitude_rad: v[12],
    })
}

/// Writes `initial_state.csv` under a data set's root.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_initial_state(root: &Path, state: &InitialState) -> Result<(), DatasetError> {
    let (p, q) = (state.site_from_lander.translation, state.site_from_lander.rotation);
    let v = state.lander_velocity_in_site_m_s;
    let sigmas = [state.sigma_position_m, state.sigma_velocity_m_s, state.sigma_attitude_rad];
    let values = [p.x, p.y, p.z, q.w, q.i, q.j, q.k, v.x, v.y, v.z, sigmas[0], sigmas[1], sigmas[2]];
    write_timed_table(&root.join("initial_state.csv"), HEADER, [(state.t_ns, values.as_slice())])
}
