//! Plots and the numbers beside them.

use opnav::report::*;
use opnav::stats::ConsistencyBounds;

#[test]
fn numbers_have_four_digits_that_matter() {
    for (value, text) in [
        (0.0, "0"),
        (1.0, "1"),
        (-12345.0, "−12345"),
        (123.456, "123.5"),
        (0.012_345_6, "0.01235"),
        (-0.000_123_4, "−1.23 × 10⁻⁴"),
        (4.56789e12, "4.57 × 10¹²"),
        (99_999.7, "100000"),
        (f64::NAN, "–"),
    ] {
        assert_eq!(format_number(value), text);
    }
    assert_eq!(label_of("pair_rotation_error_p95"), "Pair rotation error 95th percentile");
    assert_eq!(label_of("nees_per_dof_mean"), "NEES per degree of freedom, mean");
    assert_eq!(label_of("ate_position_rms"), "ATE, position r.m.s.");
    assert_eq!(unit_label("deg/s"), "°/s");
}

#[test]
fn plots_survive_whatever_they_are_given() {
    let curves = [
        (vec![], vec![], vec![]),
        (vec![1.0], vec![2.0], vec![3.0]),
        (vec![0.0, 1.0], vec![0.0, 0.0], vec![0.0, 0.0]),
        (vec![0.0, 1.0], vec![f64::NAN, f64::INFINITY], vec![f64::NAN, 1.0]),
        (vec![0.0, 1.0, 2.0], vec![1e-300, -1e300, 1.0], vec![]),
        ((0..50_000).map(f64::from).collect(), (0..50_000).map(|k| f64::from(k % 17) - 8.0).collect(), vec![]),
    ];
    let bounds = ConsistencyBounds::of_mean(9, 1, 0.95);
    for (t_s, values, sigma) in &curves {
        let curve = || Curve { label: "x".into(), t_s, values, sigma };
        let plots = [
            error_with_envelope("a", "m", &[curve(), curve()]),
            consistency_plot("b", &curve(), &bounds),
            magnitude_plot("c", "deg", &curve()),
        ];
        for plot in plots {
            let svg = plot.expect("a plot").svg;
            assert!(svg.trim_end().ends_with("</svg>") && !svg.contains("NaN"), "{} bytes", svg.len());
            assert!(svg.len() < 200_000, "{} bytes", svg.len());
        }
    }
}

/// Points of the error's polyline, in the drawing's units.
fn line_points(svg: &str) -> Vec<(f64, f64)> {
    let line = svg.lines().filter(|l| l.starts_with("<polyline") && l.contains("#1F4E79")).max_by_key(|l| l.len());
    let points = line.expect("an error line").split("points=\"").nth(1).expect("points");
    let pair = |p: &str| p.split_once(',').and_then(|(x, y)| Some((x.parse().ok()?, y.parse().ok()?)));
    points.split([' ', '"']).filter_map(pair).collect()
}

#[test]
fn a_peak_is_not_lost_in_a_long_series() {
    let n = 20_000;
    let t_s: Vec<f64> = (0..n).map(f64::from).collect();
    let values: Vec<f64> = (0..n).map(|k| if k == 12_345 { 9.0 } else { 1.0 }).collect();
    let curve = Curve { label: "x".into(), t_s: &t_s, values: &values, sigma: &[] };
    let points = line_points(&error_with_envelope("peak", "m", &[curve]).expect("a plot").svg);
    assert!(points.len() < 1000, "{}", points.len());
    let top = points.iter().min_by(|a, b| a.1.total_cmp(&b.1)).expect("points");
    let (left, right) = (points[0].0, points[points.len() - 1].0);
    assert!(((top.0 - left) / (right - left) - 12_345.0 / f64::from(n)).abs() < 2e-3, "{top:?}");
    assert_eq!(points.iter().filter(|p| p.1 == top.1).count(), 1);
}
