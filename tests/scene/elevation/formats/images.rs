//! Pictures and bare samples, which have their scale from the scenario.

use super::geotiff::write_tiff;
use super::{COLUMNS, ROWS, fault, folder, heights, metres_per_px, read};
use opnav::scene::{Georeference, RasterFile, RawLayout, SampleKind};
use tiff::encoder::colortype;

#[test]
fn images_have_a_scale_from_the_scenario() {
    let folder = folder();
    let grey: Vec<u16> = heights().iter().map(|h| (10.0 * (h + 2000.0)) as u16).collect();
    image::ImageBuffer::<image::Luma<u16>, _>::from_raw(COLUMNS as u32, ROWS as u32, grey)
        .unwrap()
        .save(folder.path().join("a.png"))
        .unwrap();
    let file = RasterFile { scale: 0.1, offset: -2000.0, ..metres_per_px("a.png", 2.5) };
    let raster = read(&folder, file).unwrap();
    assert!(raster.values.iter().zip(heights()).all(|(a, b)| (a - b).abs() < 1e-3));
    assert_eq!(raster.georeference, Georeference::Metres { first_m: [0.0, 0.0], step_m: [2.5, 2.5] });
    write_tiff::<colortype::Gray32Float>(&folder.path().join("a.tif"), None, &heights());
    assert_eq!(read(&folder, metres_per_px("a.tif", 2.5)).unwrap().values, heights());
    let flat = image::GrayImage::from_pixel(24, 16, image::Luma([77]));
    flat.save(folder.path().join("a.jpg")).unwrap();
    assert!(read(&folder, metres_per_px("a.jpg", 1.0)).unwrap().values.iter().all(|v| (v - 77.0).abs() <= 1.0));
    for name in ["a.png", "a.tif"] {
        let message = fault(&folder, RasterFile::from_path(name));
        assert!(message.contains("file.geometry.metres"), "{message}");
    }
}

#[test]
fn bare_samples_have_their_layout_from_the_scenario() {
    let folder = folder();
    let bytes: Vec<u8> = heights().iter().flat_map(|h| (*h as i16).to_be_bytes()).collect();
    std::fs::write(folder.path().join("a.img"), &bytes).unwrap();
    let layout = RawLayout { columns: COLUMNS, rows: ROWS, sample: SampleKind::I16Big, skip_bytes: 0 };
    let bare = |layout| RasterFile { layout: Some(layout), ..metres_per_px("a.img", 1.0) };
    assert_eq!(read(&folder, bare(layout)).unwrap().values, heights());
    // Read with the other byte order they are something else.
    let swapped = RawLayout { sample: SampleKind::I16Little, ..layout };
    assert_ne!(read(&folder, bare(swapped)).unwrap().values, heights());
    let too_large = fault(&folder, bare(RawLayout { rows: ROWS + 1, ..layout }));
    assert!(too_large.contains("1554 bytes") && too_large.contains("1628"), "{too_large}");
    let unstated = fault(&folder, RasterFile::from_path("a.img"));
    assert!(unstated.contains("file.layout"), "{unstated}");
}
