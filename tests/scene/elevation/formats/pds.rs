//! Images of the Planetary Data System, their label beside or before them.

use super::{COLUMNS, ROWS, folder, heights, read};
use opnav::scene::{Georeference, RasterFile};

/// A label as MOLA's are, with the given pointer and lines inside its objects.
pub fn label(pointer: &str, image: &str, map: &str) -> String {
    format!(
        "PDS_VERSION_ID = PDS3\r\nRECORD_BYTES = 100\r\n^IMAGE = {pointer}\r\nOBJECT = IMAGE\r\n  LINES = {ROWS}\r\n  \
         LINE_SAMPLES = {COLUMNS}\r\n{image}\r\nEND_OBJECT = IMAGE\r\nOBJECT = IMAGE_MAP_PROJECTION\r\n  \
         MAP_PROJECTION_TYPE = \"SIMPLE CYLINDRICAL\"\r\n  A_AXIS_RADIUS = 3396.0 <KM>\r\n  CENTER_LATITUDE = 0.0 \
         <DEGREE>\r\n  CENTER_LONGITUDE = 180.0 <DEGREE>\r\n  MAP_RESOLUTION = 4.0 <PIXEL/DEGREE>\r\n  \
         POSITIVE_LONGITUDE_DIRECTION = \"EAST\"\r\n{map}\r\nEND_OBJECT = IMAGE_MAP_PROJECTION\r\nEND\r\n"
    )
}

pub const OFFSETS: &str = "LINE_PROJECTION_OFFSET = 40.5\r\nSAMPLE_PROJECTION_OFFSET = 12.5";

#[test]
fn pds_images_with_a_detached_label_are_read() {
    let folder = folder();
    let image = "  SAMPLE_TYPE = MSB_INTEGER\r\n  SAMPLE_BITS = 16\r\n  SCALING_FACTOR = 0.5\r\n  OFFSET = -3";
    std::fs::write(folder.path().join("a.lbl"), label("\"A.IMG\"", image, OFFSETS)).unwrap();
    let bytes: Vec<u8> = heights().iter().flat_map(|h| (*h as i16).to_be_bytes()).collect();
    std::fs::write(folder.path().join("a.img"), &bytes).unwrap();
    let expected: Vec<f32> = heights().iter().map(|h| 0.5 * h - 3.0).collect();
    for name in ["a.lbl", "a.img"] {
        assert_eq!(read(&folder, RasterFile::from_path(name)).unwrap().values, expected, "{name}");
    }
    std::fs::write(folder.path().join("a.img"), &bytes[..bytes.len() - 1]).unwrap();
    let message = read(&folder, RasterFile::from_path("a.lbl")).unwrap_err().to_string();
    assert!(message.contains("a.img") && message.contains("cut short"), "{message}");
    std::fs::remove_file(folder.path().join("a.img")).unwrap();
    let message = read(&folder, RasterFile::from_path("a.lbl")).unwrap_err().to_string();
    assert!(message.contains("A.IMG"), "{message}");
}

#[test]
fn pds_images_with_an_attached_label_are_read() {
    let folder = folder();
    let image = "  SAMPLE_TYPE = PC_REAL\r\n  SAMPLE_BITS = 32\r\n  MISSING_CONSTANT = 16#FF7FFFFB#\r\n  \
                 LINE_PREFIX_BYTES = 3\r\n  LINE_SUFFIX_BYTES = 5";
    let mut values = heights();
    values[40] = f32::from_bits(0xFF7F_FFFB);
    for (pointer, start) in [("13", 1200), ("1101 <BYTES>", 1100)] {
        let mut bytes = label(pointer, image, OFFSETS).into_bytes();
        assert!(bytes.len() < start);
        bytes.resize(start, b' ');
        for row in values.chunks(COLUMNS) {
            bytes.extend([1; 3]);
            row.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
            bytes.extend([2; 5]);
        }
        std::fs::write(folder.path().join("a.img"), bytes).unwrap();
        let raster = read(&folder, RasterFile::from_path("a.img")).unwrap();
        assert!(raster.values[40].is_nan());
        assert!(raster.values.iter().zip(heights()).enumerate().all(|(i, (a, b))| i == 40 || *a == b));
    }
}

#[test]
fn both_ways_of_counting_pixels_in_labels_are_told_apart() {
    let folder = folder();
    std::fs::write(folder.path().join("a.img"), vec![0_u8; COLUMNS * ROWS]).unwrap();
    // As the data dictionary says, and as MOLA's labels count: one more.
    for (offset, bounds) in [(40.5, ""), (39.5, "\r\nMAXIMUM_LATITUDE = 10.0"), (40.5, "\r\nMAXIMUM_LATITUDE = 10.0")] {
        let map = format!("LINE_PROJECTION_OFFSET = {offset}\r\nSAMPLE_PROJECTION_OFFSET = 12.5{bounds}");
        std::fs::write(folder.path().join("a.lbl"), label("\"a.img\"", "SAMPLE_BITS = 8", &map)).unwrap();
        let raster = read(&folder, RasterFile::from_path("a.lbl")).unwrap();
        let Georeference::Degrees { first_deg, step_deg, radius_m } = raster.georeference else { panic!("degrees") };
        let counts_from_one = offset == 40.5 && !bounds.is_empty();
        let expected = if counts_from_one { [177.125, 9.875] } else { [176.875, 0.25 * offset] };
        assert_eq!((first_deg, step_deg, radius_m), (expected, [0.25, 0.25], 3_396_000.0), "{offset} {bounds}");
    }
}
