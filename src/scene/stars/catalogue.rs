//! Star catalogues.

use crate::scene::error::SceneError;
use nalgebra::{Unit, Vector3};
use serde::Deserialize;
use std::path::Path;

/// A star.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Star {
    /// Its direction, in the axes that the owner names.
    pub direction: Unit<Vector3<f64>>,
    /// Apparent magnitude in V.
    pub magnitude: f64,
}

/// One line of a catalogue; other columns are left alone.
#[derive(Debug, Deserialize)]
struct Row {
    ra_deg: f64,
    dec_deg: f64,
    magnitude: f64,
}

/// Name that errors give the built-in catalogue.
const BUILT_IN: &str = "bright_stars.csv";

impl Star {
    /// The brightest stars, in ICRF axes.
    pub fn brightest() -> Vec<Star> {
        read(include_bytes!("bright_stars.csv"), Path::new(BUILT_IN)).expect("the built-in catalogue is well formed")
    }

    /// Stars of a CSV file with the columns `ra_deg`, `dec_deg` and `magnitude`, in ICRF axes.
    ///
    /// # Errors
    /// Names the file, the line and the column at fault.
    pub fn read_csv(path: &Path) -> Result<Vec<Star>, SceneError> {
        let bytes = std::fs::read(path).map_err(|source| SceneError::Io {
            action: "read the star catalogue",
            path: path.into(),
            source,
        })?;
        read(&bytes, path)
    }
}

fn read(bytes: &[u8], path: &Path) -> Result<Vec<Star>, SceneError> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(bytes);
    let mut stars = Vec::new();
    for (index, row) in reader.deserialize::<Row>().enumerate() {
        let row = row.map_err(|error| SceneError::Malformed {
            path: path.into(),
            line: error.position().map_or(index as u64 + 2, csv::Position::line),
            problem: format!("not a star ({error}): give the columns ra_deg, dec_deg and magnitude"),
        })?;
        let is_star = row.ra_deg.is_finite() && row.dec_deg.abs() <= 90.0 && row.magnitude.abs() < 100.0;
        if !is_star {
            let problem = format!(
                "ra_deg {}, dec_deg {}, magnitude {}: the declination is -90 to 90, all are finite numbers",
                row.ra_deg, row.dec_deg, row.magnitude
            );
            return Err(SceneError::Malformed { path: path.into(), line: index as u64 + 2, problem });
        }
        stars.push(star(&row));
    }
    Ok(stars)
}

fn star(row: &Row) -> Star {
    let (sin_ra, cos_ra) = row.ra_deg.to_radians().sin_cos();
    let (sin_dec, cos_dec) = row.dec_deg.to_radians().sin_cos();
    let direction = Unit::new_normalize(Vector3::new(cos_dec * cos_ra, cos_dec * sin_ra, sin_dec));
    Star { direction, magnitude: row.magnitude }
}
