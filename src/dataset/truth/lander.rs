//! True states of a spacecraft: `truth/state.csv`, EuRoC's `state_groundtruth`.

use super::layout::truth_folder;
use crate::dataset::error::DatasetError;
use crate::dataset::storage::{TimedRow, read_timed_table, write_timed_table};
use nalgebra::{Isometry3, Translation3, Vector3};
use std::path::Path;

/// True state of the lander, EuRoC's `state_groundtruth`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LanderState {
    /// Time in ns.
    pub t_ns: i64,
    /// Pose of the lander in the site frame, m.
    pub site_from_lander: Isometry3<f64>,
    /// Velocity of the lander in the site frame, m/s.
    pub lander_velocity_in_site_m_s: Vector3<f64>,
    /// Gyroscope bias in lander axes, rad/s.
    pub gyro_bias_rad_s: Vector3<f64>,
    /// Accelerometer bias in lander axes, m/s².
    pub accelerometer_bias_m_s2: Vector3<f64>,
}

const STATE_HEADER: &str = "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], \
q_RS_z [], v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], b_w_RS_S_y [rad s^-1], \
b_w_RS_S_z [rad s^-1], b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], b_a_RS_S_z [m s^-2]";

/// Writes `truth/state.csv` under a data set's root.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_lander_states(root: &Path, states: &[LanderState]) -> Result<(), DatasetError> {
    write_node_states(root, None, states)
}

/// Writes `state.csv` of one of several spacecraft, `truth/node1/state.csv`.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_node_states(root: &Path, node: Option<u32>, states: &[LanderState]) -> Result<(), DatasetError> {
    let rows: Vec<(i64, [f64; 16])> = states.iter().map(|s| (s.t_ns, lander_columns(s))).collect();
    let path = truth_folder(root, node).join("state.csv");
    write_timed_table(&path, STATE_HEADER, rows.iter().map(|(t, v)| (*t, v.as_slice())))
}

fn lander_columns(s: &LanderState) -> [f64; 16] {
    let (p, q) = (s.site_from_lander.translation, s.site_from_lander.rotation);
    let (v, g, a) = (s.lander_velocity_in_site_m_s, s.gyro_bias_rad_s, s.accelerometer_bias_m_s2);
    [p.x, p.y, p.z, q.w, q.i, q.j, q.k, v.x, v.y, v.z, g.x, g.y, g.z, a.x, a.y, a.z]
}

/// Reads `truth/state.csv` under a data set's root.
///
/// # Errors
/// Names the file and line at fault.
pub fn read_lander_states(root: &Path) -> Result<Vec<LanderState>, DatasetError> {
    read_node_states(root, None)
}

/// Reads `state.csv` of one of several spacecraft, `truth/node1/state.csv`.
///
/// # Errors
/// Names the file and line at fault.
pub fn read_node_states(root: &Path, node: Option<u32>) -> Result<Vec<LanderState>, DatasetError> {
    let path = truth_folder(root, node).join("state.csv");
    let table = read_timed_table(&path, 16)?;
    let state = |(index, row): (usize, &TimedRow)| {
        let v = &row.values;
        let rotation = table.rotation(&path, index, 3)?;
        Ok(LanderState {
            t_ns: row.t_ns,
            site_from_lander: Isometry3::from_parts(Translation3::new(v[0], v[1], v[2]), rotation),
            lander_velocity_in_site_m_s: Vector3::from_column_slice(&v[7..10]),
            gyro_bias_rad_s: Vector3::from_column_slice(&v[10..13]),
            accelerometer_bias_m_s2: Vector3::from_column_slice(&v[13..16]),
        })
    };
    table.rows.iter().enumerate().map(state).collect()
}
