//! Statistics of natural images, to tell whether rendered ground looks like photographed ground.

use image::GrayImage;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

/// Statistics of one image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImageStatistics {
    /// Exponent of the radial power spectrum: power ~ frequency to this power; about -2 for natural scenes (van der Schaaf
    /// and van Hateren, "Modelling the power spectra of natural images", Vision Research 36(17), 1996).
    pub spectrum_slope: f64,
    /// Fourth moment over the squared second moment of the grey levels' differences along rows and columns: 3 for Gaussian
    /// textures, more where smooth ground has sharp edges (Huang and Mumford, "Statistics of natural images and models",
    /// CVPR 1999).
    pub gradient_kurtosis: f64,
    /// Standard deviation of the grey levels.
    pub grey_spread_dn: f64,
}

/// Frequencies in cycles/px between which the spectrum's exponent is fitted: above the window's, below the optics'.
const FITTED_1_PX: [f64; 2] = [0.01, 0.25];
/// Least edge of an image in px that has ten frequencies in that range.
const LEAST_EDGE_PX: u32 = 48;

impl ImageStatistics {
    /// Statistics of the largest square in the middle of an image; `None` if that is smaller than 48 px or all of one
    /// grey level.
    pub fn of(image: &GrayImage) -> Option<ImageStatistics> {
        let edge = image.width().min(image.height());
        if edge < LEAST_EDGE_PX {
            return None;
        }
        let (left, top) = ((image.width() - edge) / 2, (image.height() - edge) / 2);
        let grey = (0..edge * edge)
            .map(|k| f64::from(image.get_pixel(left + k % edge, top + k / edge)[0]))
            .collect::<Vec<_>>();
        let mean = grey.iter().sum::<f64>() / grey.len() as f64;
        let variance = grey.iter().map(|g| (g - mean).powi(2)).sum::<f64>() / grey.len() as f64;
        if variance <= 0.0 {
            return None;
        }
        let edge = edge as usize;
        Some(ImageStatistics {
            spectrum_slope: spectrum_slope(&grey, edge),
            gradient_kurtosis: gradient_kurtosis(&grey, edge),
            grey_spread_dn: variance.sqrt(),
        })
    }
}

/// Kurtosis of central differences along both axes.
fn gradient_kurtosis(grey: &[f64], edge: usize) -> f64 {
    let inner = (1..edge - 1).flat_map(|y| (1..edge - 1).map(move |x| y * edge + x));
    let (second, fourth, count) = inner
        .flat_map(|at| [grey[at + 1] - grey[at - 1], grey[at + edge] - grey[at - edge]])
        .fold((0.0, 0.0, 0.0), |(second, fourth, count), d| (second + d * d, fourth + d.powi(4), count + 1.0));
    fourth * count / (second * second)
}

/// Slope of log power over log frequency, each interval of log frequency weighing the same.
fn spectrum_slope(grey: &[f64], edge: usize) -> f64 {
    let power = radial_power(grey, edge);
    let [low, high] = FITTED_1_PX.map(|f| f * edge as f64);
    let points = power.iter().enumerate().filter(|(k, p)| (low..=high).contains(&(*k as f64)) && **p > 0.0);
    let (mut w, mut x, mut y, mut xx, mut xy) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (k, p) in points {
        let (weight, a, b) = (1.0 / k as f64, (k as f64).ln(), p.ln());
        w += weight;
        x += weight * a;
        y += weight * b;
        xx += weight * a * a;
        xy += weight * a * b;
    }
    (w * xy - x * y) / (w * xx - x * x)
}

/// Mean power at each whole number of cycles across the image, after a Hann window.
fn radial_power(grey: &[f64], edge: usize) -> Vec<f64> {
    let window: Vec<f64> =
        (0..edge).map(|k| 0.5 - 0.5 * (std::f64::consts::TAU * (k as f64 + 0.5) / edge as f64).cos()).collect();
    let weight = |at: usize| window[at % edge] * window[at / edge];
    let total: f64 = (0..grey.len()).map(weight).sum();
    let mean = grey.iter().enumerate().map(|(at, g)| g * weight(at)).sum::<f64>() / total;
    let mut field: Vec<Complex<f64>> =
        grey.iter().enumerate().map(|(at, g)| Complex::new((g - mean) * weight(at), 0.0)).collect();
    let transform = FftPlanner::new().plan_fft_forward(edge);
    transform.process(&mut field);
    let mut turned: Vec<Complex<f64>> = (0..grey.len()).map(|at| field[(at % edge) * edge + at / edge]).collect();
    transform.process(&mut turned);
    let cycles = |k: usize| k.min(edge - k) as f64;
    let mut sums = vec![(0.0, 0.0); edge];
    for (at, value) in turned.iter().enumerate() {
        let ring = cycles(at % edge).hypot(cycles(at / edge)).round() as usize;
        sums[ring].0 += value.norm_sqr();
        sums[ring].1 += 1.0;
    }
    sums.iter().map(|(sum, count)| if *count > 0.0 { sum / count } else { 0.0 }).collect()
}
