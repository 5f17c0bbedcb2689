//! Any file of a picture: kinds, depths, damage.

use crate::dataset::{complaint, folder, grey, png, put};
use image::{DynamicImage, GrayImage, ImageBuffer, ImageFormat, Luma, Rgb};
use opnav::dataset::{CameraSource, ImageSequence};
use std::path::Path;

pub const FOV: CameraSource = CameraSource::HorizontalFov(1.0);

pub fn open(folder: &Path) -> ImageSequence {
    ImageSequence::open(folder, &FOV).expect("a sequence")
}

fn encoded(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).expect("a picture");
    bytes.into_inner()
}

/// A smooth grey picture: JPEG keeps it to a level or two.
fn ramp() -> GrayImage {
    GrayImage::from_fn(64, 48, |x, y| Luma([(40 + 2 * x + y) as u8]))
}

fn tiff_of<Kind: tiff::encoder::colortype::ColorType>(values: &[Kind::Inner]) -> Vec<u8>
where
    [Kind::Inner]: tiff::encoder::TiffValue,
{
    let mut bytes = std::io::Cursor::new(Vec::new());
    tiff::encoder::TiffEncoder::new(&mut bytes)
        .expect("a file")
        .write_image::<Kind>(64, 48, values)
        .expect("a picture");
    bytes.into_inner()
}

#[test]
fn every_kind_of_image_is_read_as_the_same_grey() {
    let shallow = DynamicImage::ImageLuma8(ramp());
    let colour = DynamicImage::ImageRgb8(shallow.to_rgb8());
    let deep =
        DynamicImage::ImageLuma16(ImageBuffer::from_fn(64, 48, |x, y| Luma([u16::from(ramp()[(x, y)].0[0]) * 257])));
    let deep_colour = DynamicImage::ImageRgb16(deep.to_rgb16());
    let cases = [
        ("grey.png", encoded(&shallow, ImageFormat::Png), 0),
        ("colour.png", encoded(&colour, ImageFormat::Png), 0),
        ("alpha.png", encoded(&DynamicImage::ImageRgba8(shallow.to_rgba8()), ImageFormat::Png), 0),
        ("deep.png", encoded(&deep, ImageFormat::Png), 0),
        ("deep_colour.png", encoded(&deep_colour, ImageFormat::Png), 0),
        ("grey.jpg", encoded(&shallow, ImageFormat::Jpeg), 3),
        ("COLOUR.JPEG", encoded(&colour, ImageFormat::Jpeg), 3),
        ("grey.tif", encoded(&shallow, ImageFormat::Tiff), 0),
        ("deep.tiff", encoded(&deep, ImageFormat::Tiff), 0),
        ("colour.bmp", encoded(&colour, ImageFormat::Bmp), 0),
        ("grey.pgm", encoded(&shallow, ImageFormat::Pnm), 0),
        ("deep.pgm", encoded(&deep, ImageFormat::Pnm), 0),
        ("misnamed.png", encoded(&shallow, ImageFormat::Jpeg), 3),
    ];
    for (name, bytes, tolerance) in cases {
        let dir = folder();
        put(dir.path(), name, bytes);
        // A bright deep picture besides, so that 16 bits are seen to be used.
        let bright = ImageBuffer::from_pixel(64, 48, Luma([65_535_u16]));
        put(dir.path(), "zz.png", png(&DynamicImage::ImageLuma16(bright)));
        let sequence = open(dir.path());
        let read = sequence.load(&sequence.frames[0]).unwrap_or_else(|e| panic!("{name}: {e}"));
        let worst = read.pixels().zip(ramp().pixels()).map(|(a, b)| a.0[0].abs_diff(b.0[0])).max();
        assert!(worst <= Some(tolerance), "{name}: {worst:?} levels off");
    }
}

#[test]
fn floating_point_images_share_one_scale_and_survive_what_is_not_a_number() {
    let dir = folder();
    let values = |gain: f32| -> Vec<f32> { ramp().pixels().map(|p| gain * (f32::from(p.0[0]) - 100.0)).collect() };
    let mut bad = values(0.01);
    (bad[7], bad[8], bad[9]) = (f32::NAN, f32::INFINITY, f32::NEG_INFINITY);
    put(dir.path(), "a1.tif", tiff_of::<tiff::encoder::colortype::Gray32Float>(&values(0.01)));
    put(dir.path(), "a2.tif", tiff_of::<tiff::encoder::colortype::Gray32Float>(&bad));
    let double: Vec<f64> = values(0.005).into_iter().map(f64::from).collect();
    put(dir.path(), "a3.tif", tiff_of::<tiff::encoder::colortype::Gray64Float>(&double));
    put(dir.path(), "a4.tif", tiff_of::<tiff::encoder::colortype::Gray32Float>(&[f32::NAN; 64 * 48]));
    let sequence = open(dir.path());
    let pictures: Vec<GrayImage> = sequence.frames.iter().map(|f| sequence.load(f).expect("a picture")).collect();
    let contrast = |p: &GrayImage| f64::from(p.iter().max().unwrap() - p.iter().min().unwrap());
    assert!(contrast(&pictures[0]) > 200.0);
    assert_eq!((pictures[1].as_raw()[7], pictures[1].as_raw()[8], pictures[1].as_raw()[9]), (0, 255, 0));
    let same =
        pictures[1].iter().zip(pictures[0].iter()).enumerate().filter(|(i, (a, b))| !(7..10).contains(i) && a != b);
    assert_eq!(same.count(), 0, "the rest of the picture is as without them");
    let half = contrast(&pictures[2]) / contrast(&pictures[0]);
    assert!((half - 0.5).abs() < 0.02, "half of the contrast stays half: {half}");
    assert!(pictures[3].iter().all(|p| *p == 0), "a picture without any number is black");
    assert!(sequence.notes.iter().any(|n| n.contains("floating-point pictures")), "{:?}", sequence.notes);
}

#[test]
fn signed_and_long_whole_numbers_are_read_from_tiff() {
    use tiff::encoder::colortype::{Gray32, GrayI16};
    let dir = folder();
    let ramp = ramp();
    put(
        dir.path(),
        "a1.tif",
        tiff_of::<GrayI16>(&ramp.pixels().map(|p| i16::from(p.0[0]) - 100).collect::<Vec<i16>>()),
    );
    put(dir.path(), "a2.tif", tiff_of::<Gray32>(&ramp.pixels().map(|p| u32::from(p.0[0])).collect::<Vec<u32>>()));
    let sequence = open(dir.path());
    for frame in &sequence.frames {
        let picture = sequence.load(frame).expect("a picture");
        assert!(picture.iter().max() > picture.iter().min(), "{}", frame.path.display());
    }
}

#[test]
fn bits_in_use_are_found_and_noted() {
    let dir = folder();
    let deep = |largest: u16| {
        png(&DynamicImage::ImageLuma16(ImageBuffer::from_fn(64, 48, |x, _| {
            Luma([(u32::from(largest) * x / 63) as u16])
        })))
    };
    put(dir.path(), "a1.png", deep(900));
    put(dir.path(), "a2.png", deep(1023));
    let sequence = open(dir.path());
    assert_eq!(sequence.levels.deep_bits, 10);
    assert_eq!(sequence.load(&sequence.frames[1]).expect("a picture")[(63, 0)].0[0], 255);
    assert!(sequence.notes.iter().any(|n| n.contains("seem to use 10 bits: 1023 becomes 255")), "{:?}", sequence.notes);
}

#[test]
fn images_cut_short_are_named() {
    let shallow = DynamicImage::ImageLuma8(ramp());
    let formats = [
        ("png", ImageFormat::Png),
        ("jpg", ImageFormat::Jpeg),
        ("tif", ImageFormat::Tiff),
        ("bmp", ImageFormat::Bmp),
        ("pgm", ImageFormat::Pnm),
    ];
    for (extension, format) in formats {
        let dir = folder();
        let whole = encoded(&shallow, format);
        put(dir.path(), &format!("a1.{extension}"), &whole);
        for share in [1, 2, 3] {
            put(dir.path(), &format!("a2.{extension}"), &whole[..whole.len() * share / 4]);
            let sequence = open(dir.path());
            sequence.load(&sequence.frames[0]).expect("a whole picture");
            let path = sequence.frames[1].path.clone();
            let cure = "remove it or put a whole one in its place";
            complaint(sequence.load(&sequence.frames[1]), &path, None, &["the picture cannot be read (", cure]);
        }
    }
    // A thumbnail's own end marker is not the picture's.
    let dir = folder();
    let mut bytes = encoded(&shallow, ImageFormat::Jpeg);
    bytes.splice(2..2, [0xff, 0xe1, 0x00, 0x06, 0xff, 0xda, 0xff, 0xd9]);
    let path = put(dir.path(), "a1.jpg", &bytes);
    let sequence = open(dir.path());
    sequence.load(&sequence.frames[0]).expect("a whole picture");
    put(dir.path(), "a1.jpg", &bytes[..bytes.len() - 40]);
    complaint(sequence.load(&sequence.frames[0]), &path, None, &["(the file is cut short)"]);
}

/// A PNG whose header promises a size and whose data is not there.
fn promised(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = grey(2, 2);
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    let crc = bytes[12..29].iter().fold(!0_u32, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |c, _| if c & 1 == 1 { (c >> 1) ^ 0xedb8_8320 } else { c >> 1 })
    });
    bytes[29..33].copy_from_slice(&(!crc).to_be_bytes());
    bytes
}

#[test]
fn images_too_large_to_hold_are_refused_by_their_header() {
    let dir = folder();
    let path = put(dir.path(), "a1.png", promised(20_000, 20_000));
    let words =
        ["the picture is 20000x20000 px, more than the 67108864 pixels that a picture may have: shrink it or cut it"];
    complaint(ImageSequence::open(dir.path(), &FOV), &path, None, &words);
    put(dir.path(), "a2.png", grey(64, 48));
    let sequence = open(dir.path());
    assert_eq!(sequence.sensor.camera.size_px(), (64, 48));
    complaint(sequence.load(&sequence.frames[0]), &path, None, &words);
}

#[test]
fn colours_weigh_as_the_eye_sees_them() {
    let dir = folder();
    let colours = ImageBuffer::from_fn(64, 48, |x, _| Rgb(if x < 32 { [0, 200, 0] } else { [0, 0, 200_u8] }));
    put(dir.path(), "a1.png", png(&DynamicImage::ImageRgb8(colours)));
    let sequence = open(dir.path());
    let picture = sequence.load(&sequence.frames[0]).expect("a picture");
    assert_eq!((picture[(0, 0)].0[0], picture[(63, 0)].0[0]), (143, 14));
}
