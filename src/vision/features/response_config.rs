//! How an image becomes a corner response.

/// Filters about a corner response.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResponseConfig {
    /// Gaussian smoothing before, 1σ in px.
    pub smoothing_sigma_px: f64,
    /// Gaussian smoothing of the response, 1σ in px.
    pub response_sigma_px: f64,
    /// Side of the window that gathers the structure tensor, px, an odd number.
    pub block_px: u32,
    /// Harris' trace factor.
    pub harris_k: f64,
}
