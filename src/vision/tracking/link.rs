//! How a track goes from one image to the next.

use nalgebra::{Matrix2, Vector2};

/// Where a feature of the first image lies in the second one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    /// Pixel in the second image.
    pub(super) to_px: Vector2<f64>,
    /// 1σ of each coordinate in px.
    pub(super) sigma_px: f64,
    /// How the image is stretched about the feature, second by first.
    pub(super) linear: Matrix2<f64>,
}

/// How patches are stretched before they are aligned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stretch {
    /// As the matches about them say.
    OfMatches,
    /// By their own grey levels too.
    Own,
}

/// Where a track is in one image.
#[derive(Debug, Clone, Copy)]
pub(super) struct TrackPoint {
    pub(super) number: u64,
    pub(super) pixel_px: Vector2<f64>,
    /// 1σ of the drift off the point of the first sight, px.
    pub(super) sigma_px: f64,
    /// Links so far that no matched corner made.
    pub(super) followed: u32,
}

/// A point in two images, with the 1σ of the second pixel given the first, px.
pub(super) type SharedPoint = (Vector2<f64>, Vector2<f64>, f64);
