//! Rank of the observability matrix, order by order.

use nalgebra::DMatrix;

/// A singular value counts when it exceeds this fraction of the largest one.
pub const RELATIVE_RANK_TOLERANCE: f64 = 1e-12;

/// Rank of the observability matrix `Q_k`, the rows of all Lie derivatives up to one order.
#[derive(Debug, Clone, PartialEq)]
pub struct ObservabilityRank {
    /// Highest order `k` of the Lie derivatives included.
    pub order: usize,
    /// The rank.
    pub rank: usize,
    /// Singular values, largest first (no unit: scale rows and columns before).
    pub singular_values: Vec<f64>,
    /// Orthonormal columns that span what cannot be seen up to this order (states × (states - rank)).
    pub unobservable: DMatrix<f64>,
}

/// Ranks of `Q_0`, `Q_1`, … where `blocks[k]` holds the gradient of the k-th Lie derivative (measurements × states), in
/// comparable units. Source: Hermann and Krener, "Nonlinear controllability and observability" (1977), the rank test.
pub fn rank_by_order(blocks: &[DMatrix<f64>]) -> Vec<ObservabilityRank> {
    (0..blocks.len()).map(|order| rank_of(order, &stack(&blocks[..=order]))).collect()
}

fn stack(blocks: &[DMatrix<f64>]) -> DMatrix<f64> {
    let columns = blocks[0].ncols();
    let rows: usize = blocks.iter().map(DMatrix::nrows).sum();
    // At least square, so that the decomposition returns every right singular vector.
    let mut stacked = DMatrix::zeros(rows.max(columns), columns);
    let mut first_row = 0;
    for block in blocks {
        stacked.rows_mut(first_row, block.nrows()).copy_from(block);
        first_row += block.nrows();
    }
    stacked
}

fn rank_of(order: usize, matrix: &DMatrix<f64>) -> ObservabilityRank {
    let svd = matrix.clone().svd(false, true);
    let right = svd.v_t.as_ref().expect("the right singular vectors were asked for");
    let floor = RELATIVE_RANK_TOLERANCE * svd.singular_values.max();
    let mut by_size: Vec<usize> = (0..svd.singular_values.len()).collect();
    by_size.sort_by(|&a, &b| svd.singular_values[b].total_cmp(&svd.singular_values[a]));
    let singular_values: Vec<f64> = by_size.iter().map(|&i| svd.singular_values[i]).collect();
    let rank = singular_values.iter().filter(|&&s| s > floor).count();
    let null: Vec<_> = by_size[rank..].iter().map(|&i| right.row(i).transpose()).collect();
    let unobservable = if null.is_empty() { DMatrix::zeros(matrix.ncols(), 0) } else { DMatrix::from_columns(&null) };
    ObservabilityRank { order, rank, singular_values, unobservable }
}
