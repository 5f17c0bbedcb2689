//! Points followed from image to image by the grey levels about them, after warping them by a predicted motion.

use super::alignment::{AlignedPatch, refine_by_patch};
use super::config::KltConfig;
use super::local_affine::Affine;
use crate::vision::error::VisionError;
use crate::vision::opencv_bridge::{grey_image, image_mat};
use image::GrayImage;
use nalgebra::{Matrix2, Vector2};
use opencv::core::{BORDER_REFLECT_101, Mat, Size};
use opencv::imgproc::pyr_down;
use rayon::prelude::*;

/// Where a point was found in the second image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KltPoint {
    /// Pixel (u, v).
    pub pixel_px: Vector2<f64>,
    /// Predicted covariance of the pixel, the first one taken as exact, px².
    pub covariance_px2: Matrix2<f64>,
    /// Correlation of the patches, 0 to 1.
    pub correlation: f64,
}

/// Follows points from one image into another; `None` where a point leaves the image, where the grey levels do not say
/// where it went, or where the way back does not end where it began.
///
/// `predict` carries pixels of the first image into the second as far as the motion is known beforehand (a turn from
/// gyroscopes, a plane, the matches around); it warps each patch, too. What it leaves open is searched for from coarse to
/// fine. Points are independent: the result does not depend on the number of threads.
///
/// # Errors
/// OpenCV's refusal to shrink an image.
pub fn track_patches(
    (from, to): (&GrayImage, &GrayImage),
    points_px: &[Vector2<f64>],
    predict: &(dyn Fn(&Vector2<f64>) -> Option<Vector2<f64>> + Sync),
    config: &KltConfig,
) -> Result<Vec<Option<KltPoint>>, VisionError> {
    let shrink = |image| pyramid(image, config.levels).map_err(VisionError::opencv("shrink a picture"));
    let (from, to) = (shrink(from)?, shrink(to)?);
    let follow = |point_px: &Vector2<f64>| {
        let warp = warp_about(point_px, predict, f64::from(config.half_px))?;
        let there = coarse_to_fine((&from, &to), point_px, &warp, config)?;
        let back = Affine::about(&there.pixel_px, point_px, warp.linear.try_inverse()?);
        let returned = refine_by_patch((&to[0], &from[0]), &there.pixel_px, &back, config)?;
        ((returned.pixel_px - point_px).norm() <= config.max_return_px).then_some(KltPoint {
            pixel_px: there.pixel_px,
            covariance_px2: there.covariance_px2,
            correlation: there.correlation,
        })
    };
    Ok(points_px.par_iter().map(follow).collect())
}

/// The image and smaller ones, each half as large.
fn pyramid(image: &GrayImage, levels: u32) -> opencv::Result<Vec<GrayImage>> {
    let mut images = vec![image.clone()];
    for _ in 1..levels {
        let last = &images[images.len() - 1];
        if last.width().min(last.height()) < 64 {
            break;
        }
        let mut half = Mat::default();
        pyr_down(&image_mat(last)?, &mut half, Size::default(), BORDER_REFLECT_101)?;
        images.push(grey_image(&half)?);
    }
    Ok(images)
}

/// The predicted motion about a point, by central differences over the patch.
fn warp_about(
    point_px: &Vector2<f64>,
    predict: &dyn Fn(&Vector2<f64>) -> Option<Vector2<f64>>,
    reach_px: f64,
) -> Option<Affine> {
    let slope =
        |step: Vector2<f64>| Some((predict(&(point_px + step))? - predict(&(point_px - step))?) / (2.0 * reach_px));
    let linear = Matrix2::from_columns(&[slope(Vector2::x() * reach_px)?, slope(Vector2::y() * reach_px)?]);
    Some(Affine::about(point_px, &predict(point_px)?, linear))
}

/// The point in the second image: each level starts where the coarser one ended, or at the prediction where that failed.
fn coarse_to_fine(
    (from, to): (&[GrayImage], &[GrayImage]),
    point_px: &Vector2<f64>,
    warp: &Affine,
    config: &KltConfig,
) -> Option<AlignedPatch> {
    let mut start_px = warp.apply(point_px);
    let coarse = KltConfig { half_px: (config.half_px / 2).max(3), ..config.clone() };
    for level in (1..from.len()).rev() {
        let scale = f64::from(1u32 << level);
        let here = point_px / scale;
        let smaller = Affine::about(&here, &(start_px / scale), warp.linear);
        if let Some(found) = refine_by_patch((&from[level], &to[level]), &here, &smaller, &coarse) {
            start_px = found.pixel_px * scale;
        }
    }
    refine_by_patch((&from[0], &to[0]), point_px, &Affine::about(point_px, &start_px, warp.linear), config)
}
