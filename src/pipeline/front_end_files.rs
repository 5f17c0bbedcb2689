//! The files of a result that the front end fills: tables, chains of attitudes, images to look at.

use super::error::PipelineError;
use crate::dataset::{DatasetError, ImageSequence, StampedPose, write_atomically, write_tum};
use crate::observations::{TrackObservation, attitude_chains, write_relative_rotations, write_tracks};
use crate::report::{contact_sheet, draw_tracks};
use crate::vision::FrontEnd;
use image::{RgbImage, imageops};
use rayon::prelude::*;
use serde::Serialize;
use std::io::Cursor;
use std::path::Path;

/// An unbroken chain of attitudes, as the summary names it.
#[derive(Debug, Clone, Serialize)]
pub(super) struct ChainFile {
    file: String,
    t_ns_from: i64,
    t_ns_to: i64,
    poses: usize,
}

/// Writes `tracks.csv`, `relative_rotations.csv`, and the chains of attitudes, see [`attitude_chains`]: the first as
/// `attitude_chain.tum`, those after a break that no pair bridges as `attitude_chain_2.tum` and so on.
pub(super) fn write_front_end(out: &Path, front_end: &FrontEnd) -> Result<Vec<ChainFile>, PipelineError> {
    write_tracks(&out.join("tracks.csv"), &front_end.observations)?;
    write_relative_rotations(&out.join("relative_rotations.csv"), &front_end.rotations)?;
    remove_earlier(out, is_chain)?;
    let times_ns: Vec<i64> = front_end.frames.iter().map(|f| f.t_ns).collect();
    let chains = attitude_chains(&times_ns, &front_end.rotations);
    let named = chains.iter().enumerate().map(|(number, chain)| {
        let file = if number == 0 { "attitude_chain.tum".into() } else { format!("attitude_chain_{}.tum", number + 1) };
        write_tum(&out.join(&file), chain)?;
        Ok(chain_file(file, chain))
    });
    named.collect()
}

fn chain_file(file: String, chain: &[StampedPose]) -> ChainFile {
    let time = |pose: Option<&StampedPose>| pose.map_or(0, |p| p.t_ns);
    ChainFile { file, t_ns_from: time(chain.first()), t_ns_to: time(chain.last()), poses: chain.len() }
}

/// Removes what an earlier job left in the same folder under names that this one may not write anew.
fn remove_earlier(folder: &Path, is_ours: impl Fn(&str) -> bool) -> Result<(), PipelineError> {
    if !folder.is_dir() {
        return Ok(());
    }
    for entry in std::fs::read_dir(folder).map_err(DatasetError::io("list", folder))?.flatten() {
        if is_ours(&entry.file_name().to_string_lossy()) {
            std::fs::remove_file(entry.path()).map_err(DatasetError::io("remove", entry.path()))?;
        }
    }
    Ok(())
}

fn is_chain(name: &str) -> bool {
    name.starts_with("attitude_chain") && name.ends_with(".tum")
}

fn is_overlay(name: &str) -> bool {
    name.strip_suffix(".png").is_some_and(|t_ns| t_ns.parse::<i64>().is_ok())
}

/// Number of frames that get an overlay of their own.
const OVERLAYS: usize = 6;
/// Number of frames on the contact sheet, its columns, and the width of each in px.
const SHEET: (usize, usize, u32) = (24, 6, 320);

/// Draws the tracks into frames spread over the sequence: a few in full size (`overlays/<t_ns>.png`), more of them small on
/// one sheet (`contact_sheet.png`).
pub(super) fn write_images(out: &Path, sequence: &ImageSequence, front_end: &FrontEnd) -> Result<(), PipelineError> {
    let usable: Vec<usize> = (0..front_end.frames.len()).filter(|k| front_end.frames[*k].problem.is_none()).collect();
    remove_earlier(&out.join("overlays"), is_overlay)?;
    let whole = spread(&usable[1.min(usable.len())..], OVERLAYS);
    whole.par_iter().try_for_each(|k| {
        let name = format!("overlays/{}.png", front_end.frames[*k].t_ns);
        write_rgb_png(&out.join(name), &overlay(sequence, front_end, *k)?)
    })?;
    let (count, columns, width_px) = SHEET;
    let small = |k: &usize| {
        let whole = overlay(sequence, front_end, *k)?;
        let height_px = (u64::from(whole.height()) * u64::from(width_px) / u64::from(whole.width())).max(1) as u32;
        Ok(imageops::thumbnail(&whole, width_px, height_px.min(4 * width_px)))
    };
    let tiles: Vec<RgbImage> = spread(&usable, count).par_iter().map(small).collect::<Result<_, PipelineError>>()?;
    write_rgb_png(&out.join("contact_sheet.png"), &contact_sheet(&tiles, columns, width_px))
}

/// At most `count` of the items, spread evenly, the first and the last among them.
fn spread(items: &[usize], count: usize) -> Vec<usize> {
    let count = count.min(items.len());
    (0..count).map(|k| items[k * (items.len() - 1) / (count - 1).max(1)]).collect()
}

fn overlay(sequence: &ImageSequence, front_end: &FrontEnd, k: usize) -> Result<RgbImage, PipelineError> {
    let report = &front_end.frames[k];
    let now = observations_at(front_end, report.t_ns);
    let first = front_end.observations.partition_point(|o| o.t_ns < report.t_ns);
    let before =
        first.checked_sub(1).map_or(&[][..], |last| observations_at(front_end, front_end.observations[last].t_ns));
    let before_px = before.iter().map(|o| (o.track_id, o.pixel_px)).collect();
    let designated = now.iter().find(|o| o.track_id == TrackObservation::DESIGNATED);
    Ok(draw_tracks(&sequence.load(&sequence.frames[report.index])?, now, &before_px, designated))
}

fn observations_at(front_end: &FrontEnd, t_ns: i64) -> &[TrackObservation] {
    let first = front_end.observations.partition_point(|o| o.t_ns < t_ns);
    let end = front_end.observations.partition_point(|o| o.t_ns <= t_ns);
    &front_end.observations[first..end]
}

fn write_rgb_png(path: &Path, image: &RgbImage) -> Result<(), PipelineError> {
    let mut bytes = Cursor::new(Vec::new());
    image
        .write_to(&mut bytes, image::ImageFormat::Png)
        .map_err(|e| DatasetError::Unusable { path: path.into(), problem: e.to_string() })?;
    Ok(write_atomically(path, |w| w.write_all(bytes.get_ref()))?)
}
