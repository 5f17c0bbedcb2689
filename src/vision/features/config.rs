//! Settings of the detector.

use super::detector_kind::DetectorKind;
use super::response_config::ResponseConfig;
use crate::settings::{OutOfRange, limits};
use crate::vision::implementation::Implementation;
use crate::vision::noise_model::CornerNoise;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Detection of features.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DetectorConfig {
    /// What finds features (default harris).
    pub kind: DetectorKind,
    /// Whose code does it (default opencv): `fused` is Harris alone, and faster; for others it means OpenCV's, too.
    pub implementation: Implementation,
    /// Most features an image, 1 or more (default 1000).
    pub max_features: usize,
    /// Gaussian smoothing before detection, 1σ in px, above 0 (default 1.0).
    pub smoothing_sigma_px: f64,
    /// Gaussian smoothing of the response, 1σ in px, above 0 (default 0.8).
    pub response_sigma_px: f64,
    /// Side of the window that gathers the structure tensor, px, an odd number, 3 or more (default 5).
    pub block_px: u32,
    /// Harris' trace factor k, above 0 (default 0.04), used with that detector only.
    pub harris_k: f64,
    /// Least response as a fraction of the strongest, above 0 (default 1e-5), of a response that grows with the fourth power
    /// of the slopes, as Harris' does; noise is refused by `max_sigma_px`.
    pub min_response_ratio: f64,
    /// Least distance between features, px, above 0 (default 5).
    pub min_distance_px: f64,
    /// Features closer to the image's edge are dropped, px, 4 or more (default 16).
    pub border_px: u32,
    /// Peaks of the response with a greater width are too blunt to be found again at the same place, px,
    /// above 0 (default 2.2).
    pub max_peak_width_px: f64,
    /// Features with a greater predicted 1σ are dropped, px, above 0 (default 0.4).
    pub max_sigma_px: f64,
    /// How wrong corners are (default: the noise model's).
    pub noise: CornerNoise,
}

impl Default for DetectorConfig {
    fn default() -> Self {
        DetectorConfig {
            kind: DetectorKind::default(),
            implementation: Implementation::default(),
            max_features: 1000,
            smoothing_sigma_px: 1.0,
            response_sigma_px: 0.8,
            block_px: 5,
            harris_k: 0.04,
            min_response_ratio: 1e-5,
            min_distance_px: 5.0,
            border_px: 16,
            max_peak_width_px: 2.2,
            max_sigma_px: 0.4,
            noise: CornerNoise::default(),
        }
    }
}

impl DetectorConfig {
    /// The filters about the response.
    pub(super) fn response(&self) -> ResponseConfig {
        let DetectorConfig { smoothing_sigma_px, response_sigma_px, block_px, harris_k, .. } = *self;
        ResponseConfig { smoothing_sigma_px, response_sigma_px, block_px, harris_k }
    }

    /// Checks every range.
    ///
    /// # Errors
    /// Names the key.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::count_from("max_features", self.max_features, 1)?;
        limits::positive("smoothing_sigma_px", self.smoothing_sigma_px)?;
        limits::positive("response_sigma_px", self.response_sigma_px)?;
        limits::count_from("block_px", self.block_px as usize, 3)?;
        if self.block_px.is_multiple_of(2) {
            return Err(OutOfRange::new("block_px", self.block_px, "it must be odd"));
        }
        limits::positive("harris_k", self.harris_k)?;
        limits::positive("min_response_ratio", self.min_response_ratio)?;
        limits::positive("min_distance_px", self.min_distance_px)?;
        limits::count_from("border_px", self.border_px as usize, 4)?;
        limits::positive("max_peak_width_px", self.max_peak_width_px)?;
        limits::positive("max_sigma_px", self.max_sigma_px)?;
        self.noise.validate().map_err(|e| e.under("noise"))
    }
}
