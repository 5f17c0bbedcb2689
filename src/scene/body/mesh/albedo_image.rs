//! Grey images that hold a body's albedo.

use crate::scene::error::SceneError;
use std::path::Path;

/// How an image goes on beyond an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageEdge {
    /// It starts again from the other side.
    Repeat,
    /// Its outermost pixels go on.
    Clamp,
}

/// A grey image whose values are proportional to albedo: no gamma, and colours count by their luma.
#[derive(Debug, Clone, PartialEq)]
pub struct AlbedoImage {
    width_px: u32,
    height_px: u32,
    values: Vec<f32>,
    /// Beyond its upper and lower edge; to the left and right an image repeats.
    vertical_edge: ImageEdge,
}

impl AlbedoImage {
    /// Image of the given size, row by row from the top.
    ///
    /// # Panics
    /// If there are not `width_px · height_px` values, or none.
    pub fn new(width_px: u32, height_px: u32, values: Vec<f32>, vertical_edge: ImageEdge) -> Self {
        assert!(!values.is_empty() && values.len() == width_px as usize * height_px as usize, "a value a pixel");
        AlbedoImage { width_px, height_px, values, vertical_edge }
    }

    /// Reads a PNG, JPEG or TIFF of 8 or 16 bits; black is 0 and white is 1.
    ///
    /// # Errors
    /// Names the file and what is wrong with it.
    pub fn read(path: &Path, vertical_edge: ImageEdge) -> Result<Self, SceneError> {
        let unusable = |problem: String| SceneError::Unusable { path: path.into(), problem };
        let content = std::fs::read(path).map_err(|source| SceneError::Io {
            action: "read the albedo image",
            path: path.into(),
            source,
        })?;
        let image = image::load_from_memory(&content)
            .map_err(|e| unusable(format!("{e}: give a PNG, JPEG or TIFF of 8 or 16 bits")))?
            .into_luma16();
        let (width_px, height_px) = image.dimensions();
        if width_px == 0 || height_px == 0 || image.iter().all(|value| *value == 0) {
            return Err(unusable("the albedo image is black: it says nothing about the albedo".into()));
        }
        let values = image.iter().map(|value| f32::from(*value) / f32::from(u16::MAX)).collect();
        Ok(AlbedoImage { width_px, height_px, values, vertical_edge })
    }

    /// Width and height in px.
    pub fn size_px(&self) -> [u32; 2] {
        [self.width_px, self.height_px]
    }

    /// Values row by row from the top.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// How the image goes on beyond its upper and lower edge; to the left and right it repeats.
    pub fn vertical_edge(&self) -> ImageEdge {
        self.vertical_edge
    }

    /// Value at a place by bilinear interpolation between pixel centres: (0, 0) is the upper left corner of the image
    /// and (1, 1) the lower right one.
    pub fn at(&self, [right, down]: [f64; 2]) -> f64 {
        let (x, y) = (right * f64::from(self.width_px) - 0.5, down * f64::from(self.height_px) - 0.5);
        let (column, row) = (x.floor(), y.floor());
        let (s, t) = (x - column, y - row);
        let value = |dx: i64, dy: i64| {
            let column = (column as i64 + dx).rem_euclid(i64::from(self.width_px)) as usize;
            let row = match self.vertical_edge {
                ImageEdge::Repeat => (row as i64 + dy).rem_euclid(i64::from(self.height_px)),
                ImageEdge::Clamp => (row as i64 + dy).clamp(0, i64::from(self.height_px) - 1),
            } as usize;
            f64::from(self.values[row * self.width_px as usize + column])
        };
        let upper = value(0, 0) * (1.0 - s) + value(1, 0) * s;
        let lower = value(0, 1) * (1.0 - s) + value(1, 1) * s;
        upper * (1.0 - t) + lower * t
    }

    /// The image with every value multiplied.
    pub(super) fn scaled(mut self, factor: f64) -> Self {
        for value in &mut self.values {
            *value = (f64::from(*value) * factor) as f32;
        }
        self
    }
}
