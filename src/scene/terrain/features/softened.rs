//! Features near the size of the details that are evaluated: as high as they are, shaded as if seen a little out of focus.
//!
//! Gradients and albedo that are sampled once a detail's size would put a feature of that size anywhere within it, and
//! elsewhere again when finer details are evaluated. Spread over more ground and as much weaker, they keep its place.

use super::bins::Bounded;
use crate::scene::terrain::relief::FeatureSample;
use nalgebra::Vector2;

/// Radius of the spread over the size of the details.
const SPREAD: f64 = 0.6;
/// Largest growth of a radius: wider ones would leave the cells where features are looked up.
const MOST_GROWTH: f64 = 1.8;
/// Radii over the spread from which on nothing is changed.
const UNCHANGED_RADII: f64 = 6.0;

/// A feature that can be spread.
pub trait Spreadable: Copy {
    /// Radius in m.
    fn radius_m(&self) -> f64;
    /// The feature with its radius and its strength (height and albedo) multiplied.
    fn spread(&self, growth: f64, strength: f64) -> Self;
    /// The feature with breaks of its slope rounded over a distance in m, its heights unchanged.
    fn rounded(&self, _within_m: f64) -> Self {
        *self
    }
    /// Adds what the feature does to a place (m).
    fn add_to(&self, total: &mut FeatureSample, at: &Vector2<f64>);
}

/// A feature, and the spread one that is shaded where it is small.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Softened<F> {
    shape: F,
    shade: Option<F>,
}

impl<F: Spreadable> Softened<F> {
    /// For details of a size in m.
    pub fn new(feature: F, feature_m: f64) -> Self {
        if feature_m <= 0.0 {
            return Softened { shape: feature, shade: None };
        }
        let (spread_m, radius_m) = (SPREAD * feature_m, feature.radius_m());
        let growth = (1.0 + (spread_m / radius_m).powi(2)).sqrt();
        let shape = feature.rounded(feature_m);
        // As much of it over more ground.
        let shade = || shape.spread(growth.min(MOST_GROWTH), growth.powi(-2));
        Softened { shape, shade: (radius_m < UNCHANGED_RADII * spread_m).then(shade) }
    }

    /// Adds what the feature does to a place (m).
    pub fn add_to(&self, total: &mut FeatureSample, at: &Vector2<f64>) {
        let Some(shade) = self.shade else {
            self.shape.add_to(total, at);
            return;
        };
        let (mut shaped, mut shaded) = (FeatureSample::default(), FeatureSample::default());
        self.shape.add_to(&mut shaped, at);
        shade.add_to(&mut shaded, at);
        total.height_m += shaped.height_m;
        total.gradient += shaded.gradient;
        total.albedo += shaded.albedo;
    }
}

impl<F: Bounded> Bounded for Softened<F> {
    fn circle_m(&self) -> (Vector2<f64>, f64) {
        self.shade.as_ref().unwrap_or(&self.shape).circle_m()
    }
}
