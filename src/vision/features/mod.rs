//! Corners: response, maxima, sub-pixel peak with its covariance, spread over the picture, the picture's noise.

mod config;
mod even_spread;
mod feature;
mod harris;
mod harris_response;
mod image_noise;
mod line_filter;
mod local_maxima;
mod subpixel_peak;

pub use config::DetectorConfig;
pub use feature::Feature;
pub use harris::detect_harris;
pub use image_noise::noise_sigma_dn;
