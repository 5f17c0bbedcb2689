//! The front end over a whole sequence.

use super::designated::carry_designated;
use super::fixed_center::{CenterProblem, CenteredPair, rotations_about_center};
use super::frame_features::{FrameFeatures, PairPixels, Way, match_pair, milliseconds};
use super::front_end::{FrontEnd, RotationPrediction, TrackInputs};
use super::keyframes::keyframe_rotations;
use super::matching::IndexMatch;
use super::sharpen::{Link, sharpen};
use super::tracks::Tracks;
use super::{
    FrontEndConfig, FrontEndMode, PairHints, PairSolution, PairStatus, RelativeRotation, RotationModel,
    TrackObservation, VisionError, relative_rotation,
};
use crate::dataset::{Frame, ImageSequence};
use crate::geometry::Camera;
use nalgebra::{Matrix2, Unit, UnitQuaternion, Vector2, Vector3};
use rayon::prelude::*;
use std::time::Instant;

/// Pictures held in memory at a time.
const CHUNK: usize = 8;

/// An adjacent pair: its matches and what they say.
pub(super) struct Pair {
    pub(super) matches: Vec<IndexMatch>,
    pub(super) pixels: PairPixels,
    pub(super) solution: PairSolution,
    links: Vec<Option<Link>>,
    match_ms: f64,
    rotation_ms: f64,
}

impl Pair {
    /// Matches that may extend tracks, with their links.
    pub(super) fn verified(&self) -> impl Iterator<Item = (IndexMatch, Option<Link>)> + '_ {
        let usable = matches!(self.solution.status, PairStatus::Ok | PairStatus::NoMotion | PairStatus::Degenerate);
        let links = self.links.iter().copied().chain(std::iter::repeat(None));
        let agreeing = self.matches.iter().zip(links).zip(&self.solution.inliers);
        agreeing.filter(move |(_, inlier)| usable && **inlier).map(|((m, link), _)| (*m, link))
    }
}

/// Everything about the pictures and adjacent pairs of a sequence.
pub(super) struct Chain {
    pub(super) frames: Vec<FrameFeatures>,
    pub(super) pairs: Vec<Pair>,
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
/// `progress` is told how many pictures have been read, from any thread. The result does not depend on the number of
/// threads, times aside.
///
/// # Errors
/// Fewer than two pictures, a picture that cannot be read, a parameter out of range, or OpenCV's refusal.
pub fn track_sequence(
    sequence: &ImageSequence,
    config: &FrontEndConfig,
    inputs: &TrackInputs,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<FrontEnd, VisionError> {
    config.validate()?;
    opencv::core::set_num_threads(1).map_err(VisionError::opencv("set its number of threads"))?;
    let chosen = chosen_frames(sequence, inputs)?;
    let job = Job { sequence, config, prior: inputs.rotation_prior };
    let mut chain = link(&job, &chosen, progress)?;
    let center = match config.mode {
        FrontEndMode::Auto => settle_rivals(&job, &mut chain)?,
        FrontEndMode::FixedCenter => solve_about_center(&job, &mut chain),
    };
    let tracks = chain_tracks(&chain);
    let mut rotations: Vec<RelativeRotation> = (0..chain.pairs.len()).map(|k| adjacent(&chain, k)).collect();
    rotations.extend(keyframe_rotations(&job, &chain, &tracks, center.as_ref())?);
    let designated = match &inputs.designated {
        Some(start) => carry_designated(&job, &chosen, &tracks, start)?,
        None => Vec::new(),
    };
    let mut observations = Vec::new();
    for (k, frame) in chain.frames.iter().enumerate() {
        let t_ns = frame.report.t_ns;
        observations.extend(designated.iter().filter(|d| d.t_ns == t_ns).map(|d| d.observation()));
        observations.extend(tracks.observations(k, t_ns, &frame.features));
    }
    Ok(FrontEnd {
        observations,
        rotations,
        frames: chain.frames.into_iter().map(|f| f.report).collect(),
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

/// Features of all pictures and matches of adjacent ones, a chunk at a time.
fn link(job: &Job, chosen: &[&Frame], progress: &(dyn Fn(usize) + Sync)) -> Result<Chain, VisionError> {
    let done = std::sync::atomic::AtomicUsize::new(0);
    let mut chain = Chain { frames: Vec::new(), pairs: Vec::new() };
    for chunk in chosen.chunks(CHUNK) {
        let find = |frame: &&Frame| {
            let found = FrameFeatures::find(job.sequence, frame, job.config);
            progress(done.fetch_add(1, std::sync::atomic::Ordering::Relaxed) + 1);
            found
        };
        let first = chain.frames.len().saturating_sub(1);
        chain.frames.extend(chunk.par_iter().map(find).collect::<Result<Vec<_>, _>>()?);
        let open: Vec<&[FrameFeatures]> = chain.frames[first..].windows(2).collect();
        let pairs = open.par_iter().map(|w| solve_sharp_pair(job, &w[0], &w[1])).collect::<Result<Vec<_>, _>>()?;
        chain.pairs.extend(pairs);
        let last = chain.frames.len() - 1;
        chain.frames[first..last].iter_mut().for_each(FrameFeatures::forget_picture);
    }
    for (k, pair) in chain.pairs.iter().enumerate() {
        let report = &mut chain.frames[k + 1].report;
        (report.matches, report.match_ms, report.rotation_ms) = (pair.matches.len(), pair.match_ms, pair.rotation_ms);
    }
    Ok(chain)
}

/// Solves a pair, sharpens the matches that agree, and solves it again with them.
fn solve_sharp_pair(job: &Job, from: &FrameFeatures, to: &FrameFeatures) -> Result<Pair, VisionError> {
    let mut pair = solve_pair(job, from, to)?;
    if pair.solution.inlier_count() == 0 {
        return Ok(pair);
    }
    let start = Instant::now();
    pair.links = sharpen((&from.picture, &to.picture), &pair.pixels, &pair.solution.inliers);
    pair.match_ms += milliseconds(start);
    let start = Instant::now();
    let pixels = pair.pixels.sharpened(&pair.links);
    let predicted = job.predicted(from.report.t_ns, to.report.t_ns);
    let solution = first_solution(job, &pixels, predicted)?;
    if solution.status == PairStatus::Ok || pair.solution.status != PairStatus::Ok {
        (pair.pixels, pair.solution) = (pixels, solution);
    }
    pair.rotation_ms += milliseconds(start);
    Ok(pair)
}

/// Matches a pair in one way after another until the motion is clear; the best attempt otherwise.
fn solve_pair(job: &Job, from: &FrameFeatures, to: &FrameFeatures) -> Result<Pair, VisionError> {
    let predicted = job.predicted(from.report.t_ns, to.report.t_ns);
    let fewest = job.config.rotation.min_matches;
    if from.features.len() < fewest || to.features.len() < fewest {
        let solution = PairSolution::failed(PairStatus::NoFeatures, 0);
        return Ok(Pair {
            matches: vec![],
            pixels: PairPixels::default(),
            solution,
            links: vec![],
            match_ms: 0.0,
            rotation_ms: 0.0,
        });
    }
    let ways = [Way::Guided, Way::Upright, Way::Turned];
    let mut best: Option<Pair> = None;
    for way in ways.into_iter().filter(|w| predicted.is_some() || *w != Way::Guided) {
        let start = Instant::now();
        let matches = match_pair((from, to), way, (job.camera(), predicted), job.config);
        let match_ms = milliseconds(start) + best.as_ref().map_or(0.0, |b| b.match_ms);
        let start = Instant::now();
        let pixels = PairPixels::new(&from.features, &to.features, matches.iter().map(|m| (m.from, m.to)));
        let solution = first_solution(job, &pixels, predicted)?;
        let rotation_ms = milliseconds(start) + best.as_ref().map_or(0.0, |b| b.rotation_ms);
        let clear = matches!(solution.status, PairStatus::Ok | PairStatus::NoMotion | PairStatus::Degenerate)
            && solution.inlier_count() >= 3 * fewest;
        let better = best.as_ref().is_none_or(|b| solution.inlier_count() > b.solution.inlier_count());
        if better {
            best = Some(Pair { matches, pixels, solution, links: vec![], match_ms, rotation_ms });
        }
        if clear {
            break;
        }
    }
    Ok(best.expect("at least one way is tried"))
}

fn first_solution(
    job: &Job,
    pixels: &PairPixels,
    predicted: Option<UnitQuaternion<f64>>,
) -> Result<PairSolution, VisionError> {
    let hints = PairHints { camera_to_from_camera_from: predicted, normal_in_from: None };
    relative_rotation(pixels.view(), job.camera(), &hints, &job.config.rotation)
}

/// Pairs with two rival solutions are solved again with the ground's normal as their neighbours found it: first as the
/// pair before did, then, for those that come before the first clear one, as the pair after did.
fn settle_rivals(job: &Job, chain: &mut Chain) -> Result<Center, VisionError> {
    let again = |pair: &mut Pair, normal: Unit<Vector3<f64>>| -> Result<(), VisionError> {
        let hints = PairHints { camera_to_from_camera_from: None, normal_in_from: Some(normal) };
        pair.solution = relative_rotation(pair.pixels.view(), job.camera(), &hints, &job.config.rotation)?;
        Ok(())
    };
    let open = |pair: &Pair| pair.solution.status == PairStatus::Degenerate && job.prior.is_none();
    let mut normal: Option<Unit<Vector3<f64>>> = None;
    for pair in &mut chain.pairs {
        if let Some(known) = normal.filter(|_| open(pair)) {
            again(pair, known)?;
        }
        let here = pair.solution.normal_in_from.or(normal);
        normal = here.zip(turn_of(pair, job.camera())).map(|(n, turn)| turn * n);
    }
    let mut normal_after: Option<Unit<Vector3<f64>>> = None;
    for pair in chain.pairs.iter_mut().rev() {
        let carried = normal_after.zip(turn_of(pair, job.camera())).map(|(n, turn)| turn.inverse() * n);
        if let Some(known) = carried.filter(|_| open(pair)) {
            again(pair, known)?;
        }
        normal_after = pair.solution.normal_in_from.or(carried);
    }
    Ok(None)
}

/// The rotation of a pair for carrying a normal over: the solution where there is one; where rivals are open, the turn
/// that fits the bearings best, which is near all of them.
fn turn_of(pair: &Pair, camera: &Camera) -> Option<UnitQuaternion<f64>> {
    match pair.solution.status {
        PairStatus::Ok => Some(pair.solution.camera_to_from_camera_from),
        PairStatus::Degenerate => Some(least_turn(&pair.pixels, &pair.solution.inliers, camera)),
        _ => None,
    }
}

/// The rotation that best carries all matched bearings over, translation ignored (Wahba's problem).
fn least_turn(pixels: &PairPixels, inliers: &[bool], camera: &Camera) -> UnitQuaternion<f64> {
    let mut sum = nalgebra::Matrix3::zeros();
    let both = pixels.pair.from_px.iter().zip(&pixels.pair.to_px);
    for ((from, to), _) in both.zip(inliers).filter(|(_, inlier)| **inlier) {
        if let (Some(a), Some(b)) = (camera.unproject(from), camera.unproject(to)) {
            sum += b.into_inner() * a.transpose();
        }
    }
    UnitQuaternion::from_matrix(&sum)
}

fn solve_about_center(job: &Job, chain: &mut Chain) -> Center {
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
    Some((solved.center_in_camera, solved.center_covariance_rad2))
}

fn chain_tracks(chain: &Chain) -> Tracks {
    let mut tracks = Tracks::new(chain.frames.iter().map(|f| f.features.len()));
    for (k, pair) in chain.pairs.iter().enumerate() {
        let features = (chain.frames[k].features.as_slice(), chain.frames[k + 1].features.as_slice());
        tracks.chain(k, features, pair.verified());
    }
    tracks
}

fn adjacent(chain: &Chain, k: usize) -> RelativeRotation {
    let times = (chain.frames[k].report.t_ns, chain.frames[k + 1].report.t_ns);
    as_relative_rotation(times, chain.pairs[k].matches.len(), &chain.pairs[k].solution)
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

impl super::front_end::DesignatedStep {
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
