//! True motion and inertia of a small body: `truth/asteroid.csv` and `truth/asteroid.json`.

use crate::dataset::error::DatasetError;
use crate::dataset::storage::{TimedRow, read_text, read_timed_table, write_text, write_timed_table};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// True attitude and rate of a small body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AsteroidState {
    /// Time in ns.
    pub t_ns: i64,
    /// Attitude: takes inertial axes to asteroid axes.
    pub asteroid_from_inertial: UnitQuaternion<f64>,
    /// Angular rate in asteroid axes, rad/s.
    pub rate_in_asteroid_rad_s: Vector3<f64>,
}

/// True inertia of a small body, `asteroid.json`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct AsteroidInertia {
    /// Inertia tensor in asteroid axes (rows), to scale only.
    pub inertia: [[f64; 3]; 3],
}

impl AsteroidInertia {
    /// The tensor as a matrix.
    pub fn matrix(&self) -> Matrix3<f64> {
        Matrix3::from_fn(|row, column| self.inertia[row][column])
    }
}

/// Writes `truth/asteroid.csv` and `truth/asteroid.json` under a data set's root.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_asteroid(root: &Path, states: &[AsteroidState], inertia: &AsteroidInertia) -> Result<(), DatasetError> {
    let rows: Vec<(i64, [f64; 7])> = states
        .iter()
        .map(|s| {
            let (q, w) = (s.asteroid_from_inertial, s.rate_in_asteroid_rad_s);
            (s.t_ns, [q.w, q.i, q.j, q.k, w.x, w.y, w.z])
        })
        .collect();
    let header = "t_ns,qw,qx,qy,qz,wx_rad_s,wy_rad_s,wz_rad_s";
    write_timed_table(&root.join("truth/asteroid.csv"), header, rows.iter().map(|(t, v)| (*t, v.as_slice())))?;
    let text = serde_json::to_string_pretty(inertia).expect("an inertia tensor is plain data");
    write_text(&root.join("truth/asteroid.json"), &text)
}

/// Reads `truth/asteroid.csv` and `truth/asteroid.json` under a data set's root.
///
/// # Errors
/// Names the file and line at fault.
pub fn read_asteroid(root: &Path) -> Result<(Vec<AsteroidState>, AsteroidInertia), DatasetError> {
    let path = root.join("truth/asteroid.csv");
    let table = read_timed_table(&path, 7)?;
    let state = |(index, row): (usize, &TimedRow)| {
        Ok(AsteroidState {
            t_ns: row.t_ns,
            asteroid_from_inertial: table.rotation(&path, index, 0)?,
            rate_in_asteroid_rad_s: Vector3::from_column_slice(&row.values[4..7]),
        })
    };
    let states = table.rows.iter().enumerate().map(state).collect::<Result<_, _>>()?;
    Ok((states, read_inertia(&root.join("truth/asteroid.json"))?))
}

fn read_inertia(path: &Path) -> Result<AsteroidInertia, DatasetError> {
    let text = read_text(path)?;
    let unusable = |problem: String| DatasetError::Unusable { path: path.into(), problem };
    let inertia: AsteroidInertia = serde_json::from_str(&text).map_err(|e| unusable(e.to_string()))?;
    let matrix = inertia.matrix();
    let symmetric = (matrix - matrix.transpose()).abs().max() <= 1e-9 * matrix.abs().max();
    if !symmetric || matrix.cholesky().is_none() {
        return Err(unusable("the inertia is not a symmetric positive definite tensor".into()));
    }
    Ok(inertia)
}
