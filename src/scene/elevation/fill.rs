//! Fills what a raster does not know from its surroundings.

/// Passes of smoothing on each scale.
const PASSES: usize = 12;

/// Replaces every NaN by a smooth surface through the known values around it and returns how many there were.
///
/// From coarse to fine, each unknown value starts from the mean of the known ones of its surroundings and is then made
/// the mean of its four neighbours, over and over (a membrane, solved by Gauss and Seidel on halved grids). Without any
/// known value all stay NaN.
pub(super) fn fill_unknown(columns: usize, values: &mut [f32]) -> usize {
    let unknown: Vec<usize> = (0..values.len()).filter(|i| values[*i].is_nan()).collect();
    let rows = values.len() / columns;
    if unknown.is_empty() || unknown.len() == values.len() {
        return unknown.len();
    }
    let (half_columns, mut half) = halved(columns, rows, values);
    fill_unknown(half_columns, &mut half);
    for i in &unknown {
        values[*i] = half[(i / columns / 2) * half_columns + (i % columns) / 2];
    }
    for _ in 0..PASSES {
        unknown.iter().for_each(|i| values[*i] = neighbours_mean(columns, rows, values, *i));
    }
    unknown.len()
}

/// Means of the known values of two by two posts, and the number of columns.
fn halved(columns: usize, rows: usize, values: &[f32]) -> (usize, Vec<f32>) {
    let half_columns = columns.div_ceil(2);
    let mean = |column: usize, row: usize| {
        let block = (0..4).map(|k| (2 * column + k % 2, 2 * row + k / 2)).filter(|(c, r)| *c < columns && *r < rows);
        let known = block.map(|(c, r)| values[r * columns + c]).filter(|v| !v.is_nan());
        let (sum, count) = known.fold((0.0, 0.0), |(sum, count), v| (sum + v, count + 1.0));
        if count > 0.0 { sum / count } else { f32::NAN }
    };
    let half = (0..rows.div_ceil(2)).flat_map(|row| (0..half_columns).map(move |column| mean(column, row))).collect();
    (half_columns, half)
}

fn neighbours_mean(columns: usize, rows: usize, values: &[f32], at: usize) -> f32 {
    let (column, row) = (at % columns, at / columns);
    let left = values[if column > 0 { at - 1 } else { at }];
    let right = values[if column + 1 < columns { at + 1 } else { at }];
    let above = values[if row > 0 { at - columns } else { at }];
    let below = values[if row + 1 < rows { at + columns } else { at }];
    0.25 * (left + right + above + below)
}
