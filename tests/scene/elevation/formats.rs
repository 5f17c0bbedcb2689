//! Files of elevation models: every format against heights that are known, and every fault against its message.

mod faults;
mod geotiff;
mod images;
mod mars;
mod pds;

use opnav::scene::{Raster, RasterFile, RasterGeometry, SceneError};
use tempfile::TempDir;

const COLUMNS: usize = 37;
const ROWS: usize = 21;

fn height(column: usize, row: usize) -> f32 {
    100.0 * column as f32 - 7.0 * row as f32 + ((column * row) % 5) as f32 - 800.0
}

fn heights() -> Vec<f32> {
    (0..ROWS * COLUMNS).map(|i| height(i % COLUMNS, i / COLUMNS)).collect()
}

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn read(folder: &TempDir, file: RasterFile) -> Result<Raster, SceneError> {
    Raster::read(&file, folder.path())
}

/// What a reader says of a file, which has to name it.
fn fault(folder: &TempDir, file: RasterFile) -> String {
    let name = file.path.display().to_string();
    let message = read(folder, file).expect_err("refused").to_string();
    assert!(message.contains(&name), "the file is not named: {message}");
    message
}

fn metres_per_px(path: &str, metres_per_px: f64) -> RasterFile {
    let geometry = RasterGeometry::Metres { metres_per_px, first_x_m: 0.0, first_y_m: 0.0 };
    RasterFile { geometry, ..RasterFile::from_path(path) }
}
