//! Rasters from images of the Planetary Data System, version 3, with an attached or a detached label.

use super::file_raster::FileRaster;
use super::pds_label::Label;
use super::pds_map::georeference;
use super::raw_samples::{RawLayout, SampleKind};
use crate::scene::error::SceneError;
use std::path::{Path, PathBuf};

/// Where a label says that its image begins.
#[derive(Debug, PartialEq)]
struct Pointer {
    file: Option<String>,
    byte: usize,
}

/// Reads an image from the bytes of its label, of its labelled file, or of an image with its label beside it. Its map is
/// only looked at, and complained about, if it is `wanted`.
///
/// Source: PDS Standards Reference 3.8, appendix A, objects IMAGE and IMAGE_MAP_PROJECTION.
pub fn read(path: &Path, bytes: Vec<u8>, wanted: bool) -> Result<FileRaster, SceneError> {
    let (label_path, text) = label_text(path, &bytes)?;
    let unusable = |problem: String| SceneError::Unusable { path: label_path.clone(), problem };
    let label = Label::parse(&text);
    let pointer = pointer(&label).map_err(unusable)?;
    let layout = layout(&label, pointer.byte).map_err(unusable)?;
    let values = match &pointer.file {
        None => values(&label, &layout, &bytes).map_err(unusable)?,
        Some(name) => {
            let image_path = beside(&label_path, name);
            let bytes = std::fs::read(&image_path).map_err(|error| {
                let image = image_path.display();
                unusable(format!("its image {image} cannot be read ({error}): put it beside the label"))
            })?;
            values(&label, &layout, &bytes)
                .map_err(|problem| SceneError::Unusable { path: image_path.clone(), problem })?
        }
    };
    let georeference = if wanted { georeference(&label).map_err(unusable)? } else { None };
    Ok(FileRaster { columns: layout.columns, values, georeference })
}

/// The label in a file's first bytes, or in the file beside it that ends in `.lbl`.
fn label_text(path: &Path, bytes: &[u8]) -> Result<(PathBuf, String), SceneError> {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(1 << 16)]);
    if head.contains("PDS_VERSION_ID") || head.contains("^IMAGE") {
        return Ok((path.into(), head.into_owned()));
    }
    for extension in ["lbl", "LBL"] {
        let label_path = path.with_extension(extension);
        if let Ok(text) = std::fs::read(&label_path) {
            return Ok((label_path, String::from_utf8_lossy(&text).into_owned()));
        }
    }
    Err(SceneError::Unusable {
        path: path.into(),
        problem: "it is no TIFF, PNG, JPEG or PDS file and has no label (.lbl) beside it: for bare samples, state \
                  file.layout in the scenario"
            .into(),
    })
}

/// A file beside the label, whatever the case of its name.
fn beside(label_path: &Path, name: &str) -> PathBuf {
    let as_named = label_path.with_file_name(name);
    let lower = label_path.with_file_name(name.to_lowercase());
    if !as_named.exists() && lower.exists() { lower } else { as_named }
}

/// `^IMAGE = record`, `= n <BYTES>`, `= "FILE"`, `= ("FILE", record)` or `= ("FILE", n <BYTES>)`, counted from 1.
fn pointer(label: &Label) -> Result<Pointer, String> {
    let text = label.text("^IMAGE").ok_or("its label has no ^IMAGE: it describes no image, use another file")?;
    let mut pointer = Pointer { file: None, byte: 0 };
    for part in text.trim_matches(['(', ')']).split(',') {
        let (number, unit) = part.split_once('<').unwrap_or((part, ""));
        match number.trim().parse::<usize>() {
            Ok(first) if unit.starts_with("BYTES") => pointer.byte = first.saturating_sub(1),
            Ok(first) => {
                let record_bytes = label.number("RECORD_BYTES").ok_or("its label lacks RECORD_BYTES: correct it")?;
                pointer.byte = first.saturating_sub(1).saturating_mul(record_bytes.max(0.0) as usize);
            }
            Err(_) => pointer.file = Some(part.trim().trim_matches('"').into()),
        }
    }
    Ok(pointer)
}

fn layout(label: &Label, skip_bytes: usize) -> Result<RawLayout, String> {
    let count = |key: &str| {
        let number = label.number(&format!("IMAGE.{key}")).ok_or(format!("its label lacks {key}: correct it"))?;
        if number >= 2.0 { Ok(number as usize) } else { Err(format!("{key} is {number} in its label: 2 are needed")) }
    };
    let bands = label.number("IMAGE.BANDS").unwrap_or(1.0);
    if bands != 1.0 {
        return Err(format!("it has {bands} bands: use an image with one"));
    }
    let layout =
        RawLayout { columns: count("LINE_SAMPLES")?, rows: count("LINES")?, sample: sample(label)?, skip_bytes };
    layout.validate().map_err(|e| e.to_string())?;
    layout.check_size()?;
    Ok(layout)
}

fn sample(label: &Label) -> Result<SampleKind, String> {
    use SampleKind::*;
    let bits = label.number("IMAGE.SAMPLE_BITS").unwrap_or(8.0);
    let name = label.text("IMAGE.SAMPLE_TYPE").unwrap_or("MSB_UNSIGNED_INTEGER").to_uppercase();
    let little = ["LSB_", "PC_", "VAX_"].iter().any(|start| name.starts_with(start));
    let either = |big: SampleKind, small: SampleKind| Ok(if little { small } else { big });
    match (bits as u32, name.contains("REAL"), name.contains("UNSIGNED")) {
        _ if name.starts_with("VAX_REAL") || name.starts_with("IBM") => {
            Err(format!("its sample type {name} is not supported: convert it to IEEE floats"))
        }
        (32, true, _) => either(F32Big, F32Little),
        (8, false, true) => Ok(U8),
        (8, false, false) => Ok(I8),
        (16, false, true) => either(U16Big, U16Little),
        (16, false, false) => either(I16Big, I16Little),
        (32, false, true) => either(U32Big, U32Little),
        (32, false, false) => either(I32Big, I32Little),
        _ => Err(format!("its samples, {name} of {bits} bits, are not supported: convert them")),
    }
}

/// Values with the label's scaling; NaN where the label says that nothing is known.
fn values(label: &Label, layout: &RawLayout, bytes: &[u8]) -> Result<Vec<f64>, String> {
    let margin = |key: &str| label.number(&format!("IMAGE.{key}")).unwrap_or(0.0).max(0.0) as usize;
    let mut values = layout.values(bytes, [margin("LINE_PREFIX_BYTES"), margin("LINE_SUFFIX_BYTES")])?;
    let unknown: Vec<f64> = ["MISSING_CONSTANT", "MISSING", "INVALID_CONSTANT", "NULL"]
        .iter()
        .filter_map(|key| label.number(&format!("IMAGE.{key}")))
        .collect();
    let scale = label.number("IMAGE.SCALING_FACTOR").unwrap_or(1.0);
    let offset = label.number("IMAGE.OFFSET").unwrap_or(0.0);
    values.iter_mut().for_each(|v| *v = if unknown.contains(v) { f64::NAN } else { *v * scale + offset });
    Ok(values)
}
