//! Smoothed image and corner response by OpenCV.

use super::detector::Detector;
use super::response_config::ResponseConfig;
use super::responses::Responses;
use crate::vision::opencv_bridge::image_mat;
use image::GrayImage;
use opencv::core::{BORDER_REFLECT_101, CV_32F, Mat, Size};
use opencv::imgproc::gaussian_blur;
use opencv::prelude::*;

/// Lines that are responded to together: few enough to stay in the processor's cache.
pub(super) const BAND: i32 = 48;

/// Smooths an image, lets a detector respond to it, and smooths the response.
pub(super) fn responses_by_opencv(
    detector: &dyn Detector,
    image: &GrayImage,
    config: &ResponseConfig,
) -> opencv::Result<Responses> {
    let mut found = Responses::take();
    image_mat(image)?.convert_to(&mut found.between, CV_32F, 1.0 / 255.0, 0.0)?;
    blur(&found.between, &mut found.smooth, config.smoothing_sigma_px)?;
    respond_in_bands(detector, &found.smooth, config, &mut found.between)?;
    blur(&found.between, &mut found.response, config.response_sigma_px)?;
    Ok(found)
}

fn blur(from: &Mat, to: &mut Mat, sigma_px: f64) -> opencv::Result<()> {
    gaussian_blur(from, to, Size::new(0, 0), sigma_px, sigma_px, BORDER_REFLECT_101)
}

/// The response band by band, each with the lines around it that it depends on.
fn respond_in_bands(
    detector: &dyn Detector,
    smooth: &Mat,
    config: &ResponseConfig,
    response: &mut Mat,
) -> opencv::Result<()> {
    let (rows, reach) = (smooth.rows(), config.block_px as i32 / 2 + 1);
    let mut part = Mat::default();
    for first in (0..rows).step_by(BAND as usize) {
        let last = (first + BAND).min(rows);
        let (above, below) = ((first - reach).max(0), (last + reach).min(rows));
        detector.respond(&smooth.row_bounds(above, below)?.try_clone()?, config, &mut part)?;
        part.row_bounds(first - above, last - above)?.copy_to(&mut response.row_bounds_mut(first, last)?)?;
    }
    Ok(())
}
