//! The detector as a whole.

use crate::render::{detector, lit_frame};
use opnav::geometry::Camera;
use opnav::render::{Detector, RenderedFrame};
use opnav::scene::{Exposure, FixedPatternConfig, SensorConfig, ShutterConfig, VignettingConfig};

/// Everything switched on.
fn everything() -> SensorConfig {
    SensorConfig {
        bits: 12,
        black_level_dn: 64.0,
        dark_current_electrons_s: 50.0,
        defocus_radius_px: 1.3,
        shutter: ShutterConfig { exposure_time_s: 0.1, ..ShutterConfig::default() },
        vignetting: VignettingConfig { cosine_fourth: true, radial: [-0.1, 0.0, 0.0] },
        fixed_pattern: FixedPatternConfig {
            response_sigma: 0.01,
            offset_sigma_electrons: 5.0,
            hot_pixel_fraction: 1e-3,
            hot_pixel_electrons_s: 1e4,
        },
        ..SensorConfig::default()
    }
}

#[test]
fn the_same_seed_and_time_give_the_same_bytes_on_any_number_of_threads() {
    let frame = lit_frame(200, |u, v| 0.001 * ((u * 7 + v * 3) % 90) as f32);
    let expose = |seed, t_ns| detector(&frame, &everything(), seed).expose(&frame, t_ns);
    let picture = expose(9, 33);
    assert_eq!(picture, expose(9, 33));
    assert_ne!(picture, expose(10, 33));
    assert_ne!(picture, expose(9, 34));
    let other = Detector::new(&Camera::from_fov(200, 200, 1.2), &everything(), 9, 1);
    assert_ne!(picture, other.expose(&frame, 33), "another camera has noise of its own");
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        assert_eq!(picture, pool.install(|| expose(9, 33)), "{threads} threads");
    }
}

#[test]
fn automatic_exposure_uses_the_range() {
    let ramp = lit_frame(100, |u, v| 0.2 * (100 * v + u) as f32 / 9_999.0);
    let quiet = SensorConfig { noise: false, psf_sigma_px: 0.0, ..SensorConfig::default() };
    for (exposure, share) in [
        (Exposure::Auto, 0.8),
        (Exposure::Percentile { percent: 99.0, full_well_share: 0.5 }, 0.5),
        (Exposure::Percentile { percent: 49.5, full_well_share: 0.4 }, 0.8),
    ] {
        let picture = detector(&ramp, &SensorConfig { exposure, ..quiet }, 1).expose(&ramp, 1);
        let bright = f64::from(picture.numbers[9_899]) / 255.0;
        assert!((bright - share).abs() < 0.004, "{exposure:?}: the 99th percentile is at {bright}");
    }
    // The level follows the light: half the light, twice the exposure. A fixed exposure does not.
    let dim = RenderedFrame { radiance: ramp.radiance.iter().map(|r| 0.5 * r).collect(), ..ramp.clone() };
    let expose = |frame, exposure| detector(frame, &SensorConfig { exposure, ..quiet }, 1).expose(frame, 1);
    assert_eq!(expose(&ramp, Exposure::Auto), expose(&dim, Exposure::Auto));
    let fixed = Exposure::Fixed { electrons_per_radiance: 8e4 };
    assert_ne!(expose(&ramp, fixed), expose(&dim, fixed));
    // Nothing lit: black, not divided by zero.
    let unlit = RenderedFrame { mask: vec![1; 10_000], ..ramp.clone() };
    assert!(expose(&unlit, Exposure::Auto).numbers.iter().all(|number| *number == 0));
}

#[test]
fn exposure_time_collects_light() {
    let frame = lit_frame(16, |_, _| 0.25);
    let collected = |exposure_time_s| {
        let config = SensorConfig {
            noise: false,
            bits: 16,
            electrons_per_dn: Some(1.0),
            exposure: Exposure::Timed { electrons_per_radiance_s: 1e5 },
            shutter: ShutterConfig { exposure_time_s, ..ShutterConfig::default() },
            dark_current_electrons_s: 1000.0,
            ..SensorConfig::default()
        };
        detector(&frame, &config, 1).expose(&frame, 0).numbers[100]
    };
    assert_eq!([collected(0.1), collected(0.4)], [2600, 10_400]);
}

/// A ramp through the whole range, read without noise.
fn ramp_at(bits: u32) -> Vec<u16> {
    let frame = lit_frame(256, |u, v| (256 * v + u) as f32 / 65_535.0);
    let config = SensorConfig {
        noise: false,
        psf_sigma_px: 0.0,
        bits,
        exposure: Exposure::Fixed { electrons_per_radiance: 20_000.0 },
        ..SensorConfig::default()
    };
    detector(&frame, &config, 1).expose(&frame, 0).numbers
}

#[test]
fn numbers_fill_their_bits_and_err_evenly() {
    for bits in [4, 8, 12, 16] {
        let numbers = ramp_at(bits);
        let largest = f64::from((1_u32 << bits) - 1);
        assert_eq!((numbers[0], f64::from(numbers[65_535])), (0, largest), "{bits} bits");
        // Quantisation errs evenly between ±½: mean 0, variance 1/12 (EMVA 1288), unless each number is met exactly.
        let error = |offset: f64| {
            let errors =
                numbers.iter().enumerate().map(|(i, n)| i as f64 / 65_535.0 * largest - f64::from(*n) + offset);
            let errors: Vec<f64> = errors.collect();
            let mean = errors.iter().sum::<f64>() / errors.len() as f64;
            (mean, errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64)
        };
        let even = |(mean, square): (f64, f64)| mean.abs() < 0.01 && (square - 1.0 / 12.0).abs() < 0.003;
        assert_eq!(even(error(0.0)), bits < 16, "{bits} bits: {:?}", error(0.0));
        assert!(!even(error(0.5)), "{bits} bits: half a number aside goes unnoticed");
    }
}

#[test]
fn black_level_and_gain_place_the_numbers() {
    let frame = lit_frame(8, |_, _| 0.5);
    let base = SensorConfig {
        noise: false,
        bits: 12,
        black_level_dn: 95.0,
        exposure: Exposure::Fixed { electrons_per_radiance: 20_000.0 },
        ..SensorConfig::default()
    };
    // By default a full well of 20 000 electrons reads as 4095: 10 000 electrons lie halfway from 95.
    assert_eq!(detector(&frame, &base, 1).expose(&frame, 0).numbers[0], 2095);
    let gain = SensorConfig { electrons_per_dn: Some(8.0), ..base };
    assert_eq!(detector(&frame, &gain, 1).expose(&frame, 0).numbers[0], 95 + 1250);
}
