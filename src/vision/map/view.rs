//! What a camera would see of the map.

use super::ground::{MapGround, Meeting};
use crate::geometry::Camera;
use image::GrayImage;
use nalgebra::{Isometry3, Matrix3, Vector2, Vector3};
use rayon::prelude::*;

/// Grey level of the mean, and of one standard deviation, of a drawn view.
const MEAN_DN: f32 = 128.0;
const SPREAD_DN: f32 = 45.0;

/// An image of the map.
pub(super) struct MapView<'a> {
    ground: &'a MapGround,
    camera: Camera,
    origin_in_site_m: Vector3<f64>,
    site_from_camera: Matrix3<f64>,
    /// The image, its contrast stretched; grey where the map knows nothing.
    pub(super) image: GrayImage,
    /// 255 where the map knows the ground, 0 elsewhere.
    pub(super) known: GrayImage,
    /// Share of the pixels that show known ground.
    pub(super) covered: f64,
}

impl<'a> MapView<'a> {
    /// Draws the map as a camera at a pose sees it.
    pub(super) fn draw(ground: &'a MapGround, camera: &Camera, camera_from_site: &Isometry3<f64>) -> Self {
        let (width, height) = camera.size_px();
        let mut view = MapView {
            ground,
            camera: *camera,
            origin_in_site_m: camera_from_site.inverse().translation.vector,
            site_from_camera: camera_from_site.rotation.inverse().to_rotation_matrix().into_inner(),
            image: GrayImage::default(),
            known: GrayImage::default(),
            covered: 0.0,
        };
        let row = |v: u32| {
            let mut height_m = ground.mean_height_m();
            let pixel = |u: u32| {
                let meeting = view.meet_from(&Vector2::new(f64::from(u), f64::from(v)), height_m)?;
                height_m = meeting.point_in_site_m.z;
                ground.brightness(&meeting)
            };
            (0..width).map(pixel).map(|value| value.unwrap_or(f32::NAN)).collect::<Vec<f32>>()
        };
        let values: Vec<f32> = (0..height).into_par_iter().flat_map_iter(row).collect();
        let known: Vec<u8> = values.iter().map(|v| if v.is_nan() { 0 } else { 255 }).collect();
        view.covered = known.iter().filter(|k| **k > 0).count() as f64 / known.len() as f64;
        view.image = GrayImage::from_raw(width, height, stretched(&values)).expect("a byte a pixel");
        view.known = GrayImage::from_raw(width, height, known).expect("a byte a pixel");
        view
    }

    /// The ground at a pixel.
    pub(super) fn meet(&self, pixel_px: &Vector2<f64>) -> Option<Meeting> {
        self.meet_from(pixel_px, self.ground.mean_height_m())
    }

    fn meet_from(&self, pixel_px: &Vector2<f64>, height_m: f64) -> Option<Meeting> {
        let direction = self.site_from_camera * self.camera.normalize(pixel_px)?.push(1.0);
        self.ground.meet((&self.origin_in_site_m, &direction), 1.0 / self.camera.mean_focal_px(), height_m)
    }

    /// Whether the square of `2 half + 1` px a side about a pixel shows known ground at its corners, the middles of its
    /// sides and its centre.
    pub(super) fn knows_square(&self, pixel_px: &Vector2<f64>, half_px: i64) -> bool {
        let (width, height) = (i64::from(self.known.width()), i64::from(self.known.height()));
        let (u, v) = (pixel_px.x.round() as i64, pixel_px.y.round() as i64);
        let steps = [-half_px, 0, half_px];
        steps.iter().all(|dv| {
            steps.iter().all(|du| {
                let (x, y) = (u + du, v + dv);
                (0..width).contains(&x) && (0..height).contains(&y) && self.known[(x as u32, y as u32)].0[0] > 0
            })
        })
    }
}

/// Grey levels with a mean and a spread that use the eight bits.
fn stretched(values: &[f32]) -> Vec<u8> {
    let known = || values.iter().filter(|v| !v.is_nan()).map(|v| f64::from(*v));
    let count = known().count().max(1) as f64;
    let mean = known().sum::<f64>() / count;
    let spread = (known().map(|v| (v - mean).powi(2)).sum::<f64>() / count).sqrt().max(1e-9);
    let grey = |v: &f32| {
        let value = if v.is_nan() { 0.0 } else { (*v - mean as f32) / spread as f32 };
        (MEAN_DN + SPREAD_DN * value).round().clamp(0.0, 255.0) as u8
    };
    values.iter().map(grey).collect()
}
