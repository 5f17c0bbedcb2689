//! Golden-section search.

/// Argument and value of the minimum of a unimodal function in (`low`, `high`), found with exactly `evaluations` (at
/// least 2) evaluations; the bracket shrinks by 0.618 with each.
pub fn golden_section(function: impl Fn(f64) -> f64, low: f64, high: f64, evaluations: usize) -> (f64, f64) {
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    let (mut a, mut b) = (low, high);
    let (mut x1, mut x2) = (b - ratio * (b - a), a + ratio * (b - a));
    let (mut f1, mut f2) = (function(x1), function(x2));
    for _ in 2..evaluations {
        if f1 <= f2 {
            (b, x2, f2) = (x2, x1, f1);
            x1 = b - ratio * (b - a);
            f1 = function(x1);
        } else {
            (a, x1, f1) = (x1, x2, f2);
            x2 = a + ratio * (b - a);
            f2 = function(x2);
        }
    }
    if f1 <= f2 { (x1, f1) } else { (x2, f2) }
}
