//! One pair of adjacent images: matched, solved, refined by patches, solved again.

use super::context::{TrackingContext, milliseconds};
use super::image_features::{FrameFeatures, MatchStrategy, match_pair};
use super::link::{Link, Stretch};
use super::pair_pixels::PairPixels;
use super::refined_match::refine_matches;
use crate::observations::PairStatus;
use crate::vision::config::FrontEndMode;
use crate::vision::error::VisionError;
use crate::vision::matching::IndexMatch;
use crate::vision::pair::{PairHints, PairSolution, relative_rotation};
use crate::vision::patch::Match;
use nalgebra::UnitQuaternion;
use std::f64::consts::SQRT_2;
use std::time::Instant;

/// An adjacent pair: its matches and what they say.
pub struct Pair {
    pub(super) match_count: usize,
    matches: Vec<IndexMatch>,
    pub pixels: PairPixels,
    pub solution: PairSolution,
    links: Vec<Option<Link>>,
    pub(super) match_ms: f64,
    pub(super) rotation_ms: f64,
}

impl Pair {
    /// Whether two rival solutions are left, which the neighbours may settle.
    pub(super) fn is_open(&self) -> bool {
        self.solution.status == PairStatus::Degenerate
    }

    /// Drops what only tracks need, and what only solving it again needs unless it is open: a long sequence keeps little
    /// of each pair.
    pub(super) fn forget_matches(&mut self) {
        (self.matches, self.links) = (Vec::new(), Vec::new());
        if !self.is_open() {
            self.pixels = PairPixels::default();
        }
    }

    /// Whether the matches that agree are of surface points, even if they do not determine the rotation.
    fn is_usable(&self) -> bool {
        matches!(self.solution.status, PairStatus::Ok | PairStatus::NoMotion | PairStatus::Degenerate)
    }

    /// Pixels of the matches that agree with the motion, and 1σ of their differences.
    pub(super) fn agreeing(&self) -> Vec<Match> {
        let (pixels, usable) = (&self.pixels, self.is_usable());
        let both = pixels.pair.from_px.iter().zip(&pixels.pair.to_px).zip(&pixels.sigma_px);
        let agreeing = both.zip(&self.solution.inliers).filter(|(_, inlier)| usable && **inlier);
        agreeing.map(|(((from_px, to_px), sigma_px), _)| (*from_px, *to_px, SQRT_2 * sigma_px)).collect()
    }

    /// Matches that may extend tracks, with their links.
    pub(super) fn verified(&self) -> impl Iterator<Item = (IndexMatch, Option<Link>)> + '_ {
        let usable = self.is_usable();
        let links = self.links.iter().copied().chain(std::iter::repeat(None));
        let agreeing = self.matches.iter().zip(links).zip(&self.solution.inliers);
        agreeing.filter(move |(_, inlier)| usable && **inlier).map(|((m, link), _)| (*m, link))
    }
}

/// Solves a pair, sharpens the matches that agree, and solves it again with them.
pub(super) fn solve_refined_pair(
    context: &TrackingContext,
    from: &FrameFeatures,
    to: &FrameFeatures,
) -> Result<Pair, VisionError> {
    let mut pair = solve_pair(context, from, to)?;
    if pair.solution.inlier_count() == 0 {
        return Ok(pair);
    }
    let start = Instant::now();
    let own = context.config.mode == FrontEndMode::FixedCenter && context.config.fixed_center.stretch_patches;
    let how = (&context.config.klt, if own { Stretch::Own } else { Stretch::OfMatches });
    pair.links = refine_matches((&from.image, &to.image), (&pair.pixels, &pair.solution.inliers), how);
    pair.match_ms += milliseconds(start);
    let start = Instant::now();
    let pixels = pair.pixels.with_refined(&pair.links);
    let predicted = context.predicted(from.report.t_ns, to.report.t_ns);
    let solution = first_solution(context, &pixels, predicted)?;
    if solution.status == PairStatus::Ok || pair.solution.status != PairStatus::Ok {
        (pair.pixels, pair.solution) = (pixels, solution);
    }
    pair.rotation_ms += milliseconds(start);
    Ok(pair)
}

/// Matches a pair by one strategy after another until the motion is clear; the best attempt otherwise.
fn solve_pair(context: &TrackingContext, from: &FrameFeatures, to: &FrameFeatures) -> Result<Pair, VisionError> {
    let predicted = context.predicted(from.report.t_ns, to.report.t_ns);
    let fewest = context.config.rotation.min_matches;
    if from.features.len() < fewest || to.features.len() < fewest {
        let solution = PairSolution::failed(PairStatus::NoFeatures, 0);
        return Ok(Pair {
            match_count: 0,
            matches: vec![],
            pixels: PairPixels::default(),
            solution,
            links: vec![],
            match_ms: 0.0,
            rotation_ms: 0.0,
        });
    }
    let strategies = [MatchStrategy::Guided, MatchStrategy::Upright, MatchStrategy::Turned];
    let mut best: Option<Pair> = None;
    for strategy in strategies.into_iter().filter(|w| predicted.is_some() || *w != MatchStrategy::Guided) {
        let start = Instant::now();
        let matches = match_pair((from, to), strategy, (context.camera(), predicted), context.config)?;
        let match_ms = milliseconds(start) + best.as_ref().map_or(0.0, |b| b.match_ms);
        let start = Instant::now();
        let pixels = PairPixels::new(&from.features, &to.features, matches.iter().map(|m| (m.from, m.to)));
        let solution = first_solution(context, &pixels, predicted)?;
        let rotation_ms = milliseconds(start) + best.as_ref().map_or(0.0, |b| b.rotation_ms);
        let clear = matches!(solution.status, PairStatus::Ok | PairStatus::NoMotion | PairStatus::Degenerate)
            && solution.inlier_count() >= 3 * fewest;
        let better = best.as_ref().is_none_or(|b| solution.inlier_count() > b.solution.inlier_count());
        if better {
            let match_count = matches.len();
            best = Some(Pair { match_count, matches, pixels, solution, links: vec![], match_ms, rotation_ms });
        }
        if clear {
            break;
        }
    }
    Ok(best.expect("at least one way is tried"))
}

fn first_solution(
    context: &TrackingContext,
    pixels: &PairPixels,
    predicted: Option<UnitQuaternion<f64>>,
) -> Result<PairSolution, VisionError> {
    let hints = PairHints { camera_to_from_camera_from: predicted, normal_in_from: None };
    relative_rotation(pixels.view(), context.camera(), &hints, &context.config.rotation)
}
