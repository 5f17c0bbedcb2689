//! Corners: response, maxima, sub-pixel peak with its covariance, spread over the image, the image's noise.

mod config;
mod corner_response;
mod detect;
mod detector;
mod detector_kind;
mod even_spread;
mod feature;
mod harris;
mod harris_response;
mod image_noise;
mod line_filter;
mod local_maxima;
mod response_config;
mod responses;
mod shi_tomasi;
mod subpixel_peak;

pub use config::DetectorConfig;
pub use detect::detect_features;
pub use detector::{Detector, FusedResponse, PeakModel};
pub use detector_kind::DetectorKind;
pub use feature::Feature;
pub use image_noise::noise_sigma_dn;
pub use response_config::ResponseConfig;
pub use responses::Responses;
