//! `relative_rotations.csv`: the rotation of every image pair, with its outcome.

use super::rotation::{PairStatus, RelativeRotation, RotationModel};
use super::text_table::{Row, read_rows};
use crate::dataset::{DatasetError, write_atomically};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use std::path::Path;

const HEADER: &str = "t_ns_from,t_ns_to,qw,qx,qy,qz,sigma_x_rad,sigma_y_rad,sigma_z_rad,matches,inliers,model,status";
/// Greatest 1σ of a rotation that is read, rad: beyond a turn it says nothing, and its square must be a number.
const GREATEST_SIGMA_RAD: f64 = 1e6;

impl RotationModel {
    /// The model's word in files.
    pub fn word(self) -> &'static str {
        match self {
            RotationModel::Essential => "essential",
            RotationModel::Homography => "homography",
            RotationModel::FixedCenter => "fixed-center",
            RotationModel::None => "none",
        }
    }

    const ALL: [Self; 4] = [Self::Essential, Self::Homography, Self::FixedCenter, Self::None];
}

impl PairStatus {
    /// The outcome's word in files.
    pub fn word(self) -> &'static str {
        match self {
            PairStatus::Ok => "ok",
            PairStatus::NoFeatures => "no-features",
            PairStatus::FewMatches => "few-matches",
            PairStatus::Degenerate => "degenerate",
            PairStatus::NoMotion => "no-motion",
            PairStatus::Rejected => "rejected",
        }
    }

    const ALL: [Self; 6] =
        [Self::Ok, Self::NoFeatures, Self::FewMatches, Self::Degenerate, Self::NoMotion, Self::Rejected];
}

/// Writes `relative_rotations.csv`: one row a pair, in the order given. The file keeps the standard deviations, not the
/// correlations.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_relative_rotations(path: &Path, rotations: &[RelativeRotation]) -> Result<(), DatasetError> {
    write_atomically(path, |w| {
        writeln!(w, "{HEADER}")?;
        for r in rotations {
            let q = r.camera_to_from_camera_from;
            let sigma = r.covariance_rad2.diagonal().map(|variance| variance.max(0.0).sqrt());
            write!(w, "{},{},{},{},{},{},", r.t_ns_from, r.t_ns_to, q.w, q.i, q.j, q.k)?;
            write!(w, "{},{},{},{},{},", sigma.x, sigma.y, sigma.z, r.matches, r.inliers)?;
            writeln!(w, "{},{}", r.model.word(), r.status.word())?;
        }
        Ok(())
    })
}

/// Reads `relative_rotations.csv`; covariances come back diagonal.
///
/// # Errors
/// Names the file and line of a wrong header, a wrong column count, a value that is not a number, a quaternion off unit
/// length by more than 1e-6, a negative or absurd σ, or a model or status that is not in the contract.
pub fn read_relative_rotations(path: &Path) -> Result<Vec<RelativeRotation>, DatasetError> {
    read_rows(path, HEADER, parse)
}

fn parse(row: &Row) -> Result<RelativeRotation, String> {
    let q = Quaternion::new(row.number(2)?, row.number(3)?, row.number(4)?, row.number(5)?);
    if (q.norm() - 1.0).abs() > 1e-6 {
        return Err(format!("the quaternion has length {}: it must be 1", q.norm()));
    }
    let sigma = Vector3::new(row.number(6)?, row.number(7)?, row.number(8)?);
    if sigma.min() < 0.0 {
        return Err("a standard deviation is negative".into());
    }
    if sigma.max() > GREATEST_SIGMA_RAD {
        return Err(format!("a standard deviation is {} rad: {GREATEST_SIGMA_RAD} is the most", sigma.max()));
    }
    Ok(RelativeRotation {
        t_ns_from: row.whole(0)?,
        t_ns_to: row.whole(1)?,
        camera_to_from_camera_from: UnitQuaternion::new_unchecked(q),
        covariance_rad2: Matrix3::from_diagonal(&sigma.component_mul(&sigma)),
        matches: row.whole(9)?,
        inliers: row.whole(10)?,
        model: one_of("model", row.word(11), RotationModel::ALL, RotationModel::word)?,
        status: one_of("status", row.word(12), PairStatus::ALL, PairStatus::word)?,
    })
}

fn one_of<T: Copy, const N: usize>(
    name: &str,
    found: &str,
    all: [T; N],
    word: fn(T) -> &'static str,
) -> Result<T, String> {
    let words = || all.map(word).join(", ");
    all.into_iter().find(|t| word(*t) == found).ok_or_else(|| format!("{name} '{found}' is not one of {}", words()))
}
