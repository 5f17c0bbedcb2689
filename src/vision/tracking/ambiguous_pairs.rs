//! Pairs with two rival solutions, settled by their neighbours.

use super::adjacent_pair::Pair;
use super::context::{Center, TrackingContext};
use super::image_chain::Chain;
use super::pair_pixels::PairPixels;
use crate::geometry::Camera;
use crate::observations::PairStatus;
use crate::vision::error::VisionError;
use crate::vision::pair::{PairHints, relative_rotation};
use nalgebra::{Unit, UnitQuaternion, Vector3};

/// Pairs with two rival solutions are solved again with the ground's normal as their neighbours found it: first as the
/// pair before did, then, for those that come before the first clear one, as the pair after did.
pub fn resolve_ambiguous_pairs(context: &TrackingContext, chain: &mut Chain) -> Result<Center, VisionError> {
    let again = |pair: &mut Pair, normal: Unit<Vector3<f64>>| -> Result<(), VisionError> {
        let hints = PairHints { camera_to_from_camera_from: None, normal_in_from: Some(normal) };
        pair.solution = relative_rotation(pair.pixels.view(), context.camera(), &hints, &context.config.rotation)?;
        Ok(())
    };
    let open = |pair: &Pair| pair.is_open() && context.prior.is_none();
    let mut normal: Option<Unit<Vector3<f64>>> = None;
    for pair in &mut chain.pairs {
        if let Some(known) = normal.filter(|_| open(pair)) {
            again(pair, known)?;
        }
        let here = pair.solution.normal_in_from.or(normal);
        normal = here.zip(turn_of(pair, context.camera())).map(|(n, turn)| turn * n);
    }
    let mut normal_after: Option<Unit<Vector3<f64>>> = None;
    for pair in chain.pairs.iter_mut().rev() {
        let carried = normal_after.zip(turn_of(pair, context.camera())).map(|(n, turn)| turn.inverse() * n);
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
