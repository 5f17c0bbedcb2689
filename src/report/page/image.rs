//! Images as the page carries them.

use crate::report::error::ReportError;
use image::RgbImage;
use std::io::Cursor;

/// PNG bytes of an image, made smaller if it is wider than `most_px`.
///
/// # Errors
/// [`ReportError::PageImage`] if it cannot be encoded, such as an empty one.
pub fn image_png(image: &RgbImage, most_px: u32) -> Result<Vec<u8>, ReportError> {
    let mut bytes = Cursor::new(Vec::new());
    if image.width() > most_px && most_px > 0 {
        let height = (u64::from(image.height()) * u64::from(most_px) / u64::from(image.width())).max(1) as u32;
        let small = image::imageops::resize(image, most_px, height, image::imageops::FilterType::Triangle);
        small.write_to(&mut bytes, image::ImageFormat::Png)?;
    } else {
        image.write_to(&mut bytes, image::ImageFormat::Png)?;
    }
    Ok(bytes.into_inner())
}
