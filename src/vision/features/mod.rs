//! Corners, from response to covariance. `detect` is the recipe; a `detector` is a response and what is known of its
//! peaks (`harris` through `harris_response` and `line_filter`, its hot loops; `shi_tomasi`), and `detector_kind` the
//! list of all. `local_maxima` and `subpixel_peak` find and place peaks, `even_spread` chooses among them,
//! `image_noise` measures the noise that the covariance of each `feature` comes from. Nothing here knows a second
//! image.

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
