//! The designated landing point, carried from picture to picture by the verified matches about it.
//!
//! Ground near the point is nearly flat, so a weighted affine fit to the nearest matches says where it went; the grey
//! levels of the patch, warped by that fit, then refine it. Each picture is reached from all recent pictures that
//! share enough tracks near the point, and what they say is averaged, so that errors add up slowly. Where the point leaves the picture
//! or the matches, it ends: nothing is invented.

use super::front_end::DesignatedStep;
use super::local_affine::{Affine, Match, fit_affine};
use super::patch::refine_by_patch;
use super::sequence::Job;
use super::tracks::Tracks;
use super::{KltConfig, VisionError};
use crate::dataset::{DesignatedPoint, Frame};
use image::GrayImage;
use nalgebra::Matrix2;
use std::collections::VecDeque;

/// Half the side of the patch about the point, px.
const HALF_PX: u32 = 15;
/// Pictures back to which the point may be tied.
const MEMORY: usize = 8;
/// The point ends this close to the edge, px.
const MARGIN_PX: f64 = 4.0;
/// 1σ in px by which the looks of the ground move over the ground as scale grows e-fold, in each coordinate: finer details
/// appear, and all past pictures are wrong alike about where the point is among them (fitted to rendered ground).
const LOOKS_SIGMA_PX: f64 = 0.2;
/// Largest change of scale between the tied pictures: beyond it, patches and features no longer look alike.
const MOST_SCALE: f64 = 1.35;

struct Past {
    frame: usize,
    picture: GrayImage,
    step: DesignatedStep,
}

/// Carries the point through the chain from the picture at its time (the first one otherwise).
pub(super) fn carry_designated(
    job: &Job,
    chosen: &[&Frame],
    tracks: &Tracks,
    start: &DesignatedPoint,
) -> Result<Vec<DesignatedStep>, VisionError> {
    let first = chosen.iter().position(|f| f.t_ns == start.t_ns).unwrap_or(0);
    if !job.camera().contains(&start.pixel_px, MARGIN_PX) {
        return Ok(Vec::new());
    }
    let mut steps = vec![DesignatedStep {
        t_ns: chosen[first].t_ns,
        pixel_px: start.pixel_px,
        step_sigma_px: (0.5 * start.covariance_px2.trace()).sqrt(),
        covariance_px2: start.covariance_px2,
        t_ns_from: chosen[first].t_ns,
        refined: false,
    }];
    let klt = KltConfig { half_px: HALF_PX, ..job.config.klt.clone() };
    let mut past = VecDeque::new();
    past.push_back(Past { frame: first, picture: job.sequence.load(chosen[first])?, step: steps[0] });
    for (frame, file) in chosen.iter().enumerate().skip(first + 1) {
        let picture = job.sequence.load(file)?;
        let carried: Vec<DesignatedStep> =
            past.iter().filter_map(|p| carry(p, (frame, &picture, file.t_ns), tracks, &klt)).collect();
        let Some(step) = fused(&carried).filter(|s| job.camera().contains(&s.pixel_px, MARGIN_PX)) else { break };
        steps.push(step);
        past.push_back(Past { frame, picture, step });
        if past.len() > MEMORY {
            past.pop_front();
        }
    }
    Ok(steps)
}

/// The point in a new picture from a past one; `None` where too few tracks near it are shared, or the scale changed too
/// much.
fn carry(
    past: &Past,
    (frame, picture, t_ns): (usize, &GrayImage, i64),
    tracks: &Tracks,
    klt: &KltConfig,
) -> Option<DesignatedStep> {
    let pairs: Vec<Match> = tracks.shared(past.frame, frame);
    let adjacent = frame == past.frame + 1;
    let local = fit_affine(&past.step.pixel_px, &pairs, if adjacent { 8 } else { 16 })?;
    let scale = local.affine.linear.determinant().abs().sqrt();
    if !adjacent && !(1.0 / MOST_SCALE..MOST_SCALE).contains(&scale) {
        return None;
    }
    let predicted = local.affine.apply(&past.step.pixel_px);
    let refined = refine_by_patch((&past.picture, picture), &past.step.pixel_px, &local.affine, klt)
        .filter(|r| (r.pixel_px - predicted).norm() < 3.0 * local.sigma_px + 0.5);
    let (pixel_px, step_sigma_px) = match &refined {
        Some(r) => (r.pixel_px, r.sigma_px()),
        None => (predicted, local.sigma_px),
    };
    Some(DesignatedStep {
        t_ns,
        pixel_px,
        step_sigma_px,
        covariance_px2: grown(&past.step.covariance_px2, &local.affine, step_sigma_px),
        t_ns_from: past.step.t_ns,
        refined: refined.is_some(),
    })
}

/// Mean of what the past pictures say, by the inverse variance of each step. Their errors share a history, so the
/// variances are averaged, not reduced; were each picture tied to one past picture alone, the point would split into
/// several that drift apart.
fn fused(carried: &[DesignatedStep]) -> Option<DesignatedStep> {
    let nearest = carried.last()?;
    let weight = |s: &DesignatedStep| s.step_sigma_px.max(1e-3).powi(-2);
    let total: f64 = carried.iter().map(weight).sum();
    let share = |s: &DesignatedStep| weight(s) / total;
    Some(DesignatedStep {
        pixel_px: carried.iter().map(|s| s.pixel_px * share(s)).sum(),
        step_sigma_px: carried.iter().map(|s| s.step_sigma_px * share(s)).sum(),
        covariance_px2: carried.iter().map(|s| s.covariance_px2 * share(s)).sum(),
        refined: carried.iter().any(|s| s.refined),
        ..*nearest
    })
}

fn grown(covariance_px2: &Matrix2<f64>, affine: &Affine, step_sigma_px: f64) -> Matrix2<f64> {
    let carried = affine.linear * covariance_px2 * affine.linear.transpose();
    let growth = 0.5 * affine.linear.determinant().abs().max(1e-12).ln();
    let looks_px2 = LOOKS_SIGMA_PX.powi(2) * growth.abs();
    (carried + carried.transpose()) * 0.5 + Matrix2::identity() * (step_sigma_px.powi(2) + looks_px2)
}
