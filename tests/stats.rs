//! Tests of the room `stats`.

mod least_squares;
mod robust;
mod standard_problems;
mod symmetric;

use nalgebra::{SMatrix, SVector};
use opnav::stats::{ConsistencyBounds, Estimate, normalized_error_squared, random_stream};
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};

/// Quantiles of χ² from printed tables (Abramowitz and Stegun, table 26.8).
#[test]
fn gates_agree_with_printed_tables() {
    let table = [
        (1, 0.95, 3.841_46),
        (1, 0.99, 6.634_90),
        (2, 0.95, 5.991_47),
        (3, 0.95, 7.814_73),
        (3, 0.99, 11.344_9),
        (6, 0.95, 12.591_6),
        (9, 0.95, 16.919_0),
        (10, 0.995, 25.188_2),
        (100, 0.95, 124.342),
    ];
    for (degrees, confidence, quantile) in table {
        let gate = ConsistencyBounds::gate(degrees, confidence);
        assert!((gate / quantile - 1.0).abs() < 5e-6, "{degrees} at {confidence}: {gate} for {quantile}");
    }
}

#[test]
fn bounds_of_a_mean_agree_with_printed_tables() {
    // χ² with 10 degrees of freedom: .025 and .975 quantiles are 3.24697 and 20.4831; with 100: 74.2219 and 129.561.
    for (degrees, samples, lower, upper) in
        [(10, 1, 3.246_97, 20.483_1), (5, 2, 3.246_97, 20.483_1), (2, 50, 74.221_9, 129.561)]
    {
        let total = f64::from(degrees * samples);
        let bounds = ConsistencyBounds::of_mean(degrees as usize, samples as usize, 0.95);
        assert!((bounds.lower * total / lower - 1.0).abs() < 5e-6, "{bounds:?}");
        assert!((bounds.upper * total / upper - 1.0).abs() < 5e-6, "{bounds:?}");
    }
    let many = ConsistencyBounds::of_mean(9, 100_000, 0.95);
    assert!(many.lower > 0.99 && many.upper < 1.01 && many.contains(1.0));
}

#[test]
fn a_diagnosis_says_which_side() {
    let bounds = ConsistencyBounds { lower: 0.8, upper: 1.2 };
    assert!(bounds.diagnosis(1.0).starts_with("consistent"));
    assert!(bounds.diagnosis(1.3).starts_with("overconfident"));
    assert!(bounds.diagnosis(0.7).starts_with("pessimistic"));
    assert!(bounds.diagnosis(f64::NAN).starts_with("undetermined"));
    assert!(!bounds.contains(f64::NAN));
}

#[test]
fn normalised_errors_follow_the_chi_squared_law() {
    let root = SMatrix::<f64, 3, 3>::new(2.0, 0.0, 0.0, -1.0, 0.5, 0.0, 0.3, 4.0, 0.1);
    let covariance = root * root.transpose();
    let mut random = random_stream(7, "normalised errors", 0);
    let runs = 4000;
    let mut sum = 0.0;
    for _ in 0..runs {
        let white = SVector::<f64, 3>::from_fn(|_, _| StandardNormal.sample(&mut random));
        sum += normalized_error_squared(&(root * white), &covariance).expect("positive definite");
    }
    let mean = sum / f64::from(3 * runs);
    let bounds = ConsistencyBounds::of_mean(3, runs as usize, 0.999);
    assert!(bounds.contains(mean), "{mean} outside {bounds:?}");
    assert!(!bounds.contains(mean * 1.2), "an error of 10 % in sigma must show");
}

#[test]
fn a_covariance_that_is_not_one_has_no_normalised_error() {
    let error = SVector::<f64, 2>::new(1.0, 1.0);
    for bad in [[0.0, 0.0, 0.0, 0.0], [1.0, 2.0, 2.0, 1.0], [f64::NAN, 0.0, 0.0, 1.0], [-1.0, 0.0, 0.0, -1.0]] {
        assert_eq!(normalized_error_squared(&error, &SMatrix::from_row_slice(&bad)), None, "{bad:?}");
    }
}

#[test]
fn estimates_from_sigma_give_sigma_back() {
    let sigma = SVector::<f64, 3>::new(0.5, 2.0, 7.0);
    let estimate = Estimate::from_sigma(SVector::<f64, 3>::zeros(), &sigma);
    assert!((estimate.sigma() - sigma).norm() < 1e-15);
    let mut skewed = estimate.clone();
    skewed.covariance[(0, 1)] = 0.2;
    let symmetric = skewed.symmetrized().covariance;
    assert_eq!(symmetric, symmetric.transpose());
    assert_eq!(symmetric[(0, 1)], 0.1);
}

fn draw(seed: u64, purpose: &str, index: u64) -> [u64; 4] {
    random_stream(seed, purpose, index).random()
}

#[test]
fn streams_are_reproducible_and_differ_by_seed_purpose_and_index() {
    assert_eq!(draw(1, "imu", 0), draw(1, "imu", 0));
    let others = [draw(1, "imu", 0), draw(2, "imu", 0), draw(1, "stars", 0), draw(1, "imu", 1), draw(0, "imu", 1)];
    for (i, a) in others.iter().enumerate() {
        for b in &others[i + 1..] {
            assert_ne!(a, b);
        }
    }
}

/// A stored seed must draw the same numbers with every later version.
#[test]
fn streams_keep_their_numbers() {
    assert_eq!(draw(42, "imu", 7)[0], 10_982_356_204_176_287_162);
}

#[test]
fn neighbouring_streams_are_uncorrelated() {
    let n = 20_000;
    let column = |index: u64| -> Vec<f64> {
        let mut random = random_stream(3, "frames", index);
        (0..n).map(|_| StandardNormal.sample(&mut random)).collect()
    };
    let (a, b) = (column(0), column(1));
    let correlation: f64 = a.iter().zip(&b).map(|(x, y)| x * y).sum::<f64>() / f64::from(n);
    assert!(correlation.abs() < 4.0 / f64::from(n).sqrt(), "{correlation}");
}
