//! Landmarks on the surface and where they fall in the images.

use super::layout::truth_folder;
use crate::dataset::error::DatasetError;
use crate::dataset::storage::{read_text, write_atomically};
use nalgebra::{Vector2, Vector3};
use serde::Deserialize;
use std::path::Path;

/// A point on the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Landmark {
    /// Number, from 0.
    pub id: u32,
    /// Position in the reference frame (site or asteroid), m.
    pub position_m: Vector3<f64>,
}

/// Where a landmark falls in an image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LandmarkObservation {
    /// Time of the frame in ns.
    pub t_ns: i64,
    /// Number of the camera.
    pub camera: u32,
    /// The landmark.
    pub id: u32,
    /// Exact pixel.
    pub pixel_px: Vector2<f64>,
    /// Inside the image and not hidden by the surface.
    pub visible: bool,
}

#[derive(Deserialize)]
struct LandmarkRow {
    id: u32,
    x_m: f64,
    y_m: f64,
    z_m: f64,
}

#[derive(Deserialize)]
struct ObservationRow {
    t_ns: i64,
    cam: u32,
    id: u32,
    u_px: f64,
    v_px: f64,
    visible: u8,
}

/// Writes `truth/landmarks.csv` under a data set's root.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_landmarks(root: &Path, landmarks: &[Landmark]) -> Result<(), DatasetError> {
    write_atomically(&root.join("truth/landmarks.csv"), |w| {
        writeln!(w, "id,x_m,y_m,z_m")?;
        landmarks.iter().try_for_each(|l| {
            let p = l.position_m;
            writeln!(w, "{},{},{},{}", l.id, p.x, p.y, p.z)
        })
    })
}

/// Writes `observations.csv` of a spacecraft: `truth/observations.csv`, or `truth/node1/observations.csv` where there
/// are several.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_observations(
    root: &Path,
    node: Option<u32>,
    observations: &[LandmarkObservation],
) -> Result<(), DatasetError> {
    write_atomically(&truth_folder(root, node).join("observations.csv"), |w| {
        writeln!(w, "t_ns,cam,id,u_px,v_px,visible")?;
        observations.iter().try_for_each(|o| {
            let visible = u8::from(o.visible);
            writeln!(w, "{},{},{},{},{},{visible}", o.t_ns, o.camera, o.id, o.pixel_px.x, o.pixel_px.y)
        })
    })
}

/// Reads `truth/landmarks.csv` under a data set's root.
///
/// # Errors
/// Names the file and the row at fault.
pub fn read_landmarks(root: &Path) -> Result<Vec<Landmark>, DatasetError> {
    let rows: Vec<LandmarkRow> = read_rows(&root.join("truth/landmarks.csv"))?;
    Ok(rows.iter().map(|r| Landmark { id: r.id, position_m: Vector3::new(r.x_m, r.y_m, r.z_m) }).collect())
}

/// Reads `observations.csv` of a spacecraft.
///
/// # Errors
/// Names the file and the row at fault.
pub fn read_observations(root: &Path, node: Option<u32>) -> Result<Vec<LandmarkObservation>, DatasetError> {
    let rows: Vec<ObservationRow> = read_rows(&truth_folder(root, node).join("observations.csv"))?;
    let observation = |r: &ObservationRow| LandmarkObservation {
        t_ns: r.t_ns,
        camera: r.cam,
        id: r.id,
        pixel_px: Vector2::new(r.u_px, r.v_px),
        visible: r.visible != 0,
    };
    Ok(rows.iter().map(observation).collect())
}

fn read_rows<Row: for<'a> Deserialize<'a>>(path: &Path) -> Result<Vec<Row>, DatasetError> {
    let text = read_text(path)?;
    let malformed = |e: csv::Error| DatasetError::Malformed {
        path: path.into(),
        line: e.position().map_or(0, csv::Position::line),
        problem: e.to_string(),
    };
    csv::Reader::from_reader(text.as_bytes()).deserialize().collect::<Result<_, _>>().map_err(malformed)
}
