//! Result folders to one page.

use super::doctor::diagnose;
use super::error::PipelineError;
use crate::dataset::DatasetError;
use crate::report::{Page, PageImage, Section, environment_table, image_png, result_section, write_report};
use std::path::{Path, PathBuf};

/// Writes one self-contained HTML page about evaluated result folders.
///
/// # Errors
/// A result that was not evaluated, or a file that cannot be read or written.
pub fn write_page(results: &[PathBuf], out: &Path) -> Result<(), PipelineError> {
    let mut sections = Vec::new();
    for result in results {
        let mut section = result_section(result, overlay_images(result)?)?;
        let name = result.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        if !section.heading.to_lowercase().contains(&name.to_lowercase()) {
            section.heading = format!("{} ({name})", section.heading);
        }
        sections.push(section);
    }
    sections.push(environment());
    let page = Page {
        title: "opnav: navigation by images".into(),
        lead: "What was estimated from the images, held against the truth that the estimators never saw.".into(),
        sections,
    };
    Ok(write_report(&page, out)?)
}

/// Width of the images on the page, px.
const IMAGE_WIDTH_PX: u32 = 480;

/// The images of `overlays/` in order of time.
fn overlay_images(result: &Path) -> Result<Vec<PageImage>, PipelineError> {
    let folder = result.join("overlays");
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let mut files: Vec<(i64, PathBuf)> = std::fs::read_dir(&folder)
        .map_err(DatasetError::io("list", &folder))?
        .filter_map(|entry| {
            let path = entry.ok()?.path();
            let t_ns = path.file_stem()?.to_str()?.parse().ok()?;
            Some((t_ns, path))
        })
        .collect();
    files.sort();
    let image = |(t_ns, path): &(i64, PathBuf)| {
        let unusable = |e: image::ImageError| DatasetError::Unusable { path: path.into(), problem: e.to_string() };
        let png = image_png(&image::open(path).map_err(unusable)?.to_rgb8(), IMAGE_WIDTH_PX)?;
        Ok::<_, PipelineError>(PageImage { caption: format!("t = {:.1} s", *t_ns as f64 * 1e-9), png })
    };
    files.iter().map(image).collect()
}

fn environment() -> Section {
    let diagnosis = diagnose();
    let entries = [
        ("opnav", diagnosis.opnav_version.to_string()),
        ("OpenCV", diagnosis.opencv_version.unwrap_or_else(|| "none".into())),
        ("graphics adapter", diagnosis.default_adapter.unwrap_or_else(|| "none".into())),
        ("processor threads", diagnosis.threads.to_string()),
    ]
    .map(|(name, value)| (name.to_string(), value));
    Section { heading: "Environment".into(), blocks: vec![environment_table(&entries)] }
}
