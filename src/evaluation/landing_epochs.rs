//! A landing result as it stands on disk, epoch by epoch.

use super::error::EvaluationError;
use super::named_table::NamedTable;
use crate::dataset::{DatasetError, TimedRow, read_timed_table};
use nalgebra::{Isometry3, Quaternion, SMatrix, SVector, Translation3, UnitQuaternion, Vector3};
use std::collections::HashMap;
use std::path::Path;

/// One epoch of a landing estimate.
#[derive(Debug, Clone, PartialEq)]
pub struct LandingEpoch {
    /// Time in ns.
    pub t_ns: i64,
    /// Estimated pose of the lander in the site frame, m.
    pub site_from_lander: Isometry3<f64>,
    /// Estimated velocity of the lander in the site frame, m/s.
    pub lander_velocity_in_site_m_s: Vector3<f64>,
    /// Where the estimator believes the ground point of track 0 to lie, site frame, m; the origin where the file does
    /// not say.
    pub designated_in_site_m: Vector3<f64>,
    /// The file's 1σ of x, y, z (m), roll, pitch, yaw (rad), vx, vy, vz (m/s); none where it has no such columns.
    pub sigma: Option<SVector<f64, 9>>,
    /// Covariance of (position m, velocity m/s, ψ rad), site axes, `true_site_from_lander = exp(ψ) * estimated`.
    pub covariance: Option<SMatrix<f64, 9, 9>>,
}

const DESIGNATED: [&str; 3] = ["designated_x_m", "designated_y_m", "designated_z_m"];

/// Reads `estimate.csv` and, if it is there, `covariance.csv` of a landing result.
pub fn read_landing_epochs(result_folder: &Path) -> Result<Vec<LandingEpoch>, EvaluationError> {
    let table = NamedTable::read(&result_folder.join("estimate.csv"))?;
    let times = table.times("t_ns")?;
    let pose = table.places(["x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"])?;
    let velocity = table.places(["vx_m_s", "vy_m_s", "vz_m_s"])?;
    let sigma_names = ["x_m", "y_m", "z_m", "roll_rad", "pitch_rad", "yaw_rad", "vx_m_s", "vy_m_s", "vz_m_s"]
        .map(|n| format!("sigma_{n}"));
    let sigma = table.places(sigma_names.each_ref().map(String::as_str)).ok();
    let designated = table.places(DESIGNATED).ok();
    let covariances = read_covariances::<9>(&result_folder.join("covariance.csv"))?;
    let epoch = |(row, t_ns): (usize, &i64)| {
        let p = table.numbers(row, &pose)?;
        let rotation = rotation(&table, row, [pose[3], pose[4], pose[5], pose[6]])?;
        let sigma = sigma.map(|places| table.numbers(row, &places)).transpose()?;
        Ok(LandingEpoch {
            t_ns: *t_ns,
            site_from_lander: Isometry3::from_parts(Translation3::new(p[0], p[1], p[2]), rotation),
            lander_velocity_in_site_m_s: Vector3::from(table.numbers(row, &velocity)?),
            designated_in_site_m: match designated {
                Some(places) => Vector3::from(table.numbers(row, &places)?),
                None => Vector3::zeros(),
            },
            sigma: sigma.map(SVector::from),
            covariance: covariances.get(t_ns).copied(),
        })
    };
    times.iter().enumerate().map(epoch).collect()
}

/// Unit quaternion from the columns qw, qx, qy, qz of a row.
pub fn rotation(table: &NamedTable, row: usize, places: [usize; 4]) -> Result<UnitQuaternion<f64>, EvaluationError> {
    let [w, x, y, z] = table.numbers(row, &places)?;
    let q = Quaternion::new(w, x, y, z);
    if (q.norm() - 1.0).abs() > 1e-2 {
        return Err(table.malformed(row, places[0], "begins a quaternion whose length is not 1"));
    }
    Ok(UnitQuaternion::from_quaternion(q))
}

/// Covariances by time, stored as upper triangles row by row; empty where there is no file.
pub fn read_covariances<const N: usize>(path: &Path) -> Result<HashMap<i64, SMatrix<f64, N, N>>, DatasetError> {
    if !path.is_file() {
        return Ok(HashMap::new());
    }
    let table = read_timed_table(path, N * (N + 1) / 2)?;
    let matrix = |row: &TimedRow| {
        let mut covariance = SMatrix::<f64, N, N>::zeros();
        let mut values = row.values.iter();
        for i in 0..N {
            for j in i..N {
                let value = *values.next().expect("the table has the columns of a triangle");
                covariance[(i, j)] = value;
                covariance[(j, i)] = value;
            }
        }
        (row.t_ns, covariance)
    };
    Ok(table.rows.iter().map(matrix).collect())
}
