//! Harris corners (Harris and Stephens 1988).

use super::detector::{Detector, FusedResponse, PeakModel};
use super::harris_response::fused_responses;
use super::response_config::ResponseConfig;
use opencv::core::{BORDER_REFLECT_101, Mat};
use opencv::imgproc::corner_harris;

/// The detector whose response is `det − k trace²` of the structure tensor.
pub(super) struct Harris;

impl Detector for Harris {
    fn peaks(&self) -> PeakModel {
        PeakModel { slope_power: 4.0, change_over_harris: 1.0, noise_over_harris: 1.0 }
    }

    fn respond(&self, smooth: &Mat, config: &ResponseConfig, response: &mut Mat) -> opencv::Result<()> {
        corner_harris(smooth, response, config.block_px as i32, 3, config.harris_k, BORDER_REFLECT_101)
    }

    fn fused(&self) -> Option<FusedResponse> {
        Some(fused_responses)
    }
}

#[cfg(test)]
mod tests {
    use super::super::corner_response::responses_by_opencv;
    use super::*;
    use crate::stats::random_stream;
    use image::GrayImage;
    use opencv::prelude::*;
    use rand::RngExt;

    /// Greatest difference of our smoothed image and response from OpenCV's, each over the greatest value.
    fn off(size: (u32, u32), ours: &ResponseConfig, theirs: &ResponseConfig) -> [f32; 2] {
        let mut random = random_stream(3, "picture", 0);
        let image = GrayImage::from_fn(size.0, size.1, |_, _| image::Luma([random.random()]));
        let found = fused_responses(&image, ours).expect("one pass");
        let other = responses_by_opencv(&Harris, &image, theirs).expect("OpenCV filters");
        let greatest = |ours: &Mat, theirs: &Mat| {
            let [ours, theirs]: [&[f32]; 2] = [ours, theirs].map(|m| m.data_typed().expect("numbers"));
            let most = |values: &mut dyn Iterator<Item = f32>| values.fold(0.0, |a, b| f32::max(a, b.abs()));
            most(&mut ours.iter().zip(theirs).map(|(a, b)| a - b)) / most(&mut theirs.iter().copied())
        };
        [greatest(&found.smooth, &other.smooth), greatest(&found.response, &other.response)]
    }

    #[test]
    fn the_response_is_opencvs_but_for_rounding() {
        let usual = ResponseConfig { smoothing_sigma_px: 1.0, response_sigma_px: 0.8, block_px: 5, harris_k: 0.04 };
        let wide = ResponseConfig { smoothing_sigma_px: 2.1, response_sigma_px: 1.7, block_px: 9, harris_k: 0.06 };
        let cases = [((97, 64), usual), ((97, 64), wide), ((64, 150), wide), ((5, 7), usual), ((7, 4), wide)];
        for (size, config) in cases {
            let [smooth, response] = off(size, &config, &config);
            assert!(smooth < 1e-5 && response < 2e-5, "{size:?}: {smooth}, {response}");
        }
        let [smooth, response] = off((97, 64), &usual, &ResponseConfig { block_px: 7, ..usual });
        assert!(smooth < 1e-5 && response > 0.1, "{smooth}, {response}");
    }
}
