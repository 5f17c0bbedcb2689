//! A tumbling result as it stands on disk, epoch by epoch.

use super::error::EvaluationError;
use super::landing_epochs::{read_covariances, rotation};
use super::named_table::NamedTable;
use nalgebra::{SMatrix, UnitQuaternion, Vector3};
use std::path::Path;

/// Names of the five inertia ratios; the sixth element Lzz is 1.
pub const INERTIA_NAMES: [&str; 5] = ["Lxx", "Lyy", "Lxy", "Lxz", "Lyz"];

/// One epoch of a tumbling estimate, in the estimator's asteroid axes (the camera's axes at the start).
#[derive(Debug, Clone, PartialEq)]
pub struct TumblingEpoch {
    /// Time in ns.
    pub t_ns: i64,
    /// Estimated attitude; inertial axes are the camera's.
    pub asteroid_from_inertial: UnitQuaternion<f64>,
    /// Estimated rate in asteroid axes, rad/s.
    pub rate_in_asteroid_rad_s: Vector3<f64>,
    /// Estimated Lxx, Lyy, Lxy, Lxz, Lyz in units of Lzz; none where not determined.
    pub inertia: [Option<f64>; 5],
    /// 1σ of each.
    pub inertia_sigma: [Option<f64>; 5],
    /// Covariance of (attitude error in inertial axes in rad, rate error in asteroid axes in rad/s), the attitude error
    /// being `truth.minus(estimate)`: `true_asteroid_from_inertial = estimated * exp(d)`.
    pub covariance: Option<SMatrix<f64, 6, 6>>,
}

/// Reads `estimate.csv` and, if it is there, `covariance.csv` of a tumbling result.
pub fn read_tumbling_epochs(result_folder: &Path) -> Result<Vec<TumblingEpoch>, EvaluationError> {
    let table = NamedTable::read(&result_folder.join("estimate.csv"))?;
    let times = table.times("t_ns")?;
    let attitude = table.places(["qw", "qx", "qy", "qz"])?;
    let rate = table.places(["wx_rad_s", "wy_rad_s", "wz_rad_s"])?;
    let inertia = table.places(INERTIA_NAMES)?;
    let sigma = INERTIA_NAMES.map(|name| table.column(&format!("sigma_{name}")).ok());
    let covariances = read_covariances::<6>(&result_folder.join("covariance.csv"))?;
    let epoch = |(row, t_ns): (usize, &i64)| {
        Ok(TumblingEpoch {
            t_ns: *t_ns,
            asteroid_from_inertial: rotation(&table, row, attitude)?,
            rate_in_asteroid_rad_s: Vector3::from(table.numbers(row, &rate)?),
            inertia: inertia.map(|column| table.optional(row, column)),
            inertia_sigma: sigma.map(|column| table.optional(row, column?)),
            covariance: covariances.get(t_ns).copied(),
        })
    };
    times.iter().enumerate().map(epoch).collect()
}
