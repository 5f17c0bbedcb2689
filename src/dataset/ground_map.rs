//! A map of the ground about a site: orthoimages with their heights, from fine to coarse.

use image::{ImageBuffer, Luma};
use nalgebra::Vector2;

/// A map in the site frame, at least one level.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundMap {
    /// The levels, the finest first. Where several cover a place, the finest counts.
    pub levels: Vec<MapLevel>,
}

/// Orthoimage and heights on one grid of square pixels. Columns run along +x of the site frame, rows along -y (north up):
/// the centre of the pixel (column, row) lies at `first_in_site_m + metres_per_px · (column, -row)`.
#[derive(Debug, Clone, PartialEq)]
pub struct MapLevel {
    /// Edge of a pixel, m.
    pub metres_per_px: f64,
    /// Place (x, y) in the site frame of the centre of the pixel (0, 0), m.
    pub first_in_site_m: Vector2<f64>,
    /// The orthoimage: brightness on one linear scale for all levels.
    pub image: ImageBuffer<Luma<u16>, Vec<u16>>,
    /// Height in the site frame at each pixel's centre, m, row by row; NaN where nothing is known, of the image neither.
    pub heights_m: Vec<f32>,
    /// 1σ of the level's own error along each horizontal axis, m.
    pub sigma_horizontal_m: f64,
    /// 1σ of the level's own error in height, m.
    pub sigma_vertical_m: f64,
}

impl MapLevel {
    /// Width and height in px.
    pub fn size_px(&self) -> (u32, u32) {
        self.image.dimensions()
    }

    /// Column and row of a place (x, y) in the site frame, m; outside of the level, too.
    pub fn pixel_of(&self, place_in_site_m: &Vector2<f64>) -> Vector2<f64> {
        let east_south = place_in_site_m - self.first_in_site_m;
        Vector2::new(east_south.x, -east_south.y) / self.metres_per_px
    }

    /// Place (x, y) in the site frame of a column and row, m.
    pub fn place_of(&self, pixel_px: &Vector2<f64>) -> Vector2<f64> {
        self.first_in_site_m + Vector2::new(pixel_px.x, -pixel_px.y) * self.metres_per_px
    }

    /// Height at a place (x, y) in the site frame, m, bilinear between pixel centres; `None` outside of the level and where
    /// one of the four heights is not known.
    pub fn height_m(&self, place_in_site_m: &Vector2<f64>) -> Option<f64> {
        let (width, height) = self.size_px();
        let at = self.pixel_of(place_in_site_m);
        if !(at.x >= 0.0 && at.y >= 0.0 && at.x <= f64::from(width - 1) && at.y <= f64::from(height - 1)) {
            return None;
        }
        let (column, row) = ((at.x as u32).min(width - 2), (at.y as u32).min(height - 2));
        let (s, t) = (at.x - f64::from(column), at.y - f64::from(row));
        let first = row as usize * width as usize + column as usize;
        let below = first + width as usize;
        let [a, b, c, d] = [first, first + 1, below, below + 1].map(|k| f64::from(self.heights_m[k]));
        let mixed = (a * (1.0 - s) + b * s) * (1.0 - t) + (c * (1.0 - s) + d * s) * t;
        mixed.is_finite().then_some(mixed)
    }
}

impl GroundMap {
    /// The finest level that knows a place (x, y) in the site frame, and the height there, m.
    pub fn height_m(&self, place_in_site_m: &Vector2<f64>) -> Option<(usize, f64)> {
        let on = |(index, level): (usize, &MapLevel)| Some((index, level.height_m(place_in_site_m)?));
        self.levels.iter().enumerate().find_map(on)
    }
}
