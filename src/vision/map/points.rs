//! Points of the map that patches find in an image.

use super::config::MapMatchConfig;
use super::fit::Pointing;
use super::ground::Meeting;
use super::result::MapSighting;
use super::view::MapView;
use crate::dataset::MapLevel;
use crate::vision::error::VisionError;
use crate::vision::features::{DetectorConfig, detect_features};
use crate::vision::patch::{KltConfig, track_patches};
use image::GrayImage;
use nalgebra::{Matrix2, Vector2};

/// A point of the map and where it was found.
#[derive(Debug, Clone, Copy)]
pub(super) struct FoundPoint {
    pub(super) meeting: Meeting,
    /// Pixel of the halved image.
    pub(super) pixel_px: Vector2<f64>,
    /// Covariance, px² of the halved image.
    pub(super) covariance_px2: Matrix2<f64>,
}

impl FoundPoint {
    pub(super) fn pointing(&self) -> Pointing {
        let sigma_px = (0.5 * self.covariance_px2.trace()).sqrt();
        Pointing { point_in_site_m: self.meeting.point_in_site_m, pixel_px: self.pixel_px, sigma_px }
    }

    /// The sighting in the whole image, which is `scale` times as large.
    pub(super) fn sighting(&self, scale: f64, level: &MapLevel) -> MapSighting {
        MapSighting {
            pixel_px: self.pixel_px * scale,
            covariance_px2: self.covariance_px2 * (scale * scale),
            point_in_site_m: self.meeting.point_in_site_m,
            sigma_horizontal_m: level.sigma_horizontal_m,
            sigma_vertical_m: level.sigma_vertical_m,
        }
    }
}

/// Corners of the drawn map, strongest first, whose patches show known ground.
pub(super) fn corners(
    view: &MapView,
    count: usize,
    half_px: u32,
    detector: &DetectorConfig,
) -> Result<Vec<Vector2<f64>>, VisionError> {
    let config = DetectorConfig { max_features: count, border_px: half_px + 3, ..detector.clone() };
    let features = detect_features(&view.image, Some(&view.known), &config)?;
    let margin_px = i64::from(half_px) + 2;
    Ok(features.iter().map(|f| f.pixel_px).filter(|p| view.knows_square(p, margin_px)).collect())
}

/// Half the side of the patches for an image of a size: small images have small ones.
pub(super) fn half_px(image: &GrayImage) -> u32 {
    (image.width().min(image.height()) / 16).clamp(5, 10)
}

/// Follows corners of the drawn map into the image, which shows nearly the same.
pub(super) fn find(
    view: &MapView,
    image: &GrayImage,
    config: &MapMatchConfig,
    detector: &DetectorConfig,
) -> Result<Vec<FoundPoint>, VisionError> {
    let half_px = half_px(image);
    let corners = corners(view, config.candidates, half_px, detector)?;
    let klt = KltConfig { half_px, noise: config.patch_noise, ..KltConfig::default() };
    let found = track_patches((&view.image, image), &corners, &|pixel_px| Some(*pixel_px), &klt)?;
    let looks_px2 = Matrix2::identity() * config.noise.looks_sigma_px.powi(2);
    let point = |(corner, found): (&Vector2<f64>, &Option<crate::vision::patch::KltPoint>)| {
        let found = found.as_ref()?;
        let covariance_px2 = found.covariance_px2 + looks_px2;
        let mut meeting = view.meet(corner)?;
        meeting.point_in_site_m.z += config.noise.standing_out * meeting.footprint_m;
        Some(FoundPoint { meeting, pixel_px: found.pixel_px, covariance_px2 })
    };
    Ok(corners.iter().zip(&found).filter_map(point).collect())
}

/// At most `most` of the points, the most exact of each neighbourhood.
pub(super) fn spread(points: &[FoundPoint], (width, height): (u32, u32), most: usize) -> Vec<FoundPoint> {
    let mut order: Vec<&FoundPoint> = points.iter().collect();
    order.sort_by(|a, b| a.covariance_px2.trace().total_cmp(&b.covariance_px2.trace()));
    let mut distance_px = (f64::from(width) * f64::from(height) / most as f64).sqrt();
    let mut chosen: Vec<FoundPoint> = Vec::new();
    while distance_px > 2.0 && chosen.len() < most {
        for point in &order {
            let apart = |other: &FoundPoint| (other.pixel_px - point.pixel_px).norm() >= distance_px;
            if chosen.len() < most && chosen.iter().all(apart) {
                chosen.push(**point);
            }
        }
        distance_px *= 0.7;
    }
    chosen
}
