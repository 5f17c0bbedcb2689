//! The front end over a whole sequence.

use super::adjacent_pair::{Pair, solve_sharp_pair};
use super::designated::carry_designated;
use super::fixed_center::{CenterProblem, CenteredPair, rotations_about_center};
use super::frame_features::FrameFeatures;
use super::front_end::{DesignatedStep, FrameReport, FrontEnd, RotationPrediction, TrackInputs};
use super::keyframes::keyframe_rotations;
use super::pair_order::rotations_in_order;
use super::rivals::settle_rivals;
use super::tracks::Tracks;
use super::{
    FrameStatus, FrontEndConfig, FrontEndMode, PairSolution, PairStatus, RelativeRotation, RotationModel,
    TrackObservation, VisionError,
};
use crate::dataset::{Frame, ImageSequence};
use crate::geometry::Camera;
use nalgebra::{Matrix2, Unit, UnitQuaternion, Vector2, Vector3};
use rayon::prelude::*;

/// Pictures held in memory at a time.
const CHUNK: usize = 8;

/// Everything about the usable pictures of a sequence and the pairs of each with the next; reports of the others.
pub(super) struct Chain {
    pub(super) frames: Vec<FrameFeatures>,
    pub(super) pairs: Vec<Pair>,
    pub(super) lost: Vec<FrameReport>,
}

/// The fixed part of the work.
pub(super) struct Job<'a> {
    pub(super) sequence: &'a ImageSequence,
    pub(super) config: &'a FrontEndConfig,
    pub(super) prior: Option<RotationPrediction<'a>>,
}

/// The centre of rotation with its covariance, in the fixed-centre mode.
pub(super) type Center = Option<(Unit<Vector3<f64>>, Matrix2<f64>)>;

impl Job<'_> {
    pub(super) fn camera(&self) -> &Camera {
        &self.sequence.sensor.camera
    }

    pub(super) fn predicted(&self, t_ns_from: i64, t_ns_to: i64) -> Option<UnitQuaternion<f64>> {
        self.prior.and_then(|prior| prior(t_ns_from, t_ns_to))
    }
}

/// Runs the front end: features, matches, rotations, tracks, keyframe pairs, the designated point.
///
/// A picture that cannot be read, is of the wrong size or without features is reported by status; the pictures on both
/// sides of it make a pair, and tracks go on over the gap.
///
/// `progress` is told how many pictures have been read, from any thread. The result does not depend on the number of
/// threads, times aside.
///
/// # Errors
/// Fewer than two pictures that can be read, a parameter out of range, or OpenCV's refusal.
pub fn track_sequence(
    sequence: &ImageSequence,
    config: &FrontEndConfig,
    inputs: &TrackInputs,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<FrontEnd, VisionError> {
    config.validate()?;
    opencv::core::set_num_threads(1).map_err(VisionError::opencv("set its number of threads"))?;
    let mut chosen = chosen_frames(sequence, inputs)?;
    let job = Job { sequence, config, prior: inputs.rotation_prior };
    let mut tracks = Tracks::new();
    let mut chain = link(&job, &chosen, &mut tracks, progress)?;
    let reports = all_reports(&chain)?;
    chosen.retain(|frame| chain.frames.binary_search_by_key(&frame.index, |f| f.report.index).is_ok());
    let center = match config.mode {
        FrontEndMode::Auto => settle_rivals(&job, &mut chain)?,
        FrontEndMode::FixedCenter => solve_about_center(&job, &mut chain, &mut tracks),
    };
    let keyframes = keyframe_rotations(&job, &chain, &tracks, center.as_ref())?;
    let rotations = rotations_in_order(&chain, &reports, keyframes);
    let designated = match &inputs.designated {
        Some(start) => carry_designated(&job, &chosen, &tracks, start)?,
        None => Vec::new(),
    };
    let observations = with_designated(tracks.into_observations(), &designated);
    Ok(FrontEnd {
        observations,
        rotations,
        frames: reports,
        center_in_camera: center.map(|c| c.0),
        center_covariance_rad2: center.map(|c| c.1),
        designated,
    })
}

fn chosen_frames<'a>(sequence: &'a ImageSequence, inputs: &TrackInputs) -> Result<Vec<&'a Frame>, VisionError> {
    if inputs.every == 0 {
        return Err(VisionError::OutOfRange { name: "every", value: 0.0, cure: "it must be 1 or more" });
    }
    let end = inputs.frames.end.min(sequence.frames.len());
    let start = inputs.frames.start.min(end);
    let chosen: Vec<&Frame> = sequence.frames[start..end].iter().step_by(inputs.every).collect();
    if chosen.len() < 2 { Err(VisionError::TooFewPictures { found: chosen.len() }) } else { Ok(chosen) }
}

/// Features of all pictures, matches of adjacent ones and tracks along those, a chunk at a time. About a centre, what
/// matches agree is only known when all pairs are solved together: tracks wait for that.
fn link(
    job: &Job,
    chosen: &[&Frame],
    tracks: &mut Tracks,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Chain, VisionError> {
    let done = std::sync::atomic::AtomicUsize::new(0);
    let mut chain = Chain { frames: Vec::new(), pairs: Vec::new(), lost: Vec::new() };
    for chunk in chosen.chunks(CHUNK) {
        let find = |frame: &&Frame| {
            let found = FrameFeatures::find(job.sequence, frame, job.config);
            progress(done.fetch_add(1, std::sync::atomic::Ordering::Relaxed) + 1);
            found
        };
        let first = chain.frames.len().saturating_sub(1);
        for found in chunk.par_iter().map(find).collect::<Result<Vec<_>, _>>()? {
            match found.report.status {
                FrameStatus::Ok => chain.frames.push(found),
                _ => chain.lost.push(found.report),
            }
        }
        let open: Vec<&[FrameFeatures]> = chain.frames[first..].windows(2).collect();
        let pairs = open.par_iter().map(|w| solve_sharp_pair(job, &w[0], &w[1])).collect::<Result<Vec<_>, _>>()?;
        chain.pairs.extend(pairs);
        let last = chain.frames.len().saturating_sub(1);
        chain.frames[first..last].iter_mut().for_each(FrameFeatures::forget_picture);
        if job.config.mode == FrontEndMode::Auto {
            chain_tracks(&mut chain, first, tracks);
        }
    }
    for (k, pair) in chain.pairs.iter().enumerate() {
        let report = &mut chain.frames[k + 1].report;
        (report.matches, report.match_ms, report.rotation_ms) = (pair.match_count, pair.match_ms, pair.rotation_ms);
    }
    if let Some(last) = chain.frames.last().filter(|_| job.config.mode == FrontEndMode::Auto) {
        tracks.report(last.report.t_ns, &last.features);
    }
    Ok(chain)
}

fn solve_about_center(job: &Job, chain: &mut Chain, tracks: &mut Tracks) -> Center {
    let camera = job.camera();
    let middle = Vector2::new(f64::from(camera.width_px), f64::from(camera.height_px)) * 0.5;
    let guesses: Vec<Vector2<f64>> = chain.frames.iter().filter_map(|f| f.centroid_px).collect();
    let mean = guesses.iter().sum::<Vector2<f64>>() / guesses.len().max(1) as f64;
    let guess = if guesses.is_empty() { middle } else { mean };
    let problem = CenterProblem {
        camera,
        center_guess: camera.unproject(&guess).unwrap_or(Vector3::z_axis()),
        config: &job.config.fixed_center,
        rotation: &job.config.rotation,
    };
    let times = |k: usize| (chain.frames[k].report.t_ns, chain.frames[k + 1].report.t_ns);
    let pairs: Vec<CenteredPair> = chain
        .pairs
        .iter()
        .enumerate()
        .map(|(k, pair)| CenteredPair {
            matches: pair.pixels.view(),
            dt_s: (times(k).1 - times(k).0) as f64 * 1e-9,
            predicted: job.predicted(times(k).0, times(k).1),
        })
        .collect();
    let solved = rotations_about_center(&pairs, &problem);
    for (pair, solution) in chain.pairs.iter_mut().zip(solved.pairs) {
        let hopeless = pair.solution.status == PairStatus::NoFeatures;
        pair.solution = if hopeless { PairSolution::failed(PairStatus::NoFeatures, 0) } else { solution };
    }
    chain_tracks(chain, 0, tracks);
    if let Some(last) = chain.frames.last() {
        tracks.report(last.report.t_ns, &last.features);
    }
    Some((solved.center_in_camera, solved.center_covariance_rad2))
}

/// Extends the tracks along all pairs from number `first` on, and drops what is then done with.
fn chain_tracks(chain: &mut Chain, first: usize, tracks: &mut Tracks) {
    for (k, pair) in chain.pairs.iter_mut().enumerate().skip(first) {
        let (here, next) = (&chain.frames[k], &chain.frames[k + 1]);
        tracks.chain(here.report.t_ns, (&here.features, &next.features), pair.verified());
        pair.forget_matches();
        chain.frames[k].features = Vec::new();
    }
}

/// The observations with those of the designated point, first in each picture.
fn with_designated(observations: Vec<TrackObservation>, designated: &[DesignatedStep]) -> Vec<TrackObservation> {
    if designated.is_empty() {
        return observations;
    }
    let mut all: Vec<TrackObservation> = designated.iter().map(DesignatedStep::observation).collect();
    all.extend(observations);
    all.sort_by_key(|o| (o.t_ns, o.track_id));
    all
}

/// Reports of all pictures in order; refused where fewer than two could be loaded.
fn all_reports(chain: &Chain) -> Result<Vec<FrameReport>, VisionError> {
    let usable = chain.frames.iter().map(|f| &f.report);
    let mut all: Vec<FrameReport> = usable.chain(&chain.lost).cloned().collect();
    all.sort_unstable_by_key(|r| r.index);
    let found = all.iter().filter(|r| r.problem.is_none()).count();
    match all.iter().find_map(|r| r.problem.clone()) {
        Some(problem) if found < 2 => Err(VisionError::TooFewUsable { found, selected: all.len(), problem }),
        _ => Ok(all),
    }
}

/// The rotation of a picture and the next usable one.
pub(super) fn linked(chain: &Chain, k: usize) -> RelativeRotation {
    let times = (chain.frames[k].report.t_ns, chain.frames[k + 1].report.t_ns);
    as_relative_rotation(times, chain.pairs[k].match_count, &chain.pairs[k].solution)
}

/// A pair's solution in the form of the contract.
pub(super) fn as_relative_rotation(
    (t_ns_from, t_ns_to): (i64, i64),
    matches: usize,
    solution: &PairSolution,
) -> RelativeRotation {
    let ok = solution.status == PairStatus::Ok;
    RelativeRotation {
        t_ns_from,
        t_ns_to,
        camera_to_from_camera_from: solution.camera_to_from_camera_from,
        covariance_rad2: solution.covariance_rad2,
        matches,
        inliers: solution.inlier_count(),
        model: if ok { solution.model } else { RotationModel::None },
        status: solution.status,
    }
}

impl DesignatedStep {
    /// As an observation of track [`TrackObservation::DESIGNATED`].
    pub fn observation(&self) -> TrackObservation {
        TrackObservation {
            t_ns: self.t_ns,
            track_id: TrackObservation::DESIGNATED,
            pixel_px: self.pixel_px,
            sigma_px: self.step_sigma_px,
            response: 0.0,
        }
    }
}
