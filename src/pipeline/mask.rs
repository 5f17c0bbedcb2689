//! The file that says where not to look.

use crate::dataset::DatasetError;
use image::{DynamicImage, GrayImage, ImageDecoder, ImageReader};
use std::path::Path;

/// Reads a mask of 8 bits a pixel and of the camera's size.
///
/// # Errors
/// Names the file and what to do: it cannot be read, has another size or another kind of numbers.
pub(super) fn read_mask(path: &Path, (width_px, height_px): (u32, u32)) -> Result<GrayImage, DatasetError> {
    let unusable = |problem: String| DatasetError::Unusable { path: path.into(), problem };
    if !path.is_file() {
        let cure = "the mask is a picture of 8 bits, 0 where not to look".into();
        return Err(DatasetError::Missing { path: path.into(), cure });
    }
    let unreadable = |problem: String| unusable(format!("the mask cannot be read as a picture ({problem})"));
    let reader = ImageReader::open(path).and_then(ImageReader::with_guessed_format);
    let decoder =
        reader.map_err(|e| unreadable(e.to_string()))?.into_decoder().map_err(|e| unreadable(e.to_string()))?;
    let (found_width_px, found_height_px) = decoder.dimensions();
    if (found_width_px, found_height_px) != (width_px, height_px) {
        return Err(unusable(format!(
            "the mask is {found_width_px}x{found_height_px} px, but the camera is {width_px}x{height_px} px: draw it on \
             one of the camera's pictures"
        )));
    }
    match DynamicImage::from_decoder(decoder).map_err(|e| unreadable(e.to_string()))? {
        DynamicImage::ImageLuma8(mask) => Ok(mask),
        other => Err(unusable(format!("the mask is a picture of kind {:?}: save it as grey of 8 bits", other.color()))),
    }
}
