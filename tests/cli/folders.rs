//! Bad folders and bad pictures: the exact words for each, and what is still tracked.

use super::{opnav, tracking_error};
use crate::vision::texture::picture;
use image::{DynamicImage, GrayImage, ImageFormat, Luma};
use nalgebra::Vector2;
use opnav::observations::PairStatus;
use opnav::observations::read_relative_rotations;
use serde_json::Value;
use std::path::Path;
use tempfile::TempDir;

const SIDE: u32 = 160;

fn folder() -> TempDir {
    TempDir::new().expect("a temporary folder")
}

/// A textured picture that slides by 4 px a frame.
fn frame(k: usize) -> GrayImage {
    picture(SIDE, SIDE, 1.0, k as u64, |p| p + Vector2::new(4.0 * k as f64, 0.0))
}

/// A folder of `count` pictures, `frame9.png` before `frame10.png`.
fn frames(count: usize) -> TempDir {
    let folder = folder();
    (0..count).for_each(|k| frame(k).save(folder.path().join(format!("frame{k}.png"))).expect("written"));
    folder
}

fn put(folder: &TempDir, name: &str, bytes: impl AsRef<[u8]>) {
    std::fs::write(folder.path().join(name), bytes).expect("written");
}

fn encoded(picture: &GrayImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    DynamicImage::ImageLuma8(picture.clone()).write_to(&mut bytes, format).expect("a picture");
    bytes.into_inner()
}

/// The error of tracking, with `FOLDER` for the folder's path.
fn message(folder: &TempDir, more: &[&str]) -> String {
    tracking_error(folder.path(), more).replace(&folder.path().display().to_string(), "FOLDER")
}

/// Tracks the folder; the statuses of the adjacent pairs, and the frames that were not used as (file, status, problem).
fn tracked(folder: &TempDir) -> (Vec<PairStatus>, Vec<[String; 3]>) {
    let out = folder.path().join("result");
    opnav().arg("track").arg(folder.path()).args(["--fov-deg", "60", "--out"]).arg(&out).assert().success();
    let rotations = read_relative_rotations(&out.join("relative_rotations.csv")).expect("rotations");
    let summary: Value =
        serde_json::from_slice(&std::fs::read(out.join("summary.json")).expect("a summary")).expect("JSON");
    let frames = summary["counts"]["frames"].as_u64().expect("a count") as usize;
    let text = |value: &Value| value.as_str().unwrap_or_default().replace(&format!("{}/", folder.path().display()), "");
    let unused = summary["frames_not_used"].as_array().expect("a list").iter();
    let unused = unused.map(|f| ["file", "status", "problem"].map(|key| text(&f[key]))).collect();
    (rotations[..frames - 1].iter().map(|r| r.status).collect(), unused)
}

/// Tracks five pictures of which the third is this one; it has to be named so, and tracking goes on around it.
fn assert_named(name: &str, bytes: &[u8], status: &str, problem: &str) {
    let folder = frames(5);
    std::fs::remove_file(folder.path().join("frame2.png")).expect("it was there");
    put(&folder, name, bytes);
    let (pairs, unused) = tracked(&folder);
    assert_eq!(unused, [[name, status, problem]]);
    use PairStatus::{NoFeatures, Ok};
    assert!(pairs[1..3] == [NoFeatures; 2] && pairs[0] != NoFeatures && pairs[3] != NoFeatures, "{pairs:?} {:?}", Ok);
}

#[test]
fn folders_that_cannot_be_tracked() {
    let fov = ["--fov-deg", "60"];
    let empty = folder();
    let kinds = "png, jpg, jpeg, tif, tiff, bmp, pgm, ppm, pbm, pnm";
    assert_eq!(message(&empty, &fov), format!("error: FOLDER: no pictures found ({kinds}): check the folder"));
    let above = folder();
    for node in ["node10", "node2"] {
        std::fs::create_dir_all(above.path().join(node).join("cam0")).expect("a folder");
    }
    assert_eq!(
        message(&above, &fov),
        format!(
            "error: FOLDER: no pictures found ({kinds}): give one of the 2 folders below that hold some, such as FOLDER/node2"
        )
    );
    assert_eq!(
        message(&frames(1), &fov),
        "error: at least two pictures are needed, and 1 selected: check the folder and the range of frames"
    );
    let doubled = frames(0);
    for name in ["1000000000.png", "1000000000.jpg"] {
        frame(0).save(doubled.path().join(name)).expect("written");
    }
    assert_eq!(
        message(&doubled, &fov),
        "error: FOLDER/1000000000.png: FOLDER/1000000000.jpg has the same time stamp, 1000000000 ns: remove one of them"
    );
    let unordered = frames(3);
    put(&unordered, "data.csv", "#t\n5,frame0.png\n3,frame1.png\n");
    assert_eq!(
        message(&unordered, &fov),
        "error: FOLDER/data.csv, line 3: time stamp 3 ns does not come after the one before it: sort the rows and remove \
         doubles"
    );
    let lens = frames(2);
    let camera = "resolution: [160, 160]\nintrinsics: [80.0, 80.0, 79.5, 79.5]\ndistortion_model: radial-tangential\n\
                  distortion_coefficients: [-0.9, 0.0, 0.0, 0.0]\n";
    put(&lens, "sensor.yaml", camera);
    assert_eq!(
        message(&lens, &[]),
        "error: FOLDER/sensor.yaml: the distortion cannot be inverted at pixel (-0.5, -0.5): check the coefficients or crop \
         the picture"
    );
}

#[test]
fn folders_without_two_images_that_can_be_read() {
    let folder = folder();
    put(&folder, "a1.png", "not a picture");
    put(&folder, "a2.png", encoded(&frame(0), ImageFormat::Png));
    put(&folder, "a3.png", "");
    let cure = "remove it or put a whole one in its place";
    assert_eq!(
        message(&folder, &["--fov-deg", "60"]),
        format!(
            "error: at least two pictures are needed, and 1 of the 3 selected can be used; the first fault: FOLDER/a1.png: the \
             picture cannot be read (Format error decoding Png: Invalid PNG signature.): {cure}"
        )
    );
}

#[test]
fn images_cut_short_are_named_and_passed_over() {
    let cure = "remove it or put a whole one in its place";
    let jpeg = encoded(&frame(2), ImageFormat::Jpeg);
    let problem = format!("frame2.jpg: the picture cannot be read (the file is cut short): {cure}");
    assert_named("frame2.jpg", &jpeg[..jpeg.len() / 2], "unreadable", &problem);
    let png = encoded(&frame(2), ImageFormat::Png);
    let problem = format!("frame2.png: the picture cannot be read (unexpected end of file): {cure}");
    assert_named("frame2.png", &png[..png.len() / 2], "unreadable", &problem);
}

#[test]
fn images_of_any_other_size_are_named_and_passed_over() {
    for side in [1, 80] {
        let problem = format!(
            "frame2.png is {side}x{side} px, but its camera is 160x160 px: give the camera file of these pictures or remove \
             the picture"
        );
        let small = GrayImage::new(side, side);
        assert_named("frame2.png", &encoded(&small, ImageFormat::Png), "wrong-size", &problem);
    }
    let problem = "frame2.pgm: the picture is 20000x20000 px, more than the 67108864 pixels that a picture may have: shrink it \
                   or cut it";
    assert_named("frame2.pgm", b"P5 20000 20000 255\nabc", "unreadable", problem);
}

#[test]
fn black_and_white_images_are_named_and_passed_over() {
    for level in [0, 255] {
        let flat = GrayImage::from_pixel(SIDE, SIDE, Luma([level]));
        assert_named("frame2.png", &encoded(&flat, ImageFormat::Png), "no-features", "");
    }
}

#[test]
fn floating_point_images_without_a_number_are_passed_over() {
    use tiff::encoder::{TiffEncoder, colortype::Gray32Float};
    let write = |path: &Path, values: &[f32]| {
        let mut encoder = TiffEncoder::new(std::fs::File::create(path).expect("a file")).expect("a file");
        encoder.write_image::<Gray32Float>(SIDE, SIDE, values).expect("a picture");
    };
    let folder = folder();
    for k in 0..5 {
        let mut values: Vec<f32> = frame(k).iter().map(|g| f32::from(*g) * 1e-3).collect();
        match k {
            2 => values.fill(f32::NAN),
            _ => values[..100].fill(f32::NAN),
        }
        write(&folder.path().join(format!("frame{k}.tif")), &values);
    }
    let (pairs, unused) = tracked(&folder);
    assert_eq!(unused, [["frame2.tif", "no-features", ""]]);
    assert!(pairs[1..3] == [PairStatus::NoFeatures; 2] && pairs[0] != PairStatus::NoFeatures, "{pairs:?}");
}

#[test]
fn images_of_one_pixel_are_an_outcome() {
    let folder = folder();
    for k in 0..3 {
        put(&folder, &format!("a{k}.png"), encoded(&GrayImage::new(1, 1), ImageFormat::Png));
    }
    let (pairs, unused) = tracked(&folder);
    assert_eq!((pairs, unused.len()), (vec![PairStatus::NoFeatures; 2], 3));
}

#[test]
fn nothing_of_an_earlier_job_stays_in_the_result() {
    let folder = frames(4);
    let out = folder.path().join("result");
    std::fs::create_dir_all(out.join("overlays")).expect("a folder");
    let stale = ["overlays/77.png", "attitude_chain_7.tum"].map(|name| out.join(name));
    let kept = ["overlays/mine.png", "notes.txt"].map(|name| out.join(name));
    stale.iter().chain(&kept).for_each(|path| std::fs::write(path, "").expect("written"));
    tracked(&folder);
    assert!(stale.iter().all(|path| !path.exists()) && kept.iter().all(|path| path.exists()));
}

#[test]
fn times_come_from_a_list_or_a_rate() {
    let folder = frames(3);
    put(&folder, "list.csv", "5,frame2.png\n7,frame0.png\n");
    let list = folder.path().join("list.csv");
    let times = |more: &[&str]| {
        let out = folder.path().join("result");
        opnav()
            .arg("track")
            .arg(folder.path())
            .args(["--fov-deg", "60"])
            .args(more)
            .arg("--out")
            .arg(&out)
            .assert()
            .success();
        let rotations = read_relative_rotations(&out.join("relative_rotations.csv")).expect("rotations");
        (rotations[0].t_ns_from, rotations[0].t_ns_to)
    };
    assert_eq!(times(&["--times", &list.display().to_string()]), (5, 7));
    assert_eq!(times(&["--rate-hz", "50"]), (0, 20_000_000));
    opnav().args(["track", "x", "--out", "y", "--rate-hz", "0"]).assert().code(2);
    opnav().args(["track", "x", "--out", "y", "--rate-hz", "5", "--times", "z"]).assert().code(2);
}
