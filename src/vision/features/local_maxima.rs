//! Local maxima of a corner response.

use image::GrayImage;

/// Local maxima of a response of `width` pixels a row, as (response, index) in reading order: at least `least_ratio` times
/// the greatest response, `border` pixels off the edges, and where `mask` is given only where it is not zero.
///
/// Of equal neighbours the first in reading order is the maximum.
pub(super) fn local_maxima(
    (response, width): (&[f32], usize),
    (border, least_ratio): (usize, f32),
    mask: Option<&GrayImage>,
) -> Vec<(f32, usize)> {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2")]
        fn with_avx2(field: (&[f32], usize), limits: (usize, f32), mask: Option<&GrayImage>) -> Vec<(f32, usize)> {
            scan(field, limits, mask)
        }
        if is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has the instructions that the function is compiled for.
            return unsafe { with_avx2((response, width), (border, least_ratio), mask) };
        }
    }
    scan((response, width), (border, least_ratio), mask)
}

#[inline(always)]
fn scan(
    (response, width): (&[f32], usize),
    (border, least_ratio): (usize, f32),
    mask: Option<&GrayImage>,
) -> Vec<(f32, usize)> {
    let (height, border) = (response.len() / width.max(1), border.max(1));
    let mut found = Vec::new();
    if width <= 2 * border || height <= 2 * border {
        return found;
    }
    let least = (greatest(response) * least_ratio).max(1e-12);
    let inner = width - 2 * border;
    let mut flags = vec![0u8; inner];
    for y in border..height - border {
        let first = y * width + border;
        let line = |shift: isize| &response[first.wrapping_add_signed(shift)..][..inner];
        flag_maxima(line, width as isize, least, &mut flags);
        for (x, _) in flags.iter().enumerate().filter(|(_, flag)| **flag != 0) {
            let at = first + x;
            if mask.is_none_or(|m| m.as_raw()[at] != 0) {
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

    #[test]
    fn of_a_ridge_of_equals_only_the_first_is_a_maximum() {
        let mut response = vec![0.0; 9 * 9];
        [(4, 4), (4, 5), (5, 4)].iter().for_each(|(y, x)| response[y * 9 + x] = 2.0);
        response[2 * 9 + 2] = 1.0;
        let at = |limits| local_maxima((&response, 9), limits, None).iter().map(|m| m.1).collect::<Vec<_>>();
        assert_eq!(at((1, 1e-5)), [20, 40]);
        assert_eq!(at((1, 0.6)), [40], "too weak");
        assert_eq!(at((3, 1e-5)), [40], "too near to the edge");
        assert!(at((5, 1e-5)).is_empty(), "no room inside the border");
    }
}
