//! Depth pictures and masks.

use crate::dataset::{complaint, folder};
use image::{DynamicImage, GrayImage, Luma};
use opnav::dataset::*;
use std::fs;

#[test]
fn depth_and_masks_return() {
    let dir = folder();
    let depth: Vec<f32> = (0..12).map(|k| if k == 5 { f32::NAN } else { 1234.567 * k as f32 }).collect();
    let path = dir.path().join("truth/depth/cam0/7.tiff");
    write_depth_tiff(&path, 4, 3, &depth).expect("write");
    let back = read_depth_tiff(&path).expect("read");
    assert_eq!(back.dimensions(), (4, 3));
    assert!(back.as_raw().iter().zip(&depth).all(|(a, b)| a.to_bits() == b.to_bits()));
    let mask = GrayImage::from_fn(5, 4, |x, y| Luma([(x + 5 * y) as u8]));
    let path = dir.path().join("truth/mask/cam0/7.png");
    write_grey_png(&path, &mask).expect("write");
    assert_eq!(read_mask_png(&path).expect("read"), mask);
}

#[test]
fn broken_depth_and_masks_are_named() {
    let dir = folder();
    let path = dir.path().join("1.tiff");
    complaint(read_depth_tiff(&path), &path, None, &["could not read"]);
    write_depth_tiff(&path, 4, 3, &[1.0; 12]).expect("write");
    let whole = fs::read(&path).expect("written");
    fs::write(&path, &whole[..whole.len() / 2]).expect("write");
    complaint(read_depth_tiff(&path), &path, None, &[]);
    let mut bytes = std::io::Cursor::new(Vec::new());
    DynamicImage::ImageLuma8(GrayImage::new(4, 3)).write_to(&mut bytes, image::ImageFormat::Tiff).expect("a picture");
    fs::write(&path, bytes.get_ref()).expect("write");
    complaint(read_depth_tiff(&path), &path, None, &["not a float32 picture"]);
    let path = dir.path().join("1.png");
    fs::write(&path, "not a picture").expect("write");
    complaint(read_mask_png(&path), &path, None, &[]);
    complaint(write_depth_tiff(&dir.path().join("2.tiff"), 4, 3, &[1.0; 11]), &dir.path().join("2.tiff"), None, &[]);
}
