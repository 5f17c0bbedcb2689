//! The front end over a whole sequence.

use super::config::{FrontEndConfig, FrontEndMode};
use super::designated::carry_designated;
use super::error::VisionError;
use super::front_end::{DesignatedStep, FrontEnd, TrackInputs};
use super::masks::KeepOut;
use super::pair::{CenterProblem, CenteredPair, PairSolution, rotations_about_center};
use super::tracking::{
    Center, Chain, TrackingContext, Tracks, keyframe_rotations, link, milliseconds, resolve_ambiguous_pairs,
    rotations_in_order,
};
use crate::dataset::{Frame, ImageSequence};
use crate::observations::{PairStatus, TrackObservation};
use crate::settings::limits;
use nalgebra::{Vector2, Vector3};
use std::time::Instant;

/// Wall times of stages, one after the other.
struct Laps {
    since: Instant,
    times_ms: Vec<(&'static str, f64)>,
}

impl Laps {
    fn start() -> Self {
        Laps { since: Instant::now(), times_ms: Vec::new() }
    }

    fn end(&mut self, stage: &'static str) {
        self.times_ms.push((stage, milliseconds(self.since)));
        self.since = Instant::now();
    }
}

/// Runs the front end: features, matches, rotations, tracks, keyframe pairs, the designated point.
///
/// An image that cannot be read, is of the wrong size or without features is reported by status; the images on both
/// sides of it make a pair, and tracks go on over the gap.
///
/// `progress` is told how many images have been read, from any thread. The result does not depend on the number of
/// threads, times aside.
///
/// # Errors
/// Fewer than two images that can be read, a parameter out of range, a mask that does not fit, or OpenCV's refusal.
pub fn track_sequence(
    sequence: &ImageSequence,
    config: &FrontEndConfig,
    inputs: &TrackInputs,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<FrontEnd, VisionError> {
    config.validate()?;
    opencv::core::set_num_threads(1).map_err(VisionError::opencv("set its number of threads"))?;
    let mut chosen = chosen_frames(sequence, inputs)?;
    let keep_out =
        inputs.mask.map(|m| KeepOut::new(m, config.klt.half_px, sequence.sensor.camera.size_px())).transpose()?;
    let context = TrackingContext { sequence, config, prior: inputs.rotation_prior, keep_out };
    let mut laps = Laps::start();
    let mut tracks = Tracks::new();
    let mut chain = link(&context, &chosen, &mut tracks, progress)?;
    laps.end("link");
    let reports = chain.reports()?;
    chosen.retain(|frame| chain.frames.binary_search_by_key(&frame.index, |f| f.report.index).is_ok());
    let center = match config.mode {
        FrontEndMode::Auto => resolve_ambiguous_pairs(&context, &mut chain)?,
        FrontEndMode::FixedCenter => solve_about_center(&context, &mut chain, &mut tracks),
    };
    laps.end("settle");
    let keyframes = keyframe_rotations(&context, &chain, &tracks, center.as_ref())?;
    let rotations = rotations_in_order(&chain, &reports, keyframes);
    laps.end("keyframes");
    let designated = match &inputs.designated {
        Some(start) => carry_designated(&context, &chosen, &tracks, start)?,
        None => Vec::new(),
    };
    laps.end("designated");
    let observations = with_designated(tracks.into_observations(), &designated);
    Ok(FrontEnd {
        observations,
        rotations,
        frames: reports,
        center_in_camera: center.map(|c| c.0),
        center_covariance_rad2: center.map(|c| c.1),
        designated,
        stage_ms: laps.times_ms,
    })
}

fn chosen_frames<'a>(sequence: &'a ImageSequence, inputs: &TrackInputs) -> Result<Vec<&'a Frame>, VisionError> {
    limits::count_from("every", inputs.every, 1)?;
    let end = inputs.frames.end.min(sequence.frames.len());
    let start = inputs.frames.start.min(end);
    let chosen: Vec<&Frame> = sequence.frames[start..end].iter().step_by(inputs.every).collect();
    if chosen.len() < 2 { Err(VisionError::TooFewImages { found: chosen.len() }) } else { Ok(chosen) }
}

fn solve_about_center(context: &TrackingContext, chain: &mut Chain, tracks: &mut Tracks) -> Center {
    let camera = context.camera();
    let middle = Vector2::new(f64::from(camera.width_px), f64::from(camera.height_px)) * 0.5;
    let guesses: Vec<Vector2<f64>> = chain.frames.iter().filter_map(|f| f.centroid_px).collect();
    let mean = guesses.iter().sum::<Vector2<f64>>() / guesses.len().max(1) as f64;
    let guess = if guesses.is_empty() { middle } else { mean };
    let problem = CenterProblem {
        camera,
        center_guess: camera.unproject(&guess).unwrap_or(Vector3::z_axis()),
        config: &context.config.fixed_center,
        rotation: &context.config.rotation,
    };
    let times = |k: usize| (chain.frames[k].report.t_ns, chain.frames[k + 1].report.t_ns);
    let pairs: Vec<CenteredPair> = chain
        .pairs
        .iter()
        .enumerate()
        .map(|(k, pair)| CenteredPair {
            matches: pair.pixels.view(),
            dt_s: (times(k).1 - times(k).0) as f64 * 1e-9,
            predicted: context.predicted(times(k).0, times(k).1),
        })
        .collect();
    let solved = rotations_about_center(&pairs, &problem);
    for (pair, solution) in chain.pairs.iter_mut().zip(solved.pairs) {
        let hopeless = pair.solution.status == PairStatus::NoFeatures;
        pair.solution = if hopeless { PairSolution::failed(PairStatus::NoFeatures, 0) } else { solution };
    }
    chain.extend_tracks(0, tracks, None);
    chain.end_tracks(tracks);
    Some((solved.center_in_camera, solved.center_covariance_rad2))
}

/// The observations with those of the designated point, first in each image.
fn with_designated(observations: Vec<TrackObservation>, designated: &[DesignatedStep]) -> Vec<TrackObservation> {
    if designated.is_empty() {
        return observations;
    }
    let mut all: Vec<TrackObservation> = designated.iter().map(DesignatedStep::observation).collect();
    all.extend(observations);
    all.sort_by_key(|o| (o.t_ns, o.track_id));
    all
}
