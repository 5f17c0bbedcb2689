//! One sighting of a track.

use nalgebra::Vector2;

/// Where one track was seen in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackObservation {
    /// Time of the frame in ns.
    pub t_ns: i64,
    /// The track's number; the same number is the same surface point. The designated point is [`Self::DESIGNATED`].
    pub track_id: u64,
    /// Pixel (u, v).
    pub pixel_px: Vector2<f64>,
    /// 1σ of each coordinate in px.
    pub sigma_px: f64,
    /// Harris response, 0 where there is none (the designated point).
    pub response: f64,
}

impl TrackObservation {
    /// Track number of the designated landing point.
    pub const DESIGNATED: u64 = 0;
}
