//! Images one after the other, and the pairs between them.

use super::adjacent_pair::{Pair, solve_refined_pair};
use super::coasted_tracks::CoastedSpan;
use super::context::TrackingContext;
use super::image_features::FrameFeatures;
use super::tracks::Tracks;
use crate::dataset::Frame;
use crate::observations::FrameStatus;
use crate::vision::config::FrontEndMode;
use crate::vision::error::VisionError;
use crate::vision::front_end::FrameReport;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Most pixels of the images that are worked on at a time; two images always are.
const MOST_PIXELS: usize = 1 << 26;
/// Most images that are worked on at a time.
const MOST_IMAGES: usize = 8;

/// Images that are worked on, and held in memory, at a time.
fn images_at_a_time(context: &TrackingContext) -> usize {
    let (width_px, height_px) = context.camera().size_px();
    (MOST_PIXELS / (width_px as usize * height_px as usize).max(1)).clamp(2, MOST_IMAGES)
}

/// Everything about the usable images of a sequence and the pairs of each with the next; reports of the others.
#[derive(Default)]
pub struct Chain {
    pub frames: Vec<FrameFeatures>,
    pub pairs: Vec<Pair>,
    pub(super) lost: Vec<FrameReport>,
}

/// Features of all images, matches of adjacent ones and tracks along those, a chunk at a time. About a centre, what
/// matches agree is only known when all pairs are solved together: tracks wait for that.
pub fn link(
    context: &TrackingContext,
    chosen: &[&Frame],
    tracks: &mut Tracks,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Chain, VisionError> {
    let done = AtomicUsize::new(0);
    let mut chain = Chain::default();
    for chunk in chosen.chunks(images_at_a_time(context)) {
        let find = |frame: &&Frame| {
            let found = FrameFeatures::find(context, frame);
            progress(done.fetch_add(1, Ordering::Relaxed) + 1);
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
        let pairs =
            open.par_iter().map(|w| solve_refined_pair(context, &w[0], &w[1])).collect::<Result<Vec<_>, _>>()?;
        for (pair, to) in pairs.iter().zip(chain.frames.iter_mut().skip(first + 1)) {
            let report = &mut to.report;
            (report.matches, report.match_ms, report.rotation_ms) = (pair.match_count, pair.match_ms, pair.rotation_ms);
        }
        chain.pairs.extend(pairs);
        let last = chain.frames.len().saturating_sub(1);
        if context.config.mode == FrontEndMode::Auto {
            chain.extend_tracks(first, tracks, Some(context));
        }
        chain.frames[first..last].iter_mut().for_each(FrameFeatures::forget_image);
    }
    if context.config.mode == FrontEndMode::Auto {
        chain.end_tracks(tracks);
    }
    Ok(chain)
}

/// The way from an image to the next one.
fn passage<'a>(
    context: &'a TrackingContext,
    pair: &Pair,
    (here, next): (&'a FrameFeatures, &'a FrameFeatures),
) -> CoastedSpan<'a> {
    let images = (&here.image, &next.image);
    CoastedSpan { images, matches: pair.agreeing(), klt: &context.config.klt, keep_out: context.keep_out.as_ref() }
}

impl Chain {
    /// Extends the tracks along all pairs from number `first` on, and drops what is then done with. With a `context`, whose
    /// images are then still needed, points that matching lost are followed by their patches.
    pub fn extend_tracks(&mut self, first: usize, tracks: &mut Tracks, context: Option<&TrackingContext>) {
        for (k, pair) in self.pairs.iter_mut().enumerate().skip(first) {
            let (here, next) = (&self.frames[k], &self.frames[k + 1]);
            let passage = |context| passage(context, pair, (here, next));
            let passage = context.filter(|context| context.config.klt.follow_lost).map(passage);
            tracks.chain(here.report.t_ns, (&here.features, &next.features), pair.verified(), passage.as_ref());
            pair.forget_matches();
            self.frames[k].features = Vec::new();
        }
    }

    /// Ends the tracks with the last image.
    pub fn end_tracks(&self, tracks: &mut Tracks) {
        if let Some(last) = self.frames.last() {
            tracks.report(last.report.t_ns, &last.features);
        }
    }

    /// Reports of all images in order; refused where fewer than two could be loaded.
    pub fn reports(&self) -> Result<Vec<FrameReport>, VisionError> {
        let mut all: Vec<FrameReport> = self.frames.iter().map(|f| &f.report).chain(&self.lost).cloned().collect();
        all.sort_unstable_by_key(|r| r.index);
        let found = all.iter().filter(|r| r.problem.is_none()).count();
        match all.iter().find_map(|r| r.problem.clone()) {
            Some(problem) if found < 2 => Err(VisionError::TooFewUsable { found, selected: all.len(), problem }),
            _ => Ok(all),
        }
    }
}
