//! Faults of files and settings, by their messages.

use super::geotiff::{Geo, tiled_tiff, write_tiff};
use super::pds::{OFFSETS, label};
use super::{COLUMNS, ROWS, fault, folder, heights, metres_per_px, read};
use opnav::scene::{ElevationConfig, RasterFile, RasterGeometry, RawLayout, SampleKind};
use tiff::encoder::colortype;

#[test]
fn faults_name_the_file_and_the_cure() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    let geotiff = |geo: Geo| {
        write_tiff::<colortype::Gray32Float>(&path("a.tif"), Some(&geo), &heights());
        fault(&folder, RasterFile::from_path("a.tif"))
    };
    let says = |message: String, cure: &str| assert!(message.contains(cure), "{message}");
    says(geotiff(Geo { shorts: vec![[1024, 3]], ..Geo::projected() }), "model type 3");
    says(geotiff(Geo { shorts: vec![[1025, 1]], ..Geo::projected() }), "reference system is unknown");
    says(geotiff(Geo { shorts: vec![[1024, 1], [3076, 9002]], ..Geo::projected() }), "not in metres");
    says(geotiff(Geo { shorts: vec![[1024, 2], [2054, 9101]], ..Geo::projected() }), "not in degrees");
    says(geotiff(Geo { tie: None, ..Geo::projected() }), "tie point");
    says(geotiff(Geo { scale: Some([0.0, 1.0, 0.0]), ..Geo::projected() }), "pixel scale is 0");
    says(geotiff(Geo { no_data: Some("none"), ..Geo::projected() }), "tag 42113");
    write_tiff::<colortype::Gray32Float>(&path("a.tif"), Some(&Geo::projected()), &vec![f32::NAN; COLUMNS * ROWS]);
    says(fault(&folder, RasterFile::from_path("a.tif")), "all are no-data");
    write_tiff::<colortype::Gray32Float>(&path("a.tif"), Some(&Geo::projected()), &heights());
    let whole = std::fs::read(path("a.tif")).unwrap();
    for share in 1..8 {
        std::fs::write(path("a.tif"), &whole[..whole.len() * share / 8]).unwrap();
        says(fault(&folder, RasterFile::from_path("a.tif")), "cut short");
    }
    let colours = image::RgbImage::new(9, 9);
    colours.save(path("rgb.tif")).unwrap();
    says(fault(&folder, metres_per_px("rgb.tif", 1.0)), "one band");
    std::fs::write(path("huge.tif"), tiled_tiff(2_000_000_000)).unwrap();
    says(fault(&folder, metres_per_px("huge.tif", 1.0)), "inconsistent sizes");
    std::fs::write(path("a.png"), b"\x89PNG\r\n\x1a\nnothing").unwrap();
    says(fault(&folder, metres_per_px("a.png", 1.0)), "cut short");
    says(fault(&folder, RasterFile::from_path("none.tif")), "could not read the raster");
    std::fs::write(path("empty.img"), b"").unwrap();
    says(fault(&folder, RasterFile::from_path("empty.img")), "no TIFF, PNG, JPEG or PDS");
    for (image, cure) in [
        ("SAMPLE_BITS = 12", "12 bits"),
        ("SAMPLE_TYPE = VAX_REAL\r\nSAMPLE_BITS = 32", "VAX_REAL"),
        ("SAMPLE_BITS = 8\r\nBANDS = 3", "3 bands"),
    ] {
        std::fs::write(path("a.lbl"), label("\"a.img\"", image, OFFSETS)).unwrap();
        says(fault(&folder, RasterFile::from_path("a.lbl")), cure);
    }
    std::fs::write(path("a.lbl"), label("\"a.img\"", "SAMPLE_BITS = 8", "")).unwrap();
    std::fs::write(path("a.img"), vec![0; COLUMNS * ROWS]).unwrap();
    says(fault(&folder, RasterFile::from_path("a.lbl")), "SAMPLE_PROJECTION_OFFSET");
    std::fs::write(path("a.lbl"), label("\"a.img\"", "SAMPLE_BITS = 8\r\nLINE_SUFFIX_BYTES = 1e300", OFFSETS)).unwrap();
    says(read(&folder, RasterFile::from_path("a.lbl")).unwrap_err().to_string(), "cut short");
}

#[test]
fn settings_outside_their_range_are_named() {
    let refused = |change: &dyn Fn(&mut ElevationConfig)| {
        let mut config = ElevationConfig::from_path("a.tif");
        change(&mut config);
        config.validate().expect_err("refused").to_string()
    };
    assert!(refused(&|c| c.file.scale = 0.0).starts_with("file.scale is 0"));
    assert!(refused(&|c| c.file.offset = f64::NAN).starts_with("file.offset is NaN"));
    assert!(refused(&|c| c.file.radius_m = Some(-1.0)).starts_with("file.radius_m is -1"));
    let flat = RasterGeometry::Metres { metres_per_px: 0.0, first_x_m: 0.0, first_y_m: 0.0 };
    assert!(refused(&|c| c.file.geometry = flat).starts_with("file.geometry.metres.metres_per_px is 0"));
    let none = RawLayout { columns: 0, rows: 9, sample: SampleKind::U8, skip_bytes: 0 };
    assert!(refused(&|c| c.file.layout = Some(none)).starts_with("file.layout.columns is 0"));
    assert_eq!(ElevationConfig::from_path("a.tif").validate().map_err(|e| e.to_string()), Ok(()));
}
