//! Bounds of a raster around a place, from blocks of posts.

/// Posts along the edge of the smallest block.
const BLOCK_POSTS: usize = 4;

/// What the posts of a block, and the steps from them to the next, do not exceed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BlockBounds {
    pub low: f32,
    pub high: f32,
    /// Largest difference between neighbours along a row, and from row to row.
    pub steps: [f32; 2],
}

/// Blocks of ever more posts over a raster.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Blocks {
    levels: Vec<BlockLevel>,
    wraps: bool,
}

#[derive(Debug, Clone, PartialEq)]
struct BlockLevel {
    columns: usize,
    rows: usize,
    bounds: Vec<BlockBounds>,
}

impl BlockBounds {
    const EMPTY: BlockBounds = BlockBounds { low: f32::INFINITY, high: f32::NEG_INFINITY, steps: [0.0; 2] };

    fn joined(self, other: &BlockBounds) -> BlockBounds {
        BlockBounds {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            steps: [self.steps[0].max(other.steps[0]), self.steps[1].max(other.steps[1])],
        }
    }
}

impl Blocks {
    /// Blocks of a raster with `columns` values a row; `wraps` if the last column borders on the first.
    pub(super) fn new(columns: usize, values: &[f32], wraps: bool) -> Self {
        let mut levels = vec![smallest(columns, values, wraps)];
        while let Some(last) = levels.last().filter(|l| l.columns > 1 || l.rows > 1) {
            let coarser = doubled(last);
            levels.push(coarser);
        }
        Blocks { levels, wraps }
    }

    /// Bounds of the whole raster.
    pub(super) fn all(&self) -> BlockBounds {
        self.levels.last().map_or(BlockBounds::EMPTY, |level| level.bounds[0])
    }

    /// Bounds of all values between posts within `half` columns and rows of a place, those beyond the border included.
    pub(super) fn around(&self, [column, row]: [f64; 2], half: [f64; 2]) -> BlockBounds {
        if self.wraps {
            return self.all(); // such a raster has posts of kilometres: nothing is won by looking closer
        }
        // A value between posts is made of two posts on either side.
        let half = half.map(|h| h + 2.0);
        let posts = 2.0 * half[0].max(half[1]) / BLOCK_POSTS as f64;
        let index = (posts.log2().ceil().max(0.0) as usize).min(self.levels.len() - 1);
        let level = &self.levels[index];
        let size = (BLOCK_POSTS << index) as f64;
        let range = |at: f64, half: f64| ((at - half) / size).floor() as i64..=((at + half) / size).floor() as i64;
        let mut found = BlockBounds::EMPTY;
        for j in range(row, half[1]) {
            let j = j.clamp(0, level.rows as i64 - 1) as usize;
            for i in range(column, half[0]) {
                let last = level.columns as i64;
                let i = i.clamp(0, last - 1) as usize;
                found = found.joined(&level.bounds[j * level.columns + i]);
            }
        }
        found
    }
}

fn smallest(columns: usize, values: &[f32], wraps: bool) -> BlockLevel {
    let rows = values.len() / columns;
    let block_columns = columns.div_ceil(BLOCK_POSTS);
    let mut level = BlockLevel {
        columns: block_columns,
        rows: rows.div_ceil(BLOCK_POSTS),
        bounds: vec![BlockBounds::EMPTY; block_columns * rows.div_ceil(BLOCK_POSTS)],
    };
    for (at, value) in values.iter().enumerate() {
        let (column, row) = (at % columns, at / columns);
        let next = if column + 1 < columns { Some(at + 1) } else { wraps.then_some(at + 1 - columns) };
        let step = |other: Option<usize>| other.map_or(0.0, |other| (values[other] - value).abs());
        let post = BlockBounds {
            low: *value,
            high: *value,
            steps: [step(next), step(Some(at + columns).filter(|below| *below < values.len()))],
        };
        let block = &mut level.bounds[(row / BLOCK_POSTS) * block_columns + column / BLOCK_POSTS];
        *block = block.joined(&post);
    }
    level
}

fn doubled(finer: &BlockLevel) -> BlockLevel {
    let (columns, rows) = (finer.columns.div_ceil(2), finer.rows.div_ceil(2));
    let mut level = BlockLevel { columns, rows, bounds: vec![BlockBounds::EMPTY; columns * rows] };
    for (at, bounds) in finer.bounds.iter().enumerate() {
        let block = &mut level.bounds[(at / finer.columns / 2) * columns + (at % finer.columns) / 2];
        *block = block.joined(bounds);
    }
    level
}
