//! Interpolation between the posts of a raster.

/// A raster of values at whole columns and rows, with ever coarser copies.
///
/// Values between posts are bicubic (Catmull and Rom 1974): exact at the posts, with a continuous gradient. Beyond the
/// border the values of the border go on outward; a raster that goes around the planet goes on at its other side.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Grid {
    /// The raster itself, then copies that each have half as many posts a row.
    levels: Vec<Level>,
}

/// Value and derivatives at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GridSample {
    pub value: f64,
    pub by_column: f64,
    pub by_row: f64,
}

#[derive(Debug, Clone, PartialEq)]
struct Level {
    columns: usize,
    rows: usize,
    values: Vec<f32>,
    wraps: bool,
}

/// Posts along the shorter side of the coarsest copy.
const COARSEST_POSTS: usize = 4;

impl Grid {
    /// Grid of `columns` values a row, row by row; `wraps` if the last column borders on the first.
    pub(super) fn new(columns: usize, values: Vec<f32>, wraps: bool) -> Self {
        let mut levels = vec![Level { columns, rows: values.len() / columns, values, wraps }];
        while let Some(coarser) = levels.last().and_then(Level::halved) {
            levels.push(coarser);
        }
        Grid { levels }
    }

    /// The grid between posts.
    pub(super) fn sample(&self, column: f64, row: f64) -> GridSample {
        self.levels[0].sample(column, row)
    }

    /// The grid with only those waves that posts `post_ratio` apart can carry: what a coarse look at it sees.
    pub(super) fn sample_coarse(&self, column: f64, row: f64, post_ratio: f64) -> GridSample {
        let halvings = (post_ratio.max(1.0).log2() as usize).min(self.levels.len() - 1);
        if halvings == 0 {
            return self.sample(column, row);
        }
        let scale = 0.5_f64.powi(halvings as i32);
        let at = |c: f64| (c + 0.5) * scale - 0.5;
        let coarse = self.levels[halvings].sample(at(column), at(row));
        GridSample { by_column: coarse.by_column * scale, by_row: coarse.by_row * scale, ..coarse }
    }

    /// Columns and rows.
    pub(super) fn size(&self) -> [usize; 2] {
        [self.levels[0].columns, self.levels[0].rows]
    }
}

impl Level {
    /// Means of two by two posts.
    fn halved(&self) -> Option<Level> {
        let (columns, rows) = (self.columns.div_ceil(2), self.rows.div_ceil(2));
        if columns.min(rows) < COARSEST_POSTS || (self.wraps && self.columns % 2 == 1) {
            return None;
        }
        let mean = |column: usize, row: usize| {
            let right = (2 * column + 1).min(self.columns - 1);
            let below = (2 * row + 1).min(self.rows - 1);
            let at = |c: usize, r: usize| self.values[r * self.columns + c];
            0.25 * (at(2 * column, 2 * row) + at(right, 2 * row) + at(2 * column, below) + at(right, below))
        };
        let values = (0..rows).flat_map(|row| (0..columns).map(move |column| mean(column, row))).collect();
        Some(Level { columns, rows, values, wraps: self.wraps })
    }

    fn sample(&self, column: f64, row: f64) -> GridSample {
        let (columns, by_column) = self.taps(column, self.columns, self.wraps);
        let (rows, by_row) = self.taps(row, self.rows, false);
        let (across, across_slope) = weights(by_column);
        let (along, along_slope) = weights(by_row);
        let mut total = GridSample { value: 0.0, by_column: 0.0, by_row: 0.0 };
        for j in 0..4 {
            let line = &self.values[rows[j] * self.columns..][..self.columns];
            let (mut value, mut slope) = (0.0, 0.0);
            for i in 0..4 {
                let post = f64::from(line[columns[i]]);
                value += across[i] * post;
                slope += across_slope[i] * post;
            }
            total.value += along[j] * value;
            total.by_column += along[j] * slope;
            total.by_row += along_slope[j] * value;
        }
        total
    }

    /// The four posts around a coordinate, and the place between the middle two.
    fn taps(&self, at: f64, count: usize, wraps: bool) -> ([usize; 4], f64) {
        let floor = at.floor();
        let first = floor.clamp(-1e15, 1e15) as i64 - 1;
        let index = |k: i64| {
            let i = first + k;
            if wraps { i.rem_euclid(count as i64) as usize } else { i.clamp(0, count as i64 - 1) as usize }
        };
        ([index(0), index(1), index(2), index(3)], at - floor)
    }
}

/// Weights of four neighbours at `t` between the middle two, and their derivatives by `t`.
fn weights(t: f64) -> ([f64; 4], [f64; 4]) {
    let value = [
        0.5 * t * (t * (2.0 - t) - 1.0),
        1.0 + 0.5 * t * t * (3.0 * t - 5.0),
        0.5 * t * (1.0 + t * (4.0 - 3.0 * t)),
        0.5 * t * t * (t - 1.0),
    ];
    let slope = [
        0.5 * (t * (4.0 - 3.0 * t) - 1.0),
        0.5 * t * (9.0 * t - 10.0),
        0.5 * (1.0 + t * (8.0 - 9.0 * t)),
        0.5 * t * (3.0 * t - 2.0),
    ];
    (value, slope)
}
