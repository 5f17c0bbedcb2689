//! Pictures: grey PNG, float depth TIFF, mask PNG.

use super::{DatasetError, write_atomically};
use image::{GrayImage, ImageBuffer, Luma};
use std::io::Cursor;
use std::path::Path;

/// Writes an 8-bit grey PNG atomically.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_grey_png(path: &Path, picture: &GrayImage) -> Result<(), DatasetError> {
    let mut bytes = Cursor::new(Vec::new());
    picture
        .write_to(&mut bytes, image::ImageFormat::Png)
        .map_err(|e| DatasetError::Unusable { path: path.into(), problem: e.to_string() })?;
    write_atomically(path, |w| w.write_all(bytes.get_ref()))
}

/// Reads an 8-bit mask.
///
/// # Errors
/// Names the file.
pub fn read_mask_png(path: &Path) -> Result<GrayImage, DatasetError> {
    let picture =
        image::open(path).map_err(|e| DatasetError::Unusable { path: path.into(), problem: e.to_string() })?;
    Ok(picture.to_luma8())
}

/// Writes a float32 TIFF of z-depth (m, NaN where nothing is hit), rows from the top.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_depth_tiff(path: &Path, width_px: u32, height_px: u32, depth_m: &[f32]) -> Result<(), DatasetError> {
    let unusable = |e: tiff::TiffError| DatasetError::Unusable { path: path.into(), problem: e.to_string() };
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = tiff::encoder::TiffEncoder::new(&mut bytes).map_err(unusable)?;
    encoder.write_image::<tiff::encoder::colortype::Gray32Float>(width_px, height_px, depth_m).map_err(unusable)?;
    write_atomically(path, |w| w.write_all(bytes.get_ref()))
}

/// Reads a float32 TIFF of z-depth in m.
///
/// # Errors
/// Names the file, and says so if it is not a float picture of one channel.
pub fn read_depth_tiff(path: &Path) -> Result<ImageBuffer<Luma<f32>, Vec<f32>>, DatasetError> {
    let unusable = |problem: String| DatasetError::Unusable { path: path.into(), problem };
    let file = std::fs::File::open(path).map_err(DatasetError::io("read", path))?;
    let mut decoder =
        tiff::decoder::Decoder::new(std::io::BufReader::new(file)).map_err(|e| unusable(e.to_string()))?;
    let (width, height) = decoder.dimensions().map_err(|e| unusable(e.to_string()))?;
    match decoder.read_image().map_err(|e| unusable(e.to_string()))? {
        tiff::decoder::DecodingResult::F32(values) => ImageBuffer::from_raw(width, height, values)
            .ok_or_else(|| unusable("it is not a picture of one channel".into())),
        _ => Err(unusable("it is not a float32 picture".into())),
    }
}
