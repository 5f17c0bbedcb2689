//! Pixels and standard deviations of a pair's matches.

use super::link::{Link, SharedPoint};
use crate::vision::features::Feature;
use crate::vision::pair::{MatchedPair, PixelMatches};

/// Matched pixels with their noise, owned.
#[derive(Debug, Clone, Default)]
pub struct PairPixels {
    pub(super) pair: MatchedPair,
    pub(super) sigma_px: Vec<f64>,
}

impl PairPixels {
    pub(super) fn new(from: &[Feature], to: &[Feature], matches: impl Iterator<Item = (usize, usize)>) -> Self {
        let mut pixels = PairPixels::default();
        for (i, j) in matches {
            pixels.pair.from_px.push(from[i].pixel_px);
            pixels.pair.to_px.push(to[j].pixel_px);
            pixels.sigma_px.push((0.5 * (from[i].sigma_px.powi(2) + to[j].sigma_px.powi(2))).sqrt());
        }
        pixels
    }

    /// Pixels of the same points, each with the 1σ of the second given the first.
    pub(super) fn from_shared(points: &[SharedPoint]) -> Self {
        let mut pixels = PairPixels::default();
        for (from_px, to_px, sigma_px) in points {
            pixels.pair.from_px.push(*from_px);
            pixels.pair.to_px.push(*to_px);
            pixels.sigma_px.push(sigma_px * std::f64::consts::FRAC_1_SQRT_2);
        }
        pixels
    }

    /// The same matches with the second pixels where the links put them.
    pub(super) fn with_refined(&self, links: &[Option<Link>]) -> Self {
        let mut pixels = self.clone();
        for (i, link) in links.iter().enumerate() {
            if let Some(link) = link {
                pixels.pair.to_px[i] = link.to_px;
                pixels.sigma_px[i] = link.sigma_px * std::f64::consts::FRAC_1_SQRT_2;
            }
        }
        pixels
    }

    pub fn view(&self) -> PixelMatches<'_> {
        PixelMatches { pair: &self.pair, sigma_px: &self.sigma_px }
    }
}
