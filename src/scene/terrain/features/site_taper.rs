//! The landing site is kept gentle: what stands on the ground is lower the nearer it is to the origin.

use nalgebra::Vector2;

/// A smooth minimum of two positive numbers.
pub(super) fn at_most(natural: f64, allowed: f64) -> f64 {
    natural * allowed / (natural.powi(2) + allowed.powi(2)).sqrt().max(1e-12)
}

/// A height in m that grows from 0 at the origin to `full_m`, and its gradient at a place (m); it stays below
/// `site_slope` times the distance.
pub(super) fn grown_from_site(full_m: f64, site_slope: f64, at: &Vector2<f64>) -> (f64, Vector2<f64>) {
    if full_m <= 0.0 {
        return (0.0, Vector2::zeros());
    }
    let rate_1_m2 = (site_slope / full_m).powi(2);
    let growth = rate_1_m2 * at.norm_squared();
    let whole = 1.0 + growth;
    (full_m * growth / whole, at * (2.0 * full_m * rate_1_m2 / (whole * whole)))
}
