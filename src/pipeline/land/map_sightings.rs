//! Known points for a descent: each image matched with a map from where the filter predicts the camera.

use crate::dataset::{GroundMap, ImageSequence};
use crate::navigation::landing::{KnownSighting, LandingConfig, LandingInput, SightedByMap, sighted_by_map};
use crate::observations::{PredictedCamera, TrackObservation};
use crate::pipeline::error::PipelineError;
use crate::pipeline::progress::Progress;
use crate::pipeline::settings::LandSettings;
use crate::pipeline::summary::Summary;
use crate::vision::{DesignatedStep, MapFeatures, MapFix, MapMatcher, MapSighting, MapStatus};
use std::time::Instant;

/// Sightings of the map's points in every image of a descent, counted in the summary.
///
/// # Errors
/// Settings out of range, or IMU samples that do not fit the images.
pub(super) fn known_sightings(
    sequence: &ImageSequence,
    (input, settings): (&LandingInput, &LandSettings),
    (map, designated): (&GroundMap, &[DesignatedStep]),
    (progress, summary): (&dyn Progress, &mut Summary),
) -> Result<SightedByMap, PipelineError> {
    let start = Instant::now();
    let means = MapFeatures::of(&settings.front_end);
    let matcher = MapMatcher::new(map, &means, &settings.map)?;
    progress.begin("matching the map", input.frame_times_ns.len());
    let mut look = |camera: &PredictedCamera, t_ns: i64| -> Result<Option<Vec<KnownSighting>>, PipelineError> {
        progress.advance_to(input.frame_times_ns.partition_point(|time_ns| *time_ns <= t_ns));
        let Some(frame) = sequence.frames.iter().find(|f| f.t_ns == t_ns) else { return Ok(None) };
        let Ok(image) = sequence.load(frame) else { return Ok(None) };
        let fix = matcher.sightings(&image, &input.camera, camera)?;
        count(&fix, summary);
        Ok(Some(fix.sightings.iter().map(|s| known_sighting(t_ns, s)).collect()))
    };
    let tracked: Vec<TrackObservation> = designated.iter().map(drifted).collect();
    let landing = LandingConfig { map_shared_ln_scale: settings.map.noise.shared_ln_scale, ..settings.landing.clone() };
    let sighted = sighted_by_map(input, &tracked, &landing, &mut look)?;
    progress.end();
    summary.counts.insert("map_sightings".into(), sighted.known.len());
    summary.timing_ms.insert("map".into(), start.elapsed().as_secs_f64() * 1e3);
    Ok(sighted)
}

/// The designated point as tracked, with 1σ of its pixel and of its drift together.
fn drifted(step: &DesignatedStep) -> TrackObservation {
    TrackObservation { sigma_px: step.covariance_px2.symmetric_eigenvalues().max().sqrt(), ..step.observation() }
}

fn known_sighting(t_ns: i64, sighting: &MapSighting) -> KnownSighting {
    let variance_m2 = (2.0 * sighting.sigma_horizontal_m.powi(2) + sighting.sigma_vertical_m.powi(2)) / 3.0;
    KnownSighting {
        t_ns,
        pixel_px: sighting.pixel_px,
        sigma_px: sighting.sigma_px(),
        point_in_site_m: sighting.point_in_site_m,
        sigma_point_m: variance_m2.sqrt(),
    }
}

fn count(fix: &MapFix, summary: &mut Summary) {
    let name = match fix.status {
        MapStatus::Tracked => "map_frames_tracked",
        MapStatus::Acquired => "map_frames_acquired",
        MapStatus::OffMap => "map_frames_off_map",
        MapStatus::Lost => "map_frames_lost",
    };
    *summary.counts.entry(name.into()).or_default() += 1;
}
