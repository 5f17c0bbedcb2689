//! Rasters from PNG and JPEG images.

use super::file_raster::FileRaster;
use image::DynamicImage;

/// Grey values of an image, 0 to 255 or 0 to 65535 as the file has them; colours become luma.
pub fn read(bytes: &[u8]) -> Result<FileRaster, String> {
    let image =
        image::load_from_memory(bytes).map_err(|e| format!("the picture cannot be read: {e}; is it cut short?"))?;
    let columns = image.width() as usize;
    let values = match image {
        DynamicImage::ImageLuma16(_)
        | DynamicImage::ImageLumaA16(_)
        | DynamicImage::ImageRgb16(_)
        | DynamicImage::ImageRgba16(_) => image.to_luma16().as_raw().iter().map(|v| f64::from(*v)).collect(),
        _ => image.to_luma8().as_raw().iter().map(|v| f64::from(*v)).collect(),
    };
    Ok(FileRaster { columns, values, georeference: None })
}
