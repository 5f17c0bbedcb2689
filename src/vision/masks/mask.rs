//! Parts of every image that are not to be looked at: a leg of the lander, an antenna, a dirty lens.

use crate::vision::error::VisionError;
use crate::vision::opencv_bridge::{grey_image, image_mat};
use image::GrayImage;
use nalgebra::Vector2;
use opencv::core::{BORDER_CONSTANT, Mat, Point, Scalar, Size};
use opencv::imgproc::{MORPH_RECT, erode, get_structuring_element};

/// How much further than half its side a patch may reach: a pixel for its slopes, and two for where it ends up.
const BEYOND_PATCH_PX: u32 = 3;

/// A mask that holds for all images.
pub struct KeepOut<'a> {
    mask: &'a GrayImage,
    clear: GrayImage,
}

impl<'a> KeepOut<'a> {
    /// Prepares a mask (0: do not look here) for patches of `half_px` about each point.
    ///
    /// # Errors
    /// A mask of another size than the camera's, one that leaves nothing, or OpenCV's refusal.
    pub fn new(mask: &'a GrayImage, half_px: u32, size_px: (u32, u32)) -> Result<Self, VisionError> {
        if mask.dimensions() != size_px {
            let ((mask_width_px, mask_height_px), (width_px, height_px)) = (mask.dimensions(), size_px);
            return Err(VisionError::MaskSize { mask_width_px, mask_height_px, width_px, height_px });
        }
        let clear = clear_of(mask, half_px + BEYOND_PATCH_PX).map_err(VisionError::opencv("erode a mask"))?;
        if clear.as_raw().iter().all(|c| *c == 0) {
            return Err(VisionError::MaskCoversAll);
        }
        Ok(KeepOut { mask, clear })
    }

    /// Not zero where a point and its patch stay clear of the mask's zeros.
    pub fn clear(&self) -> &GrayImage {
        &self.clear
    }

    /// Whether the patch about a pixel stays clear of the mask's zeros.
    pub fn is_clear(&self, pixel_px: &Vector2<f64>) -> bool {
        let (x, y) = (pixel_px.x.round(), pixel_px.y.round());
        let inside = x >= 0.0 && y >= 0.0 && x < f64::from(self.clear.width()) && y < f64::from(self.clear.height());
        inside && self.clear.get_pixel(x as u32, y as u32).0[0] != 0
    }

    /// The image, black where it is not to be looked at.
    pub fn blackened(&self, image: &GrayImage) -> GrayImage {
        let mut seen = image.clone();
        seen.iter_mut().zip(self.mask.as_raw()).filter(|(_, mask)| **mask == 0).for_each(|(level, _)| *level = 0);
        seen
    }
}

/// The mask without what lies within `margin_px` of its zeros along both axes; the image's edge is no zero.
fn clear_of(mask: &GrayImage, margin_px: u32) -> opencv::Result<GrayImage> {
    let (side, centre) = (2 * margin_px as i32 + 1, Point::new(-1, -1));
    let square = get_structuring_element(MORPH_RECT, Size::new(side, side), centre)?;
    let (beyond, mut clear) = (Scalar::all(f64::MAX), Mat::default());
    erode(&image_mat(mask)?, &mut clear, &square, centre, 1, BORDER_CONSTANT, beyond)?;
    grey_image(&clear)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patches_keep_off_a_masked_pixel_and_not_off_the_edge() {
        let mut mask = GrayImage::from_pixel(64, 48, image::Luma([1]));
        mask.put_pixel(30, 20, image::Luma([0]));
        let keep_out = KeepOut::new(&mask, 5, (64, 48)).expect("a mask");
        let clear = |x: f64, y: f64| keep_out.is_clear(&Vector2::new(x, y));
        assert!(!clear(30.0, 20.0) && !clear(38.0, 28.4) && !clear(22.0, 12.0));
        assert!(clear(39.0, 20.0) && clear(30.0, 11.0) && clear(0.0, 0.0) && clear(63.0, 47.0));
        assert!(!clear(-1.0, 20.0) && !clear(64.0, 20.0), "outside of the picture");
        let black = keep_out.blackened(&GrayImage::from_pixel(64, 48, image::Luma([9])));
        assert_eq!(black.as_raw().iter().filter(|g| **g == 0).count(), 1);
    }

    #[test]
    fn a_mask_must_fit_and_leave_something() {
        let refused =
            |mask: &GrayImage| KeepOut::new(mask, 5, (64, 48)).err().map(|e| e.to_string()).unwrap_or_default();
        assert!(refused(&GrayImage::from_pixel(48, 64, image::Luma([1]))).contains("48x64"));
        assert!(refused(&GrayImage::new(64, 48)).contains("nothing"));
        assert_eq!(refused(&GrayImage::from_pixel(64, 48, image::Luma([1]))), "");
    }
}
