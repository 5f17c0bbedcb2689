//! Points whose corners matching lost, followed by their patches alone.
//!
//! A corner that fades or that another one outshines is not found again, but the ground about it is still there. The
//! matches about it say where it went, and its patch, warped by them, where exactly; the patch must lead back to where it
//! came from.

use super::link::{Link, TrackPoint};
use crate::vision::features::Feature;
use crate::vision::masks::KeepOut;
use crate::vision::matching::CellIndex;
use crate::vision::patch::{Affine, KltConfig, Match, fit_affine, refine_by_patch};
use image::GrayImage;
use nalgebra::Vector2;
use rayon::prelude::*;

/// A patch that leads further than this from where the matches lead follows something else, px.
const FARTHEST_PX: f64 = 2.0;
/// Fewest matches that say where a point went.
const FEWEST: usize = 12;

/// A point without a corner takes the next free one this near, px.
const TAKEN_UP_PX: f64 = 1.5;
/// A point without a corner ends this near to another one: one of them is enough, px.
const CROWDED_PX: f64 = 5.0;

/// A point without a corner, with the response of its last one.
#[derive(Debug, Clone, Copy)]
pub(super) struct CoastedTrack {
    pub(super) point: TrackPoint,
    pub(super) response: f64,
}

/// Two images with what is known of the way from one to the other.
pub(super) struct CoastedSpan<'a> {
    /// The first image and the second one.
    pub(super) images: (&'a GrayImage, &'a GrayImage),
    /// Matches that agree with the motion.
    pub(super) matches: Vec<Match>,
    /// Following of patches.
    pub(super) klt: &'a KltConfig,
    /// Where not to look.
    pub(super) keep_out: Option<&'a KeepOut<'a>>,
}

impl CoastedSpan<'_> {
    /// Where each point of the first image lies in the second one; `None` where the grey levels do not say.
    pub(super) fn follow(&self, points_px: &[Vector2<f64>]) -> Vec<Option<Link>> {
        points_px.par_iter().map(|point_px| self.follow_one(point_px)).collect()
    }

    fn follow_one(&self, point_px: &Vector2<f64>) -> Option<Link> {
        let (old, new) = self.images;
        let there = fit_affine(point_px, &self.matches, FEWEST)?.affine;
        let found = refine_by_patch((old, new), point_px, &there, self.klt)?;
        let clear = self.keep_out.is_none_or(|k| k.is_clear(&found.pixel_px));
        if !clear || (found.pixel_px - there.apply(point_px)).norm() > FARTHEST_PX {
            return None;
        }
        let back = Affine::about(&found.pixel_px, point_px, there.linear.try_inverse()?);
        let returned = refine_by_patch((new, old), &found.pixel_px, &back, self.klt)?;
        let same = (returned.pixel_px - point_px).norm() <= self.klt.max_return_px;
        same.then_some(Link { to_px: found.pixel_px, sigma_px: found.sigma_px(), linear: there.linear })
    }
}

/// Points without matches in the next image, in order of the number: those that come upon a free corner there take it,
/// those that come upon another point end, the others are given back.
pub(super) fn carried_coasted(
    mut lost: Vec<CoastedTrack>,
    passage: &CoastedSpan,
    (next, there): (&[Feature], &mut [Option<TrackPoint>]),
) -> Vec<CoastedTrack> {
    lost.sort_unstable_by_key(|l| l.point.number);
    let places: Vec<Vector2<f64>> = lost.iter().map(|l| l.point.pixel_px).collect();
    let corners = CellIndex::new(next.iter().map(|f| &f.pixel_px), CROWDED_PX);
    let mut taken = CellIndex::new(std::iter::empty(), CROWDED_PX);
    let mut coasted: Vec<CoastedTrack> = Vec::new();
    for (lost, link) in lost.iter().zip(passage.follow(&places)) {
        let Some(link) = link else { continue };
        let scale = link.linear.determinant().abs().sqrt();
        let sigma_px = (scale * lost.point.sigma_px).hypot(link.sigma_px);
        let point = TrackPoint { pixel_px: link.to_px, sigma_px, followed: lost.point.followed + 1, ..lost.point };
        let off_px = |j: &usize| (next[*j].pixel_px - point.pixel_px).norm();
        let near: Vec<usize> = corners.near(&point.pixel_px).filter(|j| off_px(j) < CROWDED_PX).collect();
        let crowded = near.iter().any(|j| there[*j].is_some())
            || taken
                .near(&point.pixel_px)
                .any(|k: usize| (coasted[k].point.pixel_px - point.pixel_px).norm() < CROWDED_PX);
        if crowded {
            continue;
        }
        let free = near.into_iter().filter(|j| off_px(j) < TAKEN_UP_PX);
        match free.min_by(|a, b| off_px(a).total_cmp(&off_px(b))) {
            Some(corner) => there[corner] = Some(point),
            None => {
                taken.insert(coasted.len(), &point.pixel_px);
                coasted.push(CoastedTrack { point, ..*lost });
            }
        }
    }
    coasted
}
