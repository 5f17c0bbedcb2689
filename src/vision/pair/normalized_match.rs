//! Matches in ideal coordinates, with the noise that their pixels have there.

use super::correspondence::MatchedPair;
use crate::geometry::Camera;
use nalgebra::{Matrix2, Vector2, Vector3};

/// One point seen in two images, in ideal (undistorted) coordinates (x/z, y/z), each with its covariance.
#[derive(Debug, Clone, Copy)]
pub(super) struct NormalizedMatch {
    pub(super) from: Vector2<f64>,
    pub(super) to: Vector2<f64>,
    pub(super) from_covariance: Matrix2<f64>,
    pub(super) to_covariance: Matrix2<f64>,
}

impl NormalizedMatch {
    /// The first image's ray (x/z, y/z, 1).
    pub(super) fn first_ray(&self) -> Vector3<f64> {
        self.from.push(1.0)
    }

    /// The second image's ray (x/z, y/z, 1).
    pub(super) fn second_ray(&self) -> Vector3<f64> {
        self.to.push(1.0)
    }
}

/// Pixels of both images in ideal coordinates; `None` for a match that the distortion model cannot undo.
pub(super) fn normalized(pair: &MatchedPair, sigma_px: &[f64], camera: &Camera) -> Vec<Option<NormalizedMatch>> {
    let one = |((from_px, to_px), sigma_px): ((&Vector2<f64>, &Vector2<f64>), &f64)| {
        let (from, from_covariance) = ideal(from_px, *sigma_px, camera)?;
        let (to, to_covariance) = ideal(to_px, *sigma_px, camera)?;
        Some(NormalizedMatch { from, to, from_covariance, to_covariance })
    };
    pair.from_px.iter().zip(&pair.to_px).zip(sigma_px).map(one).collect()
}

fn ideal(pixel_px: &Vector2<f64>, sigma_px: f64, camera: &Camera) -> Option<(Vector2<f64>, Matrix2<f64>)> {
    let ideal = camera.normalize(pixel_px)?;
    let pixel_by_ideal = Matrix2::from_diagonal(&camera.focal_px) * camera.distortion.distort(&ideal).1;
    let ideal_by_pixel = pixel_by_ideal.try_inverse()?;
    Some((ideal, ideal_by_pixel * ideal_by_pixel.transpose() * sigma_px.powi(2)))
}
