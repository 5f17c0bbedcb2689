//! Sharpens matches by grey levels: the corner says which surface point it is, the patch about it says where it went.
//!
//! Corners found anew in the next image are not quite the same surface points: each detection has its own error, and
//! as scale changes a corner wanders over the ground. Aligning the patch of the first image, warped by the local affine
//! map of the matches, with the second one is several times more exact and does not wander.

use super::link::{Link, Stretch};
use super::pair_pixels::PairPixels;
use crate::vision::patch::{Affine, KltConfig, Match, fit_affine, refine_by_patch, refine_with_stretch};
use image::GrayImage;
use rayon::prelude::*;

/// A patch that leads further than this from the matched corner follows something else, px.
const FARTHEST_PX: f64 = 2.0;
/// Fewest neighbours that give an affine map.
const FEWEST: usize = 8;

/// A link for each match that agrees with the motion; `None` where the patches do not settle it.
pub(super) fn refine_matches(
    images: (&GrayImage, &GrayImage),
    (pixels, inliers): (&PairPixels, &[bool]),
    (klt, stretch): (&KltConfig, Stretch),
) -> Vec<Option<Link>> {
    let matches: Vec<Match> = (0..pixels.sigma_px.len())
        .map(|i| (pixels.pair.from_px[i], pixels.pair.to_px[i], std::f64::consts::SQRT_2 * pixels.sigma_px[i]))
        .collect();
    let agreeing: Vec<Match> = matches.iter().zip(inliers).filter(|(_, inlier)| **inlier).map(|(m, _)| *m).collect();
    let link = |(m, inlier): (&Match, &bool)| if *inlier { link(images, m, &agreeing, (klt, stretch)) } else { None };
    matches.par_iter().zip(inliers).map(link).collect()
}

fn link(
    (old, new): (&GrayImage, &GrayImage),
    (from_px, to_px, _): &Match,
    agreeing: &[Match],
    (klt, stretch): (&KltConfig, Stretch),
) -> Option<Link> {
    let linear = fit_affine(from_px, agreeing, FEWEST)?.affine.linear;
    let start = Affine::about(from_px, to_px, linear);
    let (refined, linear) = match stretch {
        Stretch::OfMatches => (refine_by_patch((old, new), from_px, &start, klt)?, linear),
        Stretch::Own => refine_with_stretch((old, new), from_px, &start, klt)?,
    };
    let near = (refined.pixel_px - to_px).norm() < FARTHEST_PX;
    near.then_some(Link { to_px: refined.pixel_px, sigma_px: refined.sigma_px(), linear })
}
