//! The designated landing point, carried from image to image by the verified matches about it.
//!
//! Ground near the point is nearly flat, so a weighted affine fit to the nearest matches says where it went; the grey
//! levels of the patch, warped by that fit, then refine it. Each image is tied to the last two and to keyframes at
//! larger scale changes, so that errors add up slowly. Where the point leaves the image or the matches, it ends:
//! nothing is invented.

use super::keyframes::{Keyframe, KeyframeMeasurement, Keyframes};
use crate::dataset::{DesignatedPoint, Frame};
use crate::vision::error::VisionError;
use crate::vision::front_end::DesignatedStep;
use crate::vision::masks::KeepOut;
use crate::vision::patch::{KltConfig, Match, fit_affine, refine_by_patch};
use crate::vision::tracking::{TrackingContext, Tracks};
use image::GrayImage;

/// Half the side of the patch about the point, px.
const HALF_PX: u32 = 15;
/// The point ends this close to the edge, px.
const MARGIN_PX: f64 = 4.0;
/// Largest change of scale between the tied images: beyond it, patches and features no longer look alike.
const MOST_SCALE: f64 = 1.35;

/// Carries the point through the chain from the image at its time (the first one otherwise).
pub fn carry_designated(
    context: &TrackingContext,
    chosen: &[&Frame],
    tracks: &Tracks,
    start: &DesignatedPoint,
) -> Result<Vec<DesignatedStep>, VisionError> {
    let first = chosen.iter().position(|f| f.t_ns == start.t_ns).unwrap_or(0);
    if !context.camera().contains(&start.pixel_px, MARGIN_PX) {
        return Ok(Vec::new());
    }
    let mut steps = vec![DesignatedStep {
        t_ns: chosen[first].t_ns,
        pixel_px: start.pixel_px,
        step_sigma_px: (0.5 * start.covariance_px2.trace()).sqrt(),
        covariance_px2: start.covariance_px2,
        pixel_size: 1.0,
        drift_first_px2: 0.0,
        t_ns_from: chosen[first].t_ns,
        refined: false,
    }];
    let klt = KltConfig { half_px: HALF_PX, ..context.config.klt.clone() };
    let mut past = Keyframes::new(first, context.sequence.load(chosen[first])?, steps[0], context.config.designated);
    for (frame, file) in chosen.iter().enumerate().skip(first + 1) {
        let image = context.sequence.load(file)?;
        let tie = |(from, keyframe): (usize, &Keyframe)| {
            tie((from, keyframe), (frame, &image), tracks, (&klt, context.keep_out.as_ref()))
        };
        let ties: Vec<KeyframeMeasurement> = past.chosen().filter_map(tie).collect();
        let fused = past.fused(file.t_ns, &ties);
        let Some(fused) = fused.filter(|f| context.camera().contains(&f.step.pixel_px, MARGIN_PX)) else { break };
        steps.push(fused.step);
        past.keep(frame, image, fused);
    }
    Ok(steps)
}

/// The point in a new image from a past one; `None` where too few tracks near it are shared, or the scale changed too
/// much.
fn tie(
    (from, past): (usize, &Keyframe),
    (frame, image): (usize, &GrayImage),
    tracks: &Tracks,
    (klt, keep_out): (&KltConfig, Option<&KeepOut>),
) -> Option<KeyframeMeasurement> {
    let pairs: Vec<Match> = tracks.shared(past.frame, frame);
    let adjacent = frame == past.frame + 1;
    let local = fit_affine(&past.step.pixel_px, &pairs, if adjacent { 8 } else { 16 })?;
    let linear = local.affine.linear;
    let scale = linear.determinant().abs().sqrt();
    if !adjacent && !(1.0 / MOST_SCALE..MOST_SCALE).contains(&scale) {
        return None;
    }
    let predicted = local.affine.apply(&past.step.pixel_px);
    let refined = refine_by_patch((&past.image, image), &past.step.pixel_px, &local.affine, klt)
        .filter(|r| (r.pixel_px - predicted).norm() < 3.0 * local.sigma_px + 0.5)
        .filter(|r| [past.step.pixel_px, r.pixel_px].iter().all(|p| keep_out.is_none_or(|k| k.is_clear(p))));
    let (pixel_px, sigma_px) = match &refined {
        Some(r) => (r.pixel_px, r.sigma_px()),
        None => (predicted, local.sigma_px),
    };
    Some(KeyframeMeasurement { from, pixel_px, sigma_px, linear, refined: refined.is_some() })
}
