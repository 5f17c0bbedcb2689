//! Damaged files that once broke a reader.

use opnav::dataset::truth::read_flow;
use opnav::dataset::{CameraSource, ImageSequence};
use opnav::scene::{Raster, RasterFile};

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// The size overflowed when it was multiplied.
#[test]
fn a_flow_field_of_impossible_size() {
    let dir = folder();
    let path = dir.path().join("7.flo");
    let size = [0xff; 8];
    std::fs::write(&path, [&b"PIEH"[..], &size].concat()).expect("a file");
    let error = read_flow(&path).expect_err("refused").to_string();
    assert!(error.ends_with("7.flo: it has 12 bytes, 147573952520956936212 expected: make it anew"), "{error}");
}

/// The count of a tag was believed, and 27 GB asked for.
#[test]
fn a_geotiff_with_an_endless_tag() {
    let dir = folder();
    let mut bytes = super::scenarios::geotiff_bytes();
    let tag = 33_550_u16.to_le_bytes();
    let at = bytes.windows(4).position(|w| w[..2] == tag && w[2..] == [12, 0]).expect("the tag of the scale");
    bytes[at + 4..at + 8].copy_from_slice(&u32::MAX.to_le_bytes());
    std::fs::write(dir.path().join("map.tif"), bytes).expect("a file");
    let error = Raster::read(&RasterFile::from_path("map.tif"), dir.path()).expect_err("refused").to_string();
    assert!(error.contains("map.tif"), "{error}");
}

/// The folder was blamed.
#[test]
fn a_list_without_pictures() {
    let dir = folder();
    image::GrayImage::new(4, 4).save(dir.path().join("x.png")).expect("a picture");
    std::fs::write(dir.path().join("data.csv"), "#timestamp [ns],filename\n").expect("a file");
    let error = ImageSequence::open(dir.path(), &CameraSource::HorizontalFov(1.0)).expect_err("refused").to_string();
    assert!(
        error.contains("data.csv: it lists no pictures: write a line 'timestamp [ns],filename' for each"),
        "{error}"
    );
}
