//! The Harris response of an image, in one pass over its lines.

use super::line_filter::{Lines, Padded, along, down, gaussian};
use super::response_config::ResponseConfig;
use super::responses::Responses;
use image::GrayImage;
use opencv::core::{CV_32F, Mat, Size};
use opencv::prelude::*;

/// Where the pass writes, row by row.
struct Planes<'a> {
    smooth: &'a mut [f32],
    response: &'a mut [f32],
}

/// The same as OpenCV's but for rounding: smooths an image, gathers its structure tensor from Sobel's slopes over a
/// square, and smooths Harris' response to it.
pub(super) fn fused_responses(image: &GrayImage, config: &ResponseConfig) -> opencv::Result<Responses> {
    let (width, height) = image.dimensions();
    let mut found = Responses::take();
    for plane in [&mut found.smooth, &mut found.response] {
        if plane.size()? != Size::new(width as i32, height as i32) {
            *plane = Mat::zeros(height as i32, width as i32, CV_32F)?.to_mat()?;
        }
    }
    let planes = Planes { smooth: found.smooth.data_typed_mut()?, response: found.response.data_typed_mut()? };
    fill(image.as_raw(), (width as usize, height as usize), config, planes);
    Ok(found)
}

fn fill(grey: &[u8], size: (usize, usize), config: &ResponseConfig, found: Planes) {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2")]
        fn with_avx2(grey: &[u8], size: (usize, usize), config: &ResponseConfig, found: Planes) {
            pass(grey, size, config, found);
        }
        if is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has the instructions that the function is compiled for.
            unsafe { with_avx2(grey, size, config, found) };
            return;
        }
    }
    pass(grey, size, config, found);
}

#[inline(always)]
fn pass(grey: &[u8], size: (usize, usize), config: &ResponseConfig, found: Planes) {
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
