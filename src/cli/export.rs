//! `opnav export`: a data set in the formats of other tools.

use super::progress::Terminal;
use clap::ValueEnum;
use opnav::pipeline::{ExportFormat, ExportRequest, PipelineError, export};
use std::path::PathBuf;

/// Write the true poses, cameras and landmarks of a data set in another tool's format.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A data set with its truth.
    folder: PathBuf,
    /// The format.
    #[arg(long, value_enum, value_name = "FORMAT")]
    to: FormatName,
    /// Folder of the files; they name images relative to the data set.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum FormatName {
    /// COLMAP's text model: cameras.txt, images.txt, points3D.txt.
    Colmap,
    /// The TUM RGB-D benchmark's lists: groundtruth.txt and rgb.txt for each camera.
    Tum,
}

/// Exports and says where.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let format = match arguments.to {
        FormatName::Colmap => ExportFormat::Colmap,
        FormatName::Tum => ExportFormat::Tum,
    };
    let request = ExportRequest { folder: arguments.folder.clone(), out: arguments.out.clone(), format };
    let count = export(&request)?;
    terminal.say(&format!("{count} pictures in {}", arguments.out.display()));
    Ok(())
}
