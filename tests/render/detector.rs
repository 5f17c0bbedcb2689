//! The detector.

use opnav::render::{RenderedFrame, expose};
use opnav::scene::{Exposure, SensorConfig};

fn grey(side_px: u32, radiance: f32) -> RenderedFrame {
    let count = (side_px * side_px) as usize;
    RenderedFrame {
        width_px: side_px,
        height_px: side_px,
        radiance: vec![radiance; count],
        depth_m: vec![1.0; count],
        mask: vec![RenderedFrame::BODY | RenderedFrame::LIT; count],
    }
}

#[test]
fn the_detector_is_reproducible_and_noisy_as_stated() {
    let sensor = SensorConfig {
        exposure: Exposure::Fixed { electrons_per_radiance: 20_000.0 },
        full_well_electrons: 5_000.0,
        read_noise_electrons: 30.0,
        ..SensorConfig::default()
    };
    let frame = grey(256, 0.1);
    let picture = expose(&frame, &sensor, 9, 33);
    assert_eq!(picture, expose(&frame, &sensor, 9, 33));
    assert_ne!(picture, expose(&frame, &sensor, 10, 33));
    assert_ne!(picture, expose(&frame, &sensor, 9, 34));
    let values: Vec<f64> = picture.pixels().map(|p| f64::from(p[0])).collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64;
    // 2000 electrons: shot noise √2000, read noise 30, rounding 1/√12 of a level.
    let per_electron = 255.0 / 5_000.0;
    let expected = (2_000.0 + 900.0) * per_electron * per_electron + 1.0 / 12.0;
    assert!((mean - 102.0).abs() < 0.05, "mean {mean}");
    assert!((variance / expected - 1.0).abs() < 0.03, "variance {variance} for {expected}");
}

#[test]
fn automatic_exposure_uses_the_range() {
    let mut frame = grey(100, 0.0);
    (0..10_000).for_each(|i| frame.radiance[i] = 0.2 * i as f32 / 9_999.0);
    let sensor = SensorConfig { noise: false, psf_sigma_px: 0.0, ..SensorConfig::default() };
    let picture = expose(&frame, &sensor, 1, 1);
    let bright = f64::from(picture.as_raw()[9_900]) / 255.0;
    assert!((bright - 0.8).abs() < 0.005, "the 99th percentile is at {bright}");
    // Nothing lit: black, not divided by zero.
    assert!(expose(&RenderedFrame { mask: vec![1; 10_000], ..frame }, &sensor, 1, 1).pixels().all(|p| p[0] == 0));
}
