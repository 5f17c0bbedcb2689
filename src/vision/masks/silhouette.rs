//! The bright silhouette of a body against the dark.

use crate::vision::error::VisionError;
use crate::vision::opencv_bridge::image_mat;
use image::GrayImage;
use nalgebra::Vector2;
use opencv::core::{Mat, Point, Scalar, Size};
use opencv::imgproc::{MORPH_ELLIPSE, THRESH_BINARY, THRESH_OTSU, erode, get_structuring_element, threshold};
use opencv::prelude::*;

/// Centroid of the bright pixels (Otsu 1979), px; `None` for an image without any.
///
/// # Errors
/// OpenCV's refusal.
pub fn bright_centroid_px(image: &GrayImage) -> Result<Option<Vector2<f64>>, VisionError> {
    let mask = bright(image).map_err(VisionError::opencv("threshold a picture"))?;
    let bytes = mask.data_bytes().map_err(VisionError::opencv("read a mask"))?;
    let (mut sum, mut count) = (Vector2::zeros(), 0.0);
    for (index, _) in bytes.iter().enumerate().filter(|(_, value)| **value != 0) {
        sum += Vector2::new((index % image.width() as usize) as f64, (index / image.width() as usize) as f64);
        count += 1.0;
    }
    Ok((count > 0.0).then(|| sum / count))
}

/// The bright pixels at least `margin_px` from the dark: away from the limb and the terminator, whose corners do not
/// stay on the surface.
///
/// # Errors
/// OpenCV's refusal.
pub fn inside_silhouette(image: &GrayImage, margin_px: u32) -> Result<GrayImage, VisionError> {
    let eroded = || -> opencv::Result<Mat> {
        let side = 2 * margin_px as i32 + 1;
        let centre = Point::new(-1, -1);
        let disc = get_structuring_element(MORPH_ELLIPSE, Size::new(side, side), centre)?;
        let mut inside = Mat::default();
        let mask = bright(image)?;
        erode(&mask, &mut inside, &disc, centre, 1, opencv::core::BORDER_REPLICATE, Scalar::default())?;
        Ok(inside)
    };
    let inside = eroded().map_err(VisionError::opencv("erode a mask"))?;
    let bytes = inside.data_bytes().map_err(VisionError::opencv("read a mask"))?.to_vec();
    Ok(GrayImage::from_raw(image.width(), image.height(), bytes).expect("the mask has the picture's size"))
}

/// 255 where the smoothed image is brighter than a third of Otsu's threshold: lit ground, shaded slopes included. The
/// third decides where to look and enters no covariance.
fn bright(image: &GrayImage) -> opencv::Result<Mat> {
    let bytes = image_mat(image)?;
    let (mut smooth, mut mask) = (Mat::default(), Mat::default());
    opencv::imgproc::gaussian_blur_def(&bytes, &mut smooth, Size::new(0, 0), 2.0)?;
    let level = threshold(&smooth, &mut mask, 0.0, 255.0, THRESH_BINARY | THRESH_OTSU)?;
    threshold(&smooth, &mut mask, (level / 3.0).max(4.0), 255.0, THRESH_BINARY)?;
    Ok(mask)
}
