//! An affine map fitted to the matches near a point.

use crate::stats::upper_median;
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

/// `p -> linear p + shift`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Affine {
    pub linear: Matrix2<f64>,
    pub(super) shift: Vector2<f64>,
}

impl Affine {
    /// The map that takes `from_px` to `to_px`.
    pub fn about(from_px: &Vector2<f64>, to_px: &Vector2<f64>, linear: Matrix2<f64>) -> Self {
        Affine { linear, shift: to_px - linear * from_px }
    }

    pub fn apply(&self, pixel_px: &Vector2<f64>) -> Vector2<f64> {
        self.linear * pixel_px + self.shift
    }
}

/// A match: pixel before, pixel after, σ of their difference in px.
pub type Match = (Vector2<f64>, Vector2<f64>, f64);

/// An affine map and the 1σ in px of where it puts the point.
pub struct LocalFit {
    pub affine: Affine,
    pub sigma_px: f64,
}

/// Nearest matches used.
const NEAREST: usize = 40;

/// The nearest matches with their distances, nearest first; of equally near ones the first.
fn nearest<'a>(about_px: &Vector2<f64>, matches: &'a [Match]) -> Vec<(f64, &'a Match)> {
    let mut all: Vec<(f64, usize)> = matches.iter().enumerate().map(|(i, m)| ((m.0 - about_px).norm(), i)).collect();
    let nearer = |a: &(f64, usize), b: &(f64, usize)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
    if all.len() > NEAREST {
        all.select_nth_unstable_by(NEAREST, nearer);
        all.truncate(NEAREST);
    }
    all.sort_unstable_by(nearer);
    all.into_iter().map(|(distance_px, i)| (distance_px, &matches[i])).collect()
}

/// Robust weighted fit to the nearest matches (from, to, σ in px); `None` with fewer than `fewest`, or where the point lies
/// outside of what they span. Near matches weigh more: curvature of the ground grows with the square of the distance.
pub fn fit_affine(about_px: &Vector2<f64>, matches: &[Match], fewest: usize) -> Option<LocalFit> {
    let near = nearest(about_px, matches);
    if near.len() < fewest {
        return None;
    }
    let reach = near[near.len() / 2].0.max(20.0);
    let prior: Vec<f64> = near.iter().map(|(d, m)| 1.0 / (m.2.powi(2) * (1.0 + (d / reach).powi(2)).powi(2))).collect();
    let mut weights = prior.clone();
    let mut fit = solve(about_px, &near, &weights)?;
    for _ in 0..6 {
        let residual = |(_, m): &(f64, &Match)| (m.1 - fit.0 * (m.0 - about_px).push(1.0)).norm() / m.2;
        let sizes: Vec<f64> = near.iter().map(residual).collect();
        let limit = (3.0 * upper_median(&mut sizes.clone())? / 1.18).max(1.0);
        weights = prior.iter().zip(&sizes).map(|(w, s)| w / (1.0 + (s / limit).powi(2)).powi(2)).collect();
        fit = solve(about_px, &near, &weights)?;
    }
    let (map, inverse) = fit;
    let misfit: f64 =
        near.iter().zip(&weights).map(|((_, m), w)| w * (m.1 - map * (m.0 - about_px).push(1.0)).norm_squared()).sum();
    let variance = (misfit / (2.0 * near.len() as f64 - 6.0)).max(0.25);
    let linear: Matrix2<f64> = map.fixed_view::<2, 2>(0, 0).into_owned();
    let affine = Affine { linear, shift: map.column(2) - linear * about_px };
    Some(LocalFit { affine, sigma_px: (inverse[(2, 2)] * variance).sqrt() })
}

type Map = nalgebra::Matrix2x3<f64>;

/// Weighted least squares about the point: the map, and the inverse of its normal matrix.
fn solve(about_px: &Vector2<f64>, near: &[(f64, &Match)], weights: &[f64]) -> Option<(Map, Matrix3<f64>)> {
    let (mut normal, mut right) = (Matrix3::zeros(), nalgebra::Matrix3x2::zeros());
    for ((_, m), w) in near.iter().zip(weights) {
        let row: Vector3<f64> = (m.0 - about_px).push(1.0);
        normal += row * row.transpose() * *w;
        right += row * m.1.transpose() * *w;
    }
    let inverse = normal.try_inverse()?;
    Some(((inverse * right).transpose(), inverse))
}
