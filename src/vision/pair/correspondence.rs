//! Pixels that correspond in two images.

use nalgebra::Vector2;

/// Pixels of the same surface points in two frames.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MatchedPair {
    /// Pixels in the first frame.
    pub from_px: Vec<Vector2<f64>>,
    /// Pixels in the second frame, in the same order.
    pub to_px: Vec<Vector2<f64>>,
}
