//! Noise of an image, from the image itself.

use image::GrayImage;

/// Response of a pixel that shows no noise: empty sky, or saturated. No other has this one.
const BLIND: u16 = 4095;

/// 1σ of the image's noise in grey levels (Immerkaer 1996), from the lower quartile of the response of a mask that
/// is blind to planes and edges, so that texture counts little; at least the noise of rounding.
pub fn noise_sigma_dn(image: &GrayImage) -> f64 {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let mut histogram = vec![0u32; usize::from(BLIND) + 1];
    let mut line = vec![BLIND; width.saturating_sub(2)];
    for y in (1..height.saturating_sub(1)).step_by(3) {
        let row = |y: usize| &image.as_raw()[y * width..][..width];
        respond([row(y - 1), row(y), row(y + 1)], &mut line);
        line.iter().for_each(|r| histogram[usize::from(*r & BLIND)] += 1);
    }
    histogram[usize::from(BLIND)] = 0;
    let count: u32 = histogram.iter().sum();
    let mut seen = 0;
    let quartile = histogram.iter().position(|n| {
        seen += n;
        seen * 4 > count
    });
    const LOWER_QUARTILE_OF_ABSOLUTE_NORMAL: f64 = 0.3186;
    let sigma = quartile.unwrap_or(0) as f64 / (6.0 * LOWER_QUARTILE_OF_ABSOLUTE_NORMAL);
    sigma.max(1.0 / 12f64.sqrt())
}

/// Size of the mask's response along the middle one of three lines, without the first and the last pixel.
fn respond(lines: [&[u8]; 3], out: &mut [u16]) {
    let count = out.len();
    let [[a, b, c], [d, e, f], [g, h, i]] = lines.map(|l| [0, 1, 2].map(|k| &l[k..][..count]));
    let corners = a.iter().zip(c).zip(g.iter().zip(i));
    let cross = b.iter().zip(d).zip(f.iter().zip(h));
    let grey = |level: &u8| i16::from(*level);
    for (((out, e), ((a, c), (g, i))), ((b, d), (f, h))) in out.iter_mut().zip(e).zip(corners).zip(cross) {
        let corners = grey(a) + grey(c) + grey(g) + grey(i);
        let cross = grey(b) + grey(d) + grey(f) + grey(h);
        let response = (4 * grey(e) - 2 * cross + corners).unsigned_abs();
        *out = if (4..=251).contains(e) { response } else { BLIND };
    }
}
