//! Rotations of images further apart, through the tracks that they share.

use super::context::TrackingContext;
use super::image_chain::Chain;
use super::output_order::as_relative_rotation;
use super::pair_pixels::PairPixels;
use super::tracks::Tracks;
use crate::observations::{PairStatus, RelativeRotation};
use crate::vision::error::VisionError;
use crate::vision::pair::{
    CenterProblem, CenteredPair, PairHints, PairSolution, relative_rotation, rotation_about_center,
};
use nalgebra::{Matrix2, Unit, UnitQuaternion, Vector3};
use rayon::prelude::*;

/// The centre of rotation with its covariance, in the fixed-centre mode.
type Center<'a> = Option<&'a (Unit<Vector3<f64>>, Matrix2<f64>)>;

/// Solves the keyframe pairs of all spans, in order of the first image, then of the span. A pair whose rotation is too
/// large, or with too few shared tracks, is left out; so is one that spans a link without a rotation, unless it is solved.
pub fn keyframe_rotations(
    context: &TrackingContext,
    chain: &Chain,
    numbers: &Tracks,
    center: Center<'_>,
) -> Result<Vec<RelativeRotation>, VisionError> {
    let spans = context.config.keyframe_spans.iter().filter(|s| **s >= 2);
    let count = chain.frames.len();
    let all: Vec<(usize, usize)> = {
        let mut all: Vec<_> = spans.flat_map(|s| (0..count.saturating_sub(*s)).map(move |k| (k, k + s))).collect();
        all.sort_unstable();
        all.dedup();
        all
    };
    let solved = all.par_iter().map(|span| keyframe(context, chain, numbers, (*span, center)));
    Ok(solved.collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect())
}

fn keyframe(
    context: &TrackingContext,
    chain: &Chain,
    numbers: &Tracks,
    ((from, to), center): ((usize, usize), Center<'_>),
) -> Result<Option<RelativeRotation>, VisionError> {
    let chained = chained_rotation(chain, from, to);
    let too_far = |rotation: &UnitQuaternion<f64>| rotation.angle() > context.config.keyframe_max_angle_rad;
    let shared = numbers.shared_by_corners(from, to);
    if chained.as_ref().is_some_and(too_far) || shared.len() < context.config.rotation.min_matches {
        return Ok(None);
    }
    let (a, b) = (&chain.frames[from], &chain.frames[to]);
    let pixels = PairPixels::from_shared(&shared);
    let solution: PairSolution = match center {
        None => {
            let hints = PairHints { camera_to_from_camera_from: chained, normal_in_from: None };
            relative_rotation(pixels.view(), context.camera(), &hints, &context.config.rotation)?
        }
        Some((direction, covariance)) => {
            let problem = CenterProblem {
                camera: context.camera(),
                center_guess: *direction,
                config: &context.config.fixed_center,
                rotation: &context.config.rotation,
            };
            let dt_s = (b.report.t_ns - a.report.t_ns) as f64 * 1e-9;
            let pair = CenteredPair { matches: pixels.view(), dt_s, predicted: chained };
            rotation_about_center(&pair, (direction, covariance), &problem)
        }
    };
    let unsure = solution.status != PairStatus::Ok || too_far(&solution.camera_to_from_camera_from);
    if chained.is_none() && unsure {
        return Ok(None);
    }
    let times = (a.report.t_ns, b.report.t_ns);
    Ok(Some(as_relative_rotation(times, pixels.sigma_px.len(), &solution)))
}

/// Product of the adjacent rotations; `None` where one of them is missing.
fn chained_rotation(chain: &Chain, from: usize, to: usize) -> Option<UnitQuaternion<f64>> {
    chain.pairs[from..to].iter().try_fold(UnitQuaternion::identity(), |so_far, pair| {
        let ok = pair.solution.status == PairStatus::Ok;
        ok.then(|| pair.solution.camera_to_from_camera_from * so_far)
    })
}
