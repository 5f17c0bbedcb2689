//! Images: grey PNG, float TIFF of depth, albedo or normals, mask PNG.

use crate::dataset::error::DatasetError;
use crate::dataset::storage::write_atomically;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{DynamicImage, GrayImage, ImageBuffer, Luma, Rgb};
use std::io::Cursor;
use std::path::Path;
use tiff::encoder::colortype::{ColorType, Gray32Float, RGB32Float};

/// The content of a grey PNG of 8 or 16 bits, packed fast rather than small.
///
/// # Errors
/// [`DatasetError::Unusable`] names `path`.
pub fn encode_grey_png(path: &Path, image: &DynamicImage) -> Result<Vec<u8>, DatasetError> {
    let mut bytes = Vec::with_capacity(image.as_bytes().len() + 1024);
    let encoder = PngEncoder::new_with_quality(&mut bytes, CompressionType::Fast, FilterType::Up);
    image
        .write_with_encoder(encoder)
        .map_err(|e| DatasetError::Unusable { path: path.into(), problem: e.to_string() })?;
    Ok(bytes)
}

/// Writes an 8-bit grey PNG atomically.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_grey_png(path: &Path, image: &GrayImage) -> Result<(), DatasetError> {
    let bytes = encode_grey_png(path, &DynamicImage::ImageLuma8(image.clone()))?;
    write_atomically(path, |w| w.write_all(&bytes))
}

/// Reads an 8-bit mask.
///
/// # Errors
/// Names the file.
pub fn read_mask_png(path: &Path) -> Result<GrayImage, DatasetError> {
    let image = image::open(path).map_err(|e| DatasetError::Unusable { path: path.into(), problem: e.to_string() })?;
    Ok(image.to_luma8())
}

/// The content of a float32 TIFF of one channel (depth in m, albedo), rows from the top, not compressed.
///
/// # Errors
/// [`DatasetError::Unusable`] names `path` if the values do not fill the image.
pub fn encode_scalar_tiff(path: &Path, size_px: (u32, u32), values: &[f32]) -> Result<Vec<u8>, DatasetError> {
    encode_float_tiff::<Gray32Float>(path, size_px, values)
}

/// The content of a float32 TIFF of three channels, such as surface normals; rows from the top, not compressed.
///
/// # Errors
/// [`DatasetError::Unusable`] names `path` if the values do not fill the image.
pub fn encode_vector_tiff(path: &Path, size_px: (u32, u32), values: &[[f32; 3]]) -> Result<Vec<u8>, DatasetError> {
    encode_float_tiff::<RGB32Float>(path, size_px, values.as_flattened())
}

fn encode_float_tiff<Kind: ColorType<Inner = f32>>(
    path: &Path,
    (width_px, height_px): (u32, u32),
    values: &[f32],
) -> Result<Vec<u8>, DatasetError>
where
    [f32]: tiff::encoder::TiffValue,
{
    let unusable = |e: tiff::TiffError| DatasetError::Unusable { path: path.into(), problem: e.to_string() };
    let mut bytes = Cursor::new(Vec::with_capacity(size_of_val(values) + 4096));
    let mut encoder = tiff::encoder::TiffEncoder::new(&mut bytes).map_err(unusable)?;
    encoder.write_image::<Kind>(width_px, height_px, values).map_err(unusable)?;
    Ok(bytes.into_inner())
}

/// Writes a float32 TIFF of z-depth (m, NaN where nothing is hit), rows from the top.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_depth_tiff(path: &Path, width_px: u32, height_px: u32, depth_m: &[f32]) -> Result<(), DatasetError> {
    let bytes = encode_scalar_tiff(path, (width_px, height_px), depth_m)?;
    write_atomically(path, |w| w.write_all(&bytes))
}

/// Reads a float32 TIFF of one channel: z-depth in m, or albedo.
///
/// # Errors
/// Names the file, and says so if it is not a float image of one channel.
pub fn read_depth_tiff(path: &Path) -> Result<ImageBuffer<Luma<f32>, Vec<f32>>, DatasetError> {
    let (size_px, values) = read_float_tiff(path)?;
    ImageBuffer::from_raw(size_px.0, size_px.1, values).ok_or_else(|| wrong_channels(path, "one channel"))
}

/// Reads a float32 TIFF of three channels: surface normals in reference axes.
///
/// # Errors
/// Names the file, and says so if it is not a float image of three channels.
pub fn read_normals_tiff(path: &Path) -> Result<ImageBuffer<Rgb<f32>, Vec<f32>>, DatasetError> {
    let (size_px, values) = read_float_tiff(path)?;
    let complete = values.len() as u64 == 3 * u64::from(size_px.0) * u64::from(size_px.1);
    ImageBuffer::from_raw(size_px.0, size_px.1, values)
        .filter(|_| complete)
        .ok_or_else(|| wrong_channels(path, "three channels"))
}

fn wrong_channels(path: &Path, expected: &str) -> DatasetError {
    DatasetError::Unusable { path: path.into(), problem: format!("it is not a picture of {expected}") }
}

fn read_float_tiff(path: &Path) -> Result<((u32, u32), Vec<f32>), DatasetError> {
    let unusable = |problem: String| DatasetError::Unusable { path: path.into(), problem };
    let file = std::fs::File::open(path).map_err(DatasetError::io("read", path))?;
    let mut decoder =
        tiff::decoder::Decoder::new(std::io::BufReader::new(file)).map_err(|e| unusable(e.to_string()))?;
    let size_px = decoder.dimensions().map_err(|e| unusable(e.to_string()))?;
    match decoder.read_image().map_err(|e| unusable(e.to_string()))? {
        tiff::decoder::DecodingResult::F32(values) => Ok((size_px, values)),
        _ => Err(unusable("it is not a float32 picture".into())),
    }
}
