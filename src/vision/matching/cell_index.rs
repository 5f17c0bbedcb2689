//! Features by cells of the image, to find those near a place.

use nalgebra::Vector2;

/// Points by square cells of a side, so that the neighbours of a pixel lie in 3×3 cells.
pub struct CellIndex {
    side_px: f64,
    cells: std::collections::HashMap<(i64, i64), Vec<usize>>,
}

impl CellIndex {
    pub fn new<'a>(points_px: impl Iterator<Item = &'a Vector2<f64>>, side_px: f64) -> Self {
        let mut index = CellIndex { side_px, cells: std::collections::HashMap::new() };
        points_px.enumerate().for_each(|(i, pixel_px)| index.insert(i, pixel_px));
        index
    }

    pub fn insert(&mut self, number: usize, pixel_px: &Vector2<f64>) {
        self.cells.entry(self.cell(pixel_px)).or_default().push(number);
    }

    fn cell(&self, pixel_px: &Vector2<f64>) -> (i64, i64) {
        ((pixel_px.x / self.side_px).floor() as i64, (pixel_px.y / self.side_px).floor() as i64)
    }

    /// All within a side of a pixel, and some more.
    pub fn near(&self, pixel_px: &Vector2<f64>) -> impl Iterator<Item = usize> + '_ {
        let (column, row) = self.cell(pixel_px);
        let around = (-1..=1).flat_map(move |j| (-1..=1).map(move |i| (column + i, row + j)));
        around.filter_map(|cell| self.cells.get(&cell)).flatten().copied()
    }
}
