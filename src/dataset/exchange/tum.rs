//! Trajectories in the TUM format: `t x y z qx qy qz qw`, time in seconds.

use crate::dataset::error::DatasetError;
use crate::dataset::storage::{parse_finite, read_text, seconds_to_ns, write_atomically};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use std::path::Path;

/// A pose with its time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StampedPose {
    /// Time in ns.
    pub t_ns: i64,
    /// Pose of the moving frame in the reference frame, `reference_from_moving` (m).
    pub reference_from_moving: Isometry3<f64>,
}

/// Writes poses with nanosecond time stamps.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_tum(path: &Path, poses: &[StampedPose]) -> Result<(), DatasetError> {
    write_atomically(path, |w| {
        for pose in poses {
            let t = &pose.reference_from_moving.translation;
            let q = &pose.reference_from_moving.rotation;
            let sign = if pose.t_ns < 0 { "-" } else { "" };
            let (s, ns) = (pose.t_ns.unsigned_abs() / 1_000_000_000, pose.t_ns.unsigned_abs() % 1_000_000_000);
            writeln!(w, "{sign}{s}.{ns:09} {} {} {} {} {} {} {}", t.x, t.y, t.z, q.i, q.j, q.k, q.w)?;
        }
        Ok(())
    })
}

/// Reads poses; lines that start with `#` are comments.
///
/// # Errors
/// Names the file and line of what is not eight finite numbers, a zero quaternion, or times out of order; a file
/// without poses is an error too.
pub fn read_tum(path: &Path) -> Result<Vec<StampedPose>, DatasetError> {
    let text = read_text(path)?;
    let mut poses: Vec<StampedPose> = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let malformed =
            |problem: String| DatasetError::Malformed { path: path.into(), line: index as u64 + 1, problem };
        if line.trim().is_empty() || line.trim_start().starts_with('#') {
            continue;
        }
        let fields: Vec<&str> = line.split_whitespace().collect();
        if fields.len() != 8 {
            return Err(malformed(format!("{} columns found, 8 expected (t x y z qx qy qz qw)", fields.len())));
        }
        let v: Vec<f64> = fields[1..].iter().map(|f| parse_finite(f).map_err(&malformed)).collect::<Result<_, _>>()?;
        let q = Quaternion::new(v[6], v[3], v[4], v[5]);
        if q.norm() < 1e-6 {
            return Err(malformed("the quaternion is zero".into()));
        }
        if q.norm() > 1e6 {
            return Err(malformed(format!("the quaternion's length is {}, 1 expected", q.norm())));
        }
        let t_ns = seconds_to_ns(fields[0]).ok_or_else(|| malformed(format!("'{}' is not a time", fields[0])))?;
        if poses.last().is_some_and(|last| last.t_ns >= t_ns) {
            return Err(malformed("time does not come after the one before it".into()));
        }
        let rotation = UnitQuaternion::from_quaternion(q);
        let pose = Isometry3::from_parts(Translation3::new(v[0], v[1], v[2]), rotation);
        poses.push(StampedPose { t_ns, reference_from_moving: pose });
    }
    if poses.is_empty() {
        return Err(DatasetError::Unusable { path: path.into(), problem: "it has no poses".into() });
    }
    Ok(poses)
}
