//! Pictures as the page carries them.

use crate::report::error::ReportError;
use image::RgbImage;
use std::io::Cursor;

/// PNG bytes of a picture, made smaller if it is wider than `most_px`.
///
/// # Errors
/// [`ReportError::Picture`] if it cannot be encoded, such as an empty one.
pub fn picture_png(picture: &RgbImage, most_px: u32) -> Result<Vec<u8>, ReportError> {
    let mut bytes = Cursor::new(Vec::new());
    if picture.width() > most_px && most_px > 0 {
        let height = (u64::from(picture.height()) * u64::from(most_px) / u64::from(picture.width())).max(1) as u32;
        let small = image::imageops::resize(picture, most_px, height, image::imageops::FilterType::Triangle);
        small.write_to(&mut bytes, image::ImageFormat::Png)?;
    } else {
        picture.write_to(&mut bytes, image::ImageFormat::Png)?;
    }
    Ok(bytes.into_inner())
}
