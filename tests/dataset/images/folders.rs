//! Any folder of pictures: kinds of files, order, time stamps.

use crate::dataset::{complaint, folder, grey, png, put};
use image::{DynamicImage, GrayImage, ImageBuffer, ImageFormat, Luma, Rgb};
use opnav::dataset::{CameraSource, DatasetError, FrameTimes, ImageSequence};
use std::path::Path;

const FOV: CameraSource = CameraSource::HorizontalFov(1.0);

fn open(folder: &Path) -> ImageSequence {
    ImageSequence::open(folder, &FOV).expect("a sequence")
}

fn timed(folder: &Path, times: FrameTimes) -> Result<Vec<i64>, DatasetError> {
    let sequence = ImageSequence::open_timed(folder, &FOV, &times)?;
    Ok(sequence.frames.iter().map(|f| f.t_ns).collect())
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

// ---------------------------------------------------------------------------------------------------- kinds of files

#[test]
fn every_kind_of_picture_is_read_as_the_same_grey() {
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
fn floating_point_pictures_share_one_scale_and_survive_what_is_not_a_number() {
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
fn pictures_cut_short_are_named() {
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
fn pictures_too_large_to_hold_are_refused_by_their_header() {
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
fn the_size_of_most_pictures_is_the_cameras() {
    let dir = folder();
    for (name, width) in [("a1.png", 32), ("a2.png", 64), ("a3.png", 64)] {
        put(dir.path(), name, grey(width, 48));
    }
    let sequence = open(dir.path());
    assert_eq!(sequence.sensor.camera.size_px(), (64, 48));
    complaint(sequence.load(&sequence.frames[0]), &dir.path().join("a1.png"), None, &["is 32x48 px", "is 64x48 px"]);
    put(dir.path(), "a4.png", grey(32, 48));
    assert_eq!(open(dir.path()).sensor.camera.size_px(), (32, 48), "of two sizes as frequent, the first");
}

// ---------------------------------------------------------------------------------------------------- order and times

fn names(sequence: &ImageSequence) -> Vec<String> {
    sequence.frames.iter().map(|f| f.path.file_name().expect("a name").to_string_lossy().into_owned()).collect()
}

#[test]
fn hidden_files_and_other_files_are_passed_over() {
    let dir = folder();
    for name in ["frame10.png", "frame9.PNG", "._frame1.png", "notes.txt", "frame2.png.bak"] {
        put(dir.path(), name, grey(64, 48));
    }
    std::fs::create_dir(dir.path().join("frame3.png")).expect("a folder with a picture's name");
    assert_eq!(names(&open(dir.path())), ["frame9.PNG", "frame10.png"]);
}

#[test]
fn names_that_are_seconds_give_the_times() {
    let dir = folder();
    for name in ["1305031102.25.png", "1305031102.175304.png", "1305031103.0.png"] {
        put(dir.path(), name, grey(64, 48));
    }
    let sequence = open(dir.path());
    let times: Vec<i64> = sequence.frames.iter().map(|f| f.t_ns).collect();
    assert_eq!(times, [1_305_031_102_175_304_000, 1_305_031_102_250_000_000, 1_305_031_103_000_000_000]);
    assert!(sequence.notes.is_empty(), "{:?}", sequence.notes);
}

#[test]
fn names_that_are_no_increasing_times_are_refused() {
    let dir = folder();
    put(dir.path(), "1403636579763555584.png", grey(64, 48));
    let cover = put(dir.path(), "cover.png", grey(64, 48));
    let words = ["its name is no time stamp", "--rate-hz or --times"];
    complaint(timed(dir.path(), FrameTimes::Folder), &cover, None, &words);
    std::fs::remove_file(&cover).expect("removed");
    let doubled = put(dir.path(), "1403636579763555584.pgm", grey(64, 48));
    let words = ["has the same time stamp, 1403636579763555584 ns: remove one of them", ".png", ".pgm"];
    let first = complaint(timed(dir.path(), FrameTimes::Folder), &doubled, None, &words[..1]);
    assert!(words.iter().all(|word| first.contains(word)), "{first}");
}

#[test]
fn a_rate_spaces_the_pictures() {
    let dir = folder();
    for name in ["a1.png", "a2.png", "a10.png"] {
        put(dir.path(), name, grey(64, 48));
    }
    assert_eq!(timed(dir.path(), FrameTimes::RateHz(30.0)).expect("times"), [0, 33_333_333, 66_666_667]);
    let camera = "resolution: [64, 48]\nintrinsics: [60.0, 60.0, 31.5, 23.5]\nrate_hz: 20\n";
    let file = put(dir.path(), "sensor.yaml", camera);
    let sequence = ImageSequence::open(dir.path(), &CameraSource::File(file)).expect("a sequence");
    assert_eq!(sequence.frames[2].t_ns, 100_000_000);
    assert_eq!(sequence.notes, ["no time stamps found: 20 pictures a second, as the camera file says"]);
    assert!(open(dir.path()).notes[0].contains("1 s apart"));
    for rate in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300] {
        complaint(timed(dir.path(), FrameTimes::RateHz(rate)), dir.path(), None, &["is not a positive number"]);
    }
}

#[test]
fn a_list_gives_order_and_times() {
    let dir = folder();
    for name in ["x.png", "y.png", "z.png"] {
        put(dir.path(), name, grey(64, 48));
    }
    let lists = [
        "#timestamp [ns],filename\n5,z.png\n7,x.png\n",
        "timestamp,filename\r\n5,z.png\r\n7,x.png\r\n",
        "# seconds, as in other data sets\n0.000000005 z.png\n0.000000007 x.png",
        "5\tz.png\n\n7\tx.png",
    ];
    for text in lists {
        let list = put(dir.path(), "list.csv", text);
        let sequence = ImageSequence::open_timed(dir.path(), &FOV, &FrameTimes::List(list)).expect("a sequence");
        assert_eq!(names(&sequence), ["z.png", "x.png"]);
        assert_eq!(sequence.frames.iter().map(|f| f.t_ns).collect::<Vec<_>>(), [5, 7], "{text}");
    }
}

#[test]
fn bad_lists_are_refused_with_the_line_and_a_lost_picture_is_not() {
    let dir = folder();
    for name in ["x.png", "z.png"] {
        put(dir.path(), name, grey(64, 48));
    }
    let cases = [
        (
            "5,x.png\n5,z.png\n",
            Some(2),
            "time stamp 5 ns does not come after the one before it: sort the rows and remove",
        ),
        ("#t\n5,x.png\n4,z.png\n", Some(3), "does not come after"),
        (
            "5,x.png\nnoon,z.png\n",
            Some(2),
            "'noon' is not a time stamp: write whole nanoseconds, or seconds with a point",
        ),
        ("5,x.png\n99999999999999999999,z.png\n", Some(2), "is not a time stamp"),
        ("-9223372036854775808,x.png\n9,z.png\n", Some(1), "is not a time stamp"),
        ("5,x.png\n4611686018427387905,z.png\n", Some(2), "is not a time stamp"),
        ("5,x.png\n6,\n", Some(2), "'timestamp [ns],filename' expected"),
        ("5,u.png\n6,v.png\n", None, "none of its 2 pictures exists, such as"),
    ];
    for (text, line, word) in cases {
        let list = put(dir.path(), "list.csv", text);
        complaint(timed(dir.path(), FrameTimes::List(list.clone())), &list, line, &[word]);
    }
    let nowhere = dir.path().join("nowhere.csv");
    complaint(timed(dir.path(), FrameTimes::List(nowhere.clone())), &nowhere, None, &["is missing"]);
    let list = put(dir.path(), "list.csv", "1,x.png\n2,lost.png\n3,z.png\n");
    let sequence = ImageSequence::open_timed(dir.path(), &FOV, &FrameTimes::List(list)).expect("a sequence");
    complaint(sequence.load(&sequence.frames[1]), &sequence.frames[1].path, None, &["could not read"]);
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
