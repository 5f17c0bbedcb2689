//! Medians, quantiles and the median absolute deviation: against sorting, against `statrs`, and by their laws.

use opnav::stats::{
    MAD_TO_SIGMA, NORMAL_MEDIAN, NORMAL_MEDIAN_2D, SQUARED_NORMAL_MEDIAN_3D, median, median_absolute_deviation,
    quantile, random_stream, upper_median,
};
use proptest::prelude::*;
use rand_distr::{Distribution, StandardNormal};
use statrs::distribution::{ChiSquared, ContinuousCDF, Normal};
use statrs::statistics::{Data, OrderStatistics};

const NAN: f64 = f64::NAN;

#[test]
fn odd_and_even_numbers_of_values() {
    assert_eq!(upper_median(&mut [3.0, 1.0, 2.0]), Some(2.0));
    assert_eq!(median(&mut [3.0, 1.0, 2.0]), Some(2.0));
    assert_eq!(upper_median(&mut [4.0, 1.0, 2.0, 3.0]), Some(3.0));
    assert_eq!(median(&mut [4.0, 1.0, 2.0, 3.0]), Some(2.5));
    assert_eq!(upper_median(&mut [7.0]), Some(7.0));
    assert_eq!(median(&mut [7.0]), Some(7.0));
}

#[test]
fn nothing_has_none() {
    assert_eq!(upper_median(&mut []), None);
    assert_eq!(median(&mut []), None);
    assert_eq!(quantile(&mut [], 0.3), None);
    assert_eq!(median_absolute_deviation(&mut []), None);
}

#[test]
fn what_is_no_number_lies_beyond_infinity() {
    assert_eq!(upper_median(&mut [NAN, 1.0, 2.0]), Some(2.0));
    assert_eq!(median(&mut [1.0, f64::INFINITY, NAN]), Some(f64::INFINITY));
    assert_eq!(quantile(&mut [NAN, 1.0, 2.0], 0.0), Some(1.0));
    assert!(upper_median(&mut [NAN, NAN, 1.0]).is_some_and(f64::is_nan));
    assert!(quantile(&mut [NAN, 1.0, 2.0], 0.75).is_some_and(f64::is_nan));
}

/// Hyndman and Fan's seventh definition, as R and NumPy have it by default: the values are theirs.
#[test]
fn quantiles_are_linear_between_order_statistics() {
    let mut values = [8.0, 1.0, 4.0, 2.0];
    for (share, expected) in [(0.0, 1.0), (0.25, 1.75), (0.4, 2.4), (0.5, 3.0), (0.9, 6.8), (1.0, 8.0)] {
        let found = quantile(&mut values, share).expect("values");
        assert!((found - expected).abs() < 1e-12, "{share}: {found}");
    }
    assert_eq!(quantile(&mut values, -1.0), Some(1.0));
    assert_eq!(quantile(&mut values, 2.0), Some(8.0));
    let eighth = Data::new(values).quantile(0.25);
    assert!((eighth - 1.75).abs() > 0.1, "the definition of statrs is another one: {eighth}");
}

#[test]
fn the_constants_are_those_of_the_distributions() {
    let third_quartile = Normal::standard().inverse_cdf(0.75);
    assert!((NORMAL_MEDIAN - third_quartile).abs() < 5e-5);
    assert!((MAD_TO_SIGMA - 1.0 / third_quartile).abs() < 5e-5);
    assert!((NORMAL_MEDIAN_2D - (2.0 * std::f64::consts::LN_2).sqrt()).abs() < 5e-5);
    assert!((SQUARED_NORMAL_MEDIAN_3D - ChiSquared::new(3.0).expect("positive").inverse_cdf(0.5)).abs() < 5e-7);
}

/// Lengths of normal vectors over the constants have a median of 1; over each other's constants they have not.
#[test]
fn normal_vectors_have_these_median_lengths() {
    let mut random = random_stream(11, "median lengths", 0);
    let mut middle_squared = |dimension: usize| {
        let mut squares: Vec<f64> = (0..40_001)
            .map(|_| (0..dimension).map(|_| StandardNormal.sample(&mut random)).map(|x: f64| x * x).sum())
            .collect();
        upper_median(&mut squares).expect("values")
    };
    let (one, two, three) = (middle_squared(1), middle_squared(2), middle_squared(3));
    assert!((one.sqrt() / NORMAL_MEDIAN - 1.0).abs() < 0.02, "{one}");
    assert!((two.sqrt() / NORMAL_MEDIAN_2D - 1.0).abs() < 0.02, "{two}");
    assert!((three / SQUARED_NORMAL_MEDIAN_3D - 1.0).abs() < 0.03, "{three}");
    assert!((two.sqrt() / NORMAL_MEDIAN - 1.0).abs() > 0.5);
}

#[test]
fn the_median_absolute_deviation_ignores_outliers_where_the_standard_deviation_does_not() {
    let mut random = random_stream(12, "deviations", 0);
    let mut values: Vec<f64> = (0..20_000)
        .map(|_| {
            5.0 + 2.0 * {
                let x: f64 = StandardNormal.sample(&mut random);
                x
            }
        })
        .collect();
    values.iter_mut().step_by(10).for_each(|value| *value = 1e6);
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let deviation = (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt();
    let robust = MAD_TO_SIGMA * median_absolute_deviation(&mut values).expect("values");
    assert!((2.0..2.6).contains(&robust), "{robust}");
    assert!(deviation > 1e5, "{deviation}");
    assert_eq!(median_absolute_deviation(&mut [1.0, 1.0, 2.0, 2.0, 4.0, 6.0, 9.0]), Some(1.0));
}

#[test]
fn nothing_is_allocated() {
    let mut values: Vec<f64> = (0..1001).map(|k| f64::from(k * 7919 % 1001)).collect();
    let counted = allocation_counter::measure(|| {
        assert_eq!(upper_median(&mut values), Some(500.0));
        assert_eq!(quantile(&mut values, 0.25), Some(250.0));
        assert_eq!(median_absolute_deviation(&mut values), Some(250.0));
    });
    assert_eq!(counted.count_total, 0);
}

proptest! {
    #[test]
    fn selection_agrees_with_sorting_and_with_statrs(values in prop::collection::vec(-1e6f64..1e6, 1..60), share in 0.0f64..=1.0) {
        let mut sorted = values.clone();
        sorted.sort_by(f64::total_cmp);
        let of = |function: fn(&mut [f64]) -> Option<f64>| function(&mut values.clone());
        prop_assert_eq!(of(upper_median), Some(sorted[sorted.len() / 2]));
        prop_assert_eq!(of(median), Some(Data::new(values.clone()).median()));
        let found = quantile(&mut values.clone(), share).expect("values");
        let place = share * (sorted.len() - 1) as f64;
        let (low, high) = (sorted[place.floor() as usize], sorted[place.ceil() as usize]);
        prop_assert!(low <= found && found <= high + 1e-9);
        let mut reordered = values.clone();
        quantile(&mut reordered, share);
        reordered.sort_by(f64::total_cmp);
        prop_assert_eq!(reordered, sorted);
    }

    #[test]
    fn they_move_and_stretch_with_the_values(values in prop::collection::vec(-1e3f64..1e3, 1..40), shift in -1e3f64..1e3, scale in 0.1f64..10.0) {
        let moved: Vec<f64> = values.iter().map(|v| v * scale + shift).collect();
        let close = |a: f64, b: f64| (a - b).abs() < 1e-8;
        let (plain, other) = (upper_median(&mut values.clone()).expect("values"), upper_median(&mut moved.clone()).expect("values"));
        prop_assert!(close(plain * scale + shift, other));
        let (plain, other) = (median_absolute_deviation(&mut values.clone()).expect("values"), median_absolute_deviation(&mut moved.clone()).expect("values"));
        prop_assert!(close(plain * scale, other));
    }
}
