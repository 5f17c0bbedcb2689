//! How the numbers of images become 8-bit grey.

use super::image_file::RawImage;
use image::{GrayImage, ImageBuffer, Luma};

/// Which numbers become 0 and 255, alike for all images of a sequence, so that grey levels can be compared.
///
/// Images of 8 bits are taken as they are, unless their camera file states fewer `bits`. Images of 16 bits are
/// divided by the largest number of the stated bits; where none are stated, of the bits that a sample of the images
/// uses. Floating-point images are mapped from the range between the 0.1 % and 99.9 % quantiles of a sample, widened by
/// a tenth on both sides. What lies outside becomes 0 or 255; what is not a number becomes 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IntensityScale {
    /// Bits that the numbers of 8-bit images use, 1 to 8.
    pub shallow_bits: u32,
    /// Bits that the numbers of 16-bit images use, 1 to 16.
    pub deep_bits: u32,
    /// The numbers of floating-point images that become 0 and 255.
    pub real_range: [f32; 2],
}

/// A sample of the numbers of a sequence's deep images.
#[derive(Debug, Default)]
pub(super) struct NumberSample {
    /// The largest whole number.
    largest: u16,
    reals: Vec<f32>,
}

impl NumberSample {
    /// Most numbers kept of one image.
    const PER_IMAGE: usize = 50_000;

    pub(super) fn add(&mut self, picture: &RawImage) {
        match picture {
            RawImage::Shallow(_) => {}
            RawImage::Deep(deep) => self.largest = deep.iter().copied().fold(self.largest, u16::max),
            RawImage::Real(real) => {
                let step = real.as_raw().len().div_ceil(Self::PER_IMAGE).max(1);
                self.reals.extend(real.iter().step_by(step).filter(|v| v.is_finite()));
            }
        }
    }

    /// Bits that the largest whole number needs; `None` if all are 0 or none was seen.
    fn bits(&self) -> Option<u32> {
        (self.largest > 0).then(|| u16::BITS - self.largest.leading_zeros())
    }

    /// The range of the floating-point numbers; `None` if none was seen or all are the same.
    fn range(&mut self) -> Option<[f32; 2]> {
        self.reals.sort_unstable_by(f32::total_cmp);
        let last = self.reals.len().checked_sub(1)?;
        let quantile = |share: f64| self.reals[(share * last as f64).round() as usize];
        let (low, high) = (quantile(0.001), quantile(0.999));
        let margin = 0.1 * (high - low);
        (margin > 0.0 && margin.is_finite()).then_some([low - margin, high + margin])
    }
}

impl IntensityScale {
    /// From the bits that a camera file states, if any, and a sample of the deep images; what the sample decided is
    /// added to `notes`.
    pub(super) fn new(stated_bits: Option<u32>, mut sample: NumberSample, notes: &mut Vec<String>) -> Self {
        let (found_bits, found_range) = (sample.bits().filter(|_| stated_bits.is_none()), sample.range());
        notes.extend(found_bits.map(|bits| {
            format!(
                "16-bit pictures seem to use {bits} bits: {} becomes 255; `bits` in the camera file states it",
                (1_u32 << bits) - 1
            )
        }));
        notes.extend(
            found_range
                .map(|[black, white]| format!("floating-point pictures: {black} becomes 0 and {white} becomes 255")),
        );
        IntensityScale {
            shallow_bits: stated_bits.unwrap_or(8).min(8),
            deep_bits: stated_bits.or(found_bits).unwrap_or(16),
            real_range: found_range.unwrap_or([0.0, 1.0]),
        }
    }

    pub(super) fn to_eight_bits(self, picture: RawImage) -> GrayImage {
        match picture {
            RawImage::Shallow(shallow) if self.shallow_bits < 8 => scaled(&shallow, self.shallow_bits),
            RawImage::Shallow(shallow) => shallow,
            RawImage::Deep(deep) => scaled(&deep, self.deep_bits),
            RawImage::Real(real) => {
                let [black, white] = self.real_range;
                let scale = 255.0 / (white - black);
                // A cast turns what is not a number into 0.
                mapped(&real, |value| ((value - black) * scale).round().clamp(0.0, 255.0) as u8)
            }
        }
    }
}

fn scaled<T: image::Primitive + Into<u32>>(image: &ImageBuffer<Luma<T>, Vec<T>>, bits: u32) -> GrayImage
where
    Luma<T>: image::Pixel<Subpixel = T>,
{
    let largest = (1_u32 << bits) - 1;
    mapped(image, |number| ((number.into() * 255 + largest / 2) / largest).min(255) as u8)
}

fn mapped<T: image::Primitive>(image: &ImageBuffer<Luma<T>, Vec<T>>, byte: impl Fn(T) -> u8) -> GrayImage
where
    Luma<T>: image::Pixel<Subpixel = T>,
{
    let bytes = image.as_raw().iter().map(|number| byte(*number)).collect();
    GrayImage::from_raw(image.width(), image.height(), bytes).expect("one byte a pixel")
}
