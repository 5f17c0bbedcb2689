//! Noise of a picture, from the picture itself.

use image::GrayImage;

/// 1σ of the picture's noise in grey levels (Immerkaer 1996), from the lower quartile of the response of a mask that
/// is blind to planes and edges, so that texture counts little; at least the noise of rounding.
pub fn noise_sigma_dn(picture: &GrayImage) -> f64 {
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let p = picture.as_raw();
    let mut histogram = vec![0u32; 4096];
    let mut count = 0u32;
    for y in (1..height.saturating_sub(1)).step_by(3) {
        for x in 1..width.saturating_sub(1) {
            let at = y * width + x;
            let g = |dy: isize, dx: isize| i32::from(p[(at as isize + dy * width as isize + dx) as usize]);
            if g(0, 0) < 4 || g(0, 0) > 251 {
                continue; // empty sky or saturated: no noise to see
            }
            let cross = g(-1, 0) + g(1, 0) + g(0, -1) + g(0, 1);
            let corners = g(-1, -1) + g(-1, 1) + g(1, -1) + g(1, 1);
            histogram[(4 * g(0, 0) - 2 * cross + corners).unsigned_abs() as usize] += 1;
            count += 1;
        }
    }
    let mut seen = 0;
    let quartile = histogram.iter().position(|n| {
        seen += n;
        seen * 4 > count
    });
    const LOWER_QUARTILE_OF_ABSOLUTE_NORMAL: f64 = 0.3186;
    let sigma = quartile.unwrap_or(0) as f64 / (6.0 * LOWER_QUARTILE_OF_ABSOLUTE_NORMAL);
    sigma.max(1.0 / 12f64.sqrt())
}
