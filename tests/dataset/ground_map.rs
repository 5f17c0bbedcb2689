//! The folder of a map: what is written is read back, and what is wrong with it is named.

use super::{complaint, folder, put};
use image::{GrayImage, ImageBuffer, Luma};
use nalgebra::Vector2;
use opnav::dataset::*;
use std::fs;
use std::path::Path;

fn level(metres_per_px: f64, heights_m: Vec<f32>) -> MapLevel {
    MapLevel {
        metres_per_px,
        first_in_site_m: Vector2::new(-1.0 / 3.0, 2.0),
        image: ImageBuffer::from_fn(4, 3, |u, v| Luma([(u * 1000 + v * 17) as u16])),
        heights_m,
        sigma_horizontal_m: 0.1 * metres_per_px,
        sigma_vertical_m: 0.25,
    }
}

fn map() -> GroundMap {
    let heights = |scale: f32| (0..12).map(|k| scale * k as f32).collect();
    GroundMap { levels: vec![level(0.5, heights(1.0)), level(2.0, heights(-3.0))] }
}

fn written(root: &Path) -> String {
    write_ground_map(root, &map()).expect("written");
    fs::read_to_string(root.join("map.toml")).expect("a text")
}

#[test]
fn a_map_returns_every_digit() {
    let dir = folder();
    written(dir.path());
    assert_eq!(read_ground_map(dir.path()).expect("read"), map());
    assert!(fs::read_dir(dir.path()).expect("listed").count() == 5, "nothing but the map is left");
}

#[test]
fn places_and_heights_follow_the_stated_axes() {
    let level = level(0.5, (0..12).map(|k| k as f32).collect());
    assert_eq!(level.place_of(&Vector2::new(2.0, 1.0)), Vector2::new(-1.0 / 3.0 + 1.0, 1.5));
    assert!((level.pixel_of(&level.place_of(&Vector2::new(1.25, 0.75))) - Vector2::new(1.25, 0.75)).norm() < 1e-12);
    let height = |u: f64, v: f64| level.height_m(&level.place_of(&Vector2::new(u, v)));
    assert!((height(1.25, 0.75).expect("inside") - (1.25 + 4.0 * 0.75)).abs() < 1e-6);
    assert_eq!(height(3.0, 2.0), Some(11.0));
    assert_eq!((height(-0.01, 1.0), height(1.0, 2.01), height(f64::NAN, 1.0)), (None, None, None));
}

#[test]
fn unknown_heights_are_unknown_and_a_coarser_level_stands_in() {
    let dir = folder();
    let mut map = map();
    map.levels[0].heights_m[5] = f32::NAN;
    map.levels[1].heights_m[11] = f32::INFINITY;
    write_ground_map(dir.path(), &map).expect("written");
    let map = read_ground_map(dir.path()).expect("read");
    let hole = map.levels[0].place_of(&Vector2::new(1.2, 0.9));
    assert_eq!(map.levels[0].height_m(&hole), None);
    assert_eq!(map.height_m(&hole).expect("the coarser level").0, 1);
    let corner = map.levels[1].place_of(&Vector2::new(2.5, 1.5));
    assert_eq!(map.levels[1].height_m(&corner), None, "infinite heights are no heights");
    assert_eq!(map.height_m(&map.levels[0].place_of(&Vector2::new(2.5, 0.5))).expect("the finer level").0, 0);
}

#[test]
fn eight_bits_span_the_same_range_as_sixteen() {
    let dir = folder();
    written(dir.path());
    let picture = GrayImage::from_fn(4, 3, |u, _| Luma([if u == 0 { 0 } else { 255 }]));
    picture.save(dir.path().join("ortho_0.png")).expect("saved");
    let map = read_ground_map(dir.path()).expect("read");
    assert_eq!((map.levels[0].image[(0, 0)].0[0], map.levels[0].image[(3, 2)].0[0]), (0, u16::MAX));
}

#[test]
fn faults_of_map_toml_are_named() {
    let dir = folder();
    let file = dir.path().join("map.toml");
    complaint(read_ground_map(dir.path()), &file, None, &["missing", "opnav map"]);
    let text = written(dir.path());
    let with = |from: &str, to: &str| {
        assert!(text.contains(from), "{from} not in {text}");
        put(dir.path(), "map.toml", text.replacen(from, to, 1));
        read_ground_map(dir.path())
    };
    complaint(with("metres_per_px = 0.5", "metres_per_px = \"x\""), &file, Some(6), &["string"]);
    complaint(with("first_x_m", "first_z_m"), &file, Some(7), &["first_z_m"]);
    complaint(with("format = 1", "format = 9"), &file, None, &["format is 9"]);
    complaint(
        with("metres_per_px = 0.5", "metres_per_px = -0.5"),
        &file,
        None,
        &["levels[0].metres_per_px", "positive"],
    );
    complaint(with("first_y_m = 2.0", "first_y_m = inf"), &file, None, &["levels[0].first_y_m", "finite"]);
    complaint(with("sigma_vertical_m = 0.25", "sigma_vertical_m = nan"), &file, None, &["sigma_vertical_m"]);
    complaint(with("metres_per_px = 2.0", "metres_per_px = 0.5"), &file, None, &["levels[1]", "fine to coarse"]);
    complaint(
        with("heights_1.tiff", "elsewhere.tiff"),
        &dir.path().join("elsewhere.tiff"),
        None,
        &["missing", "map.toml"],
    );
    put(dir.path(), "map.toml", "format = 1\nlevels = []\n");
    complaint(read_ground_map(dir.path()), &file, None, &["at least one"]);
}

#[test]
fn faults_of_rasters_are_named() {
    let dir = folder();
    written(dir.path());
    let heights = dir.path().join("heights_1.tiff");
    write_depth_tiff(&heights, 3, 3, &[1.0; 9]).expect("written");
    complaint(read_ground_map(dir.path()), &heights, None, &["3x3", "4x3"]);
    write_depth_tiff(&heights, 4, 3, &[f32::NAN; 12]).expect("written");
    complaint(read_ground_map(dir.path()), &heights, None, &["NaN"]);
    put(dir.path(), "heights_1.tiff", "no picture");
    complaint(read_ground_map(dir.path()), &heights, None, &[]);
    fs::remove_file(&heights).expect("removed");
    complaint(read_ground_map(dir.path()), &heights, None, &["missing", "map.toml"]);
    written(dir.path());
    let picture = dir.path().join("ortho_0.png");
    write_depth_tiff(&dir.path().join("real.tiff"), 4, 3, &[0.5; 12]).expect("written");
    fs::rename(dir.path().join("real.tiff"), &picture).expect("renamed");
    complaint(read_ground_map(dir.path()), &picture, None, &["floating-point"]);
    GrayImage::new(1, 3).save(&picture).expect("saved");
    complaint(read_ground_map(dir.path()), &picture, None, &["1x3"]);
}
