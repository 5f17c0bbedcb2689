//! The section of a result folder.

use super::mission::{MissionReport, mission_section};
use super::page::{PageImage, Section};
use crate::evaluation::{Metrics, Mission, Summary};
use crate::report::error::ReportError;
use std::path::Path;

/// Section of an evaluated result folder (`summary.json`, `metrics.json`, `metrics_series.json`).
///
/// # Errors
/// Names the file that is missing or malformed.
pub fn result_section(result_folder: &Path, images: Vec<PageImage>) -> Result<Section, ReportError> {
    let summary = Summary::read(result_folder)?;
    let metrics = Metrics::read(result_folder)?;
    let (heading, done) = match summary.mission {
        Mission::Landing => (
            "Landing",
            "A lander finds its position, velocity and attitude above the designated point from an inertial unit and one \
             camera. Every error below is the truth less the estimate. The site's origin is known only through the pixel \
             that designates it in the first picture; what counts for a landing is the place above the ground point that \
             is really tracked from there.",
        ),
        Mission::Tumbling => (
            "Tumbling body",
            "The attitude, the angular rate and the inertia ratios of a small body are found from pictures of one camera. \
             Every error below is the truth less the estimate; the asteroid's axes are the camera's at the start.",
        ),
        Mission::Tracking => (
            "Tracking",
            "Features are extracted, matched and tracked through a sequence, and the rotation between pictures is \
             recovered from them.",
        ),
    };
    let object = &summary.object;
    let done = done.to_string();
    mission_section(&MissionReport { heading: heading.into(), done, images, metrics: &metrics, summary: object })
}
