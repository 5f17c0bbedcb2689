//! Covariance when neighbouring matches err together.
//!
//! The looks of the ground change with the light and the view, and what is near in the image changes alike. So the
//! scores of the matches are added up over cells of the image, and the spread of these sums is what the estimate's
//! covariance is made of (Liang and Zeger 1986), as far as it exceeds that of independent matches.

use crate::vision::pair::normalized_match::NormalizedMatch;
use nalgebra::{Matrix3, SMatrix, SVector};

/// Cells a side of the matches' rectangle.
const CELLS: usize = 6;

/// Which cell of the first image each match lies in.
pub fn cells(normalized: &[NormalizedMatch]) -> Vec<usize> {
    let (mut low, mut high) = (nalgebra::Vector2::repeat(f64::INFINITY), nalgebra::Vector2::repeat(f64::NEG_INFINITY));
    for s in normalized {
        low = low.inf(&s.from);
        high = high.sup(&s.from);
    }
    let place = |value: f64, low: f64, high: f64| {
        (((value - low) / (high - low).max(1e-12) * CELLS as f64) as usize).min(CELLS - 1)
    };
    let cell = |s: &NormalizedMatch| place(s.from.x, low.x, high.x) + CELLS * place(s.from.y, low.y, high.y);
    normalized.iter().map(cell).collect()
}

/// Sums of values over the cells; empty cells left out.
pub fn sums_by_cell<const N: usize>(cells: &[usize], values: &[SVector<f64, N>]) -> Vec<SVector<f64, N>> {
    let mut sums = vec![(0, SVector::<f64, N>::zeros()); CELLS * CELLS];
    for (cell, value) in cells.iter().zip(values) {
        sums[*cell].0 += 1;
        sums[*cell].1 += value;
    }
    sums.into_iter().filter(|s| s.0 > 0).map(|s| s.1).collect()
}

/// Covariance of the rotation (the first three parameters) from that of independent matches, `plain`, and the matches'
/// scores. `None` where it is not determined.
///
/// The sandwich `V (Σ s sᵀ) V` of the cells' scores, corrected for their number, is right but itself uncertain: there are
/// few cells. Its mean ratio to `V` is much surer than its shape, so `V` is enlarged by that, and never made smaller.
pub fn covariance_of_rotation<const N: usize>(
    plain: &SMatrix<f64, N, N>,
    scores: &[SVector<f64, N>],
    cells: &[usize],
) -> Option<Matrix3<f64>> {
    let rotation = |m: &SMatrix<f64, N, N>| -> Matrix3<f64> { m.fixed_view::<3, 3>(0, 0).into_owned() };
    let sums = sums_by_cell(cells, scores);
    let count = sums.len() as f64;
    let middle = sums.iter().fold(SMatrix::<f64, N, N>::zeros(), |sum, s| sum + s * s.transpose());
    let sandwich = plain * middle * plain * (count / (count - 1.0).max(1.0));
    let alone = rotation(plain);
    let ratio = (alone.try_inverse()? * rotation(&sandwich)).trace() / 3.0;
    ratio.is_finite().then(|| alone * ratio.max(1.0))
}
