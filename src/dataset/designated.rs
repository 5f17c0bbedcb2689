//! The designated landing point: its pixel in the first frame.

use super::error::DatasetError;
use super::storage::{read_timed_table, write_timed_table};
use nalgebra::{Matrix2, Vector2};
use std::path::Path;

/// Pixel of the landing point in one frame, with its covariance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DesignatedPoint {
    /// Time of the frame in ns.
    pub t_ns: i64,
    /// Pixel (u, v).
    pub pixel_px: Vector2<f64>,
    /// Covariance in px².
    pub covariance_px2: Matrix2<f64>,
}

const HEADER: &str = "t_ns,u_px,v_px,var_u_px2,cov_uv_px2,var_v_px2";

/// Reads `designated.csv` under a data set's root.
///
/// # Errors
/// Names the file and line at fault, such as a covariance that is not positive definite.
pub fn read_designated(root: &Path) -> Result<DesignatedPoint, DatasetError> {
    let path = root.join("designated.csv");
    let table = read_timed_table(&path, 5)?;
    let row = &table.rows[0];
    let v = &row.values;
    let covariance = Matrix2::new(v[2], v[3], v[3], v[4]);
    if covariance.cholesky().is_none() {
        let problem = "the covariance of the designated point is not positive definite".into();
        return Err(DatasetError::Unusable { path, problem });
    }
    Ok(DesignatedPoint { t_ns: row.t_ns, pixel_px: Vector2::new(v[0], v[1]), covariance_px2: covariance })
}

/// Writes `designated.csv` under a data set's root.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_designated(root: &Path, point: &DesignatedPoint) -> Result<(), DatasetError> {
    let (p, c) = (point.pixel_px, point.covariance_px2);
    let values = [p.x, p.y, c[(0, 0)], c[(0, 1)], c[(1, 1)]];
    write_timed_table(&root.join("designated.csv"), HEADER, [(point.t_ns, values.as_slice())])
}
