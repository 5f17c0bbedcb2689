//! Tests of the room `dataset`: what is written comes back, and what is damaged is named.

mod exchange;
mod ground_map;
mod images;
mod inputs;
mod storage;
mod truth;

use image::{DynamicImage, GrayImage, Luma};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use opnav::dataset::*;
use opnav::geometry::{Camera, Distortion};
use std::fs;
use std::path::{Path, PathBuf};

pub fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

pub fn put(root: &Path, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
    let path = root.join(name);
    fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
    fs::write(&path, text).expect("a file");
    path
}

pub fn pose(x: f64) -> Isometry3<f64> {
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.1 * x, -0.2, 0.3));
    Isometry3::from_parts(Translation3::new(x, 1.0 / 3.0, -1e-7), rotation)
}

fn close(a: &Isometry3<f64>, b: &Isometry3<f64>) -> bool {
    a.translation == b.translation && a.rotation.angle_to(&b.rotation) < 1e-15
}

pub fn sensor(distortion: Distortion) -> CameraSensor {
    let camera = Camera { distortion, ..Camera::from_fov(64, 48, 1.0) };
    CameraSensor { camera, spacecraft_from_camera: pose(2.0), rate_hz: Some(20.0), bits: None }
}

/// The error's text, which has to name the file and, if given, the line and a word of the problem.
pub fn complaint<T>(result: Result<T, DatasetError>, file: &Path, line: Option<u64>, words: &[&str]) -> String {
    let Err(error) = result else { panic!("{} should have been refused ({words:?})", file.display()) };
    let text = error.to_string();
    assert!(text.contains(&file.display().to_string()), "no file in: {text}");
    if let Some(line) = line {
        assert!(text.contains(&format!("line {line}:")), "line {line} not in: {text}");
    }
    for word in words {
        assert!(text.contains(word), "'{word}' not in: {text}");
    }
    text
}

pub fn png(picture: &DynamicImage) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png).expect("a picture");
    bytes.into_inner()
}

pub fn grey(width: u32, height: u32) -> Vec<u8> {
    png(&DynamicImage::ImageLuma8(GrayImage::from_fn(width, height, |x, y| Luma([(x * 3 + y) as u8]))))
}
