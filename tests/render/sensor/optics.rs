//! Vignetting and point spread.

use crate::render::{detector, lit_frame};
use nalgebra::Vector2;
use opnav::geometry::Camera;
use opnav::render::{Detector, RenderedFrame};
use opnav::scene::{Exposure, SensorConfig, VignettingConfig};

/// No noise, 16 bits, radiance 1 at the top of the range.
fn quiet() -> SensorConfig {
    SensorConfig {
        noise: false,
        bits: 16,
        full_well_electrons: 65_535.0,
        exposure: Exposure::Fixed { electrons_per_radiance: 60_000.0 },
        psf_sigma_px: 0.0,
        ..SensorConfig::default()
    }
}

#[test]
fn brightness_falls_toward_the_edge_as_stated() {
    let camera = Camera { center_px: Vector2::new(110.0, 140.0), ..Camera::from_fov(240, 240, 1.4) };
    let frame = lit_frame(240, |_, _| 1.0);
    let radial = [-0.2, 0.05, -0.1];
    let vignetting = VignettingConfig { cosine_fourth: true, radial };
    let config = SensorConfig { vignetting, ..quiet() };
    let picture = Detector::new(&camera, &config, 1, 0).expose(&frame, 0);
    let worst = |center_px: Vector2<f64>, power: i32| {
        let mut worst: f64 = 0.0;
        for (u, v) in (0..240_u32).flat_map(|v| (0..240_u32).map(move |u| (u, v))) {
            let offset_px = Vector2::new(f64::from(u), f64::from(v)) - center_px;
            let cosine = 1.0 / (offset_px.norm() / camera.focal_px.x).hypot(1.0);
            let r2 = offset_px.norm_squared() / (120.0 * 120.0 * 2.0);
            let expected = cosine.powi(power) * (1.0 + radial[0] * r2 + radial[1] * r2 * r2 + radial[2] * r2.powi(3));
            let found = f64::from(picture.numbers[frame.index(u, v)]) / 60_000.0;
            worst = worst.max((found - expected).abs());
        }
        worst
    };
    assert!(worst(camera.center_px, 4) < 1e-4, "{}", worst(camera.center_px, 4));
    assert!(worst(camera.center_px.add_scalar(1.0), 4) > 1e-3, "a shifted centre goes unnoticed");
    assert!(worst(camera.center_px, 3) > 1e-2, "the third power goes unnoticed");
}

/// One bright pixel in the dark: sum, centroid and second moments along u and v of its light, over the radiance put in.
fn point_light(config: &SensorConfig) -> (f64, Vector2<f64>, Vector2<f64>) {
    // Bright enough that quantisation does not matter, dim enough that nothing saturates.
    let frame = lit_frame(101, |u, v| if (u, v) == (50, 47) { 1.0 } else { 0.0 });
    let spread = (2.0 * config.psf_sigma_px.powi(2)).max(config.defocus_radius_px.powi(2)) * std::f64::consts::PI;
    let level = 4e4 * spread.max(1.0);
    let bright = SensorConfig { exposure: Exposure::Fixed { electrons_per_radiance: level }, ..*config };
    let picture = detector(&frame, &bright, 1).expose(&frame, 0);
    moments(&frame, |i| f64::from(picture.numbers[i]), level)
}

fn moments(frame: &RenderedFrame, light: impl Fn(usize) -> f64, level: f64) -> (f64, Vector2<f64>, Vector2<f64>) {
    let places = || (0..frame.height_px).flat_map(|v| (0..frame.width_px).map(move |u| (u, v)));
    let weighted = |f: &dyn Fn(Vector2<f64>) -> Vector2<f64>| -> Vector2<f64> {
        places().map(|(u, v)| f(Vector2::new(f64::from(u), f64::from(v))) * light(frame.index(u, v))).sum()
    };
    let sum = weighted(&|_| Vector2::repeat(1.0)).x;
    let mean = weighted(&|p| p) / sum;
    let second = weighted(&|p| (p - mean).component_mul(&(p - mean))) / sum;
    (sum / level, mean, second)
}

#[test]
fn point_spread_has_its_second_moment_and_loses_no_light() {
    for sigma_px in [0.4, 0.5, 0.8, 1.5, 3.0] {
        let (sum, mean, second) = point_light(&SensorConfig { psf_sigma_px: sigma_px, ..quiet() });
        let variance = sigma_px * sigma_px;
        assert!((sum - 1.0).abs() < 2e-4, "σ = {sigma_px}: light {sum}");
        assert!((mean - Vector2::new(50.0, 47.0)).norm() < 1e-3, "σ = {sigma_px}: centroid {mean}");
        assert!((second / variance).add_scalar(-1.0).abs().max() < 5e-3, "σ = {sigma_px}: second moments {second}");
    }
    // A sampled Gaussian, as many tools use it, has a seventh less at σ = 0.5: the bar would find it.
    let sampled = |n: i32| (-2.0 * f64::from(n * n)).exp();
    let (weights, square) = (-3..=3).fold((0.0, 0.0), |(w, s), n| (w + sampled(n), s + sampled(n) * f64::from(n * n)));
    assert!((square / weights / 0.25 - 1.0).abs() > 0.1);
}

#[test]
fn a_defocused_point_keeps_its_light() {
    for radius_px in [0.3, 1.0, 2.5, 6.0, 11.0] {
        let (sum, mean, second) = point_light(&SensorConfig { defocus_radius_px: radius_px, ..quiet() });
        assert!((sum - 1.0).abs() < 1e-4, "radius {radius_px}: light {sum}");
        assert!((mean - Vector2::new(50.0, 47.0)).norm() < 1e-3, "radius {radius_px}: centroid {mean}");
        // A disc has r²/4 along either axis, and rounding to pixels adds 1/12 where the disc is much wider than a pixel.
        if radius_px >= 4.0 {
            let expected = 0.25 * radius_px * radius_px + 1.0 / 12.0;
            assert!((second / expected).add_scalar(-1.0).abs().max() < 0.01, "radius {radius_px}: {second}");
            assert!(
                (second * 4.0 / (radius_px + 0.5).powi(2)).add_scalar(-1.0).abs().max() > 0.03,
                "half a pixel more"
            );
        }
    }
    // Negative control: a disc cut off by the picture's edge loses light, and the sum shows it.
    let frame = lit_frame(31, |u, v| if (u, v) == (15, 4) { 1.0 } else { 0.0 });
    let config = SensorConfig { defocus_radius_px: 6.0, ..quiet() };
    let level = Exposure::Fixed { electrons_per_radiance: 1e6 };
    let picture = detector(&frame, &SensorConfig { exposure: level, ..config }, 1).expose(&frame, 0);
    let (sum, ..) = moments(&frame, |i| f64::from(picture.numbers[i]), 1e6);
    assert!((sum - 1.0).abs() > 0.01, "{sum}");
}

#[test]
fn an_even_field_stays_even_up_to_the_edge() {
    let frame = lit_frame(40, |_, _| 0.5);
    let config = SensorConfig { psf_sigma_px: 2.0, defocus_radius_px: 4.0, ..quiet() };
    let picture = detector(&frame, &config, 1).expose(&frame, 0);
    assert!(picture.numbers.iter().all(|number| number.abs_diff(30_000) <= 1));
}
