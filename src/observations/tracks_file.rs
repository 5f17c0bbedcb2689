//! `tracks.csv`: where every track was seen.

use super::text_table::{Row, read_rows};
use super::track::TrackObservation;
use crate::dataset::{DatasetError, write_atomically};
use nalgebra::Vector2;
use std::path::Path;

const HEADER: &str = "t_ns,track_id,u_px,v_px,sigma_px,response";

/// Writes `tracks.csv`: one row an observation, in the order given, numbers with every digit.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_tracks(path: &Path, observations: &[TrackObservation]) -> Result<(), DatasetError> {
    write_atomically(path, |w| {
        writeln!(w, "{HEADER}")?;
        for o in observations {
            let (u_px, v_px) = (o.pixel_px.x, o.pixel_px.y);
            writeln!(w, "{},{},{u_px},{v_px},{},{}", o.t_ns, o.track_id, o.sigma_px, o.response)?;
        }
        Ok(())
    })
}

/// Reads `tracks.csv`.
///
/// # Errors
/// Names the file and line of a wrong header, a wrong column count, a value that is not a finite number, a σ that is
/// not positive, or time stamps that go back.
pub fn read_tracks(path: &Path) -> Result<Vec<TrackObservation>, DatasetError> {
    let observations = read_rows(path, HEADER, parse)?;
    if let Some(index) = observations.windows(2).position(|w| w[1].t_ns < w[0].t_ns) {
        let problem = "its time stamp lies before the one above: sort the rows by time".into();
        return Err(DatasetError::Malformed { path: path.into(), line: index as u64 + 3, problem });
    }
    Ok(observations)
}

fn parse(row: &Row) -> Result<TrackObservation, String> {
    let observation = TrackObservation {
        t_ns: row.whole(0)?,
        track_id: row.whole(1)?,
        pixel_px: Vector2::new(row.number(2)?, row.number(3)?),
        sigma_px: row.number(4)?,
        response: row.number(5)?,
    };
    if observation.sigma_px <= 0.0 {
        return Err(format!("sigma_px is {}: it must be positive", observation.sigma_px));
    }
    Ok(observation)
}
