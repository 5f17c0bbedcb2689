//! The Harris response of a picture, in one pass over its lines.

use super::config::DetectorConfig;
use super::line_filter::{Lines, Padded, along, down, gaussian};
use std::cell::Cell;

/// A smoothed picture (grey levels / 255) and its smoothed Harris response, row by row.
#[derive(Default)]
pub(super) struct Responses {
    pub(super) smooth: Vec<f32>,
    pub(super) response: Vec<f32>,
}

/// Rooms larger than this are not kept for the next picture, px.
const MOST_KEPT: usize = 1 << 24;

thread_local! {
    /// Room of the thread's last picture: fresh memory costs about as much as the filters do.
    static ROOM: Cell<Responses> = const { Cell::new(Responses { smooth: Vec::new(), response: Vec::new() }) };
}

impl Responses {
    /// Gives the room back for the thread's next picture.
    pub(super) fn put_back(self) {
        if self.smooth.len() <= MOST_KEPT {
            ROOM.set(self);
        }
    }

    fn with_room(count: usize) -> Self {
        let mut room = ROOM.take();
        room.smooth.resize(count, 0.0);
        room.response.resize(count, 0.0);
        room
    }
}

/// Smooths a picture, gathers its structure tensor from Sobel's slopes over a square, and smooths Harris' response to it.
pub(super) fn responses(grey: &[u8], size: (usize, usize), config: &DetectorConfig) -> Responses {
    let mut found = Responses::with_room(size.0 * size.1);
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2")]
        fn with_avx2(grey: &[u8], size: (usize, usize), config: &DetectorConfig, found: &mut Responses) {
            pass(grey, size, config, found);
        }
        if is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has the instructions that the function is compiled for.
            unsafe { with_avx2(grey, size, config, &mut found) };
            return found;
        }
    }
    pass(grey, size, config, &mut found);
    found
}

#[inline(always)]
fn pass(grey: &[u8], size: (usize, usize), config: &DetectorConfig, found: &mut Responses) {
    let (width, height) = size;
    let weights = [config.smoothing_sigma_px, config.response_sigma_px].map(gaussian);
    let [reach_smooth, reach_response] = weights.each_ref().map(|w| w.len() - 1);
    let block = vec![1.0; config.block_px as usize / 2 + 1];
    let reach_block = block.len() - 1;
    let mut bytes = Lines::new(size, reach_smooth);
    let mut smooth = Lines::new(size, 1);
    let mut tensor = [0; 3].map(|_| Lines::new(size, reach_block));
    let mut sharp = Lines::new(size, reach_response);
    let mut line = Padded::new(width, reach_smooth.max(reach_block).max(reach_response).max(1));
    let mut slopes = Slopes::new(width);
    let mut sums = [0; 3].map(|_| vec![0.0; width]);
    let ahead = |y: usize, reach: usize| (y + reach + 1).min(height);
    for y in 0..height {
        while sharp.made < ahead(y, reach_response) {
            while tensor[0].made < ahead(sharp.made, reach_block) {
                while smooth.made < ahead(tensor[0].made, 1) {
                    let y = smooth.made;
                    while bytes.made < ahead(y, reach_smooth) {
                        let row = &grey[bytes.made * width..][..width];
                        bytes.next().iter_mut().zip(row).for_each(|(v, b)| *v = f32::from(*b) * (1.0 / 255.0));
                    }
                    down(&bytes, y, &weights[0], &mut line);
                    along(&mut line, &weights[0], smooth.next());
                    found.smooth[y * width..][..width].copy_from_slice(smooth.line(y as isize));
                }
                slopes.products(&smooth, tensor[0].made, config.block_px, &mut tensor);
            }
            let y = sharp.made;
            for (tensor, sum) in tensor.iter().zip(&mut sums) {
                down(tensor, y, &block, &mut line);
                along(&mut line, &block, sum);
            }
            harris(&sums, config.harris_k as f32, sharp.next());
        }
        down(&sharp, y, &weights[1], &mut line);
        along(&mut line, &weights[1], &mut found.response[y * width..][..width]);
    }
}

/// Room for a line's slopes.
struct Slopes {
    even: Padded,
    steep: Padded,
}

impl Slopes {
    fn new(width: usize) -> Self {
        Slopes { even: Padded::new(width, 1), steep: Padded::new(width, 1) }
    }

    /// The next line of the products of Sobel's slopes: u·u, u·v, v·v, scaled to the mean of a block of `block_px` a side.
    #[inline(always)]
    fn products(&mut self, smooth: &Lines, y: usize, block_px: u32, tensor: &mut [Lines; 3]) {
        let scale = 1.0 / (4.0 * block_px as f32);
        let [above, here, below] = [-1, 0, 1].map(|k| smooth.line(y as isize + k));
        let lines = above.iter().zip(here).zip(below);
        for (((a, h), b), (even, steep)) in lines.zip(self.even.inside().iter_mut().zip(self.steep.inside())) {
            *even = a + 2.0 * h + b;
            *steep = b - a;
        }
        self.even.mirror_edges();
        self.steep.mirror_edges();
        let [uu, uv, vv] = tensor;
        let out = uu.next().iter_mut().zip(uv.next()).zip(vv.next());
        let [left, right] = [-1, 1].map(|by| self.even.shifted(by));
        let [before, middle, after] = [-1, 0, 1].map(|by| self.steep.shifted(by));
        let slopes = left.iter().zip(right).zip(before.iter().zip(middle).zip(after));
        for (((uu, uv), vv), ((left, right), ((before, middle), after))) in out.zip(slopes) {
            let (u, v) = ((right - left) * scale, (before + 2.0 * middle + after) * scale);
            (*uu, *uv, *vv) = (u * u, u * v, v * v);
        }
    }
}

/// `det − k trace²` of the tensors of a line.
#[inline(always)]
fn harris([uu, uv, vv]: &[Vec<f32>; 3], k: f32, out: &mut [f32]) {
    for (((value, a), b), c) in out.iter_mut().zip(uu).zip(uv).zip(vv) {
        *value = a * c - b * b - k * (a + c) * (a + c);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::random_stream;
    use crate::vision::opencv_bridge::picture_mat;
    use image::GrayImage;
    use opencv::core::{BORDER_REFLECT_101, CV_32F, Mat, Size};
    use opencv::imgproc::{corner_harris, gaussian_blur};
    use opencv::prelude::*;
    use rand::RngExt;

    /// The same by OpenCV.
    fn by_opencv(picture: &GrayImage, config: &DetectorConfig) -> opencv::Result<(Mat, Mat)> {
        let (mut grey, mut smooth, mut sharp, mut response) =
            (Mat::default(), Mat::default(), Mat::default(), Mat::default());
        picture_mat(picture)?.convert_to(&mut grey, CV_32F, 1.0 / 255.0, 0.0)?;
        let blur = |from: &Mat, to: &mut Mat, sigma_px: f64| {
            gaussian_blur(from, to, Size::new(0, 0), sigma_px, sigma_px, BORDER_REFLECT_101)
        };
        blur(&grey, &mut smooth, config.smoothing_sigma_px)?;
        corner_harris(&smooth, &mut sharp, config.block_px as i32, 3, config.harris_k, BORDER_REFLECT_101)?;
        blur(&sharp, &mut response, config.response_sigma_px)?;
        Ok((smooth, response))
    }

    /// Greatest difference from OpenCV's smoothed picture and response, each over the greatest value.
    fn off(size: (u32, u32), ours: &DetectorConfig, theirs: &DetectorConfig) -> [f32; 2] {
        let mut random = random_stream(3, "picture", 0);
        let picture = GrayImage::from_fn(size.0, size.1, |_, _| image::Luma([random.random()]));
        let found = responses(picture.as_raw(), (size.0 as usize, size.1 as usize), ours);
        let (smooth, response) = by_opencv(&picture, theirs).expect("OpenCV filters");
        let greatest = |ours: &[f32], theirs: &Mat| {
            let theirs: &[f32] = theirs.data_typed().expect("numbers");
            let most = |values: &mut dyn Iterator<Item = f32>| values.fold(0.0, |a, b| f32::max(a, b.abs()));
            most(&mut ours.iter().zip(theirs).map(|(a, b)| a - b)) / most(&mut theirs.iter().copied())
        };
        [greatest(&found.smooth, &smooth), greatest(&found.response, &response)]
    }

    #[test]
    fn the_response_is_opencvs_but_for_rounding() {
        let usual = DetectorConfig::default();
        let wide = DetectorConfig {
            smoothing_sigma_px: 2.1,
            response_sigma_px: 1.7,
            block_px: 9,
            harris_k: 0.06,
            ..usual.clone()
        };
        for (size, config) in [((97, 64), &usual), ((97, 64), &wide), ((5, 7), &usual), ((7, 4), &wide)] {
            let [smooth, response] = off(size, config, config);
            assert!(smooth < 1e-5 && response < 2e-5, "{size:?}: {smooth}, {response}");
        }
        let [smooth, response] = off((97, 64), &usual, &DetectorConfig { block_px: 7, ..usual.clone() });
        assert!(smooth < 1e-5 && response > 0.1, "{smooth}, {response}");
    }
}
