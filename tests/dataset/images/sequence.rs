//! Sequences of pictures: where they are found, in which order, and what is wrong with them.

use crate::dataset::{complaint, folder, grey, png, put, sensor};
use image::{DynamicImage, ImageBuffer, Luma};
use opnav::dataset::*;
use opnav::geometry::Distortion;
use std::fs;
use std::path::Path;

/// A data set of three pictures under `root`.
fn sequence(root: &Path) {
    put(root, "cam0/data.csv", "#timestamp [ns],filename\n100,100.png\n200,200.png\n300,300.png\n");
    for name in ["100", "200", "300"] {
        put(root, &format!("cam0/data/{name}.png"), grey(64, 48));
    }
    write_camera_sensor(&root.join("cam0/sensor.yaml"), &sensor(Distortion::None)).expect("write");
}

#[test]
fn data_sets_and_euroc_folders_open() {
    for below in ["", "mav0"] {
        let dir = folder();
        sequence(&dir.path().join(below));
        let sequence = ImageSequence::open(dir.path(), &CameraSource::Folder).expect("open");
        assert_eq!(sequence.root, dir.path().join(below));
        assert_eq!(sequence.frames.iter().map(|f| f.t_ns).collect::<Vec<_>>(), [100, 200, 300]);
        assert_eq!(sequence.frames.iter().map(|f| f.index).collect::<Vec<_>>(), [0, 1, 2]);
        let picture = sequence.load(&sequence.frames[2]).expect("load");
        assert_eq!((picture.dimensions(), picture[(3, 1)].0[0]), ((64, 48), 10));
    }
}

#[test]
fn sixteen_bit_and_colour_images_become_grey() {
    let dir = folder();
    let deep = ImageBuffer::from_pixel(64, 48, Luma([0x8080u16]));
    put(dir.path(), "1.png", png(&DynamicImage::ImageLuma16(deep)));
    put(
        dir.path(),
        "2.png",
        png(&DynamicImage::ImageRgb8(ImageBuffer::from_pixel(64, 48, image::Rgb([128, 128, 128])))),
    );
    let sequence = ImageSequence::open(dir.path(), &CameraSource::HorizontalFov(1.0)).expect("open");
    for frame in &sequence.frames {
        assert_eq!(sequence.load(frame).expect("load")[(5, 5)].0[0], 128);
    }
}

#[test]
fn plain_folders_are_sorted_as_people_count() {
    let dir = folder();
    for name in ["img10.png", "img2.png", "img1.png", "notes.txt"] {
        put(dir.path(), name, grey(64, 48));
    }
    let sequence = ImageSequence::open(dir.path(), &CameraSource::HorizontalFov(60f64.to_radians())).expect("open");
    let order: Vec<_> = sequence.frames.iter().map(|f| f.path.file_name().expect("a name").to_owned()).collect();
    assert_eq!(order, ["img1.png", "img2.png", "img10.png"]);
    assert_eq!(sequence.frames.iter().map(|f| f.t_ns).collect::<Vec<_>>(), [0, 1_000_000_000, 2_000_000_000]);
    let focal = 32.0 / 30f64.to_radians().tan();
    assert!((sequence.sensor.camera.focal_px.x - focal).abs() < 1e-12);
}

#[test]
fn names_that_are_nanoseconds_give_the_times_and_small_numbers_do_not() {
    let dir = folder();
    for name in ["1403636579763555584.png", "1403636579813555456.png"] {
        put(dir.path(), name, grey(64, 48));
    }
    let open = || ImageSequence::open(dir.path(), &CameraSource::HorizontalFov(1.0)).expect("open");
    assert_eq!(open().frames[1].t_ns, 1_403_636_579_813_555_456);
    fs::remove_dir_all(dir.path()).expect("removed");
    for name in ["0007.png", "0008.png"] {
        put(dir.path(), name, grey(64, 48));
    }
    assert_eq!(open().frames[1].t_ns, 1_000_000_000);
}

#[test]
fn bad_lists_of_frames_are_refused_with_the_line() {
    let dir = folder();
    sequence(dir.path());
    let list = dir.path().join("cam0/data.csv");
    let cases = [
        ("#t\n100,100.png\n100,200.png\n", Some(3), "100 ns does not come after"),
        ("#t\n200,200.png\n100,100.png\n", Some(3), "does not come after"),
        ("#t\n100\n", Some(2), "timestamp [ns],filename"),
        ("#t\nnoon,100.png\n", Some(2), "'noon' is not a time stamp"),
        ("#t\n100,lost.png\n", None, "none of its 1 pictures exists"),
    ];
    for (text, line, word) in cases {
        fs::write(&list, text).expect("write");
        complaint(ImageSequence::open(dir.path(), &CameraSource::Folder), &list, line, &[word]);
    }
    fs::write(&list, "#t\n").expect("write");
    complaint(ImageSequence::open(dir.path(), &CameraSource::Folder), &list, None, &["it lists no pictures"]);
}

#[test]
fn a_missing_camera_or_folder_comes_with_the_cure() {
    let dir = folder();
    sequence(dir.path());
    let file = dir.path().join("cam0/sensor.yaml");
    fs::remove_file(&file).expect("removed");
    complaint(ImageSequence::open(dir.path(), &CameraSource::Folder), &file, None, &["--camera", "--fov-deg"]);
    let elsewhere = dir.path().join("other.yaml");
    complaint(ImageSequence::open(dir.path(), &CameraSource::File(elsewhere.clone())), &elsewhere, None, &["missing"]);
    let nowhere = dir.path().join("nowhere");
    complaint(ImageSequence::open(&nowhere, &CameraSource::Folder), &nowhere, None, &["missing"]);
    for fov in [0.0, 4.0, f64::NAN] {
        let picture = dir.path().join("cam0/data/100.png");
        complaint(
            ImageSequence::open(dir.path(), &CameraSource::HorizontalFov(fov)),
            &picture,
            None,
            &["field of view"],
        );
    }
}

#[test]
fn images_of_the_wrong_size_or_broken_are_named() {
    let dir = folder();
    sequence(dir.path());
    let sequence = ImageSequence::open(dir.path(), &CameraSource::Folder).expect("open");
    let path = put(dir.path(), "cam0/data/200.png", grey(32, 48));
    complaint(sequence.load(&sequence.frames[1]), &path, None, &["32x48", "64x48"]);
    let whole = grey(64, 48);
    put(dir.path(), "cam0/data/200.png", &whole[..whole.len() / 2]);
    complaint(sequence.load(&sequence.frames[1]), &path, None, &["cannot be read"]);
    let mut flipped = whole.clone();
    let middle = flipped.len() / 2;
    flipped[middle] ^= 0xff;
    put(dir.path(), "cam0/data/200.png", &flipped);
    complaint(sequence.load(&sequence.frames[1]), &path, None, &["cannot be read"]);
    put(dir.path(), "cam0/data/200.png", "");
    complaint(sequence.load(&sequence.frames[1]), &path, None, &["cannot be read"]);
    fs::remove_file(&path).expect("removed");
    complaint(sequence.load(&sequence.frames[1]), &path, None, &["could not read"]);
    assert!(sequence.load(&sequence.frames[0]).is_ok(), "the others stay usable");
}
