//! What a map says of an image.

use nalgebra::{Isometry3, Matrix2, Vector2, Vector3};

/// A point of the map that was found in an image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapSighting {
    /// Pixel (u, v) of the image.
    pub pixel_px: Vector2<f64>,
    /// Covariance of the pixel, px². What all sightings of an image have in common is in it as many times as there are
    /// sightings: taken as independent, they are right about the pose together.
    pub covariance_px2: Matrix2<f64>,
    /// The point in the site frame, m.
    pub point_in_site_m: Vector3<f64>,
    /// 1σ of the map's own error along each horizontal axis, m.
    pub sigma_horizontal_m: f64,
    /// 1σ of the map's own error in height, m.
    pub sigma_vertical_m: f64,
}

impl MapSighting {
    /// 1σ averaged over both coordinates, px.
    pub fn sigma_px(&self) -> f64 {
        (0.5 * self.covariance_px2.trace()).sqrt()
    }
}

/// How an image was matched with the map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MapStatus {
    /// By patches at their predicted places.
    Tracked,
    /// By descriptors, then by patches.
    Acquired,
    /// The map does not cover enough of the predicted view.
    OffMap,
    /// Too few points were found, or too few agree with one pose.
    Lost,
}

/// What became of one image.
#[derive(Debug, Clone, PartialEq)]
pub struct MapFix {
    /// How it was matched.
    pub status: MapStatus,
    /// The points, spread over the image; none unless tracked or acquired.
    pub sightings: Vec<MapSighting>,
    /// The pose that fits all agreeing points best, the prediction counted in with its 1σ; the prediction itself where
    /// there are none.
    pub camera_from_site: Isometry3<f64>,
    /// Points found in the image.
    pub found: usize,
    /// Points that agree with the pose.
    pub agreeing: usize,
    /// R.m.s. of the agreeing points' residuals, px of the image.
    pub residual_px: f64,
    /// Edge of the pixels that were compared, over that of the image's: how often it was halved.
    pub scale: f64,
}
