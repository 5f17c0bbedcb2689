//! The metrics themselves: how they are written, and how percentiles are taken.

use super::consistency::landing_with_noise;
use opnav::evaluation::*;
use std::fs;

#[test]
fn metrics_are_written_with_units_and_come_back() {
    let bench = landing_with_noise(1.0);
    let metrics = bench.metrics();
    // serde_json reads a number to within a few units of the last place.
    let same = |a: f64, b: f64| (a - b).abs() <= 8.0 * f64::EPSILON * b.abs();
    let back = Metrics::read(&bench.result()).expect("read");
    assert_eq!((back.mission, &back.verdicts, &back.notes), (metrics.mission, &metrics.verdicts, &metrics.notes));
    for (a, b) in back.figures.iter().zip(&metrics.figures) {
        assert_eq!((&a.name, &a.unit, a.bound.is_some()), (&b.name, &b.unit, b.bound.is_some()));
        assert!(same(a.value, b.value), "{}", a.name);
    }
    for (a, b) in back.series.iter().zip(&metrics.series) {
        assert_eq!((&a.name, &a.unit, a.t_s.len(), a.sigma.len()), (&b.name, &b.unit, b.t_s.len(), b.sigma.len()));
        assert!(a.values.iter().zip(&b.values).all(|(x, y)| same(*x, *y)), "{}", a.name);
    }
    assert_eq!((back.figures.len(), back.series.len()), (metrics.figures.len(), metrics.series.len()));
    let text = fs::read_to_string(bench.result().join("metrics.json")).expect("written");
    let object: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let figures = object["figures"].as_array().expect("figures");
    assert_eq!(figures.len(), metrics.figures.len());
    for figure in figures {
        assert!(figure["value"].is_f64() && !figure["unit"].as_str().expect("a unit").is_empty(), "{figure}");
    }
    assert_eq!(object["mission"], "landing");
}

#[test]
fn percentiles_interpolate_between_order_statistics() {
    assert_eq!(percentile(&[3.0, 1.0, 2.0, f64::NAN], 0.5), Some(2.0));
    assert_eq!(percentile(&[1.0, 2.0, 3.0, 4.0], 0.5), Some(2.5));
    assert_eq!(percentile(&[1.0, 2.0], 1.0), Some(2.0));
    assert_eq!(percentile(&[], 0.5), None);
    assert_eq!(root_mean_square([3.0, 4.0, 0.0, 0.0]), Some(2.5));
    assert_eq!(root_mean_square([]), None);
}
