//! Reading an image of any kind: PNG, JPEG, TIFF, BMP or PNM; whole numbers or floating point; grey or colour.

use crate::dataset::error::DatasetError;
use image::{DynamicImage, GrayImage, ImageBuffer, ImageDecoder, ImageFormat, ImageReader, Luma};
use std::fs::File;
use std::io::{BufReader, Cursor};
use std::path::Path;
use tiff::ColorType;
use tiff::decoder::{Decoder, DecodingResult};
use tiff::tags::Tag;

/// Extensions of the files that count as images.
pub(super) const EXTENSIONS: [&str; 10] = ["png", "jpg", "jpeg", "tif", "tiff", "bmp", "pgm", "ppm", "pbm", "pnm"];

/// Most pixels of an image: detection takes some 40 bytes a pixel.
const MOST_PIXELS: u64 = 1 << 26;

/// A grey image with the numbers of its file.
pub enum RawImage {
    /// Up to 8 bits a pixel.
    Shallow(GrayImage),
    /// Up to 16 bits a pixel.
    Deep(ImageBuffer<Luma<u16>, Vec<u16>>),
    /// Floating point, or whole numbers of more than 16 bits or with a sign.
    Real(ImageBuffer<Luma<f32>, Vec<f32>>),
}

/// What an image's header says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Header {
    pub size_px: (u32, u32),
    pub(super) numbers: Numbers,
    format: ImageFormat,
    /// Grey numbers of a kind that only the TIFF decoder itself reads.
    is_real_grey: bool,
}

/// The kind of an image's numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Numbers {
    /// Up to 8 bits.
    Shallow,
    /// Up to 16 bits.
    Deep,
    /// Floating point, more bits, or with a sign.
    Real,
}

/// Reads an image's header alone.
///
/// # Errors
/// Names a file that is missing, of no known kind, or whose image has more than 2^26 pixels.
pub fn read_header(path: &Path) -> Result<Header, DatasetError> {
    let unusable = unusable(path);
    let reader = ImageReader::open(path)
        .and_then(|reader| reader.with_guessed_format())
        .map_err(DatasetError::io("read", path))?;
    let format = reader.format().ok_or_else(|| unusable("its kind is not known".into()))?;
    let header = match format {
        ImageFormat::Tiff => tiff_header(path).map_err(|e| unusable(e.to_string()))?,
        _ => {
            let decoder = reader.into_decoder().map_err(|e| unusable(e.to_string()))?;
            let color = decoder.color_type();
            let deep = color.bytes_per_pixel() > color.channel_count();
            let numbers = if deep { Numbers::Deep } else { Numbers::Shallow };
            Header { size_px: decoder.dimensions(), numbers, format, is_real_grey: false }
        }
    };
    let (width_px, height_px) = header.size_px;
    if u64::from(width_px) * u64::from(height_px) > MOST_PIXELS {
        let problem = format!(
            "the picture is {width_px}x{height_px} px, more than the {MOST_PIXELS} pixels that a picture may have: \
             shrink it or cut it"
        );
        return Err(DatasetError::Unusable { path: path.into(), problem });
    }
    Ok(header)
}

/// Reads an image's numbers; colour becomes grey by Rec. 709, transparency and the orientation tag are passed over.
///
/// # Errors
/// Names an image that is damaged or cut short.
pub fn read_numbers(path: &Path, header: &Header) -> Result<RawImage, DatasetError> {
    let unusable = unusable(path);
    if header.is_real_grey {
        return real_tiff(path, header).map_err(unusable);
    }
    let bytes = std::fs::read(path).map_err(DatasetError::io("read", path))?;
    if header.format == ImageFormat::Jpeg && !jpeg_is_whole(&bytes) {
        return Err(unusable("the file is cut short".into()));
    }
    let image = ImageReader::with_format(Cursor::new(bytes), header.format).decode();
    Ok(match image.map_err(|e| unusable(e.to_string()))? {
        deep @ (DynamicImage::ImageLuma16(_)
        | DynamicImage::ImageLumaA16(_)
        | DynamicImage::ImageRgb16(_)
        | DynamicImage::ImageRgba16(_)) => RawImage::Deep(deep.into_luma16()),
        real @ (DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_)) => RawImage::Real(grey(&real)),
        shallow => RawImage::Shallow(shallow.into_luma8()),
    })
}

fn unusable(path: &Path) -> impl Fn(String) -> DatasetError {
    move |reason| DatasetError::Unusable {
        path: path.into(),
        problem: format!("the picture cannot be read ({reason}): remove it or put a whole one in its place"),
    }
}

fn grey(image: &DynamicImage) -> ImageBuffer<Luma<f32>, Vec<f32>> {
    let colours = image.to_rgb32f();
    let grey = |p: &image::Rgb<f32>| 0.2126 * p.0[0] + 0.7152 * p.0[1] + 0.0722 * p.0[2];
    let values = colours.pixels().map(grey).collect();
    ImageBuffer::from_raw(colours.width(), colours.height(), values).expect("one value a pixel")
}

fn tiff_header(path: &Path) -> tiff::TiffResult<Header> {
    const WHOLE: u16 = 1;
    let mut decoder = Decoder::new(BufReader::new(File::open(path)?))?;
    let format = decoder.find_tag_unsigned_vec::<u16>(Tag::SampleFormat)?;
    let whole = format.is_none_or(|f| f.iter().all(|f| *f == WHOLE));
    let color = decoder.colortype()?;
    let numbers = match color.bit_depth() {
        bits if !whole || bits > 16 => Numbers::Real,
        bits if bits > 8 => Numbers::Deep,
        _ => Numbers::Shallow,
    };
    let is_real_grey = numbers == Numbers::Real && matches!(color, ColorType::Gray(_));
    Ok(Header { size_px: decoder.dimensions()?, numbers, format: ImageFormat::Tiff, is_real_grey })
}

fn real_tiff(path: &Path, header: &Header) -> Result<RawImage, String> {
    let file = File::open(path).map_err(|e| e.to_string())?;
    let mut decoder = Decoder::new(BufReader::new(file)).map_err(|e| e.to_string())?;
    let values: Vec<f32> = match decoder.read_image().map_err(|e| e.to_string())? {
        DecodingResult::F32(values) => values,
        DecodingResult::F64(values) => values.into_iter().map(|v| v as f32).collect(),
        DecodingResult::U32(values) => values.into_iter().map(|v| v as f32).collect(),
        DecodingResult::I8(values) => values.into_iter().map(f32::from).collect(),
        DecodingResult::I16(values) => values.into_iter().map(f32::from).collect(),
        DecodingResult::I32(values) => values.into_iter().map(|v| v as f32).collect(),
        _ => return Err("numbers of this kind are not read; save it with 32-bit floats".into()),
    };
    let (width_px, height_px) = header.size_px;
    let image = ImageBuffer::from_raw(width_px, height_px, values);
    image.map(RawImage::Real).ok_or_else(|| "numbers are missing".into())
}

/// Whether a JPEG goes on to its end marker: decoders fill what is missing with grey and say nothing.
fn jpeg_is_whole(bytes: &[u8]) -> bool {
    const START_OF_SCAN: u8 = 0xda;
    const END: u8 = 0xd9;
    let mut at = 2;
    while let Some([0xff, marker]) = bytes.get(at..at + 2) {
        match *marker {
            END => return true,
            0xff => at += 1,
            0x01 | 0xd0..=0xd8 => at += 2,
            marker => {
                let Some([high, low]) = bytes.get(at + 2..at + 4) else { return false };
                at += 2 + usize::from(u16::from_be_bytes([*high, *low]));
                if marker == START_OF_SCAN {
                    at = next_marker(bytes, at);
                }
            }
        }
    }
    false
}

/// Where the next marker is after compressed data, in which 0xff is followed by 0 or a restart marker.
fn next_marker(bytes: &[u8], from: usize) -> usize {
    let is_marker = |w: &[u8]| w[0] == 0xff && !matches!(w[1], 0x00 | 0xd0..=0xd7);
    let rest = bytes.get(from..).unwrap_or(&[]);
    rest.windows(2).position(is_marker).map_or(bytes.len(), |offset| from + offset)
}
