//! Grey images of 1 to 16 bits a pixel.

use image::{DynamicImage, GrayImage, ImageBuffer};

/// A grey image as a detector delivers it: digital numbers from 0 to 2^bits - 1, rows from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct GreyRaster {
    /// Width in px.
    pub width_px: u32,
    /// Height in px.
    pub height_px: u32,
    /// Bits a pixel, 1 to 16.
    pub bits: u32,
    /// Digital numbers, row by row.
    pub numbers: Vec<u16>,
}

impl GreyRaster {
    /// The image as its file holds it: the numbers as they are, in 8 bits a pixel where they fit, else in 16.
    /// `None` if the numbers do not fill the image or exceed their bits.
    pub fn to_image(&self) -> Option<DynamicImage> {
        let largest = (1_u32 << self.bits.min(16)) - 1;
        if self.numbers.iter().any(|n| u32::from(*n) > largest) {
            return None;
        }
        if self.bits > 8 {
            let deep = ImageBuffer::from_raw(self.width_px, self.height_px, self.numbers.clone())?;
            return Some(DynamicImage::ImageLuma16(deep));
        }
        let bytes = self.numbers.iter().map(|n| *n as u8).collect();
        GrayImage::from_raw(self.width_px, self.height_px, bytes).map(DynamicImage::ImageLuma8)
    }
}
