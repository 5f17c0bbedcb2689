//! Local maxima of a corner response.
//!
//! Of equal neighbours the first in reading order is the maximum.

use super::corner_response::BAND;
use image::GrayImage;
use opencv::core::{CMP_EQ, Mat, Point, Scalar, Vector, compare, find_non_zero, max, min_max_loc, no_array};
use opencv::imgproc::dilate_def;
use opencv::prelude::*;

/// Which maxima count.
pub(super) struct Peaks<'a> {
    /// Those this far off the edges, px.
    pub(super) border_px: usize,
    /// Those of at least this fraction of the greatest response.
    pub(super) least_ratio: f32,
    /// Where it is given, those where it is not zero.
    pub(super) mask: Option<&'a GrayImage>,
}

impl Peaks<'_> {
    /// Least response that counts beside the greatest one.
    fn least(&self, greatest: f32) -> f32 {
        (greatest * self.least_ratio).max(1e-12)
    }

    fn is_clear(&self, at: usize) -> bool {
        self.mask.is_none_or(|m| m.as_raw()[at] != 0)
    }
}

/// Local maxima of a response, as (response, index) in reading order, by OpenCV: what a dilation leaves as it is.
pub(super) fn maxima_by_opencv(response: &Mat, peaks: &Peaks) -> opencv::Result<Vec<(f32, usize)>> {
    let mut greatest = 0.0;
    min_max_loc(response, None, Some(&mut greatest), None, None, &no_array())?;
    let least = f64::from(peaks.least(greatest.max(0.0) as f32));
    let (width, border) = (response.cols() as usize, peaks.border_px.max(1) as i32);
    let (mut dilated, mut summits, mut flags) = (Mat::default(), Mat::default(), Mat::default());
    let mut found = Vec::new();
    for first in (border..response.rows() - border).step_by(BAND as usize) {
        let last = (first + BAND).min(response.rows() - border);
        let band = response.row_bounds(first - 1, last + 1)?;
        dilate_def(&band, &mut dilated, &Mat::default())?;
        max(&dilated, &Scalar::all(least), &mut summits)?;
        compare(&band, &summits, &mut flags, CMP_EQ)?;
        let mut places = Vector::<Point>::new();
        find_non_zero(&flags.row_bounds(1, last - first + 1)?, &mut places)?;
        found.extend(places.iter().map(|place| (place.y + first) as usize * width + place.x as usize));
    }
    let values: &[f32] = response.data_typed()?;
    let inside = |at: usize| at % width >= peaks.border_px && at % width + peaks.border_px < width;
    let is_first = |at: usize| [1, width - 1, width, width + 1].iter().all(|by| values[at - by] < values[at]);
    found.retain(|at| inside(*at) && peaks.is_clear(*at) && is_first(*at));
    Ok(found.into_iter().map(|at| (values[at], at)).collect())
}

/// The same as [`maxima_by_opencv`], in one pass.
pub(super) fn fused_maxima(response: &Mat, peaks: &Peaks) -> opencv::Result<Vec<(f32, usize)>> {
    let (width, response) = (response.cols() as usize, response.data_typed::<f32>()?);
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2")]
        fn with_avx2(response: &[f32], width: usize, peaks: &Peaks) -> Vec<(f32, usize)> {
            scan(response, width, peaks)
        }
        if is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has the instructions that the function is compiled for.
            return Ok(unsafe { with_avx2(response, width, peaks) });
        }
    }
    Ok(scan(response, width, peaks))
}

#[inline(always)]
fn scan(response: &[f32], width: usize, peaks: &Peaks) -> Vec<(f32, usize)> {
    let (height, border) = (response.len() / width.max(1), peaks.border_px.max(1));
    let mut found = Vec::new();
    if width <= 2 * border || height <= 2 * border {
        return found;
    }
    let least = peaks.least(greatest(response));
    let inner = width - 2 * border;
    let mut flags = vec![0u8; inner];
    for y in border..height - border {
        let first = y * width + border;
        let line = |shift: isize| &response[first.wrapping_add_signed(shift)..][..inner];
        flag_maxima(line, width as isize, least, &mut flags);
        for (x, _) in flags.iter().enumerate().filter(|(_, flag)| **flag != 0) {
            let at = first + x;
            if peaks.is_clear(at) {
                found.push((response[at], at));
            }
        }
    }
    found
}

/// Flags the maxima of a line; `line` gives it as seen from shifted pixels.
#[inline(always)]
fn flag_maxima<'a>(line: impl Fn(isize) -> &'a [f32], width: isize, least: f32, flags: &mut [u8]) {
    let here = line(0);
    flags.iter_mut().zip(here).for_each(|(flag, value)| *flag = u8::from(*value >= least));
    for before in [-width - 1, -width, -width + 1, -1].map(&line) {
        flags.iter_mut().zip(here).zip(before).for_each(|((flag, value), b)| *flag &= u8::from(b < value));
    }
    for after in [1, width - 1, width, width + 1].map(&line) {
        flags.iter_mut().zip(here).zip(after).for_each(|((flag, value), a)| *flag &= u8::from(a <= value));
    }
}

/// The greatest of all values and nothing, in strands that the compiler makes vectors of.
#[inline(always)]
fn greatest(values: &[f32]) -> f32 {
    let mut strands = [0.0f32; 16];
    let chunks = values.chunks_exact(16);
    let rest = chunks.remainder().iter().fold(0.0, |a, b| if *b > a { *b } else { a });
    for chunk in chunks {
        strands.iter_mut().zip(chunk).for_each(|(s, v)| *s = if *v > *s { *v } else { *s });
    }
    strands.iter().fold(rest, |a, b| if *b > a { *b } else { a })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn both(values: &[f32], width: usize, peaks: &Peaks) -> [Vec<(f32, usize)>; 2] {
        let field = Mat::from_slice(values).expect("a row of numbers");
        let field = field.reshape(1, (values.len() / width) as i32).expect("whole rows").try_clone().expect("a copy");
        [maxima_by_opencv, fused_maxima].map(|find| find(&field, peaks).expect("maxima"))
    }

    fn peaks(border_px: usize, least_ratio: f32) -> Peaks<'static> {
        Peaks { border_px, least_ratio, mask: None }
    }

    #[test]
    fn of_a_ridge_of_equals_only_the_first_is_a_maximum() {
        let mut response = vec![0.0; 9 * 9];
        [(4, 4), (4, 5), (5, 4)].iter().for_each(|(y, x)| response[y * 9 + x] = 2.0);
        response[2 * 9 + 2] = 1.0;
        for way in 0..2 {
            let at = |p: &Peaks| both(&response, 9, p)[way].iter().map(|m| m.1).collect::<Vec<_>>();
            assert_eq!(at(&peaks(1, 1e-5)), [20, 40]);
            assert_eq!(at(&peaks(1, 0.6)), [40], "too weak");
            assert_eq!(at(&peaks(3, 1e-5)), [40], "too near to the edge");
            let mask = GrayImage::from_fn(9, 9, |u, _| image::Luma([u8::from(u != 4)]));
            assert_eq!(at(&Peaks { mask: Some(&mask), ..peaks(1, 1e-5) }), [20], "masked");
            assert!(at(&peaks(5, 1e-5)).is_empty(), "no room inside the border");
        }
    }

    #[test]
    fn opencv_finds_the_same_as_one_pass() {
        use rand::RngExt;
        let mut random = crate::stats::random_stream(5, "response", 0);
        for (width, height, levels) in [(97, 64, 1e6), (64, 33, 4.0), (31, 40, 1.0)] {
            let level = |_| ((random.random::<f64>() - 0.3) * levels).round() as f32;
            let values: Vec<f32> = (0..width * height).map(level).collect();
            for (border_px, least_ratio) in [(1, 1e-5), (7, 0.3)] {
                let [ours, theirs] = both(&values, width, &peaks(border_px, least_ratio));
                assert!(ours == theirs && !ours.is_empty(), "{width}x{height}, {levels} levels");
            }
        }
    }
}
