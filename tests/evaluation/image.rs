//! Statistics of pictures, on pictures whose statistics are known.

use image::{GrayImage, Luma};
use opnav::evaluation::ImageStatistics;
use opnav::stats::random_stream;
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};

const EDGE_PX: u32 = 256;

/// A sum of plane waves whose power goes as frequency to an exponent.
fn waves(exponent: f64, seed: u64) -> GrayImage {
    let mut random = random_stream(seed, "waves", 0);
    let mut grey = vec![0.0; (EDGE_PX * EDGE_PX) as usize];
    // One wave for every lattice frequency would take long; as many in every octave do, each standing for its share.
    for _ in 0..1500 {
        let frequency = 0.006_f64 * (0.4_f64 / 0.006).powf(random.random_range(0.0..1.0));
        let angle: f64 = random.random_range(0.0..std::f64::consts::TAU);
        let phase: f64 = random.random_range(0.0..std::f64::consts::TAU);
        // Power a wave: density times the area of frequencies that it stands for, which grows as its square.
        let amplitude = frequency.powf(0.5 * exponent + 1.0);
        let (fx, fy) = (frequency * angle.cos(), frequency * angle.sin());
        for (at, value) in grey.iter_mut().enumerate() {
            let (x, y) = ((at % EDGE_PX as usize) as f64, (at / EDGE_PX as usize) as f64);
            *value += amplitude * (std::f64::consts::TAU * (fx * x + fy * y) + phase).cos();
        }
    }
    let rms = (grey.iter().map(|g| g * g).sum::<f64>() / grey.len() as f64).sqrt();
    GrayImage::from_fn(EDGE_PX, EDGE_PX, |x, y| {
        Luma([(128.0 + 30.0 * grey[(y * EDGE_PX + x) as usize] / rms).round().clamp(0.0, 255.0) as u8])
    })
}

fn of(picture: &GrayImage) -> ImageStatistics {
    ImageStatistics::of(picture).expect("a picture with texture")
}

#[test]
fn the_slope_of_the_spectrum_is_the_exponent_of_the_power() {
    for exponent in [-2.5, -2.0, -1.5] {
        // One picture has few waves across it: their chance powers move its slope by about 0.1.
        let found = (0..3).map(|seed| of(&waves(exponent, seed)).spectrum_slope).sum::<f64>() / 3.0;
        println!("exponent {exponent}: {found:.3}");
        assert!((found - exponent).abs() < 0.2, "{found} for {exponent}");
    }
}

#[test]
fn noise_has_a_level_spectrum_gaussian_gradients_and_its_own_spread() {
    let mut random = random_stream(4, "noise", 0);
    let picture = GrayImage::from_fn(EDGE_PX, EDGE_PX, |_, _| {
        let z: f64 = StandardNormal.sample(&mut random);
        Luma([(128.0 + 20.0 * z).round().clamp(0.0, 255.0) as u8])
    });
    let found = of(&picture);
    assert!(found.spectrum_slope.abs() < 0.15, "{found:?}");
    assert!((found.gradient_kurtosis - 3.0).abs() < 0.1, "{found:?}");
    assert!((found.grey_spread_dn - 20.0).abs() < 0.3, "{found:?}");
}

#[test]
fn edges_on_smooth_ground_raise_the_kurtosis() {
    // One column in 32 is an edge of two differences: kurtosis is one over the share of differences that are not 0.
    let picture = GrayImage::from_fn(EDGE_PX, EDGE_PX, |x, _| Luma([if x / 32 % 2 == 0 { 100 } else { 150 }]));
    let found = of(&picture);
    let inner = f64::from(EDGE_PX - 2);
    let expected = 2.0 * inner / (2.0 * 7.0);
    assert!((found.gradient_kurtosis / expected - 1.0).abs() < 1e-9, "{found:?}, expected {expected}");
    assert!((found.grey_spread_dn - 25.0).abs() < 1e-9, "{found:?}");
}

#[test]
fn images_without_statistics_have_none() {
    assert_eq!(ImageStatistics::of(&GrayImage::from_pixel(200, 200, Luma([77]))), None);
    assert_eq!(ImageStatistics::of(&GrayImage::new(47, 300)), None);
}
