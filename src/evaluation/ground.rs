//! The ground that the track of the designated point was really on.

use super::error::EvaluationError;
use super::named_table::NamedTable;
use super::true_camera::TrueCamera;
use crate::observations::TrackObservation;
use nalgebra::{Vector2, Vector3};
use std::path::Path;

/// Where the designated point's track began and ended on the true surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackedGround {
    /// Time of the last image in which the point was tracked, ns.
    pub last_t_ns: i64,
    /// Surface point (m, site) under the first observation.
    pub first_in_site_m: Option<Vector3<f64>>,
    /// Surface point (m, site) under the last observation.
    pub last_in_site_m: Option<Vector3<f64>>,
    /// Greatest distance in px of an observation from where the first point lies in the image, over the images taken
    /// from further away than [`TrackedGround::FAR_M`].
    pub far_error_px: Option<f64>,
}

impl TrackedGround {
    /// Slant range in m beyond which the point's pixel is judged.
    pub const FAR_M: f64 = 3000.0;
}

/// One row of `tracks.csv`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackedPixel {
    /// Time in ns.
    pub t_ns: i64,
    /// The track's number.
    pub track_id: u64,
    /// Pixel (u, v).
    pub pixel_px: Vector2<f64>,
}

/// Reads `tracks.csv` of a result; nothing where there is none.
pub fn read_tracks(result_folder: &Path) -> Result<Vec<TrackedPixel>, EvaluationError> {
    let path = result_folder.join("tracks.csv");
    if !path.is_file() {
        return Ok(vec![]);
    }
    let table = NamedTable::read(&path)?;
    let [t, id, u, v] = table.places(["t_ns", "track_id", "u_px", "v_px"])?;
    let pixel = |row: usize| {
        let track_id = u64::try_from(table.integer(row, id)?).map_err(|_| table.malformed(row, id, "is negative"))?;
        let pixel_px = Vector2::new(table.number(row, u)?, table.number(row, v)?);
        Ok(TrackedPixel { t_ns: table.integer(row, t)?, track_id, pixel_px })
    };
    (0..table.len()).map(pixel).collect()
}

/// Ground under the designated point's track; `None` if it was never tracked.
pub fn tracked_ground(tracks: &[TrackedPixel], camera: &TrueCamera) -> Result<Option<TrackedGround>, EvaluationError> {
    let designated = || tracks.iter().filter(|o| o.track_id == TrackObservation::DESIGNATED);
    let (Some(first), Some(last)) = (designated().min_by_key(|o| o.t_ns), designated().max_by_key(|o| o.t_ns)) else {
        return Ok(None);
    };
    let under = |seen: &TrackedPixel| -> Result<Option<Vector3<f64>>, EvaluationError> {
        let depth = camera.depth(seen.t_ns)?;
        Ok(depth.and_then(|depth| camera.surface_point(seen.t_ns, &seen.pixel_px, &depth)))
    };
    let first_in_site_m = under(first)?;
    let error_px = |seen: &TrackedPixel| {
        let point = first_in_site_m.as_ref()?;
        let camera_in_site_m = camera.reference_from_camera(seen.t_ns)?.translation.vector;
        let far = (point - camera_in_site_m).norm() > TrackedGround::FAR_M;
        Some((seen.pixel_px - camera.pixel_of(seen.t_ns, point)?).norm()).filter(|_| far)
    };
    Ok(Some(TrackedGround {
        last_t_ns: last.t_ns,
        first_in_site_m,
        last_in_site_m: under(last)?,
        far_error_px: designated().filter_map(error_px).reduce(f64::max),
    }))
}
