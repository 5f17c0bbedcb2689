//! Statistics of the detector's noise, stage by stage. One electron is one digital number unless a test says otherwise.

use crate::render::{detector, lit_frame};
use opnav::render::RenderedFrame;
use opnav::scene::{Exposure, FixedPatternConfig, SensorConfig, ShutterConfig};

const SIDE: u32 = 256;

/// 16 bits, one electron a number, black level 1000, no read noise, no blur, an exposure of 1 s.
fn bare() -> SensorConfig {
    SensorConfig {
        full_well_electrons: 60_000.0,
        read_noise_electrons: 0.0,
        bits: 16,
        electrons_per_dn: Some(1.0),
        black_level_dn: 1000.0,
        exposure: Exposure::Fixed { electrons_per_radiance: 1.0 },
        shutter: ShutterConfig { exposure_time_s: 1.0, ..ShutterConfig::default() },
        psf_sigma_px: 0.0,
        ..SensorConfig::default()
    }
}

fn even(electrons: f32) -> RenderedFrame {
    lit_frame(SIDE, |_, _| electrons)
}

/// Electrons of each pixel of one picture.
fn electrons(config: &SensorConfig, frame: &RenderedFrame, t_ns: i64) -> Vec<f64> {
    let gain = config.gain_electrons_per_dn();
    let picture = detector(frame, config, 5).expose(frame, t_ns);
    picture.numbers.iter().map(|n| (f64::from(*n) - config.black_level_dn) * gain).collect()
}

fn moments(values: &[f64]) -> (f64, f64) {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    (mean, values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (values.len() - 1) as f64)
}

/// Half the variance of the difference of two pictures: noise in time, without the fixed pattern (EMVA 1288, 6.6).
fn variance_in_time(config: &SensorConfig, frame: &RenderedFrame) -> f64 {
    let (a, b) = (electrons(config, frame, 1), electrons(config, frame, 2));
    let difference: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a - b).collect();
    0.5 * moments(&difference).1
}

/// Mean over ten pictures, pixel by pixel.
fn mean_of_images(config: &SensorConfig, frame: &RenderedFrame) -> Vec<f64> {
    let mut sum = vec![0.0; frame.radiance.len()];
    for t_ns in 0..10 {
        sum.iter_mut().zip(electrons(config, frame, t_ns)).for_each(|(sum, value)| *sum += 0.1 * value);
    }
    sum
}

/// Whether a measured variance of so many pixels agrees with the expected one: 4.5 of its own standard deviations.
fn agrees(variance: f64, expected: f64) -> bool {
    (variance / expected - 1.0).abs() < 4.5 * (2.0 / f64::from(SIDE * SIDE)).sqrt()
}

#[test]
fn photon_transfer_curve_has_the_slope_of_the_gain() {
    let gain = 4.0;
    let config = SensorConfig { electrons_per_dn: Some(gain), read_noise_electrons: 20.0, ..bare() };
    // Variance in numbers is (read² + electrons)/gain² + 1/12, so its slope by the mean number is 1/gain.
    let point = |electrons: f32| {
        let frame = even(electrons);
        let (mean, _) = moments(&self::electrons(&config, &frame, 1));
        (mean / gain, variance_in_time(&config, &frame) / (gain * gain))
    };
    let points: Vec<(f64, f64)> = [200.0, 2_000.0, 8_000.0, 20_000.0, 40_000.0].map(point).to_vec();
    let (first, last) = (points[0], points[4]);
    let slope = (last.1 - first.1) / (last.0 - first.0);
    assert!((slope * gain - 1.0).abs() < 0.02, "slope {slope} for a gain of {gain} electrons a number");
    for (mean, variance) in &points {
        let expected = (400.0 + mean * gain) / (gain * gain) + 1.0 / 12.0;
        assert!(agrees(*variance, expected), "at {mean}: {variance} for {expected}");
        assert!(!agrees(*variance, 1.1 * expected), "a tenth more variance goes unnoticed at {mean}");
    }
}

#[test]
fn faint_light_is_counted_by_poissons_law() {
    // The third central moment of Poisson's law is its mean, that of a normal law 0.
    for mean in [0.3, 3.0, 20.0] {
        let values = electrons(&bare(), &even(mean as f32), 1);
        let (found, variance) = moments(&values);
        let third = values.iter().map(|v| (v - found).powi(3)).sum::<f64>() / values.len() as f64;
        assert!((found - mean).abs() < 4.5 * (mean / values.len() as f64).sqrt(), "mean {found} for {mean}");
        let sigma_of_variance = ((mean + 2.0 * mean * mean) / values.len() as f64).sqrt();
        assert!((variance - mean).abs() < 4.5 * sigma_of_variance, "variance {variance} for {mean}");
        let sigma_of_third = (15.0 * mean.powi(3) + 25.0 * mean * mean + mean).sqrt() / (values.len() as f64).sqrt();
        assert!((third - mean).abs() < 4.5 * sigma_of_third, "third moment {third} for {mean}");
        assert!(third.abs() > 4.5 * sigma_of_third, "a normal law would pass at {mean}");
    }
}

#[test]
fn read_noise_is_normal_and_stands_alone_in_the_dark() {
    let config = SensorConfig { read_noise_electrons: 30.0, ..bare() };
    let values = electrons(&config, &even(0.0), 1);
    let (mean, variance) = moments(&values);
    assert!(mean.abs() < 0.5 && agrees(variance, 900.0 + 1.0 / 12.0), "{mean} {variance}");
    let beyond = values.iter().filter(|v| v.abs() > 60.0).count() as f64 / values.len() as f64;
    assert!((beyond - 0.0455).abs() < 0.004, "{beyond} beyond two sigma");
    let (_, without) = moments(&electrons(&SensorConfig { noise: false, ..config }, &even(0.0), 1));
    assert_eq!(without, 0.0);
}

#[test]
fn dark_current_grows_with_time_and_has_shot_noise() {
    for exposure_time_s in [0.5, 2.0] {
        let shutter = ShutterConfig { exposure_time_s, ..ShutterConfig::default() };
        let config = SensorConfig { dark_current_electrons_s: 400.0, shutter, ..bare() };
        let (mean, variance) = moments(&electrons(&config, &even(0.0), 1));
        let expected = 400.0 * exposure_time_s;
        assert!((mean - expected).abs() < 4.5 * (expected / 65_536.0).sqrt(), "{mean} for {expected}");
        assert!(agrees(variance, expected), "{variance} for {expected}");
        assert!(!agrees(variance, expected + 25.0), "read noise of 5 electrons goes unnoticed");
    }
}

#[test]
fn response_differs_from_pixel_to_pixel_and_stays() {
    let fixed_pattern = FixedPatternConfig { response_sigma: 0.02, ..FixedPatternConfig::default() };
    let config = SensorConfig { fixed_pattern, ..bare() };
    let frame = even(20_000.0);
    let mean_image = mean_of_images(&config, &frame);
    let (mean, variance) = moments(&mean_image);
    let response_sigma = (variance - 0.1 * mean).sqrt() / mean;
    assert!((response_sigma / 0.02 - 1.0).abs() < 0.02, "PRNU {response_sigma}");
    // It is no noise in time, and it is none of the offsets: in the dark nothing is left.
    assert!(agrees(variance_in_time(&config, &frame), 20_000.0 * (1.0 + 0.02 * 0.02)));
    assert_eq!(moments(&electrons(&config, &even(0.0), 1)).1, 0.0);
    let (_, smooth) = moments(&mean_of_images(&bare(), &frame));
    assert!((smooth - 2_000.0).abs() < 60.0, "without PRNU: {smooth}");
}

#[test]
fn offset_differs_from_pixel_to_pixel_and_stays() {
    let fixed_pattern = FixedPatternConfig { offset_sigma_electrons: 25.0, ..FixedPatternConfig::default() };
    let config = SensorConfig { fixed_pattern, read_noise_electrons: 5.0, ..bare() };
    let (mean, variance) = moments(&mean_of_images(&config, &even(0.0)));
    let sigma = (variance - 0.1 * (25.0 + 1.0 / 12.0)).sqrt();
    assert!(mean.abs() < 0.5 && (sigma / 25.0 - 1.0).abs() < 0.015, "DSNU {sigma}, mean {mean}");
    assert!(agrees(variance_in_time(&config, &even(0.0)), 25.0 + 1.0 / 12.0));
    // The same however bright the picture is.
    let (_, bright) = moments(&mean_of_images(&config, &even(10_000.0)));
    assert!(((bright - 1_002.5).sqrt() / 25.0 - 1.0).abs() < 0.05, "{bright}");
}

/// Pixels far above the rest, and how bright.
fn hot(values: &[f64]) -> Vec<(usize, f64)> {
    values.iter().copied().enumerate().filter(|(_, v)| *v > 60.0).collect()
}

#[test]
fn hot_pixels_are_as_many_as_stated_and_the_same_in_every_image() {
    let fixed_pattern = FixedPatternConfig {
        hot_pixel_fraction: 0.01,
        hot_pixel_electrons_s: 5_000.0,
        ..FixedPatternConfig::default()
    };
    let config = SensorConfig { fixed_pattern, read_noise_electrons: 10.0, ..bare() };
    let first = hot(&electrons(&config, &even(0.0), 1));
    // An exponential law leaves exp(-60/5000) of them above the threshold.
    let expected = 655.36 * (-60.0_f64 / 5_000.0).exp();
    assert!((first.len() as f64 - expected).abs() < 4.5 * expected.sqrt(), "{} for {expected}", first.len());
    let mean = first.iter().map(|(_, v)| v - 60.0).sum::<f64>() / first.len() as f64;
    assert!((mean / 5_000.0 - 1.0).abs() < 0.2, "mean {mean}");
    let second = hot(&electrons(&config, &even(0.0), 2));
    let shared = first.iter().filter(|(i, _)| second.iter().any(|(j, _)| i == j)).count();
    assert!(shared as f64 > 0.985 * first.len() as f64, "{shared} of {} stay", first.len());
    // Another camera has others; none is hot if none shall be.
    let elsewhere = crate::render::detector(&even(0.0), &config, 6).expose(&even(0.0), 1);
    let elsewhere: Vec<f64> = elsewhere.numbers.iter().map(|n| f64::from(*n) - 1000.0).collect();
    let by_chance = first.iter().filter(|(i, _)| elsewhere[*i] > 60.0).count();
    assert!(by_chance < 30, "{by_chance} shared with another camera");
    assert!(hot(&electrons(&SensorConfig { read_noise_electrons: 10.0, ..bare() }, &even(0.0), 1)).is_empty());
}

#[test]
fn a_full_well_holds_no_more() {
    let config = SensorConfig { full_well_electrons: 30_000.0, ..bare() };
    let above = electrons(&config, &even(31_000.0), 1);
    let at_most = above.iter().copied().fold(0.0, f64::max);
    let full = above.iter().filter(|v| **v == 30_000.0).count() as f64 / above.len() as f64;
    assert!(at_most == 30_000.0 && full > 0.999, "{at_most}, {full}");
    // Just at the full well half of the pixels are full, and the variance is (1 - 1/π)/2 of the shot noise's.
    let at = electrons(&config, &even(30_000.0), 1);
    let (_, variance) = moments(&at);
    assert!((variance / 30_000.0 - 0.5 * (1.0 - std::f64::consts::FRAC_1_PI)).abs() < 0.01, "{variance}");
    // A tenth below nothing is cut.
    assert!(electrons(&config, &even(27_000.0), 1).iter().all(|v| *v < 30_000.0));
}
