//! Rasters from TIFF files, with their place on the map if they are GeoTIFF files.

use super::file_raster::{FileGeoreference, FileRaster, MOST_POSTS, too_many};
use super::geokeys::GeoKeys;
use std::io::Cursor;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

type Tiff<'a> = Decoder<Cursor<&'a [u8]>>;

/// Reads the first image of a TIFF file. Its map is only looked at, and complained about, if it is `wanted`.
///
/// Source: OGC 19-008r4, "GeoTIFF standard 1.1", 2019; no-data from GDAL's tag 42113.
pub fn read(bytes: &[u8], wanted: bool) -> Result<FileRaster, String> {
    let unreadable = |e: tiff::TiffError| format!("the TIFF file cannot be read: {e}; is it cut short?");
    let mut tiff = Decoder::new(Cursor::new(bytes)).map_err(unreadable)?.with_limits(limits());
    let (columns, rows) = tiff.dimensions().map_err(unreadable)?;
    let color = tiff.colortype().map_err(unreadable)?;
    if color.num_samples() != 1 {
        return Err(format!("it has {} values a pixel: use a file with one band", color.num_samples()));
    }
    if u64::from(columns) * u64::from(rows) > MOST_POSTS as u64 {
        return Err(too_many([columns as usize, rows as usize]));
    }
    let mut values = as_f64(tiff.read_image().map_err(unreadable)?);
    if let Some(no_data) = no_data(&mut tiff)? {
        // Some writers round the tag's text to fewer digits than the samples have.
        let same = |v: f64| v == no_data || (v as f32) == (no_data as f32);
        values.iter_mut().filter(|v| same(**v)).for_each(|v| *v = f64::NAN);
    }
    let georeference = if wanted { georeference(&mut tiff)? } else { None };
    Ok(FileRaster { columns: columns as usize, values, georeference })
}

/// Room for the largest raster, and for no more: a damaged file may ask for any amount of memory.
fn limits() -> Limits {
    const MOST_BYTES: usize = size_of::<f64>() * MOST_POSTS;
    let mut limits = Limits::default();
    (limits.decoding_buffer_size, limits.intermediate_buffer_size) = (MOST_BYTES, MOST_BYTES);
    limits.ifd_value_size = MOST_BYTES / 16;
    limits
}

fn as_f64(image: DecodingResult) -> Vec<f64> {
    match image {
        DecodingResult::U8(v) => v.into_iter().map(f64::from).collect(),
        DecodingResult::I8(v) => v.into_iter().map(f64::from).collect(),
        DecodingResult::U16(v) => v.into_iter().map(f64::from).collect(),
        DecodingResult::I16(v) => v.into_iter().map(f64::from).collect(),
        DecodingResult::U32(v) => v.into_iter().map(f64::from).collect(),
        DecodingResult::I32(v) => v.into_iter().map(f64::from).collect(),
        DecodingResult::U64(v) => v.into_iter().map(|v| v as f64).collect(),
        DecodingResult::I64(v) => v.into_iter().map(|v| v as f64).collect(),
        DecodingResult::F16(v) => v.into_iter().map(|v| v.to_f64()).collect(),
        DecodingResult::F32(v) => v.into_iter().map(f64::from).collect(),
        DecodingResult::F64(v) => v,
    }
}

fn no_data(tiff: &mut Tiff) -> Result<Option<f64>, String> {
    let Some(text) = ascii(tiff, Tag::GdalNodata) else { return Ok(None) };
    let text = text.trim_matches(|c: char| c.is_whitespace() || c == '\0');
    text.parse().map(Some).map_err(|_| format!("its no-data value '{text}' (tag 42113) is not a number: correct it"))
}

fn ascii(tiff: &mut Tiff, tag: Tag) -> Option<String> {
    tiff.find_tag(tag).ok().flatten().and_then(|value| value.into_string().ok())
}

fn numbers(tiff: &mut Tiff, tag: Tag) -> Option<Vec<f64>> {
    tiff.find_tag(tag).ok().flatten().and_then(|value| value.into_f64_vec().ok())
}

/// Where the posts lie; `None` for a plain TIFF file.
fn georeference(tiff: &mut Tiff) -> Result<Option<FileGeoreference>, String> {
    let Some(directory) = tiff.find_tag_unsigned_vec::<u16>(Tag::GeoKeyDirectoryTag).ok().flatten() else {
        return Ok(None);
    };
    let keys = GeoKeys::new(&directory, numbers(tiff, Tag::GeoDoubleParamsTag).unwrap_or_default());
    let (corner, step) = placement(tiff)?;
    // The tie point is the corner of a pixel that is an area, and the centre of one that is a point.
    let half = if keys.is_pixel_a_point() { 0.0 } else { 0.5 };
    let first = [corner[0] + half * step[0], corner[1] - half * step[1]];
    keys.georeference(first, step).map(Some)
}

/// Map coordinates of raster place (0, 0), and the steps eastward per column and southward per row.
fn placement(tiff: &mut Tiff) -> Result<([f64; 2], [f64; 2]), String> {
    if let Some(m) = numbers(tiff, Tag::ModelTransformationTag).filter(|m| m.len() == 16) {
        if m[1] != 0.0 || m[4] != 0.0 {
            return Err("its rows do not run along the map's axes: resample it north up (gdalwarp does)".into());
        }
        return checked([m[3], m[7]], [m[0], -m[5]]);
    }
    let scale = numbers(tiff, Tag::ModelPixelScaleTag).filter(|s| s.len() >= 2);
    let tie = numbers(tiff, Tag::ModelTiepointTag).filter(|t| t.len() >= 6);
    let (Some(scale), Some(tie)) = (scale, tie) else {
        return Err(
            "it has geographic keys but no pixel scale and tie point: state file.geometry in the scenario".into()
        );
    };
    checked([tie[3] - tie[0] * scale[0], tie[4] + tie[1] * scale[1]], [scale[0], scale[1]])
}

fn checked(corner: [f64; 2], step: [f64; 2]) -> Result<([f64; 2], [f64; 2]), String> {
    let usable = corner.iter().chain(&step).all(|v| v.is_finite()) && step[0] != 0.0 && step[1] != 0.0;
    if usable { Ok((corner, step)) } else { Err("its pixel scale is 0 or not a number: state file.geometry".into()) }
}
