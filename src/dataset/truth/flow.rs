//! Optical flow in Middlebury's `.flo` format: "PIEH", width and height as i32, then (u, v) as f32 row by row, all
//! little-endian (Baker et al., "A database and evaluation methodology for optical flow", 2011). Its readers, OpenCV's
//! among them, take NaN for unknown.

use crate::dataset::error::DatasetError;
use nalgebra::Vector2;
use std::path::Path;

/// Motion of each pixel's surface point to the next image.
#[derive(Debug, Clone, PartialEq)]
pub struct OpticalFlow {
    /// Width in px.
    pub width_px: u32,
    /// Height in px.
    pub height_px: u32,
    /// Pixel in the next image less pixel in this one, rows from the top; NaN where the point is not visible in the
    /// next image, or where there is no surface.
    pub motion_px: Vec<Vector2<f32>>,
}

const TAG: &[u8; 4] = b"PIEH";
const HEADER_BYTES: usize = 12;

/// The content of a `.flo` file.
pub fn encode_flow(flow: &OpticalFlow) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(HEADER_BYTES + 8 * flow.motion_px.len());
    bytes.extend_from_slice(TAG);
    bytes.extend_from_slice(&flow.width_px.to_le_bytes());
    bytes.extend_from_slice(&flow.height_px.to_le_bytes());
    for motion in &flow.motion_px {
        bytes.extend_from_slice(&motion.x.to_le_bytes());
        bytes.extend_from_slice(&motion.y.to_le_bytes());
    }
    bytes
}

/// Reads a `.flo` file.
///
/// # Errors
/// Names the file, and says so if it is not such a file or not whole.
pub fn read_flow(path: &Path) -> Result<OpticalFlow, DatasetError> {
    let bytes = std::fs::read(path).map_err(DatasetError::io("read", path))?;
    let unusable = |problem: &str| DatasetError::Unusable { path: path.into(), problem: problem.into() };
    if bytes.len() < HEADER_BYTES || &bytes[..4] != TAG {
        return Err(unusable("it does not begin as a .flo file does (PIEH)"));
    }
    let word = |at: usize| [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]];
    let (width_px, height_px) = (u32::from_le_bytes(word(4)), u32::from_le_bytes(word(8)));
    let expected_bytes = HEADER_BYTES as u128 + 8 * u128::from(width_px) * u128::from(height_px);
    if bytes.len() as u128 != expected_bytes {
        return Err(unusable(&format!("it has {} bytes, {expected_bytes} expected: make it anew", bytes.len())));
    }
    let motion = |at: usize| Vector2::new(f32::from_le_bytes(word(at)), f32::from_le_bytes(word(at + 4)));
    let motion_px = (HEADER_BYTES..bytes.len()).step_by(8).map(motion).collect();
    Ok(OpticalFlow { width_px, height_px, motion_px })
}
