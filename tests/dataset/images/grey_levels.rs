//! Pictures of any depth.

use crate::dataset::{folder, png, put};
use image::{DynamicImage, ImageBuffer, Luma};
use opnav::dataset::{CameraSource, GreyRaster, ImageSequence, read_camera_sensor};

const NUMBERS: [u16; 6] = [0, 1, 16, 2048, 4094, 4095];

fn twelve_bits() -> GreyRaster {
    GreyRaster { width_px: 3, height_px: 2, bits: 12, numbers: NUMBERS.to_vec() }
}

/// The picture as the front end reads it, with these lines in the camera file.
fn as_read(picture: &GreyRaster, lines: &str) -> Vec<u8> {
    let dir = folder();
    put(dir.path(), "cam0/data/100.png", png(&picture.to_image().expect("a picture")));
    let camera = format!("resolution: [3, 2]\nintrinsics: [5.0, 5.0, 1.0, 0.5]\n{lines}");
    put(dir.path(), "cam0/sensor.yaml", camera);
    let sequence = ImageSequence::open(dir.path(), &CameraSource::Folder).expect("a sequence");
    sequence.load(&sequence.frames[0]).expect("a picture").into_raw()
}

#[test]
fn numbers_are_stored_as_they_are() {
    let stored = twelve_bits().to_image().expect("a picture");
    let expected = ImageBuffer::from_raw(3, 2, NUMBERS.to_vec()).expect("a picture");
    assert_eq!(stored, DynamicImage::ImageLuma16(expected));
    let read = image::load_from_memory(&png(&stored)).expect("a picture");
    assert_eq!(read, stored);
    let shallow = GreyRaster { bits: 8, numbers: vec![0, 1, 2, 100, 254, 255], ..twelve_bits() };
    let bytes = ImageBuffer::<Luma<u8>, _>::from_raw(3, 2, vec![0, 1, 2, 100, 254, 255]).expect("a picture");
    assert_eq!(shallow.to_image(), Some(DynamicImage::ImageLuma8(bytes)));
    // Numbers beyond the bits, and too few of them.
    assert_eq!(GreyRaster { bits: 8, ..twelve_bits() }.to_image(), None);
    assert_eq!(GreyRaster { numbers: vec![1], ..twelve_bits() }.to_image(), None);
}

#[test]
fn the_front_end_sees_the_whole_range_of_any_depth() {
    assert_eq!(as_read(&twelve_bits(), "bits: 12\n"), [0, 0, 1, 128, 255, 255]);
    // Without the key the numbers themselves tell: the largest is 4095.
    assert_eq!(as_read(&twelve_bits(), ""), as_read(&twelve_bits(), "bits: 12\n"));
    // A key that states all 16 bits is believed, and the picture is nearly black.
    assert_eq!(as_read(&twelve_bits(), "bits: 16\n"), [0, 0, 0, 8, 16, 16]);
    let four = GreyRaster { bits: 4, numbers: vec![0, 1, 7, 8, 14, 15], ..twelve_bits() };
    assert_eq!(as_read(&four, "bits: 4\n"), [0, 17, 119, 136, 238, 255]);
    let sixteen = GreyRaster { bits: 16, numbers: vec![0, 257, 0x8080, 65_000, 65_534, 65_535], ..twelve_bits() };
    assert_eq!(as_read(&sixteen, "bits: 16\n"), as_read(&sixteen, ""));
    assert_eq!(as_read(&sixteen, "")[2..], [128, 253, 255, 255]);
}

#[test]
fn impossible_depths_are_refused() {
    let dir = folder();
    for bits in ["0", "17", "-3"] {
        let text = format!("resolution: [3, 2]\nintrinsics: [5.0, 5.0, 1.0, 0.5]\nbits: {bits}\n");
        let path = put(dir.path(), "sensor.yaml", text);
        let error = read_camera_sensor(&path).expect_err("refused").to_string();
        assert!(error.contains("bits") && error.contains("sensor.yaml"), "{error}");
    }
}
