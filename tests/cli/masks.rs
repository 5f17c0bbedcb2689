//! `opnav track --mask`: refused with a reason, or kept to.

use super::{assert_names, opnav, tracking_error};
use crate::vision::texture::picture;
use image::{GrayImage, Luma};
use nalgebra::Vector2;
use opnav::observations::read_tracks;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

const SIDE: u32 = 256;

fn folder() -> TempDir {
    let folder = TempDir::new().expect("a temporary folder");
    for k in 0..3u32 {
        let moved = move |p: Vector2<f64>| p + Vector2::new(3.0, -2.0) * f64::from(k);
        picture(SIDE, SIDE, 1.0, k.into(), moved).save(folder.path().join(format!("a{k}.png"))).expect("written");
    }
    folder
}

fn mask(folder: &Path, make: impl FnOnce(&Path)) -> PathBuf {
    let path = folder.join("mask-file.png");
    make(&path);
    path
}

#[test]
fn a_mask_that_does_not_fit_is_refused_by_name() {
    let (pictures, masks) = (folder(), TempDir::new().expect("a temporary folder"));
    let error = |path: &Path| {
        tracking_error(pictures.path(), &["--fov-deg", "60", "--mask", path.to_str().expect("a plain path")])
    };
    let small = mask(masks.path(), |p| GrayImage::new(SIDE, 64).save(p).expect("written"));
    assert_names(&error(&small), &["mask-file.png", "256x64", "256x256"]);
    let text = mask(masks.path(), |p| std::fs::write(p, "no picture").expect("written"));
    assert_names(&error(&text), &["mask-file.png", "cannot be read"]);
    let cut = mask(masks.path(), |p| {
        GrayImage::from_fn(SIDE, SIDE, |u, v| Luma([(u * v) as u8])).save(p).expect("written");
        let bytes = std::fs::read(p).expect("read");
        std::fs::write(p, &bytes[..bytes.len() / 2]).expect("written");
    });
    assert_names(&error(&cut), &["mask-file.png", "cannot be read"]);
    let deep = mask(masks.path(), |p| {
        image::ImageBuffer::from_pixel(SIDE, SIDE, Luma([9u16])).save(p).expect("written");
    });
    assert_names(&error(&deep), &["mask-file.png", "8 bits"]);
    let closed = mask(masks.path(), |p| GrayImage::new(SIDE, SIDE).save(p).expect("written"));
    assert_names(&error(&closed), &["nothing to look at"]);
    assert_names(&error(Path::new("/nonexistent/mask.png")), &["/nonexistent/mask.png", "missing"]);
}

#[test]
fn tracks_stay_where_the_mask_lets_them() {
    let (pictures, masks) = (folder(), TempDir::new().expect("a temporary folder"));
    let half = GrayImage::from_fn(SIDE, SIDE, |u, _| Luma([if u < SIDE / 2 { 0 } else { 1 }]));
    let path = mask(masks.path(), |p| half.save(p).expect("written"));
    let left = |more: &[&str]| {
        let out = masks.path().join(format!("out{}", more.len()));
        let command = &mut opnav();
        command.arg("track").arg(pictures.path()).args(["--fov-deg", "60"]).args(more).arg("--out").arg(&out);
        command.assert().success();
        let tracks = read_tracks(&out.join("tracks.csv")).expect("tracks");
        assert!(tracks.len() > 30, "{} observations", tracks.len());
        tracks.iter().filter(|o| o.pixel_px.x < f64::from(SIDE) / 2.0 + 9.0).count()
    };
    assert_eq!(left(&["--mask", path.to_str().expect("a plain path")]), 0);
    assert!(left(&[]) > 30, "without the mask, the left half is used");
}
